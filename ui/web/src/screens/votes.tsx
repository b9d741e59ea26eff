// Votes: the question, a ballot that says what is missing before it is sent, and the result when the room shows it.
import type { JSX } from "preact";
import { useState } from "preact/hooks";
import { coins, coins_left, dots, gap_of, ranking, same } from "../ballots";
import type { Gap } from "../ballots";
import { amount, number, share } from "../format";
import { Icon, MarkState, Segments, Timer, Title } from "../parts";
import type { Session } from "../session";
import type { Ui } from "../ui";
import type { Ballot, Dot, Vote } from "../wire";
import { t } from "../words";
import { kForms, option_label, tone_of } from "./ballot_forms";

function gap_sentence(gap: Gap): string {
  switch (gap.what) {
    case "answer":
      return t("choose_one");
    case "rank":
      return t("rank_some");
    case "rank_all":
      return t("rank_all", { n: gap.n });
    case "coins":
      return t("coins_none");
    case "dots":
      return t("dots_none");
    case "number":
      return t("slider_none");
    case "too_many":
      return t("dots_take");
  }
}

export function ResultOf({ vote }: { vote: Vote }): JSX.Element | null {
  if (vote.kind === "slider" && vote.result !== null && vote.mean !== null)
    return (
      <dl class="figures big">
        <div>
          <dt>{t("mean")}</dt>
          <dd>{amount(vote.mean, vote.unit)}</dd>
        </div>
        {vote.median === null ? null : (
          <div>
            <dt>{t("median")}</dt>
            <dd>{amount(vote.median, vote.unit)}</dd>
          </div>
        )}
      </dl>
    );
  if (!vote.result) return null;
  return (
    <>
      <ul class="results">
        {vote.result.map((row) => (
          <li key={row.option} class={row.option === vote.leading ? "leads" : ""}>
            <div class="row spread">
              <span>
                {row.option === vote.leading ? <Icon name="check" /> : null}
                {option_label(vote, row.option)}
              </span>
              <b>{share(row.share)}</b>
            </div>
            <div class={`bar ${vote.kind === "dots" ? tone_of(vote, row.option) : ""}`}>
              <i style={{ width: `${Math.min(100, row.share * 100)}%` }} />
            </div>
            {vote.kind === "yes_no" ? null : <p class="small">{t("points", { n: row.points })}</p>}
          </li>
        ))}
      </ul>
      <p>{vote.leading ? t("leads", { label: option_label(vote, vote.leading) }) : vote.count > 0 ? t("tie") : ""}</p>
    </>
  );
}

export function Turnout({ vote }: { vote: Vote }): JSX.Element {
  // Nobody could vote yet: a share of nobody would read as if people had not cared.
  if (!vote.open && vote.opened === false) return <p class="small">{t("vote_unopened")}</p>;
  return (
    <p class="small">
      {vote.turnout !== null && vote.electorate > 0 && vote.count <= vote.electorate
        ? t("turnout", { share: share(vote.turnout), n: vote.electorate })
        : t("counted", { n: vote.count })}
    </p>
  );
}

function OpenVote({ s, ui, id, vote }: { s: Session; ui: Ui; id: string; vote: Vote }): JSX.Element {
  const mark = `vote/${id}`,
    under = s.shown(mark, "votes");
  const sent = under === undefined ? s.ballotOf(id, vote) : (under as Ballot | null);
  const isCast = under === undefined ? s.hasVoted(id, vote) : under !== null;
  const edited = id in ui.ballots ? (ui.ballots[id] ?? null) : sent;
  const gap = gap_of(vote, edited),
    isNew = !same(edited, sent),
    isSending = s.mark(mark)?.state === "sending";
  const set = (ballot: Ballot): void => ui.set({ ballots: { ...ui.ballots, [id]: ballot } });
  const cast = (ballot: Ballot | null): void => {
    const { [id]: _, ...others } = ui.ballots;
    ui.set({ ballots: others });
    s.command("cast_vote", { node: id, voter: `seat ${s.you?.seat ?? 0}`, ballot: ballot as never }, { mark, shown: ballot as never });
  };
  const Form = kForms[vote.kind];
  const status = isSending ? t(s.connection.isOpen ? "vote_sending" : "vote_waiting") : isCast && !isNew ? t("vote_counted") : null;
  return (
    <section class="vote">
      <h2>{vote.question}</h2>
      <p class="small">{t(vote.secret ? "vote_secret" : "vote_named")}</p>
      <Timer s={s} ends_at={vote.ends_at} />
      <Form s={s} ui={ui} id={id} vote={vote} ballot={edited} set={set} />
      <div class="cast">
        {gap && !(isCast && !isNew) ? (
          <p class="missing" aria-live="polite">
            {gap_sentence(gap)}
          </p>
        ) : null}
        {!gap && vote.kind === "coins" && coins_left(vote, edited) > 0 ? <p class="small">{t("coins_unspent")}</p> : null}
        {status ? (
          <p class={`counted ${isSending ? "busy" : ""}`} role="status">
            {isSending ? <i class="ring" aria-hidden="true" /> : <Icon name="check" />}
            {status}
          </p>
        ) : null}
        {s.mark(mark)?.state === "refused" ? (
          <p>
            <MarkState s={s} mark={mark} />
          </p>
        ) : null}
        <button class="main" disabled={gap !== null || !isNew} onClick={() => edited !== null && cast(edited)}>
          {t(isCast ? "change_vote" : "send_vote")}
        </button>
        {isCast && !isNew ? (
          <button class="link" onClick={() => cast(null)}>
            {t("withdraw_vote")}
          </button>
        ) : null}
      </div>
      <Turnout vote={vote} />
      {vote.result ? (
        <>
          <h3>{t("result")}</h3>
          <ResultOf vote={vote} />
        </>
      ) : null}
    </section>
  );
}

function ballot_words(vote: Vote, ballot: Ballot): string {
  if (typeof ballot === "number") return amount(ballot, vote.unit);
  if (typeof ballot === "string") return option_label(vote, ballot);
  if (vote.kind === "rank")
    return ranking(vote, ballot)
      .map((id, i) => `${i + 1}. ${option_label(vote, id)}`)
      .join(", ");
  if (vote.kind === "coins")
    return Object.entries(coins(vote, ballot))
      .map(([id, n]) => `${option_label(vote, id)}: ${number(n)}`)
      .join(", ");
  const count = new Map<string, number>();
  for (const dot of dots(vote, ballot) as Dot[]) count.set(dot.option, (count.get(dot.option) ?? 0) + 1);
  return [...count].map(([id, n]) => `${option_label(vote, id)}: ${number(n)}`).join(", ");
}

function ClosedVote({ vote }: { vote: Vote }): JSX.Element {
  return (
    <section class="vote closed">
      <h2>{vote.question}</h2>
      {vote.result ? <ResultOf vote={vote} /> : <p>{t("vote_closed_hidden")}</p>}
      {vote.mine !== null ? (
        <p class="small">
          {t("your_vote")}: {ballot_words(vote, vote.mine)}
        </p>
      ) : null}
      <Turnout vote={vote} />
    </section>
  );
}

export function Votes({ s, ui }: { s: Session; ui: Ui }): JSX.Element {
  const all = Object.entries(s.views.votes),
    open = all.filter(([, vote]) => vote.open);
  const closed = all.filter(([, vote]) => !vote.open && (vote.mine !== null || vote.count > 0));
  // What was voted on last comes first: that is what people talk about.
  closed.sort(([a], [b]) => Number(b === s.lastVote) - Number(a === s.lastVote));
  // Stays on its vote after that is sent, so that people see it counted.
  const [at, go] = useState(() => open.find(([id, vote]) => !s.hasVoted(id, vote) && s.mark(`vote/${id}`) === null)?.[0] ?? "");
  const shown = open.find(([id]) => id === at) ?? open[0];
  return (
    <>
      <Title>{t("votes")}</Title>
      {open.length > 1 && shown ? (
        <Segments
          label={t("votes")}
          value={shown[0]}
          choices={open.map(([id, vote], i) => ({ id, text: `${i + 1}${s.hasVoted(id, vote) ? " ✓" : ""}` }))}
          onChange={go}
        />
      ) : null}
      {shown ? <OpenVote key={shown[0]} s={s} ui={ui} id={shown[0]} vote={shown[1]} /> : null}
      {open.length === 0 && closed.length === 0 ? <p class="empty">{t("no_votes")}</p> : null}
      {closed.length > 0 ? (
        <>
          {open.length > 0 ? <h2>{t("vote_closed")}</h2> : null}
          {closed.map(([id, vote]) => (
            <ClosedVote key={id} vote={vote} />
          ))}
        </>
      ) : null}
    </>
  );
}
