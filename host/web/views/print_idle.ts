// Print while nothing is printed: an interrupted print first, then what waits, with one button to begin; and
// how the last print ended.
import {api} from '../api';
import {ask, card, command, empty, missing} from '../controls';
import {fill, h, View} from '../dom';
import {live} from '../live';
import {printNow} from '../queue_data';
import type {Job} from '../types';
import {duration, moment, percent, plural, said, shortName, t, word} from '../words';
import {gramsOf, picture, pictureOf} from './job_parts';
import {rangeOf} from './queue';

export class PrintIdle extends View {
  private jobs: Job[]|null = null;  ///< null: not known yet
  private drawn = '';

  protected show(): void {
    const refresh = async () => {
      if (!live.ready) return;
      this.jobs = (await api.get<{jobs: Job[]}>('/api/jobs').catch(() => null))?.jobs ?? this.jobs;
      this.draw();
    };
    this.until(
        live.on('queue', () => void refresh()), live.on('up', () => void refresh()),
        live.on('status', () => this.draw()));
    this.draw();
    void refresh();
  }

  private draw(): void {
    const status = live.status;
    const waiting = this.jobs?.filter((job) => job.state === 'queued');
    const now = JSON.stringify(
        [status?.interrupted, status?.last?.job, status?.last?.print?.state, status?.problem, waiting]);
    if (now === this.drawn) return;
    this.drawn = now;
    fill(
        this, status?.problem ? h('p', {class: 'warning'}, said(status.problem)) : null,
        status?.interrupted ? this.interrupted() : null,
        ...(this.failed ? [this.last(), this.next(waiting)] : [this.next(waiting), this.last()]));
  }

  private get failed(): boolean {
    return (live.status?.last?.print?.state ?? live.status?.last?.job?.state) === 'failed';
  }

  private interrupted(): HTMLElement {
    const print = live.status?.interrupted;
    const resume =
        command({label: t('resume.continue'), icon: 'play', kind: 'main', run: () => this.resume()});
    return card(
        t('resume.title'), 'attention', h('p', {class: 'strong'}, shortName(print?.job)),
        h('p', {}, print?.question ?? t('resume.text')), h('div', {class: 'row'}, resume));
  }

  /**
   * Says what will happen, asks, and continues. A daemon that does not know how to say it continues at once.
   */
  private async resume(): Promise<void> {
    const print = live.status?.interrupted;
    if (!print) return;
    const path = '/api/prints/resume', name = print.print;  // a name may hold what an address cannot
    let will = print.question ?? '';
    if (!will) {
      const answer = await api.post<{will?: string}>(path, {name}).catch((error) => {
        if (missing(error)) return {will: ''};
        throw error;
      });
      will = answer.will ?? '';
    }
    if (will && await ask(t('resume.title'), will, [{label: t('resume.sure'), kind: 'main'}]) !== 0) return;
    if (will && !print.question)
      await api.post(path, {name, sure: true});
    else
      await api.post('/api/print/resume', print.question ? {sure: true} : {});
    await live.refresh();
  }

  private next(waiting: Job[]|undefined): HTMLElement|null {
    if (!waiting) return null;
    const job = waiting[0];
    if (!job)
      return card(
          t('idle.title'), 'next', empty(t('idle.none'), t('idle.none_text')),
          h('div', {class: 'row'}, h('a', {class: 'button main', href: '#/queue'}, t('idle.add'))));
    const start =
        command({label: t('idle.clear_print'), icon: 'play', kind: 'main big', run: () => printNow(job)});
    const facts = [
      job.seconds === undefined ? '' : duration(job.seconds), gramsOf(job), rangeOf(job.layers)
    ].filter(Boolean).join(' · ');
    const more = waiting.length > 1 ?
        h('a', {href: '#/queue', class: 'more'}, plural('idle.more', waiting.length - 1)) :
        null;
    const name = h('h3', {class: 'job', title: job.job}, shortName(job.job));
    return card(
        t('idle.next'), 'next', picture(pictureOf(job), job.job, 'large'),
        h('div', {class: 'stack'}, name, facts ? h('p', {class: 'soft'}, facts) : null,
          job.reason ? h('p', {class: 'warning'}, said(job.reason)) : null, h('div', {class: 'row'}, start),
          more));
  }

  private last(): HTMLElement|null {
    const last = live.status?.last;
    if (!last?.job) return null;
    const state = last.print?.state ?? last.job.state, ended = last.job.ended;
    const facts = [
      last.print?.percent === undefined || state === 'done' ? '' : percent(last.print.percent),
      ended ? moment(ended) : ''
    ];
    return card(
        t('idle.last'), 'last',
        h('div', {class: 'run-head'}, h('h3', {class: 'job', title: last.job.job}, shortName(last.job.job)),
          h('span', {class: `badge ${state}`}, word('state', state)),
          h('span', {class: 'soft'}, facts.filter(Boolean).join(' · '))),
        last.job.reason ? h('p', {class: 'prose'}, said(last.job.reason)) : null,
        h('a', {href: '#/history', class: 'more'}, t('idle.history')));
  }
}

customElements.define('print-idle', PrintIdle);
