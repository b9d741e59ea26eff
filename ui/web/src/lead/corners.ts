// The outline of an area while somebody draws it: corners in metres, by touches or by numbers.
import { number } from "../format";
import type { Pin } from "../ui";

export type Corner = [number, number];
export interface Drawn {
  corners: Corner[];
  isClosed: boolean; ///< touches add no more corners
}
export const kLeastCorners = 3;

const far = (a: Corner, b: Corner): number => Math.hypot(a[0] - b[0], a[1] - b[1]);

/// A touch adds a corner, but for one of the first corner, which closes the outline, and one of the last corner, which was meant once.
export function touched({ corners, isClosed }: Drawn, place: Corner, reach: number): Drawn {
  const [first] = corners,
    last = corners[corners.length - 1];
  if (isClosed || first === undefined || last === undefined) return { corners: isClosed ? corners : [place], isClosed };
  if (corners.length >= kLeastCorners && far(first, place) <= reach) return { corners, isClosed: true };
  if (far(last, place) === 0) return { corners, isClosed };
  return { corners: [...corners, place], isClosed };
}

/// The last step is taken back: that it was closed, or else its last corner.
export const without_last = ({ corners, isClosed }: Drawn): Drawn => ({ corners: isClosed ? corners : corners.slice(0, -1), isClosed: false });

/// Where nobody knows how exactly fingers meet: so far a corner may be missed, of an outline of this size [m].
export function usual_reach(corners: Corner[]): number {
  const size = (k: 0 | 1): number => Math.max(...corners.map((one) => one[k])) - Math.min(...corners.map((one) => one[k]));
  return corners.length === 0 ? 0 : 0.06 * Math.hypot(size(0), size(1));
}

/// [m²]
export function size_of(corners: Corner[]): number {
  let twice = 0;
  corners.forEach(([x, y], i) => {
    const [u, v] = corners[(i + 1) % corners.length] as Corner;
    twice += x * v - u * y;
  });
  return Math.abs(twice) / 2;
}

// On which side of the line from a to b a point lies.
const side = (a: Corner, b: Corner, c: Corner): number => Math.sign((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));

// Of a point on that line.
const is_between = (a: Corner, b: Corner, c: Corner): boolean =>
  Math.min(a[0], b[0]) <= c[0] && c[0] <= Math.max(a[0], b[0]) && Math.min(a[1], b[1]) <= c[1] && c[1] <= Math.max(a[1], b[1]);

function do_meet(a: Corner, b: Corner, c: Corner, d: Corner): boolean {
  const sides = [side(a, b, c), side(a, b, d), side(c, d, a), side(c, d, b)] as const;
  if (sides[0] * sides[1] < 0 && sides[2] * sides[3] < 0) return true;
  return (
    (sides[0] === 0 && is_between(a, b, c)) ||
    (sides[1] === 0 && is_between(a, b, d)) ||
    (sides[2] === 0 && is_between(c, d, a)) ||
    (sides[3] === 0 && is_between(c, d, b))
  );
}

/// Does one of its sides meet another one that does not follow it? An outline that is still drawn has no side back to its first corner.
export function crosses_itself({ corners, isClosed }: Drawn): boolean {
  const n = corners.length,
    at = (k: number): Corner => corners[k % n] as Corner,
    sides = isClosed ? n : n - 1;
  for (let i = 0; i < sides; ++i)
    for (let k = i + 2; k < sides; ++k) {
      if (i === 0 && k === n - 1) continue;
      if (do_meet(at(i), at(i + 1), at(k), at(k + 1))) return true;
    }
  return false;
}

/// Corners as pins with their numbers.
export const pins_of = (corners: Corner[]): Pin[] =>
  corners.map(([x, y], i) => ({ id: `corner/${i}`, x, y, letter: number(i + 1), tone: i === 0 ? "mine" : "say", label: "" }));
