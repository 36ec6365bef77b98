// Temperatures of the last hour as lines on a canvas: values full, targets dashed and pale. Gaps stay gaps.
import {h} from './dom';
import {language, number, t} from './words';

export interface Line {
  name: string;
  colour: string;
  dashed?: boolean;
  points: [number, number|null][]
}

export interface Chart extends HTMLElement {
  draw(lines: Line[], now: number): void
}

const longestGap = 15;  // s without a value that are still drawn through
const hour = 3600, left = 34, bottom = 20, above = 8;

export function chart(label: string): Chart {
  const canvas = h('canvas', {role: 'img', 'aria-label': label});
  const box = h('div', {class: 'chart'}, canvas) as unknown as Chart;
  let last: {lines: Line[]; now: number}|null = null;
  const paint = () => {
    if (last) paintChart(canvas, last.lines, last.now);
  };
  new ResizeObserver(paint).observe(box);
  box.draw = (lines, now) => {
    last = {lines, now};
    canvas.setAttribute('aria-label', `${label}: ${inWords(lines)}`);
    paint();
  };
  return box;
}

function inWords(lines: Line[]): string {
  const known = lines.map((line) => {
    const value = [...line.points].reverse().find((point) => point[1] !== null);
    return value ? `${line.name} ${number(value[1])} °C` : '';
  });
  return known.filter(Boolean).join(', ') || t('unknown');
}

function paintChart(canvas: HTMLCanvasElement, lines: Line[], now: number): void {
  const brush = canvas.getContext('2d'), width = canvas.clientWidth, height = canvas.clientHeight;
  if (!brush || !width) return;
  const ratio = Math.min(2, devicePixelRatio || 1), style = getComputedStyle(canvas);
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  brush.scale(ratio, ratio);
  const values = lines.flatMap((line) => line.points.map((point) => point[1] ?? 0));
  const most = Math.max(100, Math.ceil((values.reduce((a, b) => Math.max(a, b), 0) + 10) / 50) * 50);
  const begin = now - spanOf(lines, now);
  const x = (time: number) => left + ((time - begin) / (now - begin)) * (width - left - 6);
  const y = (value: number) => height - bottom - (value / most) * (height - bottom - above);
  grid(brush, style, {width, height, most, y});
  hours(brush, {begin, now, height, x});
  for (const line of lines) trace(brush, style.getPropertyValue(line.colour) || style.color, line, x, y);
}

/** An hour, or less if less is known: ten minutes at least. */
function spanOf(lines: Line[], now: number): number {
  const first = lines.reduce((least, line) => Math.min(least, line.points[0]?.[0] ?? now), now);
  return Math.min(hour, Math.max(600, Math.ceil((now - first) / 300) * 300));
}

function grid(
    brush: CanvasRenderingContext2D, style: CSSStyleDeclaration,
    at: {width: number; height: number; most: number; y: (value: number) => number}): void {
  brush.font = `12px ${style.fontFamily}`;
  brush.textBaseline = 'middle';
  brush.textAlign = 'right';
  brush.lineWidth = 1;
  for (let value = 0; value <= at.most; value += at.most > 150 ? 100 : 50) {
    brush.strokeStyle = style.getPropertyValue('--rule');
    brush.beginPath();
    brush.moveTo(left, Math.round(at.y(value)) + 0.5);
    brush.lineTo(at.width, Math.round(at.y(value)) + 0.5);
    brush.stroke();
    brush.fillStyle = style.getPropertyValue('--soft');
    brush.fillText(number(value), left - 6, at.y(value));
  }
}

function hours(
    brush: CanvasRenderingContext2D,
    at: {begin: number; now: number; height: number; x: (time: number) => number}): void {
  brush.textAlign = 'center';
  brush.textBaseline = 'alphabetic';
  const span = at.now - at.begin, step = span > 2700 ? 900 : span > 1200 ? 600 : 300;
  const clock = new Intl.DateTimeFormat(language(), {hour: 'numeric', minute: '2-digit'});
  for (let time = Math.ceil(at.begin / step) * step; time < at.now; time += step)
    if (at.x(time) > left + 18 && at.x(time) < at.x(at.now) - 16)
      brush.fillText(clock.format(time * 1000), at.x(time), at.height - 4);
}

function trace(
    brush: CanvasRenderingContext2D, colour: string, line: Line, x: (time: number) => number,
    y: (value: number) => number): void {
  brush.strokeStyle = colour;
  brush.globalAlpha = line.dashed ? 0.55 : 1;
  brush.setLineDash(line.dashed ? [3, 4] : []);
  brush.lineWidth = line.dashed ? 1.5 : 2;
  brush.lineJoin = 'round';
  brush.beginPath();
  let before = -Infinity;  // when the last value was known, s
  for (const [time, value] of line.points) {
    if (value === null) continue;
    if (time - before < longestGap)
      brush.lineTo(x(time), y(value));
    else
      brush.moveTo(x(time), y(value));
    before = time;
  }
  brush.stroke();
  brush.setLineDash([]);
  brush.globalAlpha = 1;
}
