// The plan with what things are, and the same as a list for those who do not read maps.
import type { JSX } from "preact";
import { useState } from "preact/hooks";
import { amount } from "../format";
import { Icon, Segments, StatusWord, Title } from "../parts";
import { PlanHere } from "../space";
import type { Session } from "../session";
import type { Ui } from "../ui";
import { Key, t } from "../words";
import { goal_sentence } from "./card";
import { ExportPart } from "./export";
import { Part } from "./part";
import { Pens } from "./pens";

// Figures that every volume has come by the names of their ports.
const kFigures: Record<string, Key> = {
  volume: "figure_volume",
  demand: "figure_demand",
  floor_area: "figure_floor_area",
  height: "figure_height",
};
const figure_label = (label: string): string => (kFigures[label] ? t(kFigures[label] as Key) : label);

/// What was touched: its name, its numbers, and how it fares.
export function WhatIsThis({ s, ui }: { s: Session; ui: Ui }): JSX.Element | null {
  const found = s.plan().find(([id]) => id === ui.selected);
  if (!found) return null;
  const item = found[1];
  return (
    <section class="what" aria-live="polite">
      <header class="row spread">
        <h2>{item.name || t(`kind_${item.kind}` as Key)}</h2>
        <button class="round" aria-label={t("close")} onClick={() => ui.set({ selected: null })}>
          <Icon name="cross" />
        </button>
      </header>
      <p class="faint">
        {t(`kind_${item.kind}` as Key)}
        {item.use ? ` · ${item.use}` : ""}
      </p>
      {item.met === null ? null : (
        <p class={`word ${item.met ? "met" : "far"}`}>
          <i aria-hidden="true" />
          {t(item.met ? "met_yes" : "met_no")}
        </p>
      )}
      {item.figures.length > 0 ? (
        <dl class="figures">
          {item.figures.map(([label, value, unit]) => (
            <div key={label}>
              <dt>{figure_label(label)}</dt>
              <dd>{amount(value, unit)}</dd>
            </div>
          ))}
        </dl>
      ) : null}
      {s.may("comment") ? (
        <button
          class="quiet"
          onClick={() => {
            ui.set({ part: "comments", isWriting: true, place: null, parent: null });
            ui.go("ideas");
          }}
        >
          <Icon name="ideas" />
          {t("comment_on")}
        </button>
      ) : null}
    </section>
  );
}

function PlanList({ s, ui }: { s: Session; ui: Ui }): JSX.Element {
  const kinds = ["volume", "building", "plot", "street"] as const;
  return (
    <div class="list">
      {kinds.map((kind) => {
        const items = s
          .plan()
          .filter(([, item]) => item.kind === kind)
          .sort((a, b) => a[1].name.localeCompare(b[1].name));
        if (items.length === 0) return null;
        return (
          <section key={kind}>
            <h2>{t(`kind_${kind}` as Key)}</h2>
            <ul>
              {items.map(([id, item]) => (
                <li key={id}>
                  <button
                    class="entry"
                    aria-expanded={ui.selected === id}
                    onClick={() => ui.set({ selected: ui.selected === id ? null : id })}
                  >
                    <i class="swatch" style={{ background: item.fill }} aria-hidden="true" />
                    <span>{item.name || id}</span>
                    <span class="faint">{item.figures[0] ? amount(item.figures[0][1], item.figures[0][2]) : ""}</span>
                    {item.met === null ? null : (
                      <span class={`word ${item.met ? "met" : "far"}`}>
                        <i aria-hidden="true" />
                        <span class="unseen">{t(item.met ? "met_yes" : "met_no")}</span>
                      </span>
                    )}
                  </button>
                  {ui.selected === id ? <WhatIsThis s={s} ui={ui} /> : null}
                </li>
              ))}
            </ul>
          </section>
        );
      })}
    </div>
  );
}

export function Figures({ s }: { s: Session }): JSX.Element | null {
  const figures = Object.entries(s.views.figures);
  if (figures.length === 0) return null;
  return (
    <section>
      <h2>{t("figures")}</h2>
      <ul class="goals">
        {figures.map(([id, figure]) => (
          <li key={id} class={figure.status}>
            <div class="row spread">
              <b>{figure.name}</b>
              <StatusWord status={figure.status} />
            </div>
            <p>{goal_sentence(figure)}</p>
            {figure.why ? (
              <p class="small faint" lang="en">
                {figure.why}
              </p>
            ) : null}
          </li>
        ))}
      </ul>
    </section>
  );
}

export function PlanScreen({ s, ui, isWide }: { s: Session; ui: Ui; isWide: boolean }): JSX.Element {
  const [isList, setList] = useState(isWide);
  return (
    <>
      <div class="row spread">
        <Title>{t("plan")}</Title>
        {isWide ? null : (
          <Segments
            label={t("plan")}
            value={isList ? "list" : "map"}
            choices={[
              { id: "map", text: t("map") },
              { id: "list", text: t("list") },
            ]}
            onChange={(id) => setList(id === "list")}
          />
        )}
      </div>
      {isList && !isWide ? null : <PlanHere s={s} ui={ui} binding={{ pins: [], onTap: (_, node) => ui.set({ selected: node }) }} />}
      {isList || isWide ? <PlanList s={s} ui={ui} /> : ui.selected ? <WhatIsThis s={s} ui={ui} /> : <p class="small">{t("plan_hint")}</p>}
      <Figures s={s} />
      <Pens s={s} ui={ui} on="plan" />
      {s.you?.role === "designer" ? <ExportPart formats={() => <Part s={s} ui={ui} name="files" />} /> : null}
    </>
  );
}
