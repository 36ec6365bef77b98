// Printer: what can be done with it while nothing is printed, what it is, and how it is set up.
import {fill, h, setAttribute, View} from '../dom';
import {t} from '../words';

import {ChecksPanel} from './checks';
import {FilamentPanel} from './filaments';
import {HeatPanel} from './heat';
import {KeysPanel} from './keys';
import {LogPanel} from './log';
import {MachinePanel} from './machine';
import {MovePanel} from './move';
import {ProfilePanel} from './profile';
import {SettingsPanel} from './settings';

const parts: Record<string, () => HTMLElement[][]> = {
  steer: () => [[new MachinePanel(), new MovePanel()], [new FilamentPanel(), new HeatPanel()]],
  check: () => [[new ChecksPanel()], [new LogPanel(true)]],
  profile: () => [[new ProfilePanel()]],
  settings: () => [[new SettingsPanel()], [new KeysPanel()]],
};

export class PrinterView extends View {
  protected show(): void {
    const place = h('div', {}), names = Object.keys(parts);
    const links = names.map((name) => h('a', {href: `#/printer/${name}`}, t(`part.${name}`)));
    const choose = () => {
      if (!location.hash.startsWith('#/printer') && location.hash) return;
      const name = names.find((one) => location.hash === `#/printer/${one}`) ?? names[0];
      const columns = parts[name]();
      place.className = `columns ${columns.length > 1 ? 'two' : ''}`;
      fill(place, ...columns.map((column) => h('div', {class: 'side'}, ...column)));
      links.forEach((link, n) => setAttribute(link, 'aria-current', names[n] === name ? 'true' : false));
    };
    window.addEventListener('hashchange', choose);
    this.until(() => window.removeEventListener('hashchange', choose));
    this.append(
        h('h1', {class: 'unseen'}, t('page.printer')),
        h('nav', {class: 'parts', 'aria-label': t('parts')}, ...links), place);
    choose();
  }
}

customElements.define('printer-view', PrinterView);
