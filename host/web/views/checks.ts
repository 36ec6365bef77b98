// The doctor's findings, and the ports of the computer that the daemon runs on.
import {api} from '../api';
import {command, empty, load} from '../controls';
import {fill, h, View} from '../dom';
import {live} from '../live';
import type {Finding, Port} from '../types';
import {t} from '../words';

export function findingList(findings: Finding[]): HTMLElement {
  return h(
      'ul', {class: 'findings'},
      ...findings.map(
          (finding) =>
              h('li', {class: finding.grade}, h('span', {class: 'grade'}, t(`grade.${finding.grade}`)),
                h('div', {}, h('p', {}, finding.sentence),
                  finding.remedy ? h('p', {class: 'soft'}, finding.remedy) : null))));
}

export class ChecksPanel extends View {
  protected show(): void {
    const findings = h('div', {class: 'stack'}), ports = h('div', {class: 'stack'});
    const doctor = command({
      label: t('doctor.ask'),
      run: async () => {
        fill(findings, h('p', {class: 'loading'}, t('doctor.runs')));
        try {
          fill(findings, findingList((await api.post<{findings: Finding[]}>('/api/doctor')).findings));
        } catch (error) {
          fill(findings);
          throw error;
        }
      }
    });
    const refresh = () => load(ports, () => api.get<{ports: Port[]}>('/api/ports'), (answer) => {
      fill(
          ports,
          answer.ports.length ?
              h('ul', {class: 'plain'},
                ...answer.ports.map(
                    (port) =>
                        h('li', {}, h('code', {}, port.stable_path || port.path),
                          h('span', {class: 'soft'},
                            [port.description, port.firmware].filter(Boolean).join(' · '))))) :
              empty(t('ports.none'), t('ports.none_text')));
    });
    const may = () => doctor.allow(!live.busy);
    this.className = 'card';
    this.append(
        h('h2', {}, t('doctor.title')), findings, h('div', {class: 'row'}, doctor),
        h('h3', {}, t('ports.title')), ports);
    this.until(live.on('status', may), live.on('up', () => {
      may();
      void refresh();
    }));
    may();
    if (live.ready) void refresh();
  }
}

customElements.define('checks-panel', ChecksPanel);
