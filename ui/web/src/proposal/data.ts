// What a page of a proposal holds: made by core/export/formats/html.cpp. Whoever changes it raises `data-version` in index.html and
// `kDataVersion` there: an export refuses a page that reads other data.
import type { Look } from "../space/picture";

export interface Storey {
  number: number; ///< from 0 up, below the ground -1, -2, ...
  level: number; ///< of the plan that shows it: the `number` of a level
  bottom: number; ///< [m]
  top: number; ///< [m]
  area: number; ///< [m²]
  path: number; ///< index into `paths`
}
export interface Building {
  id: string;
  name: string;
  use: string;
  fill: string;
  form: string;
  why: string; ///< why it has no shape
  at: [number, number]; ///< in the plan [dm]
  area: number;
  asked_area: number;
  volume: number;
  asked_volume: number;
  footprint: number;
  bottom: number;
  top: number;
  storeys: Storey[];
  cellars: Storey[]; ///< below the ground, from the top down: no floor area
}
export interface Level {
  number: number;
  name: string; ///< "Level 3", "Cellar 1"
  heights: string; ///< "from -3.00 m"
  bottom: number; ///< of its lowest floor [m]
}
export interface Use {
  use: string;
  letter: string;
  fill: string;
  buildings: number;
  area: number;
  asked_area: number;
  volume: number;
  asked_volume: number;
}
export interface OpenSpace {
  use: string;
  area: number; ///< kept open [m²]
  asked_area: number;
  why: string; ///< why there is less than asked for
}
export interface Plot {
  name: string;
  is_boundary: boolean;
  area: number;
  fsi: number;
  gsi: number;
  fsi_max: number | null; ///< no rule where null, as the others
  gsi_max: number | null;
  height_max: number | null;
}
export interface Indicator {
  name: string;
  value: number;
  target: number;
  unit: string;
  direction: string;
  status: string;
  score: number;
}
interface Outline {
  name: string;
  path: string; ///< in decimetres, y downwards
}
export interface Proposal {
  title: string;
  about: string;
  settled: boolean;
  identity: [string, string][];
  true_north: number; ///< clockwise from the y axis [deg]
  plan: {
    box: [number, number, number, number]; ///< [dm]
    levels: Level[]; ///< from the deepest cellar up
    level_height: number;
    lands: (Outline & { is_boundary: boolean })[];
    existing: Outline[];
    streets: Outline[];
  };
  paths: string[];
  buildings: Building[];
  uses: Use[];
  all: Use;
  open: OpenSpace[];
  plots: Plot[];
  indicators: Indicator[];
  conflicts: { node: string; port: string; tension: string; pulls: string[] }[];
  minor_conflicts: number;
  troubles: { place: string; message: string }[];
  shapes: Record<string, unknown>; ///< as in the view `shapes` of a room
  looks: Record<string, Look>;
}

/// The storeys of a building that plans show, from the deepest cellar up.
export const drawn_storeys = (building: Building): Storey[] => [...[...building.cellars].reverse(), ...building.storeys];
/// The area of what is below the ground [m²].
export const cellar_area = (buildings: Building[]): number =>
  buildings.reduce((sum, one) => sum + one.cellars.reduce((area, cellar) => area + cellar.area, 0), 0);

export const use_name = (use: string): string => use || "no use";

const plain = new Intl.NumberFormat("en", { maximumFractionDigits: 0 }),
  fine = new Intl.NumberFormat("en", { minimumFractionDigits: 2, maximumFractionDigits: 2 }),
  short = new Intl.NumberFormat("en", { maximumSignificantDigits: 4 });
export const whole = (value: number): string => plain.format(value);
export const hundredths = (value: number): string => fine.format(value);
export const figure = (value: number, unit: string): string =>
  `${short.format(value)} ${unit.replace(/2$/, "²").replace(/3$/, "³")}`.trim();
export const signed = (value: number): string => (Math.round(value) > 0 ? "+" : "") + plain.format(Math.round(value) + 0);
