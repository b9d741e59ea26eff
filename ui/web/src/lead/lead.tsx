// The facilitator's page: the phase and its clock, votes, proposals, people, and what the beamer shows.
import type { JSX } from "preact";
import { useEffect, useState } from "preact/hooks";
import { typed_number } from "../format";
import { Icon, MarkState, Segments, Sure, Timer } from "../parts";
import type { Session } from "../session";
import { useClock, useLook, useMedia } from "../ui";
import type { Ui } from "../ui";
import type { Activity, Layout, Vote } from "../wire";
import { Key, t } from "./words";
import { findings_of } from "./findings";
import { join_address } from "../screens/codes";
import { ExportPart } from "../screens/export";
import { at_door, pens_asked, proposals_waiting } from "../screens/waiting";
import { AreasPart } from "./areas";
import { Answer, Decide } from "./deciding";
import { HealthPart } from "./health";
import { JoinPart, KeysPart } from "./invitations";
import { MinutesPart } from "./minutes";
import { PlanFiles } from "../files/plan_files";
import { People } from "./people";
import { ScenariosPart } from "./scenarios";
import { ResultOf, Turnout } from "../screens/votes";

const kActivities: Activity[] = ["change", "draft", "comment", "vote"];
const kRewind = 30000;
const kFold = 2; // more proposals than this are folded, so that all of them are in sight
const kComments = 5; // more comments than this are shown on demand

interface Plan {
  name: string;
  activities: Activity[];
  minutes: string;
}

function set_phase(s: Session, name: string, activities: Activity[], ends_at: number): void {
  s.event("set_phase", { name, activities, forms: s.views.room.phase?.forms ?? [], ends_at }, { mark: "lead/phase" });
}

function PhasePart({ s }: { s: Session }): JSX.Element {
  const { phase, paused, rate } = s.views.room;
  const [typed, set] = useState<Plan | null>(null);
  // Until something is typed, the form shows what holds now. Before the first phase that is everything, and nobody's choice.
  const plan = typed ?? { name: "", activities: phase?.name ? phase.activities : [], minutes: "10" };
  const allowed = kActivities.filter((one) => phase?.activities.includes(one)).map((one) => t(`lead_${one}` as Key));
  if (phase && phase.forms.length > 0) allowed.push(t("form_title"));
  const minutes = typed_number(plan.minutes) ?? 0;
  const kinds: { key: Key; activities: Activity[] }[] = [
    { key: "lead_look", activities: [] },
    { key: "lead_change", activities: ["change"] },
    { key: "lead_draft", activities: ["draft"] },
    { key: "lead_comment", activities: ["comment"] },
    { key: "lead_vote", activities: ["vote"] },
  ];
  const start = (): void => {
    set_phase(
      s,
      plan.name.trim() ||
        kinds
          .filter((kind) => kind.activities.some((one) => plan.activities.includes(one)))
          .map((kind) => t(kind.key))
          .join(", ") ||
        t("lead_look"),
      plan.activities,
      minutes > 0 ? s.now() + minutes * 60000 : 0,
    );
    set(null);
  };
  return (
    <section class="panel">
      <header class="row spread">
        <h2>{t("lead_phase")}</h2>
        <MarkState s={s} mark="lead/phase" />
      </header>
      <p class="lead">{phase?.name ? t("lead_phase_now", { name: phase.name }) : t("lead_phase_none")}</p>
      {phase ? <p>{allowed.length > 0 ? t("lead_now_may", { what: allowed.join(", ") }) : t("lead_now_nothing")}</p> : null}
      <Timer s={s} ends_at={phase?.ends_at} />
      <div class="row">
        {phase && phase.ends_at > 0 ? (
          <button class="quiet" onClick={() => set_phase(s, phase.name, phase.activities, Math.max(phase.ends_at, s.now()) + 300000)}>
            <Icon name="clock" />
            {t("lead_more_time")}
          </button>
        ) : null}
        <button class="quiet" onClick={() => s.event("set_pace", { rate: rate ?? 10, is_paused: !paused }, { mark: "lead/pace" })}>
          <Icon name={paused ? "play" : "pause"} />
          {t(paused ? "lead_resume" : "lead_pause")}
        </button>
        <Rewind s={s} />
        <MarkState s={s} mark="lead/pace" />
      </div>
      <fieldset class="field">
        <legend>{t("lead_may")}</legend>
        <div class="row">
          {kActivities.map((activity) => (
            <label key={activity} class="tick">
              <input
                type="checkbox"
                checked={plan.activities.includes(activity)}
                onChange={() =>
                  set({ ...plan, activities: kActivities.filter((one) => (one === activity) !== plan.activities.includes(one)) })
                }
              />
              <span>{t(`lead_${activity}` as Key)}</span>
            </label>
          ))}
        </div>
      </fieldset>
      <div class="pair">
        <label class="field">
          <span>{t("lead_title")}</span>
          <input
            value={plan.name}
            maxLength={40}
            autocomplete="off"
            onInput={(event) => set({ ...plan, name: event.currentTarget.value })}
          />
        </label>
        <label class="field">
          <span>{t("lead_minutes")}</span>
          <input
            class="number"
            inputMode="decimal"
            autocomplete="off"
            value={plan.minutes}
            onInput={(event) => set({ ...plan, minutes: event.currentTarget.value })}
          />
        </label>
      </div>
      <button class="main" onClick={start}>
        {t("lead_start_phase")}
        <Icon name="right" />
      </button>
    </section>
  );
}

function Rewind({ s }: { s: Session }): JSX.Element {
  useClock(1000); // half a minute later nothing may be left to take back
  const to = s.rewindTo(kRewind);
  if (to === null)
    return (
      <button class="quiet" disabled>
        <Icon name="undo" />
        {t("lead_rewind")}
      </button>
    );
  return (
    <Sure
      text={t("lead_rewind_sure")}
      yes={t("lead_rewind_yes")}
      onYes={() => s.submit({ t: "rewind", to: s.rewindTo(kRewind) ?? to }, { mark: "lead/pace" })}
    >
      {t("lead_rewind")}
    </Sure>
  );
}

function VoteRow({ s, id, vote }: { s: Session; id: string; vote: Vote }): JSX.Element {
  const open = (): void => {
    const phase = s.views.room.phase;
    // Ballots are taken in phases that name them.
    if (phase && !phase.activities.includes("vote")) set_phase(s, phase.name, [...phase.activities, "vote"], phase.ends_at);
    s.event("open_vote", { vote: id, ends_at: 0 }, { mark: `lead/${id}` });
  };
  return (
    <li>
      <div class="row spread">
        <b class="grow">{vote.question}</b>
        <MarkState s={s} mark={`lead/${id}`} />
        {vote.open ? (
          <button class="quiet" onClick={() => s.event("close_vote", { vote: id }, { mark: `lead/${id}` })}>
            {t("lead_close_vote")}
          </button>
        ) : (
          <button class="quiet" onClick={open}>
            {t("lead_open_vote")}
          </button>
        )}
      </div>
      <Turnout vote={vote} />
      {vote.result && vote.count > 0 ? (
        <details>
          <summary>{t("result")}</summary>
          <ResultOf vote={vote} />
        </details>
      ) : null}
    </li>
  );
}

function BeamerPart({ s }: { s: Session }): JSX.Element {
  const { room } = s.views,
    layouts: Layout[] = ["plan", "compare", "vote", "comments", "marks", "space", "code"];
  return (
    <section class="panel">
      <header class="row spread">
        <h2>{t("lead_show")}</h2>
        <MarkState s={s} mark="lead/show" />
      </header>
      <Segments
        label={t("lead_show")}
        value={room.layout || "plan"}
        onChange={(layout) => s.event("show", { layout }, { mark: "lead/show" })}
        choices={layouts.map((id) => ({ id, text: t(`show_${id}` as Key) }))}
      />
      <p class="small">
        {t("lead_beamer_open")} <b>{join_address(s)}#beamer</b>
      </p>
    </section>
  );
}

function DecisionPart({ s }: { s: Session }): JSX.Element {
  const [decision, set] = useState("");
  return (
    <section class="panel">
      <header class="row spread">
        <h2>{t("lead_mark")}</h2>
        <MarkState s={s} mark="lead/mark" />
      </header>
      <div class="pick">
        <label class="field">
          <span>{t("lead_mark_text")}</span>
          <input value={decision} maxLength={2000} autocomplete="off" onInput={(event) => set(event.currentTarget.value)} />
        </label>
        <button
          class="quiet"
          disabled={decision.trim() === ""}
          onClick={() => {
            s.event("mark", { kind: "decision", text: decision.trim() }, { mark: "lead/mark" });
            set("");
          }}
        >
          {t("lead_mark")}
        </button>
      </div>
    </section>
  );
}

function EndPart({ s }: { s: Session }): JSX.Element {
  const [isShared, share] = useState(false);
  // Ballots of an open vote would be counted by nobody, so the server refuses it.
  const open = Object.values(s.views.votes).filter((vote) => vote.open).length;
  if (open > 0)
    return (
      <section class="panel">
        <h2>{t("lead_end")}</h2>
        <p class="small">{t("lead_end_votes", { n: open })}</p>
      </section>
    );
  return (
    <section class="panel">
      <h2>{t("lead_end")}</h2>
      <p class="small">{t("lead_end_text")}</p>
      <label class="tick">
        <input type="checkbox" checked={isShared} onChange={() => share(!isShared)} />
        <span>{t("lead_end_share")}</span>
      </label>
      <Sure
        class="quiet"
        text={t("lead_end_sure")}
        yes={t("lead_end")}
        onYes={() => s.event("close_room", { shares_minutes: isShared }, { mark: "lead/end" })}
      >
        {t("lead_end")}
      </Sure>
    </section>
  );
}

/// What waits for the facilitator, wherever the page is scrolled to.
function Waiting({ door, pens, proposals, comments, warnings }: Record<"door" | "pens" | "proposals" | "comments" | "warnings", number>): JSX.Element | null {
  const go = (id: string): void => {
    const part = document.getElementById(id);
    part?.scrollIntoView({ block: "start" });
    part?.focus({ preventScroll: true });
  };
  if (door + pens + proposals + comments + warnings === 0) return null;
  return (
    <div class="row waiting">
      <span>{t("lead_waiting")}</span>
      {door > 0 ? (
        <button class="quiet" onClick={() => go("lead-people")}>
          {t("lead_waiting_door", { n: door })}
        </button>
      ) : null}
      {pens > 0 ? (
        <button class="quiet" onClick={() => go("lead-areas")}>
          {t("lead_waiting_pens", { n: pens })}
        </button>
      ) : null}
      {proposals > 0 ? (
        <button class="quiet" onClick={() => go("lead-proposals")}>
          {t("lead_waiting_proposals", { n: proposals })}
        </button>
      ) : null}
      {comments > 0 ? (
        <button class="quiet" onClick={() => go("lead-comments")}>
          {t("lead_waiting_comments", { n: comments })}
        </button>
      ) : null}
      {warnings > 0 ? (
        <button class="quiet" onClick={() => go("lead-health")}>
          {t("lead_waiting_health", { n: warnings })}
        </button>
      ) : null}
    </div>
  );
}

export function Lead({ s, ui }: { s: Session; ui: Ui }): JSX.Element {
  const votes = Object.entries(s.views.votes),
    proposals = proposals_waiting(s),
    isTwo = useMedia("(min-width: 1200px)");
  const [isLong, setLong] = useState(false);
  useEffect(() => {
    s.want("lead");
    return () => s.release("lead");
  }, []);
  // Those that most agree with come first; of the others, those that wait longest.
  const comments = Object.entries(s.views.comments)
    .filter(([, comment]) => comment.state === "open" && !comment.answer && !comment.parent)
    .sort(([, a], [, b]) => b.plus - a.plus);
  const warnings = s.health ? findings_of(s.health, s.views.room.paused ?? false, String).filter((one) => one.verdict === "bad").length : 0;
  useLook(
    s,
    proposals.map(([id]) => id),
  );
  const files = <ExportPart key="files" formats={() => <PlanFiles room={s.views.room.code ?? ""} token={s.connection.token ?? ""} />} />;
  if (s.views.room.closed)
    return (
      <>
        <MinutesPart s={s} />
        {files}
      </>
    );
  const join = <JoinPart key="join" s={s} ui={ui} />;
  const now = (
    <>
      <PhasePart s={s} />
      <section class="panel">
        <h2>{t("lead_votes")}</h2>
        {votes.length > 0 ? (
          <ul class="rows">
            {votes.map(([id, vote]) => (
              <VoteRow key={id} s={s} id={id} vote={vote} />
            ))}
          </ul>
        ) : (
          <p class="small">{t("lead_no_votes")}</p>
        )}
      </section>
      {proposals.length > 0 ? (
        <section class="panel" id="lead-proposals" tabIndex={-1}>
          <h2>{t("ideas_proposals")}</h2>
          <ul class="proposals">
            {proposals.map(([id, proposal]) => (
              <Decide key={id} s={s} id={id} proposal={proposal} isOpen={proposals.length <= kFold} />
            ))}
          </ul>
        </section>
      ) : null}
      {comments.length > 0 ? (
        <section class="panel" id="lead-comments" tabIndex={-1}>
          <h2>{t("ideas_comments")}</h2>
          <ul class="comments">
            {comments.slice(0, isLong ? comments.length : kComments).map(([id, comment]) => (
              <Answer key={id} s={s} id={id} comment={comment} />
            ))}
          </ul>
          {comments.length > kComments ? (
            <button class="quiet" aria-expanded={isLong} onClick={() => setLong(!isLong)}>
              {isLong ? t("lead_comments_few") : t("lead_comments_all", { n: comments.length })}
            </button>
          ) : null}
        </section>
      ) : null}
    </>
  );
  const rest = (
    <>
      <BeamerPart s={s} />
      <DecisionPart s={s} />
      <ScenariosPart s={s} />
      <People s={s} />
      <AreasPart s={s} ui={ui} />
      <KeysPart s={s} />
      <HealthPart s={s} />
      {files}
      <EndPart s={s} />
    </>
  );
  // Before the first phase, people have to come in; later, what happens comes first.
  const isBegun = s.views.room.phase !== null && s.views.room.phase !== undefined;
  return (
    <>
      <Waiting door={at_door(s).length} pens={pens_asked(s).length} proposals={proposals.length} comments={comments.length} warnings={warnings} />
      {isTwo ? (
        <div class="boards">
          <div>{now}</div>
          <div>
            {join}
            {rest}
          </div>
        </div>
      ) : (
        <>
          {isBegun ? null : join}
          {now}
          {isBegun ? join : null}
          {rest}
        </>
      )}
    </>
  );
}
