// Timers by name, of which starting one again puts it off; and the delays between attempts to connect and questions for the server.
import type { World } from "./world";

const kAtOnce = 100;
const kFirst = 200;
const kGrowth = 1.7;
const kJitter = 0.4;
export const kLongestWait = 5000;
// Most outages last seconds: so long a page asks very often.
const kSoon = 5000;
const kAskSoon = 250;
const kAskLater = 400;

const grown = (from: number, n: number): number => from * Math.pow(kGrowth, n);
const jittered = (delay: number, chance: number): number => Math.min(kLongestWait, delay) * (1 + kJitter * (2 * chance - 1));

/// The delay before attempt `n` (from 0) to connect again [ms]. The first one comes at once, but not from all pages in the same moment.
/// It grows, and never ends.
export function back_off(n: number, chance: number): number {
  if (n === 0) return kAtOnce * chance;
  return jittered(grown(kFirst, n - 1), chance);
}

/// The delay between two questions whether the server is there [ms], after it has been away for so long. Somebody who looks at the page
/// waits for it; a page that is hidden asks as soon as it is looked at.
export function ask_again(away: number, isVisible: boolean, chance: number): number {
  return jittered(!isVisible ? kLongestWait : away < kSoon ? kAskSoon : kAskLater, chance);
}

/// The delay before try `n` (from 1) of an operation that the server cannot take for the moment [ms].
export function hold_off(n: number, chance: number): number {
  return jittered(grown(kFirst, n + 2), chance);
}

export class Timers {
  private running = new Map<string, number>();

  constructor(private world: Pick<World, "set" | "clear">) {}

  start(name: string, delay: number, then: () => void): void {
    this.stop(name);
    const timer = this.world.set(delay, () => {
      this.running.delete(name);
      then();
    });
    this.running.set(name, timer);
  }

  stop(name: string): void {
    const timer = this.running.get(name);
    if (timer === undefined) return;
    this.world.clear(timer);
    this.running.delete(name);
  }

  stopAll(): void {
    for (const name of [...this.running.keys()]) this.stop(name);
  }

  has(name: string): boolean {
    return this.running.has(name);
  }
}
