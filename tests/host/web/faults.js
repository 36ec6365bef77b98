// What a person with a keyboard, a screen reader, weak eyes or large fingers would stumble over in the page that is
// shown now. Run in the page; returns sentences. WCAG 2.2: 1.4.3, 1.4.10, 1.4.11, 2.5.8, 3.1.1, 4.1.2.
const faults = [];
const shown = (one) => one.checkVisibility({ visibilityProperty: true, opacityProperty: true }) && one.getClientRects().length > 0;
const unseen = (one) => {  // there for screen readers only
  const box = one.getBoundingClientRect();
  return box.width <= 1.5 || box.height <= 1.5;
};
const words = (one) => {
  const text = (one.getAttribute('aria-label') ?? one.innerText ?? '').trim().replace(/\s+/g, ' ').slice(0, 40);
  return `<${one.localName}${one.className && typeof one.className === 'string' ? '.' + one.className.trim().replace(/\s+/g, '.') : ''}> "${text}"`;
};

// ---- colours

/** [r, g, b, a] with a from 0 to 1, of what getComputedStyle gives. */
const canvas = new OffscreenCanvas(1, 1).getContext('2d', { willReadFrequently: true });
const known = new Map();
const rgba = (colour) => {
  if (known.has(colour)) return known.get(colour);
  const plain = /^rgba?\(([\d.]+), ([\d.]+), ([\d.]+)(?:, ([\d.]+))?\)$/.exec(colour);
  let value;
  if (plain) value = [+plain[1], +plain[2], +plain[3], plain[4] === undefined ? 1 : +plain[4]];
  else {
    canvas.clearRect(0, 0, 1, 1);
    canvas.fillStyle = colour;
    canvas.fillRect(0, 0, 1, 1);
    const [r, g, b, a] = canvas.getImageData(0, 0, 1, 1).data;
    value = [r, g, b, a / 255];
  }
  known.set(colour, value);
  return value;
};
const over = (top, below) => [0, 1, 2].map((n) => top[n] * top[3] + below[n] * (1 - top[3])).concat(1);
const light = (colour) => {
  const [r, g, b] = colour.map((value) => (value / 255 <= 0.04045 ? value / 255 / 12.92 : ((value / 255 + 0.055) / 1.055) ** 2.4));
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
};
const contrast = (one, other) => {
  const [more, less] = [light(one), light(other)].sort((a, b) => b - a);
  return (more + 0.05) / (less + 0.05);
};
/** What lies behind the content of an element. */
const behind = (one) => {
  const layers = [];
  for (let at = one; at; at = at.parentElement) {
    const style = getComputedStyle(at), colour = rgba(style.backgroundColor);
    if (colour[3] > 0) layers.push(colour);
    if (colour[3] === 1) break;
  }
  const page = matchMedia('(prefers-color-scheme: dark)').matches ? [0, 0, 0, 1] : [255, 255, 255, 1];
  return layers.reverse().reduce((below, top) => over(top, below), page);
};
const opacity = (one) => {
  let all = 1;
  for (let at = one; at; at = at.parentElement) all *= +getComputedStyle(at).opacity;
  return all;
};
const off = (one) => one.closest('[disabled], [aria-disabled=true], [aria-hidden=true]') !== null ||
  one.closest('label')?.control?.disabled;

const walk = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
while (walk.nextNode()) {
  const one = walk.currentNode.parentElement;
  if (!walk.currentNode.data.trim() || !shown(one) || unseen(one) || off(one) || ['SCRIPT', 'STYLE', 'OPTION', 'NOSCRIPT'].includes(one.tagName)) continue;
  const style = getComputedStyle(one), back = behind(one), ink = rgba(style.color);
  const ratio = contrast(over([ink[0], ink[1], ink[2], ink[3] * opacity(one)], back), back);
  const size = parseFloat(style.fontSize), large = size >= 24 || (size >= 18.66 && +style.fontWeight >= 700);
  if (ratio < (large ? 3 : 4.5) - 0.005) faults.push(`contrast ${ratio.toFixed(2)} of the text of ${words(one)}`);
}
for (const one of document.querySelectorAll('input:not([type=range], [type=file], [type=color]), select, textarea')) {
  if (!shown(one) || unseen(one) || off(one)) continue;
  const style = getComputedStyle(one), around = behind(one.parentElement);
  const best = Math.max(contrast(over(rgba(style.borderTopColor), around), around), contrast(behind(one), around));
  if (best < 2.995 && !['checkbox', 'radio'].includes(one.type)) faults.push(`contrast ${best.toFixed(2)} of the border of ${words(one)}`);
  if ('placeholder' in one && one.placeholder && !one.value) {
    const ink = rgba(getComputedStyle(one, '::placeholder').color), back = behind(one), ratio = contrast(over(ink, back), back);
    if (ratio < 4.495) faults.push(`contrast ${ratio.toFixed(2)} of the placeholder of ${words(one)}`);
  }
}

// ---- targets

const controls = 'a[href], button, input:not([type=hidden]), select, textarea, summary, [role=button], [role=slider], [tabindex="0"]';
for (const one of document.querySelectorAll(controls)) {
  if (!shown(one)) continue;
  const target = unseen(one) ? one.labels?.[0] : ['checkbox', 'radio'].includes(one.type) ? one.labels?.[0] ?? one : one;
  if (!target || unseen(target) || one.classList.contains('skip')) continue;
  const box = target.getBoundingClientRect();
  const inText = one.localName === 'a' && one.parentElement.localName === 'p' && one.parentElement.innerText.trim() !== one.innerText.trim();
  if (!inText && (box.width < 23.9 || box.height < 23.9)) faults.push(`target of ${box.width.toFixed(0)} × ${box.height.toFixed(0)} px: ${words(one)}`);
  const main = one.closest('nav') || one.matches('.main, .danger, .stop, [class~=button]:not(.quiet)');
  if (main && !inText && (box.height < 43.9 || box.width < 43.9)) faults.push(`main action of ${box.width.toFixed(0)} × ${box.height.toFixed(0)} px: ${words(one)}`);
}

// ---- the whole

if (document.documentElement.scrollWidth > innerWidth) {
  const wide = [...document.querySelectorAll('body *')].filter((one) => shown(one) && one.getBoundingClientRect().right > innerWidth + 0.5 &&
    !one.closest('.scroll, [role=tablist]')).slice(0, 3).map(words);
  faults.push(`the page is ${document.documentElement.scrollWidth} px wide, the screen ${innerWidth}: ${wide.join('; ')}`);
}
if (!document.documentElement.lang) faults.push('the language is not named');
if (!document.title.trim()) faults.push('there is no title');
if (document.querySelectorAll('main, [role=main]').length !== 1) faults.push('not exactly one main part');
if (document.querySelectorAll('h1').length !== 1) faults.push(`${document.querySelectorAll('h1').length} headings of the first rank`);
const ids = [...document.querySelectorAll('[id]')].map((one) => one.id);
for (const id of new Set(ids)) if (ids.filter((other) => other === id).length > 1) faults.push(`the id ${id} is used more than once`);
for (const one of document.querySelectorAll('img:not([alt])')) faults.push(`no alternative text: ${words(one)}`);
return [...new Set(faults)];
