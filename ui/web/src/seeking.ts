// Whether the server can be reached, and when a socket is opened for it.
import { ask_again } from "./timers";
import type { Timers } from "./timers";
import type { World } from "./world";

const kSlowOpen = 1500; // a socket that takes longer to open may never do so [ms]
const kMostQuestions = 6; // that have no answer yet; browsers open no more connections at once
const kUnasked = 20000; // after so long without an answer a socket is tried all the same [ms]

/// How long something is waited for that may be slow or may never come [ms]: twice as long after each that did not come in time.
export class Patience {
  constructor(
    readonly least: number,
    readonly most: number,
    public wait = least,
  ) {}

  ended(): void {
    this.wait = Math.min(this.most, 2 * this.wait);
  }

  /// It came after so long: the next one may take a few times as long.
  took(time: number): void {
    this.wait = Math.min(this.most, Math.max(this.least, 3 * time));
  }
}

/// Browsers delay the sockets of a page of which many have failed, by seconds. They do not delay questions by HTTP, so a socket is
/// opened when the server has answered one. Nobody has to pay for that: while nobody answers, a question is a packet.
export class Seeking {
  private questions = new Set<() => void>(); // whether the server is there; each is ended by calling it
  private isOpening = false; // a socket was asked for, and nobody has given it up
  private isBlind = false; // it was asked for although nobody answered
  private opened = 0; // when it was asked for
  // After so long, a socket that has not opened is given up: where a question is answered meanwhile, and where none is.
  private known = new Patience(kSlowOpen, 30000);
  private unknown = new Patience(5000, 30000);

  /// `connect` gives up the socket that is there, and calls `asked` for the next one.
  constructor(
    private world: Pick<World, "now" | "ask" | "isVisible" | "chance">,
    private timers: Timers,
    private away: () => number, // for how long there has been no connection
    private connect: (isBlind: boolean) => void,
  ) {}

  get sinceAsked(): number {
    return this.world.now() - this.opened;
  }

  /// A socket was asked for. `late` is called where it has not opened in time.
  asked(late: () => void): void {
    this.opened = this.world.now();
    this.isOpening = true;
    this.isBlind = false;
    this.timers.start("opening", this.unknown.wait, () => {
      this.unknown.ended();
      late();
    });
    // A socket that was asked for while the network was away waits long, although the network is back.
    this.timers.start("seek", kSlowOpen, () => this.seek());
  }

  /// It has opened.
  succeeded(): void {
    this.stop();
    this.known.took(this.sinceAsked);
    this.unknown.took(this.sinceAsked);
  }

  /// Asks until a socket has opened.
  seek(): void {
    // A socket that is tried blindly has its whole time.
    if (!this.timers.has("blind")) this.timers.start("blind", Math.max(kUnasked, this.unknown.wait), () => this.tryBlindly());
    if (this.questions.size < kMostQuestions) {
      const end = this.world.ask((isThere) => {
        this.questions.delete(end);
        if (isThere) this.found();
      });
      this.questions.add(end);
    }
    this.timers.start("seek", ask_again(this.away(), this.world.isVisible(), this.world.chance()), () => this.seek());
  }

  stop(): void {
    this.isOpening = false;
    for (const name of ["seek", "blind", "opening"]) this.timers.stop(name);
    for (const end of this.questions) end();
    this.questions.clear();
  }

  // The server has answered. A socket that may still be in its handshake, which takes more round trips than a question, is left to it:
  // seek() goes on asking. What was asked for while nobody answered may wait for packets that are lost.
  private found(): void {
    if (this.isOpening && !this.isBlind) {
      if (this.sinceAsked < this.known.wait) return;
      this.known.ended();
    }
    this.connect(false);
  }

  // A way that is too slow for questions, or a proxy that does not pass them on, may still take sockets. Meanwhile it goes on asking.
  private tryBlindly(): void {
    this.connect(true);
    this.isBlind = true;
    this.seek();
  }
}
