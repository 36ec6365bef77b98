// Queue and files: what waits, in its order; and what can be added, from this device or the daemon's folders.
import {access, api, Sent} from '../api';
import {ask, card, command, complain, empty, labelFor, say} from '../controls';
import {fill, fillList, h, icon, setHidden, setText, View} from '../dom';
import {layerRange} from '../inputs';
import {live} from '../live';
import {printNow, upload, uploadSliced} from '../queue_data';

import type {Job} from '../types';
import {duration, number, percent, plural, said, shortName, t} from '../words';
import {gramsOf, picture, pictureOf} from './job_parts';

interface Row extends HTMLElement {
  draw(job: Job, first: boolean, last: boolean): void
}

export class QueueView extends View {
  private jobs: Job[] = [];
  private known = false;
  private list!: HTMLElement;
  private none!: HTMLElement;
  private total!: HTMLElement;
  private dragged = 0;

  protected show(): void {
    this.list = h('ol', {class: 'rows', 'aria-label': t('queue.title')});
    this.none = empty(t('queue.none'), t('queue.none_text'));
    this.total = h('p', {class: 'soft'});
    const waiting = card(t('queue.title'), 'waiting', this.total, this.list, this.none);
    this.append(
        h('h1', {class: 'unseen'}, t('page.queue')), waiting,
        h('div', {class: 'side'}, this.dropping(), this.adding()));
    this.until(live.on('queue', () => void this.refresh()), live.on('up', () => void this.refresh()));
    this.draw();
    void this.refresh();
  }

  private async refresh(): Promise<void> {
    if (!live.ready) return;
    const answer = await api.get<{jobs: Job[]}>('/api/jobs').catch(() => null);
    if (!answer) return;
    this.jobs = answer.jobs;
    this.known = true;
    this.draw();
  }

  private get waiting(): Job[] {
    return this.jobs.filter((job) => job.state === 'queued');
  }

  private draw(): void {
    const waiting = this.waiting;
    fillList(
        this.list, waiting, (job) => job.id, (job) => this.row(job),
        (row, job) => row.draw(job, job === waiting[0], job === waiting[waiting.length - 1]));
    setHidden(this.none, waiting.length > 0 || !this.known);
    setHidden(this.list, waiting.length === 0);
    const known = waiting.filter((job) => job.seconds !== undefined);
    const time = known.length === waiting.length ?
        duration(known.reduce((sum, job) => sum + (job.seconds ?? 0), 0)) :
        '';
    setText(
        this.total,
        waiting.length ? [plural('queue.jobs', waiting.length), time].filter(Boolean).join(' · ') : '');
  }

  private row(job: Job): Row {
    const name = h('h3', {class: 'job'}), facts = h('p', {class: 'soft'}),
          reason = h('p', {class: 'warning'});
    const id = job.id;
    let shown = pictureOf(job), image = picture(shown, job.job, 'small');
    const bare = (label: string, drawing: string, run: () => Promise<unknown>) => command({
      label: `${label}: ${shortName(job.job)}`,
      icon: drawing,
      bare: true,
      kind: 'quiet',
      right: 'queue',
      run
    });
    const up = bare(t('queue.up'), 'up', () => this.moveJob(id, -1)),
          down = bare(t('queue.down'), 'down', () => this.moveJob(id, 1));
    const copy = bare(t('queue.copy'), 'copy', async () => {
      await api.post(`/api/jobs/${id}/copy`);
      await this.refresh();
    });
    const remove = bare(t('queue.remove'), 'trash', async () => {
      if (await ask(
              t('queue.remove_title'), t('queue.remove_text', {job: shortName(job.job)}),
              [{label: t('queue.remove'), kind: 'danger'}]) !== 0)
        return;
      await api.remove(`/api/jobs/${id}`);
      await this.refresh();
    });
    const start = command({
      label: t('idle.clear_print'),
      icon: 'play',
      kind: 'main',
      run: () => printNow({id, job: job.job, state: 'queued'})
    });
    const row = h('li', {
                  draggable: true,
                  dragstart: (event: DragEvent) => this.lift(id, event),
                  dragover: (event: DragEvent) => this.over(event),
                  drop: (event: DragEvent) => this.drop(id, event)
                },
                  image, h('div', {class: 'stack'}, name, facts, reason),
                  h('div', {class: 'tools'}, up, down, copy, remove), start) as unknown as Row;
    row.draw = (now, first, last) => {
      if (pictureOf(now) !== shown) {
        const better = picture(shown = pictureOf(now), now.job, 'small');
        image.replaceWith(better);
        image = better;
      }
      setText(name, shortName(now.job));
      name.title = now.job;
      const layers = rangeOf(now.layers);
      setText(facts, [
        now.seconds === undefined ? '' : duration(now.seconds), gramsOf(now), layers
      ].filter(Boolean).join(' · '));
      setText(reason, said(now.reason));
      setHidden(reason, !now.reason);
      up.allow(!first);
      down.allow(!last);
      setHidden(start, !first || live.busy);
    };
    return row;
  }

  // ---- order

  private async moveJob(id: number, by: number): Promise<void> {
    const ids = this.waiting.map((job) => job.id), from = ids.indexOf(id), to = from + by;
    if (from < 0 || to < 0 || to >= ids.length) return;
    ids.splice(to, 0, ...ids.splice(from, 1));
    await this.order(ids);
  }

  private async order(ids: number[]): Promise<void> {
    await api.put('/api/jobs/order', {ids});
    await this.refresh();
  }

  private lift(id: number, event: DragEvent): void {
    this.dragged = id;
    if (event.dataTransfer) event.dataTransfer.effectAllowed = 'move';
    event.dataTransfer?.setData('text/plain', String(id));
  }

  private over(event: DragEvent): void {
    if (this.dragged) event.preventDefault();
  }

  private drop(before: number, event: DragEvent): void {
    if (!this.dragged) return;
    event.preventDefault();
    event.stopPropagation();
    const ids = this.waiting.map((job) => job.id), from = ids.indexOf(this.dragged), to = ids.indexOf(before);
    this.dragged = 0;
    if (from < 0 || to < 0 || from === to) return;
    ids.splice(to, 0, ...ids.splice(from, 1));
    this.order(ids).catch(complain);
  }

  // ---- adding

  private dropping(): HTMLElement {
    const choose = h('input', {
      type: 'file',
      multiple: true,
      class: 'unseen',
      id: 'files',
      accept: '.toml,.svg,.stl,.3mf,.obj,.amf,.gcode,.gco,.g',
      change: () => {
        void this.send([...(choose.files ?? [])], area);
        choose.value = '';
      }
    });
    const area: HTMLElement =
        h('div', {
          class: 'drop',
          dragover: (event: DragEvent) => {
            event.preventDefault();
            area.classList.add('over');
          },
          dragleave: () => area.classList.remove('over'),
          drop: (event: DragEvent) => {
            event.preventDefault();
            area.classList.remove('over');
            if (!choose.disabled) void this.send([...(event.dataTransfer?.files ?? [])], area);
          }
        },
          icon('upload'), h('p', {role: 'status'}, t('files.drop')),
          h('progress', {max: 100, value: 0, hidden: true, 'aria-label': t('files.progress')}),
          h('p', {class: 'soft', hidden: true, 'aria-hidden': 'true'}), choose,
          labelFor('files', t('files.choose'), 'button'));
    const allow = () => {
      choose.disabled = !live.ready || !access.may('queue');
    };
    this.until(live.on('link', allow), live.on('up', allow));
    allow();
    return card(t('files.title'), 'files', area, h('p', {class: 'soft'}, t('files.help')));
  }

  private async send(files: File[], area: HTMLElement): Promise<void> {
    if (!files.length) return;
    const sending = new Sending(area, files);
    try {
      const sliced = files.filter((file) => /\.(gcode|gco|g)$/i.test(file.name)),
            others = files.filter((file) => !sliced.includes(file));
      const queued = sliced.map((file) => file.name);
      for (const file of sliced) await uploadSliced(file, sending.begin([file]));
      if (others.length) {
        const sent = await upload(others, sending.begin(others)),
              known = (await api.get<{jobs: string[]}>('/api/files')).jobs;
        const jobs = sent.filter((job) => known.includes(job)),  // not a profile, which is TOML as well
            tomls = jobs.filter((job) => job.endsWith('.toml'));
        for (const job of tomls.length ? tomls : jobs.length ? jobs : sent) {
          await api.post('/api/jobs', {job});
          queued.push(shortName(job));
        }
      }
      say(t('files.done', {name: queued.join(', ')}));
    } catch (error) {
      complain(error);
    }
    sending.end();
    await this.refresh();
  }

  private adding(): HTMLElement {
    const jobs = h('select', {id: 'job'}),
          layers = h('input', {id: 'layers', placeholder: '1–5', inputmode: 'text', autocomplete: 'off'});
    const refresh = async () => {
      const answer = await api.get<{jobs: string[]}>('/api/files').catch(() => null);
      if (!answer) return;
      const chosen = jobs.value;
      fill(jobs, ...answer.jobs.map((job) => h('option', {value: job}, job)));
      if (answer.jobs.includes(chosen)) jobs.value = chosen;
      add.allow(answer.jobs.length > 0);
    };
    const add = command({
      label: t('queue.add'),
      icon: 'plus',
      right: 'queue',
      kind: 'main',
      run: async () => {
        const range = layerRange(layers.value);
        await api.post('/api/jobs', range ? {job: jobs.value, layers: range} : {job: jobs.value});
        await this.refresh();
      }
    });
    this.until(live.on('up', () => void refresh()), live.on('queue', () => void refresh()));
    void refresh();
    return card(
        t('queue.add_title'), 'adding', labelFor('job', t('queue.job')), jobs,
        labelFor('layers', t('queue.layers')), layers, h('p', {class: 'soft'}, t('queue.layers_help')),
        h('div', {class: 'row'}, add));
  }
}

/** What is said of files on their way: how much of all has left this device, and that the rest takes time. */
class Sending {
  private readonly words: Element;
  private readonly bar: HTMLProgressElement;
  private readonly share: HTMLElement;
  private readonly all: number;
  private before = 0;

  constructor(area: HTMLElement, files: File[]) {
    this.words = area.querySelector('p') as Element;
    this.bar = area.querySelector('progress') as HTMLProgressElement;
    this.share = this.bar.nextElementSibling as HTMLElement;
    this.all = files.reduce((sum, file) => sum + file.size, 0);
  }

  /** The next ones. Returns who is to hear how many of their bytes were sent. */
  begin(files: File[]): Sent {
    const before = this.before, size = files.reduce((sum, file) => sum + file.size, 0), {name} = files[0];
    this.before += size;
    const show = (bytes: number) => {
      const done = this.all ? Math.floor(((before + Math.min(bytes, size)) / this.all) * 100) : 100;
      setText(this.words, t(bytes < size ? 'files.sending' : 'files.checking', {name}));
      this.bar.value = done;
      setText(this.share, percent(done));
      for (const one of [this.bar, this.share]) setHidden(one, false);
    };
    show(0);
    return show;
  }

  end(): void {
    for (const one of [this.bar, this.share]) setHidden(one, true);
    setText(this.words, t('files.drop'));
  }
}

export function rangeOf(layers: Job['layers']): string {
  if (!Array.isArray(layers)) return '';
  const first = number(layers[0] + 1), last = number(layers[1] + 1);
  return first === last ? t('queue.layer_only', {layer: first}) : t('queue.layers_of', {first, last});
}

customElements.define('queue-view', QueueView);
