// How long to wait before the next attempt to connect: half a second, doubled up to 10 s, and spread, so that
// the pages of a house do not all come back in the same moment.
export class BackOff {
  private attempts = 0;

  /** Milliseconds. `chance` is from 0 to 1. */
  next(chance: number = Math.random()): number {
    const wait = Math.min(10_000, 500 * 2 ** this.attempts++);
    return Math.round(wait * (0.8 + 0.4 * chance));
  }

  reset(): void {
    this.attempts = 0;
  }
}
