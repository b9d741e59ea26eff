// The life of a connection: it keeps one seat in a room and gives every operation exactly one answer, whatever the network does.
import { Heartbeat, kWakeWait } from "./heartbeat";
import { hello_of } from "./hello";
import { Queue, kLease } from "./queue";
import type { Item } from "./queue";
import { PresenceVoice } from "./presence";
import { Patience, Seeking } from "./seeking";
import { Timers, back_off, hold_off, kLongestWait } from "./timers";
import type { Deed, Json, Nack, Seen, ViewName, Welcome } from "./wire";
import type { Answer, Link, Listener, Options, Stage, World } from "./world";

// Patience [ms].
const kLonely = 60000; // after so long, an operation is sent with the value that the person saw
const kSilence = 8000; // an operation without an answer on a living connection is sent again
// Below the limits of the server: 30 at once, and 10 in a second.
const kBurst = 20;
const kPerSecond = 8;
const kLargest = 16000; // of a message [bytes]
const kMostWaiting = 5000;
const kRetries = 8; // of what the server cannot take for the moment
const kCovered = 20; // answers to later operations alone, after which an earlier one counts as answered

export class Connection {
  stage: Stage = "connecting";
  since: number; ///< of the stage being "open" or not
  seq = 0; ///< the last entry that the server has told of
  queue: Queue;
  private link: Link | null = null;
  private views: Set<ViewName>;
  private attempt = 0;
  private isGreeted = false; // the welcome has come on this link
  private timers: Timers;
  private heartbeat: Heartbeat;
  private sent = new Map<number, { at: number; order: number }>(); // what has gone out on this link
  private order = 0;
  private tokens = kBurst;
  private filled = 0;
  private retries = new Map<number, number>();
  private covered = new Map<number, number>(); // how often only a later operation was answered
  private held = 0; // until then nothing is sent
  private jumped = false;
  private gapBefore = 0; // the operation that the server has missed
  private gapsDue = 0; // refusals because of it that are still to come on this link
  private isStopped = false;
  private seeking: Seeking;
  private welcoming = new Patience(5000, 30000);
  private opened = 0; // when the link was
  readonly presence: PresenceVoice;
  private looked: string[] = []; // drafts
  private asked = 0; // how many views the hello of this link has named
  private me: string;

  constructor(
    private world: World,
    private options: Options,
    private listener: Listener,
  ) {
    this.me = world.name();
    this.timers = new Timers(world);
    this.presence = new PresenceVoice(this.timers, (message) => this.send(message));
    this.since = world.now();
    this.seeking = new Seeking(
      world,
      this.timers,
      () => world.now() - this.since,
      (isBlind) => {
        if (isBlind) this.attempt = 1;
        this.connect();
      },
    );
    this.heartbeat = new Heartbeat(
      world,
      this.timers,
      (message) => this.send(message),
      () => this.reconnect(0),
    );
    this.views = new Set(options.views);
    Queue.tidy(world.store, options.prefix, world.now());
    const own = options.run === null ? null : Queue.take(world.store, options.prefix, options.run, this.me, world.now());
    this.queue = own ?? this.oldRun() ?? this.newRun();
  }

  get waiting(): number {
    return this.queue.items.length;
  }
  get isOpen(): boolean {
    return this.stage === "open";
  }
  get token(): string | null {
    return this.world.store.get(`${this.options.prefix}token`);
  }

  start(): void {
    this.connect();
    this.lives();
  }

  /// Ends the page's part in it; what waits stays in the store.
  stop(): void {
    this.isStopped = true;
    this.timers.stopAll();
    this.dropLink();
    this.queue.release(this.world.now());
  }

  /// The page leaves: the next page may go on with the run.
  leave(): void {
    this.queue.release(this.world.now());
  }

  /// Puts an operation in line. It has an answer at once where it can never be sent.
  submit(deed: Deed, more: { seen?: Seen[]; mark?: string; shown?: Json } = {}): Item {
    if (!this.queue.isOurs()) this.changeRun();
    const now = this.world.now();
    const size = new TextEncoder().encode(JSON.stringify(deed)).length;
    if (size > kLargest || this.waiting >= kMostWaiting) {
      const item: Item = { id: 0, deed, base: this.seq, at: now, ...more };
      this.listener.answered(item, { kind: "refused", why: "size", place: "", text: "", args: {} });
      return item;
    }
    const item = this.queue.changeLast(deed, more) ?? this.queue.add(deed, this.seq, now, more);
    this.pump();
    this.listener.changed();
    return item;
  }

  /// Asks for one more view.
  want(views: ViewName[]): void {
    const fresh = views.filter((view) => !this.views.has(view));
    if (fresh.length === 0) return;
    for (const view of fresh) this.views.add(view);
    if (this.isGreeted) this.sendWant();
  }

  /// Gives a view back whose first message says that it has all of it: a change that is under way is then taken for none.
  release(view: ViewName): void {
    if (this.views.delete(view) && this.isGreeted) this.sendWant();
  }

  /// The drafts that are on the screen: the server tries those.
  look(drafts: string[]): void {
    if (drafts.join() === this.looked.join()) return;
    this.looked = drafts;
    if (this.isGreeted) this.sendWant();
  }

  private sendWant(): void {
    this.send({ t: "want", views: [...this.views], ...(this.looked.length > 0 ? { drafts: this.looked } : {}) });
  }

  /// The page is looked at again, or the network is back: is the connection alive?
  wake(): void {
    if (this.isStopped || this.stage === "removed" || this.stage === "old") return;
    if (!this.queue.isOurs()) {
      this.changeRun();
      this.reconnect(0);
    } else if (this.isGreeted) {
      this.presence.change({ hidden: false });
      this.heartbeat.wake();
    } else if (this.seeking.sinceAsked > kWakeWait || !this.link) this.reconnect(0);
  }

  /// The page is hidden: phones slow its clock down, so it asks nothing.
  sleep(): void {
    this.heartbeat.stop();
    this.presence.hide();
  }

  // --- Runs ---------------------------------------------------------------------------------------------------------

  private newRun(): Queue {
    const { store, name, now } = this.world;
    return Queue.fresh(store, this.options.prefix, name(), this.me, now());
  }

  private oldRun(): Queue | null {
    return Queue.leftOver(this.world.store, this.options.prefix, this.me, this.world.now());
  }

  // A page that has nothing to send itself sends what closed pages have left, by their runs.
  private takeOver(): void {
    if (!this.isGreeted || this.waiting > 0) return;
    const old = this.oldRun();
    if (!old) return;
    this.queue.forget();
    this.queue = old;
    this.reconnect(0);
  }

  // Another page has this run, and sends what is in it.
  private changeRun(): void {
    const items = [...this.queue.items];
    this.queue = this.newRun();
    this.sent.clear();
    for (const item of items) this.listener.answered(item, { kind: "elsewhere" });
    this.listener.changed();
  }

  // --- Sockets ------------------------------------------------------------------------------------------------------

  private connect(): void {
    this.timers.stop("retry");
    this.dropLink();
    if (this.isStopped) return;
    if (this.stage !== "open" && this.stage !== "door" && this.stage !== "waiting") this.stage = "connecting";
    const link = this.world.open();
    this.link = link;
    link.onopen = () => {
      if (this.link !== link) return;
      this.seeking.succeeded();
      this.opened = this.world.now();
      this.timers.start("hello", this.welcoming.wait, () => {
        this.welcoming.ended();
        this.lost();
      });
      this.greet();
    };
    link.onmessage = (text) => {
      if (this.link === link) this.receive(text);
    };
    link.onclose = (code, reason) => {
      if (this.link === link) this.closed(code, reason);
    };
    this.seeking.asked(() => this.lost());
  }

  private dropLink(): void {
    const link = this.link;
    this.link = null;
    this.seeking.stop();
    this.isGreeted = false;
    this.heartbeat.stop();
    for (const name of ["retry", "hello", "pump", "silence", "calm"]) this.timers.stop(name);
    this.presence.gone();
    this.sent.clear();
    if (!link) return;
    link.onopen = link.onmessage = link.onclose = null;
    link.close();
  }

  private greet(): void {
    const { room, lang, invite, isBeamer, views } = this.options;
    const greeted = this.link?.greeted ?? null;
    this.asked = greeted === null ? this.views.size : views.length;
    if (greeted === this.queue.run) return;
    // Another page has taken the run since.
    if (greeted !== null) return this.reconnect(0);
    this.send(
      hello_of({
        room,
        run: this.queue.run,
        isBeamer: isBeamer ?? false,
        token: this.token,
        invite,
        unacked: this.queue.lastAnswered,
        views: [...this.views],
        lang,
      }),
    );
  }

  private lost(): void {
    this.reconnect(back_off(this.attempt, this.world.chance()));
    this.attempt += 1;
  }

  private reconnect(delay: number): void {
    this.dropLink();
    this.setStage(this.stage === "door" ? "door" : "waiting");
    if (delay <= 0) this.connect();
    // The first attempt is a socket at once: mostly nothing but the old one was lost.
    else this.timers.start("retry", delay, () => (this.attempt <= 1 ? this.connect() : this.seeking.seek()));
  }

  private setStage(stage: Stage): void {
    const wasOpen = this.stage === "open";
    if (wasOpen !== (stage === "open")) this.since = this.world.now();
    this.stage = stage;
    this.listener.changed();
  }

  private closed(code: number, reason: string): void {
    this.attempt += 1;
    const wait = back_off(this.attempt - 1, this.world.chance());
    switch (code) {
      case 4401:
        return this.noSeat();
      case 4403:
        return this.end("removed");
      case 4409:
        this.changeRun();
        return this.reconnect(wait);
      case 4426:
        return this.old();
      case 4400:
      case 4413:
      case 4429:
        return this.reconnect(Math.max(wait, kLongestWait));
      case 4503: {
        const told = /\d+/.exec(reason);
        return this.reconnect(told ? Math.min(60000, Number(told[0])) : wait);
      }
      default:
        return this.reconnect(wait);
    }
  }

  private end(stage: Stage): void {
    this.dropLink();
    this.timers.stop("retry");
    this.setStage(stage);
  }

  // The seat is gone: what waits, in whatever run, was said by that seat. It is refused, and a new seat gets a new run.
  private noSeat(): void {
    const had = this.token !== null;
    this.world.store.remove(`${this.options.prefix}token`);
    if (!had) {
      this.dropLink();
      this.setStage("door");
      this.timers.start("retry", kLongestWait, () => this.connect());
      return;
    }
    const items = Queue.forgetAll(this.world.store, this.options.prefix);
    this.queue = this.newRun();
    for (const item of items) this.listener.answered(item, { kind: "refused", why: "seat", place: "", text: "", args: {} });
    this.reconnect(0);
  }

  private old(): void {
    const { store } = this.world;
    const key = `${this.options.prefix}reloaded`;
    const before = Number(store.get(key) ?? "0"),
      now = this.world.now();
    this.end("old");
    if (now - before < 60000) return;
    store.set(key, String(now));
    this.listener.reload();
  }

  // --- Messages -----------------------------------------------------------------------------------------------------

  private send(message: object): void {
    this.link?.send(JSON.stringify(message));
  }

  private receive(text: string): void {
    let message: { t?: unknown; [key: string]: unknown };
    try {
      message = JSON.parse(text);
    } catch {
      return;
    }
    switch (message.t) {
      case "welcome":
        return this.welcome(message as unknown as Welcome);
      case "ack":
        return this.acknowledged(Number(message.id), Number(message.s), Number(message.k));
      case "nack":
        return this.refused(message as unknown as Nack);
      case "pong":
        return this.heartbeat.answered(message.n);
      case "state":
        this.seq = Math.max(this.seq, Number(message.s) || 0);
        break;
      default:
        break;
    }
    if (typeof message.t === "string") this.listener.told(message as { t: string });
  }

  private welcome(welcome: Welcome): void {
    this.timers.stop("hello");
    if (!this.isGreeted) {
      const trip = this.world.now() - this.opened;
      this.welcoming.took(trip);
      this.heartbeat.begin(trip);
    }
    this.isGreeted = true;
    this.gapsDue = 0;
    // A room that could not store for a while greets its pages again; what it has not answered is sent again.
    this.sent.clear();
    this.queue.greeted(welcome.done);
    if (welcome.token) this.world.store.set(`${this.options.prefix}token`, welcome.token);
    this.seq = Math.max(this.seq, welcome.seq);
    this.timers.start("calm", 3000, () => {
      this.attempt = 0;
      this.jumped = false;
    });
    this.listener.welcomed(welcome);
    this.setStage("open");
    this.presence.greeted(this.world.isVisible());
    // What was wanted after the hello had gone out stands in no message yet.
    if (this.views.size > this.asked || this.looked.length > 0) this.sendWant();
    this.pump();
  }

  private acknowledged(id: number, seq: number, tick: number): void {
    this.seq = Math.max(this.seq, seq || 0);
    // "All before it are decided" does not say how: a refusal may have been lost on the way. So each of those is asked for by its
    // own number, and is taken as saved only if the server answers by later numbers again and again.
    const order = this.sent.get(id)?.order ?? Infinity;
    for (const item of this.queue.items.filter((one) => one.id < id && (this.sent.get(one.id)?.order ?? Infinity) < order)) {
      const times = (this.covered.get(item.id) ?? 0) + 1;
      this.covered.set(item.id, times);
      this.sent.delete(item.id);
      if (times > kCovered) this.answer(item.id, { kind: "saved", seq, tick });
    }
    this.answer(id, { kind: "saved", seq, tick });
    this.pump();
  }

  private refused(nack: Nack): void {
    const { id, why } = nack;
    if (why === "gap") return this.gap(id, Number(nack.args?.next ?? 0));
    const item = this.queue.items.find((one) => one.id === id);
    if (!item) return;
    if (why === "rate" || why === "draining" || why === "storage") {
      const tries = (this.retries.get(id) ?? 0) + 1;
      this.retries.set(id, tries);
      if (tries <= kRetries) return this.hold(hold_off(tries, this.world.chance()), id);
    }
    this.answer(id, { kind: "refused", why, place: nack.place ?? "", text: nack.text ?? "", args: nack.args ?? {} });
  }

  private answer(id: number, answer: Answer): void {
    this.sent.delete(id);
    this.retries.delete(id);
    this.covered.delete(id);
    const item = this.queue.answered(id);
    if (!item) return;
    this.listener.answered(item, answer);
    this.listener.changed();
  }

  // An operation before `id` has not reached the server. What followed it has to go out again, once.
  private gap(id: number, next: number): void {
    const first = this.queue.items[0];
    if (!first) return;
    if (next < first.id) return this.jump();
    if (next === this.gapBefore && this.gapsDue > 0) {
      this.gapsDue -= 1;
      return;
    }
    // Each of those that have gone out after it gets the same refusal; only the first one is a reason to send again.
    this.gapBefore = next;
    this.gapsDue = [...this.sent.keys()].filter((one) => one > next && one !== id).length;
    this.unsend(next);
    this.pump();
  }

  // The server has forgotten answers that this page has: `unacked` of the next hello lets it go on. If that does not help, the
  // rest gets a new run; none of it can have been taken, because the server waits for numbers before it.
  private jump(): void {
    if (!this.jumped) {
      this.jumped = true;
      return this.reconnect(0);
    }
    const items = [...this.queue.items];
    this.queue.forget();
    this.queue = this.newRun();
    for (const item of items) this.queue.add(item.deed, item.base, item.at, item);
    this.reconnect(0);
  }

  private hold(delay: number, id: number): void {
    this.held = this.world.now() + delay;
    this.unsend(id);
    this.timers.start("pump", delay, () => this.pump());
  }

  private unsend(from: number): void {
    for (const id of [...this.sent.keys()]) if (id >= from) this.sent.delete(id);
  }

  // --- Sending ------------------------------------------------------------------------------------------------------

  // Sends what has not gone out on this link, in order, as fast as the server allows.
  private pump(): void {
    if (!this.isGreeted) return;
    const now = this.world.now();
    if (now < this.held) return this.timers.start("pump", this.held - now, () => this.pump());
    this.tokens = Math.min(kBurst, this.tokens + ((now - this.filled) / 1000) * kPerSecond);
    this.filled = now;
    for (const item of this.queue.items) {
      if (this.sent.has(item.id)) continue;
      if (this.tokens < 1) {
        this.timers.start("pump", 1000 / kPerSecond, () => this.pump());
        break;
      }
      this.tokens -= 1;
      this.queue.sends(item.id);
      this.sent.set(item.id, { at: now, order: ++this.order });
      this.send(this.messageOf(item, now));
    }
    if (this.queue.items.length > 0 && !this.timers.has("silence")) this.timers.start("silence", kSilence, () => this.silence());
  }

  private messageOf(item: Item, now: number): object {
    const isStale = item.seen !== undefined && now - item.at > kLonely;
    return { ...item.deed, id: item.id, ...(item.deed.t === "op" ? { base: item.base } : {}), ...(isStale ? { if: item.seen } : {}) };
  }

  // The connection lives, but an operation has no answer: it or its answer was lost on the way.
  private silence(): void {
    const first = this.queue.items[0];
    const went = first && this.sent.get(first.id);
    if (first && went && this.world.now() - went.at >= kSilence) this.unsend(first.id);
    this.pump();
  }

  private lives(): void {
    if (this.queue.isOurs()) this.queue.live(this.world.now());
    this.takeOver();
    this.timers.start("lives", kLease / 3, () => this.lives());
  }
}
