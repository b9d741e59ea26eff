// Whether a connection still lives: it is asked from time to time, and at once when somebody looks at the page again.
import type { Timers } from "./timers";
import type { World } from "./world";

// [ms]
const kBetween = 5000;
const kPatience = 4000;
const kLongest = 12000;
export const kWakeWait = 1500;

export class Heartbeat {
  private asked = 0; // the number of the last question
  private askedAt = 0;
  private trip = 0; // the shortest time from a question to its answer on this link [ms]

  constructor(
    private world: Pick<World, "now" | "isVisible">,
    private timers: Timers,
    private send: (message: object) => void,
    private died: () => void,
  ) {}

  /// A new link, on which the server has answered the first message after so long.
  begin(trip: number): void {
    this.trip = trip;
    this.schedule();
  }

  stop(): void {
    this.timers.stop("ping");
    this.timers.stop("pong");
  }

  /// Somebody looks at the page: is it alive?
  wake(): void {
    this.ask(kWakeWait);
  }

  answered(number: unknown): void {
    if (number !== this.asked) return;
    this.timers.stop("pong");
    // The shortest one: a page that was frozen reads its messages late.
    this.trip = Math.min(this.trip, this.world.now() - this.askedAt);
  }

  private schedule(): void {
    if (this.world.isVisible()) this.timers.start("ping", kBetween, () => this.ask(kPatience));
  }

  // On a slow way an answer is waited for longer.
  private ask(patience: number): void {
    const wait = Math.max(patience, Math.min(kLongest, 2 * this.trip));
    this.asked += 1;
    this.askedAt = this.world.now();
    this.send({ t: "ping", n: this.asked });
    const due = this.askedAt + wait;
    this.timers.start("pong", wait, () => {
      // A timer that comes much too late means that the page was frozen: its messages have not been read yet.
      if (this.world.now() - due > 1000) this.ask(kWakeWait);
      else this.died();
    });
    this.schedule();
  }
}
