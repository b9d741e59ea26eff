// Where names stand on the plan: inside their things, else beside them, and never on each other.
import assert from "node:assert/strict";
import { test } from "node:test";
import { names_of } from "../../../build/web_test/modules.mjs";

const square = (name, kind = "volume") => ({ kind, name });
const corners = (x, y, size) => `M${x} ${y}L${x + size} ${y}L${x + size} ${y + size}L${x} ${y + size}z`;
const frame = { x: 0, y: 0, width: 200, height: 200 };
const box = (name) => [name.x - name.width / 2, name.y - name.height / 2, name.x + name.width / 2, name.y + name.height / 2];
const is_apart = (a, b) => a[2] <= b[0] || b[2] <= a[0] || a[3] <= b[1] || b[3] <= a[1];

test("names never lie on each other, and those beside a thing on no other thing", () => {
  let seed = 7;
  const random = () => (seed = (seed * 16807) % 2147483647) / 2147483647;
  let inside = 0,
    beside = 0;
  for (let round = 0; round < 300; ++round) {
    const things = Array.from({ length: 12 }, (_, i) => {
      const size = 4 + random() * 36,
        x = random() * (200 - size),
        y = random() * (200 - size);
      return { id: `n${i}`, x, y, size, item: { ...square(""), name: "Στέγη ".repeat(1 + (i % 3)).trim(), d: corners(x, y, size) } };
    });
    const names = names_of(things.map(({ id, item }) => [id, item]), [6], frame);
    for (const name of names) {
      const own = things.find(({ id }) => id === name.id),
        at = box(name);
      const isInside = name.y > own.y && name.y < own.y + own.size;
      if (isInside) ++inside;
      else ++beside;
      for (const other of names) assert.ok(other === name || is_apart(at, box(other)), "on a name");
      if (isInside) continue;
      for (const { id, x, y, size } of things) {
        const gap = id === name.id ? 0 : 3; // half a letter: nobody takes it for the name of the other
        assert.ok(is_apart(at, [x - gap, y - gap, x + size + gap, y + size + gap]), "on a thing, or too near to another");
      }
      assert.ok(at[0] >= 0 && at[1] >= 0 && at[2] <= 200 && at[3] <= 200, "outside the picture");
    }
  }
  assert.ok(inside > 100 && beside > 100, `${inside} inside, ${beside} beside`);
});

test("a name stands inside where it fits, and below where it does not", () => {
  const [large] = names_of([["a", { ...square("Hall"), d: corners(50, 50, 60) }]], [10], frame);
  assert.deepEqual([large.x, large.y], [80, 80]);
  const [small] = names_of([["a", { ...square("Library"), d: corners(50, 50, 8) }]], [10], frame);
  assert.ok(small.x === 54 && small.y > 58);
  assert.deepEqual(names_of([["a", { ...square("Tree", "building"), d: corners(50, 50, 8) }]], [10], frame), []);
});
