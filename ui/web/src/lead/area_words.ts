// Areas of a room in words, and the names that they can have.
import type { LeadView, Selection } from "../wire";
import { t } from "./words";

const kLongest = 64;

/// A name as the server takes it: letters without accents, digits and `_`. Empty where nothing of it is left, as of Korean ones.
export function area_id(name: string): string {
  return name
    .normalize("NFD")
    .replace(/[\u0300-\u036f]/g, "")
    .toLowerCase()
    .replace(/ß/g, "ss")
    .replace(/[^a-z0-9]+/g, "_")
    .replace(/^_+|_+$/g, "")
    .slice(0, kLongest);
}

/// The name of a new area: as it was typed, or else one with the next number.
export function area_name(typed: string, taken: string[]): string {
  const id = area_id(typed);
  if (id !== "" || typed.trim() === "") return id;
  let n = 1;
  while (taken.includes(`area_${n}`)) n += 1;
  return `area_${n}`;
}

/// What lies in an area.
export function area_words(area: { nodes: Selection; corners: number }, roles: LeadView["roles"], name_of: (node: string) => string): string {
  const { nodes, corners } = area,
    words: string[] = [];
  if (typeof nodes === "string") words.push(name_of(nodes));
  else if (Array.isArray(nodes)) words.push(...nodes.map(name_of));
  else {
    if (nodes.tag) words.push(t("area_tag", { tag: nodes.tag }));
    if (nodes.typification) words.push(t("area_role", { role: roles?.[nodes.typification]?.label ?? nodes.typification }));
  }
  if (corners > 0) words.push(t("area_outline", { n: corners }));
  return words.join(", ");
}
