// Parts that several pages show of a job: its picture, and what it takes.
import {h} from '../dom';
import type {Job} from '../types';
import {number, shortName} from '../words';

/** A picture of the job, or a plain square if the daemon has none. */
export function picture(
    id: number|string, name: string, size: 'small'|'large', base = '/api/jobs'): HTMLElement {
  const image = h('img', {src: `${base}/${id}/picture`, alt: '', loading: 'lazy', decoding: 'async'});
  const box = h('span', {class: `picture ${size}`}, image);
  image.addEventListener('error', () => {
    image.remove();
    box.classList.add('none');
    box.textContent = shortName(name).slice(0, 1).toUpperCase();
    box.setAttribute('aria-hidden', 'true');
  });
  return box;
}

export function gramsOf(job: Job): string {
  const grams = job.grams?.filter((one) => one.grams > 0) ?? [];
  return grams.map((one) => `${one.name} ${number(one.grams, one.grams < 10 ? 1 : 0)} g`).join(' · ');
}
