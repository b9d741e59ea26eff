// Own drafts, everybody's proposals, and two of them side by side in a table.
import type { JSX } from "preact";
import { useState } from "preact/hooks";
import { number } from "../format";
import { Icon, MarkState, Sure } from "../parts";
import type { Session } from "../session";
import { conflict_place, steps_words } from "../steps";
import { useLook } from "../ui";
import type { Ui } from "../ui";
import type { Conflict, Draft, Json, Proposal } from "../wire";
import { Key, t } from "../words";
import { TrialCells, TrialFigures, TwoPlans, figures_of_both } from "./trials";

const kStates = ["proposed", "accepted", "rejected", "open"];
export const state_word = (state: string): string => (kStates.includes(state) ? t(`proposal_state_${state}` as Key) : state);

function value_word(value: Json | undefined): string | null {
  if (typeof value === "number") return number(value);
  if (typeof value === "string") return value;
  return null;
}

// Where both have set the same value, nobody has to choose.
const conflicts_of = (proposal: Proposal): Conflict[] =>
  proposal.conflicts.filter(({ live, draft }) => live === undefined || live === null || JSON.stringify(live) !== JSON.stringify(draft));

/// What somebody else has made of the same place, with both values where they are short.
export function conflict_words(one: Conflict): string {
  const live = value_word(one.live),
    draft = value_word(one.draft),
    place = conflict_place(one);
  return live !== null && draft !== null
    ? t("conflict_values", { place, by: one.by, live, draft })
    : t("conflict_at", { place, by: one.by });
}

function DraftEntry({ s, ui, id, draft }: { s: Session; ui: Ui; id: string; draft: Draft }): JSX.Element {
  const [why, set] = useState("");
  const propose = (): void => {
    s.event("propose", { draft: id, title: draft.title, why: why.trim() }, { mark: `propose/${id}` });
    if (ui.draft?.id === id) ui.set({ draft: null });
  };
  return (
    <li class="proposal">
      <h3>{draft.title || id}</h3>
      {draft.steps.length > 0 ? (
        <ol class="steps">
          {steps_words(draft.steps, draft.said).map((step, i) => (
            <li key={i}>{step}</li>
          ))}
        </ol>
      ) : (
        <p class="small">{t("draft_empty")}</p>
      )}
      {draft.steps.length > 0 ? <TrialFigures trial={draft.trial} /> : null}
      {draft.misfits.map((misfit) => (
        <p class="wrong" key={misfit.step}>
          {t("misfit_at", { n: misfit.step + 1, why: misfit.why })}
        </p>
      ))}
      {draft.steps.length > 0 ? (
        <label class="field">
          <span>{t("draft_why")}</span>
          <textarea rows={2} value={why} maxLength={2000} onInput={(event) => set(event.currentTarget.value)} />
        </label>
      ) : null}
      <div class="row">
        {draft.steps.length > 0 ? (
          <button class="main" onClick={propose}>
            {t("draft_propose")}
          </button>
        ) : null}
        <button
          class="quiet"
          onClick={() => {
            ui.set({ draft: { id, title: draft.title || id } });
            ui.go("card");
          }}
        >
          {t("draft_go_on")}
        </button>
        <Sure
          text={t("draft_drop_sure")}
          yes={t("draft_drop")}
          onYes={() => {
            if (ui.draft?.id === id) ui.set({ draft: null });
            s.submit({ t: "draft", do: "drop", draft: id }, { mark: `draft/${id}` });
          }}
        >
          {t("draft_drop")}
        </Sure>
        <MarkState s={s} mark={`propose/${id}`} />
      </div>
    </li>
  );
}

function NewDraft({ s, ui }: { s: Session; ui: Ui }): JSX.Element {
  const [title, set] = useState("");
  const begin = (): void => {
    const id = s.freshName("draft");
    s.submit({ t: "draft", do: "begin", draft: id, title: title.trim() }, { mark: "draft/new" });
    ui.set({ draft: { id, title: title.trim() } });
    ui.go("card");
  };
  return (
    <div class="pick">
      <label class="field">
        <span>{t("draft_title")}</span>
        <input value={title} maxLength={40} autocomplete="off" onInput={(event) => set(event.currentTarget.value)} />
      </label>
      <button class="quiet" disabled={title.trim() === ""} onClick={begin}>
        <Icon name="plus" />
        {t("draft_new")}
      </button>
    </div>
  );
}

export function ProposalEntry({ s, proposal, children }: { s: Session; proposal: Proposal; children?: JSX.Element }): JSX.Element {
  return (
    <li class="proposal">
      <div class="row spread">
        <h3>{proposal.title}</h3>
        <span class={`word ${proposal.state === "accepted" ? "met" : proposal.state === "rejected" ? "far" : "close"}`}>
          <i aria-hidden="true" />
          {state_word(proposal.state)}
        </span>
      </div>
      <p class="faint">
        {proposal.seat === s.you?.seat ? t("comment_yours") : t("proposal_by", { name: s.seatName(proposal.seat) })} ·{" "}
        {t("draft_steps", { n: proposal.steps })}
      </p>
      {proposal.why ? <p class="said">{proposal.why}</p> : null}
      {proposal.words.length > 0 && !children ? (
        <details>
          <summary>{t("proposal_steps")}</summary>
          <ol class="steps">
            {steps_words(proposal.words, proposal.said).filter(Boolean).map((word, i) => (
              <li key={i}>{word}</li>
            ))}
          </ol>
        </details>
      ) : null}
      {proposal.state === "accepted" && proposal.kept < proposal.steps ? (
        <p class="small">{t("proposal_kept", { kept: proposal.kept, steps: proposal.steps })}</p>
      ) : null}
      {conflicts_of(proposal).length > 0 ? (
        <div class="wrong">
          <b>{t("proposal_conflicts")}</b>
          <ul>
            {conflicts_of(proposal).map((one) => (
              <li key={one.place}>{conflict_words(one)}</li>
            ))}
          </ul>
        </div>
      ) : null}
      {proposal.answer ? (
        <div class={`answer ${proposal.state}`}>
          <b>{t("proposal_answer")}</b>
          <p>{proposal.answer}</p>
        </div>
      ) : null}
      {children}
    </li>
  );
}

/// Two proposals, one row for each thing that can differ.
function CompareTable({ s, left, right }: { s: Session; left: Proposal; right: Proposal }): JSX.Element {
  const list = (words: string[]): JSX.Element =>
    words.length > 0 ? (
      <ul>
        {words.map((word, i) => (
          <li key={i}>{word}</li>
        ))}
      </ul>
    ) : (
      <>{t("none")}</>
    );
  const both = [left, right];
  return (
    <table class="compare">
      <thead>
        <tr>
          <th scope="col">
            <span class="unseen">{t("compare_row")}</span>
          </th>
          {both.map((one, i) => (
            <th key={i} scope="col">
              {one.title}
            </th>
          ))}
        </tr>
      </thead>
      <tbody>
        <tr>
          <th scope="row">{t("compare_state")}</th>
          {both.map((one, i) => (
            <td key={i}>
              {state_word(one.state)}
              <br />
              <span class="faint">{t("proposal_by", { name: s.seatName(one.seat) })}</span>
            </td>
          ))}
        </tr>
        <tr>
          <th scope="row">{t("proposal_why")}</th>
          {both.map((one, i) => (
            <td key={i}>{one.why || t("none")}</td>
          ))}
        </tr>
        <tr>
          <th scope="row">{t("proposal_steps")}</th>
          {both.map((one, i) => (
            <td key={i}>{list(steps_words(one.words, one.said).filter(Boolean))}</td>
          ))}
        </tr>
        {figures_of_both(both).map((figure) => (
          <tr key={figure.id}>
            <th scope="row">{figure.name}</th>
            {both.map((one, i) => (
              <TrialCells key={i} figure={one.trial?.figures.find((other) => other.id === figure.id)} />
            ))}
          </tr>
        ))}
        <tr>
          <th scope="row">{t("proposal_conflicts")}</th>
          {both.map((one, i) => (
            <td key={i}>{list(conflicts_of(one).map(conflict_words))}</td>
          ))}
        </tr>
        <tr>
          <th scope="row">{t("proposal_misfits")}</th>
          {both.map((one, i) => (
            <td key={i}>{list(one.misfits.map((misfit) => t("misfit_at", { n: misfit.step + 1, why: misfit.why })))}</td>
          ))}
        </tr>
      </tbody>
    </table>
  );
}

function Compare({ s, all }: { s: Session; all: [string, Proposal][] }): JSX.Element | null {
  const [pair, set] = useState<[string, string]>([all[0]?.[0] ?? "", all[1]?.[0] ?? ""]);
  const left = all.find(([id]) => id === pair[0])?.[1] ?? all[0]?.[1],
    right = all.find(([id]) => id === pair[1])?.[1] ?? all[1]?.[1];
  const shown: [string, string] = [all.find(([, one]) => one === left)?.[0] ?? "", all.find(([, one]) => one === right)?.[0] ?? ""];
  if (!left || !right) return null;
  const choice = (label: Key, at: 0 | 1): JSX.Element => (
    <label class="field">
      <span>{t(label)}</span>
      <select
        value={pair[at]}
        onChange={(event) => set(at === 0 ? [event.currentTarget.value, pair[1]] : [pair[0], event.currentTarget.value])}
      >
        {all.map(([id, one]) => (
          <option key={id} value={id}>
            {one.title}
          </option>
        ))}
      </select>
    </label>
  );
  return (
    <section>
      <h2>{t("compare")}</h2>
      <div class="pair">
        {choice("compare_first", 0)}
        {choice("compare_second", 1)}
      </div>
      <CompareTable s={s} left={left} right={right} />
      <TwoPlans s={s} left={shown[0]} right={shown[1]} />
    </section>
  );
}

export function Proposals({ s, ui }: { s: Session; ui: Ui }): JSX.Element {
  const all = Object.entries(s.views.proposals),
    drafts = Object.entries(s.views.drafts).filter(([, draft]) => draft.state !== "proposed" && draft.state !== "accepted");
  const open = all.filter(([, one]) => one.state === "proposed");
  // Two proposals are compared; own drafts come after them, and the server tries four in all.
  useLook(
    s,
    [...open, ...drafts].map(([id]) => id),
  );
  const canDraft = s.may("draft") && (s.views.card.controls ?? []).length > 0;
  return (
    <>
      {canDraft || drafts.length > 0 ? (
        <section>
          <h2>{t("my_drafts")}</h2>
          <ul class="proposals">
            {drafts.map(([id, draft]) => (
              <DraftEntry key={id} s={s} ui={ui} id={id} draft={draft} />
            ))}
          </ul>
          {canDraft ? <NewDraft s={s} ui={ui} /> : null}
        </section>
      ) : null}
      <section>
        <h2>{t("ideas_proposals")}</h2>
        {all.length === 0 ? <p class="empty">{t("no_proposals")}</p> : null}
        <ul class="proposals">
          {all.map(([id, proposal]) => (
            <ProposalEntry key={id} s={s} proposal={proposal} />
          ))}
        </ul>
      </section>
      {all.length > 1 ? <Compare s={s} all={all} /> : null}
    </>
  );
}
