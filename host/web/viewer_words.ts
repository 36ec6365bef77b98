// What the page of a dry run says, in two languages. It is opened from a folder, so that it can fetch
// nothing.

const english = {
  language: 'Language',
  title: 'Dry run of',
  ended: 'The dry run ended early: the figures are of what was laid.',
  figures: 'Figures',
  good: 'good',
  doubtful: 'doubtful',
  bad: 'bad',
  time: 'Time',
  material: 'Material',
  gaps: 'Gaps',
  colours: 'Colour at borders',
  'time.good': 'with heating; the nozzle never waited in a curve',
  'time.starved': 'with heating; waits of the nozzle in a curve: {n}',
  'time.struck': 'the head strikes what it has printed ({n}×): do not print this',
  'time.lines': 'lines were lost or run twice',
  'time.stopped': 'until it was stopped',
  'material.fed': 'mixtures fed within {error} of what was asked',
  'gaps.over': 'of {area} mm²; {overfill} have too much plastic',
  'colours.none': 'every mixture is where it belongs',
  'colours.near': '{area} mm² nearer to another mixture; 90 % within {distance} mm of a border',
  'colours.area': '{area} mm² nearer to another mixture',
  worst: 'Worst places',
  'worst.none': 'Nothing is amiss.',
  gap: 'plastic is missing',
  overfill: 'too much plastic',
  mixture: 'wrong mixture',
  'worst.place': 'Layer {layer}: {what}, {area} mm², at x {x}, y {y} mm',
  layers: 'Layers',
  picture: 'Picture',
  layer: 'Layer',
  'layer.of': 'Layer {layer} of {count}',
  'layer.some': 'Layer {layer} ({place} of {count})',
  'layer.high': '{top} mm high',
  previous: 'Previous layer',
  next: 'Next layer',
  'layer.figures': 'gaps {gaps}, too much {overfill}, wrong mixture {colours}',
  curve: 'Curve',
  deposit: 'Deposit',
  'picture.gaps': 'Gaps',
  mixtures: 'Mixtures',
  'curve.says': 'The planned curve, in the mixtures that were asked for.',
  'deposit.says': 'The beads as they were laid, in the mixtures that really arrived.',
  'gaps.says': 'Pale: exactly full. Dark: plastic is missing. Red: too much plastic.',
  'mixtures.says': 'The mixtures that arrived. Hatched: nearer to another zone’s mixture than to their own.',
  larger: 'Larger',
  smaller: 'Smaller',
  whole: 'Whole layer',
  keys: 'Keys: 1 to 4 change the picture, the arrows the layer; + and − the size, 0 shows the whole layer.',
  missing: 'The picture {file} is not in this folder.',
  nothing: 'No layer was laid.',
  h: 'h',
  min: 'min',
  s: 's',
};

type Key = keyof typeof english;

const german: Record<Key, string> = {
  language: 'Sprache',
  title: 'Probelauf von',
  ended: 'Der Probelauf endete vorzeitig: Die Zahlen gelten für das, was gelegt wurde.',
  figures: 'Zahlen',
  good: 'gut',
  doubtful: 'fraglich',
  bad: 'schlecht',
  time: 'Zeit',
  material: 'Material',
  gaps: 'Lücken',
  colours: 'Farbe an Grenzen',
  'time.good': 'mit Aufheizen; die Düse wartete nie in einer Kurve',
  'time.starved': 'mit Aufheizen; die Düse wartete {n}-mal in einer Kurve',
  'time.struck': 'der Kopf stößt {n}-mal an Gedrucktes: bitte nicht drucken',
  'time.lines': 'Zeilen gingen verloren oder liefen doppelt',
  'time.stopped': 'bis zum Abbruch',
  'material.fed': 'Mischungen auf {error} genau gefördert',
  'gaps.over': 'von {area} mm²; auf {overfill} liegt zu viel Kunststoff',
  'colours.none': 'jede Mischung ist, wo sie hingehört',
  'colours.near':
      '{area} mm² näher an einer anderen Mischung; 90 % höchstens {distance} mm von einer Grenze entfernt',
  'colours.area': '{area} mm² näher an einer anderen Mischung',
  worst: 'Schlimmste Stellen',
  'worst.none': 'Nichts zu beanstanden.',
  gap: 'Kunststoff fehlt',
  overfill: 'zu viel Kunststoff',
  mixture: 'falsche Mischung',
  'worst.place': 'Schicht {layer}: {what}, {area} mm², bei x {x}, y {y} mm',
  layers: 'Schichten',
  picture: 'Bild',
  layer: 'Schicht',
  'layer.of': 'Schicht {layer} von {count}',
  'layer.some': 'Schicht {layer} ({place} von {count})',
  'layer.high': '{top} mm hoch',
  previous: 'Vorige Schicht',
  next: 'Nächste Schicht',
  'layer.figures': 'Lücken {gaps}, zu viel {overfill}, falsche Mischung {colours}',
  curve: 'Kurve',
  deposit: 'Gelegt',
  'picture.gaps': 'Lücken',
  mixtures: 'Mischungen',
  'curve.says': 'Die geplante Kurve in den verlangten Mischungen.',
  'deposit.says': 'Die Raupen, wie sie gelegt wurden, in den Mischungen, die wirklich ankamen.',
  'gaps.says': 'Hell: genau voll. Dunkel: Kunststoff fehlt. Rot: zu viel Kunststoff.',
  'mixtures.says':
      'Die angekommenen Mischungen. Schraffiert: näher an der Mischung einer anderen Zone als an der eigenen.',
  larger: 'Größer',
  smaller: 'Kleiner',
  whole: 'Ganze Schicht',
  keys:
      'Tasten: 1 bis 4 wechseln das Bild, die Pfeile die Schicht; + und − die Größe, 0 zeigt die ganze Schicht.',
  missing: 'Das Bild {file} liegt nicht in diesem Ordner.',
  nothing: 'Es wurde keine Schicht gelegt.',
  h: 'h',
  min: 'min',
  s: 's',
};

const languages = {
  en: english as Record<Key, string>,
  de: german
};
export type Language = keyof typeof languages;
export const names: Record<Language, string> = {
  en: 'English',
  de: 'Deutsch'
};

/** What this browser was asked for before, or prefers. Storage may be forbidden to pages of a folder. */
export function preferred(): Language {
  let chosen: string|null = null;
  try {
    chosen = localStorage.getItem('language');
  } catch { /* the browser's language then */
  }
  for (const tag of [chosen ?? '', ...navigator.languages]) {
    const language = tag.slice(0, 2).toLowerCase();
    if (language in languages) return language as Language;
  }
  return 'en';
}

export function remember(language: Language): void {
  try {
    localStorage.setItem('language', language);
  } catch { /* it is asked for again next time */
  }
}

/** Texts and numbers of one language. */
export class Words {
  constructor(readonly language: Language) {}

  text(key: Key, values: Record<string, string|number> = {}): string {
    return languages[this.language][key].replace(/\{(\w+)\}/g, (all, name) => String(values[name] ?? all));
  }
  number(value: number, digits: number): string {
    return new Intl
        .NumberFormat(this.language, {minimumFractionDigits: digits, maximumFractionDigits: digits})
        .format(value);
  }
  percent(fraction: number): string {
    return new Intl
        .NumberFormat(this.language, {style: 'percent', minimumFractionDigits: 1, maximumFractionDigits: 1})
        .format(fraction);
  }
  duration(seconds: number): string {
    const whole = Math.round(seconds), hours = Math.floor(whole / 3600),
          minutes = Math.floor((whole % 3600) / 60);
    if (hours > 0) return `${hours} ${this.text('h')} ${minutes} ${this.text('min')}`;
    return minutes > 0 ? `${minutes} ${this.text('min')} ${whole % 60} ${this.text('s')}` :
                         `${whole} ${this.text('s')}`;
  }
}
