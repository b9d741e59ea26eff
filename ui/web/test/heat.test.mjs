// The heat map: laws of its bands.
import assert from "node:assert/strict";
import test from "node:test";
import { heat, kBands, points_of } from "../../../build/web_test/modules.mjs";

const kPlan = { x: 0, y: -100, width: 160, height: 100 };
function random(seed) {
  let state = seed;
  return () => ((state = (state * 48271) % 2147483647) / 2147483647);
}
const density = (places, x, y) => places.reduce((sum, [px, py]) => sum + Math.exp(-((x - px) ** 2 + (y - py) ** 2) / (2 * 8 * 8)), 0);
const rings = (path) => path.split("z").filter(Boolean).map(points_of);
// By the even-odd rule.
function contains(all, x, y) {
  let is = false;
  for (const ring of all)
    ring.forEach(([ax, ay], i) => {
      const [bx, by] = ring[(i + 1) % ring.length];
      if (ay > y !== by > y && x < ax + ((y - ay) / (by - ay)) * (bx - ax)) is = !is;
    });
  return is;
}

test("a band holds the places that are as dense, and no others", () => {
  const next = random(7);
  for (let round = 0; round < 12; ++round) {
    const places = Array.from({ length: 1 + Math.floor(12 * next()) }, () => [160 * next(), -100 * next()]);
    if (round % 2) for (let k = 0; k < 6; ++k) places.push([80 + 6 * next(), -50 + 6 * next()]);
    const bands = heat(places, kPlan);
    assert.deepEqual(bands.map((band) => band.least), kBands);
    let seen = 0;
    for (const { least, path } of bands) {
      const all = rings(path);
      for (let k = 0; k < 150; ++k) {
        const x = 160 * next(),
          y = -100 * next(),
          here = density(places, x, y);
        // Lines are straight between the corners of the grid.
        if (Math.abs(here - least) < 0.12) continue;
        assert.equal(contains(all, x, y), here > least, `${here} at ${x}, ${y}, band ${least}`);
        seen += 1;
      }
    }
    assert.ok(seen > 200);
  }
});

test("nothing said is nothing drawn; one place is the lowest band alone", () => {
  assert.ok(heat([], kPlan).every(({ path }) => path === ""));
  const one = heat([[80, -50]], kPlan);
  assert.ok(one[0].path !== "" && one.slice(1).every(({ path }) => path === ""));
  const corner = rings(heat([[0, 0]], kPlan)[0].path);
  assert.equal(corner.length, 1, "closed at the edge of the plan, too");
  const [first] = corner[0],
    last = corner[0][corner[0].length - 1];
  assert.ok(Math.hypot(first[0] - last[0], first[1] - last[1]) < 6);
});

test("five who say something at one place reach the highest band", () => {
  const five = heat(Array(5).fill([80, -50]), kPlan);
  assert.ok(five.every(({ path }) => path !== ""));
});
