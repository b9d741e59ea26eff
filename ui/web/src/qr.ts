// QR codes of short texts: byte mode, error correction M, versions 1 to 6 (ISO/IEC 18004).

/// Codewords in all, error correction codewords of a block, and blocks, by version.
const kVersions: [number, number, number][] = [
  [26, 10, 1],
  [44, 16, 1],
  [70, 26, 1],
  [100, 18, 2],
  [134, 24, 2],
  [172, 16, 4],
];

// The field with 256 elements over x^8 + x^4 + x^3 + x^2 + 1.
const kPower: number[] = [],
  kLog: number[] = [];
for (let i = 0, x = 1; i < 255; ++i) {
  kPower[i] = x;
  kLog[x] = i;
  x = x & 0x80 ? (x << 1) ^ 0x11d : x << 1;
}
const times = (a: number, b: number): number => (a === 0 || b === 0 ? 0 : (kPower[((kLog[a] ?? 0) + (kLog[b] ?? 0)) % 255] ?? 0));

function remainder(data: number[], degree: number): number[] {
  let generator = [1];
  for (let i = 0; i < degree; ++i) {
    const next = new Array<number>(generator.length + 1).fill(0);
    generator.forEach((factor, at) => {
      next[at] = (next[at] ?? 0) ^ factor;
      next[at + 1] = (next[at + 1] ?? 0) ^ times(factor, kPower[i] ?? 0);
    });
    generator = next;
  }
  const rest = [...data, ...new Array<number>(degree).fill(0)];
  for (let i = 0; i < data.length; ++i) {
    const lead = rest[i] ?? 0;
    generator.forEach((factor, at) => (rest[i + at] = (rest[i + at] ?? 0) ^ times(factor, lead)));
  }
  return rest.slice(data.length);
}

function codewords(bytes: Uint8Array, total: number, correction: number, blocks: number): number[] {
  const capacity = total - correction * blocks,
    bits: number[] = [];
  const put = (value: number, count: number): void => {
    for (let i = count - 1; i >= 0; --i) bits.push((value >> i) & 1);
  };
  put(4, 4);
  put(bytes.length, 8);
  bytes.forEach((byte) => put(byte, 8));
  put(0, Math.min(4, capacity * 8 - bits.length));
  while (bits.length % 8 !== 0) bits.push(0);
  const data: number[] = [];
  for (let i = 0; i < bits.length; i += 8) data.push(parseInt(bits.slice(i, i + 8).join(""), 2));
  for (let i = 0; data.length < capacity; ++i) data.push(i % 2 === 0 ? 0xec : 0x11);
  // In these versions all blocks have one length but those of none; the longer ones come last.
  const short = Math.floor(capacity / blocks),
    longer = capacity % blocks,
    parts: number[][] = [];
  for (let i = 0, at = 0; i < blocks; ++i) {
    const length = short + (i >= blocks - longer ? 1 : 0);
    parts.push(data.slice(at, at + length));
    at += length;
  }
  const checks = parts.map((part) => remainder(part, correction)),
    out: number[] = [];
  for (let i = 0; i <= short; ++i) for (const part of parts) if (i < part.length) out.push(part[i] ?? 0);
  for (let i = 0; i < correction; ++i) for (const check of checks) out.push(check[i] ?? 0);
  return out;
}

type Matrix = (boolean | null)[][];

function frame(size: number): Matrix {
  const matrix: Matrix = Array.from({ length: size }, () => new Array<boolean | null>(size).fill(null));
  const set = (x: number, y: number, dark: boolean): void => {
    const row = matrix[y];
    if (row && x >= 0 && x < size) row[x] = dark;
  };
  for (const [cx, cy] of [
    [3, 3],
    [size - 4, 3],
    [3, size - 4],
  ] as const)
    for (let dy = -4; dy <= 4; ++dy)
      for (let dx = -4; dx <= 4; ++dx) {
        const ring = Math.max(Math.abs(dx), Math.abs(dy));
        set(cx + dx, cy + dy, ring !== 2 && ring !== 4);
      }
  for (let i = 8; i < size - 8; ++i) {
    set(i, 6, i % 2 === 0);
    set(6, i, i % 2 === 0);
  }
  if (size > 21)
    for (let dy = -2; dy <= 2; ++dy)
      for (let dx = -2; dx <= 2; ++dx) set(size - 7 + dx, size - 7 + dy, Math.max(Math.abs(dx), Math.abs(dy)) !== 1);
  write_format(matrix, 0);
  return matrix;
}

// The level M (00), the mask, and ten bits that protect them, written twice; and the one module that is always dark.
function write_format(matrix: Matrix, mask: number): void {
  const size = matrix.length;
  let rest = mask;
  for (let i = 0; i < 10; ++i) rest = (rest << 1) ^ ((rest >> 9) * 0x537);
  const bits = ((mask << 10) | rest) ^ 0x5412;
  const set = (x: number, y: number, at: number): void => {
    const row = matrix[y];
    if (row) row[x] = ((bits >> at) & 1) === 1;
  };
  for (let i = 0; i <= 5; ++i) set(8, i, i);
  set(8, 7, 6);
  set(8, 8, 7);
  set(7, 8, 8);
  for (let i = 9; i < 15; ++i) set(14 - i, 8, i);
  for (let i = 0; i < 8; ++i) set(size - 1 - i, 8, i);
  for (let i = 8; i < 15; ++i) set(8, size - 15 + i, i);
  const row = matrix[size - 8];
  if (row) row[8] = true;
}

const kMasks: ((x: number, y: number) => boolean)[] = [
  (x, y) => (x + y) % 2 === 0,
  (_, y) => y % 2 === 0,
  (x) => x % 3 === 0,
  (x, y) => (x + y) % 3 === 0,
  (x, y) => (Math.floor(y / 2) + Math.floor(x / 3)) % 2 === 0,
  (x, y) => ((x * y) % 2) + ((x * y) % 3) === 0,
  (x, y) => (((x * y) % 2) + ((x * y) % 3)) % 2 === 0,
  (x, y) => (((x + y) % 2) + ((x * y) % 3)) % 2 === 0,
];

// Two columns at a time from the right, upwards and downwards in turn, past the column of the timing pattern.
function fill(matrix: Matrix, data: number[], mask: number): Matrix {
  const size = matrix.length,
    out = matrix.map((row) => [...row]),
    isMasked = kMasks[mask] ?? (() => false);
  let at = 0,
    isUp = true;
  for (let right = size - 1; right >= 1; right -= 2) {
    if (right === 6) right = 5;
    for (let i = 0; i < size; ++i) {
      const y = isUp ? size - 1 - i : i;
      for (const x of [right, right - 1]) {
        const row = out[y];
        if (!row || matrix[y]?.[x] !== null) continue;
        const bit = at < data.length * 8 && (((data[at >> 3] ?? 0) >> (7 - (at & 7))) & 1) === 1;
        row[x] = bit !== isMasked(x, y);
        at += 1;
      }
    }
    isUp = !isUp;
  }
  write_format(out, mask);
  return out;
}

// How hard a code is to read, by the four rules of the standard.
function penalty(matrix: Matrix): number {
  const size = matrix.length,
    at = (x: number, y: number): boolean => matrix[y]?.[x] === true;
  let sum = 0,
    dark = 0;
  for (const isRow of [true, false])
    for (let a = 0; a < size; ++a) {
      let run = 0,
        before: boolean | null = null,
        line = "";
      for (let b = 0; b < size; ++b) {
        const now = isRow ? at(b, a) : at(a, b);
        line += now ? "1" : "0";
        run = now === before ? run + 1 : 1;
        before = now;
        if (run === 5) sum += 3;
        else if (run > 5) sum += 1;
      }
      for (const pattern of ["10111010000", "00001011101"])
        for (let from = line.indexOf(pattern); from >= 0; from = line.indexOf(pattern, from + 1)) sum += 40;
    }
  for (let y = 0; y < size; ++y)
    for (let x = 0; x < size; ++x) {
      if (at(x, y)) dark += 1;
      if (x + 1 < size && y + 1 < size && at(x, y) === at(x + 1, y) && at(x, y) === at(x, y + 1) && at(x, y) === at(x + 1, y + 1)) sum += 3;
    }
  return sum + 10 * Math.floor(Math.abs((dark * 20) / (size * size) - 10));
}

/// The modules of the code, true for dark, without the quiet border; null where the text is longer than 106 bytes.
export function qr_code(text: string): boolean[][] | null {
  const bytes = new TextEncoder().encode(text);
  const version = kVersions.findIndex(([total, correction, blocks]) => bytes.length + 2 <= total - correction * blocks);
  const found = kVersions[version];
  if (!found) return null;
  const data = codewords(bytes, ...found),
    empty = frame(21 + 4 * version);
  let best: Matrix | null = null,
    least = Infinity;
  for (let mask = 0; mask < 8; ++mask) {
    const matrix = fill(empty, data, mask),
      cost = penalty(matrix);
    if (cost < least) [best, least] = [matrix, cost];
  }
  return best ? best.map((row) => row.map((dark) => dark === true)) : null;
}
