// The first run, for a daemon without a profile: step by step from the port to the first print.
import {api, ApiError} from '../api';
import {command, empty, labelFor, load} from '../controls';
import {Child, fill, h, View} from '../dom';
import {live} from '../live';
import type {Finding, Port, Printer} from '../types';
import {t} from '../words';
import {findingList} from './checks';
import {FilamentPanel} from './filaments';
import {MachinePanel} from './machine';
import {ProfilePanel} from './profile';

// The step "tune" names the command, until the page can do it itself.
const names = ['port', 'profile', 'doctor', 'filaments', 'load', 'tune', 'simulate', 'print'];

let reached = 0;  ///< the step, also when the person comes back from another page

export class FirstRun extends View {
  private step = reached;
  private port = 'auto';

  protected show(): void {
    this.draw();
  }

  private draw(): void {
    const name = names[this.step], body = h('div', {class: 'stack'});
    const steps =
        h('ol', {class: 'steps'},
          ...names.map(
              (one, n) => h(
                  'li',
                  {'aria-current': n === this.step ? 'step' : undefined, class: n < this.step ? 'done' : ''},
                  t(`first.${one}`))));
    const back =
        h('button',
          {type: 'button', class: 'button quiet', disabled: this.step === 0, click: () => this.go(-1)},
          t('first.back'));
    const next =
        h('button', {type: 'button', class: 'button main', click: () => this.go(1)},
          t(this.step === names.length - 1 ? 'first.end' : 'first.next'));
    fill(
        this,
        h('section', {class: 'card first'}, h('h1', {}, t('first.title')), steps,
          h('h2', {}, t(`first.${name}`)), h('p', {class: 'prose'}, t(`first.${name}_text`)), body,
          h('div', {class: 'row end'}, back, next)));
    this.fillStep(name, body);
  }

  private go(by: number): void {
    reached = this.step = (this.step + by) % names.length;
    if (this.step > 0 || by < 0) return this.draw();
    location.hash = '#/print';
  }

  private fillStep(name: string, place: HTMLElement): void {
    const put = (...children: Child[]) => fill(place, ...children);
    if (name === 'port') this.choosePort(place);
    if (name === 'profile') this.chooseFrame(place);
    if (name === 'doctor') this.doctor(place);
    if (name === 'filaments') put(new ProfilePanel());
    if (name === 'load') put(new MachinePanel(), new FilamentPanel());
    if (name === 'tune') put(h('code', {}, 'unicursal tune transition PROFILE'));
    if (name === 'simulate')
      put(command({
        label: t('first.simulate_do'),
        right: 'queue',
        run: async () => {
          await api.post('/api/dry-runs', {job: await leaf()});
          location.hash = '#/dry-run';
        }
      }));
    if (name === 'print')
      put(command({
        label: t('first.print_do'),
        right: 'queue',
        run: async () => {
          await api.post('/api/jobs', {job: await leaf()});
          location.hash = '#/print';
        }
      }));
  }

  private choosePort(place: HTMLElement): void {
    void load(place, () => api.get<{ports: Port[]}>('/api/ports'), (answer) => {
      const choice = (value: string, name: string, about: string) =>
          h('label', {class: 'option'}, h('input', {
              type: 'radio',
              name: 'port',
              value,
              checked: value === this.port,
              change: () => {
                this.port = value;
              }
            }),
            h('span', {}, h('span', {class: 'strong'}, name), ' ', h('span', {class: 'soft'}, about)));
      fill(
          place, choice('auto', t('first.auto'), t('first.auto_text')),
          ...answer.ports.map(
              (port) => choice(port.stable_path || port.path, port.description || port.path, port.path)),
          answer.ports.length ? null : empty(t('ports.none'), t('ports.none_text')));
    });
  }

  private chooseFrame(place: HTMLElement): void {
    void load(place, () => api.get<{frames: {name: string; title: string}[]}>('/api/frames'), (answer) => {
      const frame =
                h('select', {id: 'frame'},
                  ...answer.frames.map((one) => h('option', {value: one.name}, one.title))),
            name = h('input', {id: 'printer-name', maxlength: 80});
      const make = command({
        label: t('first.profile_do'),
        kind: 'main',
        right: 'all',
        run: async () => {
          // A daemon that was given its port takes no other, not even "auto".
          const port = this.port === 'auto' ? live.printer?.port || 'auto' : this.port;
          await api.post('/api/profile/new', {frame: frame.value, name: name.value || frame.value, port});
          live.takePrinter(await api.get<Printer>('/api/printer'));
          this.go(1);
        }
      });
      fill(
          place, labelFor('frame', t('first.frame')), frame, labelFor('printer-name', t('settings.name')),
          name, h('div', {class: 'row'}, make));
    });
  }

  private doctor(place: HTMLElement): void {
    const findings = h('div', {});
    const run = command({
      label: t('doctor.ask'),
      kind: 'main',
      run: async () => {
        fill(findings, h('p', {class: 'loading'}, t('doctor.runs')));
        try {
          fill(findings, findingList((await api.post<{findings: Finding[]}>('/api/doctor')).findings));
        } catch (error) {
          fill(
              findings,
              h('p', {class: 'warning'}, error instanceof ApiError ? error.message : t('error.unreachable')));
        }
      }
    });
    fill(place, findings, h('div', {class: 'row'}, run));
  }
}

/** The example among the daemon's files. leaf.toml would bring the profile of another printer. */
async function leaf(): Promise<string> {
  const {jobs} = await api.get<{jobs: string[]}>('/api/files');
  const found = jobs.find((job) => /(^|[/:])leaf\.svg$/.test(job));
  if (!found) throw new Error(t('first.no_leaf'));
  return found;
}

customElements.define('first-run', FirstRun);
