// When the connection counts as lost, how soon the page comes back, and how numbers, times and inputs are
// read.
import assert from 'node:assert/strict';
import test from 'node:test';

import {bundled} from './bundled.mjs';

const {BackOff} = await bundled('back_off');
const {Watchdog} = await bundled('watchdog');
const formats = await bundled('formats');
const inputs = await bundled('inputs');
const {laidOf} = await bundled('layers');

test('silence is asked about after 2 s and is a loss before 5 s', () => {
  const dog = new Watchdog(0);
  const verdicts = [1, 2, 3, 4, 4.5].map((second) => dog.tick(second * 1000));
  assert.deepEqual(verdicts, ['well', 'ask', 'ask', 'ask', 'lost']);
  dog.hear(5200);
  assert.equal(dog.tick(6000), 'well');
  assert.equal(dog.last, 5200);
});

test('a laptop that slept does not trust what it heard before', () => {
  const dog = new Watchdog(0);
  dog.hear(900);
  dog.tick(1000);
  assert.equal(dog.tick(3_600_000), 'slept');
  // A hidden page is woken once a minute only; events that came meanwhile count.
  dog.hear(3_659_500);
  assert.equal(dog.tick(3_660_000), 'well');
});

test('attempts come later and later, up to 12 s, and soon again after a success', () => {
  const wait = new BackOff(), waits = Array.from({length: 9}, () => wait.next(0.5));
  assert.deepEqual(waits, [500, 1000, 2000, 4000, 8000, 10_000, 10_000, 10_000, 10_000]);
  wait.reset();
  assert.equal(wait.next(0), 400);
  assert.equal(new BackOff().next(1), 600);
});

const words = (key, values) => `${key}:${Object.values(values).join(',')}`;

test('what is not known is never shown as 0', () => {
  for (const nothing of [undefined, null, NaN]) {
    assert.equal(formats.number('en', nothing), '–');
    assert.equal(formats.duration(nothing, words), '–');
    assert.equal(formats.moment('en', nothing), '–');
  }
  assert.equal(formats.percent('en', undefined), '–');
  assert.equal(formats.shares('en', undefined), '–');
  assert.equal(formats.number('en', 0), '0');
});

test('a little is not shown as nothing', () => {
  const metres = [0, 0.0004, 0.0042, 0.42, 0.994, 0.996, 12.345].map((one) => formats.metres('en', one));
  assert.deepEqual(metres, ['0 m', '< 1 mm', '4 mm', '420 mm', '994 mm', '1 m', '12.35 m']);
  const grams = [0, 0.01, 0.1, 2.34].map((one) => formats.grams('de', one));
  assert.deepEqual(grams, ['0 g', '< 0,1 g', '0,1 g', '2,3 g']);
  assert.equal(formats.grams('en', 0.3, 0), '< 1 g');
  assert.deepEqual([formats.metres('en', undefined), formats.grams('en', null)], ['–', '–']);
});

test('what the job asks of a heater is said if it is set to something else', () => {
  assert.equal(inputs.differingWish({target_c: 210, job_c: 210}), undefined);
  assert.equal(inputs.differingWish({target_c: 220, job_c: 210}), 210);
  assert.equal(inputs.differingWish({job_c: 60}), 60);
  assert.equal(inputs.differingWish({target_c: 60}), undefined);
  assert.equal(inputs.differingWish(undefined), undefined);
});

test('times have two units at most', () => {
  assert.equal(formats.duration(59.4, words), 'unit.s:59');
  assert.equal(formats.duration(59.6, words), 'unit.min:1');
  assert.equal(formats.duration(3599, words), 'unit.h_min:1,00');
  assert.equal(formats.duration(2 * 3600 + 5 * 60, words), 'unit.h_min:2,05');
  assert.equal(formats.duration(50 * 3600, words), 'unit.d_h:2,2');
});

test('per cent are not rounded up: a print at 99.9 is not done', () => {
  assert.equal(formats.percent('en', 99.9), '99 %');
  assert.equal(formats.shares('de', [0.8, 0, 0.2]), '80 · 0 · 20 %');
  assert.equal(formats.number('de', 1234.56, 1), '1.234,6');
});

test('only colours are taken as colours', () => {
  assert.equal(formats.colour('#2660c4'), '#2660c4');
  for (const text of ['red', '#26', 'url(//evil.example)', '#2660c4;', undefined])
    assert.equal(formats.colour(text), '');
  assert.equal(formats.shortName('upload:lamp/shade.3mf'), 'shade.3mf');
});

test('layers are typed from 1 and sent from 0', () => {
  assert.equal(inputs.layerRange('  '), null);
  assert.deepEqual(inputs.layerRange('3'), [2, 2]);
  assert.deepEqual(inputs.layerRange('1–5'), [0, 4]);
  assert.deepEqual(inputs.layerRange('2:4'), [1, 3]);
  for (const wrong of ['0', '5-2', 'all', '1-2-3', '-1'])
    assert.throws(() => inputs.layerRange(wrong), Error, wrong);
});

test('names of uploads are those that the daemon takes', () => {
  assert.equal(inputs.plainName('Lampenschirm groß (2).3mf'), 'Lampenschirm-gro-2-.3mf');
  assert.equal(inputs.plainName('../../etc/passwd'), 'etc-passwd');
  assert.equal(inputs.plainName('花'), 'file');
  assert.ok(inputs.plainName('x'.repeat(300) + '.gcode').endsWith('.gcode'));
});

test('preheat sets are read a line each', () => {
  assert.deepEqual(
      inputs.presetsOf('PLA 210 60\n\nPETG black: 240/80'),
      [{name: 'PLA', nozzle_c: 210, bed_c: 60}, {name: 'PETG black', nozzle_c: 240, bed_c: 80}]);
  assert.throws(() => inputs.presetsOf('PLA'));
});

test('layers below the nozzle are laid, those above are not', () => {
  assert.equal(laidOf(2, {layer: 3, bead: 10}, 50), 50);
  assert.equal(laidOf(3, {layer: 3, bead: 10}, 50), 10);
  assert.equal(laidOf(3, {layer: 3, bead: 90}, 50), 50);
  assert.equal(laidOf(4, {layer: 3, bead: 10}, 50), 0);
  assert.equal(laidOf(0, null, 50), 0);
  assert.equal(laidOf(0, {bead: 0}, 50), 0, 'before the first layer');
});
