// The frame in which the pictures of a layer are shown, all at the same place of the bed: it moves and grows
// with the mouse, fingers or keys. mm, y up; pixels, y down.
import type {Kind, Place} from './viewer_data';

interface Rectangle {
  left: number;
  top: number;
  width: number;
  height: number
}

const most = 40;     // times as large as the whole layer
const closeUp = 12;  // mm that are shown around a place

export class Stage {
  readonly element = document.createElement('div');
  private readonly ring = document.createElement('div');
  private image = document.createElement('img');
  private where?: Rectangle;  // of the picture
  private whole?: Rectangle;  // of the first picture: what "whole layer" shows
  private centre = {x: 0, y: 0};
  private zoom = 1;
  private mark?: {x: number; y: number};
  private awaited = 0;
  private readonly fingers = new Map < number, {
    x: number;
    y: number
  }
  > ();

  constructor() {
    this.element.className = 'stage';
    this.ring.className = 'ring';
    this.ring.hidden = true;
    this.image.alt = '';
    this.element.append(this.image, this.ring);
    new ResizeObserver(() => this.place()).observe(this.element);
    this.listen();
  }

  /**
   * Shows a picture when it has been read; the one before stays until then. Calls `missing` if it cannot be
   * read.
   */
  async show(kind: Kind, file: string, place: Place, alt: string, missing: () => void): Promise<void> {
    const turn = ++this.awaited;
    const next = document.createElement('img');
    next.alt = alt;
    next.draggable = false;
    next.src = file;
    try {
      await next.decode();
    } catch {
      if (turn === this.awaited) missing();
      return;
    }
    if (turn !== this.awaited) return;
    const [left, top, pixel] = place;
    this.where = {left, top, width: next.naturalWidth * pixel, height: next.naturalHeight * pixel};
    if (!this.whole) {
      this.whole = this.where;
      this.element.style.aspectRatio =
          `${Math.min(Math.max(this.whole.width / this.whole.height, 0.75), 2.5)}`;
      this.showWhole();
    }
    this.element.classList.toggle('deposit', kind === 'deposit');
    this.image.replaceWith(next);
    this.image = next;
    this.place();
  }

  showWhole(): void {
    if (!this.whole) return;
    this.zoom = 1;
    this.centre = {x: this.whole.left + this.whole.width / 2, y: this.whole.top - this.whole.height / 2};
    this.place();
  }

  /** Puts a ring around a place and shows it from near by; without a place the ring goes. */
  point(place?: {x: number; y: number}): void {
    this.mark = place;
    if (place && this.whole) {
      this.centre = {...place};
      const shown = Math.min(this.element.clientWidth, this.element.clientHeight) / this.fit();
      this.zoom = Math.min(Math.max(shown / closeUp, 1), most);
    }
    this.place();
  }

  grow(factor: number, at?: {x: number; y: number}): void {
    const before = this.zoom;
    this.zoom = Math.min(Math.max(this.zoom * factor, 1), most);
    if (this.zoom === 1) return this.showWhole();
    if (at) {  // what is under the pointer stays there
      const change = (1 - before / this.zoom) / (this.fit() * before);
      this.centre.x += (at.x - this.element.clientWidth / 2) * change;
      this.centre.y -= (at.y - this.element.clientHeight / 2) * change;
    }
    this.place();
  }

  /** Pixels per mm when the whole layer is shown. */
  private fit(): number {
    if (!this.whole) return 1;
    return Math.min(
        this.element.clientWidth / this.whole.width, this.element.clientHeight / this.whole.height);
  }

  private place(): void {
    if (!this.where) return;
    const scale = this.fit() * this.zoom;
    const x = (mm: number) => (mm - this.centre.x) * scale + this.element.clientWidth / 2;
    const y = (mm: number) => (this.centre.y - mm) * scale + this.element.clientHeight / 2;
    const {style} = this.image;
    style.left = `${x(this.where.left)}px`;
    style.top = `${y(this.where.top)}px`;
    style.width = `${this.where.width * scale}px`;
    style.height = `${this.where.height * scale}px`;
    this.element.classList.toggle('near', this.zoom > 1);
    this.ring.hidden = !this.mark;
    if (this.mark) {
      this.ring.style.left = `${x(this.mark.x)}px`;
      this.ring.style.top = `${y(this.mark.y)}px`;
      this.ring.style.width = this.ring.style.height = `${Math.max(28, 3 * scale)}px`;
    }
  }

  private listen(): void {
    const at = (event: MouseEvent) => {
      const box = this.element.getBoundingClientRect();
      return {x: event.clientX - box.left, y: event.clientY - box.top};
    };
    this.element.addEventListener('wheel', (event) => {
      if (!event.ctrlKey && this.zoom === 1 && event.deltaY > 0) return;  // the page scrolls
      event.preventDefault();
      this.grow(Math.exp(-event.deltaY / 400), at(event));
    }, {passive: false});
    this.element.addEventListener(
        'dblclick', (event) => (this.zoom > 1 ? this.showWhole() : this.grow(4, at(event))));
    this.element.addEventListener('pointerdown', (event) => {
      this.fingers.set(event.pointerId, at(event));
      this.element.setPointerCapture(event.pointerId);
    });
    this.element.addEventListener('pointermove', (event) => this.drag(event.pointerId, at(event)));
    for (const end of ['pointerup', 'pointercancel'] as const) {
      this.element.addEventListener(end, (event) => this.fingers.delete(event.pointerId));
    }
  }

  private drag(finger: number, now: {x: number; y: number}): void {
    const before = this.fingers.get(finger);
    if (!before) return;
    this.fingers.set(finger, now);
    const other = [...this.fingers].find(([id]) => id !== finger)?.[1];
    if (other) {
      const length = (p: {x: number; y: number}) => Math.hypot(p.x - other.x, p.y - other.y);
      this.grow(length(now) / Math.max(length(before), 1), other);
    } else if (this.zoom > 1) {
      const scale = this.fit() * this.zoom;
      this.centre.x -= (now.x - before.x) / scale;
      this.centre.y += (now.y - before.y) / scale;
      this.place();
    }
  }
}
