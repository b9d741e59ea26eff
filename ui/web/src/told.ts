// What the page tells a script of its own that shows a part of it.
import type { Session } from "./session";
import type { Ui } from "./ui";
import type { Language, Words } from "./words";

export interface Told {
  s: Session;
  ui: Ui;
  language: Language;
  words: Words; ///< those of the page
  own: Words | null; ///< those of the script in that language; null where the script has them
}
