// Making and changing elements. Texts become text nodes, never HTML: names of files, printers and jobs are
// hostile. Styles are set as classes or by element.style, since the page's policy forbids style attributes.

export type Child = Node|string|number|null|undefined|false;
type Value = string|number|boolean|null|undefined|((event: any) => void);

const properties = new Set(['value', 'checked', 'disabled', 'hidden', 'open', 'tabIndex', 'draggable']);

/**
 * Makes an element. Values that are functions listen to the event of that name; false and absent ones do
 * nothing.
 */
export function h<K extends keyof HTMLElementTagNameMap>(
    tag: K, attributes: Record<string, Value> = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) setAttribute(element, name, value);
  fill(element, ...children);
  return element;
}

export function setAttribute(element: Element, name: string, value: Value): void {
  if (typeof value === 'function')
    element.addEventListener(name, value);
  else if (properties.has(name))
    (element as any)[name] = value ?? (name === 'value' ? '' : false);
  else if (value === undefined || value === null || value === false)
    element.removeAttribute(name);
  else
    element.setAttribute(name === 'class' ? 'class' : name, value === true ? '' : String(value));
}

/** Replaces what an element holds. */
export function fill(element: Element, ...children: Child[]): void {
  const nodes = children.filter((child) => child !== null && child !== undefined && child !== false);
  element.replaceChildren(...nodes.map((child) => (child instanceof Node ? child : String(child))));
}

/** Sets the text if it differs, so that nothing is laid out or read aloud again without need. */
export function setText(element: Element, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}

export function setHidden(element: HTMLElement, hidden: boolean): void {
  if (element.hidden !== hidden) element.hidden = hidden;
}

/** Keeps one child of `parent` for each item, in their order; those of known keys stay, with their focus. */
export function fillList<T, E extends HTMLElement>(
    parent: Element, items: T[], key: (item: T) => string | number, make: (item: T) => E,
    update: (element: E, item: T) => void): void {
  const old = new Map<string, E>();
  for (const child of Array.from(parent.children) as E[]) old.set(child.dataset.key ?? '', child);
  let place: Element|null = parent.firstElementChild;
  for (const item of items) {
    const name = String(key(item));
    let element = old.get(name);
    old.delete(name);
    if (!element) {
      element = make(item);
      element.dataset.key = name;
    }
    update(element, item);
    if (element === place)
      place = place.nextElementSibling;
    else
      parent.insertBefore(element, place);
  }
  for (const gone of old.values()) gone.remove();
}

const drawings: Record<string, string> = {
  print: 'M4 19V8a2.5 2.5 0 0 1 5 0v8a2.5 2.5 0 0 0 5 0V8a2.5 2.5 0 0 1 5 0v11',
  queue: 'M9 6h11M9 12h11M9 18h11M4 6h.5M4 12h.5M4 18h.5',
  dry:
      'M2 12s4-6.5 10-6.5S22 12 22 12s-4 6.5-10 6.5S2 12 2 12zM12 9.2a2.8 2.8 0 1 1 0 5.6 2.8 2.8 0 0 1 0-5.6z',
  history: 'M3.5 12a8.5 8.5 0 1 0 2.6-6.1M3.5 4v4.5H8M12 7.5V12l3 2',
  printer: 'M4 20V5h16v15M2.5 20h19M12 5v6l-1.6 2h3.2L12 11M8 17h8',
  pause: 'M8.5 5v14M15.5 5v14',
  play: 'M7.5 5l11 7-11 7z',
  cancel: 'M6 6l12 12M18 6L6 18',
  stop: 'M8.5 3h7L21 8.5v7L15.5 21h-7L3 15.5v-7zM12 7.5v5.5M12 16v.5',
  plus: 'M12 5v14M5 12h14',
  minus: 'M5 12h14',
  up: 'M6 15l6-6 6 6',
  down: 'M6 9l6 6 6-6',
  left: 'M15 6l-6 6 6 6',
  right: 'M9 6l6 6-6 6',
  copy: 'M9 9h11v11H9zM5 15H4V4h11v1',
  trash: 'M4 7h16M9 7V4h6v3M6.5 7l1 13h9l1-13',
  follow: 'M12 3v4M12 17v4M3 12h4M17 12h4M12 8a4 4 0 1 1 0 8 4 4 0 0 1 0-8z',
  fit: 'M4 9V4h5M20 9V4h-5M4 15v5h5M20 15v5h-5',
  theme: 'M12 3a9 9 0 1 0 0 18zM12 3a9 9 0 0 1 0 18',
  upload: 'M12 16V4M7 9l5-5 5 5M4 20h16',
  home: 'M3.5 11.5L12 4l8.5 7.5M6 10v10h12V10',
  bell: 'M6 16V11a6 6 0 0 1 12 0v5l1.5 2h-15zM10 20.5h4',
  again: 'M20 12a8 8 0 1 1-2.5-5.800M20 3v5h-5',
};

/** A drawing of 24 by 24, hidden from screen readers. */
export function icon(name: string): SVGElement {
  const space = 'http://www.w3.org/2000/svg';
  const svg = document.createElementNS(space, 'svg');
  svg.setAttribute('viewBox', '0 0 24 24');
  svg.setAttribute('class', 'icon');
  svg.setAttribute('aria-hidden', 'true');
  const path = document.createElementNS(space, 'path');
  path.setAttribute('d', drawings[name] ?? '');
  svg.append(path);
  return svg;
}

/** An element that fills itself when it is shown and lets go of everything when it is taken away. */
export abstract class View extends HTMLElement {
  private endings: (() => void)[] = [];

  connectedCallback(): void {
    this.show();
  }

  disconnectedCallback(): void {
    for (const end of this.endings) end();
    this.endings = [];
    this.replaceChildren();
  }

  /** `end` is called when the element is taken away. */
  until(...endings: (() => void)[]): void {
    this.endings.push(...endings);
  }

  every(milliseconds: number, act: () => void): void {
    const timer = window.setInterval(act, milliseconds);
    this.until(() => window.clearInterval(timer));
  }

  protected abstract show(): void;
}
