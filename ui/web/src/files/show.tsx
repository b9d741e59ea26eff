// Shows the plan as files in an element of the page.
import { render } from "preact";
import type { Told } from "../told";
import { PlanFiles } from "./plan_files";
import { tell } from "./words";

/// Called again, it shows the same in other words. What it returns ends it.
export function show(box: HTMLElement, { s, language, words, own }: Told): () => void {
  tell(language, words, own);
  render(<PlanFiles room={s.views.room.code ?? ""} token={s.connection.token ?? ""} />, box);
  return () => render(null, box);
}
