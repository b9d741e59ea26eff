// The operations of one run that wait for an answer, kept in the browser's store so that a reload loses none.
import type { Deed, Json, Seen } from "./wire";

/// What the queue needs of localStorage; `set` says whether it was kept.
export interface Store {
  get(key: string): string | null;
  set(key: string, text: string): boolean;
  remove(key: string): void;
  keys(): string[];
}

/// One operation. `at` is when the person acted [ms since 1970]; `mark` and `shown` tell the page which control it came from.
export interface Item {
  id: number;
  deed: Deed;
  base: number;
  at: number;
  seen?: Seen[];
  mark?: string;
  shown?: Json;
}

/// A run with what is not answered in it, in order and without gaps.
export interface Left {
  run: string;
  next: number;
  items: Item[];
}

interface RunRecord {
  next: number;
  owner: string;
  at: number;
}

/// A page that has not said for so long that it lives is gone [ms].
export const kLease = 6000;
const kForgotten = 24 * 3600 * 1000;

function parsed<T>(text: string | null): T | null {
  if (text === null) return null;
  try {
    return JSON.parse(text) as T;
  } catch {
    return null;
  }
}

/// Numbers from 1 without gaps. Each operation has a key of its own, so that a long queue costs no more to add to than a short
/// one. Two pages never number the same run: the one whose name stands in the run's record owns it.
export class Queue {
  readonly items: Item[] = [];
  isKept = true;
  private next = 1;
  private found = 0; // the last number that this page has found in the store
  private gone = 0; // the last number that may have been sent, by this page or by the one that left it
  private isGreeted = false;

  private constructor(
    private store: Store,
    private prefix: string,
    readonly run: string,
    private owner: string,
  ) {}

  /// Takes a run for the page `owner`, with what is left in it; nothing where another living page has it.
  static take(store: Store, prefix: string, run: string, owner: string, now: number): Queue | null {
    const record = parsed<RunRecord>(store.get(`${prefix}run/${run}`));
    if (record && record.owner !== "" && record.owner !== owner && now - record.at < kLease) return null;
    const queue = new Queue(store, prefix, run, owner).read();
    queue.live(now);
    return queue;
  }

  private read(): Queue {
    const start = `${this.prefix}op/${this.run}/`;
    for (const key of this.store.keys()) {
      const item = key.startsWith(start) ? parsed<Item>(this.store.get(key)) : null;
      if (item) this.items.push(item);
    }
    this.items.sort((a, b) => a.id - b.id);
    const record = parsed<RunRecord>(this.store.get(`${this.prefix}run/${this.run}`));
    const last = this.items[this.items.length - 1];
    this.next = Math.max(record ? record.next : 1, last ? last.id + 1 : 1);
    this.found = this.gone = this.next - 1;
    return this;
  }

  /// Runs of this room that still hold operations although no living page owns them.
  static left(store: Store, prefix: string, now: number): string[] {
    const runs = new Set<string>();
    const start = `${prefix}op/`;
    for (const key of store.keys()) if (key.startsWith(start)) runs.add(key.slice(start.length).split("/")[0] ?? "");
    return [...runs].filter((run) => {
      const record = parsed<RunRecord>(store.get(`${prefix}run/${run}`));
      return !record || record.owner === "" || now - record.at >= kLease;
    });
  }

  /// A run that nobody has had before.
  static fresh(store: Store, prefix: string, run: string, owner: string, now: number): Queue {
    const queue = Queue.take(store, prefix, run, owner, now);
    if (!queue) throw new Error("a new run has an owner already");
    return queue;
  }

  /// What a page that has gone has left unanswered; nothing where all is answered.
  static leftOver(store: Store, prefix: string, owner: string, now: number): Queue | null {
    for (const run of Queue.left(store, prefix, now)) {
      const queue = Queue.take(store, prefix, run, owner, now);
      if (queue && queue.items.length > 0) return queue;
    }
    return null;
  }

  /// All that is not answered: in this run, and in those of pages that have gone.
  waiting(now: number): Left[] {
    const gone = Queue.left(this.store, this.prefix, now).filter((run) => run !== this.run);
    const others = gone.map((run) => new Queue(this.store, this.prefix, run, "").read());
    return [this as Queue, ...others]
      .filter((one) => one.items.length > 0)
      .map((one) => ({ run: one.run, next: one.next, items: one.items }));
  }

  /// Puts what another page has left into the store, as if a page here had left it. What is there already stays.
  static bring(store: Store, prefix: string, runs: Left[], now: number): void {
    for (const { run, next, items } of runs) {
      const record = parsed<RunRecord>(store.get(`${prefix}run/${run}`));
      // A page here has gone on with this run, and so has sent what was brought before.
      if (record && record.next >= next) continue;
      for (const item of items) store.set(`${prefix}op/${run}/${item.id}`, JSON.stringify(item));
      store.set(`${prefix}run/${run}`, JSON.stringify({ next, owner: "", at: now }));
    }
  }

  /// Empties all runs, and says what was in them.
  static forgetAll(store: Store, prefix: string): Item[] {
    const items: Item[] = [];
    for (const key of store.keys()) {
      const item = key.startsWith(`${prefix}op/`) ? parsed<Item>(store.get(key)) : null;
      if (item) items.push(item);
      if (key.startsWith(`${prefix}op/`) || key.startsWith(`${prefix}run/`)) store.remove(key);
    }
    return items.sort((a, b) => a.id - b.id);
  }

  /// Forgets runs of pages that have gone long ago and left nothing.
  static tidy(store: Store, prefix: string, now: number): void {
    const used = new Set(Queue.left(store, prefix, now));
    const start = `${prefix}run/`;
    for (const key of store.keys()) {
      const record = key.startsWith(start) ? parsed<RunRecord>(store.get(key)) : null;
      if (record && now - record.at > kForgotten && !used.has(key.slice(start.length))) store.remove(key);
    }
  }

  isOurs(): boolean {
    const record = parsed<RunRecord>(this.store.get(`${this.prefix}run/${this.run}`));
    return !this.isKept || (record !== null && record.owner === this.owner);
  }

  /// Says that the page lives.
  live(now: number): void {
    this.write({ next: this.next, owner: this.owner, at: now });
  }

  /// The page ends: the next one may take the run at once.
  release(now: number): void {
    if (this.isOurs() && this.isKept) this.write({ next: this.next, owner: "", at: now });
  }

  add(deed: Deed, base: number, at: number, more: { seen?: Seen[]; mark?: string; shown?: Json }): Item {
    const item: Item = { id: this.next, deed, base, at, ...more };
    this.keep(`${this.prefix}op/${this.run}/${item.id}`, JSON.stringify(item));
    this.next += 1;
    this.live(at);
    this.items.push(item);
    return item;
  }

  /// The operation goes out: from now on it says what it says.
  sends(id: number): void {
    this.gone = Math.max(this.gone, id);
  }

  /// Of a control that is moved again before the last move could be sent only the last value counts: what waits at the end says that
  /// instead, with the value that the person saw before the first move. Nothing where the last operation is another one, or was sent.
  changeLast(deed: Deed, more: { mark?: string; shown?: Json }): Item | null {
    const last = this.items[this.items.length - 1];
    if (!last || last.id <= this.gone || !more.mark?.startsWith("control/") || last.mark !== more.mark) return null;
    if (deed.t !== "op" || last.deed.t !== "op" || deed.draft !== last.deed.draft || deed.c.command !== last.deed.c.command) return null;
    last.deed = deed;
    last.shown = more.shown;
    this.keep(`${this.prefix}op/${this.run}/${last.id}`, JSON.stringify(last));
    return last;
  }

  /// The first welcome of this page: the room has answered all up to `done`. A browser that ends badly may lose the last seconds of
  /// its store; the room would take what gets the same numbers again for repetitions. So what was added here is numbered behind.
  greeted(done: number): void {
    const shift = this.isGreeted ? 0 : done - this.found;
    this.isGreeted = true;
    if (shift <= 0) return;
    for (const item of this.items.filter((one) => one.id > this.found)) {
      this.store.remove(`${this.prefix}op/${this.run}/${item.id}`);
      item.id += shift;
    }
    for (const item of this.items.filter((one) => one.id > done))
      this.keep(`${this.prefix}op/${this.run}/${item.id}`, JSON.stringify(item));
    this.next += shift;
  }

  /// The operation has its answer; nothing where it had one before.
  answered(id: number): Item | null {
    const index = this.items.findIndex((item) => item.id === id);
    if (index < 0) return null;
    this.store.remove(`${this.prefix}op/${this.run}/${id}`);
    const item = this.items.splice(index, 1)[0] ?? null;
    if (this.items.length === 0) this.isKept = true;
    return item;
  }

  /// The last number whose answer is known, with all before it.
  get lastAnswered(): number {
    const first = this.items[0];
    return (first ? first.id : this.next) - 1;
  }

  /// Forgets the run, once nothing waits in it.
  forget(): void {
    for (const item of this.items) this.store.remove(`${this.prefix}op/${this.run}/${item.id}`);
    this.items.length = 0;
    this.store.remove(`${this.prefix}run/${this.run}`);
  }

  private write(record: RunRecord): void {
    this.keep(`${this.prefix}run/${this.run}`, JSON.stringify(record));
  }

  // What does not fit stays in memory, and `isKept` tells the page to say so.
  private keep(key: string, text: string): void {
    if (!this.store.set(key, text)) this.isKept = false;
  }
}
