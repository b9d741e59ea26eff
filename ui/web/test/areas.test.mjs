// Outlines that are drawn by touches, and the pens of areas.
import assert from "node:assert/strict";
import test from "node:test";
import { crosses_itself, own_pens, size_of, tab_of_pens, touched, usual_reach, without_last, writers_of } from "../../../build/web_test/modules.mjs";

const kNothing = { corners: [], isClosed: false };
const drawn = (...places) => places.reduce((outline, place) => touched(outline, place, 2), kNothing);

test("each touch is a corner, and the first one closes the outline", () => {
  const open = drawn([0, 0], [10, 0], [10, 5]);
  assert.deepEqual(open, { corners: [[0, 0], [10, 0], [10, 5]], isClosed: false });
  assert.deepEqual(touched(open, [1, 1], 2), { ...open, isClosed: true });
  assert.deepEqual(touched(open, [1, 2], 2).corners.length, 4, "too far from the first one");
  assert.deepEqual(drawn([0, 0], [10, 0], [1, 0]).isClosed, false, "two corners are no outline");
  const closed = touched(open, [0, 0], 2);
  assert.deepEqual(touched(closed, [50, 50], 2), closed, "it is done");
  assert.deepEqual(touched(open, [10, 5], 2), open, "twice at the same place is once");
});

test("the last step is taken back", () => {
  const closed = touched(drawn([0, 0], [10, 0], [10, 5]), [0, 0], 2);
  const open = without_last(closed);
  assert.deepEqual(open, { ...closed, isClosed: false });
  assert.deepEqual(without_last(open).corners, [[0, 0], [10, 0]]);
  assert.deepEqual(without_last(kNothing), kNothing);
});

test("sizes of outlines, and those that cross themselves", () => {
  const square = [[0, 0], [10, 0], [10, 10], [0, 10]];
  assert.equal(size_of(square), 100);
  assert.equal(size_of([...square].reverse()), 100);
  const crosses = (corners, isClosed = true) => crosses_itself({ corners, isClosed });
  assert.ok(!crosses(square));
  assert.ok(crosses([[0, 0], [10, 10], [10, 0], [0, 10]]));
  assert.ok(!crosses([[0, 0], [10, 0], [10, 10], [5, 2], [0, 10]]), "a notch is fine");
  for (const few of [[], [[1, 1]], [[0, 0], [1, 0]], [[0, 0], [1, 0], [0, 1]]]) assert.ok(!crosses(few));
  assert.ok(crosses([[0, 0], [5, 5], [10, 10], [10, 0], [0, 10]]), "it crosses just in a corner");
  const half_a_u = [[0, 0], [0, 10], [2, 10], [2, 2], [8, 2], [8, 10]];
  assert.ok(!crosses(half_a_u, false), "while it is drawn it has no side back to its first corner");
  assert.ok(crosses(half_a_u));
  assert.equal(usual_reach([]), 0);
  assert.ok(usual_reach(square) > 0);
});

const kSeats = {
  1: { role: "facilitator", name: "Heron", areas: [] },
  2: { role: "designer", name: "Otter", areas: ["north", "gone"] },
  3: { role: "designer", name: "Lynx", areas: ["north"] },
  4: { role: "participant", name: "Badger", areas: ["north"] },
};
const told = (seat, { closed = false, pen = 0, controls = [] } = {}) => ({
  you: { seat, role: kSeats[seat].role, areas: kSeats[seat].areas },
  views: { room: { closed, seats: kSeats, areas: { north: { pen, asking: [] }, south: { pen: 0, asking: [] } } }, card: { controls } },
});

test("pens are for those who work in an area that there is", () => {
  assert.deepEqual(own_pens(told(2)), ["north"]);
  assert.deepEqual(own_pens(told(2, { closed: true })), []);
  for (const seat of [1, 4]) assert.deepEqual(own_pens(told(seat)), []);
  assert.equal(tab_of_pens(told(2, { controls: [{}] })), "plan");
  const holder = told(2, { controls: [{}] });
  holder.you.role = "stakeholder";
  assert.equal(tab_of_pens(holder), "card");
  holder.views.card.controls = [];
  assert.equal(tab_of_pens(holder), "plan", "there is no tab of goals");
});

test("a pen is given to those who work there, and to nobody else", () => {
  assert.deepEqual(writers_of(told(1), "north"), [2, 3]);
  assert.deepEqual(writers_of(told(1), "south"), []);
  assert.deepEqual(writers_of(told(1, { pen: 1 }), "north"), [1, 2, 3], "who has it is told of");
});
