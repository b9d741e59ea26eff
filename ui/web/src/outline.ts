// Outlines of the plan as points: where a thing lies, how large it is, and where its name can stand.

export interface Extent {
  x: number;
  y: number;
  width: number;
  height: number;
}

const kArguments: Record<string, number> = { m: 2, l: 2, h: 1, v: 1, c: 6, s: 4, q: 4, t: 2, a: 7, z: 0 };

/// The corners of SVG path data; of curves, their ends. What cannot be read ends the outline there.
export function points_of(path: string): [number, number][] {
  const tokens = path.match(/[a-zA-Z]|[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?/g) ?? [];
  const points: [number, number][] = [];
  let x = 0,
    y = 0,
    startX = 0,
    startY = 0,
    letter = "",
    at = 0;
  while (at < tokens.length) {
    const token = tokens[at] ?? "";
    if (/^[a-zA-Z]$/.test(token)) {
      letter = token;
      at += 1;
      if (letter.toLowerCase() === "z") {
        x = startX;
        y = startY;
      }
      continue;
    }
    const kind = letter.toLowerCase(),
      count = kArguments[kind];
    if (!count) break;
    const numbers = tokens.slice(at, at + count).map(Number);
    if (numbers.length < count || numbers.some((value) => Number.isNaN(value))) break;
    at += count;
    const isRelative = letter === kind;
    const last = numbers[count - 1] ?? 0,
      before = numbers[count - 2] ?? 0;
    if (kind === "h") x = isRelative ? x + last : last;
    else if (kind === "v") y = isRelative ? y + last : last;
    else {
      x = isRelative ? x + before : before;
      y = isRelative ? y + last : last;
    }
    if (kind === "m") {
      startX = x;
      startY = y;
      letter = isRelative ? "l" : "L"; // more pairs after a move are lines
    }
    points.push([x, y]);
  }
  return points;
}

export function extent_of(points: [number, number][]): Extent | null {
  if (points.length === 0) return null;
  let left = Infinity,
    right = -Infinity,
    top = Infinity,
    bottom = -Infinity;
  for (const [x, y] of points) {
    left = Math.min(left, x);
    right = Math.max(right, x);
    top = Math.min(top, y);
    bottom = Math.max(bottom, y);
  }
  return { x: left, y: top, width: right - left, height: bottom - top };
}

export function middle_of(extent: Extent): [number, number] {
  return [extent.x + extent.width / 2, extent.y + extent.height / 2];
}
