// Steps of drafts and places of the model as words, from the parts that the server tells of them.
import { amount, number, unit_sign } from "./format";
import type { Conflict, Json, Said } from "./wire";
import { Key, is_key, t } from "./words";

// What is set to a value: the value says it.
const kSet = ["set_port", "set_cell", "set_setting", "set_link_strength", "set_link_parameter"];

function name_of(of: Said["of"]): string {
  if (of === undefined || typeof of === "string") return of ?? "";
  return `${of.kind} (${of.from} – ${of.to})`;
}

// A port in words of the page, or by its id, of which the last part is enough: `smart_volume.storey_height`.
function port_words(port: string): string {
  const last = port.slice(port.lastIndexOf(".") + 1),
    key = `port_${last}`;
  return is_key(key) ? t(key) : last.replace(/_/g, " ");
}

/// A thing and one of its values. Role cards have words for values, which often name the thing as well.
export function place_words({ of, what }: Said): string {
  const name = name_of(of);
  if (!what) return name;
  const { label } = what;
  if (label !== undefined && (typeof of === "object" || label.toLowerCase().includes(name.toLowerCase()))) return label;
  const value = label ?? port_words(what.port);
  return name === "" ? value : `${name}, ${value}`;
}

function value_words(value: Json, unit: string, step: number): string {
  if (typeof value === "number") return amount(value, unit, step);
  if (typeof value === "boolean") return t(value ? "yes" : "no");
  if (!Array.isArray(value)) return String(value);
  const sign = unit_sign(unit),
    place = value.map((one) => (typeof one === "number" ? number(one) : String(one))).join(" / ");
  return sign === "" ? place : `${place}\u00a0${sign}`;
}

// Both values in the same digits, a small change in so many that they differ; the unit once.
function change_words(said: Said): string {
  const { from, to, unit = "" } = said,
    place = place_words(said);
  if (to === undefined) return t("step_changed", { place });
  const isSmall = typeof from === "number" && typeof to === "number" && number(from) === number(to),
    step = isSmall ? Math.abs(to - from) : 0;
  const words = value_words(to, unit, step);
  return from === undefined ? t("step_to", { place, to: words }) : t("step_from_to", { place, from: value_words(from, "", step), to: words });
}

/// A step in the language of the page. What the page has no words for is told in English.
export function step_words(said: Said | null | undefined, english: string): string {
  const { id, n = 0 } = said ?? {};
  if (!said || id === undefined) return english;
  if (id === "add_nodes" || id === "remove_nodes") return t(`step_${id}` as Key, { n });
  const key = `step_${id}`;
  if (!kSet.includes(id) && !is_key(key)) return english;
  const words = kSet.includes(id)
    ? change_words(said)
    : t(key as Key, { of: name_of(said.of), place: place_words(said), to: said.to === undefined ? "" : String(said.to) });
  return n > 0 ? t("step_more", { step: words, n }) : words;
}

/// All steps of a draft; those that were taken back have no words.
export const steps_words = (english: string[], said: (Said | null)[] | undefined): string[] =>
  english.map((words, i) => (words === "" ? "" : step_words(said?.[i], words)));

export const conflict_place = ({ said, label, place }: Conflict): string => (said ? place_words(said) : label || place);
