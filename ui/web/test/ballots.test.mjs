// Ballots: what counts is what the room counts, and no step of filling one in makes it worse than it was.
import assert from "node:assert/strict";
import test from "node:test";
import { coins, coins_left, coins_put, dots, gap_of, rank_added, rank_moved, ranking, same } from "../../../build/web_test/modules.mjs";
import { seeded } from "./fakes.mjs";

const options = ["a", "b", "c", "d"].map((id) => ({ id, label: id.toUpperCase() }));
const question = (kind, more = {}) => ({ kind, options, points: 10, whole: true, least: 0, most: 100, ...more });
const dot = (option) => ({ place: [1, 2, 0], option });

test("an empty ballot counts in no kind", () => {
  for (const kind of ["yes_no", "rank", "coins", "dots", "slider"]) assert.notEqual(gap_of(question(kind), null), null, kind);
});

test("what is missing", () => {
  assert.equal(gap_of(question("yes_no"), "yes"), null);
  assert.deepEqual(gap_of(question("yes_no"), "perhaps"), { what: "answer", n: 1 });
  assert.deepEqual(gap_of(question("rank"), ["b", "a"]), { what: "rank_all", n: 2 });
  assert.equal(gap_of(question("rank"), ["b", "a", "d", "c"]), null);
  assert.equal(gap_of(question("rank", { whole: false }), ["b"]), null);
  assert.equal(gap_of(question("coins"), { a: 10 }), null);
  assert.equal(gap_of(question("coins"), { a: 1 }), null, "coins may be kept");
  assert.deepEqual(gap_of(question("coins"), { a: 8, b: 4 }), { what: "too_many", n: 2 });
  assert.deepEqual(gap_of(question("coins"), { a: 0 }), { what: "coins", n: 1 });
  assert.deepEqual(gap_of(question("dots", { points: 1 }), [dot("a"), dot("b")]), { what: "too_many", n: 1 });
  assert.equal(gap_of(question("slider"), 0), null, "0 is an answer");
  assert.deepEqual(gap_of(question("slider"), 101), { what: "number", n: 1 });
  assert.deepEqual(gap_of(question("slider"), NaN), { what: "number", n: 1 });
});

test("what names options that are gone is left out", () => {
  assert.deepEqual(ranking(question("rank"), ["gone", "a"]), ["a"]);
  assert.deepEqual(coins(question("coins"), { gone: 3, a: 2 }), { a: 2 });
  assert.deepEqual(dots(question("dots"), [dot("gone"), dot("a"), null, "a"]), [dot("a")]);
  assert.equal(gap_of(question("rank"), { a: 1 }).what, "rank_all", "a ballot of another kind is none");
});

test("random steps keep rankings without doubles, and coins within what there is", () => {
  const chance = seeded(7);
  for (let round = 0; round < 200; ++round) {
    let ranked = [],
      put = {};
    for (let step = 0; step < 60; ++step) {
      const id = options[Math.floor(chance() * 4)].id,
        by = chance() < 0.5 ? -1 : 1;
      ranked = chance() < 0.4 ? rank_added(question("rank"), ranked, id) : rank_moved(question("rank"), ranked, id, by);
      assert.equal(new Set(ranked).size, ranked.length);
      const before = coins_left(question("coins"), put);
      put = coins_put(question("coins"), put, id, by);
      const left = coins_left(question("coins"), put);
      assert.ok(left >= 0 && left <= 10 && Math.abs(left - before) <= 1);
      assert.ok(
        Object.values(put).every((n) => Number.isInteger(n) && n > 0),
        "coins of 0 are left out",
      );
    }
  }
});

test("moving up and down again changes nothing", () => {
  const ranked = ["a", "b", "c", "d"];
  for (const id of ["b", "c", "d"])
    assert.deepEqual(rank_moved(question("rank"), rank_moved(question("rank"), ranked, id, -1), id, 1), ranked);
  assert.deepEqual(rank_moved(question("rank"), ranked, "a", -1), ranked, "the first stays");
});

test("ballots are compared by what they say", () => {
  assert.ok(same({ a: 1, b: 2 }, { b: 2, a: 1 }));
  assert.ok(!same(["a", "b"], ["b", "a"]));
  assert.ok(!same([], {}));
  assert.ok(same([dot("a")], [dot("a")]));
  assert.ok(!same(null, 0));
});
