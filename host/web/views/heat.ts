// Temperatures: now in numbers, and the last hour as a chart.
import {api, ApiError} from '../api';
import {chart, Line} from '../chart';
import {h, setHidden, setText, View} from '../dom';
import {differingWish} from '../inputs';
import {live} from '../live';
import type {Heater, Temperatures} from '../types';
import {celsius, t, together} from '../words';

export class HeatPanel extends View {
  private rows: (number|null)[][] = [];
  private columns: string[] = [];
  private until_ = 0;  ///< the daemon's time of the last answer, s

  protected show(): void {
    const picture = chart(t('heat.title'));
    const nozzle = h('span', {class: 'now'}), bed = h('span', {class: 'now'});
    const numbers = () => {
      const print = live.busy ? live.status?.print : undefined;
      setText(nozzle, heater(print?.nozzle ?? live.printer?.nozzle));
      setText(bed, heater(print?.bed ?? live.printer?.bed));
    };
    const refresh = async () => {
      if (!live.ready || document.hidden) return;
      try {
        this.take(await api.get<Temperatures>(`/api/temperatures?since=${this.until_}`));
        setHidden(picture, !this.rows.length);
        picture.draw(this.lines(), this.until_);
      } catch (error) {
        if (error instanceof ApiError) setHidden(picture, true);
      }
    };
    this.className = 'card heat';
    this.setAttribute('role', 'region');
    this.setAttribute('aria-label', t('heat.title'));
    this.append(
        h('h2', {}, t('heat.title')),
        h('div', {class: 'legend'}, h('span', {class: 'key nozzle-key'}, t('heat.nozzle')), nozzle,
          h('span', {class: 'key bed-key'}, t('heat.bed')), bed),
        picture);
    const redraw = () => picture.draw(this.lines(), this.until_);
    document.addEventListener('theme', redraw);
    this.until(live.on('status', numbers), live.on('printer', numbers), live.on('up', () => {
      this.rows = [];
      this.until_ = 0;
      void refresh();
    }), () => document.removeEventListener('theme', redraw));
    this.every(5000, () => void refresh());
    numbers();
    void refresh();
  }

  private take(news: Temperatures): void {
    this.columns = news.columns;
    const last = this.rows.length ? this.rows[this.rows.length - 1][0] ?? 0 : 0;
    this.rows.push(...news.rows.filter((row) => (row[0] ?? 0) > last));
    this.rows = this.rows.filter((row) => (row[0] ?? 0) > news.now - 3600);
    this.until_ = news.now;
  }

  private lines(): Line[] {
    const column = (name: string) => this.columns.indexOf(name);
    const points = (name: string): [number, number|null][] =>
        this.rows.map((row) => [row[0] ?? 0, row[column(name)] ?? null]);
    return [
      {name: t('heat.nozzle_target'), colour: '--hot', dashed: true, points: points('nozzle_target')},
      {name: t('heat.bed_target'), colour: '--warm', dashed: true, points: points('bed_target')},
      {name: t('heat.nozzle'), colour: '--hot', points: points('nozzle')},
      {name: t('heat.bed'), colour: '--warm', points: points('bed')},
    ];
  }
}

function heater(value: Heater|undefined): string {
  const now = celsius(value?.actual_c);
  const words = value?.target_c ? `${now} → ${celsius(value.target_c)}` : now;
  const wish = differingWish(value);
  return wish === undefined ? words : `${words} (${together(t('adjust.job', {value: celsius(wish)}))})`;
}

customElements.define('heat-panel', HeatPanel);
