// Shows the facilitator's page in an element of the page.
import { render } from "preact";
import type { JSX } from "preact";
import type { Session } from "../session";
import type { Told } from "../told";
import { Ui, useWatched } from "../ui";
import { Lead } from "./lead";
import { tell } from "./words";

// This script has a Preact of its own, which is drawn again by itself.
function Whole({ s, ui }: { s: Session; ui: Ui }): JSX.Element {
  useWatched(s, ui);
  return <Lead s={s} ui={ui} />;
}

/// Called again, it shows the same in other words. What it returns ends it.
export function show(box: HTMLElement, { s, ui, language, words, own }: Told): () => void {
  tell(language, words, own);
  render(<Whole s={s} ui={ui} />, box);
  return () => render(null, box);
}
