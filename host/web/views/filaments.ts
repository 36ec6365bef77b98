// The filaments of the feeders: load, purge and unload each, or purge all.
import {command, CommandButton, swatchOf} from '../controls';
import {fill, h, setText, View} from '../dom';
import {live} from '../live';
import {t} from '../words';

import {free, order} from './machine';

export class FilamentPanel extends View {
  private drawn = '';
  private buttons: CommandButton[] = [];

  protected show(): void {
    const list = h('ol', {class: 'rows feeders'}), hint = h('p', {class: 'soft'});
    const all = command({label: t('feed.purge_all'), run: () => order('feed', {action: 'purge'})});
    const draw = () => {
      const printer = live.printer, count = printer?.feeders ?? printer?.filaments?.length ?? 0;
      const now = JSON.stringify([count, printer?.filaments]);
      if (now !== this.drawn) {
        this.drawn = now;
        this.buttons = [all];
        fill(list, ...Array.from({length: count}, (_, n) => this.feeder(n + 1)));
      }
      setText(hint, count ? t('feed.help') : t('feed.unknown'));
      for (const button of this.buttons) button.allow(free());
    };
    this.className = 'card';
    this.append(h('h2', {}, t('feed.title')), hint, list, h('div', {class: 'row'}, all));
    this.until(live.on('printer', draw), live.on('status', draw), live.on('up', draw));
    draw();
  }

  private feeder(feeder: number): HTMLElement {
    const filament = live.printer?.filaments?.[feeder - 1];
    const act = (action: string) => {
      const button = command({label: t(`feed.${action}`), run: () => order('feed', {action, feeder})});
      button.setAttribute('aria-label', `${t(`feed.${action}`)}: ${t('feed.feeder', {n: feeder})}`);
      this.buttons.push(button);
      return button;
    };
    return h(
        'li', {}, swatchOf(filament?.colour),
        h('div', {class: 'stack'},
          h('span', {class: 'strong'}, filament?.name || t('feed.feeder', {n: feeder})),
          h('span', {class: 'soft'},
            [t('feed.feeder', {n: feeder}), filament?.material].filter(Boolean).join(' · '))),
        h('div', {class: 'row'}, act('load'), act('purge'), act('unload')));
  }
}

customElements.define('filament-panel', FilamentPanel);
