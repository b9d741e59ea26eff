// Where the names of a plan stand: inside their volumes, or beside them where nothing else lies.
import { Extent, extent_of, middle_of, points_of } from "./outline";
import type { PlanItem, Point } from "./wire";

const kLongLine = 14; // letters; a longer name beside a thing stands in two lines

export interface Frame {
  x: number;
  y: number;
  width: number;
  height: number;
}

const extents = new WeakMap<PlanItem, Extent | null>();

/// Where a thing lies; measured once for each outline that the server sends.
export function extent(item: PlanItem): Extent | null {
  const known = extents.get(item);
  if (known !== undefined) return known;
  const found = extent_of(points_of(item.d));
  extents.set(item, found);
  return found;
}

/// The middle of a thing in the model: metres, y to the north.
export function middle(item: PlanItem): Point | null {
  const found = extent(item);
  if (!found) return null;
  const [x, y] = middle_of(found);
  return [x, -y, 0];
}

/// In one line, or in the two that are most alike.
export function lines_of(name: string, room: number): string[] {
  const words = name.split(" ");
  if (name.length <= room || words.length < 2) return [name];
  let best: string[] = [name],
    least = Infinity;
  for (let i = 1; i < words.length; ++i) {
    const lines = [words.slice(0, i).join(" "), words.slice(i).join(" ")];
    const longest = Math.max(...lines.map((line) => line.length));
    if (longest < least) [best, least] = [lines, longest];
  }
  return best;
}

export interface Name {
  id: string;
  kind: string;
  lines: string[];
  x: number;
  y: number;
  font: number;
  width: number;
  height: number;
}

// Where the name of a thing fits, if need be a little smaller.
function name_of(id: string, item: PlanItem, fonts: number[]): Name | null {
  const found = extent(item);
  if (!found || item.kind === "boundary" || item.kind === "plot" || !item.name) return null;
  const [x, y] = middle_of(found);
  const isStreet = item.kind === "street";
  for (const font of fonts) {
    const room = (isStreet ? Math.max(found.width, found.height) : found.width) / (font * 0.58);
    const lines = lines_of(item.name, room);
    const longest = Math.max(...lines.map((line) => line.length));
    if (longest > room || (!isStreet && found.height < font * 1.15 * lines.length)) continue;
    return { id, kind: item.kind, lines, x, y, font, width: longest * font * 0.58, height: lines.length * font * 1.1 };
  }
  return null;
}

// Below or above a volume that is too small for its name.
function names_beside(id: string, item: PlanItem, font: number): Name[] {
  const found = item.kind === "volume" ? extent(item) : null;
  if (!found || !item.name) return [];
  const [x] = middle_of(found),
    lines = lines_of(item.name, kLongLine);
  const width = Math.max(...lines.map((line) => line.length)) * font * 0.58,
    height = lines.length * font * 1.1,
    far = height / 2 + font * 0.15;
  return [found.y + found.height + far, found.y - far].map((y) => ({ id, kind: item.kind, lines, x, y, font, width, height }));
}

const is_apart = (one: Name, other: Name): boolean =>
  Math.abs(one.x - other.x) * 2 >= one.width + other.width || Math.abs(one.y - other.y) * 2 >= one.height + other.height;

// A name beside a thing keeps away from others, so that nobody takes it for theirs, and does not leave the picture.
function is_on_nothing(name: Name, items: [string, PlanItem][], frame: Frame): boolean {
  const left = name.x - name.width / 2,
    top = name.y - name.height / 2;
  const isInside =
    left >= frame.x && left + name.width <= frame.x + frame.width && top >= frame.y && top + name.height <= frame.y + frame.height;
  return (
    isInside &&
    items.every(([id, item]) => {
      const found = item.kind === "volume" || item.kind === "building" ? extent(item) : null;
      const gap = id === name.id ? 0 : name.font * 0.6;
      return (
        !found ||
        left >= found.x + found.width + gap ||
        left + name.width <= found.x - gap ||
        top >= found.y + found.height + gap ||
        top + name.height <= found.y - gap
      );
    })
  );
}

/// What lies on top gets its name first; a name that would lie on another is left out, and a touch tells it. Names that fit into
/// their things come before those that stand beside them.
export function names_of(items: [string, PlanItem][], fonts: number[], frame: Frame): Name[] {
  const names: Name[] = [],
    without: [string, PlanItem][] = [];
  for (const [id, item] of [...items].reverse()) {
    const name = name_of(id, item, fonts);
    if (name && names.every((one) => is_apart(one, name))) names.push(name);
    else if (!name) without.push([id, item]);
  }
  for (const [id, item] of without) {
    const name = names_beside(id, item, fonts[fonts.length - 1] ?? 0).find(
      (one) => names.every((other) => is_apart(one, other)) && is_on_nothing(one, items, frame),
    );
    if (name) names.push(name);
  }
  return names;
}
