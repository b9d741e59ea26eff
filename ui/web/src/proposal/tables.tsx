// The tables of a proposal: programme against result, buildings, storeys, plots, indicators.
import type { ComponentChildren, JSX } from "preact";
import { Indicator, Proposal, cellar_area, drawn_storeys, figure, hundredths, signed, use_name, whole } from "./data";
import type { Choice } from "./model";

// Wide tables move sideways within their own frame, which the keyboard reaches.
function Table({ label, head, children }: { label: string; head: string[]; children: ComponentChildren }): JSX.Element {
  return (
    <div class="wide_table" role="region" aria-label={label} tabIndex={0}>
      <table>
        <thead>
          <tr>
            {head.map((one) => (
              <th key={one} scope="col">
                {one}
              </th>
            ))}
          </tr>
        </thead>
        <tbody>{children}</tbody>
      </table>
    </div>
  );
}

function Patch({ fill }: { fill: string }): JSX.Element {
  return (
    <svg class="patch" viewBox="0 0 10 10" aria-hidden="true">
      <rect width="10" height="10" fill={fill} />
    </svg>
  );
}

export function Programme({ proposal }: { proposal: Proposal }): JSX.Element {
  const row = (use: Proposal["all"], name: JSX.Element | string, key: string): JSX.Element => (
    <tr key={key}>
      <th scope="row">{name}</th>
      <td>{use.buildings}</td>
      <td>{whole(use.asked_area)}</td>
      <td>{whole(use.area)}</td>
      <td>{signed(use.area - use.asked_area)}</td>
      <td>{use.asked_area > 0 ? `${whole((100 * use.area) / use.asked_area)} %` : ""}</td>
      <td>{whole(use.volume)}</td>
    </tr>
  );
  const below = proposal.buildings.filter((one) => one.cellars.length > 0);
  return (
    <Table label="Uses" head={["Use", "Buildings", "Asked m²", "Floor m²", "Difference m²", "Met", "Volume m³"]}>
      {proposal.uses.map((use) =>
        row(
          use,
          <>
            <Patch fill={use.fill} /> {use_name(use.use)}
          </>,
          use.use,
        ),
      )}
      {row(proposal.all, "All", " all")}
      {below.length > 0 ? (
        <tr>
          <th scope="row">Cellars, not counted above</th>
          <td>{below.length}</td>
          <td />
          <td>{whole(cellar_area(below))}</td>
          <td />
          <td />
          <td />
        </tr>
      ) : null}
    </Table>
  );
}

export function OpenSpaces({ proposal }: { proposal: Proposal }): JSX.Element {
  return (
    <Table label="Open space" head={["Open space", "Asked m²", "Open m²", "Difference m²", "Met", "Why"]}>
      {proposal.open.map((one) => (
        <tr key={one.use}>
          <th scope="row">{one.use}</th>
          <td>{whole(one.asked_area)}</td>
          <td>{whole(one.area)}</td>
          <td>{signed(one.area - one.asked_area)}</td>
          <td>{one.asked_area > 0 ? `${whole((100 * one.area) / one.asked_area)} %` : ""}</td>
          <td class="words">{one.why}</td>
        </tr>
      ))}
    </Table>
  );
}
const has_cellars = (proposal: Proposal): boolean => proposal.buildings.some((one) => one.cellars.length > 0);

export function Buildings({ proposal, chosen, choose }: { proposal: Proposal } & Choice): JSX.Element {
  const hasCellars = has_cellars(proposal);
  return (
    <Table
      label="Buildings"
      head={["Building", "Use", "Form", "Storeys", ...(hasCellars ? ["Cellars"] : []), "Asked m²", "Floor m²", "Difference m²", "Footprint m²", "Top m", "Volume m³"]}
    >
      {proposal.buildings.map((one) => (
        <tr key={one.id} class={one.id === chosen ? "chosen" : ""}>
          <th scope="row">
            <button class="link" aria-pressed={one.id === chosen} onClick={() => choose(one.id === chosen ? null : one.id)}>
              {one.name}
            </button>
          </th>
          <td class="words">
            <Patch fill={one.fill} /> {use_name(one.use)}
          </td>
          <td class="words">{one.why ? `${one.form}: ${one.why}` : one.form}</td>
          <td>{one.storeys.length}</td>
          {hasCellars ? <td>{one.cellars.length || ""}</td> : null}
          <td>{whole(one.asked_area)}</td>
          <td>{whole(one.area)}</td>
          <td>{signed(one.area - one.asked_area)}</td>
          <td>{whole(one.footprint)}</td>
          <td>{hundredths(one.top)}</td>
          <td>{whole(one.volume)}</td>
        </tr>
      ))}
    </Table>
  );
}

export function Storeys({ proposal }: { proposal: Proposal }): JSX.Element {
  const hasCellars = has_cellars(proposal),
    names = new Map(proposal.plan.levels.map((level) => [level.number, level.name]));
  return (
    <Table label="Storeys" head={["Building", "Use", "Storey", "Level", "From m", "To m", "Floor m²", ...(hasCellars ? ["Cellar m²"] : [])]}>
      {proposal.buildings.flatMap((building) =>
        drawn_storeys(building).map((one) => (
          <tr key={`${building.id} ${one.number}`}>
            <th scope="row">{building.name}</th>
            <td class="words">{use_name(building.use)}</td>
            <td>{one.number}</td>
            <td>{names.get(one.level)}</td>
            <td>{hundredths(one.bottom)}</td>
            <td>{hundredths(one.top)}</td>
            <td>{one.number < 0 ? "" : whole(one.area)}</td>
            {hasCellars ? <td>{one.number < 0 ? whole(one.area) : ""}</td> : null}
          </tr>
        )),
      )}
    </Table>
  );
}

export function Plots({ proposal }: { proposal: Proposal }): JSX.Element {
  const limit = (value: number | null): string => (value === null ? "" : hundredths(value));
  return (
    <Table label="Plots" head={["Plot", "Land m²", "FSI", "Most FSI", "GSI", "Most GSI", "Most height m"]}>
      {proposal.plots.map((one) => (
        <tr key={`${one.is_boundary} ${one.name}`}>
          <th scope="row">{one.name}</th>
          <td>{whole(one.area)}</td>
          <td>{one.is_boundary ? "" : hundredths(one.fsi)}</td>
          <td>{limit(one.fsi_max)}</td>
          <td>{one.is_boundary ? "" : hundredths(one.gsi)}</td>
          <td>{limit(one.gsi_max)}</td>
          <td>{limit(one.height_max)}</td>
        </tr>
      ))}
    </Table>
  );
}

const kGoals: Record<string, string> = { at_least: "at least", at_most: "at most", near: "near" };

export function Indicators({ indicators }: { indicators: Indicator[] }): JSX.Element {
  return (
    <Table label="Table of indicators" head={["Indicator", "Now", "Goal", "State", "Score"]}>
      {indicators.map((one) => (
        <tr key={one.name}>
          <th scope="row">{one.name}</th>
          <td>{figure(one.value, one.unit)}</td>
          <td>
            {kGoals[one.direction] ?? one.direction} {figure(one.target, one.unit)}
          </td>
          <td class="words">{one.status}</td>
          <td>{hundredths(one.score)}</td>
        </tr>
      ))}
    </Table>
  );
}
