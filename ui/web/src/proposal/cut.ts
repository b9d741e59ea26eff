// The model cut above a level of the plans: what stands lower as upright bodies over the plans of its storeys.
import { ShapeUtils, Vector2 } from "three";
import type { SpaceContent, SurfaceContent } from "../space/contents";
import { Proposal, Storey } from "./data";

type Place = [number, number]; // in decimetres of the scene, y to the north

const last_of = <T>(list: T[]): T | undefined => list[list.length - 1];

/// The rings of a plan as the exporter writes it: steps from point to point in decimetres, y downwards.
export function rings_of(path: string): Place[][] {
  const rings: Place[][] = [];
  let at: Place = [0, 0],
    isFirst = false,
    numbers: number[] = [];
  for (const token of path.match(/[mlz]|-?(?:\d+\.?\d*|\.\d+)/g) ?? []) {
    if (token === "m") isFirst = true;
    else if (token === "z") at = [...(last_of(rings)?.[0] ?? at)];
    else if (token !== "l") numbers.push(Number(token));
    if (numbers.length < 2) continue;
    at = [at[0] + (numbers[0] as number), at[1] - (numbers[1] as number)];
    numbers = [];
    if (isFirst) rings.push([]);
    isFirst = false;
    last_of(rings)?.push([...at]);
  }
  return rings;
}

/// Twice the area that a ring encloses, below 0 where it runs clockwise [dm²].
const turned = (ring: Place[]): number =>
  ring.reduce((sum, [x, y], i) => {
    const [u, v] = ring[(i + 1) % ring.length] as Place;
    return sum + x * v - u * y;
  }, 0);

// Outer rings run counter-clockwise, and the holes of each follow it.
function faces_of(rings: Place[][]): Place[][][] {
  const faces: Place[][][] = [];
  for (const ring of rings)
    if (turned(ring) > 0 || faces.length === 0) faces.push([ring]);
    else last_of(faces)?.push(ring);
  return faces;
}

// Walls and roofs; nobody sees the underside. `low`, `high`: whole centimetres.
function add_prisms(faces: Place[][][], low: number, high: number, origin: number[], made: SurfaceContent): void {
  for (const rings of faces) {
    const first = made.points.length / 3,
      corners = rings.flat(),
      count = corners.length;
    for (const z of [low, high]) for (const [x, y] of corners) made.points.push(Math.round(10 * x - 100 * (origin[0] ?? 0)), Math.round(10 * y - 100 * (origin[1] ?? 0)), z);
    let begin = first;
    for (const ring of rings) {
      ring.forEach((_, i) => {
        const a = begin + i,
          b = begin + ((i + 1) % ring.length);
        made.triangles.push(a, b, b + count, a, b + count, a + count);
      });
      begin += ring.length;
    }
    const [outer, ...holes] = rings.map((ring) => ring.map(([x, y]) => new Vector2(x, y)));
    for (const triangle of ShapeUtils.triangulateShape(outer ?? [], holes)) for (const corner of triangle) made.triangles.push(first + count + corner);
  }
}

function body_of(storeys: Storey[], proposal: Proposal, origin: number[]): SurfaceContent {
  const [first] = storeys as [Storey];
  const made: SurfaceContent = {
    t: "surface",
    points: [],
    triangles: [],
    bottom: Math.round(100 * first.bottom),
    storey: Math.round(100 * (first.top - first.bottom)),
  };
  for (let from = 0, next = 0; from < storeys.length; from = next) {
    const { path, bottom } = storeys[from] as Storey;
    // Equal storeys one upon another are one body.
    next = from + 1;
    while (next < storeys.length && (storeys[next] as Storey).path === path) ++next;
    add_prisms(faces_of(rings_of(proposal.paths[path] ?? "")), Math.round(100 * bottom), Math.round(100 * (storeys[next - 1] as Storey).top), origin, made);
  }
  return made;
}

/// What the picture shows where all storeys above a level are taken off. Above the ground everything else stays. A cellar lies in the
/// open: the ground goes down to the deepest floor, and what stands around is left out.
export function cut_shapes(proposal: Proposal, level: number): Record<string, unknown> {
  const isBelow = level < 0,
    space = proposal.shapes["space"] as SpaceContent,
    shapes: Record<string, unknown> = {};
  for (const [key, shape] of Object.entries(proposal.shapes))
    if (!key.startsWith("n/building/") && (!isBelow || /^space$|^n\/(?:site|plot)\//.test(key))) shapes[key] = shape;
  let deepest = space.ground ?? 0;
  for (const building of proposal.buildings) {
    const all = isBelow ? [...building.cellars].reverse() : building.storeys,
      kept = all.filter((one) => one.level <= level);
    if (kept.length === 0) continue;
    shapes[`n/building/${building.id}`] = body_of(kept, proposal, space.origin);
    if (isBelow) deepest = Math.min(deepest, Math.round(100 * (kept[0] as Storey).bottom));
  }
  if (isBelow) shapes["space"] = { ...space, ground: deepest };
  return shapes;
}
