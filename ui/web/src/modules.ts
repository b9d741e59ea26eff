// What the unit tests see of the page; not part of the page itself. Words are those of all scripts together.
import { de as files_de } from "./files/words/de";
import { en as files_en } from "./files/words/en";
import { ko as files_ko } from "./files/words/ko";
import { nl as files_nl } from "./files/words/nl";
import { de as lead_de } from "./lead/words/de";
import { en as lead_en } from "./lead/words/en";
import { ko as lead_ko } from "./lead/words/ko";
import { nl as lead_nl } from "./lead/words/nl";
import { add_table, set_language } from "./words";
import { de as page_de } from "./words/de";
import { en as page_en } from "./words/en";
import { ko as page_ko } from "./words/ko";
import { nl as page_nl } from "./words/nl";

export * from "./ballots";
export * from "./connection";
export * from "./files/asking";
export * from "./format";
export * from "./handover";
export * from "./heat";
export * from "./lead/area_words";
export * from "./lead/corners";
export * from "./lead/findings";
export * from "./minutes";
export * from "./outline";
export * from "./pens";
export * from "./places";
export * from "./presence";
export * from "./proposal/cut";
export * from "./queue";
export * from "./random";
export * from "./session";
export * from "./space/decode";
export * from "./space/names";
export * from "./space/orbit";
export * from "./steps";
export * from "./timers";
export * from "./whole";
export * from "./wifi";
export { names_of } from "./plan_names";
export * from "./words";

/// English, by script.
export const kScripts = { page: page_en, files: files_en, lead: lead_en };
export const en = { ...page_en, ...files_en, ...lead_en };
export const de = { ...page_de, ...files_de, ...lead_de };
export const ko = { ...page_ko, ...files_ko, ...lead_ko };
export const nl = { ...page_nl, ...files_nl, ...lead_nl };

add_table("en", en);
set_language("en");
