// The printer's profile: the TOML file as a text, with mistakes at their line, and the list of its keys.
import {api, ApiError} from '../api';
import {command, labelFor, load, say} from '../controls';
import {fill, h, setHidden, setText, View} from '../dom';
import {live} from '../live';
import type {Profile} from '../types';
import {t} from '../words';

export class ProfilePanel extends View {
  private text!: HTMLTextAreaElement;
  private lines!: HTMLElement;
  private saved = '';

  protected show(): void {
    const place = h('div', {class: 'stack'});
    this.className = 'card profile';
    this.append(h('h2', {}, t('profile.title')), place);
    const refresh = () =>
        load(place, () => api.get<Profile>('/api/profile'), (profile) => this.fill(place, profile));
    this.until(live.on('up', () => {
      if (!this.text || this.text.value === this.saved) void refresh();
    }));
    if (live.ready) void refresh();
  }

  private fill(place: HTMLElement, profile: Profile): void {
    const mistake = h('p', {class: 'warning', role: 'alert', hidden: true});
    this.saved = profile.toml;
    this.lines = h('div', {class: 'numbers', 'aria-hidden': 'true'});
    this.text = h('textarea', {
      id: 'toml',
      value: profile.toml,
      spellcheck: 'false',
      rows: 20,
      wrap: 'off',
      autocapitalize: 'off',
      input: () => this.number(0),
      scroll: () => {
        this.lines.scrollTop = this.text.scrollTop;
      }
    });
    const save = command({
      label: t('profile.save'),
      kind: 'main',
      right: 'all',
      run: async () => {
        try {
          await api.put('/api/profile', {toml: this.text.value});
          this.saved = this.text.value;
          setHidden(mistake, true);
          this.number(0);
          say(t('profile.saved'));
        } catch (error) {
          if (!(error instanceof ApiError) || error.status !== 422) throw error;
          const line = Number(error.detail.line) || 0;
          setText(mistake, [
            line ? t('profile.line', {line}) : '', String(error.detail.key ?? ''), error.message
          ].filter(Boolean).join(' · '));
          setHidden(mistake, false);
          this.number(line);
        }
      }
    });
    const back =
        h('button', {
          type: 'button',
          class: 'button',
          click: () => {
            this.text.value = this.saved;
            this.number(0);
            setHidden(mistake, true);
          }
        },
          t('profile.back'));
    fill(
        place, profile.file ? h('p', {class: 'soft'}, h('code', {}, profile.file)) : null,
        labelFor('toml', t('profile.text')), h('div', {class: 'editor'}, this.lines, this.text), mistake,
        h('div', {class: 'row'}, save, back), this.keys(profile));
    this.number(0);
  }

  /** Numbers the lines; the one with a mistake is marked and shown. */
  private number(wrong: number): void {
    const count = this.text.value.split('\n').length;
    fill(
        this.lines,
        ...Array.from({length: count}, (_, n) => h('span', {class: n + 1 === wrong ? 'wrong' : ''}, n + 1)));
    if (!wrong) return;
    const before = this.text.value.split('\n').slice(0, wrong - 1).join('\n').length + (wrong > 1 ? 1 : 0);
    const line = this.text.value.split('\n')[wrong - 1] ?? '';
    this.text.focus();
    this.text.setSelectionRange(before, before + line.length);
    this.text.scrollTop = this.lines.scrollTop = Math.max(0, (wrong - 4) * 20);
  }

  private keys(profile: Profile): HTMLElement|null {
    if (!profile.keys?.length) return null;
    return h(
        'details', {}, h('summary', {}, t('profile.keys')),
        h('dl', {class: 'keys'},
          ...profile.keys.map(
              (key) =>
                  h('div', {}, h('dt', {}, h('code', {}, key.key)),
                    h('dd', {},
                      h('span', {class: 'strong'}, [shown(key.value), key.unit].filter(Boolean).join(' ')),
                      ' ', h('span', {class: 'soft'}, key.help ?? ''))))));
  }
}

function shown(value: unknown): string {
  return value === undefined || value === null ? '' :
      typeof value === 'string'                ? value :
                                                 JSON.stringify(value);
}

customElements.define('profile-panel', ProfilePanel);
