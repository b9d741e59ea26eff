// What waits for an answer goes along to another address of the room: as a text behind the #, which browsers send to nobody.
import type { Item, Left } from "./queue";
import type { Deed } from "./wire";

const kLongest = 200000; // characters of a text; browsers take longer addresses, but not all of them
const kMostItems = 5000;
const kDeeds: Deed["t"][] = ["op", "room", "undo", "redo", "rewind", "draft"];

/// The runs as letters, digits, `-` and `_`. Nothing where there is nothing to take along, or too much for an address: a part of a run
/// does not travel, because two pages would then give the same numbers to different operations.
export function packed(runs: Left[]): string | null {
  if (runs.every((one) => one.items.length === 0)) return null;
  const bytes = new TextEncoder().encode(JSON.stringify(runs));
  if (bytes.length * 1.4 > kLongest) return null;
  let text = "";
  for (const byte of bytes) text += String.fromCharCode(byte);
  return btoa(text).replace(/\+/g, "-").replace(/\//g, "_").replace(/=+$/, "");
}

const is_number = (value: unknown): value is number => typeof value === "number" && Number.isSafeInteger(value) && value >= 0;

function is_item(value: unknown): value is Item {
  const item = value as Partial<Item> | null;
  if (typeof item !== "object" || item === null || !is_number(item.id) || !is_number(item.base) || !is_number(item.at)) return false;
  const isOptional = (item.seen === undefined || Array.isArray(item.seen)) && (item.mark === undefined || typeof item.mark === "string");
  return isOptional && typeof item.deed === "object" && item.deed !== null && kDeeds.includes(item.deed.t);
}

function is_left(value: unknown): value is Left {
  const left = value as Partial<Left> | null;
  if (typeof left !== "object" || left === null || typeof left.run !== "string" || !/^\w{1,64}$/.test(left.run)) return false;
  const { items, next } = left;
  if (!Array.isArray(items) || items.length > kMostItems || !is_number(next) || !items.every(is_item)) return false;
  const numbers = [0, ...items.map((item) => item.id), next];
  return numbers.every((number, i) => i === 0 || number > (numbers[i - 1] as number));
}

/// The runs of such a text; nothing where it is none. Anybody can write an address, so it is read with care.
export function unpacked(text: string): Left[] {
  if (text.length > kLongest) return [];
  try {
    const letters = atob(text.replace(/-/g, "+").replace(/_/g, "/"));
    const runs = JSON.parse(new TextDecoder().decode(Uint8Array.from(letters, (letter) => letter.charCodeAt(0)))) as unknown;
    return Array.isArray(runs) && runs.every(is_left) ? runs : [];
  } catch {
    return [];
  }
}
