// The plan of each level: a slider and two buttons choose the level, a touch or the table chooses a building.
import type { JSX } from "preact";
import { Icon } from "../parts";
import { Building, Level, Proposal, Storey, cellar_area, drawn_storeys, use_name, whole } from "./data";
import type { Choice } from "./model";

// Around the plots, of their larger side; more where there is something to see.
const kMargin = 0.04,
  kSurroundings = 0.25,
  kLetter = 0.29, // half of the width of a letter, and the height of a line, of the size of the letters
  kLine = 1.2;

// The storey of a building that belongs to a level, or the higher one that passes through it.
function storey_on(building: Building, level: Level, cut: number): { storey: Storey; isOwn: boolean } | null {
  const own = drawn_storeys(building).find((one) => one.level === level.number);
  if (own) return { storey: own, isOwn: true };
  const passing = level.number < 0 ? undefined : building.storeys.find((one) => one.bottom <= cut && cut < one.top);
  return passing ? { storey: passing, isOwn: false } : null;
}

interface Seen {
  building: Building;
  on: { storey: Storey; isOwn: boolean };
}

// Of names that would lie on each other the larger storey keeps its own; all are in the tables.
function named(here: Seen[], font: number): Seen[] {
  const taken: { x: number; y: number; half: number }[] = [];
  return [...here]
    .sort((a, b) => b.on.storey.area - a.on.storey.area)
    .filter(({ building }) => {
      const [x, y] = building.at,
        half = kLetter * font * building.name.length;
      const isFree = taken.every((one) => Math.abs(one.x - x) >= one.half + half || Math.abs(one.y - y) >= kLine * font);
      if (isFree) taken.push({ x, y, half });
      return isFree;
    });
}

/// The level that is shown, by its number, and whether the model is cut above it.
export interface Shown {
  level: number;
  setLevel(level: number): void;
  isCut: boolean;
  setCut(is: boolean): void;
}

export function Plans({ proposal, chosen, choose, level, setLevel, isCut, setCut }: { proposal: Proposal } & Choice & Shown): JSX.Element {
  const { plan } = proposal,
    [x, y, width, height] = plan.box,
    margin = (plan.existing.length + plan.streets.length > 0 ? kSurroundings : kMargin) * Math.max(width, height),
    first = plan.levels[0]?.number ?? 0,
    last = plan.levels[plan.levels.length - 1]?.number ?? 0,
    here_now = plan.levels[level - first] as Level,
    isBelow = level < 0,
    cut = here_now.bottom + plan.level_height / 2;
  const shown = proposal.buildings
    .map((building) => ({ building, on: storey_on(building, here_now, cut) }))
    .filter((one): one is Seen => one.on !== null);
  const here = shown.filter(({ on }) => on.isOwn),
    area = here.reduce((sum, { on }) => sum + on.storey.area, 0),
    font = (Math.max(width, height) + 2 * margin) / 46;
  return (
    <>
      <div class="row levels">
        <button class="round" aria-label="One level lower" disabled={level <= first} onClick={() => setLevel(level - 1)}>
          <Icon name="down" />
        </button>
        <label class="field grow">
          <span>
            {here_now.name} of {isBelow ? -first : last}, {here_now.heights}
          </span>
          <input
            type="range"
            min={first}
            max={last}
            step={1}
            value={level}
            aria-valuetext={here_now.name}
            style={`--filled: ${last > first ? (100 * (level - first)) / (last - first) : 0}%`}
            onInput={(event) => setLevel(Number(event.currentTarget.value))}
          />
        </label>
        <button class="round" aria-label="One level higher" disabled={level >= last} onClick={() => setLevel(level + 1)}>
          <Icon name="up" />
        </button>
      </div>
      <label class="tick">
        <input type="checkbox" checked={isCut} onChange={(event) => setCut(event.currentTarget.checked)} />
        <span>Cut the model above this level</span>
      </label>
      <svg
        class="drawn"
        viewBox={`${x - margin} ${y - margin} ${width + 2 * margin} ${height + 2 * margin}`}
        role="img"
        aria-label={`Plan of ${here_now.name}: ${here.length} ${here.length === 1 ? "storey" : "storeys"}, ${whole(area)} m². The tables say the same.`}
      >
        {plan.streets.map((one, k) => (
          <path key={`s${k}`} class="shape street" d={one.path} fill="none" />
        ))}
        {plan.existing.map((one, k) => (
          <path key={`e${k}`} class="shape existing" d={one.path}>
            <title>{one.name}</title>
          </path>
        ))}
        {plan.lands.map((one, k) => (
          <path key={`l${k}`} class={`shape ${one.is_boundary ? "boundary" : "plot"}`} d={one.path} fill="none" />
        ))}
        {shown.map(({ building, on }) => (
          <path
            key={building.id}
            class={`shape volume ${on.isOwn ? "" : "pale"} ${building.id === chosen ? "selected" : ""}`}
            d={proposal.paths[on.storey.path]}
            fill={building.fill}
            onClick={() => choose(building.id)}
          >
            <title>
              {building.name}, {use_name(building.use)}, storey {on.storey.number}, {whole(on.storey.area)} m²
            </title>
          </path>
        ))}
        {named(here, font).map(({ building }) => (
          <text key={`n${building.id}`} class="name" font-size={font} stroke-width={font * 0.22} x={building.at[0]} y={building.at[1] + 0.35 * font}>
            {building.name}
          </text>
        ))}
      </svg>
      <p class="small">
        {isBelow
          ? `Area of this cellar ${whole(area)} m², of all cellars ${whole(cellar_area(proposal.buildings))} m², no part of the floor area.`
          : `Floor area of this level ${whole(area)} m², of all levels ${whole(proposal.all.area)} m². Pale: a higher storey passes through.`}
      </p>
    </>
  );
}
