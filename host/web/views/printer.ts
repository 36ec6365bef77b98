// Printer: what can be done with it while nothing is printed, what it is, and how it is set up.
import { h, View } from '../dom';
import { t } from '../words';
import { ChecksPanel } from './checks';
import { FilamentPanel } from './filaments';
import { HeatPanel } from './heat';
import { LogPanel } from './log';
import { MachinePanel } from './machine';
import { MovePanel } from './move';
import { ProfilePanel } from './profile';
import { SettingsPanel } from './settings';

export class PrinterView extends View {
  protected show(): void {
    this.append(h('h1', { class: 'unseen' }, t('page.printer')),
                h('div', { class: 'columns' }, new MachinePanel(), new FilamentPanel(), new MovePanel(), new HeatPanel(), new ChecksPanel(),
                  new LogPanel(true), new SettingsPanel(), new ProfilePanel()));
  }
}

customElements.define('printer-view', PrinterView);
