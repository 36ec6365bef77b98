// Decides from the times at which something was heard whether the daemon is there. Pure: times are handed in,
// in milliseconds. The page does not see the pings of a WebSocket, so it asks after 2 s of silence, and calls
// the connection lost after 4.3 s. Clocks jump while a laptop sleeps: a gap between two ticks says that
// nothing older can be trusted.
export type Verdict = 'well'|'ask'|'lost'|'slept';

export class Watchdog {
  private ticked: number;

  constructor(now: number, private heard = now) {
    this.ticked = now;
  }

  hear(now: number): void {
    this.heard = now;
  }

  /** When something was heard last. */
  get last(): number {
    return this.heard;
  }

  /** To be called twice a second. */
  tick(now: number): Verdict {
    const gap = now - this.ticked;
    this.ticked = now;
    const silence = now - this.heard;
    if (gap > 10_000 && silence > 10_000) return 'slept';
    if (silence > 4300) return 'lost';
    return silence > 1900 ? 'ask' : 'well';
  }
}
