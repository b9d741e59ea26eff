// What happened: the last decisions as cards, for those who come late or looked elsewhere.
import type { JSX } from "preact";
import { useEffect, useState } from "preact/hooks";
import { amount, clock_time, share } from "../format";
import { Icon, IconName } from "../parts";
import type { Session } from "../session";
import type { Decision, Vote } from "../wire";
import { Key, t } from "../words";
import { option_label } from "./ballot_forms";
import { Swipe } from "./trials";

const kIcons: Record<Decision["kind"], IconName> = {
  proposal: "check",
  vote: "votes",
  phase: "now",
  restart: "undo",
  rewind: "undo",
  mark: "lead",
};

// The outcome in a few words, as far as it is shown.
function outcome(vote: Vote): string {
  if (vote.open) return t("happened_again");
  if (vote.result === null) return t("happened_hidden");
  if (vote.count === 0) return t("happened_nobody");
  if (vote.kind === "slider") return vote.median === null ? t("happened_hidden") : t("happened_median", { value: amount(vote.median, vote.unit) });
  const first = vote.result.find((one) => one.option === vote.leading);
  return first ? t("happened_first", { option: option_label(vote, first.option), share: share(first.share) }) : t("happened_even");
}

function words_of(s: Session, one: Decision): { title: string; text: string } {
  const vote = one.vote === undefined ? undefined : s.views.votes[one.vote];
  switch (one.kind) {
    case "proposal":
      return { title: one.title ?? "", text: [t("proposal_by", { name: s.seatName(one.of ?? 0) }), one.text ?? ""].filter(Boolean).join(" · ") };
    case "vote":
      return { title: vote?.question ?? "", text: vote ? outcome(vote) : "" };
    case "mark":
      return { title: one.text ?? "", text: "" };
    case "rewind":
      return { title: t("happened_rewind_text"), text: "" };
    default:
      return { title: one.title ?? "", text: "" };
  }
}

// What was there before and what is there now.
function BeforeAndNow({ s, entry }: { s: Session; entry: number }): JSX.Element {
  const before = s.pastPlan(entry);
  if (!s.has("past")) return <p class="small">{t("happened_coming")}</p>;
  if (before.length === 0) return <p class="small">{t("happened_no_plan")}</p>;
  return <Swipe s={s} first={before} second={s.plan()} titles={[t("happened_then"), t("compare_now")]} />;
}

function Before({ s, entry, isOpen, onToggle }: { s: Session; entry: number; isOpen: boolean; onToggle(isOpen: boolean): void }): JSX.Element {
  return (
    <details onToggle={(event) => onToggle(event.currentTarget.open)}>
      <summary>{t("happened_before")}</summary>
      {isOpen ? <BeforeAndNow s={s} entry={entry} /> : null}
    </details>
  );
}

/// The newest first; nothing where nothing was decided yet.
export function Happened({ s }: { s: Session }): JSX.Element | null {
  const [open, set] = useState<number[]>([]);
  useEffect(() => s.want("decisions"), []);
  const all = Object.entries(s.views.decisions)
    .map(([seq, one]) => ({ seq: Number(seq), one }))
    .filter(({ one }) => kIcons[one.kind] !== undefined)
    .sort((a, b) => b.seq - a.seq);
  // The server tells of plans of before while somebody looks at one.
  const looks = all.some(({ seq }) => open.includes(seq));
  useEffect(() => {
    if (!looks) return;
    s.want("past");
    return () => s.release("past");
  }, [looks]);
  if (all.length === 0) return null;
  return (
    <section class="happened">
      <h2>{t("happened")}</h2>
      <ol>
        {all.map(({ seq, one }) => {
          const { title, text } = words_of(s, one);
          return (
            <li key={seq}>
              <Icon name={kIcons[one.kind]} />
              <div>
                <p class="faint">
                  {t(`happened_${one.kind}` as Key)} · {clock_time(one.at)}
                </p>
                <p>
                  <b>{title}</b>
                </p>
                {text ? <p class="small">{text}</p> : null}
                <Before
                  s={s}
                  entry={seq}
                  isOpen={open.includes(seq)}
                  onToggle={(isOpen) => set((all) => (isOpen ? [...all.filter((one) => one !== seq), seq] : all.filter((one) => one !== seq)))}
                />
              </div>
            </li>
          );
        })}
      </ol>
    </section>
  );
}
