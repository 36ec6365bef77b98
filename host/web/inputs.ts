// What people type and choose, made into what the daemon takes.
import type {Preferences} from './types';
import {t} from './words';

/** "2-5" or "3" as people count, from 1; nothing: all. Throws what to write instead. */
export function layerRange(text: string): [number, number]|null {
  if (!text.trim()) return null;
  const found = /^\s*(\d+)\s*(?:[-–:]\s*(\d+))?\s*$/.exec(text);
  const first = found ? Number(found[1]) : 0, last = found?.[2] ? Number(found[2]) : first;
  if (!found || first < 1 || last < first) throw new Error(t('queue.layers_wrong'));
  return [first - 1, last - 1];
}

/** A name that an upload's folder may have: letters, digits, dots, dashes and underscores. */
export function plainName(name: string): string {
  const plain = name.normalize('NFKD').replace(/[^A-Za-z0-9._-]+/g, '-').replace(/^[-.]+/, '').slice(-80);
  return plain || 'file';
}

/** A line each: name, nozzle and bed in °C. Throws what to write instead. */
export function presetsOf(text: string): NonNullable<Preferences['presets']> {
  return text.split('\n').filter((line) => line.trim()).map((line) => {
    const found = /^\s*(.+?)[\s,:;]+(\d+)[\s,/]+(\d+)\s*$/.exec(line);
    if (!found) throw new Error(t('settings.presets_wrong', {line}));
    return {name: found[1], nozzle_c: Number(found[2]), bed_c: Number(found[3])};
  });
}

/** What the job asks of a heater, if that is known and is not the present target. */
export function differingWish(heater: {target_c?: number; job_c?: number}|undefined): number|undefined {
  const wish = heater?.job_c;
  return wish === undefined || Math.abs(wish - (heater?.target_c ?? NaN)) < 0.5 ? undefined : wish;
}
