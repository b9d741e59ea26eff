// Shows one of these parts in an element of the page.
import { render } from "preact";
import { MinutesFiles } from "./minutes_files";
import { PlanFiles } from "./plan_files";
import type { Props } from "./saving";

export function show(what: "minutes" | "plan", box: HTMLElement, props: Props): void {
  render(what === "plan" ? <PlanFiles {...props} /> : <MinutesFiles {...props} />, box);
}
