// The buttons, keys and north arrow of the picture in three dimensions, and the colours that the style sheet has for it.
import type { JSX } from "preact";
import { Icon, IconName } from "./parts";
import type { Looks, Step } from "./space/picture";
import { Key, t } from "./words";

const kTurns: [Step, Key, IconName][] = [
  ["turn_left", "turn_left", "left"],
  ["tilt_up", "tilt_up", "up"],
  ["tilt_down", "tilt_down", "down"],
  ["turn_right", "turn_right", "right"],
];
const kMoves: [Step, Key, IconName][] = [
  ["left", "move_left", "left"],
  ["up", "move_up", "up"],
  ["down", "move_down", "down"],
  ["right", "move_right", "right"],
];
/// What keys do.
export const kKeys: Record<string, Step> = {
  ArrowLeft: "turn_left",
  ArrowRight: "turn_right",
  ArrowUp: "tilt_up",
  ArrowDown: "tilt_down",
  "+": "in",
  "=": "in",
  "-": "out",
  "0": "home",
};

export function Buttons({ step, isMoving, setMoving }: { step(step: Step): void; isMoving: boolean; setMoving(is: boolean): void }): JSX.Element {
  const one = ([what, key, icon]: [Step, Key, IconName]): JSX.Element => (
    <button key={what} class="round" aria-label={t(key)} onClick={() => step(what)}>
      <Icon name={icon} />
    </button>
  );
  return (
    <>
      <div class="zoom" role="group" aria-label={t("view_3d")}>
        {one(["in", "zoom_in", "plus"])}
        {one(["out", "zoom_out", "minus"])}
        {one(["home", "zoom_all", "all"])}
      </div>
      <div class="pad" role="group" aria-label={t(isMoving ? "space_move" : "space_turn")}>
        {(isMoving ? kMoves : kTurns).map(one)}
        <button class="round" aria-pressed={isMoving} aria-label={t("space_move")} onClick={() => setMoving(!isMoving)}>
          <Icon name="move" />
        </button>
      </div>
    </>
  );
}

export function North({ turned }: { turned: { current: SVGGElement | null } }): JSX.Element {
  return (
    <svg class="north" viewBox="-24 -24 48 48" role="img" aria-label={t("north")}>
      <g ref={turned}>
        <path d="M0 -8L6 14L0 10L-6 14z" />
        <text y="-10">
          {t("north_letter")}
        </text>
      </g>
    </svg>
  );
}

export function looks_of(element: HTMLElement, isDark: boolean): Looks {
  const style = getComputedStyle(element),
    value = (name: string): string => style.getPropertyValue(name).trim();
  return {
    background: value("--plan"),
    ink: value("--plan-line"),
    accent: value("--accent"),
    ground: value("--sunken"),
    isDark,
  };
}
