// History: each print with what was foretold and what it took, and the sums.
import {access, api} from '../api';
import {ask, card, command, complain, empty, load, swatchOf} from '../controls';
import {fill, h, View} from '../dom';
import {live} from '../live';
import type {History, PastPrint, UsedFilament} from '../types';
import {duration, grams, language, metres, moment, number, said, shortName, t, word} from '../words';
import {picture} from './job_parts';

const atOnce = 30;

export class HistoryView extends View {
  private list!: HTMLElement;
  private prints: PastPrint[] = [];
  private more!: HTMLElement;
  private totals!: HTMLElement;

  protected show(): void {
    this.list = h('div', {class: 'past'});
    this.totals = h('div', {class: 'totals'});
    this.more =
        h('button', {
          type: 'button',
          class: 'button',
          hidden: true,
          click: () => this.refresh(this.prints[this.prints.length - 1]?.id)
        },
          t('history.more'));
    this.append(
        h('h1', {class: 'unseen'}, t('page.history')),
        card(t('history.title'), 'history', this.list, this.more),
        h('div', {class: 'side'},
          card(
              t('history.totals'), '', this.totals,
              h('div', {class: 'row'},
                h('a', {class: 'button', href: '/api/history.csv', download: 'history.csv'},
                  t('history.csv'))))));
    this.until(live.on('up', () => this.refresh()));
    if (live.ready) this.refresh();
  }

  private refresh(before?: number): void {
    const path = `/api/history?limit=${atOnce}` + (before === undefined ? '' : `&before=${before}`);
    void load(this.list, () => api.get<History>(path), (answer) => {
      this.prints = before === undefined ? answer.prints : [...this.prints, ...answer.prints];
      this.more.hidden = answer.prints.length < atOnce;
      fill(
          this.list,
          ...(this.prints.length ? this.prints.map((print) => this.row(print)) :
                                   [empty(t('history.none'), t('history.none_text'))]));
      this.showTotals(answer.totals);
    });
  }

  private row(print: PastPrint): HTMLElement {
    const fact = (name: string, value: string) => h('div', {}, h('dt', {}, name), h('dd', {}, value));
    const layers = print.layers === undefined ? '–' : t('print.layer_of', {
      layer: print.layers_done === undefined ? '–' : number(print.layers_done),
      layers: number(print.layers)
    });
    const again = command({
      label: t('history.again'),
      icon: 'again',
      right: 'queue',
      run: async () => {
        await api.post(`/api/history/${print.id}/again`);
        location.hash = '#/queue';
      }
    });
    const resume = print.can_resume ?
        command({label: t('resume.continue'), icon: 'play', kind: 'main', run: () => this.resume(print)}) :
        null;
    const remove = command({
      label: t('history.remove') + ': ' + shortName(print.job),
      icon: 'trash',
      bare: true,
      kind: 'quiet',
      run: async () => {
        if (await ask(
                t('history.remove'), t('history.remove_text', {job: shortName(print.job)}),
                [{label: t('history.remove'), kind: 'danger'}]) !== 0)
          return;
        await api.remove(`/api/history/${print.id}`);
        this.refresh();
      }
    });
    return h(
        'article', {}, picture(print.picture ? `/api/history/${print.id}/picture` : '', print.job, 'small'),
        h('div', {class: 'stack'},
          h('div', {class: 'run-head'}, h('h3', {class: 'job', title: print.job}, shortName(print.job)),
            h('span', {class: `badge ${print.ended}`}, word('state', print.ended)), remove),
          h('p', {class: 'soft'}, moment(print.ended_at ?? print.began)),
          print.reason && print.ended !== 'completed' ? h('p', {class: 'prose'}, said(print.reason)) : null,
          h('dl', {class: 'facts small'}, fact(t('history.took'), duration(print.seconds)),
            fact(t('history.foretold'), duration(print.foretold_seconds)), fact(t('print.layer'), layers)),
          usedList(print.filaments, print.currency),
          print.warnings?.length ? this.warnings(print.warnings) : null, this.note(print),
          h('div', {class: 'row'}, again, resume)));
  }

  private warnings(warnings: string[]): HTMLElement {
    return h(
        'details', {}, h('summary', {}, t('history.warnings', {n: number(warnings.length)})),
        h('ul', {}, ...warnings.map((text) => h('li', {}, text))));
  }

  private note(print: PastPrint): HTMLElement {
    const field = h('input', {
      class: 'note',
      value: print.note ?? '',
      placeholder: t('history.note'),
      'aria-label': `${t('history.note')}: ${shortName(print.job)}`,
      maxlength: 1000,
      disabled: !access.may('queue'),
      change: async () => {
        try {
          await api.put(`/api/history/${print.id}`, {note: field.value});
          print.note = field.value;
        } catch (error) {
          field.value = print.note ?? '';
          complain(error);
        }
      }
    });
    return field;
  }

  private async resume(print: PastPrint): Promise<void> {
    const path = '/api/prints/resume', name = print.print;  // a name may hold what an address cannot
    const answer = await api.post<{will?: string}>(path, {name});
    if (await ask(
            t('resume.title'), answer.will ?? t('resume.text'), [{label: t('resume.sure'), kind: 'main'}]) !==
        0)
      return;
    await api.post(path, {name, sure: true});
    location.hash = '#/print';
  }

  private showTotals(totals: History['totals']): void {
    if (!totals) return;
    fill(
        this.totals,
        h('dl', {class: 'facts'},
          h('div', {}, h('dt', {}, t('history.prints')), h('dd', {}, number(totals.prints))),
          h('div', {}, h('dt', {}, t('history.time')), h('dd', {}, duration(totals.seconds)))),
        usedList(totals.filaments, totals.currency));
  }
}

function usedList(used: UsedFilament[]|undefined, currency: string|undefined): HTMLElement|null {
  if (!used?.length) return null;
  const row = (one: UsedFilament) => {
    const facts = [
      one.metres === undefined ? '' : metres(one.metres), one.grams === undefined ? '' : grams(one.grams),
      one.cost === undefined ? '' : money(one.cost, one.currency ?? currency)
    ];
    return h(
        'li', {}, swatchOf(one.colour), h('span', {}, [one.name, one.spool].filter(Boolean).join(', ')),
        h('span', {class: 'soft'}, facts.filter(Boolean).join(' · ')));
  };
  return h('ul', {class: 'used'}, ...used.map(row));
}

/** Small sums with three digits, so that a little is not shown as 0. */
function money(value: number, currency: string|undefined): string {
  const digits = value > 0 && value < 0.1 ? 3 : 2;
  if (!currency || !/^[A-Z]{3}$/.test(currency))
    return [number(value, digits), currency].filter(Boolean).join(' ');
  return new Intl.NumberFormat(language(), {style: 'currency', currency, maximumFractionDigits: digits})
      .format(value);
}

customElements.define('history-view', HistoryView);
