// The role card: goals as sentences, and the values that its holder may change.
import type { JSX } from "preact";
import { amount } from "../format";
import { Icon, MarkState, StatusWord, Title } from "../parts";
import { Stepper } from "../stepper";
import type { Session } from "../session";
import type { Ui } from "../ui";
import type { Control, Goal, Seen } from "../wire";
import { t } from "../words";
import { Pens } from "./pens";

// Ports of nodes are written `typification.port`; a link has a strength and parameters.
const is_parameter = (control: Pick<Control, "port">): boolean => !control.port.includes(".") && control.port !== "strength";

/// The place of a control in the scene, as conditions name it.
export function place_of(control: Pick<Control, "node" | "port">): string {
  if (control.port === "strength") return `links/${control.node}/strength`;
  if (is_parameter(control)) return `links/${control.node}/parameters/${control.port}`;
  return `nodes/${control.node}/types/${control.port.replace(".", "/")}`;
}

function change(s: Session, control: Control, value: number, draft: string | null): void {
  const seen: Seen[] = control.value === null ? [] : [{ key: place_of(control), was: control.value }];
  const more = { mark: `control/${control.node}/${control.port}`, shown: value, ...(draft ? { draft } : { seen }) };
  if (control.port === "strength") s.command("set_link_strength", { id: control.node, strength: value }, more);
  else if (is_parameter(control)) s.command("set_link_parameter", { id: control.node, parameter: control.port, value }, more);
  else s.command("set_port", { node: control.node, port: control.port, value }, more);
}

function ControlRow({
  s,
  control,
  draft,
  isDisabled,
}: {
  s: Session;
  control: Control;
  draft: string | null;
  isDisabled: boolean;
}): JSX.Element {
  const mark = `control/${control.node}/${control.port}`,
    shown = s.shown(mark, "card");
  const in_words = (value: number | null | undefined): string | null =>
    value === null || value === undefined ? null : amount(value, control.unit, control.step);
  const outcome = in_words(control.outcome),
    set = in_words(control.value);
  const costs = Array.isArray(control.costs) ? control.costs.join(", ") : control.costs;
  return (
    <li class="control">
      <div class="row spread">
        <b>{control.label}</b>
        <MarkState s={s} mark={mark} />
      </div>
      <Stepper
        id={`control-${control.node}-${control.port.replace(".", "-")}`}
        label={control.label}
        value={typeof shown === "number" ? shown : control.value}
        minimum={control.minimum}
        maximum={control.maximum}
        step={control.step}
        unit={control.unit}
        isDisabled={isDisabled}
        onChange={(value) => change(s, control, value, draft)}
      />
      {draft !== null || outcome === null || outcome === set ? null : <p class="small">{t("control_outcome", { value: outcome })}</p>}
      {control.by ? <p class="small faint">{t("changed_by", { name: control.by })}</p> : null}
      {costs ? <p class="small">{t("costs", { who: costs })}</p> : null}
    </li>
  );
}

/// A goal and how far it is, as a sentence.
export function goal_sentence(goal: Pick<Goal, "value" | "target" | "unit" | "direction">): string {
  const key = goal.direction === "at_least" ? "goal_at_least" : goal.direction === "at_most" ? "goal_at_most" : "goal_sentence";
  return t(key, { value: amount(goal.value, goal.unit), target: amount(goal.target, goal.unit) });
}

/// The draft that the person works in: its changes are their own until they are proposed.
export function DraftBanner({ s, ui }: { s: Session; ui: Ui }): JSX.Element | null {
  if (!ui.draft) return null;
  const { id, title } = ui.draft;
  return (
    <section class="banner">
      <p>{t("draft_banner", { title })}</p>
      <div class="row">
        <button class="quiet" onClick={() => s.submit({ t: "draft", do: "undo", draft: id }, { mark: "draft/undo" })}>
          <Icon name="undo" />
          {t("draft_undo")}
        </button>
        <button class="quiet" onClick={() => s.submit({ t: "draft", do: "redo", draft: id }, { mark: "draft/redo" })}>
          <Icon name="redo" />
          {t("draft_redo")}
        </button>
        <button
          class="quiet"
          onClick={() => {
            ui.set({ part: "proposals" });
            ui.go("ideas");
          }}
        >
          {t("draft_propose")}
        </button>
        <button class="quiet" onClick={() => ui.set({ draft: null })}>
          {t("draft_leave")}
        </button>
        <MarkState s={s} mark="draft/undo" />
        <MarkState s={s} mark="draft/redo" />
      </div>
    </section>
  );
}

export function Card({ s, ui }: { s: Session; ui: Ui }): JSX.Element {
  const { card } = s.views,
    goals = card.goals ?? [],
    controls = card.controls ?? [];
  if (goals.length === 0 && controls.length === 0)
    return (
      <>
        <Title>{t("your_goals")}</Title>
        <p class="empty">{t("no_card")}</p>
      </>
    );
  const mayChange = ui.draft ? s.may("draft") : s.may("change");
  return (
    <>
      <Title>{card.name || t("your_goals")}</Title>
      {card.interest ? <p class="lead">{card.interest}</p> : null}
      <DraftBanner s={s} ui={ui} />
      {goals.length > 0 ? (
        <section>
          <h2>{t("your_goals")}</h2>
          <ul class="goals">
            {goals.map((goal) => (
              <li key={goal.name} class={goal.status}>
                <div class="row spread">
                  <b>{goal.name}</b>
                  <StatusWord status={goal.status} />
                </div>
                <p>{goal_sentence(goal)}</p>
              </li>
            ))}
          </ul>
        </section>
      ) : null}
      {controls.length > 0 ? (
        <section>
          <h2>{t("your_controls")}</h2>
          {mayChange ? null : <p class="notice">{t("not_now")}</p>}
          <ul class="controls">
            {controls.map((control) => (
              <ControlRow
                key={`${control.node}/${control.port}`}
                s={s}
                control={control}
                draft={ui.draft?.id ?? null}
                isDisabled={!mayChange}
              />
            ))}
          </ul>
          <div class="row">
            {ui.draft ? null : (
              <button class="quiet" disabled={!mayChange} onClick={() => s.submit({ t: "undo" }, { mark: "undo/" })}>
                <Icon name="undo" />
                {t("undo_mine")}
              </button>
            )}
            <MarkState s={s} mark="undo/" />
          </div>
        </section>
      ) : null}
      <Pens s={s} ui={ui} on="card" />
      {card.budget && (card.budget.budget > 0 || card.budget.spent > 0) ? <Budget budget={card.budget} /> : null}
    </>
  );
}

function Budget({ budget }: { budget: { budget: number; spent: number; left: number } }): JSX.Element {
  const all = amount(budget.budget, ""),
    isOver = budget.left < 0;
  const part = budget.budget > 0 ? Math.min(100, Math.max(0, (budget.spent / budget.budget) * 100)) : 0;
  return (
    <section>
      <h2>{t("budget")}</h2>
      <div class={`bar ${isOver ? "over" : ""}`}>
        <i style={{ width: `${part}%` }} />
      </div>
      <p>{isOver ? t("budget_over", { over: amount(-budget.left, ""), all }) : t("budget_left", { left: amount(budget.left, ""), all })}</p>
    </section>
  );
}
