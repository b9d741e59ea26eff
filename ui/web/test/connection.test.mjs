// The laws of the connection, on a clock and a network of our own: each operation is applied once and answered once.
import assert from "node:assert/strict";
import test from "node:test";
import { Clock, MemoryStore, Network, Room, seeded } from "./fakes.mjs";
import { Connection, Queue, ask_again, back_off, packed, unpacked } from "../../../build/web_test/modules.mjs";

let names = 0;

/// One tab: a connection and what it has told its caller.
class Page {
  isFrozen = false;
  isVisible = true;
  thaw = [];
  answers = [];
  welcomes = 0;
  reloads = 0;
  constructor(network, store, { run = null, invite = null } = {}) {
    const { clock, chance } = network;
    this.clock = clock;
    this.connection = new Connection(
      {
        now: () => clock.time,
        set: (delay, then) => clock.set(delay, then, this),
        clear: (id) => clock.clear(id),
        open: () => network.open(this),
        ask: (then) => network.ask(this, then),
        store,
        chance,
        name: () => `name${++names}`,
        isVisible: () => this.isVisible,
      },
      { room: "BCDF", prefix: "bl1/BCDF/", run, lang: "en", views: ["room"], invite, here: "http://192.168.1.5:8080" },
      {
        changed: () => {},
        welcomed: () => this.welcomes++,
        told: () => {},
        reload: () => this.reloads++,
        answered: (item, answer) => this.answers.push({ id: item.id, value: item.deed.c?.arguments.value, ...answer }),
      },
    );
    this.connection.start();
  }
  say(value, more) {
    return this.connection.submit({ t: "op", c: { command: "set_port", arguments: { node: "a", port: "p", value } } }, more);
  }
  /// Ends as a browser ends a page that it reloads.
  end({ isOrderly = true } = {}) {
    if (isOrderly) this.connection.leave();
    const run = this.connection.queue.run;
    this.isFrozen = true;
    return run;
  }
  thawed() {
    this.isFrozen = false;
  }
}

function setting(seed = 1) {
  const clock = new Clock(),
    room = new Room(),
    network = new Network(clock, room, seeded(seed));
  return { clock, room, network, store: new MemoryStore() };
}

function expect_each_once(room, pages, values) {
  const applied = room.applied.map((one) => one.value),
    wanted = values.filter((value) => value !== "no");
  assert.deepEqual([...applied].sort(), [...wanted].sort(), "each operation is applied exactly once");
  const told = pages.flatMap((page) => page.answers).filter((answer) => answer.kind !== "elsewhere");
  const saved = told.filter((answer) => answer.kind === "saved").map((answer) => answer.value);
  assert.deepEqual([...saved].sort(), [...wanted].sort(), "each operation that was applied is told as saved, once");
  assert.equal(told.filter((answer) => answer.kind === "refused").length, values.length - wanted.length, "each refusal is told once");
}

test("operations are answered once, in order", () => {
  const { clock, room, network, store } = setting();
  const page = new Page(network, store);
  clock.run(200);
  for (const value of [1, 2, "no", 3]) page.say(value);
  clock.run(1000);
  expect_each_once(room, [page], [1, 2, "no", 3]);
  assert.deepEqual(
    page.answers.map((answer) => answer.id),
    [1, 2, 3, 4],
  );
  assert.equal(page.connection.waiting, 0);
});

test("random faults: sockets break, messages vanish and double, pages freeze and reload", () => {
  for (let seed = 1; seed <= 60; ++seed) {
    const { clock, room, network, store } = setting(seed),
      chance = network.chance;
    let page = new Page(network, store);
    const pages = [page],
      values = [];
    network.breaks = 0.05;
    network.dropSent = network.dropHeard = 0.3;
    network.double = 0.1;
    for (let step = 0; step < 150; ++step) {
      const dice = chance();
      if (dice < 0.5) {
        const value = chance() < 0.2 ? "no" : `v${step}`;
        values.push(value);
        page.say(value);
      } else if (dice < 0.56) network.isDown = !network.isDown;
      else if (dice < 0.6) {
        const run = page.end();
        page = new Page(network, store, { run });
        pages.push(page);
      } else if (dice < 0.64) {
        page.isFrozen = true;
        clock.run(chance() * 90000);
        page.isFrozen = false;
        page.thaw.splice(0).forEach((then) => then());
        page.connection.wake();
      }
      clock.run(chance() * 3000);
    }
    network.isDown = false;
    network.breaks = network.dropSent = network.dropHeard = network.double = 0;
    clock.run(60000);
    assert.equal(page.connection.waiting, 0, `seed ${seed}: nothing waits`);
    // A page that was reloaded has told nothing of what its successor was told.
    expect_each_once(room, pages, values);
  }
});

test("a thousand operations wait through an outage and a reload", () => {
  const { clock, room, network, store } = setting();
  let page = new Page(network, store);
  clock.run(200);
  network.isDown = true;
  const values = Array.from({ length: 1000 }, (_, i) => `v${i}`);
  for (const value of values.slice(0, 600)) page.say(value);
  clock.run(30000);
  const run = page.end();
  const next = new Page(network, store, { run });
  assert.equal(next.connection.waiting, 600);
  for (const value of values.slice(600)) next.say(value);
  assert.equal(next.connection.waiting, 1000);
  clock.run(20000);
  network.isDown = false;
  clock.run(200000);
  expect_each_once(room, [page, next], values);
  assert.deepEqual(
    room.applied.map((one) => one.value),
    values,
    "in order",
  );
  assert.ok(next.connection.queue.isKept);
});

test("a control that is moved again and again during an outage is one operation, with what was seen before", () => {
  const { clock, room, network, store } = setting();
  const page = new Page(network, store);
  const move = (port, value) =>
    page.connection.submit(
      { t: "op", c: { command: "set_port", arguments: { node: "a", port, value } } },
      { mark: `control/a/${port}`, shown: value, seen: [{ key: `nodes/a/${port}`, was: `before ${value}` }] },
    );
  clock.run(200);
  network.isDown = true;
  clock.run(15000);
  assert.ok(!page.connection.isOpen);
  for (let k = 0; k < 600; ++k) {
    move("p", `p${k}`);
    clock.run(100);
  }
  for (let k = 0; k < 5; ++k) move("q", `q${k}`);
  assert.equal(page.connection.waiting, 2, "each control is one");
  move("p", "p600");
  assert.equal(page.connection.waiting, 3, "in the order in which they were moved");
  assert.deepEqual(page.connection.queue.items[0].seen, [{ key: "nodes/a/p", was: "before p0" }]);
  // A reload keeps the last values, and does not change what the page before may have sent.
  const next = new Page(network, store, { run: page.end() });
  next.connection.submit({ t: "op", c: { command: "set_port", arguments: { node: "a", port: "p", value: "p601" } } }, { mark: "control/a/p" });
  assert.equal(next.connection.waiting, 4);
  network.isDown = false;
  clock.run(10000);
  assert.deepEqual(
    room.applied.map((one) => one.value),
    ["p599", "q4", "p600", "p601"],
  );
  assert.equal(next.connection.waiting, 0);
});

test("one answer for many operations is enough", () => {
  const { clock, room, network, store } = setting();
  const page = new Page(network, store),
    receive = room.receive.bind(room);
  clock.run(200);
  room.receive = (link, message) =>
    receive({ run: link.run, tell: (told) => link.tell(told.t === "ack" ? { ...told, id: room.runs.get(link.run).last } : told) }, message);
  network.latency = 100;
  for (const value of [1, 2, 3, 4]) page.say(value);
  clock.run(30000);
  expect_each_once(room, [page], [1, 2, 3, 4]);
});

test("a sender stays below the limits of the server", () => {
  const { clock, room, network, store } = setting();
  const page = new Page(network, store);
  clock.run(100);
  for (let i = 0; i < 100; ++i) page.say(i);
  clock.run(1000);
  const count = room.heard.filter((m) => m.t === "op").length;
  assert.ok(count <= 30, `${count} in the first second`);
});

test("two tabs have two runs, and the one that closes leaves its rest to the other", () => {
  const { clock, room, network, store } = setting();
  const first = new Page(network, store),
    second = new Page(network, store, { run: first.connection.queue.run });
  assert.notEqual(first.connection.queue.run, second.connection.queue.run, "a copied tab does not share the numbers");
  clock.run(500);
  network.isDown = true;
  first.say("a");
  second.say("b");
  clock.run(12000);
  first.end();
  network.isDown = false;
  clock.run(30000);
  expect_each_once(room, [first, second], ["a", "b"]);
  assert.equal(room.tokens.size, 2, "the second tab opened before there was a token to share");
});

test("a tab that was frozen while another took its run goes on with a run of its own", () => {
  const { clock, room, network, store } = setting();
  const first = new Page(network, store);
  clock.run(500);
  network.isDown = true;
  first.say("a");
  clock.run(100);
  first.isFrozen = true;
  clock.run(30000);
  network.isDown = false;
  const second = new Page(network, store);
  clock.run(20000);
  first.isFrozen = false;
  first.thaw.splice(0).forEach((then) => then());
  first.connection.wake();
  first.say("b");
  clock.run(20000);
  assert.deepEqual(room.applied.map((one) => one.value).sort(), ["a", "b"]);
  assert.deepEqual(
    first.answers.map((answer) => answer.kind),
    ["elsewhere", "saved"],
  );
  assert.equal(second.answers.length, 1);
});

test("an operation that waited for more than a minute carries what the person saw", () => {
  const { clock, room, network, store } = setting();
  const page = new Page(network, store),
    seen = [{ key: "nodes/a/name", was: "A" }];
  clock.run(200);
  page.say("at once", { seen });
  clock.run(200);
  network.isDown = true;
  page.say("early", { seen });
  clock.run(40000);
  page.say("late", { seen });
  clock.run(30000);
  network.isDown = false;
  clock.run(20000);
  const condition = Object.fromEntries(room.applied.map((one) => [one.value, one.condition]));
  assert.deepEqual(condition, { "at once": undefined, early: seen, late: undefined });
});

test("a socket that hangs is noticed: by 9 seconds while visible, by 1.5 after a wake", () => {
  const { clock, network, store } = setting();
  const page = new Page(network, store);
  clock.run(1000);
  network.isDown = true;
  const opened = network.opened;
  clock.run(9100);
  assert.ok(network.opened > opened, "visible");
  network.isDown = false;
  clock.run(10000);
  assert.equal(page.connection.stage, "open");
  page.isVisible = false;
  page.connection.sleep();
  network.isDown = true;
  const hidden = network.opened;
  clock.run(60000);
  assert.equal(network.opened, hidden, "a hidden page asks nothing");
  network.isDown = false;
  page.isVisible = true;
  page.connection.wake();
  clock.run(1000);
  assert.equal(page.connection.stage, "open");
  network.isDown = true;
  page.connection.wake();
  clock.run(1600);
  assert.ok(network.opened > hidden);
});

test("a page that wakes from a freeze keeps a socket that lives", () => {
  const { clock, network, store } = setting();
  const page = new Page(network, store);
  clock.run(5070); // the ping is out, its answer is on the way
  const opened = network.opened;
  page.isFrozen = true;
  clock.run(30000);
  page.isFrozen = false;
  clock.run(0); // the late timer runs before the messages are read
  page.thaw.splice(0).forEach((then) => then());
  clock.run(3000);
  assert.equal(network.opened, opened);
  assert.equal(page.connection.stage, "open");
});

test("sockets that fail although the server answers are tried for ever, with delays that grow to five seconds", () => {
  assert.ok(back_off(0, 0) === 0 && back_off(0, 0.999999) <= 100);
  assert.equal(back_off(1, 0.5), 200);
  assert.equal(back_off(2, 0.5), 340);
  for (let n = 1; n < 400; ++n) assert.ok(back_off(n, 0) >= 120 && back_off(n, 0.999999) <= 7000 && (n < 9 || back_off(n, 0) >= 3000));
  const { clock, network, store } = setting();
  network.isRefusing = true;
  const page = new Page(network, store);
  clock.run(60_000);
  // Chromium delays all sockets of a page once some thirty have failed within minutes.
  assert.ok(network.opened < 25, `${network.opened}`);
  clock.run(3540_000);
  assert.ok(network.opened > 500 && network.opened < 2000, `${network.opened}`);
  network.isRefusing = false;
  clock.run(8000);
  assert.equal(page.connection.stage, "open");
});

test("while the server is away sockets are rare, and who looks at the page is back within a second, however long it took", () => {
  const share = (values, part) => [...values].sort((a, b) => a - b)[Math.floor(part * values.length)];
  for (const how of ["isAway", "isDown"])
    for (const outage of [1000, 60_000, 1800_000]) {
      const times = [];
      for (let seed = 1; seed <= (outage > 100_000 ? 20 : 60); ++seed) {
        const { clock, network, room, store } = setting(seed);
        const page = new Page(network, store);
        clock.run(1000 + 37 * seed);
        network[how] = true;
        for (const link of room.links.values()) how === "isAway" && link.end(1006);
        clock.run(outage);
        if (how === "isDown" && page.connection.stage === "open") continue; // it has not been noticed yet
        const failed = network.opened;
        assert.ok(failed < 12 + outage / 5000, `${failed} sockets`);
        network[how] = false;
        const back = clock.time;
        while (page.connection.stage !== "open" && clock.time < back + 20_000) clock.run(10);
        times.push(clock.time - back);
      }
      if (times.length > 0) assert.ok(share(times, 0.95) < 1000, `${how} for ${outage} ms: ${share(times, 0.95)} ms`);
    }
});

// An encrypted socket takes three round trips to open, a question over a connection that lives takes one.
test("a socket that is slow to open is waited for, also where questions are answered sooner", () => {
  for (let trip = 100; trip <= 1200; trip += 100)
    for (let seed = 1; seed <= 10; ++seed) {
      const { clock, network, store } = setting(seed);
      Object.assign(network, { latency: trip / 2, opening: 3 * trip, asking: trip });
      const page = new Page(network, store);
      clock.run(30_000);
      assert.equal(page.connection.stage, "open", `${trip} ms`);
      assert.equal(page.welcomes, 1);
    }
});

// TCP and the handshake are two round trips, a question is one or two, hello and welcome are another one. Of slower ways the server
// sends everybody away: what it has not read after five seconds.
test("a way on which everything takes seconds connects, and stays connected when somebody looks again", () => {
  for (let trip = 1300; trip <= 4500; trip += 100)
    for (const trips of [1, 2])
      for (let seed = 1; seed <= 5; ++seed) {
        const { clock, network, room, store } = setting(seed);
        Object.assign(network, { latency: trip / 2, opening: 2 * trip, asking: trips * trip });
        const page = new Page(network, store);
        const begun = clock.time;
        while (page.connection.stage !== "open" && clock.time < begun + 120_000) clock.run(100);
        assert.ok(clock.time - begun < 60_000, `${trip} ms, a question takes ${trips}: ${clock.time - begun} ms`);
        for (let k = 0; k < 20; ++k) {
          clock.run(3000 + 500 * k);
          page.connection.wake();
        }
        assert.equal(page.welcomes, 1, `${trip} ms`);
        // It comes back sooner than it came the first time: the page has learnt how long it takes.
        for (const link of room.links.values()) link.end(1006);
        clock.run(trip / 2 + 1);
        const lost = clock.time;
        while (page.connection.stage !== "open" && clock.time < lost + 120_000) clock.run(100);
        assert.ok(clock.time - lost < 4 * trip, `${trip} ms, back after ${clock.time - lost} ms`);
      }
});

test("a socket that opens and says nothing is given up sooner at first", () => {
  const { clock, network, room, store } = setting();
  room.hello = () => {};
  new Page(network, store);
  const times = [];
  for (let opened = 0; clock.time < 1_700_000_300_000; clock.run(10))
    if (network.opened > opened) {
      opened = network.opened;
      times.push(clock.time);
    }
  const waits = times.slice(1).map((time, k) => time - times[k]);
  assert.ok(waits[0] >= 5000 && waits[0] < 6000, `${waits}`);
  assert.ok(waits.slice(4).every((wait) => wait >= 30_000 && wait < 40_000), `${waits}`);
});

test("a socket that was tried while nobody answered is not waited for once somebody does", () => {
  const { clock, network, store } = setting();
  network.isDown = true;
  const page = new Page(network, store);
  clock.run(10_000);
  for (const { opened } = network; network.opened === opened; ) clock.run(10);
  clock.run(100);
  network.isDown = false;
  clock.run(1000);
  assert.equal(page.connection.stage, "open");
});

test("a page that is hidden asks rarely, and at once when it is looked at", () => {
  assert.ok(ask_again(0, true, 0.5) < ask_again(10_000, true, 0.5) && ask_again(10_000, true, 0.999999) < 800);
  assert.equal(ask_again(0, false, 0.5), 5000);
  const { clock, network, room, store } = setting();
  const page = new Page(network, store);
  clock.run(1000);
  page.isVisible = false;
  page.connection.sleep();
  network.isAway = true;
  for (const link of room.links.values()) link.end(1006);
  clock.run(600_000);
  assert.ok(network.asked < 250, `${network.asked}`);
  network.isAway = false;
  page.isVisible = true;
  page.connection.wake();
  clock.run(200);
  assert.equal(page.connection.stage, "open");
  const { asked } = network;
  clock.run(60_000);
  assert.equal(network.asked, asked, "a connection that lives asks nothing by HTTP");
});

test("close codes", () => {
  const at = (code) => {
    const { clock, room, network, store } = setting();
    const page = new Page(network, store);
    clock.run(500);
    room.code = code;
    [...room.links.values()].forEach((link) => link.end(code));
    clock.run(1000);
    return { page, room, network, clock, store };
  };
  assert.equal(at(4403).page.connection.stage, "removed");
  const removed = at(4403);
  const opened = removed.network.opened;
  removed.clock.run(60000);
  removed.page.connection.wake();
  assert.equal(removed.network.opened, opened, "nobody who was removed comes back by themselves");
  const old = at(4426);
  assert.equal(old.page.reloads, 1);
  const again = new Page(old.network, old.store);
  old.clock.run(1000);
  assert.equal(again.reloads, 0, "reloads once");
  assert.equal(again.connection.stage, "old");
  const door = at(4401);
  assert.equal(door.page.connection.token, null, "the token is dropped");
  assert.equal(door.page.connection.stage, "door");
  door.room.code = 0;
  door.clock.run(6000);
  assert.equal(door.page.connection.stage, "open");
  for (const code of [4400, 4408, 4413, 4429, 4503]) {
    const { page, room, clock } = at(code);
    assert.equal(page.connection.stage, "waiting", `${code}`);
    room.code = 0;
    clock.run(10000);
    assert.equal(page.connection.stage, "open", `${code}`);
  }
});

test("what a lost seat has said is refused, not sent by the next seat", () => {
  const { clock, room, network, store } = setting();
  const page = new Page(network, store);
  clock.run(500);
  network.isDown = true;
  page.say("old");
  clock.run(10000);
  room.tokens.clear();
  network.isDown = false;
  clock.run(20000);
  assert.deepEqual(
    page.answers.map((answer) => [answer.kind, answer.why]),
    [["refused", "seat"]],
  );
  page.say("new");
  clock.run(1000);
  assert.deepEqual(
    room.applied.map((one) => one.value),
    ["new"],
  );
});

test("a server that has lost its memory of answers goes on from what the page knows", () => {
  const { clock, room, network, store } = setting();
  const page = new Page(network, store);
  clock.run(200);
  page.say("a");
  page.say("no");
  clock.run(500);
  room.runs.get(page.connection.queue.run).last = 1;
  page.say("b");
  clock.run(3000);
  expect_each_once(room, [page], ["a", "no", "b"]);
});

test("a browser that has lost the end of its store gives no number twice", () => {
  for (const isBusy of [false, true]) {
    const { clock, room, network, store } = setting();
    const first = new Page(network, store);
    clock.run(200);
    network.isDown = true;
    first.say("a");
    const before = new Map(store.map);
    network.isDown = false;
    clock.run(30000);
    for (const value of ["b", "c"]) first.say(value);
    clock.run(1000);
    const run = first.end({ isOrderly: false });
    store.map = before; // as the disk had it when the browser was killed
    network.isDown = isBusy;
    clock.run(10000);
    const next = new Page(network, store, { run });
    if (isBusy) next.say("said before the welcome");
    clock.run(1000);
    network.isDown = false;
    clock.run(30000);
    next.say("d");
    clock.run(3000);
    assert.deepEqual(
      room.applied.map((one) => one.value),
      ["a", "b", "c", ...(isBusy ? ["said before the welcome"] : []), "d"],
    );
    assert.equal(next.connection.waiting, 0);
  }
});

test("a room that cannot store for a moment gets the operation again", () => {
  const { clock, room, network, store } = setting();
  const page = new Page(network, store);
  clock.run(200);
  room.busy = "storage";
  page.say("a");
  page.say("b");
  clock.run(2000);
  room.busy = null;
  clock.run(15000);
  expect_each_once(room, [page], ["a", "b"]);
  room.busy = "draining";
  page.say("c");
  clock.run(200000);
  assert.equal(page.answers[page.answers.length - 1].why, "draining", "in the end the person is told");
});

test("a full store is said, and what is too large is refused at once", () => {
  const { clock, network, store } = setting();
  const page = new Page(network, store);
  clock.run(200);
  page.say("x".repeat(20000));
  assert.equal(page.answers[0].why, "size");
  network.isDown = true;
  store.limit = store.map.size;
  page.say("a");
  assert.equal(page.connection.queue.isKept, false);
  network.isDown = false;
  clock.run(30000);
  assert.equal(page.answers[1].kind, "saved");
  assert.equal(page.connection.queue.isKept, true);
});

test("a queue is read back whole, whatever else is in the store", () => {
  const store = new MemoryStore();
  store.set("bl1/BCDF/op/r/9", "{broken");
  store.set("other", "1");
  const queue = Queue.take(store, "bl1/BCDF/", "r", "me", 0);
  for (let i = 0; i < 12; ++i) queue.add({ t: "undo" }, 0, 0, {});
  queue.answered(3);
  assert.equal(queue.answered(3), null, "a second answer finds nothing");
  queue.release(0);
  const next = Queue.take(store, "bl1/BCDF/", "r", "you", 0);
  assert.deepEqual(
    next.items.map((item) => item.id),
    [1, 2, 4, 5, 6, 7, 8, 9, 10, 11, 12],
  );
  assert.equal(next.lastAnswered, 0);
  assert.equal(next.add({ t: "undo" }, 0, 0, {}).id, 13);
  assert.equal(Queue.take(store, "bl1/BCDF/", "r", "third", 100), null, "one page has a run");
});

test("runs of pages that are long gone are forgotten, but not what they left", () => {
  const store = new MemoryStore(),
    day = 24 * 3600 * 1000;
  const empty = Queue.take(store, "p/", "empty", "me", 0),
    full = Queue.take(store, "p/", "full", "you", 0);
  full.add({ t: "undo" }, 0, 0, {});
  empty.release(0);
  Queue.tidy(store, "p/", day / 2);
  assert.ok(store.get("p/run/empty"));
  Queue.tidy(store, "p/", day + 1);
  assert.equal(store.get("p/run/empty"), null);
  assert.equal(Queue.leftOver(store, "p/", "third", day + 1).items.length, 1);
});

test("what a broken socket has not answered is sent again at once", () => {
  const { clock, room, network, store } = setting();
  const page = new Page(network, store);
  clock.run(200);
  network.dropHeard = 1;
  page.say("a");
  clock.run(100);
  network.dropHeard = 0;
  [...room.links.values()].forEach((link) => link.end(1006));
  clock.run(1000);
  expect_each_once(room, [page], ["a"]);
});

test("what follows a lost operation is sent again at once", () => {
  const { clock, room, network, store } = setting();
  const page = new Page(network, store);
  clock.run(200);
  network.dropSent = 1;
  page.say("a");
  network.dropSent = 0;
  for (const value of ["b", "c", "d"]) page.say(value);
  clock.run(1000);
  expect_each_once(room, [page], ["a", "b", "c", "d"]);
  const sent = room.heard.filter((message) => message.t === "op").length;
  assert.ok(sent <= 7, `${sent} messages: each refusal does not send everything again`);
});

test("a view that is wanted between the hello and the welcome is asked for", () => {
  // At every moment of the first connection: a screen may ask for its views whenever it is drawn.
  for (let moment = 0; moment <= 100; moment += 5) {
    const { clock, room, network, store } = setting();
    const page = new Page(network, store);
    clock.run(moment);
    page.connection.want(["comments"]);
    clock.run(2000);
    const asked = room.heard.filter((m) => m.t === "hello" || m.t === "want").pop();
    assert.ok(asked.views.includes("comments"), `wanted after ${moment} ms`);
  }
});

test("what waits is sent from another address, each once, also where a part of it had arrived", () => {
  for (let seed = 1; seed < 40; ++seed) {
    const { clock, room, network, store } = setting(seed);
    const page = new Page(network, store);
    clock.run(1000);
    for (let i = 0; i < 4; ++i) page.say(i);
    clock.run(Math.floor(network.chance() * 60)); // some have arrived, and some answers are on their way
    network.isDown = true;
    for (let i = 4; i < 9; ++i) page.say(i);
    clock.run(20000);
    const waiting = unpacked(packed(page.connection.queue.waiting(clock.time)));
    assert.ok(waiting[0].items.length >= 5);
    page.end();
    network.isDown = false;
    const there = new MemoryStore();
    there.set("bl1/BCDF/token", store.get("bl1/BCDF/token"));
    Queue.bring(there, "bl1/BCDF/", waiting, clock.time);
    const other = new Page(network, there);
    other.say(9);
    clock.run(30000);
    assert.equal(other.connection.waiting, 0, `seed ${seed}`);
    assert.deepEqual(
      room.applied.map((one) => one.value),
      Array.from({ length: 10 }, (_, i) => i),
      `seed ${seed}`,
    );
  }
});
