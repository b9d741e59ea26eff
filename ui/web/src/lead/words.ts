// The sentences of the facilitator's page: those of the whole page, of files, and its own.
import { en as files, FilesKey } from "../files/words/en";
import { Key as PageKey, Language, Words, pseudo, t as say, told } from "../words";
import { en } from "./words/en";

export type LeadKey = keyof typeof en;
export type Key = PageKey | FilesKey | LeadKey;
export const t = say as (key: Key, args?: Record<string, string | number>) => string;

/// The page has told its words; `own` are those of this script, where they do not stand in it.
export function tell(language: Language, words: Words, own: Words | null): void {
  const english: Words = { ...files, ...en };
  told(language, { ...words, ...(own ?? (language === "xx" ? pseudo(english) : english)) });
}
