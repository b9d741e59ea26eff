// How densely places lie on the plan: each counts one where it is, and less with the distance; lines of equal density are outlines.
import type { Extent } from "./outline";

export interface Band {
  least: number; ///< the density from which it begins
  path: string; ///< SVG path data, to be filled by the even-odd rule
}

const kReach = 0.05, // of the longer side of the plan: where a place counts for exp(-1/2)
  kSquares = 72; // along the longer side
/// Densities from which bands begin: about one place, two, three or four, and five or more close together.
export const kBands = [0.5, 1.5, 2.5, 4.5];

/// The density at each corner of a grid over the plan and around it, row by row. At its rim it is 0, so that all outlines close.
function densities(places: [number, number][], left: number, top: number, step: number, columns: number, rows: number, reach: number): number[] {
  const all: number[] = [];
  for (let row = 0; row < rows; ++row)
    for (let column = 0; column < columns; ++column) {
      const isRim = row === 0 || column === 0 || row === rows - 1 || column === columns - 1;
      let sum = 0;
      if (!isRim)
        for (const [x, y] of places) {
          const dx = left + column * step - x,
            dy = top + row * step - y;
          sum += Math.exp(-(dx * dx + dy * dy) / (2 * reach * reach));
        }
      all.push(sum);
    }
  return all;
}

// The sides of a square that a line of equal density joins, by which of its corners are above: top left 1, top right 2, bottom right 4,
// bottom left 8. Sides: top 0, right 1, bottom 2, left 3; what is above lies on the right of the line.
const kJoins: [number, number][][] = [
  [],
  [[0, 3]],
  [[1, 0]],
  [[1, 3]],
  [[2, 1]],
  [[0, 3], [2, 1]],
  [[2, 0]],
  [[2, 3]],
  [[3, 2]],
  [[0, 2]],
  [[1, 0], [3, 2]],
  [[1, 2]],
  [[3, 1]],
  [[0, 1]],
  [[3, 0]],
  [],
];

/// The bands over a plan, the lowest first; places with y downwards, as the plan has them.
export function heat(places: [number, number][], plan: Extent): Band[] {
  const long = Math.max(plan.width, plan.height, 1),
    reach = kReach * long,
    step = long / kSquares,
    margin = 4 * reach;
  const left = plan.x - margin,
    top = plan.y - margin,
    columns = Math.ceil((plan.width + 2 * margin) / step) + 2,
    rows = Math.ceil((plan.height + 2 * margin) / step) + 2;
  const all = densities(places, left, top, step, columns, rows, reach);
  return kBands.map((least) => {
    const next = new Map<number, number>(), // from the number of a side of a square to that of another
      points = new Map<number, [number, number]>();
    // A side from the corner (row, column) to the right has an even number, one downwards an odd one.
    const crossing = (side: number): void => {
      if (points.has(side)) return;
      const from = side >> 1,
        isDown = (side & 1) === 1,
        to = from + (isDown ? columns : 1),
        a = all[from] as number,
        share = (least - a) / ((all[to] as number) - a),
        row = Math.floor(from / columns),
        column = from % columns;
      points.set(side, [left + (column + (isDown ? 0 : share)) * step, top + (row + (isDown ? share : 0)) * step]);
    };
    for (let row = 0; row + 1 < rows; ++row)
      for (let column = 0; column + 1 < columns; ++column) {
        const at = row * columns + column;
        const above = [at, at + 1, at + columns + 1, at + columns].reduce((bits, corner, k) => bits | ((all[corner] as number) >= least ? 1 << k : 0), 0);
        const sides = [2 * at, 2 * (at + 1) + 1, 2 * (at + columns), 2 * at + 1];
        for (const [from, to] of kJoins[above] as [number, number][]) {
          crossing(sides[from] as number);
          crossing(sides[to] as number);
          next.set(sides[from] as number, sides[to] as number);
        }
      }
    let path = "";
    while (next.size > 0) {
      const [first] = next.keys();
      let side: number | undefined = first,
        letter = "M";
      while (side !== undefined && next.has(side)) {
        const [x, y] = points.get(side) as [number, number];
        path += `${letter}${x.toFixed(1)} ${y.toFixed(1)}`;
        letter = "L";
        const after: number | undefined = next.get(side);
        next.delete(side);
        side = after;
      }
      path += "z";
    }
    return { least, path };
  });
}
