// What pages tell of the person at the moment: the newest, not often, and nothing without a connection.
import assert from "node:assert/strict";
import test from "node:test";
import { PresenceVoice, Timers } from "../../../build/web_test/modules.mjs";

function voice() {
  const sent = [],
    due = new Map();
  let last = 0;
  const world = { set: (delay, then) => (due.set(++last, { delay, then }), last), clear: (timer) => due.delete(timer) };
  const one = new PresenceVoice(new Timers(world), (message) => sent.push(message));
  const pass = () => {
    const all = [...due.values()];
    due.clear();
    for (const { then } of all) then();
  };
  return { one, sent, due, pass };
}

test("nothing is told without a connection, and all of it at once with one", () => {
  const { one, sent } = voice();
  one.change({ holds: ["library"] });
  assert.equal(sent.length, 0);
  one.greeted(true);
  assert.deepEqual(sent, [{ t: "presence", n: 1, hidden: false, holds: ["library"] }]);
});

test("of many changes within a quarter of a second the newest is told", () => {
  const { one, sent, due, pass } = voice();
  one.greeted(true);
  for (let k = 0; k < 100; k++) one.change({ holds: [`n${k}`] });
  assert.equal(sent.length, 1);
  assert.deepEqual(
    [...due.values()].map(({ delay }) => delay),
    [250],
  );
  pass();
  assert.equal(sent.length, 2);
  assert.deepEqual(sent[1].holds, ["n99"]);
  pass();
  assert.equal(sent.length, 2, "and nothing twice");
});

test("a page that is hidden says so before its clock stops", () => {
  const { one, sent } = voice();
  one.greeted(true);
  one.change({ holds: ["a"] });
  one.hide();
  assert.equal(sent[sent.length - 1].hidden, true);
});

test("a new connection is told again", () => {
  const { one, sent } = voice();
  one.greeted(true);
  one.gone();
  one.change({ holds: ["b"] });
  assert.equal(sent.length, 1);
  one.greeted(false);
  assert.deepEqual(sent[1], { t: "presence", n: 2, hidden: true, holds: ["b"] });
});
