// Numbers, times and shares in words. Pure: the language is handed in. What is unknown becomes "–".

export const unknown = '–';

export type Words = (key: string, values?: Record<string, string|number>) => string;

const formats = new Map<string, Intl.NumberFormat>();

/** At most `digits` behind the point. */
export function number(language: string, value: number|null|undefined, digits = 0): string {
  if (value === null || value === undefined || !isFinite(value)) return unknown;
  const name = language + digits;
  let format = formats.get(name);
  if (!format) formats.set(name, format = new Intl.NumberFormat(language, {maximumFractionDigits: digits}));
  return format.format(value);
}

/** "1 h 05 min", "12 min", "40 s"; two units at most. */
export function duration(seconds: number|null|undefined, words: Words): string {
  if (seconds === null || seconds === undefined || !isFinite(seconds) || seconds < 0) return unknown;
  if (seconds < 59.5) return words('unit.s', {n: Math.round(seconds)});
  const minutes = Math.round(seconds / 60);
  if (minutes < 60) return words('unit.min', {n: minutes});
  const hours = Math.floor(minutes / 60);
  if (hours < 48) return words('unit.h_min', {h: hours, min: String(minutes % 60).padStart(2, '0')});
  return words('unit.d_h', {d: Math.floor(hours / 24), h: hours % 24});
}

/** The time of the day, with the day if it is not today. `when`: seconds since 1970. */
export function moment(language: string, when: number|null|undefined, now: number = Date.now()): string {
  if (when === null || when === undefined || !isFinite(when)) return unknown;
  const date = new Date(when * 1000);
  const today = date.toDateString() === new Date(now).toDateString();
  const time: Intl.DateTimeFormatOptions = {hour: 'numeric', minute: '2-digit'};
  const sameYear = date.getFullYear() === new Date(now).getFullYear();
  const day: Intl.DateTimeFormatOptions = {weekday: 'short', day: 'numeric', month: 'short'};
  return new Intl
      .DateTimeFormat(
          language,
          today        ? time :
              sameYear ? {...day, ...time} :
                         {dateStyle: 'medium'})
      .format(date);
}

/** Shares of feeders in per cent, such as "80 · 0 · 20 %". */
export function shares(language: string, values: number[]|undefined): string {
  if (!values || !values.length) return unknown;
  return values.map((share) => number(language, share * 100)).join(' · ') + ' %';
}

/** A length of filament: what is not nothing is never shown as 0. */
export function metres(language: string, value: number|null|undefined): string {
  if (value === null || value === undefined || !isFinite(value)) return unknown;
  if (value <= 0 || value >= 0.995) return `${number(language, value, 2)} m`;
  return value < 0.001 ? `< ${number(language, 1)} mm` : `${number(language, value * 1000)} mm`;
}

/** The same for a mass. `digits`: behind the point. */
export function grams(language: string, value: number|null|undefined, digits = 1): string {
  if (value === null || value === undefined || !isFinite(value)) return unknown;
  const least = 10 ** -digits;
  return value > 0 && value < least ? `< ${number(language, least, digits)} g` :
                                      `${number(language, value, digits)} g`;
}

/** "#rrggbb" if it is one, otherwise nothing: colours come from files. */
export function colour(text: string|undefined): string {
  return text && /^#[0-9a-f]{6}$/i.test(text) ? text : '';
}

/** The last part of a job's name, which may be a path. */
export function shortName(job: string|undefined): string {
  if (!job) return unknown;
  return job.slice(job.lastIndexOf('/') + 1) || job;
}

/** Seconds left as they are read aloud: rounded, so that a status does not change without need. */
export function percent(language: string, value: number|null|undefined): string {
  return value === null || value === undefined ? unknown : number(language, Math.floor(value)) + ' %';
}
