// The page of a dry run, index.html beside its pictures: four figures that are judged, jumps to the worst
// places, and the layers with a slider. It works from a folder, without a network. Texts of the job become
// text nodes.
import {DryRun, fileOf, Grade, Kind, kinds, placeOf, Worst} from './viewer_data';
import {Stage} from './viewer_stage';
import {Language, names, preferred, remember, Words} from './viewer_words';

type Values = Record<string, string|number|boolean|((event: any) => void)>;

function make<K extends keyof HTMLElementTagNameMap>(
    tag: K, values: Values = {}, ...children: (Node|string)[]) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(values)) {
    if (typeof value === 'function')
      element.addEventListener(name, value);
    else
      element.setAttribute(name, String(value));
  }
  element.append(...children);
  return element;
}

class Viewer {
  private words = new Words(preferred());
  private kind: Kind;
  private index = 0;
  private jumped?: Worst;
  private readonly stage = new Stage();
  private readonly available: Kind[];
  private controls?: {
    slider: HTMLInputElement; label: HTMLElement; figures: HTMLElement; says: HTMLElement;
    previous: HTMLButtonElement;
    next: HTMLButtonElement;
    kinds: Map<Kind, HTMLButtonElement>;
    notice: HTMLElement
  };

  constructor(private readonly run: DryRun) {
    this.available = kinds.filter((kind) => run.layers.some((layer) => placeOf(run, layer, kind)));
    this.kind = this.available.includes('deposit') ? 'deposit' : this.available[0] ?? 'deposit';
    document.addEventListener('keydown', (event) => this.key(event));
    this.draw();
  }

  private t(...parameters: Parameters<Words['text']>): string {
    return this.words.text(...parameters);
  }

  /** The whole page, in the chosen language. */
  private draw(): void {
    document.documentElement.lang = this.words.language;
    const main = make('main', {}, this.head(), this.tiles(), this.worst(), this.layers());
    document.body.replaceChildren(main);
    this.show();
  }

  private head(): HTMLElement {
    const choice: HTMLSelectElement = make('select', {change: () => this.speak(choice.value as Language)});
    for (const [language, name] of Object.entries(names))
      choice.append(make('option', {value: language, lang: language}, name));
    choice.value = this.words.language;
    const heading = make('h1', {}, `${this.t('title')} `, make('bdi', {}, shortened(this.run.job)));
    const head = make(
        'header', {}, make('div', {}, heading, make('p', {}, make('bdi', {}, shortened(this.run.printer)))),
        make('label', {}, make('span', {}, this.t('language')), choice));
    return head;
  }

  private speak(language: Language): void {
    remember(language);
    this.words = new Words(language);
    this.draw();
    document.querySelector('select')?.focus();
  }

  // ---- figures

  private tiles(): HTMLElement {
    const {time, material, gaps, colours, ended} = this.run;
    const tiles = make(
        'section', {class: 'tiles', 'aria-label': this.t('figures')},
        this.tile('time', time.grade, this.words.duration(time.seconds), this.timeSays()),
        this.tile(
            'material', material.grade, `${this.words.number(material.total.grams, 1)} g`,
            this.t('material.fed', {error: this.words.percent(material.worst_error)}) + this.cost(),
            this.feeders()),
        this.tile('gaps', gaps.grade, this.words.percent(gaps.fraction), this.t('gaps.over', {
          overfill: this.words.percent(gaps.overfill_fraction),
          area: this.words.number(gaps.area_mm2, 0)
        })),
        this.tile('colours', colours.grade, this.words.percent(colours.fraction), this.coloursSay()));
    if (ended !== 'completed') tiles.prepend(make('p', {class: 'ended'}, this.t('ended')));
    return tiles;
  }

  private tile(
      name: 'time'|'material'|'gaps'|'colours', grade: Grade, figure: string, says: string,
      more?: HTMLElement) {
    const tile = make(
        'article', {class: `tile ${grade}`}, make('h2', {}, this.t(name)),
        make('span', {class: 'grade'}, this.t(grade)), make('p', {class: 'figure'}, figure),
        make('p', {class: 'says'}, says));
    if (more) tile.append(more);
    return tile;
  }

  private cost(): string {
    const {cost, currency} = this.run.material.total;
    return cost === undefined || !currency ? '' : `; ${this.words.number(cost, 2)} ${currency.slice(0, 8)}`;
  }

  private timeSays(): string {
    const {time, ended} = this.run;
    if (time.strikes > 0) return this.t('time.struck', {n: time.strikes});
    if (ended !== 'completed') return this.t('time.stopped');
    if (!time.lines_whole) return this.t('time.lines');
    return time.starvations > 0 ? this.t('time.starved', {n: time.starvations}) : this.t('time.good');
  }

  private coloursSay(): string {
    const {area_mm2: area, within_mm: within} = this.run.colours;
    if (area <= 0) return this.t('colours.none');
    const values = {area: this.words.number(area, 1), distance: this.words.number(within ?? 0, 2)};
    return this.t(within === undefined ? 'colours.area' : 'colours.near', values);
  }

  private feeders(): HTMLElement {
    const list = make('ul', {class: 'feeders'});
    for (const feeder of this.run.material.feeders) {
      const swatch = make('span', {class: 'swatch'});
      if (/^#[0-9a-f]{6}$/i.test(feeder.colour)) swatch.style.background = feeder.colour;
      list.append(make(
          'li', {}, swatch, make('bdi', {}, shortened(feeder.name)),
          ` ${this.words.number(feeder.grams, 1)} g, ${this.words.number(feeder.metres, 2)} m`));
    }
    return list;
  }

  // ---- the worst places

  private worst(): HTMLElement {
    const section = make('section', {}, make('h2', {}, this.t('worst')));
    if (this.run.worst.length === 0) section.append(make('p', {}, this.t('worst.none')));
    const list = make('ol', {class: 'worst'});
    for (const place of this.run.worst) {
      const says = this.t('worst.place', {
        layer: place.layer + 1,
        what: this.t(place.kind),
        area: this.words.number(place.area_mm2, 2),
        x: this.words.number(place.x_mm, 1),
        y: this.words.number(place.y_mm, 1)
      });
      list.append(make('li', {}, make('button', {type: 'button', click: () => this.jump(place)}, says)));
    }
    if (this.run.worst.length > 0) section.append(list);
    return section;
  }

  private jump(place: Worst): void {
    const index = this.run.layers.findIndex((layer) => layer.layer === place.layer);
    if (index < 0) return;
    this.index = index;
    this.kind = place.kind === 'mixture' ? 'mixtures' : 'gaps';
    this.jumped = place;
    this.show();
    this.stage.point({x: place.x_mm, y: place.y_mm});
    const calm = matchMedia('(prefers-reduced-motion: reduce)').matches;
    this.stage.element.scrollIntoView({block: 'nearest', behavior: calm ? 'auto' : 'smooth'});
  }

  // ---- the layers

  private layers(): HTMLElement {
    const section = make('section', {class: 'layers'}, make('h2', {}, this.t('layers')));
    if (this.run.layers.length === 0) {
      section.append(make('p', {}, this.t('nothing')));
      return section;
    }
    const choice = make('div', {class: 'choice', role: 'group', 'aria-label': this.t('picture')});
    const buttons = new Map<Kind, HTMLButtonElement>();
    kinds.forEach((kind, place) => {
      const name = this.t(kind === 'gaps' ? 'picture.gaps' : kind);
      const button = make(
          'button', {type: 'button', click: () => this.flip(kind), 'aria-keyshortcuts': place + 1}, name);
      button.disabled = !this.available.includes(kind);
      buttons.set(kind, button);
      choice.append(button);
    });
    const button = (name: 'previous'|'next'|'larger'|'smaller'|'whole', sign: string, act: () => void) =>
        make('button', {type: 'button', 'aria-label': this.t(name), title: this.t(name), click: act}, sign);
    const slider: HTMLInputElement = make('input', {
      type: 'range',
      min: 0,
      max: this.run.layers.length - 1,
      step: 1,
      'aria-label': this.t('layer'),
      input: () => this.go(Number(slider.value))
    });
    this.controls = {
      slider,
      kinds: buttons,
      label: make('p', {class: 'which', role: 'status'}),
      figures: make('p', {class: 'says'}),
      says: make('p', {class: 'says'}),
      notice: make('p', {class: 'notice', role: 'alert'}),
      previous: button('previous', '‹', () => this.go(this.index - 1)),
      next: button('next', '›', () => this.go(this.index + 1)),
    };
    const sizes = make(
        'div', {class: 'sizes'}, button('larger', '+', () => this.stage.grow(2)),
        button('smaller', '−', () => this.stage.grow(0.5)), button('whole', '⤢', () => this.whole()));
    section.append(
        choice, make('div', {class: 'frame'}, this.stage.element, sizes), this.controls.notice,
        make('div', {class: 'slide'}, this.controls.previous, slider, this.controls.next),
        this.controls.label, this.controls.figures, this.controls.says,
        make('p', {class: 'says keys'}, this.t('keys')));
    return section;
  }

  private flip(kind: Kind): void {
    if (!this.available.includes(kind)) return;
    this.kind = kind;
    this.show();
  }

  private go(index: number): void {
    this.index = Math.min(Math.max(index, 0), this.run.layers.length - 1);
    this.show();
  }

  private whole(): void {
    this.jumped = undefined;
    this.stage.point();
    this.stage.showWhole();
  }

  private layerName(): string {
    const {layers} = this.run, count = layers.length, layer = layers[this.index].layer + 1;
    const all = layers[0].layer === 0 && layers[count - 1].layer === count - 1;
    return this.t(all ? 'layer.of' : 'layer.some', {layer, place: this.index + 1, count});
  }

  /** The chosen picture of the chosen layer. */
  private show(): void {
    const layer = this.run.layers[this.index], controls = this.controls;
    if (!layer || !controls) return;
    const name = this.layerName();
    const figures = this.t('layer.figures', {
      gaps: this.words.percent(layer.gaps),
      overfill: this.words.percent(layer.overfill),
      colours: this.words.percent(layer.colours)
    });
    const says = this.t(`${this.kind}.says`);
    controls.slider.value = String(this.index);
    controls.slider.setAttribute('aria-valuetext', name);
    controls.previous.disabled = this.index === 0;
    controls.next.disabled = this.index === this.run.layers.length - 1;
    for (const [kind, button] of controls.kinds)
      button.setAttribute('aria-pressed', String(kind === this.kind));
    controls.label.textContent =
        `${name} · ${this.t('layer.high', {top: this.words.number(layer.top_mm, 2)})}`;
    controls.figures.textContent = figures;
    controls.says.textContent = says;
    controls.notice.textContent = '';
    if (this.jumped && this.jumped.layer !== layer.layer) {
      this.jumped = undefined;
      this.stage.point();
    }
    const place = placeOf(this.run, layer, this.kind), file = fileOf(layer, this.kind);
    const missing = () => {
      controls.notice.textContent = this.t('missing', {file});
    };
    if (!place) return missing();
    void this.stage.show(this.kind, file, place, `${name}. ${says} ${figures}.`, missing);
    this.readAhead();
  }

  /** The pictures that are likely to be wanted next. */
  private readAhead(): void {
    const near = this.run.layers[this.index + 1];
    if (near && placeOf(this.run, near, this.kind)) new Image().src = fileOf(near, this.kind);
    for (const kind of this.available) new Image().src = fileOf(this.run.layers[this.index], kind);
  }

  private key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target instanceof HTMLSelectElement) return;
    const slides = event.target instanceof HTMLInputElement;  // it has its own arrows
    const acts: Record<string, () => void> = {
      '+': () => this.stage.grow(2),
      '-': () => this.stage.grow(0.5),
      0: () => this.whole(),
      ...Object.fromEntries(kinds.map((kind, place) => [String(place + 1), () => this.flip(kind)])),
    };
    if (!slides) {
      acts.ArrowLeft = () => this.go(this.index - 1);
      acts.ArrowRight = () => this.go(this.index + 1);
    }
    const act = acts[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  }
}

/** Names of files may be of any length. */
function shortened(text: string): string {
  const most = 120, letters = Array.from(text);
  return letters.length > most ? `${letters.slice(0, most).join('')}…` : text;
}

/** Light or dark as this browser was asked for on the page of the daemon, or as the device has it. */
function followTheme(): void {
  const night = matchMedia('(prefers-color-scheme: dark)');
  const apply = () => {
    let chosen: string|null = null;
    try {
      chosen = localStorage.getItem('theme');
    } catch { /* storage may be forbidden to pages of a folder */
    }
    const dark = chosen === 'dark' || (chosen !== 'light' && night.matches);
    document.documentElement.dataset.theme = dark ? 'dark' : 'light';
  };
  night.addEventListener('change', apply);
  apply();
}

followTheme();
const data = document.getElementById('dry-run')?.textContent;
if (data) new Viewer(JSON.parse(data));
