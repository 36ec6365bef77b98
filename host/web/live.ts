// What the page knows of the daemon at this moment, and the connection to it. Whoever shows something follows
// a topic. When the connection is lost everything stays as it was, grey, until `up` says to fetch it again.
import {access, api, ApiError} from './api';
import {BackOff} from './back_off';
import type {KnownLayer, LogLine, Position, Printer, PrintState, Status} from './types';
import {Watchdog} from './watchdog';

export type Topic = 'link'|'up'|'status'|'position'|'layer'|'printer'|'queue'|'line'|'question';
export type LinkState = 'connecting'|'up'|'lost'|'locked';

class Live {
  link: LinkState = 'connecting';
  status: Status|null = null;
  printer: Printer|null = null;
  position: Position|null = null;
  lostSince = 0;  ///< ms
  name = '';      ///< of the printer, as its owner calls it

  private followers = new Map<Topic, Set<(value: any) => void>>();
  private socket: WebSocket|null = null;
  private readonly waits = new BackOff();
  private readonly dog = new Watchdog(Date.now());
  private timer = 0;
  private asking = false;
  private unknownLines = 0;

  on(topic: Topic, act: (value: any) => void): () => void {
    const all = this.followers.get(topic) ?? new Set();
    this.followers.set(topic, all.add(act));
    return () => void all.delete(act);
  }

  emit(topic: Topic, value?: unknown): void {
    for (const act of [...(this.followers.get(topic) ?? [])]) act(value);
  }

  start(): void {
    window.setInterval(() => this.watch(), 500);
    const soon = () => {
      if (this.link === 'lost' && !document.hidden) void this.open();
    };
    window.addEventListener('online', soon);
    document.addEventListener('visibilitychange', soon);
    void this.open();
  }

  /** Begins again, with another token perhaps. */
  async open(): Promise<void> {
    window.clearTimeout(this.timer);
    this.drop();
    const socketBefore = this.socket;
    try {
      const status = await api.get<Status>('/api/status', 4000);
      await api.login();
      if (this.socket !== socketBefore) return;  // another attempt was faster
      this.status = status;
      this.listen();
    } catch (error) {
      if (error instanceof ApiError && (error.status === 401 || error.status === 403))
        this.enter('locked');
      else
        this.retry();
    }
  }

  /** Asks for the status now, after a command. */
  async refresh(): Promise<void> {
    this.take(await api.get<Status>('/api/status', 2500));
  }

  private listen(): void {
    const socket = this.socket = api.socket();
    const patience = window.setTimeout(() => socket.close(), 4000);
    socket.onmessage = (message) => {
      window.clearTimeout(patience);
      if (socket === this.socket) this.hear(JSON.parse(message.data));
    };
    socket.onclose = () => {
      window.clearTimeout(patience);
      if (socket !== this.socket) return;
      this.socket = null;
      this.retry();
    };
  }

  private hear(event: any): void {
    this.dog.hear(Date.now());
    if (event.event === 'hello') {
      this.waits.reset();
      this.enter('up');
      this.take(event.status);
      this.emit('up');
      return;
    }
    switch (event.event) {
      case 'status':
        this.take(event.status);
        break;
      case 'state':
      case 'progress':
      case 'heat':
      case 'notice':
      case 'printer':
        this.takePrint(event.status);
        if (event.text) this.line(event.event === 'printer' ? 'printer' : 'notice', event.text);
        if (event.event === 'state') void this.refresh().catch(() => undefined);
        break;
      case 'queue':
        this.emit('queue', event);
        void this.refresh().catch(() => undefined);
        break;
      case 'position':
        this.position = event as Position;
        this.emit('position', this.position);
        break;
      case 'layer':
        this.emit('layer', event as KnownLayer);
        break;
      case 'idle':
        this.takePrinter(event.printer);
        break;
    }
  }

  /** What the idle printer is now. What it no longer says is not so any more. */
  takePrinter(news: Printer): void {
    const {action, doing, problem, cools_in_seconds, nozzle, bed, at, homed, ...rest} = this.printer ?? {};
    this.printer = {...rest, ...news};
    this.emit('printer', this.printer);
  }

  private line(from: LogLine['from'], text: string): void {
    this.emit('line', {id: -++this.unknownLines, time: Date.now() / 1000, from, text});
  }

  private take(status: Status): void {
    this.dog.hear(Date.now());
    if (this.link !== 'up') return;
    this.status = status;
    if (status.state === 'idle') this.position = null;
    this.emit('status', status);
  }

  private takePrint(print: PrintState|undefined): void {
    if (!print || !this.status) return;
    this.status = {...this.status, print};
    this.emit('status', this.status);
  }

  private watch(): void {
    if (this.link === 'locked') return;
    const verdict = this.dog.tick(Date.now());
    if (this.link !== 'up') return;
    if (verdict === 'slept' || verdict === 'lost') this.retry();
    if (verdict === 'ask' && !this.asking) void this.ask();
  }

  private async ask(): Promise<void> {
    this.asking = true;
    try {
      await this.refresh();
    } catch (error) {
      if (error instanceof ApiError && error.status === 401)
        this.enter('locked');
      else if (error instanceof TypeError)
        this.retry();  // refused or unreachable; a timeout waits for the watchdog
    }
    this.asking = false;
  }

  private drop(): void {
    const socket = this.socket;
    this.socket = null;
    if (socket) socket.close();
  }

  private retry(): void {
    this.drop();
    if (this.link === 'up') this.lostSince = this.dog.last;
    if (this.link !== 'lost') {
      if (!this.lostSince) this.lostSince = Date.now();
      this.enter('lost');
    }
    window.clearTimeout(this.timer);
    this.timer = window.setTimeout(() => void this.open(), this.waits.next());
  }

  private enter(state: LinkState): void {
    if (this.link === state) return;
    this.link = state;
    if (state === 'up') this.lostSince = 0;
    if (state === 'locked') this.drop();
    this.emit('link', state);
  }

  /** Whether commands may be given at all. */
  get ready(): boolean {
    return this.link === 'up';
  }

  /** One word for what goes on, of daemon and print together. */
  get state(): string {
    const status = this.status;
    if (!status) return 'unknown';
    if (status.state === 'printing' && status.print) return status.print.state;
    if (status.state === 'idle' && status.interrupted) return 'interrupted';
    return status.state;
  }

  get busy(): boolean {
    return !!this.status && this.status.state !== 'idle';
  }

  mayChange(): boolean {
    return this.ready && access.may('steer');
  }
}

export const live = new Live();
