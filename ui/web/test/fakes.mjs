// A clock, a store, sockets and a room for tests, all in one process and without chance that is not seeded.

export function seeded(seed) {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

/// Runs what is due in order. A frozen page is one whose timers do not run while the clock goes on.
export class Clock {
  time = 1_700_000_000_000;
  #next = 1;
  #tasks = new Map();
  set(delay, then, page = null) {
    this.#tasks.set(this.#next, { due: this.time + delay, then, page });
    return this.#next++;
  }
  clear(id) {
    this.#tasks.delete(id);
  }
  run(milliseconds) {
    const end = this.time + milliseconds;
    for (;;) {
      let first = null;
      for (const [id, task] of this.#tasks)
        if (
          task.due <= end &&
          !task.page?.isFrozen &&
          (!first || task.due < first.task.due || (task.due === first.task.due && id < first.id))
        )
          first = { id, task };
      if (!first) break;
      this.#tasks.delete(first.id);
      this.time = Math.max(this.time, first.task.due);
      first.task.then();
    }
    this.time = end;
  }
}

export class MemoryStore {
  map = new Map();
  limit = Infinity;
  get(key) {
    return this.map.get(key) ?? null;
  }
  set(key, text) {
    if (this.map.size >= this.limit && !this.map.has(key)) return false;
    this.map.set(key, text);
    return true;
  }
  remove(key) {
    this.map.delete(key);
  }
  keys() {
    return [...this.map.keys()];
  }
}

/// A room that numbers, answers and remembers as the contract says. Operations whose value is "no" are refused.
export class Room {
  seq = 0;
  applied = [];
  runs = new Map();
  tokens = new Map();
  links = new Map();
  hellos = [];
  heard = [];
  hello(link, m) {
    this.hellos.push(m);
    if (this.code) return link.end(this.code);
    if (m.token && !this.tokens.has(m.token)) return link.end(4401);
    let token = m.token;
    if (!token) {
      token = `token${this.tokens.size + 1}`;
      this.tokens.set(token, this.tokens.size + 1);
    }
    const run = this.runs.get(m.run) ?? { last: 0, answers: new Map() };
    this.runs.set(m.run, run);
    run.last = Math.max(run.last, m.unacked ?? 0);
    const old = this.links.get(m.run);
    if (old && old !== link) old.end(4409);
    this.links.set(m.run, link);
    link.run = m.run;
    link.tell({
      t: "welcome",
      you: { seat: this.tokens.get(token), role: "participant", name: "Heron", colour: "#456", areas: [], card: "" },
      epoch: 1,
      seq: this.seq,
      tick: 1,
      rate: 10,
      done: run.last,
      resume: "snapshot",
      ...(m.token ? {} : { token }),
      room: { code: m.room, title: "A room" },
    });
  }
  receive(link, m) {
    this.heard.push(m);
    if (m.t === "hello") return this.hello(link, m);
    if (m.t === "ping") return link.tell({ t: "pong", n: m.n, k: 1 });
    if (!("id" in m)) return undefined;
    const run = this.runs.get(link.run);
    if (m.id <= run.last) return link.tell(run.answers.get(m.id) ?? { t: "ack", id: m.id, s: this.seq, k: 1 });
    if (m.id > run.last + 1) return link.tell({ t: "nack", id: m.id, why: "gap", place: "id", text: "", args: { next: run.last + 1 } });
    if (this.busy) return link.tell({ t: "nack", id: m.id, why: this.busy, place: "", text: "", args: {} });
    run.last = m.id;
    const value = m.c?.arguments?.value;
    this.seq += value === "no" ? 0 : 1;
    if (value !== "no") this.applied.push({ run: link.run, id: m.id, value, condition: m.if });
    const answer =
      value === "no"
        ? { t: "nack", id: m.id, why: "range", place: "value", text: "", args: { minimum: 1, maximum: 2 } }
        : { t: "ack", id: m.id, s: this.seq, k: 1 };
    run.answers.set(m.id, answer);
    return link.tell(answer);
  }
}

/// The way between: messages take time, in order. While `isDown`, sockets neither close nor deliver, as on a phone that sleeps; a
/// socket that has lost a message delivers none after it, because TCP keeps the order.
export class Network {
  isDown = false;
  dropSent = 0; // share of messages of the page that vanish although the socket lives
  dropHeard = 0; // share of messages of the server that vanish likewise
  double = 0; // share of messages that come twice
  breaks = 0; // chance that a message breaks the socket
  latency = 20;
  opening = null; // how long a socket takes to open, where that is longer than a message
  asking = null; // how long a question and its answer take, likewise
  opened = 0;
  asked = 0;
  isRefusing = false; // sockets
  isAway = false; // refuses everything
  constructor(clock, room, chance) {
    Object.assign(this, { clock, room, chance });
  }
  /// A question by HTTP: a server that refuses sockets may still answer it.
  ask(page, then) {
    this.asked += 1;
    let isWanted = true;
    const answer = (isThere) => isWanted && !page.isFrozen && then(isThere);
    const time = this.asking ?? this.latency;
    // A browser waits two seconds for it.
    this.clock.set(Math.min(time, 2000), () => {
      if (this.isDown) this.clock.set(2000, () => answer(false));
      else answer(!this.isAway && time <= 2000);
    });
    return () => {
      isWanted = false;
    };
  }
  open(page) {
    this.opened += 1;
    const { clock, room, chance } = this;
    const link = { onopen: null, onmessage: null, onclose: null, isOpen: true, inbox: [] };
    const later = (then) =>
      clock.set(this.latency, () => {
        if (this.isDown) link.isDead = true;
        if (link.isOpen && !link.isDead) then();
      });
    const deliver = (then) => (page.isFrozen ? link.inbox.push(then) : then());
    page.thaw.push(() => link.inbox.splice(0).forEach((then) => then()));
    link.end = (code, reason = "") =>
      clock.set(this.latency, () => {
        if (!link.isOpen) return;
        link.isOpen = false;
        deliver(() => link.onclose?.(code, reason));
      });
    link.tell = (message) => {
      const times = chance() < this.double ? 2 : 1;
      if (message.t !== "welcome" && chance() < this.dropHeard) return;
      for (let i = 0; i < times; ++i) later(() => deliver(() => link.onmessage?.(JSON.stringify(message))));
    };
    link.send = (text) => {
      const message = JSON.parse(text);
      if (chance() < this.breaks) return link.end(1006);
      if ("id" in message && chance() < this.dropSent) return undefined;
      const times = chance() < this.double ? 2 : 1;
      for (let i = 0; i < times; ++i) later(() => room.receive(link, message));
      return undefined;
    };
    link.close = () => {
      link.isOpen = false;
    };
    clock.set(this.opening ?? this.latency, () => {
      if (!link.isOpen) return;
      if (this.isRefusing || this.isAway) deliver(() => link.onclose?.(1006, ""));
      else if (!this.isDown) deliver(() => link.onopen?.());
    });
    return link;
  }
}
