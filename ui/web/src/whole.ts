// Makes what a view sends whole: servers leave out what a thing does not have, and the screens need not ask for each field.
import { round_step } from "./format";
import type { Control, Json, Option, PlanItem, Proposal, ViewName, Vote } from "./wire";

type Content = { [key: string]: Json };
const is_object = (value: Json | undefined): value is Content => typeof value === "object" && value !== null && !Array.isArray(value);

// A kind of outline comes with its colour only where the palette has one.
const kFills: Record<string, string> = { plot: "#dcd8c9", building: "#c9c4ba", volume: "#c9c9c9" };

function whole_item(value: Content): PlanItem {
  const item = value as unknown as Partial<PlanItem>;
  const kind = item.kind ?? "volume";
  return {
    kind,
    name: item.name ?? "",
    d: item.d ?? "",
    fill: item.fill ?? kFills[kind] ?? "none",
    use: item.use ?? "",
    met: item.met ?? null,
    figures: item.figures ?? [],
  };
}

// Votes whose answers are always the same come without them.
const kAnswers: Partial<Record<Vote["kind"], Option[]>> = {
  yes_no: [
    { id: "yes", label: "Yes" },
    { id: "no", label: "No" },
  ],
  dots: [
    { id: "plus", label: "Plus" },
    { id: "minus", label: "Minus" },
  ],
};

function whole_vote(value: Content): Vote {
  const vote = value as unknown as Vote;
  const options = vote.options && vote.options.length > 0 ? vote.options : (kAnswers[vote.kind] ?? []);
  return {
    ...vote,
    options,
    mine: vote.mine ?? null,
    result: vote.result ?? null,
    turnout: vote.turnout ?? null,
    leading: vote.leading || null,
  };
}

function whole_proposal(value: Content): Proposal {
  const proposal = value as unknown as Proposal;
  return {
    ...proposal,
    why: proposal.why ?? "",
    words: proposal.words ?? [],
    conflicts: proposal.conflicts ?? [],
    misfits: proposal.misfits ?? [],
  };
}

// A control without limits gets some that it fits; one without a step gets a round one.
function whole_control(value: Content): Control {
  const control = value as unknown as Control & { value?: number };
  const known = typeof control.value === "number" ? control.value : null;
  const isStrength = control.port === "strength";
  const isLimited = control.maximum > control.minimum;
  const minimum = isLimited ? control.minimum : Math.min(0, 2 * (known ?? 0));
  const maximum = isLimited ? control.maximum : Math.max(isStrength ? 1 : 100, 2 * (known ?? 0));
  const step = control.step > 0 ? control.step : round_step(minimum, maximum);
  return {
    ...control,
    label: control.label || control.port,
    value: known,
    unit: control.unit ?? "",
    minimum,
    maximum,
    step,
    costs: control.costs ?? "",
  };
}

/// One key of a view.
export function whole(view: ViewName, key: string, value: Json): Json {
  if (view === "card" && key === "controls" && Array.isArray(value)) return value.filter(is_object).map(whole_control) as unknown as Json;
  if (!is_object(value)) return value;
  if (view === "plan" || view === "draft_plans" || view === "past") return whole_item(value) as unknown as Json;
  if (view === "votes") return whole_vote(value) as unknown as Json;
  if (view === "proposals") return whole_proposal(value) as unknown as Json;
  return value;
}
