// What the facilitator answers: proposals, whole or in part, and comments.
import type { JSX } from "preact";
import { useState } from "preact/hooks";
import { Icon, MarkState } from "../parts";
import type { Session } from "../session";
import { steps_words } from "../steps";
import type { Comment, Json, Proposal } from "../wire";
import { t } from "./words";
import { ProposalEntry } from "../screens/proposals";
import { TrialFigures } from "../screens/trials";

export function Decide({ s, id, proposal, isOpen }: { s: Session; id: string; proposal: Proposal; isOpen: boolean }): JSX.Element {
  const [answer, set] = useState(""),
    [left, leave] = useState<number[]>([]);
  // Another proposal that comes folds nothing that somebody is working at.
  const [isUnfolded] = useState(isOpen);
  // Steps that were taken back have no words; those that do not fit any more cannot be taken.
  const isOut = (i: number): boolean => left.includes(i) || proposal.misfits.some((one) => one.step === i);
  const steps = steps_words(proposal.words, proposal.said).map((word, i) => ({ word, i })).filter(({ word }) => word !== "");
  const keep = steps.map(({ i }) => i).filter((i) => !isOut(i));
  const decide = (is_accepted: boolean): void => {
    const args: Record<string, Json> = { draft: id, is_accepted, answer: answer.trim() };
    if (is_accepted && keep.length < steps.length) args.keep = keep;
    s.event("decide_proposal", args, { mark: `lead/${id}` });
  };
  return (
    <ProposalEntry s={s} proposal={proposal}>
      <details open={isUnfolded}>
        <summary>{t("lead_decide")}</summary>
        <TrialFigures trial={proposal.trial} />
        <fieldset class="field">
          <legend>{t("proposal_steps")}</legend>
          {steps.map(({ word, i }) => {
            const misfit = proposal.misfits.find((one) => one.step === i);
            return (
              <label key={i} class="tick">
                <input
                  type="checkbox"
                  checked={!isOut(i)}
                  disabled={misfit !== undefined}
                  onChange={() => leave(left.includes(i) ? left.filter((one) => one !== i) : [...left, i])}
                />
                <span>
                  {word}
                  {misfit ? (
                    <em>
                      {" "}
                      — {t("proposal_misfits")}: {misfit.why}
                    </em>
                  ) : null}
                </span>
              </label>
            );
          })}
        </fieldset>
        <label class="field">
          <span>{t("lead_reason")}</span>
          <textarea rows={2} value={answer} maxLength={2000} onInput={(event) => set(event.currentTarget.value)} />
        </label>
        <div class="row">
          <button class="main" disabled={keep.length === 0} onClick={() => decide(true)}>
            <Icon name="check" />
            {keep.length < steps.length ? t("lead_accept_part", { n: keep.length }) : t("lead_accept")}
          </button>
          <button class="quiet" onClick={() => decide(false)}>
            <Icon name="cross" />
            {t("lead_reject")}
          </button>
          <MarkState s={s} mark={`lead/${id}`} />
        </div>
      </details>
    </ProposalEntry>
  );
}

export function Answer({ s, id, comment }: { s: Session; id: string; comment: Comment }): JSX.Element {
  const [answer, set] = useState("");
  const decide = (state: string): void => s.event("answer_comment", { comment: id, state, answer: answer.trim() }, { mark: `lead/${id}` });
  return (
    <li class="comment">
      <p class="small">
        {s.seatName(comment.seat)}
        {comment.node ? ` · ${s.nameOf(comment.node)}` : ""}
        {comment.plus > 0 ? ` · ${t("lead_agree", { n: comment.plus })}` : ""}
      </p>
      <p class="said">{comment.text}</p>
      <label class="field">
        <span>{t("lead_reason")}</span>
        <input value={answer} maxLength={2000} autocomplete="off" onInput={(event) => set(event.currentTarget.value)} />
      </label>
      <div class="row">
        <button class="quiet" onClick={() => decide("accepted")}>
          <Icon name="check" />
          {t("lead_follow")}
        </button>
        <button class="quiet" onClick={() => decide("rejected")}>
          <Icon name="cross" />
          {t("lead_follow_not")}
        </button>
        <MarkState s={s} mark={`lead/${id}`} />
      </div>
    </li>
  );
}
