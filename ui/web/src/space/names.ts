// Where names stand in the picture: above what they name, or beside that place, and never on each other.

/// Lengths in CSS pixels, y downwards.
export interface Rectangle {
  left: number;
  top: number;
  width: number;
  height: number;
}
/// A name as large as it is drawn, and the place that it is for.
export interface Label {
  x: number;
  y: number;
  width: number;
  height: number;
}

const kGap = 2; // between two names

const is_apart = (a: Rectangle, b: Rectangle): boolean =>
  a.left >= b.left + b.width + kGap || b.left >= a.left + a.width + kGap || a.top >= b.top + b.height + kGap || b.top >= a.top + a.height + kGap;

/// What a name may cover, the best first: above its place, half aside from there, or over it. A name is moved into the picture where
/// its place is near the edge.
function places_for({ x, y, width, height }: Label, frame: { width: number; height: number }): Rectangle[] {
  const all: Rectangle[] = [];
  for (const down of [-1, 0.15])
    for (const aside of [0, -0.35, 0.35]) {
      const left = x - width / 2 + aside * width,
        top = y + down * height;
      all.push({ left: Math.min(Math.max(left, 0), frame.width - width), top: Math.min(Math.max(top, 0), frame.height - height), width, height });
    }
  return all;
}

/// A place for each name, in the order in which they come; null for those that find no room.
export function placed(labels: Label[], taken: Rectangle[], frame: { width: number; height: number }): (Rectangle | null)[] {
  const all = [...taken];
  return labels.map((label) => {
    const isSeen = label.x >= 0 && label.x <= frame.width && label.y >= 0 && label.y <= frame.height;
    if (!isSeen || label.width > frame.width || label.height > frame.height) return null;
    const found = places_for(label, frame).find((one) => all.every((other) => is_apart(one, other))) ?? null;
    if (found) all.push(found);
    return found;
  });
}
