// Shapes in three dimensions: laws of what a cell becomes, and from where it is looked at.
import assert from "node:assert/strict";
import test from "node:test";
import { bounded, cell_body, eye, home, kFieldOfView, lines_body, moved, placed, prism_body, seen, surface_body, terrain_body } from "../../../build/web_test/modules.mjs";

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

test("at home all is in the picture, as much room is left on one side as on the other, and no more than there must be", () => {
  const next = random(17);
  for (let i = 0; i < 200; ++i) {
    const aspect = 0.4 + 2.2 * next();
    const corners = Array.from({ length: 5 + Math.floor(20 * next()) }, () => [300 * next(), 200 * next(), 60 * next() * next()]);
    const [low, high] = [Math.min, Math.max].map((pick) => [0, 1, 2].map((k) => pick(...corners.map((one) => one[k]))));
    const orbit = home({ low, high, corners }, aspect),
      tall = Math.tan(kFieldOfView / 2);
    // From -1 to 1 over the picture.
    const places = corners.map((corner) => {
      const [right, up, nearer] = seen(orbit, corner);
      return [right / (orbit.distance - nearer) / (tall * aspect), up / (orbit.distance - nearer) / tall];
    });
    const ends = [0, 1].map((k) => [Math.min(...places.map((one) => one[k])), Math.max(...places.map((one) => one[k]))]);
    for (const [least, most] of ends) {
      assert.ok(least > -1 && most < 1, "all of it is seen");
      assert.ok(Math.abs(least + most) < 0.02, `it stands in the middle: ${least} to ${most}`);
    }
    assert.ok(Math.max(...ends.map(([, most]) => most)) > 0.9, "it is as large as the picture lets it be");
  }
  // One tower does not make the rest small.
  const flat = [0, 100].flatMap((x) => [0, 100].map((y) => [x, y, 0])),
    box = { low: [0, 0, 0], high: [100, 100, 40] };
  const tower = [...flat, [50, 50, 40]];
  assert.ok(home({ ...box, corners: tower }, 1.5).distance < home(box, 1.5).distance);
});

const is_apart = (a, b) => a.left >= b.left + b.width || b.left >= a.left + a.width || a.top >= b.top + b.height || b.top >= a.top + a.height;

test("names of the picture never lie on each other or on what else stands there, and the first ones come first", () => {
  const next = random(23),
    frame = { width: 900, height: 600 };
  let shown = 0,
    hidden = 0,
    aside = 0;
  for (let round = 0; round < 200; ++round) {
    const taken = [{ left: 800, top: 500, width: 100, height: 100 }];
    const labels = Array.from({ length: 25 }, () => ({ x: 1100 * next() - 100, y: 800 * next() - 100, width: 40 + 220 * next(), height: next() < 0.3 ? 100 : 50 }));
    const places = placed(labels, taken, frame);
    assert.equal(places.length, labels.length);
    places.forEach((one, i) => {
      const { x, y, width, height } = labels[i];
      const isSeen = x >= 0 && x <= frame.width && y >= 0 && y <= frame.height;
      if (!one) return void (hidden += isSeen ? 1 : 0);
      assert.ok(isSeen, "what is outside has no name");
      shown += 1;
      assert.deepEqual([one.width, one.height], [width, height]);
      assert.ok(one.left >= 0 && one.top >= 0 && one.left + width <= frame.width && one.top + height <= frame.height, "inside the picture");
      for (const other of [...taken, ...places.slice(0, i).filter(Boolean)]) assert.ok(is_apart(one, other), "on another");
      if (Math.abs(one.left + width / 2 - x) > 1) aside += 1;
    });
    // Who comes first has the place that they would have alone.
    assert.deepEqual(places[0], placed([labels[0]], taken, frame)[0]);
  }
  assert.ok(shown > 1000 && hidden > 200 && aside > 50, `${shown} shown, ${hidden} hidden, ${aside} aside`);
});

test("a name stands above its place, and where that is taken beside it or over it", () => {
  const frame = { width: 400, height: 300 },
    label = { x: 200, y: 150, width: 100, height: 20 };
  const [first, second, third] = placed([label, { ...label, x: 210 }, { ...label, x: 200, y: 151 }], [], frame);
  assert.deepEqual(first, { left: 150, top: 130, width: 100, height: 20 });
  assert.ok(second && second.top > 150, "over it");
  assert.equal(third, null, "there is no room left for it");
  assert.equal(placed([{ ...label, x: 5 }], [], frame)[0].left, 0, "near the edge it is moved into the picture");
});
