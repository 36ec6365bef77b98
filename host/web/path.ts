// One layer's curve as `GET /api/print/layers/N/path` sends it (host/daemon/API.md): a head of 32 bytes and
// nine bytes for each bead, little-endian. Coordinates become millimetres on the bed.

const headBytes = 32, beadBytes = 9;

export interface Chunk {
  layer: number;
  first: number;
  count: number;
  x0: number;
  y0: number;   ///< µm
  top: number;  ///< mm
  complete: boolean;
  planned: boolean;
  revision: number;  ///< another one: what was read before is void
  beads: DataView;
}

/** Throws RangeError for bytes that are not such a chunk. */
export function decodeChunk(bytes: ArrayBuffer): Chunk {
  const view = new DataView(bytes);
  if (bytes.byteLength < headBytes || view.getUint32(0, false) !== 0x55434c31)
    throw new RangeError('the answer does not hold a layer');
  const count = view.getUint32(12, true);
  if (bytes.byteLength < headBytes + count * beadBytes) throw new RangeError('the layer is cut off');
  const flags = view.getUint8(28);
  return {
    layer: view.getUint32(4, true),
    first: view.getUint32(8, true),
    count,
    x0: view.getInt32(16, true),
    y0: view.getInt32(20, true),
    top: view.getFloat32(24, true),
    complete: (flags & 1) !== 0,
    planned: (flags & 2) !== 0,
    revision: view.getUint8(29),
    beads: new DataView(bytes, headBytes, count * beadBytes),
  };
}

/** A layer that grows. Bead k runs from point k to point k + 1. */
export class LayerPath {
  count = 0;
  top = 0;
  complete = false;
  planned = false;
  revision = 0;
  x = new Float32Array(1);  ///< mm
  y = new Float32Array(1);
  width = new Uint8Array(0);    ///< of 20 µm; 0: a travel
  asked = new Uint8Array(0);    ///< index of a mixture; 255: none
  colour = new Uint32Array(0);  ///< 0xrrggbb
  /**
   * Of what is laid, mm: least x and y, greatest x and y. The line at the edge of the bed that primes the
   *  nozzle is left out: no mixture is asked for at its begin, and a travel leads away from it.
   */
  bounds = [Infinity, Infinity, -Infinity, -Infinity];
  private priming = false;

  constructor(readonly layer: number) {}

  /** False if it does not follow on what is known; the layer then has to be fetched from bead 0. */
  add(chunk: Chunk): boolean {
    if (chunk.layer !== this.layer) return false;
    if (chunk.first === 0) this.clear();
    if (chunk.first !== this.count || (chunk.first !== 0 && chunk.revision !== this.revision)) return false;
    this.reserve(this.count + chunk.count);
    let x = chunk.x0, y = chunk.y0;
    if (this.count === 0) {
      this.x[0] = x / 1000;
      this.y[0] = y / 1000;
    }
    for (let i = 0; i < chunk.count; i++) {
      const at = i * beadBytes, k = this.count + i, beads = chunk.beads;
      x += beads.getInt16(at, true) * 10;
      y += beads.getInt16(at + 2, true) * 10;
      this.x[k + 1] = x / 1000;
      this.y[k + 1] = y / 1000;
      this.width[k] = beads.getUint8(at + 4);
      this.asked[k] = beads.getUint8(at + 5);
      this.colour[k] =
          (beads.getUint8(at + 6) << 16) | (beads.getUint8(at + 7) << 8) | beads.getUint8(at + 8);
      if (k === 0) this.priming = this.layer === 0 && this.asked[0] === 255;
      if (!this.width[k])
        this.priming = false;
      else if (!this.priming)
        this.widen(k);
    }
    this.count += chunk.count;
    this.top = chunk.top;
    this.complete = chunk.complete;
    this.planned = chunk.planned;
    this.revision = chunk.revision;
    return true;
  }

  private clear(): void {
    this.count = 0;
    this.bounds = [Infinity, Infinity, -Infinity, -Infinity];
  }

  private widen(k: number): void {
    const b = this.bounds, half = this.width[k] * 0.01;
    b[0] = Math.min(b[0], this.x[k] - half, this.x[k + 1] - half);
    b[1] = Math.min(b[1], this.y[k] - half, this.y[k + 1] - half);
    b[2] = Math.max(b[2], this.x[k] + half, this.x[k + 1] + half);
    b[3] = Math.max(b[3], this.y[k] + half, this.y[k + 1] + half);
  }

  private reserve(beads: number): void {
    if (beads <= this.width.length) return;
    const size = Math.max(beads, this.width.length * 2);
    const grown = <T extends Float32Array|Uint8Array|Uint32Array>(from: T, to: T): T =>
        (to.set(from as any), to);
    this.x = grown(this.x, new Float32Array(size + 1));
    this.y = grown(this.y, new Float32Array(size + 1));
    this.width = grown(this.width, new Uint8Array(size));
    this.asked = grown(this.asked, new Uint8Array(size));
    this.colour = grown(this.colour, new Uint32Array(size));
  }
}
