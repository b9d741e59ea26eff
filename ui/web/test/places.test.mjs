// Other addresses of a room: which ones a page may lead to, and that the key of a seat stays behind the #.
import assert from "node:assert/strict";
import test from "node:test";
import { Queue, Session, link_to, other_places, packed, unpacked } from "../../../build/web_test/modules.mjs";
import { Clock, MemoryStore, seeded } from "./fakes.mjs";

const kHere = "http://192.168.1.5:8080",
  kThere = "http://192.168.1.7:8080";

test("whatever a server tells, only other web servers are left, and none that protects less", () => {
  const chance = seeded(7),
    schemes = ["http://", "https://", "javascript:", "data:", "file://", "ftp://", "", "//", "HTTP://"],
    hosts = ["192.168.1.7", "192.168.1.5", "room.example", "127.0.0.1", "localhost", "[fe80::1]", "a@b", "", "a b", "%", "a\\b"],
    tails = ["", ":8080", ":8080/", "/path", "?t=1", "#t=1", ":99999", ":x", "\n"];
  const some = (list) => list[Math.floor(chance() * list.length)];
  let kept = 0;
  for (let k = 0; k < 20000; ++k) {
    const here = some([kHere, "https://192.168.1.5", "http://localhost:8080"]);
    for (const place of other_places([some(schemes) + some(hosts) + some(tails)], here)) {
      const url = new URL(place);
      assert.equal(url.origin, place);
      assert.match(url.protocol, /^https?:$/);
      assert.notEqual(place, here);
      assert.ok(here.startsWith("http:") || url.protocol === "https:", `${place} from ${here}`);
      assert.ok(here.includes("localhost") || !/127\.0|localhost/.test(place), `${place} from ${here}`);
      kept += 1;
    }
  }
  assert.ok(kept > 300, `${kept}`);
  assert.deepEqual(other_places([kHere, kThere, kThere, 5, null], kHere), [kThere]);
  for (const odd of [undefined, null, "x", { 0: kThere }]) assert.deepEqual(other_places(odd, kHere), []);
});

test("the key of the seat stands in no path and no query", () => {
  for (const who of [{ token: "secret", invite: null }, { token: "secret", invite: "key", isBeamer: true }]) {
    const url = new URL(link_to(kThere, "BKRT", who));
    assert.equal(url.origin + url.pathname, `${kThere}/BKRT`);
    assert.equal(url.search, "");
    assert.ok(url.hash.includes("t=secret"));
  }
  assert.equal(link_to(kThere, "BKRT", { token: "s", invite: "k", isBeamer: true }), `${kThere}/BKRT#k=k&t=s&beamer`);
});

/// A page whose server can be switched off.
function page(store = new MemoryStore()) {
  const clock = new Clock();
  let link = null,
    isUp = true,
    answer = null;
  const world = {
    now: () => clock.time,
    set: (delay, then) => clock.set(delay, then),
    clear: (id) => clock.clear(id),
    ask(then) {
      clock.set(5, () => then(isUp));
      return () => {};
    },
    open() {
      const mine = { send: (text) => JSON.parse(text).t === "hello" && answer?.(), close() {} };
      link = mine;
      clock.set(5, () => (isUp ? mine.onopen?.() : mine.onclose?.(1006, "")));
      return mine;
    },
    store,
    chance: () => 0.5,
    name: () => "00000001",
    isVisible: () => false,
  };
  const options = { room: "BKRT", prefix: "p/", run: null, lang: "en", views: ["room"], invite: null, here: kHere };
  const session = new Session(world, options, () => {}, () => {});
  const tell = (message) => link.onmessage(JSON.stringify(message));
  const welcome = (addresses) =>
    tell({ t: "welcome", you: { seat: 1, name: "Heron" }, seq: 0, token: "secret", room: {}, ...(addresses ? { addresses } : {}) });
  const cut = () => {
    isUp = false;
    link.onclose(1006, "");
  };
  const mend = () => {
    isUp = true;
    answer = () => clock.set(5, () => welcome());
  };
  return { clock, session, store, tell, welcome, cut, mend, start: (up) => ((isUp = up), session.connection.start(), clock.run(10)) };
}

test("other addresses are offered after ten seconds without a connection, and no longer than that", () => {
  const { clock, session, start, welcome, cut, mend } = page();
  start(true);
  welcome([kHere, kThere]);
  clock.run(60000);
  assert.deepEqual(session.places(), [], "while there is a connection");
  cut();
  clock.run(9900);
  assert.deepEqual(session.places(), []);
  clock.run(200);
  assert.deepEqual(session.places(), [{ address: `${kThere}/BKRT`, link: `${kThere}/BKRT#t=secret`, takesAlong: false }]);
  mend();
  clock.run(6000);
  assert.ok(session.connection.isOpen);
  assert.deepEqual(session.places(), []);
});

test("they are kept beside the key of the seat, for a page that is loaded again", () => {
  const first = page();
  first.start(true);
  first.welcome([kHere]);
  first.tell({ t: "say", id: "addresses", args: { addresses: [kHere, kThere] } });
  assert.deepEqual(first.session.notices, [], "people are told only when they need it");
  const second = page(first.store);
  second.start(false);
  second.clock.run(10100);
  assert.deepEqual(
    second.session.places().map((one) => one.link),
    [`${kThere}/BKRT#t=secret`],
  );
});

test("a page without a seat is led nowhere", () => {
  const { clock, session, start } = page();
  start(false);
  clock.run(60000);
  assert.deepEqual(session.places(), []);
});

/// Runs with gaps, as answers leave them.
function some_runs(chance) {
  return Array.from({ length: 1 + Math.floor(chance() * 3) }, (_, r) => {
    const items = [];
    let id = Math.floor(chance() * 5);
    for (let i = 0; i < 1 + chance() * 12; ++i) {
      id += 1 + Math.floor(chance() * 3);
      const args = { text: "Wörter, 말 & <b>".repeat(1 + Math.floor(chance() * 4)) };
      items.push({ id, deed: { t: "room", e: { event: "comment", arguments: args } }, base: 3, at: 1e12 + i, mark: `comment/${id}`, shown: args });
    }
    return { run: `run${r}`, next: id + 1 + Math.floor(chance() * 3), items };
  });
}

test("what waits is the same after the way through an address, and is put into a store once", () => {
  const chance = seeded(11);
  for (let k = 0; k < 300; ++k) {
    const runs = some_runs(chance),
      text = packed(runs);
    assert.match(text, /^[\w-]+$/);
    assert.deepEqual(unpacked(text), runs);
    const store = new MemoryStore();
    Queue.bring(store, "p/", unpacked(text), 1e12);
    const own = Queue.take(store, "p/", "run0", "me", 1e12);
    assert.deepEqual(own.waiting(1e12).map((one) => one.run).sort(), runs.map((one) => one.run).sort());
    assert.deepEqual(own.waiting(1e12)[0], runs[0]);
    // The link is followed once more, after some of it was answered here: nothing comes back.
    own.answered(runs[0].items[0].id);
    const before = JSON.stringify([...store.keys()].sort());
    Queue.bring(store, "p/", unpacked(text), 1e12);
    assert.equal(JSON.stringify([...store.keys()].sort()), before);
  }
  assert.equal(packed([{ run: "a", next: 1, items: [] }]), null);
  const large = some_runs(chance);
  large[0].items[0].deed.e.arguments.text = "x".repeat(150000);
  assert.equal(packed(large), null, "a part does not travel");
});

test("whatever text an address has, it is read as whole runs or as nothing", () => {
  const chance = seeded(12),
    letters = (value) => Buffer.from(JSON.stringify(value)).toString("base64url");
  let whole = 0;
  for (let k = 0; k < 5000; ++k) {
    const text = packed(some_runs(chance)).split("");
    for (let i = 0; i < 3; ++i) text[Math.floor(chance() * text.length)] = "Aa0-_z"[Math.floor(chance() * 6)];
    for (const { run, items, next } of unpacked(text.join(""))) {
      whole += 1;
      assert.ok(/^\w+$/.test(run) && items.every((item, i) => item.id > (items[i - 1]?.id ?? 0) && item.id < next));
    }
  }
  assert.ok(whole > 0);
  const item = { id: 1, deed: { t: "op" }, base: 0, at: 1 };
  assert.equal(unpacked(letters([{ run: "a", next: 2, items: [item] }])).length, 1);
  for (const odd of [
    null,
    {},
    [null],
    [{ run: "a/b", next: 2, items: [item] }],
    [{ run: "a", next: 1, items: [item] }],
    [{ run: "a", next: 3, items: [item, item] }],
    [{ run: "a", next: 2, items: [{ ...item, deed: { t: "hello" } }] }],
    [{ run: "a", next: 2, items: [{ ...item, id: "1" }] }],
    [{ run: "a", next: 2, items: [{ ...item, mark: 5 }] }],
  ])
    assert.deepEqual(unpacked(letters(odd)), []);
  for (const text of ["", "%", "a", "x".repeat(300000)]) assert.deepEqual(unpacked(text), []);
});
