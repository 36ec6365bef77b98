// The languages hold the same texts, and the page uses each of them.
import assert from 'node:assert/strict';
import {readdirSync, readFileSync} from 'node:fs';
import {join} from 'node:path';
import test from 'node:test';

import {bundled, sources, web} from './bundled.mjs';

const languages = ['en', 'de'].map((name) => JSON.parse(readFileSync(join(web, `${name}.json`), 'utf8')));
const [english, german] = languages;
/** What the daemon says in English itself is there in other languages only, by its code or word. */
const ofDaemon = (key) => /^(refused|doing|said)\./.test(key);
const values = (text) => [...text.matchAll(/\{(\w+)\}/g)].map((found) => found[1]).sort();

test('every text is there in every language, with the same values', () => {
  assert.deepEqual(Object.keys(german).filter((key) => !ofDaemon(key)), Object.keys(english));
  for (const key of Object.keys(english)) {
    assert.deepEqual(values(german[key]), values(english[key]), key);
    assert.notEqual(german[key].trim(), '', key);
  }
});

test('no text is missing, and none is left over', () => {
  const used = new Set(), groups = new Set();
  for (const [name, text] of sources()) {
    if (name.startsWith('viewer')) continue;  // has its words with it
    for (const [, key] of text.matchAll(/'([a-z][a-z_-]*(?:\.[a-z_]+)*)'/g)) used.add(key);
    for (const [, group] of text.matchAll(/\bt\(`([a-z.]+)\.\$\{/g)) groups.add(group);
    for (const [, group] of text.matchAll(/\b(?:word|plural)\('([a-z.]+)'/g)) groups.add(group);
    for (const [, key] of text.matchAll(/\bt\(\s*'([^']+)'/g))
      assert.ok(key in english, `${name} uses ${key}`);
  }
  const inGroup = (key) => [...groups].some((group) => key.startsWith(group + '.'));
  assert.deepEqual(Object.keys(english).filter((key) => !used.has(key) && !inGroup(key)), []);
  for (const group of groups)
    assert.ok(Object.keys(english).some((key) => key.startsWith(group + '.')), `${group} is empty`);
});

test('every refusal that is translated is one that the daemon knows', () => {
  const described = readFileSync(join(web, '..', 'daemon', 'API.md'), 'utf8');
  const codes = Object.keys(german).filter((key) => key.startsWith('refused.')).map((key) => key.slice(8));
  assert.ok(codes.length > 20);
  for (const code of codes) assert.ok(described.includes(`\`${code}\``), code);
});

test('every sentence that is translated is one that the daemon says', () => {
  const folder = join(web, '..'), rooms = ['engine', 'daemon', 'idle'];
  const files = rooms.flatMap((room) => readdirSync(join(folder, room)).map((name) => join(folder, room, name)));
  const texts = files.filter((name) => /\.[ch]pp$/.test(name)).map((name) => readFileSync(name, 'utf8'));
  const all = texts.join('\n').replace(/"\s*\n\s*"/g, '').replace(/\{[^{}\s]*\}/g, '{}');
  for (const key of Object.keys(german).filter((one) => one.startsWith('said.')))
    assert.ok(all.includes(`"${key.slice(5)}"`), key);
});

test('a sentence with values is said in German, with the values of the daemon', async () => {
  globalThis.fetch = async (path) => ({json: async () => (path.includes('de.json') ? german : english)});
  globalThis.document = {documentElement: {}};
  Object.defineProperty(globalThis, 'navigator', {value: {languages: ['de-CH', 'en']}, configurable: true});
  const {said, speak} = await bundled('words');
  const heat = "a nozzle of 300.5 °C is beyond the profile's limits: choose 0 to 260 °C";
  await speak('en');
  assert.equal(said(heat), heat);
  await speak('de');
  assert.match(said(heat), /^300[.,]5 °C an der Düse .* 0 bis 260 °C$/);
  assert.equal(said('x would be -12 mm, beyond 0 to 200 mm of the bed'), 'x wäre -12 mm, außerhalb der 0 bis 200 mm des Betts');
  assert.equal(said('it is paused already'), 'er ist schon angehalten');
  for (const other of ['x would be', 'x would be 1 mm, beyond 0 to 2 mm of the bed, or so', '', '{} would be']) assert.equal(said(other), other);
  assert.equal(said(undefined), '');
});
