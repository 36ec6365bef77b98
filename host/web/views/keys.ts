// The keys that let other devices and programs in, and who asks for one.
import {access, api} from '../api';
import {ask, command, labelFor, load} from '../controls';
import {fill, h, setHidden, View} from '../dom';
import {live} from '../live';
import type {KeyList, Right} from '../types';
import {moment, t} from '../words';

const rights: Right[] = ['watch', 'queue', 'steer'];

export class KeysPanel extends View {
  protected show(): void {
    const place = h('div', {class: 'stack'});
    let shown = '';
    const refresh = () => {
      if (access.may('all'))
        void load(place, () => api.get<KeyList>('/api/keys'), (now) => {
          const asked = JSON.stringify(now.requests);  // what is being typed stays while nobody asks
          if (asked === shown && place.childElementCount) return;
          shown = asked;
          this.fill(place, now);
        });
      else
        fill(place, h('p', {class: 'soft'}, t('keys.owner')));
    };
    this.className = 'card';
    this.append(h('h2', {}, t('keys.title')), place);
    this.until(live.on('up', () => {
      shown = '';
      refresh();
    }));
    this.every(5000, () => {
      if (live.ready && !document.hidden && access.may('all')) refresh();
    });
    if (live.ready) refresh();
  }

  private fill(place: HTMLElement, now: KeyList): void {
    const again = async () => this.fill(place, await api.get<KeyList>('/api/keys'));
    const remove = (id: number, name: string) => command({
      label: `${t('keys.remove')}: ${name}`,
      icon: 'trash',
      bare: true,
      kind: 'quiet',
      right: 'all',
      run: async () => {
        if (await ask(
                t('keys.remove'), t('keys.remove_text', {name}),
                [{label: t('keys.remove'), kind: 'danger'}]) !== 0)
          return;
        await api.remove(`/api/keys/${id}`);
        await again();
      }
    });
    const decide = (id: number, grant: boolean, right?: Right) => command({
      label: t(grant ? 'keys.grant' : 'keys.deny'),
      kind: grant ? 'main' : '',
      right: 'all',
      run: async () => {
        await api.post(`/api/keys/${id}`, grant ? {grant, right} : {grant});
        await again();
      }
    });
    const name = h('input', {id: 'key-name', maxlength: 60}),
          right =
              h('select', {id: 'key-right'},
                ...rights.map((one) => h('option', {value: one}, t(`right.${one}`))));
    right.value = 'steer';
    const made = h('p', {class: 'made', role: 'status', hidden: true});
    const make = command({
      label: t('keys.make'),
      right: 'all',
      run: async () => {
        const answer = await api.post<{key: string}>('/api/keys', {name: name.value, right: right.value});
        await again();
        const shown = place.querySelector<HTMLElement>('.made');
        if (!shown) return;
        fill(shown, t('keys.once'), ' ', h('code', {}, answer.key));
        setHidden(shown, false);
      }
    });
    fill(
        place,
        h('ul', {class: 'plain'},
          ...now.requests.map(
              (one) =>
                  h('li', {class: 'attention'}, h('span', {}, t('keys.asks', {name: one.name})),
                    h('span', {class: 'soft'}, one.from ?? ''), decide(one.id, true, 'steer'),
                    decide(one.id, false))),
          ...now.keys.map(
              (one) =>
                  h('li', {}, h('span', {class: 'strong'}, one.name),
                    h('span', {class: 'soft'}, `${t(`right.${one.right}`)} · ${moment(one.made)}`),
                    remove(one.id, one.name)))),
        made,
        h('div', {class: 'fields'}, labelFor('key-name', t('keys.name')), name,
          labelFor('key-right', t('keys.right')), right),
        h('div', {class: 'row'}, make));
  }
}

customElements.define('keys-panel', KeysPanel);
