// The print in words and numbers: state, per cent, time left, when it is ready, seconds planned ahead, layer;
// and the question that the printer asks, before everything else.
import {api} from '../api';
import {command} from '../controls';
import {fill, h, setHidden, setText, View} from '../dom';
import {live} from '../live';
import {duration, moment, number, percent, said, shortName, t, unknown, word} from '../words';

const wellAhead = 120;  // s planned ahead that fill the bar

export class PrintFacts extends View {
  private asked = '';

  protected show(): void {
    const state = h('p', {class: 'state'}), job = h('h1', {class: 'job'}), done = h('p', {class: 'percent'}),
          short = h('p', {class: 'soft short'});
    const bar =
        h('div', {
          class: 'bar',
          role: 'progressbar',
          'aria-label': t('print.progress'),
          'aria-valuemin': 0,
          'aria-valuemax': 100
        },
          h('i'));
    const fact = (name: string) => {
      const value = h('dd', {});
      return [h('div', {}, h('dt', {}, name), value), value];
    };
    const [leftBox, left] = fact(t('print.left')), [readyBox, ready] = fact(t('print.ready'));
    const [layerBox, layer] = fact(t('print.layer')), [aheadBox, ahead] = fact(t('print.ahead'));
    const [heatBox, heat] = fact(t('heat.nozzle_bed'));
    const aheadBar = h('div', {class: 'bar thin', 'aria-hidden': 'true'}, h('i'));
    aheadBox.append(aheadBar);
    const question =
        h('div', {class: 'question', role: 'alert', 'aria-label': t('print.asks'), hidden: true});
    const warning = h('p', {class: 'warning', hidden: true});
    const draw = () => {
      const print = live.status?.print, full = live.status?.job?.job;
      const rest = live.state === 'reconnecting' ? undefined : print?.left_seconds;
      setText(state, word('state', live.state));
      state.dataset.state = live.state;
      setText(job, shortName(full));
      job.title = full ?? '';
      setText(done, percent(print?.percent));
      width(bar, print?.percent);
      if (print?.percent === undefined)
        bar.removeAttribute('aria-valuenow');
      else
        bar.setAttribute('aria-valuenow', String(Math.floor(print.percent)));
      setText(left, duration(rest));
      const end = rest === undefined || live.state === 'paused' ? unknown : moment(Date.now() / 1000 + rest);
      setText(ready, end);
      setText(
          short,
          rest === undefined ? '' :
                               t(end === unknown ? 'print.left_short' : 'print.left_ready',
                                 {left: duration(rest), ready: end}));
      setText(
          layer,
          print?.layers ? t('print.layer_of', {
            layer: print.layer === undefined ? unknown : number(print.layer),
            layers: number(print.layers)
          }) :
                          unknown);
      setText(ahead, duration(print?.lookahead_seconds));
      width(
          aheadBar,
          print?.lookahead_seconds === undefined ? undefined : (print.lookahead_seconds / wellAhead) * 100);
      aheadBar.classList.toggle('low', (print?.lookahead_seconds ?? wellAhead) < 15);
      setText(heat, `${number(print?.nozzle?.actual_c)} / ${number(print?.bed?.actual_c)} °C`);
      const reason = said(live.status?.problem ?? print?.reason ?? live.status?.job?.reason);
      setText(warning, reason);
      setHidden(warning, !reason);
      this.showQuestion(question);
    };
    this.append(
        question, h('div', {class: 'headline'}, h('div', {}, state, job, short), done), bar, warning,
        h('dl', {class: 'facts'}, leftBox, readyBox, layerBox, aheadBox, heatBox));
    this.until(live.on('status', draw), live.on('up', draw));
    draw();
  }

  private showQuestion(place: HTMLElement): void {
    const prompt = live.status?.print?.prompt;
    const asked = prompt ? JSON.stringify(prompt) : '';
    if (asked === this.asked) return;
    this.asked = asked;
    setHidden(place, !prompt);
    if (!prompt) return;
    const answers = prompt.answers.map(
        (label, button) => command(
            {label, kind: button === 0 ? 'main' : '', run: () => api.post('/api/print/answer', {button})}));
    fill(
        place, h('h2', {}, t('print.asks')), h('p', {class: 'prose'}, prompt.text),
        h('div', {class: 'row'}, ...answers));
    live.emit('question');
  }
}

function width(bar: HTMLElement, value: number|undefined): void {
  (bar.firstElementChild as HTMLElement).style.width = `${Math.max(0, Math.min(100, value ?? 0))}%`;
  bar.classList.toggle('unknown', value === undefined);
}

customElements.define('print-facts', PrintFacts);
