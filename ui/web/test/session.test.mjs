// What the page knows: views are merged as the contract says, and own changes are shown as they stand.
import assert from "node:assert/strict";
import test from "node:test";
import { Session, whole } from "../../../build/web_test/modules.mjs";
import { Clock, MemoryStore } from "./fakes.mjs";

/// A session whose server is played by hand.
function played(store = new MemoryStore()) {
  const clock = new Clock(),
    said = [];
  let link = null,
    names = 0;
  const world = {
    now: () => clock.time,
    set: (delay, then) => clock.set(delay, then),
    clear: (id) => clock.clear(id),
    ask: () => () => {},
    open() {
      link = { send: (text) => said.push(JSON.parse(text)), close() {} };
      return link;
    },
    store,
    chance: () => 0.5,
    name: () => `${++names}`.padStart(8, "0"),
    isVisible: () => true,
  };
  const session = new Session(
    world,
    { room: "BCDF", prefix: "p/", run: null, lang: "en", views: ["room", "votes"], invite: null, here: "http://192.168.1.5:8080" },
    () => {},
    () => {},
  );
  const tell = (message) => link.onmessage(JSON.stringify(message));
  const welcome = (seq = 0) =>
    tell({
      t: "welcome",
      you: { seat: 3, role: "participant", name: "Heron" },
      epoch: 1,
      seq,
      tick: 1,
      rate: 10,
      done: 0,
      token: "t",
      room: {},
    });
  session.connection.start();
  link.onopen();
  welcome();
  const state = (view, set, drop = [], s = 1) => tell({ t: "state", view, k: 1, s, set, drop });
  return { clock, session, said, tell, welcome, state, store };
}

test("changes are merged, and the first message after a welcome replaces the view", () => {
  const { session, state, welcome } = played();
  state("figures", { a: { name: "A" }, b: { name: "B" } });
  state("figures", { b: { name: "B2" }, c: { name: "C" } }, ["a"]);
  assert.deepEqual(session.views.figures, { b: { name: "B2" }, c: { name: "C" } });
  welcome();
  assert.deepEqual(Object.keys(session.views.figures), ["b", "c"], "the old view stays until the new one comes");
  state("figures", { d: { name: "D" } });
  assert.deepEqual(session.views.figures, { d: { name: "D" } });
  state("nonsense", { x: 1 });
  assert.ok(!("nonsense" in session.views));
});

test("a value shows what the person has set until the view has read it", () => {
  const { session, state, tell } = played();
  session.command("set_port", { node: "a", port: "p", value: 5 }, { mark: "control/a/p", shown: 5 });
  assert.equal(session.shown("control/a/p", "card"), 5);
  state("card", {}, [], 9);
  tell({ t: "ack", id: 1, s: 10, k: 1 });
  assert.equal(session.mark("control/a/p").state, "saved");
  assert.equal(session.shown("control/a/p", "card"), 5, "the view is of an earlier entry");
  state("card", {}, [], 10);
  assert.equal(session.shown("control/a/p", "card"), undefined);
});

test("a refusal stays until it is seen, and can be insisted on", () => {
  const { session, tell, said } = played();
  session.command("set_port", { node: "a", port: "p", value: 5 }, { mark: "control/a/p", shown: 5, seen: [{ key: "k", was: 1 }] });
  tell({ t: "nack", id: 1, why: "stale", place: "k", text: "", args: { now: 4 } });
  assert.equal(session.refusals.length, 1);
  assert.equal(session.shown("control/a/p", "card"), undefined, "the old value is shown again");
  session.insist(session.refusals[0]);
  assert.equal(session.refusals.length, 0);
  assert.deepEqual(said[said.length - 1].c, said[said.length - 2].c);
  assert.ok(!("if" in said[said.length - 1]));
});

test("a secret ballot that the server cannot tell is remembered until the vote closes, also over a reload", () => {
  const vote = { kind: "yes_no", open: true, secret: true, mine: null, count: 0 };
  const first = played();
  first.state("votes", { v: vote });
  assert.ok(!first.session.hasVoted("v", first.session.views.votes.v));
  first.session.command("cast_vote", { node: "v", voter: "seat 3", ballot: "yes" }, { mark: "vote/v", shown: "yes" });
  assert.ok(!first.session.hasVoted("v", first.session.views.votes.v), "not before the answer");
  first.tell({ t: "ack", id: 1, s: 2, k: 1 });
  assert.ok(first.session.hasVoted("v", first.session.views.votes.v));
  assert.equal(first.session.ballotOf("v", first.session.views.votes.v), "yes");
  assert.ok(![...first.store.map].some(([key, value]) => key.includes("cast") && value.includes("yes")), "what it said is not stored");
  const next = played(first.store);
  next.state("votes", { v: vote });
  assert.ok(next.session.hasVoted("v", next.session.views.votes.v));
  assert.equal(next.session.ballotOf("v", next.session.views.votes.v), null);
  next.state("votes", { v: { ...vote, open: false } });
  next.state("votes", { v: vote });
  assert.ok(!next.session.hasVoted("v", next.session.views.votes.v), "a vote that is opened again asks again");
});

test("what the server leaves out is filled in", () => {
  assert.deepEqual(whole("plan", "n/street/x", { kind: "street", name: "X", d: "M0 0" }).figures, []);
  assert.deepEqual(
    whole("votes", "v", { kind: "dots", options: [] }).options.map((option) => option.id),
    ["plus", "minus"],
  );
  assert.deepEqual(whole("votes", "v", { kind: "rank", options: [] }).options, []);
  assert.equal(whole("votes", "v", { kind: "yes_no", leading: "" }).leading, null);
  assert.deepEqual(whole("proposals", "p", { title: "P" }).misfits, []);
  const [control] = whole("card", "controls", [{ node: "l", port: "strength", minimum: 0, maximum: 0, step: 0 }]);
  assert.deepEqual([control.value, control.minimum, control.maximum, control.label], [null, 0, 1, "strength"]);
  assert.equal(whole("room", "title", "A"), "A");
});

test("a room that greets its pages again gets what it has not answered", () => {
  const { session, said, welcome } = played();
  session.command("set_port", { node: "a", port: "p", value: 5 });
  const before = said.filter((message) => message.t === "op").length;
  welcome();
  assert.equal(said.filter((message) => message.t === "op").length, before + 1);
});

test("what is heard of the health of a room is of this connection", () => {
  const { session, tell, welcome } = played();
  assert.equal(session.health, null);
  tell({ t: "health", battery: 0.5 });
  tell({ t: "health", battery: 0.4 });
  assert.equal(session.health.battery, 0.4);
  welcome();
  assert.equal(session.health, null, "another connection may be to another laptop, or of another role");
});

test("names of new things are of the seat", () => {
  const { session } = played();
  assert.match(session.freshName("smart_volume"), /^smart_volume_3_\d+$/);
  assert.notEqual(session.freshName("a"), session.freshName("a"));
});

test("a rewind is offered only where it takes something back", () => {
  const { session, state, clock, welcome } = played();
  assert.equal(session.rewindTo(30000), null, "the page has not been here so long");
  clock.time += 31000; // no timers: nobody answers here whether the connection lives
  state("lead", { unchanged: [[0, 0]] }, [], 0);
  assert.equal(session.rewindTo(30000), null, "nothing has happened");
  welcome(5);
  state("lead", { unchanged: [[0, 5]] }, [], 5);
  assert.equal(session.rewindTo(30000), null, "people have come and said something: the model is as it was");
  state("lead", { unchanged: [[7, 7]] }, [], 7);
  assert.equal(session.rewindTo(30000), 0, "somebody has changed the model");
  state("lead", { unchanged: [[0, 0], [8, 8]] }, [], 8);
  assert.equal(session.rewindTo(30000), null, "that was taken back");
  state("lead", { unchanged: [[9, 9]] }, [], 9);
  assert.equal(session.rewindTo(30000), 0);
  clock.time += 31000; // no timers: nobody answers here whether the connection lives
  state("lead", { unchanged: [[9, 9]] }, [], 9);
  assert.equal(session.rewindTo(30000), null, "that is longer ago");
});

test("somebody who gets another role is somebody else at once", () => {
  const { session, state } = played();
  assert.equal(session.you.role, "participant");
  state("room", { seats: { 3: { role: "designer", name: "Heron", areas: ["north"], card: "" } } });
  assert.deepEqual([session.you.role, session.you.areas, session.you.name], ["designer", ["north"], "Heron"]);
  state("room", { seats: { 4: { role: "viewer", name: "Lynx" } } });
  assert.equal(session.you.role, "designer");
});
