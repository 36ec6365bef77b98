// The layer's curve: what is laid in its true colours, the rest pale, the nozzle as a dot. What is drawn
// stays on a bitmap onto which only new beads are painted. Zooming moves the bitmap at once, while a second
// one is painted in slices of a few milliseconds, and then takes its place.
import {cssColour, fitting, Frame, groundFor, luminance, paintStroke, pale, Size} from './curve_paint';
import {h, icon, setText} from './dom';
import {LayerPath} from './path';
import {t} from './words';

const shares = {
  plan: 0.14,
  pale: 0.26,
  laid: 1
};                    // of the bead's colour; the rest is the ground
const sliceTime = 4;  // ms, so that a slice stays below 8 when one stroke is dear

const nowhere = [Infinity, Infinity, -Infinity, -Infinity];

interface Work {
  frame: Frame;
  at: number;
  laid: number;
  known: number;
  pass: 'plan'|'pale'|'laid'
}

export class CurveView extends HTMLElement {
  /** Of the last full drawing, and the longest slice and growing step since; ms. For measurements. */
  readonly timing = {full: 0, slice: 0, grow: 0, slices: 0};

  private shown = h('canvas', {class: 'layer', role: 'img'});
  private hiddenOne = h('canvas', {class: 'layer behind', 'aria-hidden': 'true'});
  private readonly dot = h('span', {class: 'nozzle', hidden: true});
  private readonly note = h('p', {class: 'note'});
  private readonly stage =
      h('div', {class: 'stage', role: 'group', tabindex: 0, 'aria-label': t('curve.title')});
  private path: LayerPath|null = null;
  private plan: LayerPath|null = null;
  private extent = nowhere;  ///< of all layers that were shown, mm
  private colours: number[] = [];
  private ground = 0;
  private size: Size = {width: 0, height: 0};
  private bed = [0, 0, 200, 200];
  private frame: Frame = {scale: 1, left: 0, top: 0};  ///< wanted, in pixels of the bitmap
  private drawn: Frame|null = null;                    ///< of the shown bitmap
  private fitted = true;
  private target = 0;   ///< beads that are laid
  private painted = 0;  ///< of them, on the shown bitmap
  private known = 0;    ///< beads on the shown bitmap, pale ones included
  private work: Work|null = null;
  private workBegan = 0;
  private ticking = false;
  private perStroke = 120;
  private pace = 0;
  private ratio = 1;
  private readonly pointers = new Map<number, [number, number]>();
  private watcher?: ResizeObserver;

  connectedCallback(): void {
    const zoomBy = (by: number) => () => this.zoom(by, this.size.width / 2, this.size.height / 2);
    const button = (label: string, name: string, act: () => void) => h(
        'button', {type: 'button', class: 'button quiet bare', 'aria-label': label, title: label, click: act},
        icon(name));
    this.stage.append(this.hiddenOne, this.shown, this.dot, this.note);
    this.append(
        this.stage,
        h('div', {class: 'zoom'}, button(t('curve.closer'), 'plus', zoomBy(1.6)),
          button(t('curve.farther'), 'minus', zoomBy(1 / 1.6)),
          button(t('curve.fit'), 'fit', () => this.fit())));
    this.listen();
    this.watcher = new ResizeObserver(() => this.resize());
    this.watcher.observe(this.stage);
    document.addEventListener('theme', this.redraw);
    this.redraw();
  }

  disconnectedCallback(): void {
    this.watcher?.disconnect();
    document.removeEventListener('theme', this.redraw);
    this.work = null;
  }

  describe(words: string): void {
    if (this.shown.getAttribute('aria-label') !== words) this.shown.setAttribute('aria-label', words);
  }

  /** A sentence where the curve will be; empty: none. */
  say(sentence: string): void {
    setText(this.note, sentence);
  }

  setBed(bed: number[]): void {
    this.bed = [0, 0, bed[0], bed[1]];
  }

  /** The ground is chosen so that all of these are seen on it: white filament, or black. */
  setColours(colours: string[]): void {
    this.colours =
        colours.filter((text) => /^#[0-9a-f]{6}$/i.test(text)).map((text) => parseInt(text.slice(1), 16));
    this.redraw();
  }

  /**
   * Shows a layer of which `laid` beads are laid; null: none. `plan`: what lies beneath while the layer is
   * not known to its end.
   */
  show(path: LayerPath|null, laid: number, plan: LayerPath|null = null): void {
    const grown = path !== null && path === this.path && plan === this.plan, before = this.frame;
    this.path = path;
    this.plan = plan;
    for (const one of [path, plan]) this.widen(one);
    this.target = path ? Math.min(laid, path.count) : 0;
    if (this.fitted) this.fitFrame();
    const still =
        before.scale === this.frame.scale && before.left === this.frame.left && before.top === this.frame.top;
    if (grown && still && this.target >= this.painted && path.count >= this.known) return this.tick();
    this.pace = 0;
    this.begin();
  }

  /** More beads are laid, or have become known. */
  grow(laid: number, atOnce: boolean): void {
    if (!this.path) return;
    const target = Math.min(laid, this.path.count);
    if (target < this.painted) return this.show(this.path, target, this.plan);
    this.target = target;
    this.pace = atOnce ? Infinity : Math.max(1, (target - this.painted) / 15);
    this.tick();
  }

  fit(): void {
    this.fitted = true;
    this.stage.classList.remove('zoomed');
    this.fitFrame();
    this.begin();
  }

  readonly redraw = () => {
    this.ground = groundFor(this.colours, document.documentElement.dataset.theme === 'dark');
    this.stage.style.background = cssColour(this.ground);
    this.stage.toggleAttribute('data-dark', luminance(this.ground) < 0.18);
    this.begin();
  };

  /** The frame holds all layers that were shown, so that it stands still from layer to layer. */
  private widen(path: LayerPath|null): void {
    if (!path) return;
    const [a, b] = [this.extent, path.bounds];
    this.extent = [Math.min(a[0], b[0]), Math.min(a[1], b[1]), Math.max(a[2], b[2]), Math.max(a[3], b[3])];
  }

  /** Another print. */
  forget(): void {
    this.extent = nowhere;
    this.show(null, 0);
  }

  private fitFrame(): void {
    const known = this.extent[2] > this.extent[0];
    this.frame = fitting(known ? this.extent : this.bed, this.size, 18 * this.ratio, 58 * this.ratio);
  }

  private resize(): void {
    this.ratio = Math.min(2, devicePixelRatio || 1);
    const size = {
      width: Math.round(this.stage.clientWidth * this.ratio),
      height: Math.round(this.stage.clientHeight * this.ratio)
    };
    if (!size.width || (size.width === this.size.width && size.height === this.size.height)) return;
    this.size = size;
    for (const canvas of [this.shown, this.hiddenOne]) {
      canvas.width = size.width;
      canvas.height = size.height;
    }
    this.drawn = null;
    if (this.fitted) this.fitFrame();
    this.begin();
  }

  // ---- painting

  /** Paints all of it again onto the hidden bitmap. */
  private begin(): void {
    if (!this.size.width) return;
    this.place();
    this.work = {frame: this.frame, at: 0, laid: this.target, known: 0, pass: 'plan'};
    this.workBegan = performance.now();
    this.timing.slice = this.timing.slices = 0;
    brushOf(this.hiddenOne).clearRect(0, 0, this.size.width, this.size.height);
    this.tick();
  }

  private tick(): void {
    if (this.ticking) return;
    this.ticking = true;
    const frame = () => {
      this.ticking = false;
      if (!this.isConnected) return;
      if (this.work)
        this.slice();
      else
        this.advance();
      if (this.work || (this.path && (this.painted < this.target || this.known < this.path.count)))
        this.tick();
    };
    if (document.hidden)
      window.setTimeout(frame, 50);
    else if (this.work)
      after(frame);
    else
      requestAnimationFrame(frame);
  }

  private slice(): void {
    const work = this.work, path = this.path, began = performance.now();
    if (!work) return;
    const brush = brushOf(this.hiddenOne);
    while (path && performance.now() - began < sliceTime) {
      const what = work.pass === 'plan' ? this.plan : path;
      const end = work.pass === 'laid' ? work.laid : what?.count ?? 0;
      if (what && work.at < end) {
        const before = performance.now();
        work.at = paintStroke(
            brush, what, work.at, end, work.frame, this.size, this.shade(shares[work.pass]), this.perStroke);
        flush(brush);
        this.perStroke = adapted(this.perStroke, performance.now() - before);
      } else if (work.pass === 'plan') {
        work.pass = 'pale';
        work.at = work.laid;
      } else if (work.pass === 'pale') {
        work.pass = 'laid';
        work.known = path.count;
        work.at = 0;
      } else
        break;
    }
    this.timing.slices++;
    this.timing.slice = Math.max(this.timing.slice, performance.now() - began);
    if (!path || (work.pass === 'laid' && work.at >= work.laid)) this.swap(work);
  }

  private shade(share: number): (colour: number) => number {
    return share === 1 ? (colour) => colour : (colour) => pale(colour, this.ground, share);
  }

  private swap(work: Work): void {
    this.timing.full = performance.now() - this.workBegan;
    this.timing.grow = 0;
    this.work = null;
    [this.shown, this.hiddenOne] = [this.hiddenOne, this.shown];
    this.shown.classList.remove('behind');
    this.hiddenOne.classList.add('behind');
    this.shown.setAttribute('role', 'img');
    this.shown.setAttribute('aria-label', this.hiddenOne.getAttribute('aria-label') ?? '');
    this.shown.removeAttribute('aria-hidden');
    this.hiddenOne.setAttribute('aria-hidden', 'true');
    this.drawn = work.frame;
    this.painted = work.laid;
    this.known = work.known;
    this.place();
  }

  /** Paints the beads that were laid since, some of them each frame, so that the line grows smoothly. */
  private advance(): void {
    const path = this.path;
    if (!path || !this.drawn) return;
    const began = performance.now(), brush = brushOf(this.shown);
    while (this.known < path.count && performance.now() - began < 2)
      this.known = paintStroke(
          brush, path, Math.max(this.known, this.painted), path.count, this.drawn, this.size,
          this.shade(shares.pale), 40);
    const end = Math.min(
        this.target, this.known,
        this.painted + (this.pace === Infinity ? this.target : Math.max(1, Math.ceil(this.pace))));
    while (this.painted < end && performance.now() - began < 2)
      this.painted =
          paintStroke(brush, path, this.painted, end, this.drawn, this.size, (colour) => colour, 40);
    flush(brush);
    this.timing.grow = Math.max(this.timing.grow, performance.now() - began);
    this.place();
  }

  /** Moves the bitmap and the dot to where the wanted frame has them. */
  private place(): void {
    const {frame, drawn, ratio, path} = this;
    if (drawn) {
      const k = frame.scale / drawn.scale;
      this.shown.style.transform = k === 1 && frame.left === drawn.left && frame.top === drawn.top ?
          '' :
          `matrix(${k}, 0, 0, ${k}, ${(frame.left - drawn.left * k) / ratio}, ${
              (frame.top - drawn.top * k) / ratio})`;
    }
    const laying = path && this.painted > 0 && (this.painted < path.count || !path.complete);
    this.dot.hidden = !laying;
    if (!path || !laying) return;
    const x = (path.x[this.painted] * frame.scale + frame.left) / ratio,
          y = (frame.top - path.y[this.painted] * frame.scale) / ratio;
    this.dot.style.transform = `translate(${x}px, ${y}px)`;
  }

  // ---- zooming

  /** `x`, `y`: what stays where it is, in pixels of the bitmap. */
  private zoom(by: number, x: number, y: number): void {
    const least = fitting(this.bed, this.size, 0).scale * 0.5;
    const scale = Math.min(400 * this.ratio, Math.max(least, this.frame.scale * by)),
          k = scale / this.frame.scale;
    this.move({scale, left: x + (this.frame.left - x) * k, top: y + (this.frame.top - y) * k});
  }

  private move(frame: Frame): void {
    this.frame = frame;
    this.fitted = false;
    this.stage.classList.add('zoomed');
    this.begin();
  }

  private pan(dx: number, dy: number): void {
    this.move({...this.frame, left: this.frame.left + dx, top: this.frame.top + dy});
  }

  /** A finger scrolls the page until the curve was zoomed (page.css); two fingers always zoom. */
  private listen(): void {
    const stage = this.stage;
    const at = (event: MouseEvent): [number, number] => {
      const box = stage.getBoundingClientRect();
      return [(event.clientX - box.left) * this.ratio, (event.clientY - box.top) * this.ratio];
    };
    stage.addEventListener('wheel', (event) => {
      if (!event.ctrlKey && !finePointer()) return;
      event.preventDefault();
      this.zoom(Math.exp(-event.deltaY * (event.deltaMode ? 0.06 : 0.002)), ...at(event));
    }, {passive: false});
    stage.addEventListener('pointerdown', (event) => {
      this.pointers.set(event.pointerId, at(event));
      if (event.pointerType === 'mouse' || !this.fitted) stage.setPointerCapture(event.pointerId);
    });
    const lift = (event: PointerEvent) => void this.pointers.delete(event.pointerId);
    stage.addEventListener('pointerup', lift);
    stage.addEventListener('pointercancel', lift);
    stage.addEventListener('pointermove', (event) => {
      if (this.pointers.has(event.pointerId)) this.drag(event.pointerId, at(event), event.pointerType);
    });
    stage.addEventListener('dblclick', (event) => (this.fitted ? this.zoom(3, ...at(event)) : this.fit()));
    stage.addEventListener('keydown', (event) => this.key(event));
  }

  private drag(id: number, to: [number, number], kind: string): void {
    const from = this.pointers.get(id) as [number, number];
    this.pointers.set(id, to);
    const other = [...this.pointers.entries()].find(([key]) => key !== id)?.[1];
    if (!other) {
      if (kind === 'mouse' || !this.fitted) this.pan(to[0] - from[0], to[1] - from[1]);
      return;
    }
    const span = (point: number[]) => Math.hypot(point[0] - other[0], point[1] - other[1]);
    this.pan((to[0] - from[0]) / 2, (to[1] - from[1]) / 2);
    if (span(from) > 10) this.zoom(span(to) / span(from), (to[0] + other[0]) / 2, (to[1] + other[1]) / 2);
  }

  private key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const step = 60 * this.ratio, middle: [number, number] = [this.size.width / 2, this.size.height / 2];
    const acts: Record<string, () => void> = {
      '+': () => this.zoom(1.4, ...middle),
      '=': () => this.zoom(1.4, ...middle),
      '-': () => this.zoom(1 / 1.4, ...middle),
      '0': () => this.fit(),
      ArrowLeft: () => this.pan(step, 0),
      ArrowRight: () => this.pan(-step, 0),
      ArrowUp: () => this.pan(0, step),
      ArrowDown: () => this.pan(0, -step),
    };
    const act = acts[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  }
}

const finePointer = () => matchMedia('(pointer: fine)').matches;

const brushes = new WeakMap<HTMLCanvasElement, CanvasRenderingContext2D>();

/** A bitmap in memory, so that its cost is known when it arises. */
function brushOf(canvas: HTMLCanvasElement): CanvasRenderingContext2D {
  let brush = brushes.get(canvas);
  if (!brush) {
    brush = canvas.getContext('2d', {willReadFrequently: true}) as CanvasRenderingContext2D;
    brushes.set(canvas, brush);
  }
  brush.lineCap = 'round';
  brush.lineJoin = 'round';
  return brush;
}

/** Browsers put strokes off; asking for a pixel makes them paint now, within the slice. */
function flush(brush: CanvasRenderingContext2D): void {
  brush.getImageData(0, 0, 1, 1);
}

/** Beads of a stroke, so that it takes about a millisecond. */
function adapted(beads: number, took: number): number {
  return Math.min(
      2000,
      Math.max(
          24,
          took > 2       ? Math.floor(beads / 1.5) :
              took < 0.7 ? Math.ceil(beads * 1.3) :
                           beads));
}

const channel = new MessageChannel();
let waiting: (() => void)[] = [];
channel.port1.onmessage = () => {
  const all = waiting;
  waiting = [];
  for (const act of all) act();
};

/** Soon, but after the browser had its turn. */
function after(act: () => void): void {
  waiting.push(act);
  channel.port2.postMessage(0);
}

customElements.define('curve-view', CurveView);
