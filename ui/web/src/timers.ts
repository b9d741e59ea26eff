// Timers by name, of which starting one again puts it off; and the delays between attempts to connect.
import type { World } from "./world";

const kFirst = 200;
const kGrowth = 1.7;
const kJitter = 0.4;
export const kLongestWait = 5000;

/// The delay before attempt `n` (from 0) to connect again [ms]. It grows, and never ends.
export function back_off(n: number, chance: number): number {
  return Math.min(kLongestWait, kFirst * Math.pow(kGrowth, n)) * (1 + kJitter * (2 * chance - 1));
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
