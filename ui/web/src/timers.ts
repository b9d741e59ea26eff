// Timers by name, of which starting one again puts it off; and the delays between attempts to connect.
import type { World } from "./world";

const kAtOnce = 100;
const kFirst = 200;
const kGrowth = 1.7;
const kJitter = 0.4;
// Most outages last seconds: so long it asks often. Later it may not: Chromium delays each new socket of a page by up to five seconds
// once some thirty have failed within minutes (its WebSocketPerProcessThrottler).
const kOften = 550;
const kOftenFor = 10; // attempts
export const kLongestWait = 5000;

const grown = (from: number, n: number): number => from * Math.pow(kGrowth, n);
const jittered = (delay: number, chance: number): number => Math.min(kLongestWait, delay) * (1 + kJitter * (2 * chance - 1));

/// The delay before attempt `n` (from 0) to connect again [ms]. The first one comes at once, but not from all pages in the same moment.
/// It grows, and never ends.
export function back_off(n: number, chance: number): number {
  if (n === 0) return kAtOnce * chance;
  return jittered(n <= kOftenFor ? Math.min(kOften, grown(kFirst, n - 1)) : grown(kOften, n - kOftenFor), chance);
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
