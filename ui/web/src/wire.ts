// What the page says and reads, as types: messages by their declarations, with the views and contents that the server makes.
import type { FromServer } from "./messages";

export type Json = null | boolean | number | string | Json[] | { [key: string]: Json };
export type Point = [number, number, number];
export type Role = "facilitator" | "designer" | "stakeholder" | "participant" | "viewer" | "recorder" | "device";
export type Activity = "change" | "draft" | "comment" | "vote";
export type Status = "met" | "close" | "far";
export type Why =
  | "bad"
  | "gone"
  | "right"
  | "area"
  | "phase"
  | "range"
  | "budget"
  | "stale"
  | "conflict"
  | "locked"
  | "closed"
  | "rate"
  | "size"
  | "storage"
  | "draining"
  | "gap";
export type Layout = "plan" | "compare" | "vote" | "comments" | "marks" | "space" | "code";
export type Door = "open" | "asks" | "shut";

/// What a person does: an operation without its number, which the connection gives it.
export type Deed =
  | { t: "op"; c: { command: string; arguments: Record<string, Json> }; gesture?: number; draft?: string }
  | { t: "room"; e: { event: string; arguments: Record<string, Json> } }
  | { t: "undo"; gesture?: number }
  | { t: "redo"; gesture?: number }
  | { t: "rewind"; to: number }
  | { t: "draft"; do: "begin" | "undo" | "redo" | "drop"; draft: string; title?: string };

/// A value that the person saw when they acted: the key of a place, and what stood there.
export interface Seen {
  key: string;
  was: Json;
}

export interface You {
  seat: number;
  role: Role;
  name: string;
  colour: string;
  areas: string[];
  card: string;
}
// The declarations leave open what stands in fields of JSON; it is said here.
type WelcomeFields = FromServer["welcome"];
export interface Welcome extends WelcomeFields {
  you: You;
  room: { code: string; title: string };
}
type NackFields = FromServer["nack"];
export interface Nack extends NackFields {
  why: Why;
  args?: Record<string, Json>;
}
type StateFields = FromServer["state"];
export interface StateMessage extends StateFields {
  set: Record<string, Json>;
}
export type Verdict = "good" | "look" | "bad";
type HealthFields = FromServer["health"];
export interface Health extends HealthFields {
  wireless: Record<string, number>; ///< by interface: 0 to 1
  reached: Record<string, number>; ///< by address: devices
  verdicts: Record<string, Verdict>; ///< by figure
}

export interface Phase {
  name: string;
  activities: Activity[];
  ends_at: number;
  forms: string[];
}
export interface Seat {
  role: Role;
  name: string;
  colour: string;
  here: boolean;
  muted?: boolean;
  waits?: boolean; ///< came while the door asked, and has no role yet
  card?: string;
  areas?: string[];
}
/// What somebody does at the moment; nothing of it is stored.
export interface Presence {
  hidden?: boolean;
  holds?: string[];
  cursor?: Point | null;
}
/// The numbers that a visitor's form asks for, by port.
export type FormRanges = Record<string, { minimum: number; maximum: number; unit: string }>;
export interface Scenario {
  name: string;
  note: string;
  seat: number;
  seq: number;
  tick: number;
}
/// Nodes as files name a set of them: by name, or by what they have in common.
export type Selection = string | string[] | { typification?: string; tag?: string };
/// What only facilitators are told.
export interface LeadView {
  unchanged?: [number, number][]; ///< spans of entries: a rewind to one of them takes nothing back
  areas?: Record<string, { nodes: Selection; corners: number; outline?: [number, number][] }>; ///< corners [m]
  tags?: Record<string, number>; ///< of the scene, with the number of nodes
  roles?: Record<string, { label: string; count: number }>;
}
export interface RoomView {
  title?: string;
  code?: string;
  phase?: Phase;
  seats?: Record<string, Seat>;
  cards?: Record<string, { name: string; interest: string }>;
  forms?: Record<string, FormRanges>;
  areas?: Record<string, { pen: number; asking: number[] }>;
  door?: Door;
  layout?: Layout | "";
  paused?: boolean;
  closed?: boolean;
  shares_minutes?: boolean; ///< of a room that is closed: everybody who took part may open the page
  rate?: number;
  scenarios?: Record<string, Scenario>;
}

export type Figure = [label: string, value: number, unit: string];
export interface PlanItem {
  kind: "volume" | "building" | "plot" | "boundary" | "street";
  name: string;
  d: string;
  fill: string;
  use: string;
  met: boolean | null;
  figures: Figure[];
}
export type Box = [number, number, number, number];

export interface Goal {
  name: string;
  value: number;
  unit: string;
  target: number;
  status: Status;
  score?: number;
  direction?: "at_least" | "at_most" | "near";
  why?: string; ///< of a rule of a plot that is broken: by whom, and which link holds it
}
export interface Control {
  node: string;
  port: string;
  label: string;
  value: number | null; ///< null where the server does not know it
  unit: string;
  minimum: number;
  maximum: number;
  step: number;
  costs: string | string[];
  by?: string; ///< who has changed it last
  outcome?: number; ///< what links leave of the value, where that is something else
}
export interface CardView {
  name?: string;
  interest?: string;
  goals?: Goal[];
  controls?: Control[];
  budget?: { budget: number; spent: number; left: number } | null;
}

export type VoteKind = "yes_no" | "dots" | "rank" | "coins" | "slider";
export interface Option {
  id: string;
  label: string;
}
export interface Dot {
  place: Point;
  option: string;
}
export type Ballot = string | string[] | Record<string, number> | Dot[] | number;
export interface Result {
  option: string;
  label: string;
  points: number;
  share: number;
}
export interface Vote {
  question: string;
  kind: VoteKind;
  options: Option[];
  points: number;
  whole: boolean;
  least: number;
  most: number;
  unit: string;
  open: boolean;
  opened?: boolean; ///< it is or has been open
  secret: boolean;
  ends_at: number;
  mine: Ballot | null;
  count: number;
  turnout: number | null;
  electorate: number;
  result: Result[] | null;
  leading: string | null;
  mean: number | null;
  median: number | null;
}

export interface Comment {
  seat: number;
  text: string;
  node?: string;
  place?: Point | Point[];
  tick?: number;
  scenario?: string;
  parent?: string;
  plus: number;
  minus: number;
  mine: -1 | 0 | 1;
  state: "open" | "accepted" | "rejected";
  answer?: string;
}
/// A link by its kind and its ends.
export interface LinkName {
  kind: string;
  from: string;
  to: string;
}
/// A step, or a place, in parts that the page puts into words.
export interface Said {
  id?: string; ///< of the command; missing for a place
  of?: string | LinkName;
  what?: { port: string; label?: string };
  from?: Json;
  to?: Json;
  unit?: string;
  n?: number;
}
/// A place that somebody else has changed since the draft was begun.
export interface Conflict {
  place: string;
  by: string;
  label?: string;
  said?: Said;
  live?: Json;
  draft?: Json;
}
export interface TrialValue {
  value: number;
  status: Status;
  score: number;
}
export interface TrialFigure {
  id: string;
  name: string;
  unit: string;
  target: number;
  before: TrialValue | null;
  after: TrialValue | null;
  difference: number | null;
}
/// What has come of a draft beside the room. A server that tries no drafts leaves it out; null: not tried yet.
export interface Trial {
  state: "waiting" | "running" | "done" | "old";
  is_settled?: boolean; ///< nothing moves any more, with the draft and without it
  line?: number;
  figures: TrialFigure[];
}
export interface Misfit {
  step: number;
  why: string;
}
export interface Proposal {
  seat: number;
  title: string;
  why: string;
  state: string;
  steps: number;
  kept: number;
  answer?: string;
  words: string[]; ///< in English
  said?: (Said | null)[]; ///< the same in parts
  conflicts: Conflict[];
  misfits: Misfit[];
  trial?: Trial | null;
}
export interface Draft {
  title: string;
  state: string;
  steps: string[]; ///< in English
  said?: (Said | null)[];
  misfits: Misfit[];
  trial?: Trial | null;
}

/// Something that was decided before all.
export interface Decision {
  kind: "proposal" | "vote" | "phase" | "restart" | "rewind" | "mark";
  seat: number; ///< who has decided
  at: number; ///< [ms since 1970]
  title?: string;
  text?: string;
  of?: number; ///< the seat whose proposal it was
  vote?: string; ///< what it came to stands in the view of the votes
}

export interface Views {
  room: RoomView;
  plan: Record<string, Json | undefined> & { box?: Box };
  figures: Record<string, Goal>;
  card: CardView;
  votes: Record<string, Vote>;
  comments: Record<string, Comment>;
  proposals: Record<string, Proposal>;
  drafts: Record<string, Draft>;
  keys: Partial<Record<Role, string>>; ///< of invitations; empty for all but facilitators
  lead: LeadView; ///< empty for all but facilitators
  draft_plans: Record<string, Json>; ///< `DRAFT/box` and `DRAFT/n/ID`
  decisions: Record<string, Decision>; ///< by entry
  past: Record<string, Json>; ///< `ENTRY/n/ID`: the plan of just before a decision
  shapes: Record<string, Json>; ///< what space/contents has the types of
}
export type ViewName = keyof Views;
