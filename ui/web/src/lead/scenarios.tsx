// Scenarios on the facilitator's page: the scene is kept under a name, and the room goes back to it.
import type { JSX } from "preact";
import { useState } from "preact/hooks";
import { MarkState, Sure } from "../parts";
import type { Session } from "../session";
import { t } from "./words";

export function ScenariosPart({ s }: { s: Session }): JSX.Element {
  const [name, set] = useState("");
  const known = Object.entries(s.views.room.scenarios ?? {}).sort(([, a], [, b]) => b.seq - a.seq);
  const save = (): void => {
    s.event("save_scenario", { id: s.freshName("scenario"), name: name.trim() }, { mark: "lead/scenario" });
    set("");
  };
  return (
    <section class="panel">
      <header class="row spread">
        <h2>{t("lead_scenarios")}</h2>
        <MarkState s={s} mark="lead/scenario" />
      </header>
      <p class="small">{t("lead_scenarios_text")}</p>
      {known.length > 0 ? (
        <ul class="rows">
          {known.map(([id, scenario]) => (
            <li key={id}>
              <div class="row spread">
                <span class="grow">
                  <b>{scenario.name || id}</b>
                  <br />
                  <span class="small">{t("lead_scenario_by", { name: s.seatName(scenario.seat), n: scenario.tick })}</span>
                </span>
                <Sure
                  text={t("lead_back_sure", { name: scenario.name || id })}
                  yes={t("lead_back_yes")}
                  onYes={() => s.event("restart", { scenario: id }, { mark: "lead/scenario" })}
                >
                  {t("lead_back")}
                </Sure>
              </div>
              {scenario.note ? <p class="small">{scenario.note}</p> : null}
            </li>
          ))}
        </ul>
      ) : null}
      <div class="pick">
        <label class="field">
          <span>{t("lead_scenario_name")}</span>
          <input value={name} maxLength={40} autocomplete="off" onInput={(event) => set(event.currentTarget.value)} />
        </label>
        <button class="quiet" disabled={name.trim() === ""} onClick={save}>
          {t("lead_scenario_save")}
        </button>
      </div>
    </section>
  );
}
