// The parts from which pages are made: buttons that give commands, steppers, swatches, dialogs and short
// messages.
import {access, ApiError} from './api';
import {Child, fill, h, icon, setAttribute, setText} from './dom';
import {live} from './live';
import type {Right} from './types';
import {colour, number, said, t, translated} from './words';

interface CommandOptions {
  label: string;
  icon?: string;
  kind?: string;
  right?: Right;
  bare?: boolean;
  run: () => Promise<unknown>| unknown;
}

export interface CommandButton extends HTMLButtonElement {
  allow(may: boolean): void
}

const commands = new Set<() => void>();

/** Every button that gives a command follows the connection and the right of the token. */
export function reviewCommands(): void {
  for (const review of commands) review();
}

/**
 * A button that gives a command to the daemon. It can be pressed while the daemon is there, nothing else is
 * on its way from it, and `allow()` agrees.
 */
export function command(options: CommandOptions): CommandButton {
  const button = h('button', {type: 'button', class: `button ${options.kind ?? ''}`},
                   options.icon ? icon(options.icon) : null,
                   options.bare ? null : h('span', {}, options.label)) as unknown as CommandButton;
  if (options.bare) {
    button.setAttribute('aria-label', options.label);
    button.title = options.label;
  }
  let allowed = true, running = false;
  const review = (): void => {
    if (!button.isConnected && button.dataset.shown) {
      commands.delete(review);
      return;
    }
    if (button.isConnected) button.dataset.shown = '1';
    const may = live.ready && access.may(options.right ?? 'steer');
    // The focus stays on a button that is off for a while only, or the keyboard would begin at the top again.
    const stays = may && document.activeElement === button;
    button.disabled = !may || (!allowed && !stays);
    setAttribute(button, 'aria-disabled', may && !allowed && stays ? 'true' : false);
    setAttribute(button, 'aria-busy', running ? 'true' : false);
  };
  button.allow = (may) => {
    allowed = may;
    commands.add(review);
    review();
  };
  button.addEventListener('blur', review);
  button.addEventListener('click', async () => {
    if (running || !allowed) return;
    running = true;
    review();
    try {
      await options.run();
    } catch (error) {
      complain(error);
    }
    running = false;
    review();
  });
  button.allow(true);
  return button;
}

export function sentenceOf(error: unknown): string {
  if (error instanceof ApiError) return translated(`refused.${error.code}`) ?? said(error.message);
  if (error instanceof DOMException && error.name === 'AbortError') return t('error.slow');
  return error instanceof TypeError ? t('error.unreachable') : String((error as Error)?.message ?? error);
}

export function complain(error: unknown): void {
  say(sentenceOf(error), 'bad');
}

/** A short message at the foot of the page; it stays for six seconds, a bad one for twenty. */
export function say(text: string, kind: 'good'|'bad' = 'good'): void {
  let place = document.querySelector('.messages');
  if (!place) document.body.append(place = h('div', {class: 'messages'}));
  const close = () => message.remove();
  const message =
      h('div', {class: `message ${kind}`, role: kind === 'bad' ? 'alert' : 'status'}, h('p', {}, text),
        h('button', {type: 'button', class: 'button quiet bare', 'aria-label': t('close'), click: close},
          icon('cancel')));
  place.append(message);
  while (place.children.length > 3) place.firstElementChild?.remove();
  window.setTimeout(close, kind === 'good' ? 6000 : 20_000);
}

/** A colour, with a light outline so that white filament is seen; the name stands beside it. */
export function swatch(): HTMLElement&{show(value: string|undefined): void} {
  const dot = h('span', {class: 'swatch', 'aria-hidden': 'true'}) as any;
  dot.show = (value: string|undefined) => {
    const good = colour(value);
    dot.style.background = good;
    dot.classList.toggle('none', !good);
  };
  dot.show(undefined);
  return dot;
}

export function swatchOf(value: string|undefined): HTMLElement {
  const dot = swatch();
  dot.show(value);
  return dot;
}

interface StepOptions {
  label: string;
  unit: string;
  step: number;
  least: number;
  most: number;
  begin?: number;  ///< from which steps are taken while the value is unknown
  send: (value: number) => Promise<unknown>;
}

export interface Stepper extends HTMLElement {
  show(value: number|undefined, beside: string): void;
  limit(most: number): void;
  allow(may: boolean): void;
}

/** A value with − and +. Presses are gathered for half a second, then sent as one. */
export function stepper(options: StepOptions): Stepper {
  let known: number|undefined, wanted: number|undefined, timer = 0, most = options.most;
  const value = h('output', {class: 'value'}), beside = h('span', {class: 'beside'});
  const change = (by: number) => {
    const from = wanted ?? known ?? options.begin;
    if (from === undefined) return;
    wanted = Math.min(most, Math.max(options.least, (Math.round(from / options.step) + by) * options.step));
    draw();
    window.clearTimeout(timer);
    timer = window.setTimeout(async () => {
      const asked = wanted;
      try {
        if (asked !== undefined) await options.send(asked);
        known = asked;
      } catch (error) {
        complain(error);
      }
      if (wanted === asked) wanted = undefined;
      draw();
    }, 500);
  };
  const less = command({
    label: t('less', {what: options.label}),
    icon: 'minus',
    bare: true,
    kind: 'quiet',
    run: () => change(-1)
  });
  const more = command({
    label: t('more', {what: options.label}),
    icon: 'plus',
    bare: true,
    kind: 'quiet',
    run: () => change(1)
  });
  const draw = () => {
    const shown = wanted ?? known;
    setText(
        value,
        shown === undefined                      ? '–' :
            shown === 0 && options.unit === '°C' ? t('heat.is_off') :
                                                   `${number(shown)} ${options.unit}`);
    value.classList.toggle('pending', wanted !== undefined);
  };
  const box = h('div', {class: 'stepper', role: 'group', 'aria-label': options.label},
                h('span', {class: 'label'}, options.label), less, value, more, beside) as unknown as Stepper;
  box.show = (now, text) => {
    known = now;
    setText(beside, text);
    draw();
  };
  box.limit = (value) => {
    most = value;
  };
  box.allow = (may) => {
    less.allow(may);
    more.allow(may);
  };
  draw();
  return box;
}

/** Asks before something is done. Resolves to the button's number, or -1 if the dialog was left. */
export function ask(title: string, text: string, buttons: {label: string; kind?: string}[]): Promise<number> {
  return new Promise((resolve) => {
    const choose = (chosen: number) => {
      dialog.close();  // the focus goes back to where it was
      dialog.remove();
      resolve(chosen);
    };
    const button = (label: string, kind: string, chosen: number) =>
        h('button', {type: 'button', class: `button ${kind}`, click: () => choose(chosen)}, label);
    const dialog: HTMLDialogElement =
        h('dialog', {
          'aria-label': title,
          cancel: (event: Event) => {
            event.preventDefault();
            choose(-1);
          }
        },
          h('h2', {}, title), h('p', {class: 'prose'}, text),
          h('div', {class: 'row end'}, button(t('leave_it'), 'quiet', -1),
            ...buttons.map((one, n) => button(one.label, one.kind ?? '', n))));
    document.body.append(dialog);
    dialog.showModal();
  });
}

/** A part of a page with a heading. */
export function card(title: string, kind: string, ...children: Child[]): HTMLElement {
  const section = h('section', {class: `card ${kind}`, 'aria-label': title}, h('h2', {}, title));
  section.append(
      ...children.filter((child) => child !== null && child !== undefined && child !== false) as Node[]);
  return section;
}

export function labelFor(id: string, text: string, kind?: string): HTMLElement {
  const label = h('label', {class: kind}, text);
  label.htmlFor = id;
  return label;
}

export function empty(title: string, text: string): HTMLElement {
  return h('div', {class: 'empty'}, h('p', {class: 'strong'}, title), h('p', {}, text));
}

/** Shows `make()`'s result, or says that it waits or why it failed, with a button to try again. */
export async function load<T>(
    place: HTMLElement, get: () => Promise<T>, show: (value: T) => void): Promise<void> {
  if (!place.childElementCount) fill(place, h('p', {class: 'loading'}, t('loading')));
  try {
    const value = await get();
    if (place.querySelector(':scope > .loading, :scope > .failed')) fill(place);
    show(value);
  } catch (error) {
    if (place.isConnected && live.ready)
      fill(
          place,
          h('div', {class: 'failed'},
            h('p', {}, missing(error) && !(error as ApiError).code ? t('error.not_here') : sentenceOf(error)),
            h('button', {type: 'button', class: 'button', click: () => void load(place, get, show)},
              t('try_again'))));
  }
}

/** Whether the daemon does not know the request at all: an older one. */
export function missing(error: unknown): boolean {
  return error instanceof ApiError && (error.status === 404 || error.status === 405 || error.status === 501);
}
