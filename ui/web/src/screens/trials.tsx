// What would come of a draft: its figures with and without it, and the plans of two drafts under one another.
import type { JSX } from "preact";
import { useState } from "preact/hooks";
import { amount } from "../format";
import { extent_of, points_of } from "../outline";
import { StatusWord } from "../parts";
import type { Session } from "../session";
import type { PlanItem, Proposal, Trial, TrialFigure } from "../wire";
import { t } from "../words";

function state_words(trial: Trial): string {
  if (trial.state === "waiting") return t("trial_waiting", { n: Math.max(1, trial.line ?? 1) });
  if (trial.state === "done") return t(trial.is_settled ? "trial_settled" : "trial_restless");
  return t(trial.state === "old" ? "trial_old" : "trial_running");
}

const signed = (value: number, unit: string): string => `${value > 0 ? "+" : value < 0 ? "−" : "±"}${amount(Math.abs(value), unit)}`;

/// One row for each indicator: without the draft, with it, and what that makes.
export function TrialFigures({ trial, most }: { trial?: Trial | null; most?: number }): JSX.Element | null {
  if (trial === undefined) return null;
  return (
    <section class="trial">
      <h3>{t("trial_title")}</h3>
      <p class="small" role="status">
        {trial === null ? t("trial_none") : state_words(trial)}
      </p>
      {trial && trial.figures.length > 0 ? (
        <table class="compare">
          <thead>
            <tr>
              <th scope="col">{t("figures")}</th>
              <th scope="col">{t("trial_before")}</th>
              <th scope="col">{t("trial_after")}</th>
            </tr>
          </thead>
          <tbody>
            {trial.figures.slice(0, most).map((figure) => (
              <tr key={figure.id}>
                <th scope="row">{figure.name}</th>
                <td>{figure.before ? amount(figure.before.value, figure.unit) : t("none")}</td>
                <TrialCells figure={figure} />
              </tr>
            ))}
          </tbody>
        </table>
      ) : null}
    </section>
  );
}

/// The figure with the draft, and how much that is more or less.
export function TrialCells({ figure }: { figure: TrialFigure | undefined }): JSX.Element {
  if (!figure?.after) return <td>{t("none")}</td>;
  return (
    <td>
      {amount(figure.after.value, figure.unit)}
      {figure.difference !== null ? <span class="faint"> ({signed(figure.difference, figure.unit)})</span> : null}
      <br />
      <StatusWord status={figure.after.status} />
    </td>
  );
}

/// The indicators that any of them has.
export function figures_of_both(both: Proposal[]): TrialFigure[] {
  const found = new Map<string, TrialFigure>();
  for (const one of both) for (const figure of one.trial?.figures ?? []) if (!found.has(figure.id)) found.set(figure.id, figure);
  return [...found.values()];
}

const kOrder = ["boundary", "plot", "street", "building", "volume"];

/// A plan without names. Thick outlines differ from the model.
export function PlanPicture({
  items,
  box,
  live,
  label,
}: {
  items: [string, PlanItem][];
  box: string;
  live: Map<string, string>;
  label: string;
}): JSX.Element {
  const sorted = [...items].sort((a, b) => kOrder.indexOf(a[1].kind) - kOrder.indexOf(b[1].kind));
  return (
    <svg viewBox={box} preserveAspectRatio="xMidYMid meet" role="img" aria-label={label}>
      {sorted.map(([id, item]) => (
        <path
          key={id}
          class={`shape ${item.kind} ${item.kind === "volume" && live.get(id) !== item.d ? "other" : ""}`}
          d={item.d}
          fill={item.kind === "street" ? "none" : item.fill}
        />
      ))}
    </svg>
  );
}

/// The plans of two drafts.
export function TwoPlans({ s, left, right }: { s: Session; left: string; right: string }): JSX.Element | null {
  const title = (id: string): string => s.views.proposals[id]?.title || id;
  return <Swipe s={s} first={s.draftPlan(left)} second={s.draftPlan(right)} titles={[title(left), title(right)]} />;
}

/// Two plans, one over the other: a slider or two buttons say how much of each is seen. Thick outlines differ from the model.
export function Swipe({
  s,
  first,
  second,
  titles: [left, right],
}: {
  s: Session;
  first: [string, PlanItem][];
  second: [string, PlanItem][];
  titles: [string, string];
}): JSX.Element | null {
  const [share, set] = useState(50);
  if (first.length === 0 || second.length === 0) return null;
  const all = extent_of([...first, ...second].flatMap(([, item]) => points_of(item.d)));
  if (!all) return null;
  const margin = 0.03 * Math.max(all.width, all.height, 1);
  const box = `${all.x - margin} ${all.y - margin} ${all.width + 2 * margin} ${all.height + 2 * margin}`;
  const live = new Map(s.plan().map(([id, item]) => [id, item.d]));
  const step = (by: number): void => set(Math.min(100, Math.max(0, share + by)));
  return (
    <section class="swipe">
      <h3>{t("compare_plans")}</h3>
      <div class="layers" style={{ aspectRatio: `${all.width + 2 * margin} / ${all.height + 2 * margin}` }}>
        <div class="layer">
          <PlanPicture items={second} box={box} live={live} label={right} />
        </div>
        <div class="layer" style={{ clipPath: `inset(0 ${100 - share}% 0 0)` }}>
          <PlanPicture items={first} box={box} live={live} label={left} />
        </div>
        <b class="corner first" aria-hidden="true">
          {share > 0 ? left : ""}
        </b>
        <b class="corner second" aria-hidden="true">
          {share < 100 ? right : ""}
        </b>
        <i class="edge" aria-hidden="true" style={{ left: `${share}%` }} />
      </div>
      <div class="row">
        <button class="quiet" disabled={share >= 100} onClick={() => step(25)}>
          {t("compare_more_of", { title: left })}
        </button>
        <button class="quiet" disabled={share <= 0} onClick={() => step(-25)}>
          {t("compare_more_of", { title: right })}
        </button>
      </div>
      <input
        type="range"
        min={0}
        max={100}
        value={share}
        aria-label={t("compare_swipe", { title: left })}
        aria-valuetext={`${share} %`}
        style={{ "--filled": `${share}%` }}
        onInput={(event) => set(Number(event.currentTarget.value))}
      />
      <p class="small">{t("compare_thick")}</p>
    </section>
  );
}
