// Print, the home of the page: the print that goes on, or what can be printed next.
import {fill, h, View} from '../dom';
import {live} from '../live';
import {t} from '../words';

import {CameraPanel} from './camera';
import {CurvePanel} from './curve_panel';
import {HeatPanel} from './heat';
import {LogPanel} from './log';
import {PrintActions} from './print_actions';
import {PrintAdjust} from './print_adjust';
import {PrintFacts} from './print_facts';
import {PrintIdle} from './print_idle';

export class PrintView extends View {
  private busy: boolean|null = null;

  protected show(): void {
    this.until(live.on('status', () => this.choose()), live.on('up', () => this.choose()));
    this.choose();
  }

  disconnectedCallback(): void {
    super.disconnectedCallback();
    this.busy = null;
  }

  private choose(): void {
    if (!live.status) return;
    const busy = live.busy;
    if (busy === this.busy) return;
    this.busy = busy;
    this.className = busy ? 'busy' : 'idle';
    if (busy)
      this.showPrint();
    else
      fill(
          this, h('h1', {class: 'unseen'}, t('page.print')), new PrintIdle(),
          h('div', {class: 'side'}, new CameraPanel(), new HeatPanel(), new LogPanel()));
  }

  private showPrint(): void {
    const curve = new CurvePanel();
    curve.className = 'card face';
    curve.setAttribute('role', 'region');
    curve.setAttribute('aria-label', t('curve.title'));
    fill(
        this, new PrintFacts(), curve, new PrintActions(),
        h('div', {class: 'side'}, new PrintAdjust(), new CameraPanel(), new HeatPanel(), new LogPanel()));
  }
}

customElements.define('print-view', PrintView);
