// Home and jog, and the fan.
import {command, CommandButton, stepper} from '../controls';
import {h, setText, View} from '../dom';
import {live} from '../live';
import {number, t} from '../words';

import {free, order, steerable} from './machine';

const steps = [0.1, 1, 10, 50];  // mm

export class MovePanel extends View {
  private step = 10;
  private fan?: number;  ///< as far as this page has set it

  protected show(): void {
    const buttons: CommandButton[] = [];
    const keep = (button: CommandButton) => (buttons.push(button), button);
    const go = (axis: 'x'|'y'|'z', sign: number, label: string, drawing: string) => {
      const button = keep(command({
        label: `${t('move.move')} ${label}`,
        icon: drawing,
        bare: true,
        run: () => order('move', {[axis]: sign * this.step})
      }));
      button.classList.add('axis', `${axis}${sign > 0 ? 'plus' : 'minus'}`);
      return button;
    };
    const at = h('p', {class: 'soft', 'aria-live': 'off'});
    const chosen =
        h('div', {class: 'choice', role: 'radiogroup', 'aria-label': t('move.step')},
          ...steps.map(
              (step) =>
                  h('label', {}, h('input', {
                      type: 'radio',
                      name: 'step',
                      value: step,
                      checked: step === this.step,
                      change: () => {
                        this.step = step;
                      }
                    }),
                    h('span', {}, `${number(step, 1)} mm`))));
    const home = keep(command({label: t('move.home'), icon: 'home', run: () => order('home')}));
    const pad =
        h('div', {class: 'pad', role: 'group', 'aria-label': t('move.title')}, go('y', 1, '+Y', 'up'),
          go('x', -1, '−X', 'left'), go('x', 1, '+X', 'right'), go('y', -1, '−Y', 'down'),
          go('z', 1, '+Z', 'up'), go('z', -1, '−Z', 'down'),
          h('span', {class: 'axis-name xy', 'aria-hidden': 'true'}, 'X Y'),
          h('span', {class: 'axis-name z', 'aria-hidden': 'true'}, 'Z'));
    const fan = stepper({
      label: t('move.fan'),
      unit: '%',
      step: 10,
      least: 0,
      most: 100,
      begin: 0,
      send: async (percent) => {
        await order('fan', {percent});
        this.fan = percent;
      }
    });
    const draw = () => {
      const printer = live.printer, where = printer?.at;
      setText(
          at,
          where ? t('move.at', {x: number(where[0], 1), y: number(where[1], 1), z: number(where[2], 2)}) :
                  t(printer?.homed ? 'move.unknown' : 'move.not_homed'));
      const may = free();
      for (const button of buttons) button.allow(may && (button === home || printer?.homed !== false));
      fan.show(this.fan, '');
      fan.allow(steerable());
    };
    this.className = 'card move';
    this.append(h('h2', {}, t('move.title')), at, h('div', {class: 'row'}, home, chosen), pad, fan);
    this.until(live.on('printer', draw), live.on('status', draw), live.on('up', draw));
    draw();
  }
}

customElements.define('move-panel', MovePanel);
