// What the beamer shows beside plan and words: two plans that are compared, and where comments lie close together.
import type { JSX } from "preact";
import { useMemo } from "preact/hooks";
import { heat, kBands } from "../heat";
import { Extent, extent_of, points_of } from "../outline";
import { Plan } from "../plan";
import type { Session } from "../session";
import { steps_words } from "../steps";
import { useLook } from "../ui";
import type { PlanItem, Proposal } from "../wire";
import { t } from "../words";
import { comment_pins } from "./ideas";
import { PlanPicture, TrialCells, TrialFigures, figures_of_both } from "./trials";

interface Side {
  letter: string;
  title: string;
  items: [string, PlanItem][];
}

const size_of_text = (): number => Math.ceil(window.innerHeight / 25);

// One box for both, so that they can be compared; nothing where there is nothing to draw.
function box_of(sides: Side[]): Extent | null {
  const all = extent_of(sides.flatMap((side) => side.items).flatMap(([, item]) => points_of(item.d)));
  if (!all) return null;
  const margin = 0.03 * Math.max(all.width, all.height, 1);
  return { x: all.x - margin, y: all.y - margin, width: all.width + 2 * margin, height: all.height + 2 * margin };
}

function Plans({ s, sides }: { s: Session; sides: Side[] }): JSX.Element {
  const box = box_of(sides),
    live = new Map(s.plan().map(([id, item]) => [id, item.d]));
  return (
    <div class="plans">
      {sides.map(({ letter, title, items }) => (
        <figure key={letter}>
          <figcaption>
            <b class="spot">{letter}</b> <span>{title}</span>
          </figcaption>
          {box && items.length > 0 ? (
            <PlanPicture items={items} box={`${box.x} ${box.y} ${box.width} ${box.height}`} live={live} label={title} />
          ) : (
            <p class="faint">{t("trial_none")}</p>
          )}
        </figure>
      ))}
    </div>
  );
}

// What each changes first, and what that makes of two figures: more does not fit beside plans that people see from afar.
function ShortTable({ both }: { both: Proposal[] }): JSX.Element {
  const figures = figures_of_both(both).slice(0, 2);
  return (
    <table class="compare">
      <thead class="unseen">
        <tr>
          <th scope="col">{t("compare_row")}</th>
          {both.map((one, i) => (
            <th key={i} scope="col">
              {one.title}
            </th>
          ))}
        </tr>
      </thead>
      <tbody>
        <tr>
          <th scope="row">{t("proposal_steps")}</th>
          {both.map((one, i) => {
            const words = steps_words(one.words, one.said).filter(Boolean);
            return (
              <td key={i}>
                {words[0] ?? (one.why || t("none"))}
                {words.length > 1 ? <span class="faint"> {t("compare_more_steps", { n: words.length - 1 })}</span> : null}
              </td>
            );
          })}
        </tr>
        {figures.map((figure) => (
          <tr key={figure.id}>
            <th scope="row">{figure.name}</th>
            {both.map((one, i) => (
              <TrialCells key={i} figure={one.trial?.figures.find((other) => other.id === figure.id)} />
            ))}
          </tr>
        ))}
      </tbody>
    </table>
  );
}

/// The two proposals that were made first, or one beside the model as it is. Nothing where there is none.
export function CompareLayout({ s, otherwise }: { s: Session; otherwise: JSX.Element }): JSX.Element {
  const all = Object.entries(s.views.proposals)
    .filter(([, one]) => one.state === "proposed")
    .slice(0, 2) as [string, Proposal][];
  useLook(
    s,
    all.map(([id]) => id),
  );
  const [first, second] = all;
  if (!first) return otherwise;
  const sides = all.map(([id, { title }], i) => ({ letter: i === 0 ? "A" : "B", title, items: s.draftPlan(id) }));
  if (!second) sides.unshift({ letter: "A", title: t("compare_now"), items: s.plan() });
  if (!second) (sides[1] as Side).letter = "B";
  return (
    <div class="stage compared">
      <Plans s={s} sides={sides} />
      {second ? <ShortTable both={[first[1], second[1]]} /> : <TrialFigures trial={first[1].trial} most={2} />}
    </div>
  );
}

/// Places of comments as a heat map. Numbers of comments only where somebody wants them.
export function CommentsLayout({ s, isNumbered }: { s: Session; isNumbered: boolean }): JSX.Element {
  const top = Object.entries(s.views.comments)
    .map(([id, comment], i) => ({ id, comment, n: i + 1 }))
    .filter(({ comment }) => !comment.parent);
  const best = [...top].sort((a, b) => b.comment.plus - b.comment.minus - (a.comment.plus - a.comment.minus)).slice(0, isNumbered ? 3 : 2);
  const pins = comment_pins(s),
    plan = extent_of(s.plan().flatMap(([, item]) => points_of(item.d)));
  const places = pins.map(({ x, y }): [number, number] => [x, -y]);
  // Each message draws the screen anew, with new objects; the densities take long and seldom change.
  const bands = useMemo(() => (plan ? heat(places, plan) : []), [JSON.stringify([places, plan])]);
  return (
    <div class="stage with-side">
      <Plan s={s} binding={{ pins: isNumbered ? pins : [], onTap: () => undefined }} selected={null} label={size_of_text()} isStill>
        <g class="heat">
          {bands.map(({ least, path }, i) => (path === "" ? null : <path key={least} class={`band_${i}`} d={path} fill-rule="evenodd" />))}
        </g>
      </Plan>
      <div class="side said">
        <div class="legend">
          <b>{t("heat_legend")}</b>
          <ul>
            {kBands.map((least, i) => (
              <li key={least}>
                <i class={`band_${i}`} aria-hidden="true" />
                {["1", "2", "3–4", "5+"][i]}
              </li>
            ))}
          </ul>
          {pins.length < top.length ? <p class="small">{t("heat_elsewhere", { n: top.length - pins.length })}</p> : null}
        </div>
        <ul>
          {best.map(({ id, comment, n }) => (
            <li key={id}>
              {isNumbered ? <b class="spot say">{n}</b> : null} {comment.text.length > 90 ? `${comment.text.slice(0, 88)}…` : comment.text}
            </li>
          ))}
        </ul>
      </div>
    </div>
  );
}
