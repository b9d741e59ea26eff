// How the room and its computer are, for the facilitator: what needs somebody stands open, the rest is folded.
import type { JSX } from "preact";
import { findings_of } from "./findings";
import type { Session } from "../session";
import { Key, t } from "./words";

export function HealthPart({ s }: { s: Session }): JSX.Element {
  const { health } = s;
  const all = health ? findings_of(health, s.views.room.paused ?? false, (node) => s.nameOf(node)) : [];
  const needing = all.filter((one) => one.verdict !== "good"),
    rest = all.filter((one) => one.verdict === "good");
  return (
    <section class="panel" id="lead-health" tabIndex={-1}>
      <h2>{t("lead_health")}</h2>
      {!health ? <p class="small">{t("health_none")}</p> : null}
      {health && needing.length === 0 ? <p>{t("health_good")}</p> : null}
      {needing.length > 0 ? (
        <ul class="health">
          {needing.map(({ verdict, text, advice }) => (
            <li key={text} class={verdict}>
              <span class={`word ${verdict === "bad" ? "far" : "close"}`}>
                <i aria-hidden="true" />
                {t(`health_is_${verdict}` as Key)}
              </span>
              <p>{text}</p>
              <p class="advice">{advice}</p>
            </li>
          ))}
        </ul>
      ) : null}
      {rest.length > 0 ? (
        <details>
          <summary>{t("health_rest", { n: rest.length })}</summary>
          <ul class="health rest">
            {rest.map(({ text }) => (
              <li key={text}>{text}</li>
            ))}
          </ul>
        </details>
      ) : null}
    </section>
  );
}
