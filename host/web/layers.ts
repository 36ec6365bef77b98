// The layers of the print that goes on: which are known, and their curves, of which the last few are kept.
import {api, ApiError} from './api';
import {decodeChunk, LayerPath} from './path';
import type {KnownLayer, Layers, Position} from './types';

const keptPaths = 4;

export class PrintLayers {
  info: Layers|null = null;
  private readonly paths = new Map<number, LayerPath>();
  private readonly plans = new Map<number, LayerPath|null>();  ///< null: there is none
  private readonly loading = new Map<number, Promise<LayerPath|null>>();

  /** Fetches what is known now; null while no print goes on. */
  async refresh(): Promise<void> {
    try {
      this.info = await api.get<Layers>('/api/print/layers');
      this.info.known.sort((a, b) => a.layer - b.layer);
    } catch (error) {
      if (!(error instanceof ApiError)) throw error;
      this.clear();
    }
  }

  clear(): void {
    this.info = null;
    this.paths.clear();
    this.plans.clear();
  }

  get known(): KnownLayer[] {
    return this.info?.known ?? [];
  }

  about(layer: number): KnownLayer|undefined {
    return this.known.find((one) => one.layer === layer);
  }

  /** Takes an event of the daemon: a layer has become known or has grown. */
  learn(news: KnownLayer): void {
    if (!this.info) return;
    const old = this.about(news.layer);
    if (old)
      Object.assign(old, news);
    else {
      this.info.known.push({...news});
      this.info.known.sort((a, b) => a.layer - b.layer);
    }
  }

  /** The curve as far as it is known now; null if the daemon no longer has it. */
  path(layer: number): Promise<LayerPath|null> {
    const running = this.loading.get(layer);
    if (running) return running;
    const loading = this.fetch(layer).finally(() => this.loading.delete(layer));
    this.loading.set(layer, loading);
    return loading;
  }

  private async fetch(layer: number): Promise<LayerPath|null> {
    const about = this.about(layer);
    let path = this.paths.get(layer);
    // What was only planned comes all over again once it is encoded; so does what was computed again after a
    // pause.
    const void_ = path && about &&
        (path.planned !== !!about.planned || about.beads < path.count || (path.complete && !about.complete));
    if (!path || void_) {
      if (path?.planned) this.plans.set(layer, path);
      path = new LayerPath(layer);
    } else if (path.complete || (about && about.beads <= path.count && !about.complete))
      return path;
    try {
      const grows = path.count > 0 && this.paths.get(layer) === path;
      const add = async (from: number) =>
          path!.add(decodeChunk(await api.bytes(`/api/print/layers/${layer}/path?from=${from}`)));
      if (!(await add(grows ? path.count : 0)) && grows) await add(0);
    } catch (error) {
      if (error instanceof ApiError && (error.status === 404 || error.status === 409))
        return this.paths.get(layer) ?? null;
      throw error;
    }
    if (about) Object.assign(about, {planned: path.planned, beads: Math.max(about.beads, path.count)});
    this.paths.delete(layer);
    this.paths.set(layer, path);
    for (const old of [...this.paths.keys()].slice(0, -keptPaths)) this.paths.delete(old);
    for (const old of [...this.plans.keys()].slice(0, -keptPaths)) this.plans.delete(old);
    return path;
  }

  /** The plan of a layer that is not encoded to its end yet; null if it is not known. */
  async plan(path: LayerPath|null): Promise<LayerPath|null> {
    if (!path || path.complete || path.planned) return null;
    const {layer} = path, known = this.plans.get(layer);
    if (known !== undefined) return known;
    this.plans.set(layer, null);  // a page that comes late asks for it once
    try {
      const plan = new LayerPath(layer);
      plan.add(decodeChunk(await api.bytes(`/api/print/layers/${layer}/plan`)));
      this.plans.set(layer, plan.count ? plan : null);
    } catch (error) {
      if (!(error instanceof ApiError)) this.plans.delete(layer);
    }
    return this.plans.get(layer) ?? null;
  }
}

/** How many of a layer's beads are laid. */
export function laidOf(layer: number, position: Position|null, beads: number): number {
  if (position?.layer === undefined || layer > position.layer) return 0;
  return layer < position.layer ? beads : Math.min(beads, position.bead);
}
