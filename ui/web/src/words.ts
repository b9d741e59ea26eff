// Picks sentences by language, with numbers and plural forms as that language has them.
import type { Key, Text } from "./words/en";

export type { Key, Text } from "./words/en";
export type Language = "en" | "nl" | "de" | "ko" | "xx";
export type Table = Record<Key, Text>;
/// Any sentences, such as those of a script of its own.
export type Words = Record<string, Text>;

/// By language: its own name. "xx" is no language: its sentences are longer and marked, so that tests find texts that are cut off or
/// not in the tables.
export const kNames: Record<Exclude<Language, "xx">, string> = { en: "English", nl: "Nederlands", de: "Deutsch", ko: "한국어" };
export const kLanguages = Object.keys(kNames) as Exclude<Language, "xx">[];

const kAccents: Record<string, string> = { a: "á", e: "ë", i: "ï", o: "ö", u: "ü", A: "Á", E: "Ë", I: "Ï", O: "Ö", U: "Ü", n: "ñ", s: "š" };

function marked(text: string): string {
  let inside = false,
    out = "";
  for (const letter of text) {
    if (letter === "{") inside = true;
    if (letter === "}") inside = false;
    out += inside ? letter : (kAccents[letter] ?? letter);
  }
  return `[${out}${"~".repeat(Math.ceil(text.length * 0.3))}]`;
}

/// English as a language of longer marked words.
export function pseudo(english: Words): Words {
  const words: Words = {};
  for (const [key, text] of Object.entries(english))
    words[key] = typeof text === "string" ? marked(text) : { one: marked(text.one), other: marked(text.other) };
  return words;
}

// Each script has its own; those of the page come by `add_table`, and the page tells them to other scripts.
const tables: Partial<Record<Language, Words>> = {};
let language: Language = "en";
let table: Words = {};

export function add_table(of: Language, words: Table): void {
  tables[of] = words;
}

/// Nothing changes where the words of that language have not come yet.
export function set_language(next: Language): void {
  const words = next === "xx" ? pseudo(tables.en ?? {}) : tables[next];
  if (words) told(next, words);
}

/// A script of its own is told what the page speaks.
export function told(next: Language, words: Words): void {
  language = next;
  table = words;
}

export const words_now = (): Words => table;

export const is_key = (key: string): key is Key => key in table;

export function language_now(): Language {
  return language;
}

/// For Intl and for the attribute `lang`.
export function locale(): string {
  return language === "xx" ? "en" : language;
}

/// The first of the wanted languages that there is.
export function best_language(wanted: readonly string[]): Language {
  for (const one of wanted) {
    const short = one.slice(0, 2).toLowerCase();
    if (short === "xx") return "xx";
    const found = kLanguages.find((known) => known === short);
    if (found) return found;
  }
  return "en";
}

// The browser reads the rules of a language for each writer that is made: that is slow, so they are kept.
const writers = new Map<string, Intl.NumberFormat>();
const kPlain = 1000; // whole numbers below it are the same in all languages here

/// A number as the language of the page writes it.
export function written(value: number, style: "decimal" | "percent" = "decimal", digits = 3): string {
  if (style === "decimal" && Number.isInteger(value) && Math.abs(value) < kPlain) return String(value);
  const key = `${locale()} ${style} ${digits}`;
  let writer = writers.get(key);
  if (!writer) writers.set(key, (writer = new Intl.NumberFormat(locale(), { style, maximumFractionDigits: digits })));
  return writer.format(value);
}

/// The sentence of a key; numbers in `args` are written as the language writes them, and `n` chooses the plural form.
export function t(key: Key, args: Record<string, string | number> = {}): string {
  const text = table[key] ?? key;
  const form = typeof text === "string" ? text : text[args.n === 1 ? "one" : "other"];
  return form.replace(/\{(\w+)\}/g, (whole, name: string) => {
    const value = args[name];
    if (value === undefined) return whole;
    return typeof value === "number" ? written(value) : value;
  });
}
