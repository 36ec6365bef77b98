// What the daemon answers (host/daemon/API.md), as far as the page reads it. Every field that the daemon may
// leave out is optional here: what is absent is unknown, and is never shown as 0.

export interface Heater {
  actual_c?: number;
  target_c?: number;
  job_c?: number;  ///< what the print's own lines ask for
}

export interface Job {
  id: number;
  job: string;
  state: string;
  added?: number;
  ended?: number;
  layers?: [number, number]|number;
  reason?: string;
  seconds?: number;
  grams?: {name: string; colour?: string; grams: number}[];
}

export interface PrintState {
  state: string;
  layer?: number;
  layers?: number;
  percent?: number;
  elapsed_seconds?: number;
  left_seconds?: number;
  nozzle?: Heater;
  bed?: Heater;
  mixture?: string;
  lookahead_seconds?: number;
  speed_percent?: number;
  flow_percent?: number;
  warnings?: string[];
  reason?: string;
  prompt?: {text: string; answers: string[]};
}

export interface JobAndPrint {
  job?: Job;
  print?: PrintState
}

export interface Status extends JobAndPrint {
  state: string;
  waiting?: number;
  last?: JobAndPrint;
  bed_clear?: boolean;
  problem?: string;
  interrupted?: {id: number; job: string; print: string; question?: string};
}

export interface Filament {
  name?: string;
  material?: string;
  colour?: string
}

export interface Printer {
  name?: string;
  bed_mm?: number[];
  nozzle_mm?: number;
  port?: string;
  baud?: number;
  firmware?: string;
  connection?: 'closed'|'connecting'|'open'|'printing';
  nozzle?: Heater;
  bed?: Heater;
  homed?: boolean;
  at?: number[];
  feeders?: number;
  filaments?: Filament[];
  limits?: {nozzle_c?: number; bed_c?: number};
  action?: string;
  doing?: string;
  cools_in_seconds?: number;
  problem?: string;
}

export interface Mixture {
  name?: string;
  shares?: number[];
  colour?: string
}

export interface Position {
  layer?: number;
  bead: number;
  at?: [number, number];
  z?: number;
  fed?: Mixture;
  leaving?: {shares?: number[]; colour?: string; nearest?: string};
  change?: {seconds: number; name?: string; colour?: string};
}

export interface KnownLayer {
  layer: number;
  top?: number;
  beads: number;
  complete?: boolean;
  planned?: boolean
}

export interface Layers {
  layers: number;
  filaments?: Filament[];
  mixtures?: Mixture[];
  known: KnownLayer[];
}

export interface Temperatures {
  now: number;
  columns: string[];
  rows: (number|null)[][]
}

export interface LogLine {
  id: number;
  time: number;
  from: 'printer'|'host'|'notice';
  text: string
}

export interface DryRun {
  id: string;
  job: string;
  state: 'running'|'done'|'failed';
  percent?: number;
  made?: number;
  seconds?: number;
  filaments?: {name?: string; colour?: string; grams?: number; metres?: number}[];
  gaps_percent?: number;
  wrong_percent?: number;
  reason?: string;
  layers?: [number, number];
  grades?: {time?: string; material?: string; gaps?: string; colours?: string};
}

export interface UsedFilament extends Filament {
  spool?: string;
  metres?: number;
  grams?: number;
  cost?: number;
  currency?: string;
}

export interface PastPrint {
  id: number;
  print?: string;
  job: string;
  began?: number;
  ended_at?: number;
  seconds?: number;
  foretold_seconds?: number;
  ended: 'completed'|'stopped'|'failed';
  reason?: string;
  layers_done?: number;
  layers?: number;
  filaments?: UsedFilament[];
  currency?: string;
  warnings?: string[];
  note?: string;
  picture?: boolean;
  can_resume?: boolean;
}

export interface History {
  prints: PastPrint[];
  totals?: {prints?: number; seconds?: number; filaments?: UsedFilament[]; currency?: string};
}

export interface Finding {
  grade: 'good'|'doubtful'|'bad';
  sentence: string;
  remedy?: string
}

export interface Port {
  path: string;
  stable_path?: string;
  description?: string;
  usb?: boolean;
  firmware?: string
}

export interface Profile {
  file?: string;
  toml: string;
  keys?: {key: string; value?: unknown; unit?: string; help?: string}[];
}

export interface Preferences {
  name?: string;
  language?: string;
  camera?: string;
  presets?: {name: string; nozzle_c: number; bed_c: number}[];
}

export type Right = 'watch'|'queue'|'steer'|'all';

export interface KeyList {
  keys: {id: number; name: string; right: Right; made?: number}[];
  requests: {id: number; name: string; from?: string}[];
}
