// Paints the beads of a layer. Beads of one colour and width that follow on each other become one stroke;
// points closer than a pixel are left out; colours are rounded to 5 bits and widths to half a pixel, which
// nobody sees.
import type {LayerPath} from './path';

/** How millimetres on the bed become pixels: px = x · scale + left, py = top − y · scale. */
export interface Frame {
  scale: number;
  left: number;
  top: number
}

export type Brush = Pick<CanvasRenderingContext2D, 'beginPath'|'moveTo'|'lineTo'|'stroke'>&{
  lineWidth: number;
  strokeStyle: any
};

export interface Size {
  width: number;
  height: number
}

/** Mixes `share` of a colour into the ground, for beads that are not laid yet. */
export function pale(colour: number, ground: number, share: number): number {
  const mix = (shift: number) => {
    const a = (colour >> shift) & 255, b = (ground >> shift) & 255;
    return Math.round(a * share + b * (1 - share)) << shift;
  };
  return mix(16) | mix(8) | mix(0);
}

export function cssColour(colour: number): string {
  return '#' + colour.toString(16).padStart(6, '0');
}

const coarse = (colour: number) => (colour & 0xf8f8f8) | ((colour >> 5) & 0x070707);

/**
 * Paints beads [from, to) in strokes of at most `most` beads, and returns where it stopped: after one
 * stroke.
 */
export function paintStroke(
    brush: Brush, path: LayerPath, from: number, to: number, frame: Frame, size: Size,
    shade: (colour: number) => number, most: number): number {
  let k = from;
  while (k < to && path.width[k] === 0) k++;
  if (k >= to) return to;
  const colour = coarse(path.colour[k]), width = thickness(path.width[k], frame.scale);
  const margin = width, right = size.width + margin, below = size.height + margin;
  const end = Math.min(to, k + most);
  let px = path.x[k] * frame.scale + frame.left, py = frame.top - path.y[k] * frame.scale;
  let down = false, painted = false;
  for (; k < end; k++) {
    if (path.width[k] === 0 || coarse(path.colour[k]) !== colour ||
        thickness(path.width[k], frame.scale) !== width)
      break;
    const x = path.x[k + 1] * frame.scale + frame.left, y = frame.top - path.y[k + 1] * frame.scale;
    const outside = (x < -margin && px < -margin) || (y < -margin && py < -margin) ||
        (x > right && px > right) || (y > below && py > below);
    if (outside) {
      down = false;
    } else {
      const near = Math.abs(x - px) < 0.8 && Math.abs(y - py) < 0.8;
      if (near && down && k + 1 < end && path.width[k + 1] !== 0) continue;
      if (!painted) brush.beginPath();
      if (!down) brush.moveTo(px, py);
      brush.lineTo(x, y);
      down = painted = true;
    }
    px = x;
    py = y;
  }
  if (painted) {
    brush.lineWidth = width;
    brush.strokeStyle = cssColour(shade(colour));
    brush.stroke();
  }
  return k;
}

/** Pixels of a bead of `width` × 20 µm; beads stand a little apart, so that the line can be followed. */
function thickness(width: number, scale: number): number {
  const pixels = width * 0.02 * scale * 0.86;
  return pixels < 8 ? Math.max(0.7, Math.round(pixels * 2) / 2) : Math.round(pixels);
}

/** The frame in which `bounds` fill a canvas of that size except a margin, which is wider below. */
export function fitting(bounds: number[], size: Size, margin: number, below = margin): Frame {
  const [x0, y0, x1, y1] = bounds, height = size.height - margin - below;
  const scale = Math.max(
      0.01, Math.min((size.width - 2 * margin) / Math.max(1, x1 - x0), height / Math.max(1, y1 - y0)));
  return {scale, left: (size.width - (x0 + x1) * scale) / 2, top: margin + (height + (y0 + y1) * scale) / 2};
}

/** Relative luminance as WCAG 2.2 has it, 0 to 1. */
export function luminance(colour: number): number {
  const part = (shift: number) => {
    const value = ((colour >> shift) & 255) / 255;
    return value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4;
  };
  return 0.2126 * part(16) + 0.7152 * part(8) + 0.0722 * part(0);
}

function contrast(a: number, b: number): number {
  const [light, dark] = [luminance(a), luminance(b)].sort((x, y) => y - x);
  return (light + 0.05) / (dark + 0.05);
}

/**
 * The theme's own ground if every colour is seen on it, otherwise the one that serves the worst of them
 * best.
 */
export function groundFor(colours: number[], dark: boolean): number {
  const grounds = dark ? [0x131716, 0x3a4340, 0xb9c2be] : [0xf3f3ef, 0x2a3230, 0xb9c2be];
  const worst = grounds.map((ground) => Math.min(99, ...colours.map((colour) => contrast(colour, ground))));
  const good = worst.findIndex((value) => value >= 1.5);
  return grounds[good >= 0 ? good : worst.indexOf(Math.max(...worst))];
}
