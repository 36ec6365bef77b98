// Settings: those of this device (theme, language), and those of the daemon (name, camera, presets).
import {access, api} from '../api';
import {command, labelFor, load, say} from '../controls';
import {fill, h, setHidden, View} from '../dom';
import {presetsOf} from '../inputs';
import {live} from '../live';
import {theme} from '../theme';
import type {Preferences} from '../types';
import {languages, t} from '../words';

export class SettingsPanel extends View {
  protected show(): void {
    const wishes = h('div', {class: 'stack'});
    this.className = 'card settings';
    this.append(
        h('h2', {}, t('settings.title')), this.device(),
        h('div', {class: 'row'},
          h('button', {type: 'button', class: 'button', click: () => this.leave()}, t('settings.leave')),
          h('a', {class: 'more', href: '#/first-run'}, t('first.title'))),
        h('h3', {}, t('settings.daemon')), wishes);
    const refresh = () => {
      void load(wishes, () => api.get<Preferences>('/api/preferences'), (now) => this.wishes(wishes, now));
    };
    this.until(live.on('up', refresh));
    if (live.ready) refresh();
  }

  private device(): HTMLElement {
    const tongue =
        h('select', {
          id: 'language',
          change: () => {
            localStorage.setItem('language', tongue.value);
            document.dispatchEvent(new Event('language'));
          }
        },
          h('option', {value: ''}, t('settings.auto')),
          ...languages.map((one) => h('option', {value: one}, t(`language.${one}`))));
    tongue.value = localStorage.getItem('language') ?? '';
    const look: HTMLSelectElement =
        h('select', {id: 'theme', change: () => theme.set(look.value as 'auto')},
          ...(['auto', 'light', 'dark'] as const).map((one) => h('option', {value: one}, t(`theme.${one}`))));
    look.value = theme.choice;
    return h(
        'div', {class: 'fields'}, labelFor('language', t('settings.language')), tongue,
        labelFor('theme', t('settings.theme')), look);
  }

  private wishes(place: HTMLElement, now: Preferences): void {
    const name = h('input', {id: 'name', value: now.name ?? '', maxlength: 80}),
          camera =
              h('input',
                {id: 'camera', type: 'url', value: now.camera ?? '', placeholder: 'http://…/snapshot.jpg'});
    const presets = h('textarea', {
      id: 'presets',
      rows: 3,
      value: (now.presets ?? []).map((one) => `${one.name} ${one.nozzle_c} ${one.bed_c}`).join('\n')
    });
    const image = h('img', {class: 'camera', alt: t('settings.camera'), hidden: true});
    image.addEventListener('error', () => setHidden(image, true));
    if (now.camera) {
      image.src = `/api/camera?${Date.now()}`;
      setHidden(image, false);
    }
    const save = command({
      label: t('settings.save'),
      kind: 'main',
      run: async () => {
        const wanted: Preferences = {...now, name: name.value, presets: presetsOf(presets.value)};
        delete (wanted as Record<string, unknown>).version;
        if (access.may('all')) wanted.camera = camera.value;
        await api.put('/api/preferences', wanted);
        live.name = name.value;
        live.emit('printer', live.printer);
        say(t('settings.saved'));
        this.wishes(place, {...now, ...wanted});
      }
    });
    camera.disabled = !access.may('all');
    fill(
        place,
        h('div', {class: 'fields'}, labelFor('name', t('settings.name')), name,
          labelFor('camera', t('settings.camera')), camera, labelFor('presets', t('settings.presets')),
          presets),
        image, h('div', {class: 'row'}, save));
  }

  private leave(): void {
    access.forget();
    api.post('/api/logout').catch(() => undefined);
    location.hash = '#/print';
    location.reload();
  }
}

customElements.define('settings-panel', SettingsPanel);
