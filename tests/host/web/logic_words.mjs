// The languages hold the same texts, and the page uses each of them.
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {join} from 'node:path';
import test from 'node:test';

import {sources, web} from './bundled.mjs';

const languages = ['en', 'de'].map((name) => JSON.parse(readFileSync(join(web, `${name}.json`), 'utf8')));
const [english, german] = languages;
const values = (text) => [...text.matchAll(/\{(\w+)\}/g)].map((found) => found[1]).sort();

test('every text is there in every language, with the same values', () => {
  assert.deepEqual(Object.keys(german), Object.keys(english));
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
