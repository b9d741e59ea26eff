// What was not taken, with the reason and what can be done about it.
import type { JSX } from "preact";
import { number } from "./format";
import { own_pens } from "./pens";
import { Refusal, Session, subject_of, why_of } from "./session";
import { t } from "./words";

function labelOf(s: Session, refusal: Refusal): string {
  const subject = subject_of(refusal.item);
  if (subject !== "what_control") return t(subject);
  const [, node = "", port = ""] = (refusal.item.mark ?? "").split("/");
  const control = (s.views.card.controls ?? []).find((one) => one.node === node && one.port === port);
  return t("what_control", { label: control?.label ?? s.nameOf(node) });
}

function RefusalLine({ s, refusal, toPens }: { s: Session; refusal: Refusal; toPens(): void }): JSX.Element {
  const { answer, item } = refusal;
  const { key, args } = why_of(answer);
  const wanted = typeof item.shown === "number" ? number(item.shown) : null;
  const now = answer.args.now;
  const isStale = answer.why === "stale" && wanted !== null;
  return (
    <li>
      <p>
        <b>{labelOf(s, refusal)}</b> — {t(key, args)}
      </p>
      {isStale && typeof now === "number" ? (
        <p>
          {t("stale_value", { now: number(now) })} {t("refused_value", { wanted })}
        </p>
      ) : null}
      {answer.text ? (
        <details>
          <summary>{t("why_details")}</summary>
          <p lang="en">
            {answer.place ? `${answer.place}: ` : ""}
            {answer.text}
          </p>
        </details>
      ) : null}
      <div class="row">
        {isStale ? (
          <button class="quiet" onClick={() => s.insist(refusal)}>
            {t("set_anyway", { wanted })}
          </button>
        ) : null}
        {key === "why_area_pen" && own_pens(s).includes(String(args.area)) ? (
          <button
            class="quiet"
            onClick={() => {
              s.dismiss(refusal);
              toPens();
            }}
          >
            {t("pens_open")}
          </button>
        ) : null}
        <button class="quiet" onClick={() => s.dismiss(refusal)}>
          {t(isStale ? "leave_it" : "understood")}
        </button>
      </div>
    </li>
  );
}

/// What was not taken stays on the screen until the person has seen why.
export function Refusals({ s, toPens }: { s: Session; toPens(): void }): JSX.Element | null {
  if (s.refusals.length === 0) return null;
  return (
    <section class="refusals" role="alert">
      <h2>{t("refused_n", { n: s.refusals.length })}</h2>
      <ul>
        {s.refusals.slice(0, 5).map((refusal) => (
          <RefusalLine key={refusal.number} s={s} refusal={refusal} toPens={toPens} />
        ))}
      </ul>
    </section>
  );
}
