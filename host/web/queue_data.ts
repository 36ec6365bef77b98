// What the Print and the Queue page do with waiting jobs.
import {api, Sent} from './api';
import {ask} from './controls';
import {plainName} from './inputs';
import {live} from './live';
import type {Job} from './types';
import {t} from './words';

/**
 * Begins a job; the person has said that the bed is clear. Asks again if an interrupted print may stand on
 * it.
 */
export async function printNow(job: Job): Promise<void> {
  if (live.status?.interrupted) {
    const sure =
        await ask(t('idle.clear_title'), t('idle.clear_text'), [{label: t('idle.clear_yes'), kind: 'main'}]);
    if (sure !== 0) return;
    await api.post('/api/print/start', {id: job.id, bed_clear: true});
  } else {
    await api.post('/api/print/start', {id: job.id});
  }
  await live.refresh();
}

/** Uploads files that belong together into one folder, and returns the jobs' names, in their order. */
export async function upload(files: File[], sent: Sent): Promise<string[]> {
  const folder = plainName(files[0].name.replace(/\.[^.]*$/, '')) + '-' + Date.now().toString(36);
  const jobs: string[] = [];
  let before = 0;
  for (const file of files) {
    let body: Blob = file;
    if (/\.toml$/i.test(file.name)) {  // it names the others as they were called
      const text = await file.text();
      body = new Blob([files.reduce((all, one) => all.split(one.name).join(plainName(one.name)), text)]);
    }
    const answer = await api.upload<{job: string}>(
        `/api/files/${folder}/${plainName(file.name)}`, body,
        (bytes) => sent(before + Math.min(bytes, file.size)));
    before += file.size;
    jobs.push(answer.job);
  }
  return jobs;
}

/** Large G-code goes as a form, which the daemon writes to the disk as it comes. */
export async function uploadSliced(file: File, sent: Sent): Promise<void> {
  const form = new FormData();
  form.append('print', 'true');
  form.append('file', file, plainName(file.name));
  await api.form('/api/files/local', form, (bytes) => sent(Math.min(bytes, file.size)));
}
