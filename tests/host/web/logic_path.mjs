// A layer's binary path, as host/daemon/API.md describes it, and how its beads are painted.
import assert from 'node:assert/strict';
import test from 'node:test';

import {bundled} from './bundled.mjs';

const {decodeChunk, LayerPath} = await bundled('path');
const paint = await bundled('curve_paint');

/** `beads`: [dx, dy in 10 µm, width in 20 µm, asked, r, g, b]. */
function bytes({layer = 3, first = 0, revision = 0, at = [12_340, -5_000], top = 0.8, flags = 0, beads}) {
  const buffer = Buffer.alloc(32 + 9 * beads.length);
  buffer.write('UCL1', 'latin1');
  [layer, first, beads.length].forEach((value, n) => buffer.writeUInt32LE(value, 4 + 4 * n));
  buffer.writeInt32LE(at[0], 16);
  buffer.writeInt32LE(at[1], 20);
  buffer.writeFloatLE(top, 24);
  buffer[28] = flags;
  buffer[29] = revision;
  beads.forEach(([dx, dy, ...rest], n) => {
    buffer.writeInt16LE(dx, 32 + 9 * n);
    buffer.writeInt16LE(dy, 34 + 9 * n);
    buffer.set(rest, 36 + 9 * n);
  });
  return buffer.buffer.slice(buffer.byteOffset, buffer.byteOffset + buffer.length);
}

const close = (value, wanted) => assert.ok(Math.abs(value - wanted) < 1e-4, `${value} is not ${wanted}`);

test('a layer begins where its head says, and each bead leads on', () => {
  const path = new LayerPath(3);
  const chunk = decodeChunk(
      bytes({beads: [[100, -50, 40, 1, 0x12, 0x34, 0x56], [-300, 0, 0, 255, 0, 0, 0]], flags: 1}));
  assert.ok(path.add(chunk));
  close(path.x[0], 12.34);
  close(path.y[0], -5);
  close(path.x[1], 13.34);
  close(path.y[1], -5.5);
  close(path.x[2], 10.34);
  close(path.top, 0.8);
  assert.equal(path.colour[0], 0x123456);
  assert.deepEqual([path.count, path.complete, path.planned], [2, true, false]);
  // The travel to x = 10.34 lays nothing, so the drawing does not reach there; half the bead of 0.8 mm does.
  close(path.bounds[0], 12.34 - 0.4);
  close(path.bounds[2], 13.34 + 0.4);
});

test('the line that primes the nozzle does not make the part small', () => {
  const path = new LayerPath(0), far = [30_000, 0, 40, 255, 1, 1, 1];
  const part = [100, 100, 40, 0, 1, 1, 1], travel = [0, 9000, 0, 255, 0, 0, 0];
  path.add(decodeChunk(
      bytes({layer: 0, at: [0, 0], beads: [far, [...far.slice(0, 3), 0, 1, 1, 1], travel, part]})));
  close(path.bounds[0], 600 - 0.4);
  close(path.bounds[1], 90 - 0.4);
  close(path.bounds[3], 91 + 0.4);
});

test('a layer grows by what follows, and refuses what does not', () => {
  const path = new LayerPath(3), bead = [10, 0, 40, 0, 9, 9, 9];
  assert.ok(path.add(decodeChunk(bytes({beads: [bead, bead]}))));
  assert.ok(!path.add(decodeChunk(bytes({first: 5, beads: [bead]}))), 'a gap');
  assert.ok(!path.add(decodeChunk(bytes({layer: 4, beads: [bead]}))), 'another layer');
  assert.equal(path.count, 2);
  assert.ok(
      path.add(decodeChunk(bytes({first: 2, at: [12_540, -5_000], beads: [bead, bead, bead], flags: 1}))));
  assert.equal(path.count, 5);
  close(path.x[5], 12.84);
  assert.ok(!path.add(decodeChunk(bytes({first: 5, revision: 1, beads: [bead]}))), 'computed again');
  assert.ok(path.add(decodeChunk(bytes({revision: 1, beads: [bead]}))), 'all over again');
  assert.equal(path.count, 1);
  close(path.bounds[2], 12.44 + 0.4);
});

test('bytes that are not a layer, or are cut off, are refused', () => {
  const good = bytes({beads: [[1, 1, 40, 0, 0, 0, 0]]});
  assert.throws(() => decodeChunk(good.slice(0, 40)), RangeError);
  assert.throws(() => decodeChunk(good.slice(0, 20)), RangeError);
  assert.throws(
      () => decodeChunk(new TextEncoder().encode('{"version":1,"error":"a sentence of some length"}').buffer),
      RangeError);
});

/** Paints a path and returns its strokes: colour, width and points. */
function strokes(beads, {
  frame = {
    scale: 10,
    left: 0,
    top: 0
  },
  size = {
    width: 1000,
    height: 1000
  },
  most = 1000
} = {}) {
  const path = new LayerPath(0);
  path.add(decodeChunk(bytes({layer: 0, at: [1000, -1000], beads})));
  const all = [];
  let points = [];
  const brush = {
    lineWidth: 0,
    strokeStyle: '',
    beginPath: () => {
      points = [];
    },
    moveTo: (x, y) => points.push(['to', x, y]),
    lineTo: (x, y) => points.push([x, y]),
    stroke() {
      all.push({colour: this.strokeStyle, width: this.lineWidth, points});
    }
  };
  let at = 0, rounds = 0;
  while (at < path.count && rounds++ < 100)
    at = paint.paintStroke(brush, path, at, path.count, frame, size, (colour) => colour, most);
  assert.equal(at, path.count, 'all beads are painted');
  return all;
}

const blue = [0x20, 0x40, 0xc0], red = [0xd0, 0x30, 0x20];

test('beads of one colour are one stroke; another colour, another width and a travel begin a new one', () => {
  const found = strokes([
    [100, 0, 40, 0, ...blue], [100, 0, 40, 0, ...blue], [100, 0, 40, 0, ...red], [0, 100, 80, 0, ...red],
    [0, 100, 0, 255, 0, 0, 0], [100, 0, 80, 0, ...red]
  ]);
  assert.deepEqual(found.map((one) => one.points.length), [3, 2, 2, 2]);
  assert.notEqual(found[0].colour, found[1].colour);
  assert.ok(found[2].width > found[1].width);
  assert.deepEqual(found[0].points, [['to', 10, 10], [20, 10], [30, 10]]);
  assert.deepEqual(found[3].points[0], ['to', 40, -10], 'behind the travel');
});

test('points that are closer than a pixel are left out, but the last is there', () => {
  const found = strokes(Array.from({length: 50}, () => [2, 0, 40, 0, ...blue]));  // 0.2 px each
  assert.equal(found.length, 1);
  assert.ok(found[0].points.length < 15, `${found[0].points.length} points`);
  close(found[0].points.at(-1)[0], 20);
});

test('what lies outside of the canvas is not painted', () => {
  const beads = Array.from({length: 20}, () => [1000, 0, 40, 0, ...blue]);  // 100 px each, to the right
  const found = strokes(beads, {size: {width: 150, height: 150}});
  assert.equal(found.length, 1);
  assert.ok(found[0].points.length <= 4, `${found[0].points.length} points`);
});

test('the ground lets every colour be seen', () => {
  assert.equal(paint.groundFor([0x2660c4, 0xd63430], false), 0xf3f3ef);
  assert.equal(paint.groundFor([0x2660c4, 0xd63430], true), 0x131716);
  assert.ok(paint.luminance(paint.groundFor([0xf6f0e2], false)) < 0.3, 'white filament on a light theme');
  assert.ok(paint.luminance(paint.groundFor([0x101010], true)) > 0.05, 'black filament on a dark theme');
});

test('a layer fits into the canvas with its margin', () => {
  const frame = paint.fitting([10, 20, 110, 70], {width: 440, height: 400}, 20, 80);
  close(frame.scale, 4);
  close(10 * frame.scale + frame.left, 20);
  close((frame.top - 70 * frame.scale + frame.top - 20 * frame.scale) / 2, 170);  // the middle of 20 … 320
});
