// Asks for a token or key, when the daemon does not know the one that the page has.
import {access} from '../api';
import {complain, labelFor} from '../controls';
import {h, View} from '../dom';
import {live} from '../live';
import {t} from '../words';

export class LoginView extends View {
  protected show(): void {
    const field =
        h('input',
          {type: 'password', name: 'token', autocomplete: 'current-password', required: true, id: 'token'});
    const send = async (event: Event) => {
      event.preventDefault();
      access.use(field.value);
      live.link = 'connecting';
      await live.open();
      if ((live.link as string) === 'locked') complain(new Error(t('login.wrong')));
    };
    this.append(
        h('form', {class: 'card login', submit: send}, h('h1', {}, t('login.title')),
          h('p', {}, t('login.text')), h('code', {}, 'unicursal token'), labelFor('token', t('login.token')),
          field, h('button', {type: 'submit', class: 'button main'}, t('login.enter'))));
    field.focus();
  }
}

customElements.define('login-view', LoginView);
