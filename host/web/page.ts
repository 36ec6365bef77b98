// The entry: token, language, theme, the frame of all pages with its navigation, and which page is shown.
import {access, api} from './api';
import {reviewCommands} from './controls';
import {fill, h, icon, setHidden, setText, View} from './dom';
import {live} from './live';
import {sound} from './sound';
import {theme} from './theme';
import type {Preferences, Printer} from './types';
import {duration, moment, percent, preferred, shortName, speak, t, word} from './words';
import {DryRunView} from './views/dry_run';
import {FirstRun} from './views/first_run';
import {HistoryView} from './views/history';
import {LoginView} from './views/login';
import {PrintView} from './views/print';
import {PrinterView} from './views/printer';
import {QueueView} from './views/queue';

interface Page {
  name: string;
  drawing: string;
  make: () => HTMLElement;
  inMenu: boolean
}

// Prepare and Tune will stand here as well, once the daemon answers for them.
const pages: Page[] = [
  {name: 'print', drawing: 'print', make: () => new PrintView(), inMenu: true},
  {name: 'queue', drawing: 'queue', make: () => new QueueView(), inMenu: true},
  {name: 'dry-run', drawing: 'dry', make: () => new DryRunView(), inMenu: true},
  {name: 'history', drawing: 'history', make: () => new HistoryView(), inMenu: true},
  {name: 'printer', drawing: 'printer', make: () => new PrinterView(), inMenu: true},
  {name: 'first-run', drawing: 'printer', make: () => new FirstRun(), inMenu: false},
];

class Shell extends View {
  private shown = '';
  private main!: HTMLElement;
  private links: HTMLAnchorElement[] = [];
  private spokeAt = 0;
  private spoken = '';
  private state = '';
  private busy = false;

  protected show(): void {
    this.main = h('main', {id: 'main', tabindex: -1});
    const name = h('a', {class: 'brand', href: '#/print'}), brief = h('p', {class: 'brief'});
    const banner = h('p', {class: 'banner', role: 'alert', hidden: true});
    const spoken = h('p', {class: 'unseen', role: 'status', 'aria-live': 'polite'});
    this.links = pages.filter((page) => page.inMenu)
                     .map(
                         (page) =>
                             h('a', {href: `#/${page.name}`}, icon(page.drawing),
                               h('span', {}, t(`page.${page.name}`))));
    this.append(
        h('a', {
          class: 'skip',
          href: '#main',
          click: (event: Event) => {
            event.preventDefault();
            this.main.focus();
          }
        },
          t('skip')),
        h('header', {}, name, brief, soundButton(), themeButton()), banner,
        h('nav', {'aria-label': t('pages')}, ...this.links), this.main, spoken);
    const draw = () => {
      setText(name, live.name || live.printer?.name || 'unicursal');
      const print = live.busy ? live.status?.print : undefined;
      const words = live.status ? word('state', live.state) : '';
      setText(brief, print?.percent === undefined ? words : `${words} · ${percent(print.percent)}`);
      document.title = print?.percent === undefined ?
          `${words || 'unicursal'}` :
          `${percent(print.percent)} ${words} – ${shortName(live.status?.job?.job)}`;
      this.speak(spoken);
      this.notice();
      if (this.busy && !live.busy) void meet();  // what was known of heat and port was the print's
      this.busy = live.busy;
    };
    const since = () => this.showLink(banner);
    this.every(1000, since);
    const route = () => {
      if (location.hash.startsWith('#token=')) {  // the address that `serve` prints, in a page that is open
        access.begin();
        live.link = 'connecting';
        void live.open();
      }
      this.route();
    };
    window.addEventListener('hashchange', route);
    this.until(
        live.on('status', draw),
        live.on(
            'up',
            () => {
              void meet();
              draw();
            }),
        live.on('printer', draw),
        live.on(
            'link',
            () => {
              since();
              reviewCommands();
              this.route();
            }),
        live.on('question', () => sound.play([880, 660, 880])),
        () => window.removeEventListener('hashchange', route));
    draw();
    since();
    this.route();
  }

  private route(): void {
    const wanted = /^#\/([a-z-]+)/.exec(location.hash)?.[1] || localStorage.getItem('view') || 'print';
    const page = pages.find((one) => one.name === wanted) ?? pages[0];
    const name = live.link === 'locked' ? 'login' : page.name;
    if (name === this.shown) return;
    const moved = this.shown !== '' && this.shown !== 'login';
    this.shown = name;
    document.body.dataset.page = name;
    if (page.inMenu && name !== 'login') localStorage.setItem('view', name);
    fill(this.main, name === 'login' ? new LoginView() : page.make());
    for (const link of this.links) {
      if (link.hash === `#/${page.name}`)
        link.setAttribute('aria-current', 'page');
      else
        link.removeAttribute('aria-current');
    }
    window.scrollTo(0, 0);
    if (moved) this.main.focus({preventScroll: true});
  }

  private showLink(banner: HTMLElement): void {
    document.body.dataset.link = live.link;
    setHidden(
        banner,
        live.link === 'up' || live.link === 'locked' || (live.link === 'connecting' && !live.lostSince));
    if (live.link === 'lost')
      setText(
          banner,
          t('link.lost',
            {since: moment(live.lostSince / 1000), time: duration((Date.now() - live.lostSince) / 1000)}));
  }

  /** For screen readers: a change of state, otherwise at most once a minute. */
  private speak(place: HTMLElement): void {
    if (!live.status) return;
    const print = live.busy ? live.status.print : undefined, state = word('state', live.state);
    const words = print?.percent === undefined ?
        state :
        t('spoken', {state, percent: percent(print.percent), left: duration(print.left_seconds)});
    if (words === this.spoken || Date.now() - this.spokeAt < 60_000) return;
    this.spokeAt = Date.now();
    this.spoken = words;
    setText(place, words);
  }

  private notice(): void {
    const state = live.state;
    if (this.state && state !== this.state && ['done', 'stopped', 'failed', 'interrupted'].includes(state))
      sound.play(state === 'done' ? [660, 880, 1100] : [440, 330]);
    this.state = state;
  }
}

function themeButton(): HTMLElement {
  const name = () => t('theme.switch', {now: t(`theme.${theme.choice}`)});
  const button =
      h('button', {
        type: 'button',
        class: 'button quiet bare',
        'aria-label': name(),
        title: name(),
        click: () => {
          theme.next();
          button.title = name();
          button.setAttribute('aria-label', name());
        }
      },
        icon('theme'));
  return button;
}

function soundButton(): HTMLElement {
  const button =
      h('button', {
        type: 'button',
        class: 'button quiet bare',
        'aria-label': t('sound'),
        title: t('sound'),
        'aria-pressed': String(sound.on),
        click: () => {
          sound.set(!sound.on);
          button.setAttribute('aria-pressed', String(sound.on));
        }
      },
        icon('bell'));
  return button;
}

/** Learns whose printer it is, after each connecting. A daemon without a profile gets the first run. */
async function meet(): Promise<void> {
  try {
    live.takePrinter(await api.get<Printer>('/api/printer'));
    if (!live.printer?.name && !live.busy && access.may('all') && !sessionStorage.getItem('met')) {
      sessionStorage.setItem('met', '1');
      location.hash = '#/first-run';
    }
  } catch {
    // Shown as unknown; the next connecting asks again.
  }
}

customElements.define('page-shell', Shell);

/** Builds the page again, in another language perhaps. */
export async function rebuild(language: string): Promise<void> {
  await speak(language);
  fill(document.body, new Shell());
}

async function begin(): Promise<void> {
  access.begin();
  theme.begin();
  document.addEventListener('language', () => void rebuild(preferred()));
  await rebuild(preferred());
  live.on('up', async () => {
    const wishes = await api.get<Preferences>('/api/preferences').catch(() => ({} as Preferences));
    live.name = wishes.name ?? '';
    live.emit('printer', live.printer);
    const language = preferred(wishes.language);
    if (language !== document.documentElement.lang) void rebuild(language);
  });
  live.start();
}

void begin();
