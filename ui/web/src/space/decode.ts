// Shapes as the server sends them become triangles with normals, and the lines that bound them, in metres from the origin.
import type { CellContent, LinesContent, PrismContent, SurfaceContent, TerrainContent } from "./contents";

export type Point3 = [number, number, number];
/// Triangles that share no corners, three numbers for each corner; and segments, two points each.
export interface Body {
  places: number[];
  normals: number[];
  lines: number[];
}

const kMetres = 0.01;
const kNoHeight = -1000000; // of terrain
const kCrease = Math.cos((25 * Math.PI) / 180); // edges that are less sharp are not drawn

const minus = (a: Point3, b: Point3): Point3 => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const dot = (a: Point3, b: Point3): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const along = (a: Point3, b: Point3, t: number): Point3 => [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])];
const cross = (a: Point3, b: Point3): Point3 => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
function unit(a: Point3): Point3 | null {
  const length = Math.sqrt(dot(a, a));
  return length > 1e-12 ? [a[0] / length, a[1] / length, a[2] / length] : null;
}
const normal_of = (a: Point3, b: Point3, c: Point3): Point3 | null => unit(cross(minus(b, a), minus(c, a)));

function points_in(numbers: number[], scale = kMetres): Point3[] {
  const points: Point3[] = [];
  for (let i = 0; i + 2 < numbers.length; i += 3)
    points.push([(numbers[i] as number) * scale, (numbers[i + 1] as number) * scale, (numbers[i + 2] as number) * scale]);
  return points;
}

class Builder {
  readonly body: Body = { places: [], normals: [], lines: [] };
  constructor(private readonly from: Point3 = [0, 0, 0]) {}
  corner(at: Point3, normal: Point3): void {
    this.body.places.push(at[0] + this.from[0], at[1] + this.from[1], at[2] + this.from[2]);
    this.body.normals.push(normal[0], normal[1], normal[2]);
  }
  flat(a: Point3, b: Point3, c: Point3, normal: Point3 | null = normal_of(a, b, c)): void {
    if (!normal) return;
    for (const corner of [a, b, c]) this.corner(corner, normal);
  }
  line(a: Point3, b: Point3): void {
    for (const end of [a, b]) this.body.lines.push(end[0] + this.from[0], end[1] + this.from[1], end[2] + this.from[2]);
  }
}

/// The place on the ball around the origin, on the way from a point in it to one beyond it (as core/geometry/tessellate).
export function place_on_ball(squared: number, inside: Point3, beyond: Point3): Point3 {
  const way = minus(beyond, inside),
    a = dot(way, way),
    b = dot(way, inside),
    rest = Math.max(0, squared - dot(inside, inside)),
    root = Math.sqrt(b * b + a * rest);
  if (a === 0) return inside;
  return along(inside, beyond, Math.min(1, b > 0 ? rest / (b + root) : (root - b) / a));
}

// A point of a divided face: where it lies in the plane, and where it comes to lie on the ball.
interface Divided {
  flat: Point3;
  place: Point3;
  isBeyond: boolean;
}

class CellBuilder {
  private readonly squared: number;
  private readonly corners: Point3[];
  private readonly builder: Builder;
  private targets: Point3[] = []; // of the part: its centre, then its seams
  private drawn = new Set<string>(); // edges

  constructor(
    private readonly cell: CellContent,
    private readonly steps: number,
  ) {
    const [x = 0, y = 0, z = 0, radius = 0] = cell.ball;
    this.builder = new Builder([x * kMetres, y * kMetres, z * kMetres]);
    this.squared = radius * radius * kMetres * kMetres;
    this.corners = points_in(cell.points);
  }

  made(): Body {
    const { parts, faces } = this.cell;
    let face = 0;
    for (let part = 0; part < parts.length; ) {
      const count = parts[part] as number,
        numbers = 3 * (1 + (parts[part + 1] as number));
      this.targets = points_in(parts.slice(part + 2, part + 2 + numbers));
      part += 2 + numbers;
      for (let i = 0; i < count; ++i) {
        const size = faces[face] as number;
        this.face(faces.slice(face + 1, face + 1 + size));
        face += 1 + size;
      }
    }
    return this.builder.body;
  }

  private face(ring: number[]): void {
    const points = ring.map((corner) => this.corners[corner] as Point3);
    const middle: Point3 = [0, 0, 0];
    for (const point of points) for (const k of [0, 1, 2] as const) middle[k] += point[k] / points.length;
    ring.forEach((from, i) => {
      const to = ring[(i + 1) % ring.length] as number;
      this.triangle(middle, from, to);
      this.edge(from, to);
    });
  }

  private isBeyond(point: Point3): boolean {
    return dot(point, point) > this.squared;
  }

  private divided(flat: Point3, marks: number): Divided {
    if (!this.isBeyond(flat)) return { flat, place: flat, isBeyond: false };
    const seam = marks === 0 ? 0 : 1 + Math.log2(marks & -marks);
    return { flat, place: place_on_ball(this.squared, (this.targets[seam] ?? this.targets[0]) as Point3, flat), isBeyond: true };
  }

  // The triangle between the middle of a face and one of its edges. One that lies in the ball is flat and needs no division.
  private triangle(middle: Point3, from: number, to: number): void {
    const a = this.corners[from] as Point3,
      b = this.corners[to] as Point3;
    const plane = normal_of(middle, a, b);
    if (!plane) return;
    if (![middle, a, b].some((point) => this.isBeyond(point))) return this.builder.flat(middle, a, b, plane);
    const { steps } = this,
      marks = this.cell.seams ?? [],
      first = marks[from] ?? 0,
      second = marks[to] ?? 0;
    let above: Divided[] = [this.divided(middle, 0)];
    for (let row = 1; row <= steps; ++row) {
      const left = along(middle, a, row / steps),
        right = along(middle, b, row / steps),
        isRim = row === steps;
      const below = Array.from({ length: row + 1 }, (_, i) =>
        this.divided(along(left, right, i / row), !isRim ? 0 : i === 0 ? first : i === row ? second : first & second),
      );
      for (let i = 0; i < row; ++i) {
        this.small(above[i] as Divided, below[i] as Divided, below[i + 1] as Divided, plane);
        if (i + 1 < row) this.small(above[i] as Divided, below[i + 1] as Divided, above[i + 1] as Divided, plane);
      }
      above = below;
    }
  }

  // Where the plane goes through the ball there is an edge: on one side of it lies the plane, on the other the ball.
  private small(a: Divided, b: Divided, c: Divided, plane: Point3): void {
    const flat: Point3[] = [],
      round: Point3[] = [],
      edge: Point3[] = [];
    [a, b, c].forEach((one, i, all) => {
      const next = all[(i + 1) % 3] as Divided;
      (one.isBeyond ? round : flat).push(one.place);
      if (one.isBeyond === next.isBeyond) return;
      const crossing = one.isBeyond ? place_on_ball(this.squared, next.flat, one.flat) : place_on_ball(this.squared, one.flat, next.flat);
      for (const list of [flat, round, edge]) list.push(crossing);
    });
    for (let i = 2; i < flat.length; ++i) this.builder.flat(flat[0] as Point3, flat[i - 1] as Point3, flat[i] as Point3, plane);
    for (let i = 2; i < round.length; ++i)
      for (const corner of [round[0], round[i - 1], round[i]] as Point3[]) this.builder.corner(corner, unit(corner) ?? plane);
    if (edge.length === 2) this.builder.line(edge[0] as Point3, edge[1] as Point3);
  }

  // The part of an edge that lies in the ball; two faces share it.
  private edge(from: number, to: number): void {
    const key = from < to ? `${from} ${to}` : `${to} ${from}`;
    if (this.drawn.has(key)) return;
    this.drawn.add(key);
    const a = this.corners[from] as Point3,
      b = this.corners[to] as Point3,
      way = minus(b, a);
    const p = dot(way, way),
      q = dot(a, way),
      under = q * q - p * (dot(a, a) - this.squared);
    if (p === 0 || under <= 0) return;
    const begin = Math.max(0, (-q - Math.sqrt(under)) / p),
      end = Math.min(1, (-q + Math.sqrt(under)) / p);
    if (end > begin) this.builder.line(along(a, b, begin), along(a, b, end));
  }
}

/// A cell whose faces are divided into so many steps along each side, and wrapped onto its ball.
export const cell_body = (cell: CellContent, steps: number): Body => new CellBuilder(cell, steps).made();

export function prism_body(prism: PrismContent): Body {
  const builder = new Builder(),
    low = (prism.low ?? 0) * kMetres,
    high = (prism.high ?? 0) * kMetres,
    count = prism.ring.length / 2;
  const at = (i: number, z: number): Point3 => [
    (prism.ring[2 * (i % count)] as number) * kMetres,
    (prism.ring[2 * (i % count) + 1] as number) * kMetres,
    z,
  ];
  for (let i = 0; i < count; ++i) {
    const normal = normal_of(at(i, low), at(i + 1, low), at(i + 1, low + 1));
    builder.flat(at(i, low), at(i + 1, low), at(i + 1, high), normal);
    builder.flat(at(i, low), at(i + 1, high), at(i, high), normal);
    builder.line(at(i, low), at(i + 1, low));
    builder.line(at(i, high), at(i + 1, high));
    builder.line(at(i, low), at(i, high));
    if (i === 0 || i + 1 === count) continue;
    builder.flat(at(0, high), at(i, high), at(i + 1, high));
    builder.flat(at(0, low), at(i + 1, low), at(i, low));
  }
  return builder.body;
}

export function surface_body(surface: SurfaceContent): Body {
  const builder = new Builder(),
    points = points_in(surface.points),
    sides = new Map<string, Point3>();
  for (let i = 0; i + 2 < surface.triangles.length; i += 3) {
    const corners = surface.triangles.slice(i, i + 3);
    const [a, b, c] = corners.map((corner) => points[corner]) as Point3[];
    const normal = normal_of(a as Point3, b as Point3, c as Point3);
    if (!normal) continue;
    builder.flat(a as Point3, b as Point3, c as Point3, normal);
    corners.forEach((from, k) => {
      // By place, because bodies may have a corner of their own for each side.
      const ends = [points[from] as Point3, points[corners[(k + 1) % 3] as number] as Point3];
      const key = ends.map((end) => end.join()).sort().join(" ");
      const other = sides.get(key);
      if (!other) sides.set(key, normal);
      else if (dot(other, normal) < kCrease) builder.line(ends[0] as Point3, ends[1] as Point3);
    });
  }
  return builder.body;
}

/// Streets are bands; outlines are lines.
export function lines_body(content: LinesContent): Body {
  const builder = new Builder(),
    points = points_in(content.points),
    half = ((content.width ?? 0) * kMetres) / 2;
  let begin = 0;
  for (const count of content.counts) {
    const line = points.slice(begin, begin + count);
    begin += count;
    if (half > 0) band(builder, line, half);
    else
      line.forEach((point, i) => {
        const next = line[i + 1] ?? (content.is_closed ? line[0] : undefined);
        if (next) builder.line(point, next);
      });
  }
  return builder.body;
}

// At a bend the band's sides lie on the line between the directions before and after it.
function band(builder: Builder, line: Point3[], half: number): void {
  const sides = line.map((point, i): [Point3, Point3] => {
    const before = line[Math.max(0, i - 1)] as Point3,
      after = line[Math.min(line.length - 1, i + 1)] as Point3;
    const x = after[0] - before[0],
      y = after[1] - before[1],
      length = Math.hypot(x, y) || 1;
    const across: Point3 = [(-y / length) * half, (x / length) * half, 0];
    return [
      [point[0] + across[0], point[1] + across[1], point[2]],
      [point[0] - across[0], point[1] - across[1], point[2]],
    ];
  });
  for (let i = 0; i + 1 < sides.length; ++i) {
    const [left, right] = sides[i] as [Point3, Point3],
      [nextLeft, nextRight] = sides[i + 1] as [Point3, Point3];
    builder.flat(right, nextRight, nextLeft, [0, 0, 1]);
    builder.flat(right, nextLeft, left, [0, 0, 1]);
  }
}

export function terrain_body(terrain: TerrainContent): Body {
  const builder = new Builder(),
    [x = 0, y = 0, cell = 1, columns = 1] = terrain.grid,
    { heights } = terrain,
    rows = Math.floor(heights.length / columns);
  const height = (row: number, column: number): number | null => {
    const found = row < 0 || column < 0 || row >= rows || column >= columns ? undefined : heights[row * columns + column];
    return found === undefined || found === kNoHeight ? null : found * kMetres;
  };
  const at = (row: number, column: number): Point3 | null => {
    const z = height(row, column);
    return z === null ? null : [(x + column * cell) * kMetres, (y + row * cell) * kMetres, z];
  };
  const slope = (before: number | null, here: number, after: number | null): number => {
    const span = (before === null ? 0 : 1) + (after === null ? 0 : 1);
    return span === 0 ? 0 : ((after ?? here) - (before ?? here)) / (span * cell * kMetres);
  };
  const corner = (row: number, column: number): void => {
    const place = at(row, column) as Point3,
      z = place[2];
    const east = slope(height(row, column - 1), z, height(row, column + 1)),
      north = slope(height(row - 1, column), z, height(row + 1, column));
    builder.corner(place, unit([-east, -north, 1]) as Point3);
  };
  for (let row = 0; row + 1 < rows; ++row)
    for (let column = 0; column + 1 < columns; ++column) {
      const square: [number, number][] = [[row, column], [row, column + 1], [row + 1, column + 1], [row + 1, column]];
      if (square.some(([r, c]) => height(r, c) === null)) continue;
      for (const k of [0, 1, 2, 0, 2, 3]) corner(...(square[k] as [number, number]));
    }
  return builder.body;
}
