// Pause, resume, cancel, and apart from them, red, the stop at once. On a phone they stay at the foot of the
// screen.
import {api} from '../api';
import {ask, command} from '../controls';
import {h, setHidden, View} from '../dom';
import {live} from '../live';
import {t} from '../words';

export class PrintActions extends View {
  protected show(): void {
    const give = (what: string) => async () => {
      await api.post(`/api/print/${what}`);
      await live.refresh();
    };
    const pause = command({label: t('print.pause'), icon: 'pause', kind: 'main', run: give('pause')});
    const resume = command({label: t('print.resume'), icon: 'play', kind: 'main', run: give('resume')});
    const cancel = command({
      label: t('print.cancel'),
      icon: 'cancel',
      run: async () => {
        const sure = await ask(
            t('print.cancel_title'), t('print.cancel_text'),
            [{label: t('print.cancel_yes'), kind: 'danger'}]);
        if (sure === 0) await give('cancel')();
      },
    });
    const stop = command({label: t('print.stop'), icon: 'stop', kind: 'danger stop', run: give('stop')});
    stop.title = t('print.stop_help');
    // The browser takes the focus away from a button that is off, as both are while the connection is lost.
    let held = false;
    const note = (event: Event) => {
      held = event.type === 'focusin' && (event.target === pause || event.target === resume);
    };
    const draw = () => {
      const state = live.state, paused = state === 'paused' || state === 'resuming';
      const at = document.activeElement;
      const focused = at === pause || at === resume || (held && (!at || at === document.body));
      setHidden(pause, paused);
      setHidden(resume, !paused);
      pause.allow(state === 'printing' || state === 'heating');
      resume.allow(state === 'paused');
      cancel.allow(!['cancelling', 'finishing', 'done', 'stopped', 'failed'].includes(state));
      stop.allow(live.busy);
      if (focused) (paused ? resume : pause).focus();
    };
    this.setAttribute('role', 'group');
    this.setAttribute('aria-label', t('print.actions'));
    this.append(pause, resume, cancel, h('span', {class: 'apart'}), stop);
    for (const kind of ['focusin', 'pointerdown']) {
      document.addEventListener(kind, note);
      this.until(() => document.removeEventListener(kind, note));
    }
    this.until(live.on('status', draw), live.on('up', draw));
    draw();
  }
}

customElements.define('print-actions', PrintActions);
