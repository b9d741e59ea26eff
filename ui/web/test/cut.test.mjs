// The model of a proposal cut above a level: laws of what stands below the cut.
import assert from "node:assert/strict";
import test from "node:test";
import { cut_shapes, rings_of, surface_body } from "../../../build/web_test/modules.mjs";

const triangles = ({ places }) => Array.from({ length: places.length / 9 }, (_, i) => [0, 3, 6].map((k) => places.slice(9 * i + k, 9 * i + k + 3)));
// What lies in the plane through the origin adds nothing, such as the underside that is left out.
const volume = (body) =>
  triangles(body).reduce((sum, [a, b, c]) => sum + (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6, 0);
const heights = (body) => body.places.filter((_, i) => i % 3 === 2);

// Twenty by ten metres with a courtyard of four by four, its south-west corner at (100, 50); and the same without the courtyard.
const kPlate = "m1000-500l200 0 0-100-200 0zm80-70l40 0 0 40-40 0z",
  kWhole = "m1000-500l200 0 0-100-200 0z";
const storey = (number, path, bottom, top) => ({ number, level: number, bottom, top, area: 0, path });
const proposal = {
  paths: [kPlate, kWhole],
  buildings: [
    { id: "house", storeys: [0, 1, 2].map((k) => storey(k, 0, 3 * k, 3 * k + 3)), cellars: [-1, -2].map((k) => storey(k, 1, 3 * k, 3 * k + 3)) },
    { id: "shed", storeys: [storey(0, 1, 0, 3)], cellars: [] },
  ],
  shapes: {
    space: { t: "space", origin: [110, 55, 0], ground: 0 },
    "n/building/house": { t: "surface" },
    "n/building/shed": { t: "surface" },
    "n/plot/site": { t: "lines" },
    "n/existing/mill": { t: "prism" },
  },
};

test("a plan is read as the exporter writes it", () => {
  const [outer, court] = rings_of(kPlate);
  assert.deepEqual(outer, [[1000, 500], [1200, 500], [1200, 600], [1000, 600]]);
  assert.deepEqual(court[0], [1080, 570], "a ring begins where the one before it began");
  assert.equal(court.length, 4);
});

test("storeys up to the level stand, with their courtyards", () => {
  for (const [level, high] of [[0, 3], [1, 6], [2, 9], [7, 9]]) {
    const shapes = cut_shapes(proposal, level),
      body = surface_body(shapes["n/building/house"]);
    assert.ok(Math.abs(volume(body) - high * (20 * 10 - 4 * 4)) < 1e-6, `${volume(body)}`);
    assert.equal(Math.max(...heights(body)), high);
    assert.ok(body.places.every((value, i) => i % 3 !== 0 || Math.abs(value) <= 10), "around the origin of the shapes");
    assert.equal(shapes.space, proposal.shapes.space);
    assert.ok(shapes["n/existing/mill"] && shapes["n/plot/site"]);
  }
});

test("below the ground the site lies open", () => {
  const shapes = cut_shapes(proposal, -1),
    body = surface_body(shapes["n/building/house"]);
  assert.deepEqual([Math.min(...heights(body)), Math.max(...heights(body))], [-6, 0]);
  assert.equal(shapes.space.ground, -600);
  assert.equal(shapes["n/building/shed"], undefined, "it has no cellar");
  assert.equal(shapes["n/existing/mill"], undefined, "it would float");
  assert.ok(shapes["n/plot/site"]);
  const lower = surface_body(cut_shapes(proposal, -2)["n/building/house"]);
  assert.equal(Math.max(...heights(lower)), -3);
  // The underside that is left out, six metres below the origin, is the rest of the volume.
  assert.ok(Math.abs(volume(lower) + (6 * 20 * 10) / 3 - 3 * 20 * 10) < 1e-6, `${volume(lower)}`);
});
