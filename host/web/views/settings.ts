// Settings: those of this device (theme, language, sound), those of the daemon (name, camera, presets), and the keys
// that let other devices and programs in.
import { access, api } from '../api';
import { ask, command, load, say } from '../controls';
import { fill, h, setHidden, View } from '../dom';
import { live } from '../live';
import { theme } from '../theme';
import type { KeyList, Preferences, Right } from '../types';
import { languages, moment, t } from '../words';

const rights: Right[] = ['watch', 'queue', 'steer', 'all'];

export class SettingsPanel extends View {
  protected show(): void {
    const wishes = h('div', {}), keys = h('div', {});
    this.className = 'card settings';
    this.append(h('h2', {}, t('settings.title')), this.device(), h('h3', {}, t('settings.daemon')), wishes, h('h3', {}, t('keys.title')), keys,
                h('div', { class: 'row' }, h('button', { type: 'button', class: 'button', click: () => this.leave() }, t('settings.leave'))));
    const refresh = () => {
      void load(wishes, () => api.get<Preferences>('/api/preferences'), (now) => this.wishes(wishes, now));
      if (access.may('all')) void load(keys, () => api.get<KeyList>('/api/keys'), (now) => this.keys(keys, now));
      else fill(keys, h('p', { class: 'soft' }, t('keys.owner')));
    };
    this.until(live.on('up', refresh));
    if (live.ready) refresh();
  }

  private device(): HTMLElement {
    const tongue = h('select', { id: 'language', change: () => { localStorage.setItem('language', tongue.value); document.dispatchEvent(new Event('language')); } },
                     h('option', { value: '' }, t('settings.auto')), ...languages.map((one) => h('option', { value: one }, t(`language.${one}`))));
    tongue.value = localStorage.getItem('language') ?? '';
    const look: HTMLSelectElement = h('select', { id: 'theme', change: () => theme.set(look.value as 'auto') }, ...(['auto', 'light', 'dark'] as const).map((one) => h('option', { value: one }, t(`theme.${one}`))));
    look.value = theme.choice;
    return h('div', { class: 'fields' }, h('label', { for: 'language' }, t('settings.language')), tongue, h('label', { for: 'theme' }, t('settings.theme')), look);
  }

  private wishes(place: HTMLElement, now: Preferences): void {
    const name = h('input', { id: 'name', value: now.name ?? '', maxlength: 80 }), camera = h('input', { id: 'camera', type: 'url', value: now.camera ?? '', placeholder: 'http://…/snapshot.jpg' });
    const presets = h('textarea', { id: 'presets', rows: 3, value: (now.presets ?? []).map((one) => `${one.name} ${one.nozzle_c} ${one.bed_c}`).join('\n') });
    const image = h('img', { class: 'camera', alt: t('settings.camera'), hidden: true });
    image.addEventListener('error', () => setHidden(image, true));
    if (now.camera) {
      image.src = `/api/camera?${Date.now()}`;
      setHidden(image, false);
    }
    const save = command({ label: t('settings.save'), kind: 'main', run: async () => {
      const wanted: Preferences = { ...now, name: name.value, presets: presetsOf(presets.value) };
      delete (wanted as Record<string, unknown>).version;
      if (access.may('all')) wanted.camera = camera.value;
      await api.put('/api/preferences', wanted);
      say(t('settings.saved'));
      this.wishes(place, { ...now, ...wanted });
    } });
    camera.disabled = !access.may('all');
    fill(place, h('div', { class: 'fields' }, h('label', { for: 'name' }, t('settings.name')), name, h('label', { for: 'camera' }, t('settings.camera')), camera,
         h('label', { for: 'presets' }, t('settings.presets')), presets), image, h('div', { class: 'row' }, save));
  }

  private keys(place: HTMLElement, now: KeyList): void {
    const again = async () => this.keys(place, await api.get<KeyList>('/api/keys'));
    const remove = (id: number, name: string) => command({ label: `${t('keys.remove')}: ${name}`, icon: 'trash', bare: true, kind: 'quiet', right: 'all', run: async () => {
      if (await ask(t('keys.remove'), t('keys.remove_text', { name }), [{ label: t('keys.remove'), kind: 'danger' }]) !== 0) return;
      await api.remove(`/api/keys/${id}`);
      await again();
    } });
    const decide = (id: number, grant: boolean, right?: Right) => command({ label: t(grant ? 'keys.grant' : 'keys.deny'), kind: grant ? 'main' : '', right: 'all', run: async () => {
      await api.post(`/api/keys/${id}`, grant ? { grant, right } : { grant });
      await again();
    } });
    const name = h('input', { id: 'key-name', maxlength: 60 }), right = h('select', { id: 'key-right' }, ...rights.slice(0, 3).map((one) => h('option', { value: one }, t(`right.${one}`))));
    right.value = 'steer';
    const made = h('p', { class: 'made', role: 'status', hidden: true });
    const make = command({ label: t('keys.make'), right: 'all', run: async () => {
      const answer = await api.post<{ key: string }>('/api/keys', { name: name.value, right: right.value });
      await again();
      const shown = place.querySelector<HTMLElement>('.made');
      if (!shown) return;
      fill(shown, t('keys.once'), ' ', h('code', {}, answer.key));
      setHidden(shown, false);
    } });
    fill(place, h('ul', { class: 'plain' }, ...now.requests.map((one) => h('li', { class: 'attention' }, h('span', {}, t('keys.asks', { name: one.name })), h('span', { class: 'soft' }, one.from ?? ''), decide(one.id, true, 'steer'), decide(one.id, false))),
         ...now.keys.map((one) => h('li', {}, h('span', { class: 'strong' }, one.name), h('span', { class: 'soft' }, `${t(`right.${one.right}`)} · ${moment(one.made)}`), remove(one.id, one.name)))),
         made, h('div', { class: 'fields' }, h('label', { for: 'key-name' }, t('keys.name')), name, h('label', { for: 'key-right' }, t('keys.right')), right), h('div', { class: 'row' }, make));
  }

  private leave(): void {
    access.forget();
    api.post('/api/logout').catch(() => undefined);
    location.hash = '#/print';
    location.reload();
  }
}

/** A line each: name, nozzle and bed in °C. Throws what to write instead. */
function presetsOf(text: string): NonNullable<Preferences['presets']> {
  return text.split('\n').filter((line) => line.trim()).map((line) => {
    const found = /^\s*(.+?)[\s,:;]+(\d+)[\s,/]+(\d+)\s*$/.exec(line);
    if (!found) throw new Error(t('settings.presets_wrong', { line }));
    return { name: found[1], nozzle_c: Number(found[2]), bed_c: Number(found[3]) };
  });
}

customElements.define('settings-panel', SettingsPanel);
