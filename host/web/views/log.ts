// Notices and lines of the printer, newest last.
import {api, ApiError} from '../api';
import {fillList, h, setHidden, View} from '../dom';
import {live} from '../live';
import type {LogLine} from '../types';
import {moment, said, t, translated} from '../words';

const most = 200;

export class LogPanel extends View {
  /** How many lines are shown; and whether those of the serial line are, too. */
  constructor(private readonly all = false) {
    super();
  }

  protected show(): void {
    let lines: LogLine[] = [], next = 0, numbered = false, running = false;
    const list = h('ol', {class: 'log', tabindex: 0, 'aria-label': t(this.all ? 'log.serial' : 'log.title')}),
          none = h('p', {class: 'soft'}, t('log.none'));
    const draw = () => {
      const shown = lines.filter((line) => this.all || line.from !== 'printer').slice(-most);
      const atEnd = list.scrollTop + list.clientHeight >= list.scrollHeight - 8;
      fillList(
          list, shown, (line) => line.id,
          (line) =>
              h('li', {class: line.from}, h('time', {}, moment(line.time)), h('span', {}, inWords(line))),
          () => undefined);
      setHidden(none, shown.length > 0);
      setHidden(list, shown.length === 0);
      if (atEnd) list.scrollTop = list.scrollHeight;
    };
    const refresh = async () => {
      if (!live.ready || document.hidden || running) return;
      running = true;
      try {
        const answer = await api.get<{next: number; lines: LogLine[]}>(`/api/log?since=${next}`);
        if (!numbered || answer.next < next) lines = [];
        numbered = true;
        next = answer.next;
        lines = lines.concat(answer.lines).slice(-1000);
      } catch (error) {
        if (!(error instanceof ApiError)) return;
      } finally {
        running = false;
      }
      draw();
    };
    this.className = 'card';
    this.setAttribute('role', 'region');
    this.setAttribute('aria-label', t(this.all ? 'log.serial' : 'log.title'));
    this.append(h('h2', {}, t(this.all ? 'log.serial' : 'log.title')), list, none);
    let soon = 0;
    this.until(live.on('up', () => {
      lines = [];
      next = 0;
      numbered = false;
      void refresh();
    }), live.on('line', (line: LogLine) => {
      if (!numbered) {
        lines.push(line);
        return draw();
      }
      if (line.from === 'printer' && !this.all) return;
      window.clearTimeout(soon);
      soon = window.setTimeout(() => void refresh(), 400);
    }));
    this.every(this.all ? 3000 : 10_000, () => void refresh());
    void refresh();
  }
}

/** What the daemon notes in English, as far as it is a state or a sentence that the page knows. */
function inWords(line: LogLine): string {
  if (line.from === 'printer') return line.text;
  const [, id, job, word] = /^(?:print|job (\d+) (.*)): (\w+)$/.exec(line.text) ?? [];
  const state = translated(`state.${word}`);
  if (!state) return said(line.text);
  return id ? t('log.job', {id, job, state}) : t('log.print', {state});
}

customElements.define('log-panel', LogPanel);
