// Speed, flow and temperatures in steps, with what the job asks or the printer has beside them.
import {api} from '../api';
import {stepper} from '../controls';
import {h, View} from '../dom';
import {differingWish} from '../inputs';
import {live} from '../live';
import type {Heater} from '../types';
import {celsius, t, together} from '../words';

export class PrintAdjust extends View {
  protected show(): void {
    const speed = stepper({
      label: t('adjust.speed'),
      unit: '%',
      step: 5,
      least: 10,
      most: 300,
      send: (percent) => api.post('/api/speed', {percent})
    });
    const flow = stepper({
      label: t('adjust.flow'),
      unit: '%',
      step: 1,
      least: 50,
      most: 150,
      send: (percent) => api.post('/api/flow', {percent})
    });
    const nozzle = stepper({
      label: t('heat.nozzle'),
      unit: '°C',
      step: 5,
      least: 0,
      most: 300,
      send: (nozzle_c) => api.post('/api/temperature', {nozzle_c})
    });
    const bed = stepper({
      label: t('heat.bed'),
      unit: '°C',
      step: 5,
      least: 0,
      most: 120,
      send: (bed_c) => api.post('/api/temperature', {bed_c})
    });
    const draw = () => {
      const print = live.status?.print, limits = live.printer?.limits;
      if (limits?.nozzle_c) nozzle.limit(limits.nozzle_c);
      if (limits?.bed_c) bed.limit(limits.bed_c);
      speed.show(print?.speed_percent, t('adjust.job', {value: '100 %'}));
      flow.show(print?.flow_percent, t('adjust.job', {value: '100 %'}));
      nozzle.show(print?.nozzle?.target_c, besides(print?.nozzle));
      bed.show(print?.bed?.target_c, besides(print?.bed));
      const running = live.status?.state === 'printing';
      for (const one of [speed, flow, nozzle, bed]) one.allow(running);
    };
    this.className = 'card';
    this.setAttribute('role', 'region');
    this.setAttribute('aria-label', t('adjust.title'));
    this.append(h('h2', {}, t('adjust.title')), h('div', {class: 'steppers'}, speed, flow, nozzle, bed));
    this.until(live.on('status', draw), live.on('up', draw), live.on('printer', draw));
    draw();
  }
}

/** How warm it is, and what the job asks for if that is not what the heater is set to. */
function besides(heater: Heater|undefined): string {
  const now = t('adjust.now', {value: celsius(heater?.actual_c)});
  const wish = differingWish(heater);
  return wish === undefined ? now : `${now} · ${together(t('adjust.job', {value: celsius(wish)}))}`;
}

customElements.define('print-adjust', PrintAdjust);
