// The figures of a dry run, as host/dry_run/dry_run_view.cpp writes them into index.html. mm, mm², s.

export type Grade = 'good'|'doubtful'|'bad';
export const kinds = ['curve', 'deposit', 'gaps', 'mixtures'] as const;
export type Kind = (typeof kinds)[number];

/** Left, top, side of a pixel: where a picture lies on the bed. */
export type Place = [number, number, number];

export interface Layer {
  layer: number;
  top_mm: number;
  gaps: number;
  overfill: number;
  colours: number;
  place: Place;
  deposit?: number;
}

export interface Worst {
  kind: 'gap'|'overfill'|'mixture';
  layer: number;
  x_mm: number;
  y_mm: number;
  area_mm2: number;
}

export interface Feeder {
  name: string;
  material: string;
  colour: string;
  metres: number;
  grams: number;
  cost?: number;
}

export interface DryRun {
  version: number;
  job: string;
  printer: string;
  ended: string;
  time: {
    grade: Grade; seconds: number; laying_seconds: number; starvations: number; strikes: number;
    lines_whole: boolean
  };
  material: {
    grade: Grade; worst_error: number; feeders: Feeder[];
    total: {grams: number; cost?: number; currency?: string}
  };
  gaps: {grade: Grade; fraction: number; overfill_fraction: number; area_mm2: number};
  colours: {grade: Grade; fraction: number; area_mm2: number; within_mm?: number};
  places: {curve?: Place; deposit?: Place};
  layers: Layer[];
  worst: Worst[];
}

/** Where the picture of a layer lies; absent if there is none. */
export function placeOf(run: DryRun, layer: Layer, kind: Kind): Place|undefined {
  if (kind === 'curve') return run.places.curve;
  if (kind === 'deposit') return layer.deposit === undefined ? undefined : run.places.deposit;
  return layer.place;
}

export function fileOf(layer: Layer, kind: Kind): string {
  const number = kind === 'deposit' ? layer.deposit ?? 0 : layer.layer;
  return `${kind}-${String(number).padStart(4, '0')}.png`;
}
