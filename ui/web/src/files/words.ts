// The sentences of files: those of the whole page, and their own.
import { Key as PageKey, Language, Words, pseudo, t as say, told } from "../words";
import { FilesKey, en } from "./words/en";

export type Key = PageKey | FilesKey;
export const t = say as (key: Key, args?: Record<string, string | number>) => string;

/// The page has told its words; `own` are those of this script, where they do not stand in it.
export function tell(language: Language, words: Words, own: Words | null): void {
  told(language, { ...words, ...(own ?? (language === "xx" ? pseudo(en) : en)) });
}
