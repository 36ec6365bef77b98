// Parts that several pages show of a job: its picture, and what it takes.
import {h} from '../dom';
import type {Job} from '../types';
import {grams, shortName} from '../words';

/** A picture, or the first letter of the name if there is none. `address`: empty: none. */
export function picture(address: string, name: string, size: 'small'|'large'): HTMLElement {
  const box = h('span', {class: `picture ${size}`});
  const letter = () => {
    box.classList.add('none');
    box.textContent = shortName(name).slice(0, 1).toUpperCase();
    box.setAttribute('aria-hidden', 'true');
  };
  if (address)
    box.append(h('img', {src: address, alt: '', loading: 'lazy', decoding: 'async', error: letter}));
  else
    letter();
  return box;
}

/** The address of a job's picture; empty while the daemon has not made one. */
export function pictureOf(job: Job): string {
  return job.grams || job.seconds !== undefined ? `/api/jobs/${job.id}/picture` : '';
}

export function gramsOf(job: Job): string {
  const used = job.grams?.filter((one) => one.grams > 0) ?? [];
  return used.map((one) => `${one.name} ${grams(one.grams, one.grams < 10 ? 1 : 0)}`).join(' · ');
}
