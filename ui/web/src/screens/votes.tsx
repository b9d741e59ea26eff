// Votes: the question, a ballot that says what is missing before it is sent, and the result when the room shows it.
import type { JSX } from "preact";
import { Gap, coins, coins_left, coins_put, dots, gap_of, rank_added, rank_moved, ranking, same } from "../ballots";
import { amount, number, round_step, share } from "../format";
import { Icon, MarkState, Segments, Stepper, Timer, Title } from "../parts";
import { PlanHere, middle } from "../plan";
import type { Session } from "../session";
import type { Pin, Ui } from "../ui";
import type { Ballot, Dot, Point, Vote } from "../wire";
import { t } from "../words";
import { useState } from "preact/hooks";

/// Answers that every vote of a kind has come in English from the server.
export function option_label(vote: Vote, id: string): string {
  if (vote.kind === "yes_no" && (id === "yes" || id === "no")) return t(id);
  const option = vote.options.find((one) => one.id === id);
  const isStandard = vote.kind === "dots" && (option?.label === "Plus" || option?.label === "Minus");
  if (isStandard && (id === "plus" || id === "minus")) return t(id);
  return option?.label || id;
}

function gap_sentence(gap: Gap): string {
  switch (gap.what) {
    case "answer": return t("choose_one");
    case "rank": return t("rank_some");
    case "rank_all": return t("rank_all", { n: gap.n });
    case "coins": return t("coins_none");
    case "dots": return t("dots_none");
    case "number": return t("slider_none");
    case "too_many": return t("dots_take");
  }
}

interface BallotProps { s: Session; ui: Ui; id: string; vote: Vote; ballot: Ballot | null; set(ballot: Ballot): void }

function YesNo({ vote, ballot, set }: BallotProps): JSX.Element {
  return (
    <div class="choices two" role="radiogroup" aria-label={vote.question}>
      {["yes", "no"].map((id) => (
        <button key={id} role="radio" class="choice" aria-checked={ballot === id} onClick={() => set(id)}>
          {ballot === id ? <Icon name="check" /> : null}{option_label(vote, id)}
        </button>
      ))}
    </div>
  );
}

function Rank({ vote, ballot, set }: BallotProps): JSX.Element {
  const ranked = ranking(vote, ballot), rest = vote.options.filter((option) => !ranked.includes(option.id));
  return (
    <>
      <p class="how">{t("rank_how")}</p>
      {ranked.length === 0 ? null : <ol class="ranked">
        {ranked.map((id, i) => {
          const label = option_label(vote, id);
          return (
            <li key={id}>
              <b class="place">{i + 1}</b><span class="grow">{label}</span>
              <button class="round" aria-label={t("rank_up", { label })} disabled={i === 0} onClick={() => set(rank_moved(vote, ballot, id, -1))}><Icon name="up" /></button>
              <button class="round" aria-label={t("rank_down", { label })} disabled={i === ranked.length - 1} onClick={() => set(rank_moved(vote, ballot, id, 1))}><Icon name="down" /></button>
              {vote.whole ? null : <button class="round" aria-label={t("rank_remove", { label })} onClick={() => set(ranked.filter((one) => one !== id))}><Icon name="cross" /></button>}
            </li>
          );
        })}
      </ol>}
      {rest.length > 0 ? (
        <>
          {ranked.length > 0 ? <h3>{t("rank_rest")}</h3> : null}
          <ul class="choices">
            {rest.map((option) => {
              const label = option_label(vote, option.id);
              return <li key={option.id}><button class="choice" aria-label={t("rank_add", { label, n: ranked.length + 1 })} onClick={() => set(rank_added(vote, ballot, option.id))}><Icon name="plus" />{label}</button></li>;
            })}
          </ul>
        </>
      ) : null}
    </>
  );
}

function Coins({ vote, ballot, set }: BallotProps): JSX.Element {
  const put = coins(vote, ballot), left = coins_left(vote, ballot);
  return (
    <>
      <p class="how" aria-live="polite">{t("coins_left", { n: left, all: vote.points })}</p>
      <ul class="coins">
        {vote.options.map((option) => {
          const label = option_label(vote, option.id), n = put[option.id] ?? 0;
          return (
            <li key={option.id}>
              <div class="grow"><span>{label}</span><div class="pile" aria-hidden="true">{Array.from({ length: Math.min(n, 24) }, (_, i) => <i key={i} />)}</div></div>
              <button class="round" aria-label={t("coin_less", { label })} disabled={n === 0} onClick={() => set(coins_put(vote, ballot, option.id, -1))}><Icon name="minus" /></button>
              <output aria-label={label}>{n}</output>
              <button class="round" aria-label={t("coin_more", { label })} disabled={left <= 0} onClick={() => set(coins_put(vote, ballot, option.id, 1))}><Icon name="plus" /></button>
            </li>
          );
        })}
      </ul>
    </>
  );
}

const kTones = ["good", "bad", "third", "fourth"];
export const tone_of = (vote: Vote, option: string): string =>
  option === "plus" ? "good" : option === "minus" ? "bad" : (kTones[vote.options.findIndex((one) => one.id === option) % 4] ?? "good");
export const letter_of = (vote: Vote, option: string): string =>
  option === "plus" ? "+" : option === "minus" ? "−" : String(vote.options.findIndex((one) => one.id === option) + 1);

function Dots({ s, ui, vote, ballot, set }: BallotProps): JSX.Element {
  const placed = dots(vote, ballot), left = vote.points - placed.length;
  const [chosen, choose] = useState(vote.options[0]?.id ?? "plus");
  const [node, pick] = useState("");
  const add = (place: Point): void => {
    if (left > 0) set([...placed, { place, option: chosen }]);
  };
  const pins: Pin[] = placed.map((dot, i) => ({
    id: `dot${i}`, x: dot.place[0], y: dot.place[1], letter: letter_of(vote, dot.option), tone: tone_of(vote, dot.option), label: option_label(vote, dot.option),
  }));
  const things = s.plan().filter(([, item]) => item.name && item.kind !== "boundary").sort((a, b) => a[1].name.localeCompare(b[1].name));
  const picked = things.find(([id]) => id === node)?.[1] ?? things[0]?.[1];
  return (
    <>
      <p class="how">{t("dots_how")} <span aria-live="polite">{t("dots_left", { n: left, all: vote.points })}</span></p>
      <div class="kinds" role="radiogroup" aria-label={t("dots_how")}>
        {vote.options.map((option) => (
          <button key={option.id} role="radio" class={`choice ${tone_of(vote, option.id)}`} aria-checked={chosen === option.id} onClick={() => choose(option.id)}>
            <b class={`spot ${tone_of(vote, option.id)}`} aria-hidden="true">{letter_of(vote, option.id)}</b>{option_label(vote, option.id)}
          </button>
        ))}
      </div>
      <PlanHere s={s} ui={ui} binding={{ pins, onTap: add }} />
      {things.length > 0 ? (
        <div class="pick">
          <label class="field"><span>{t("dot_on")}</span>
            <select value={node || things[0]?.[0]} onChange={(event) => pick(event.currentTarget.value)}>
              {things.map(([id, item]) => <option key={id} value={id}>{item.name}</option>)}
            </select>
          </label>
          <button class="quiet" disabled={left <= 0} onClick={() => { const at = picked && middle(picked); if (at) add(at); }}>{t("dot_set")}</button>
        </div>
      ) : null}
      {placed.length > 0 ? (
        <>
          <h3>{t("dots_list")}</h3>
          <ul class="dots">
            {placed.map((dot, i) => (
              <li key={i}>
                <b class={`spot ${tone_of(vote, dot.option)}`} aria-hidden="true">{letter_of(vote, dot.option)}</b>
                <span class="grow">{t("dot_at", { label: option_label(vote, dot.option), place: place_name(s, dot.place) })}</span>
                <button class="quiet" onClick={() => set(placed.filter((_, at) => at !== i))}>{t("dots_take")}</button>
              </li>
            ))}
          </ul>
        </>
      ) : null}
    </>
  );
}

/// The thing nearest to a place, where it is near.
export function place_name(s: Session, place: Point): string {
  let best = "", least = 400;
  for (const [, item] of s.plan()) {
    const at = item.kind === "volume" || item.kind === "building" ? middle(item) : null;
    const far = at ? (at[0] - place[0]) ** 2 + (at[1] - place[1]) ** 2 : Infinity;
    if (far < least) [best, least] = [item.name, far];
  }
  return best || t("somewhere");
}

function Slide({ id, vote, ballot, set }: BallotProps): JSX.Element {
  return (
    <>
      <p class="how">{t("slider_how")}</p>
      <Stepper
        id={`ballot-${id}`} label={vote.question} value={typeof ballot === "number" ? ballot : null} minimum={vote.least} maximum={vote.most}
        step={round_step(vote.least, vote.most)} unit={vote.unit} onChange={set} isLive
      />
    </>
  );
}

const kForms: Record<Vote["kind"], (props: BallotProps) => JSX.Element> = { yes_no: YesNo, rank: Rank, coins: Coins, dots: Dots, slider: Slide };

export function ResultOf({ vote }: { vote: Vote }): JSX.Element | null {
  if (vote.kind === "slider" && vote.result !== null && vote.mean !== null)
    return (
      <dl class="figures big">
        <div><dt>{t("mean")}</dt><dd>{amount(vote.mean, vote.unit)}</dd></div>
        {vote.median === null ? null : <div><dt>{t("median")}</dt><dd>{amount(vote.median, vote.unit)}</dd></div>}
      </dl>
    );
  if (!vote.result) return null;
  return (
    <>
      <ul class="results">
        {vote.result.map((row) => (
          <li key={row.option} class={row.option === vote.leading ? "leads" : ""}>
            <div class="row spread"><span>{row.option === vote.leading ? <Icon name="check" /> : null}{option_label(vote, row.option)}</span><b>{share(row.share)}</b></div>
            <div class={`bar ${vote.kind === "dots" ? tone_of(vote, row.option) : ""}`}><i style={{ width: `${Math.min(100, row.share * 100)}%` }} /></div>
            {vote.kind === "yes_no" ? null : <p class="small">{t("points", { n: row.points })}</p>}
          </li>
        ))}
      </ul>
      <p>{vote.leading ? t("leads", { label: option_label(vote, vote.leading) }) : vote.count > 0 ? t("tie") : ""}</p>
    </>
  );
}

export function Turnout({ vote }: { vote: Vote }): JSX.Element {
  return <p class="small">{vote.turnout !== null && vote.electorate > 0 ? t("turnout", { share: share(vote.turnout), n: vote.electorate }) : t("counted", { n: vote.count })}</p>;
}

function OpenVote({ s, ui, id, vote }: { s: Session; ui: Ui; id: string; vote: Vote }): JSX.Element {
  const mark = `vote/${id}`, under = s.shown(mark, "votes");
  const sent = under === undefined ? vote.mine : (under as Ballot | null);
  const edited = id in ui.ballots ? (ui.ballots[id] ?? null) : sent;
  const gap = gap_of(vote, edited), isNew = !same(edited, sent), isSending = s.mark(mark)?.state === "sending";
  const set = (ballot: Ballot): void => ui.set({ ballots: { ...ui.ballots, [id]: ballot } });
  const cast = (ballot: Ballot | null): void => {
    const { [id]: _, ...others } = ui.ballots;
    ui.set({ ballots: others });
    s.command("cast_vote", { node: id, voter: `seat ${s.you?.seat ?? 0}`, ballot: ballot as never }, { mark, shown: ballot as never });
  };
  const Form = kForms[vote.kind];
  const status = isSending ? t(s.connection.isOpen ? "vote_sending" : "vote_waiting") : sent !== null && !isNew ? t("vote_counted") : null;
  return (
    <section class="vote">
      <h2>{vote.question}</h2>
      <p class="small">{t(vote.secret ? "vote_secret" : "vote_named")}</p>
      <Timer s={s} ends_at={vote.ends_at} />
      <Form s={s} ui={ui} id={id} vote={vote} ballot={edited} set={set} />
      <div class="cast">
        {gap ? <p class="missing" aria-live="polite">{gap_sentence(gap)}</p> : null}
        {!gap && vote.kind === "coins" && coins_left(vote, edited) > 0 ? <p class="small">{t("coins_unspent")}</p> : null}
        {status ? <p class={`counted ${isSending ? "busy" : ""}`} role="status">{isSending ? <i class="ring" aria-hidden="true" /> : <Icon name="check" />}{status}</p> : null}
        {s.mark(mark)?.state === "refused" ? <p><MarkState s={s} mark={mark} /></p> : null}
        <button class="main" disabled={gap !== null || !isNew} onClick={() => edited !== null && cast(edited)}>{t(sent === null ? "send_vote" : "change_vote")}</button>
        {sent !== null && !isNew ? <button class="link" onClick={() => cast(null)}>{t("withdraw_vote")}</button> : null}
      </div>
      <Turnout vote={vote} />
      {vote.result ? <><h3>{t("result")}</h3><ResultOf vote={vote} /></> : null}
    </section>
  );
}

function ballot_words(vote: Vote, ballot: Ballot): string {
  if (typeof ballot === "number") return amount(ballot, vote.unit);
  if (typeof ballot === "string") return option_label(vote, ballot);
  if (vote.kind === "rank") return ranking(vote, ballot).map((id, i) => `${i + 1}. ${option_label(vote, id)}`).join(", ");
  if (vote.kind === "coins") return Object.entries(coins(vote, ballot)).map(([id, n]) => `${option_label(vote, id)}: ${number(n)}`).join(", ");
  const count = new Map<string, number>();
  for (const dot of dots(vote, ballot) as Dot[]) count.set(dot.option, (count.get(dot.option) ?? 0) + 1);
  return [...count].map(([id, n]) => `${option_label(vote, id)}: ${number(n)}`).join(", ");
}

function ClosedVote({ vote }: { vote: Vote }): JSX.Element {
  return (
    <section class="vote closed">
      <h2>{vote.question}</h2>
      {vote.result ? <ResultOf vote={vote} /> : <p>{t("vote_closed_hidden")}</p>}
      {vote.mine !== null ? <p class="small">{t("your_vote")}: {ballot_words(vote, vote.mine)}</p> : null}
      <Turnout vote={vote} />
    </section>
  );
}

export function Votes({ s, ui }: { s: Session; ui: Ui }): JSX.Element {
  const all = Object.entries(s.views.votes), open = all.filter(([, vote]) => vote.open);
  const closed = all.filter(([, vote]) => !vote.open && (vote.mine !== null || vote.count > 0));
  // Stays on its vote after that is sent, so that people see it counted.
  const [at, go] = useState(() => open.find(([id, vote]) => vote.mine === null && s.mark(`vote/${id}`) === null)?.[0] ?? "");
  const shown = open.find(([id]) => id === at) ?? open[0];
  return (
    <>
      <Title>{t("votes")}</Title>
      {open.length > 1 && shown ? (
        <Segments label={t("votes")} value={shown[0]} choices={open.map(([id, vote], i) => ({ id, text: `${i + 1}${vote.mine !== null ? " ✓" : ""}` }))} onChange={go} />
      ) : null}
      {shown ? <OpenVote key={shown[0]} s={s} ui={ui} id={shown[0]} vote={shown[1]} /> : null}
      {open.length === 0 && closed.length === 0 ? <p class="empty">{t("no_votes")}</p> : null}
      {closed.length > 0 ? <>{open.length > 0 ? <h2>{t("vote_closed")}</h2> : null}{closed.map(([id, vote]) => <ClosedVote key={id} vote={vote} />)}</> : null}
    </>
  );
}
