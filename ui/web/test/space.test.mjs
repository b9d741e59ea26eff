// Shapes in three dimensions: laws of what a cell becomes, and from where it is looked at.
import assert from "node:assert/strict";
import test from "node:test";
import { bounded, cell_body, eye, home, lines_body, moved, prism_body, surface_body, terrain_body } from "../../../build/web_test/modules.mjs";

// A number from 0 to 1 that follows from a seed.
function random(seed) {
  let state = seed;
  return () => ((state = (state * 48271) % 2147483647) / 2147483647);
}
// A box around the ball's centre as a cell: corners by their bits, faces counter-clockwise from outside.
const kSides = [
  [0, 2, 3, 1],
  [4, 5, 7, 6],
  [0, 1, 5, 4],
  [2, 6, 7, 3],
  [0, 4, 6, 2],
  [1, 3, 7, 5],
];
const box = (low, high, radius, at = [0, 0, 0]) => ({
  t: "cell",
  ball: [...at, radius],
  points: Array.from({ length: 8 }, (_, i) => [0, 1, 2].map((k) => ((i >> k) & 1 ? high[k] : low[k]))).flat(),
  faces: kSides.flatMap((side) => [4, ...side]),
  parts: [6, 0, 0, 0, 0],
});
const triangles = ({ places }) => Array.from({ length: places.length / 9 }, (_, i) => [0, 3, 6].map((k) => places.slice(9 * i + k, 9 * i + k + 3)));
const volume = (body) =>
  triangles(body).reduce((sum, [a, b, c]) => sum + (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6, 0);

test("a cell that lies in its ball is the cell", () => {
  const next = random(5);
  for (let i = 0; i < 50; ++i) {
    const low = [0, 1, 2].map(() => -Math.ceil(900 * next())),
      high = [0, 1, 2].map(() => Math.ceil(900 * next()));
    const body = cell_body(box(low, high, 2000), 8);
    const expected = [0, 1, 2].reduce((product, k) => (product * (high[k] - low[k])) / 100, 1);
    assert.ok(Math.abs(volume(body) - expected) < 1e-6 * expected);
    assert.equal(triangles(body).length, 24, "nothing is divided that stays flat");
    assert.equal(body.lines.length, 12 * 6, "its twelve edges");
  }
});

test("a ball that lies in its cell is the ball", () => {
  const body = cell_body(box([-3000, -3000, -3000], [3000, 3000, 3000], 1000, [500, 0, 0]), 16);
  const expected = (4 / 3) * Math.PI * 1000;
  assert.ok(Math.abs(volume(body) / expected - 1) < 0.01, `${volume(body)} of ${expected}`);
  assert.equal(body.lines.length, 0, "it has no edges");
  for (let i = 0; i < body.places.length; i += 3) {
    const out = [body.places[i] - 5, body.places[i + 1], body.places[i + 2]];
    assert.ok(Math.abs(Math.hypot(...out) - 10) < 1e-9);
    for (const k of [0, 1, 2]) assert.ok(Math.abs(out[k] / 10 - body.normals[i + k]) < 1e-9, "its normals point away from the middle");
  }
});

test("whatever a plane cuts off a ball, the rest is closed, in the ball and in the cell", () => {
  const next = random(9);
  for (let i = 0; i < 40; ++i) {
    const low = [0, 1, 2].map(() => -200 - Math.ceil(1500 * next())),
      high = [0, 1, 2].map(() => 200 + Math.ceil(1500 * next())),
      body = cell_body(box(low, high, 1000), 8);
    for (let at = 0; at < body.places.length; at += 3) {
      const place = body.places.slice(at, at + 3);
      assert.ok(Math.hypot(...place) < 10 + 1e-9);
      place.forEach((value, k) => assert.ok(value > low[k] / 100 - 1e-9 && value < high[k] / 100 + 1e-9));
    }
    for (let at = 0; at < body.lines.length; at += 3) assert.ok(Math.hypot(...body.lines.slice(at, at + 3)) < 10 + 1e-9);
    // Closed: the areas that look each way are as large as those that look back.
    const sum = [0, 0, 0];
    for (const [a, b, c] of triangles(body)) {
      const u = b.map((value, k) => value - a[k]),
        v = c.map((value, k) => value - a[k]);
      sum[0] += u[1] * v[2] - u[2] * v[1];
      sum[1] += u[2] * v[0] - u[0] * v[2];
      sum[2] += u[0] * v[1] - u[1] * v[0];
    }
    assert.ok(Math.hypot(...sum) < 1e-6, `${sum}`);
    assert.ok(volume(body) > 0);
  }
});

test("parts have centres of their own, and corners on a seam move towards it", () => {
  // Two halves of a ball, each from its own centre; the plane between them is open and lies on a seam.
  const cell = {
    t: "cell",
    ball: [0, 0, 0, 1000],
    points: [-2000, 0, 0, 2000, 0, 0, 0, 2000, 0, 0, 0, 2000],
    faces: [3, 1, 2, 3, 3, 0, 3, 2],
    parts: [1, 0, 100, 100, 100, 1, 1, -100, 100, 100, 0, 300, 300],
    seams: [0, 0, 1, 1],
  };
  const body = cell_body(cell, 4);
  // The corner (0, 20, 0) of the second part moves towards (0, 3, 3) and not towards (-1, 1, 1): it stays in the plane x = 0.
  const second = body.places.slice(body.places.length / 2);
  const rim = [];
  for (let i = 0; i < second.length; i += 3) if (Math.abs(second[i]) < 1e-9) rim.push(second.slice(i, i + 3));
  assert.ok(rim.length >= 5, "the seam stays in its plane");
  for (const place of rim) assert.ok(Math.abs(Math.hypot(...place) - 10) < 1e-9);
});

test("prisms and surfaces enclose what they should", () => {
  const prism = prism_body({ t: "prism", ring: [0, 0, 400, 0, 400, 300, 0, 300], low: 100, high: 600 });
  assert.ok(Math.abs(volume(prism) - 60) < 1e-9);
  assert.equal(prism.lines.length, 12 * 6);
  const cube = box([0, 0, 0], [100, 100, 100], 0);
  const cut = surface_body({ t: "surface", points: cube.points, triangles: kSides.flatMap(([a, b, c, d]) => [a, b, c, a, c, d]) });
  assert.ok(Math.abs(volume(cut) - 1) < 1e-9);
  assert.equal(cut.lines.length, 12 * 6, "diagonals of flat sides are no edges");
});

test("streets are as wide as they are said to be, and outlines close", () => {
  const street = lines_body({ t: "lines", points: [0, 0, 0, 1000, 0, 0], counts: [2], width: 600 });
  assert.equal(Math.max(...street.places), 10);
  assert.deepEqual([...new Set(street.places.filter((_, i) => i % 3 === 1))].sort(), [-3, 3]);
  assert.equal(lines_body({ t: "lines", points: [0, 0, 0, 1, 0, 0, 0, 1, 0], counts: [3], is_closed: true }).lines.length, 3 * 6);
  assert.equal(lines_body({ t: "lines", points: [0, 0, 0, 1, 0, 0, 0, 1, 0], counts: [3] }).lines.length, 2 * 6);
});

test("terrain leaves out what is not known", () => {
  const heights = [0, 100, 200, 0, 100, 200, 0, 100, -1000000];
  const body = terrain_body({ t: "terrain", grid: [0, 0, 100, 3], heights });
  assert.equal(triangles(body).length, 6, "three of four squares");
  for (let i = 0; i < body.normals.length; i += 3) assert.ok(Math.abs(body.normals[i] + Math.SQRT1_2) < 1e-9, "it rises to the east");
});

test("wherever people turn and move, they see it from above and can come back", () => {
  const all = { low: [-50, -40, 0], high: [60, 70, 30] },
    next = random(3);
  let orbit = home(all, 1.4);
  for (let i = 0; i < 500; ++i) {
    orbit = moved(orbit, next() - 0.5, next() - 0.5);
    orbit = bounded({ ...orbit, azimuth: orbit.azimuth + 8 * (next() - 0.5), tilt: orbit.tilt + 3 * (next() - 0.5), distance: orbit.distance * (0.3 + 2 * next()) }, all, 1.4);
    const at = eye(orbit);
    assert.ok(at[2] > orbit.target[2], "never from below");
    assert.ok(Math.abs(Math.hypot(...at.map((value, k) => value - orbit.target[k])) - orbit.distance) < 1e-6);
    orbit.target.forEach((value, k) => assert.ok(value >= all.low[k] && value <= all.high[k]));
  }
  // Looking north, what is moved to the right goes to the east.
  const north = { ...home(all, 1), azimuth: 0 };
  assert.ok(eye(north)[1] < north.target[1]);
  assert.ok(moved(north, 0.1, 0).target[0] > north.target[0] && moved(north, 0, 0.1).target[1] > north.target[1]);
});
