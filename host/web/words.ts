// The page's languages: flat JSON files, fetched once; numbers and times by Intl.
import * as formats from './formats';

let texts: Record<string, string> = {};
let fallback: Record<string, string> = {};
let chosen = 'en';
let sentences: [RegExp, string][] = [];  ///< of the daemon, with values, and their translations
let locale = 'en';  ///< with the region of the browser, as far as it speaks the language

export const languages = ['en', 'de'];

/** The language of the person: the one chosen on this device, the daemon's, or the browser's. */
export function preferred(daemon = ''): string {
  const wanted = [localStorage.getItem('language') ?? '', daemon, ...navigator.languages];
  for (const tag of wanted) {
    const language = languages.find((known) => tag.toLowerCase().split('-')[0] === known);
    if (language) return language;
  }
  return 'en';
}

export async function speak(language: string): Promise<void> {
  const load = async (name: string) => (await fetch(`/assets/${name}.json`)).json();
  if (!Object.keys(fallback).length) fallback = await load('en');
  texts = language === 'en' ? fallback : await load(language);
  chosen = language;
  sentences = texts === fallback ? [] : Object.entries(texts).filter(([key]) => /^said\..*\{\}/.test(key)).map(sentence);
  locale = navigator.languages.find((tag) => tag.toLowerCase().split('-')[0] === language) ?? language;
  document.documentElement.lang = language;
}

export function language(): string {
  return locale;
}

/** The text of a key, with {values}. */
export function t(key: string, values: Record<string, string|number> = {}): string {
  const text = texts[key] ?? fallback[key] ?? key;
  return text.replace(/\{(\w+)\}/g, (all, name) => (name in values ? String(values[name]) : all));
}

/** The text of a word of the daemon, such as a state; a word that is not known is shown as it is. */
export function word(group: string, value: string|undefined): string {
  if (!value) return formats.unknown;
  const key = `${group}.${value}`;
  return texts[key] ?? fallback[key] ?? value;
}

/** The same for what the daemon says in English: undefined in English, and where there is no translation. */
export function translated(key: string): string|undefined {
  return texts === fallback ? undefined : texts[key];
}

/** The pattern of "said.x would be {} mm": the values are one word each. */
function sentence([key, text]: [string, string]): [RegExp, string] {
  const parts = key.slice('said.'.length).split('{}').map((part) => part.replace(/[.*+?^$()|[\]\\]/g, '\\$&'));
  return [new RegExp(`^${parts.join('(\\S+)')}$`), text];
}

/** A sentence of the daemon in the person's language, if it is one that the page knows. */
export function said(sentence: string|undefined): string {
  const whole = translated(`said.${sentence}`);
  if (whole !== undefined || !sentence) return whole ?? '';
  for (const [pattern, text] of sentences) {
    const values = pattern.exec(sentence)?.slice(1);
    const shown = values?.map((value) => (/^-?\d+(\.\d+)?$/.test(value) ? number(+value, 4) : value));
    if (shown) return text.replace(/\{(\d)\}/g, (all, place) => shown[+place - 1] ?? all);
  }
  return sentence;
}

/** "1 job", "3 jobs": the keys are `key.one` and `key.other`. */
export function plural(key: string, n: number): string {
  return word(key, new Intl.PluralRules(chosen).select(n)).replace('{n}', number(n));
}

/** On one line. */
export const together = (text: string) => text.replace(/ /g, '\u00a0');
export const number = (value: number|null|undefined, digits = 0) => formats.number(locale, value, digits);
export const duration = (seconds: number|null|undefined) => formats.duration(seconds, t);
export const moment = (when: number|null|undefined) => formats.moment(locale, when);
export const shares = (values: number[]|undefined) => formats.shares(locale, values);
export const percent = (value: number|null|undefined) => formats.percent(locale, value);
export const metres = (value: number|null|undefined) => formats.metres(locale, value);
export const grams = (value: number|null|undefined, digits = 1) => formats.grams(locale, value, digits);
export const celsius = (value: number|null|undefined) =>
    (value === null || value === undefined ? formats.unknown : `${number(value)} °C`);
export {colour, shortName, unknown} from './formats';
