// The face of the page: the layer's curve with its slider, and beneath it the colour that is fed, the one
// that leaves the nozzle, and the next change.
import {api} from '../api';
import {swatch} from '../controls';
import {CurveView} from '../curve_view';
import {h, icon, setHidden, setText, View} from '../dom';
import {laidOf, PrintLayers} from '../layers';
import {live} from '../live';
import {LayerPath} from '../path';
import type {KnownLayer, Position} from '../types';
import {number, plural, shares, t} from '../words';

/** States in which the daemon knows where the nozzle is. */
const moving = ['printing', 'pausing', 'paused', 'resuming', 'finishing'];

const calm = () => matchMedia('(prefers-reduced-motion: reduce)').matches;

export class CurvePanel extends View {
  private readonly layers = new PrintLayers();
  private curve!: CurveView;
  private slider!: HTMLInputElement;
  private label!: HTMLElement;
  private follow!: HTMLButtonElement;
  private following = true;
  private chosen = -1;
  private path: LayerPath|null = null;
  private readonly fed = swatch();
  private readonly leaving = swatch();
  private readonly next = swatch();
  private fedText!: HTMLElement;
  private fedShares!: HTMLElement;
  private leavingShares!: HTMLElement;
  private leavingText!: HTMLElement;
  private nextText!: HTMLElement;
  private nextBox!: HTMLElement;
  private changeAt = 0;
  private print = -1;
  private fetching = 0;
  private absent = -1;  ///< a layer that the daemon does not know yet

  protected show(): void {
    this.curve = new CurveView();
    this.slider = h('input', {
      type: 'range',
      min: 0,
      max: 0,
      value: 0,
      class: 'layers',
      'aria-label': t('curve.layer'),
      input: () => this.choose()
    });
    this.label = h('output', {class: 'layer-label'});
    this.follow =
        h('button', {
          type: 'button',
          class: 'button quiet follow',
          'aria-pressed': 'true',
          click: () => this.setFollowing(!this.following)
        },
          icon('follow'), h('span', {}, t('curve.follow')));
    const line = (name: string, dot: HTMLElement) => {
      const text = h('span', {class: 'what'}), more = h('span', {class: 'soft'});
      return [
        h('div', {class: 'flowing'}, dot, h('div', {}, h('span', {class: 'label'}, name), text, more)), text,
        more
      ];
    };
    const [fed, fedText, fedShares] = line(t('colour.fed'), this.fed);
    const [leaving, leavingText, leavingShares] = line(t('colour.leaving'), this.leaving);
    const [next, nextText] = line(t('colour.next'), this.next);
    Object.assign(this, {fedText, fedShares, leavingText, leavingShares, nextText, nextBox: next});
    this.append(
        this.curve, h('div', {class: 'layer-row'}, this.label, this.slider, this.follow),
        h('div', {class: 'colours'}, leaving, fed, next));
    this.until(
        live.on('position', () => this.move()), live.on('layer', (layer: KnownLayer) => this.learn(layer)),
        live.on('up', () => void this.begin()), live.on('status', () => this.noticePrint()),
        live.on('printer', () => this.showBed()));
    this.every(500, () => this.showNext());
    this.showBed();
    this.showColours();
    this.curve.say(t('curve.waits'));
    this.noticePrint();
  }

  /** Fetches everything again: a page that opens, a print that begins, a connection that is back. */
  async begin(): Promise<void> {
    if (!live.ready || !live.status?.print) return;
    this.curve.say(t('curve.waits'));
    try {
      await this.layers.refresh();
      if (this.layers.info && !live.position && moving.includes(live.state)) {
        const position = await api.get<Position>('/api/print/position').catch(() => null);
        if (position?.bead !== undefined) live.position = position;
      }
    } catch {
      return;  // the connection is gone; `up` calls again
    }
    if (!this.isConnected) return;
    const used =
        this.layers.info?.mixtures?.length ? this.layers.info.mixtures : this.layers.info?.filaments ?? [];
    this.curve.setColours(used.map((one) => one.colour ?? ''));
    this.showSlider();
    this.move();
    await this.fetchShown();
  }

  /** A print that begins while the page is open: its layers are asked for once it has a state. */
  private noticePrint(): void {
    const print = live.status?.print ? live.status.job?.id ?? 0 : -1;
    if (print === this.print) return;
    this.print = print;
    this.layers.clear();
    this.curve.forget();
    if (print >= 0) void this.begin();
  }

  private get shownLayer(): number {
    const known = this.layers.known;
    if (!this.following && this.chosen >= 0) return this.chosen;
    return live.position?.layer ?? known[0]?.layer ?? -1;
  }

  private learn(layer: KnownLayer): void {
    if (!this.layers.info) return void this.begin();
    this.layers.learn(layer);
    this.showSlider();
    if (layer.layer === this.shownLayer + 1) this.readPlan();
    if (layer.layer !== this.shownLayer || this.fetching) return;
    // Layers grow a few times a second; half a second's beads are fetched together.
    this.fetching = window.setTimeout(() => {
      this.fetching = 0;
      void this.fetchShown();
    }, this.path?.layer === layer.layer ? 500 : 0);
  }

  private async fetchShown(again = true): Promise<void> {
    const layer = this.shownLayer;
    if (layer < 0) return;
    let path: LayerPath|null, plan: LayerPath|null;
    try {
      path = this.layers.about(layer) ? await this.layers.path(layer) : null;
      plan = await this.layers.plan(path);
    } catch {
      return;
    }
    if (!this.isConnected || layer !== this.shownLayer) return;
    this.path = path;
    this.absent = path ? -1 : layer;
    this.curve.say(path && path.count ? '' : t('curve.unknown'));
    this.curve.show(path, path ? laidOf(layer, live.position, path.count) : 0, plan);
    this.showLabel();
    this.readPlan();
    const about = this.layers.about(layer);
    if (again && path && about && about.beads > path.count && !path.complete) await this.fetchShown(false);
  }

  /** The plan of the next layer lies beneath it later, while the layer is encoded piece by piece. */
  private readPlan(): void {
    const next = this.layers.about(this.shownLayer + 1);
    if (this.following && next?.planned) void this.layers.path(next.layer).catch(() => null);
  }

  private move(): void {
    this.showColours();
    const layer = this.shownLayer;
    if (layer !== this.path?.layer) {
      if (layer === this.absent) return;
      this.showSlider();
      void this.fetchShown();
    } else if (this.path) {
      this.curve.grow(laidOf(layer, live.position, this.path.count), calm());
    }
    this.showLabel();
  }

  private choose(): void {
    const known = this.layers.known[Number(this.slider.value)];
    if (!known) return;
    this.chosen = known.layer;
    this.setFollowing(false);
  }

  private setFollowing(follow: boolean): void {
    this.following = follow;
    if (!follow && this.chosen < 0) this.chosen = this.path?.layer ?? -1;
    this.follow.setAttribute('aria-pressed', String(follow));
    this.showSlider();
    void this.fetchShown();
  }

  private showBed(): void {
    const bed = live.printer?.bed_mm;
    if (bed && bed.length > 1) this.curve.setBed(bed);
  }

  private showSlider(): void {
    const known = this.layers.known;
    const at = Math.max(0, known.findIndex((one) => one.layer === this.shownLayer));
    this.slider.max = String(Math.max(0, known.length - 1));
    this.slider.value = String(at);
    this.slider.disabled = known.length < 2;
    this.showLabel();
  }

  private showLabel(): void {
    const layer = this.shownLayer, about = this.layers.about(layer), at = live.position?.layer ?? -1;
    const sort = layer === at ? 'now' : layer < at ? 'laid' : 'planned';
    const words = layer < 0 ? '' : t(`curve.${sort}`, {layer: number(layer + 1)});
    setText(this.label, words);
    this.slider.setAttribute('aria-valuetext', words);
    const all = this.layers.info?.layers;
    const laid = about && layer >= 0 ? laidOf(layer, live.position, about.beads) : 0;
    this.curve.describe(layer < 0 ? t('curve.none') : t('curve.words', {
      layer: number(layer + 1),
      layers: all ? number(all) : t('unknown'),
      laid: number(laid),
      beads: about ? plural('beads', about.beads) : t('unknown'),
      colour: live.position?.leaving?.nearest ?? t('unknown'),
    }));
  }

  private showColours(): void {
    const position = live.position;
    this.fed.show(position?.fed?.colour);
    this.leaving.show(position?.leaving?.colour);
    setText(this.fedText, position?.fed?.name ?? t('unknown'));
    setText(this.fedShares, position?.fed?.shares ? shares(position.fed.shares) : '');
    const leaving = position?.leaving;
    setText(
        this.leavingText,
        leaving?.nearest ? t(leaving.nearest === position?.fed?.name ? 'colour.is' : 'colour.nearest',
                             {name: leaving.nearest}) :
                           t('unknown'));
    setText(this.leavingShares, leaving?.shares ? shares(leaving.shares) : '');
    this.next.show(position?.change?.colour);
    this.changeAt = position?.change ? Date.now() + position.change.seconds * 1000 : 0;
    this.showNext();
  }

  private showNext(): void {
    if (live.state !== 'printing' && this.nextText.textContent) return;
    const change = live.position?.change;
    setHidden(this.nextBox, !live.position);
    if (!change) return setText(this.nextText, t('colour.no_change'));
    const seconds = Math.max(0, (this.changeAt - Date.now()) / 1000);
    setText(
        this.nextText,
        t('colour.in', {name: change.name ?? t('colour.another'), s: number(seconds, seconds < 10 ? 1 : 0)}));
  }
}

customElements.define('curve-panel', CurvePanel);
