// What the page tells others of the person at the moment: is it looked at, and what is selected. Nothing of it is stored.
import type { Timers } from "./timers";

const kBetween = 250; // [ms]

export class PresenceVoice {
  private state: { hidden: boolean; holds: string[] } = { hidden: false, holds: [] };
  private told: string | null = null; // on this link; null: there is no link
  private order = 0;

  constructor(
    private timers: Timers,
    private send: (message: object) => void,
  ) {}

  change(change: Partial<{ hidden: boolean; holds: string[] }>): void {
    Object.assign(this.state, change);
    this.tell();
  }

  /// A page that is hidden may not be asked again by its clock, so it says so at once.
  hide(): void {
    this.timers.stop("presence");
    this.change({ hidden: true });
  }

  /// A new link: the server knows nothing yet.
  greeted(isVisible: boolean): void {
    this.told = "";
    this.change({ hidden: !isVisible });
  }

  gone(): void {
    this.timers.stop("presence");
    this.told = null;
  }

  // At most four times a second, and the newest in the end.
  private tell(): void {
    const text = JSON.stringify(this.state);
    if (this.told === null || text === this.told || this.timers.has("presence")) return;
    this.told = text;
    this.send({ t: "presence", n: ++this.order, ...this.state });
    this.timers.start("presence", kBetween, () => this.tell());
  }
}
