// The beamer: the plan, a vote, comments or the code, as the facilitator chooses. It never asks and never complains.
import type { JSX } from "preact";
import { amount, countdown, duration } from "../format";
import { Moved, StatusWord } from "../parts";
import { CodePicture } from "../qr_picture";
import type { Session } from "../session";
import { PlanOrSpace, SpaceAlone } from "../space";
import { useClock } from "../ui";
import type { Vote } from "../wire";
import { t } from "../words";
import { option_label } from "./ballot_forms";
import { CommentsLayout, CompareLayout } from "./beamer_layouts";
import { Codes, join_address } from "./codes";
import { ResultOf, Turnout } from "./votes";

const kOld = 5000;

function PlanLayout({ s, isSpace }: { s: Session; isSpace?: boolean }): JSX.Element {
  const figures = Object.entries(s.views.figures).slice(0, 3),
    size = Math.ceil(window.innerHeight / 25),
    Seen = isSpace ? SpaceAlone : PlanOrSpace;
  return (
    <div class={`stage ${figures.length > 0 ? "with-side" : ""}`}>
      <Seen s={s} binding={null} selected={null} label={size} isStill />
      {figures.length === 0 ? null : (
      <ul class="side">
        {figures.map(([id, figure]) => (
          <li key={id} class={figure.status}>
            <span>{figure.name}</span>
            <b>{amount(figure.value, figure.unit)}</b>
            <StatusWord status={figure.status} />
          </li>
        ))}
      </ul>
      )}
    </div>
  );
}

// The vote that is open, or else the one that was open last, or else any with a result.
function vote_shown(s: Session): Vote | null {
  const votes = Object.values(s.views.votes),
    last = s.lastVote === null ? undefined : s.views.votes[s.lastVote];
  return votes.find((vote) => vote.open) ?? last ?? [...votes].reverse().find((vote) => vote.result !== null && vote.count > 0) ?? null;
}

function VoteLayout({ s }: { s: Session }): JSX.Element {
  const vote = vote_shown(s);
  if (!vote) return <PlanLayout s={s} />;
  return (
    <div class="stage text">
      <h2>{vote.question}</h2>
      {vote.result && (!vote.open || vote.count > 0) ? (
        <ResultOf vote={vote} />
      ) : vote.kind === "yes_no" || vote.kind === "slider" ? null : (
        <ol class="options">
          {vote.options.map((option) => (
            <li key={option.id}>{option_label(vote, option.id)}</li>
          ))}
        </ol>
      )}
      <Turnout vote={vote} />
    </div>
  );
}

function CodeLayout({ s }: { s: Session }): JSX.Element {
  return (
    <div class="stage code">
      <Codes s={s} />
    </div>
  );
}

export function Beamer({ s }: { s: Session }): JSX.Element {
  useClock(1000);
  const { room } = s.views,
    layout = room.layout || "plan",
    age = s.now() - s.latest;
  const left = room.phase?.ends_at && !room.closed ? room.phase.ends_at - s.now() : 0;
  const isOld = s.latest > 0 && !s.connection.isOpen && age > kOld;
  const stage =
    layout === "vote" ? (
      <VoteLayout s={s} />
    ) : layout === "compare" ? (
      <CompareLayout s={s} otherwise={<PlanLayout s={s} />} />
    ) : layout === "comments" || layout === "marks" ? (
      <CommentsLayout s={s} isNumbered={layout === "marks"} />
    ) : layout === "space" ? (
      <PlanLayout s={s} isSpace />
    ) : layout === "code" ? (
      <CodeLayout s={s} />
    ) : (
      <PlanLayout s={s} />
    );
  return (
    <main class="beamer">
      <header>
        <h1>{room.title ?? ""}</h1>
        <p>{room.closed ? t("closed_title") : (room.phase?.name ?? "")}</p>
        {left > 0 ? (
          <p class="clock" role="timer">
            {countdown(left)}
          </p>
        ) : null}
        {layout === "code" ? null : (
          <p class="corner">
            <CodePicture code={s.views.room.code ?? ""} address={join_address(s)} />
            <b>{room.code}</b>
          </p>
        )}
      </header>
      {stage}
      <Moved s={s} />
      {isOld ? <p class="old">{t("beamer_old", { time: duration(age) })}</p> : null}
    </main>
  );
}
