// Dry runs: a job on the simulated printer. Tiles for each, and its own viewer behind a link.
import {api} from '../api';
import {ask, card, command, empty, labelFor, load} from '../controls';
import {Child, fill, h, View} from '../dom';
import {layerRange} from '../inputs';
import {live} from '../live';
import type {DryRun} from '../types';
import {duration, grams, moment, number, shortName, t, word} from '../words';
import {rangeOf} from './queue';

export class DryRunView extends View {
  private list!: HTMLElement;
  private drawn = '';

  protected show(): void {
    this.list = h('div', {class: 'runs'});
    this.append(
        h('h1', {class: 'unseen'}, t('page.dry-run')), card(t('dry.title'), 'dry', this.list),
        h('div', {class: 'side'}, this.starting()));
    this.until(live.on('up', () => this.refresh()));
    this.every(3000, () => {
      if (live.ready && !document.hidden && this.drawn.includes('"running"')) this.refresh();
    });
    this.refresh();
  }

  disconnectedCallback(): void {
    super.disconnectedCallback();
    this.drawn = '';
  }

  private refresh(): void {
    void load(this.list, () => api.get<{dry_runs: DryRun[]}>('/api/dry-runs'), (answer) => {
      const now = JSON.stringify(answer.dry_runs);
      if (now === this.drawn && this.list.childElementCount) return;
      this.drawn = now;
      fill(
          this.list,
          ...(answer.dry_runs.length ? answer.dry_runs.map((run) => this.run(run)) :
                                       [empty(t('dry.none'), t('dry.none_text'))]));
    });
  }

  private run(run: DryRun): HTMLElement {
    const link = `/api/dry-runs/${encodeURIComponent(run.id)}/index.html`;
    const remove = command({
      label: t('queue.remove') + ': ' + shortName(run.job),
      icon: 'trash',
      bare: true,
      kind: 'quiet',
      right: 'queue',
      run: async () => {
        if (await ask(
                t('dry.remove_title'), shortName(run.job), [{label: t('queue.remove'), kind: 'danger'}]) !==
            0)
          return;
        await api.remove(`/api/dry-runs/${encodeURIComponent(run.id)}`);
        this.refresh();
      }
    });
    const queue = command({
      label: t('dry.queue'),
      icon: 'plus',
      right: 'queue',
      run: async () => {
        await api.post('/api/jobs', {job: run.job});
        location.hash = '#/queue';
      }
    });
    const head =
        h('div', {class: 'run-head'}, h('h3', {class: 'job', title: run.job}, shortName(run.job)),
          h('span', {class: 'soft'}, [moment(run.made), rangeOf(run.layers)].filter(Boolean).join(' · ')),
          remove);
    if (run.state === 'running') {
      const bar =
          h('div', {
            class: 'bar',
            role: 'progressbar',
            'aria-label': t('dry.runs'),
            'aria-valuenow': run.percent === undefined ? undefined : Math.floor(run.percent)
          },
            h('i'));
      (bar.firstElementChild as HTMLElement).style.width = `${run.percent ?? 0}%`;
      return h('article', {class: 'run'}, head, h('p', {}, t('dry.runs')), bar);
    }
    if (run.state === 'failed')
      return h('article', {class: 'run'}, head, h('p', {class: 'warning'}, run.reason ?? t('state.failed')));
    return h(
        'article', {class: 'run'}, head, h('dl', {class: 'tiles'}, ...this.tiles(run)),
        h('div', {class: 'row'},
          h('a', {class: 'button main', href: link, target: '_blank', rel: 'noopener'}, t('dry.look')),
          queue));
  }

  private tiles(run: DryRun): HTMLElement[] {
    const tile = (name: string, value: Child, grade?: string) =>
        h('div', {class: `tile ${grade ?? ''}`}, h('dt', {}, name), h('dd', {}, value),
          grade ? h('span', {class: 'grade'}, word('grade', grade)) : null);
    const used = (run.filaments ?? []).filter((one) => one.grams !== undefined);
    const material = h('ul', {}, ...used.map((one) => h('li', {}, `${one.name ?? ''} ${grams(one.grams)}`)));
    const share = (value: number|undefined) => (value === undefined ? '–' : `${number(value, 2)} %`);
    const grades = run.grades ?? {};
    return [
      tile(t('dry.time'), duration(run.seconds), grades.time),
      tile(t('dry.material'), used.length ? material : '–', grades.material),
      tile(t('dry.gaps'), share(run.gaps_percent), grades.gaps),
      tile(t('dry.colour'), share(run.wrong_percent), grades.colours)
    ];
  }

  private starting(): HTMLElement {
    const jobs = h('select', {id: 'dry-job'}),
          layers = h('input', {id: 'dry-layers', placeholder: '1–5', autocomplete: 'off'});
    const refresh = async () => {
      const answer = await api.get<{jobs: string[]}>('/api/files').catch(() => null);
      if (answer) fill(jobs, ...answer.jobs.map((job) => h('option', {value: job}, job)));
      start.allow(!!answer?.jobs.length);
    };
    const start = command({
      label: t('dry.start'),
      icon: 'play',
      kind: 'main',
      right: 'queue',
      run: async () => {
        const range = layerRange(layers.value);
        await api.post('/api/dry-runs', range ? {job: jobs.value, layers: range} : {job: jobs.value});
        this.refresh();
      }
    });
    this.until(live.on('up', () => void refresh()));
    void refresh();
    return card(
        t('dry.start_title'), 'adding', h('p', {class: 'soft'}, t('dry.help')),
        labelFor('dry-job', t('queue.job')), jobs, labelFor('dry-layers', t('queue.layers')), layers,
        h('div', {class: 'row'}, start));
  }
}

customElements.define('dry-run-view', DryRunView);
