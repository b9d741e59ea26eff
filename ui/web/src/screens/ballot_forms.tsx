// How people fill in a ballot, for each kind of vote.
import type { JSX } from "preact";
import { useState } from "preact/hooks";
import { coins, coins_left, coins_put, dots, rank_added, rank_moved, ranking } from "../ballots";
import { round_step } from "../format";
import { Icon } from "../parts";
import { Stepper } from "../stepper";
import { middle } from "../plan_names";
import { PlanHere } from "../space";
import type { Session } from "../session";
import type { Pin, Ui } from "../ui";
import type { Ballot, Point, Vote } from "../wire";
import { t } from "../words";

/// Answers that every vote of a kind has come in English from the server.
export function option_label(vote: Vote, id: string): string {
  if (vote.kind === "yes_no" && (id === "yes" || id === "no")) return t(id);
  const option = vote.options.find((one) => one.id === id);
  const isStandard = vote.kind === "dots" && (option?.label === "Plus" || option?.label === "Minus");
  if (isStandard && (id === "plus" || id === "minus")) return t(id);
  return option?.label || id;
}

export interface BallotProps {
  s: Session;
  ui: Ui;
  id: string;
  vote: Vote;
  ballot: Ballot | null;
  set(ballot: Ballot): void;
}

function YesNo({ vote, ballot, set }: BallotProps): JSX.Element {
  return (
    <div class="choices two" role="group" aria-label={vote.question}>
      {["yes", "no"].map((id) => (
        <button key={id} class="choice" aria-pressed={ballot === id} onClick={() => set(id)}>
          {ballot === id ? <Icon name="check" /> : null}
          {option_label(vote, id)}
        </button>
      ))}
    </div>
  );
}

function Rank({ vote, ballot, set }: BallotProps): JSX.Element {
  const ranked = ranking(vote, ballot),
    rest = vote.options.filter((option) => !ranked.includes(option.id));
  return (
    <>
      <p class="how">{t("rank_how")}</p>
      {ranked.length === 0 ? null : (
        <ol class="ranked">
          {ranked.map((id, i) => {
            const label = option_label(vote, id);
            return (
              <li key={id}>
                <b class="place">{i + 1}</b>
                <span class="grow">{label}</span>
                <button
                  class="round"
                  aria-label={t("rank_up", { label })}
                  disabled={i === 0}
                  onClick={() => set(rank_moved(vote, ballot, id, -1))}
                >
                  <Icon name="up" />
                </button>
                <button
                  class="round"
                  aria-label={t("rank_down", { label })}
                  disabled={i === ranked.length - 1}
                  onClick={() => set(rank_moved(vote, ballot, id, 1))}
                >
                  <Icon name="down" />
                </button>
                {vote.whole ? null : (
                  <button class="round" aria-label={t("rank_remove", { label })} onClick={() => set(ranked.filter((one) => one !== id))}>
                    <Icon name="cross" />
                  </button>
                )}
              </li>
            );
          })}
        </ol>
      )}
      {rest.length > 0 ? (
        <>
          {ranked.length > 0 ? <h3>{t("rank_rest")}</h3> : null}
          <ul class="choices">
            {rest.map((option) => {
              const label = option_label(vote, option.id);
              return (
                <li key={option.id}>
                  <button
                    class="choice"
                    aria-label={t("rank_add", { label, n: ranked.length + 1 })}
                    onClick={() => set(rank_added(vote, ballot, option.id))}
                  >
                    <Icon name="plus" />
                    {label}
                  </button>
                </li>
              );
            })}
          </ul>
        </>
      ) : null}
    </>
  );
}

function Coins({ vote, ballot, set }: BallotProps): JSX.Element {
  const put = coins(vote, ballot),
    left = coins_left(vote, ballot);
  return (
    <>
      <p class="how" aria-live="polite">
        {t("coins_left", { n: left, all: vote.points })}
      </p>
      <ul class="coins">
        {vote.options.map((option) => {
          const label = option_label(vote, option.id),
            n = put[option.id] ?? 0;
          return (
            <li key={option.id}>
              <div class="grow">
                <span>{label}</span>
                <div class="pile" aria-hidden="true">
                  {Array.from({ length: Math.min(n, 24) }, (_, i) => (
                    <i key={i} />
                  ))}
                </div>
              </div>
              <button
                class="round"
                aria-label={t("coin_less", { label })}
                disabled={n === 0}
                onClick={() => set(coins_put(vote, ballot, option.id, -1))}
              >
                <Icon name="minus" />
              </button>
              <output aria-label={label}>{n}</output>
              <button
                class="round"
                aria-label={t("coin_more", { label })}
                disabled={left <= 0}
                onClick={() => set(coins_put(vote, ballot, option.id, 1))}
              >
                <Icon name="plus" />
              </button>
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
  const placed = dots(vote, ballot),
    left = vote.points - placed.length;
  const [chosen, choose] = useState(vote.options[0]?.id ?? "plus");
  const [node, pick] = useState("");
  const add = (place: Point): void => {
    if (left > 0) set([...placed, { place, option: chosen }]);
  };
  const pins: Pin[] = placed.map((dot, i) => ({
    id: `dot${i}`,
    x: dot.place[0],
    y: dot.place[1],
    letter: letter_of(vote, dot.option),
    tone: tone_of(vote, dot.option),
    label: option_label(vote, dot.option),
  }));
  const things = s
    .plan()
    .filter(([, item]) => item.name && item.kind !== "boundary")
    .sort((a, b) => a[1].name.localeCompare(b[1].name));
  const picked = things.find(([id]) => id === node)?.[1] ?? things[0]?.[1];
  return (
    <>
      <p class="how">
        {t("dots_how")} <span aria-live="polite">{t("dots_left", { n: left, all: vote.points })}</span>
      </p>
      <div class="kinds" role="group" aria-label={t("dots_how")}>
        {vote.options.map((option) => (
          <button
            key={option.id}
            class={`choice ${tone_of(vote, option.id)}`}
            aria-pressed={chosen === option.id}
            onClick={() => choose(option.id)}
          >
            <b class={`spot ${tone_of(vote, option.id)}`} aria-hidden="true">
              {letter_of(vote, option.id)}
            </b>
            {option_label(vote, option.id)}
          </button>
        ))}
      </div>
      <PlanHere s={s} ui={ui} binding={{ pins, onTap: add }} />
      {things.length > 0 ? (
        <div class="pick">
          <label class="field">
            <span>{t("dot_on")}</span>
            <select value={node || things[0]?.[0]} onChange={(event) => pick(event.currentTarget.value)}>
              {things.map(([id, item]) => (
                <option key={id} value={id}>
                  {item.name}
                </option>
              ))}
            </select>
          </label>
          <button
            class="quiet"
            disabled={left <= 0}
            onClick={() => {
              const at = picked && middle(picked);
              if (at) add(at);
            }}
          >
            {t("dot_set")}
          </button>
        </div>
      ) : null}
      {placed.length > 0 ? (
        <>
          <h3>{t("dots_list")}</h3>
          <ul class="dots">
            {placed.map((dot, i) => (
              <li key={i}>
                <b class={`spot ${tone_of(vote, dot.option)}`} aria-hidden="true">
                  {letter_of(vote, dot.option)}
                </b>
                <span class="grow">{t("dot_at", { label: option_label(vote, dot.option), place: place_name(s, dot.place) })}</span>
                <button class="quiet" onClick={() => set(placed.filter((_, at) => at !== i))}>
                  {t("dots_take")}
                </button>
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
  let best = "",
    least = 400;
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
        id={`ballot-${id}`}
        label={vote.question}
        value={typeof ballot === "number" ? ballot : null}
        minimum={vote.least}
        maximum={vote.most}
        step={round_step(vote.least, vote.most)}
        unit={vote.unit}
        onChange={set}
        isLive
      />
    </>
  );
}

export const kForms: Record<Vote["kind"], (props: BallotProps) => JSX.Element> = {
  yes_no: YesNo,
  rank: Rank,
  coins: Coins,
  dots: Dots,
  slider: Slide,
};
