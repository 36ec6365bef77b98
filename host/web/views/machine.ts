// The connection, what the printer is doing, and its heat: presets and steps. Everything is refused during a
// print.
import {api} from '../api';
import {command, CommandButton, stepper, Stepper} from '../controls';
import {fill, h, setHidden, setText, View} from '../dom';
import {live} from '../live';
import type {Preferences, Printer} from '../types';
import {celsius, duration, number, said, t, translated, unknown, word} from '../words';

/** Gives a command to the idle printer, and takes what it answers. */
export async function order(what: string, body: unknown = {}): Promise<void> {
  const answer = await api.post<Printer>(`/api/printer/${what}`, body);
  if (answer.connection) live.takePrinter(answer);
}

/** Whether the printer stands ready for a command: connected, not printing. */
export function steerable(): boolean {
  return live.printer?.connection === 'open' && !live.busy;
}

/** Whether it may move and feed as well: it does neither. It may heat meanwhile. */
export function free(): boolean {
  const action = live.printer?.action;
  return steerable() && (!action || action === 'heating');
}

export class MachinePanel extends View {
  private readonly buttons: CommandButton[] = [];
  private nozzle!: Stepper;
  private bed!: Stepper;

  protected show(): void {
    const state = h('p', {class: 'state'}), firmware = h('dd', {}), port = h('dd', {}), size = h('dd', {}),
          nozzle = h('dd', {});
    const doing = h('p', {class: 'doing', role: 'status'}), problem = h('p', {class: 'warning'}),
          cools = h('p', {class: 'soft'});
    const connect = command({label: t('machine.connect'), kind: 'main', run: () => order('connect')});
    const letGo = command({label: t('machine.disconnect'), run: () => order('disconnect')});
    const end = command({label: t('machine.end'), icon: 'cancel', run: () => order('cancel')});
    const off =
        this.steering(command({label: t('heat.off'), run: () => order('heat', {nozzle_c: 0, bed_c: 0})}));
    this.nozzle = stepper({
      label: t('heat.nozzle'),
      unit: '°C',
      step: 5,
      least: 0,
      most: 300,
      send: (nozzle_c) => order('heat', {nozzle_c})
    });
    this.bed = stepper({
      label: t('heat.bed'),
      unit: '°C',
      step: 5,
      least: 0,
      most: 120,
      send: (bed_c) => order('heat', {bed_c})
    });
    const presets = h('div', {class: 'row'});
    const fact = (name: string, value: HTMLElement) => h('div', {}, h('dt', {}, name), value);
    const draw = () => {
      const printer = live.printer, open = printer?.connection === 'open',
            print = live.busy ? live.status?.print : undefined;
      setText(state, word('connection', live.busy ? 'printing' : printer?.connection));
      state.dataset.state = live.busy ? 'printing' : printer?.connection ?? 'unknown';
      const answer = printer?.firmware ?? '';  // after a print: the whole answer to M115
      setText(firmware, /FIRMWARE_NAME:(.*?)(?: [A-Z_]+:|$)/.exec(answer)?.[1] ?? (answer || unknown));
      setText(port, printer?.port || unknown);
      setText(
          size, printer?.bed_mm ? `${printer.bed_mm.map((side) => number(side)).join(' × ')} mm` : unknown);
      setText(nozzle, printer?.nozzle_mm === undefined ? unknown : `${number(printer.nozzle_mm, 2)} mm`);
      setText(
          doing,
          translated(`doing.${printer?.action}`) ?? printer?.doing ?? (live.busy ? t('machine.busy') : ''));
      setText(problem, said(printer?.problem));
      setHidden(problem, !printer?.problem);
      setText(cools, printer?.cools_in_seconds === undefined ? '' : t('machine.cools', {
                time: duration(printer.cools_in_seconds)
              }));
      setHidden(connect, open || live.busy);
      setHidden(letGo, !open);
      setHidden(end, !printer?.action);
      connect.allow(!live.busy && printer?.connection !== 'connecting');
      this.drawHeat(print?.nozzle ?? printer?.nozzle, print?.bed ?? printer?.bed);
      for (const button of this.buttons) button.allow(steerable());
    };
    this.className = 'card machine';
    this.append(
        h('h2', {}, t('machine.title')), state, doing, problem, h('div', {class: 'row'}, connect, letGo, end),
        h('dl', {class: 'facts'}, fact(t('machine.firmware'), firmware), fact(t('machine.port'), port),
          fact(t('machine.bed'), size), fact(t('heat.nozzle'), nozzle)),
        h('h3', {}, t('heat.preheat')), presets, h('div', {class: 'steppers'}, this.nozzle, this.bed),
        h('div', {class: 'row'}, off, cools));
    this.until(
        live.on('printer', draw), live.on('status', draw),
        live.on('up', () => void this.presets(presets).then(draw)));
    draw();
    void this.presets(presets).then(draw);
  }

  private steering(button: CommandButton): CommandButton {
    this.buttons.push(button);
    return button;
  }

  private drawHeat(nozzle: Printer['nozzle'], bed: Printer['bed']): void {
    const limits = live.printer?.limits;
    if (limits?.nozzle_c) this.nozzle.limit(limits.nozzle_c);
    if (limits?.bed_c) this.bed.limit(limits.bed_c);
    this.nozzle.show(nozzle?.target_c, t('adjust.now', {value: celsius(nozzle?.actual_c)}));
    this.bed.show(bed?.target_c, t('adjust.now', {value: celsius(bed?.actual_c)}));
    this.nozzle.allow(steerable());
    this.bed.allow(steerable());
  }

  private async presets(place: HTMLElement): Promise<void> {
    if (!live.ready) return;
    const wishes = await api.get<Preferences>('/api/preferences').catch(() => ({} as Preferences));
    const presets = wishes.presets?.length ?
        wishes.presets :
        [{name: 'PLA', nozzle_c: 210, bed_c: 60}, {name: 'PETG', nozzle_c: 240, bed_c: 80}];
    fill(place, ...presets.map((preset) => this.steering(command({
      label: `${preset.name} ${number(preset.nozzle_c)} / ${number(preset.bed_c)} °C`,
      run: () => order('heat', {nozzle_c: preset.nozzle_c, bed_c: preset.bed_c}),
    }))));
  }
}

customElements.define('machine-panel', MachinePanel);
