// What the page knows of its room: the views that the server sends, and how each own change stands.
import { Connection } from "./connection";
import { packed } from "./handover";
import { link_to, other_places } from "./places";
import type { Item, Left } from "./queue";
import type { Ballot, Deed, Health, Json, PlanItem, Presence, Seen, StateMessage, ViewName, Views, Vote, Welcome, You } from "./wire";
import { whole } from "./whole";
import type { Answer, Options, World } from "./world";
import type { Key } from "./words";

/// How the last change by one control stands.
export interface Mark {
  state: "sending" | "saved" | "refused" | "elsewhere";
  shown?: Json;
  at: number;
  seq: number;
}
/// A change that was not taken, until the person has seen it.
export interface Refusal {
  number: number;
  item: Item;
  answer: Answer & { kind: "refused" };
}
export interface Notice {
  id: string;
  at: number;
}

const kEmpty = (): Views => ({
  room: {},
  plan: {},
  figures: {},
  card: {},
  votes: {},
  comments: {},
  proposals: {},
  drafts: {},
  draft_plans: {},
  keys: {},
  lead: {},
  decisions: {},
  past: {},
  shapes: {},
});
const kMostLooked = 4; // drafts
const kMoved = 10000; // after so long without a connection, other addresses are offered
const kNoticeTime = 20000,
  kMarkTime = 6000;

export class Session {
  views: Views = kEmpty();
  arrived = new Set<ViewName>();
  you: You | null = null;
  marks = new Map<string, Mark>();
  refusals: Refusal[] = [];
  notices: Notice[] = [];
  announcement = "";
  lastVote: string | null = null; ///< the last one that was seen open
  presences: Record<string, Presence> = {};
  health: Health | null = null; ///< of the room and its computer, where the server tells
  latest = 0; ///< when the last message of the server came [ms since 1970]
  readonly connection: Connection;
  private stale = new Set<ViewName>(); // views whose next message has all of them
  private past: { at: number; seq: number }[] = [];
  private watchers = new Set<() => void>();
  private due = false;
  private refused = 0;
  private secrets = new Map<string, Ballot>();
  private read = new Map<ViewName, number>(); // the last entry that each view has read

  constructor(
    private world: World,
    private options: Options,
    private keepRun: (run: string) => void,
    reload: () => void,
  ) {
    this.connection = new Connection(world, options, {
      changed: () => this.tell(),
      welcomed: (welcome) => this.welcomed(welcome),
      told: (message) => this.told(message),
      answered: (item, answer) => this.answered(item, answer),
      reload,
    });
    for (const item of this.connection.queue.items)
      if (item.mark) this.marks.set(item.mark, { state: "sending", shown: item.shown, at: item.at, seq: 0 });
  }

  watch(watcher: () => void): () => void {
    this.watchers.add(watcher);
    return () => this.watchers.delete(watcher);
  }

  now(): number {
    return this.world.now();
  }

  has(view: ViewName): boolean {
    return this.arrived.has(view);
  }

  want(...views: ViewName[]): void {
    for (const view of views) if (!this.arrived.has(view)) this.stale.add(view);
    this.connection.want(views);
  }

  /// The view is on no screen any more. What is known of it stays until all of it comes again.
  release(view: ViewName): void {
    this.arrived.delete(view);
    this.connection.release(view);
  }

  /// These drafts are on the screen. A server that does not try drafts is not asked to.
  look(drafts: string[]): void {
    const tried = drafts.filter((id) => (this.views.proposals[id] ?? this.views.drafts[id])?.trial !== undefined);
    if (tried.length > 0) this.want("draft_plans");
    this.connection.look(tried.slice(0, kMostLooked));
  }

  // --- Own changes --------------------------------------------------------------------------------------------------

  submit(deed: Deed, more: { seen?: Seen[]; mark?: string; shown?: Json } = {}): void {
    if (more.mark) this.marks.set(more.mark, { state: "sending", shown: more.shown, at: this.now(), seq: 0 });
    this.connection.submit(deed, more);
    this.tell();
  }

  command(command: string, args: Record<string, Json>, more: { seen?: Seen[]; mark?: string; shown?: Json; draft?: string } = {}): void {
    const { draft, ...rest } = more;
    this.submit({ t: "op", c: { command, arguments: args }, ...(draft ? { draft } : {}) }, rest);
  }

  event(event: string, args: Record<string, Json>, more: { mark?: string; shown?: Json } = {}): void {
    this.submit({ t: "room", e: { event, arguments: args } }, more);
  }

  mark(name: string): Mark | null {
    return this.marks.get(name) ?? null;
  }

  /// What a control shows: what the person has set, until the view has read that entry; then what the view says.
  shown(mark: string, view: ViewName): Json | undefined {
    const one = this.marks.get(mark);
    if (!one || one.shown === undefined) return undefined;
    if (one.state === "sending" || (one.state === "saved" && (this.read.get(view) ?? 0) < one.seq)) return one.shown;
    return undefined;
  }

  /// The person has seen that it was not taken.
  dismiss(refusal: Refusal): void {
    this.refusals = this.refusals.filter((one) => one !== refusal);
    if (refusal.item.mark && this.marks.get(refusal.item.mark)?.state === "refused") this.marks.delete(refusal.item.mark);
    this.tell();
  }

  /// Once more, although somebody has changed it since.
  insist(refusal: Refusal): void {
    const { deed, mark, shown } = refusal.item;
    this.dismiss(refusal);
    this.submit(deed, { mark, shown });
  }

  /// The last entry that was known that long ago; nothing where the page has not been here so long.
  seqBefore(milliseconds: number): number | null {
    const then = this.now() - milliseconds;
    let found: number | null = null;
    for (const one of this.past) if (one.at <= then) found = one.seq;
    return found;
  }

  /// The entry to which a rewind of that long would go; nothing where it would take nothing back.
  rewindTo(milliseconds: number): number | null {
    const to = this.seqBefore(milliseconds);
    if (to === null || to >= this.connection.seq) return null;
    return (this.views.lead.unchanged ?? []).some(([first, last]) => to >= first && to <= last) ? null : to;
  }

  /// A name for something new that nobody else makes.
  freshName(kind: string): string {
    const number = parseInt(this.world.name().slice(0, 8), 16) % 1000000000;
    return `${kind}_${this.you?.seat ?? 0}_${number}`;
  }

  // --- Other addresses ----------------------------------------------------------------------------------------------

  private get placesKey(): string {
    return `${this.options.prefix}addresses`;
  }

  // Beside the key of the seat, because they are needed when no server can be asked any more.
  private keepPlaces(told: Json | undefined): void {
    this.world.store.set(this.placesKey, JSON.stringify(other_places(told, this.options.here)));
  }

  /// Where the room may be, if the server has been gone for some time: links that open the same seat there. A page cannot look
  /// there by itself, because servers talk only to pages of their own.
  places(): { address: string; link: string; takesAlong: boolean }[] {
    const { stage, since, token } = this.connection;
    const isGone = (stage === "waiting" || stage === "connecting") && this.now() - since >= kMoved;
    if (!isGone || token === null) return [];
    const { room, invite, isBeamer, here } = this.options;
    const told = JSON.parse(this.world.store.get(this.placesKey) ?? "[]") as Json;
    const waiting = packed(this.connection.queue.waiting(this.now()));
    return other_places(told, here).map((place) => ({
      address: `${place}/${room}`,
      link: link_to(place, room, { token, invite, isBeamer, waiting }),
      takesAlong: waiting !== null,
    }));
  }

  /// What was brought from another address of the room for a seat that is not the one here: its author is told that it was not sent.
  refuseBrought(runs: Left[]): void {
    for (const { items } of runs)
      for (const item of items) this.answered(item, { kind: "refused", why: "seat", place: "", text: "", args: {} });
  }

  /// The person has come by an invitation.
  get isInvited(): boolean {
    return this.options.invite !== null;
  }

  // --- Views --------------------------------------------------------------------------------------------------------

  /// The things of the plan by node, in the order of the server's keys.
  plan(): [string, PlanItem][] {
    return items_of(this.views.plan, "n/");
  }

  /// The plan of a draft that was tried.
  draftPlan(draft: string): [string, PlanItem][] {
    return items_of(this.views.draft_plans, `${draft}/n/`);
  }

  /// The plan of just before the decision of that entry; empty where the server does not have it.
  pastPlan(entry: number): [string, PlanItem][] {
    return items_of(this.views.past, `${entry}/n/`);
  }

  nameOf(node: string): string {
    const item = this.views.plan[`n/${node}`] as unknown as PlanItem | undefined;
    return item?.name || node;
  }

  seatName(seat: number): string {
    return this.views.room.seats?.[seat]?.name ?? `#${seat}`;
  }

  may(activity: "change" | "draft" | "comment" | "vote"): boolean {
    const phase = this.views.room.phase;
    return this.you?.role === "facilitator" || !phase || phase.activities.includes(activity);
  }

  // --- Messages -----------------------------------------------------------------------------------------------------

  private welcomed(welcome: Welcome): void {
    this.you = welcome.you;
    this.presences = {};
    this.health = null;
    if (!this.views.room.title)
      this.views = { ...this.views, room: { ...this.views.room, title: welcome.room.title, code: welcome.room.code } };
    for (const view of Object.keys(this.views) as ViewName[]) this.stale.add(view);
    this.keepRun(this.connection.queue.run);
    this.keepPlaces(welcome.addresses ?? []);
    this.touch();
  }

  private told(message: { t: string; [key: string]: unknown }): void {
    if (message.t === "state") this.merge(message as unknown as StateMessage);
    else if (message.t === "say") {
      const id = String(message.id);
      if (id === "addresses") return this.keepPlaces((message.args as { addresses?: Json } | undefined)?.addresses);
      if (id === "stored") this.notices = this.notices.filter((notice) => notice.id !== "storage");
      this.notices = [...this.notices.filter((notice) => notice.id !== id), { id, at: this.now() }];
    } else if (message.t === "health") this.health = message as unknown as Health;
    else if (message.t === "presence") this.meet(message.seats as Record<string, Presence | null>);
    this.touch();
  }

  private meet(seats: Record<string, Presence | null>): void {
    const next = { ...this.presences };
    for (const [seat, presence] of Object.entries(seats ?? {}))
      if (presence === null) delete next[seat];
      else next[seat] = presence;
    this.presences = next;
  }

  // The first message of a view after each welcome has all of it, so what it lacks is gone.
  private merge(state: StateMessage): void {
    const view = state.view as ViewName;
    if (!(view in this.views)) return;
    if (view === "votes") for (const [id, vote] of Object.entries(this.views.votes)) if (vote.open) this.lastVote = id;
    const isWhole = this.stale.delete(view) || state.whole === true;
    const kept = isWhole ? {} : { ...this.views[view] };
    const next: Record<string, Json> = { ...(kept as Record<string, Json>) };
    for (const [key, value] of Object.entries(state.set ?? {})) next[key] = whole(view, key, value);
    for (const key of state.drop ?? []) delete next[key];
    this.views = { ...this.views, [view]: next };
    this.arrived.add(view);
    this.read.set(view, state.s);
    if (view === "votes") this.forgetClosed();
    if (view === "room") this.meetMyself();
  }

  // The facilitator may have given another role, such as to who waited at the door.
  private meetMyself(): void {
    const seat = this.you ? this.views.room.seats?.[this.you.seat] : undefined;
    if (this.you && seat) this.you = { ...this.you, role: seat.role, card: seat.card ?? "", areas: seat.areas ?? [] };
  }

  // --- Secret ballots -----------------------------------------------------------------------------------------------

  // The server cannot tell anybody their own secret ballot. That one was cast is kept here until the vote closes; what it said,
  // only as long as the page lives.
  private castKey(vote: string): string {
    return `${this.options.prefix}cast/${vote}`;
  }

  private remember(vote: string, ballot: Ballot | null): void {
    if (ballot === null) {
      this.secrets.delete(vote);
      this.world.store.remove(this.castKey(vote));
    } else {
      this.secrets.set(vote, ballot);
      this.world.store.set(this.castKey(vote), "1");
    }
  }

  private forgetClosed(): void {
    for (const [id, vote] of Object.entries(this.views.votes)) if (!vote.open) this.remember(id, null);
  }

  /// The own ballot, as far as it is known.
  ballotOf(id: string, vote: Vote): Ballot | null {
    return vote.mine ?? (vote.secret ? (this.secrets.get(id) ?? null) : null);
  }

  hasVoted(id: string, vote: Vote): boolean {
    return vote.mine !== null || (vote.secret && this.world.store.get(this.castKey(id)) !== null);
  }

  private touch(): void {
    const now = this.now();
    this.latest = now;
    const last = this.past[this.past.length - 1];
    if (!last || last.seq !== this.connection.seq) this.past.push({ at: now, seq: this.connection.seq });
    if (this.past.length > 600) this.past.shift();
    this.notices = this.notices.filter((notice) => now - notice.at < kNoticeTime);
    this.tell();
  }

  private answered(item: Item, answer: Answer): void {
    const mark = item.mark;
    if (answer.kind === "saved" && mark?.startsWith("vote/")) this.remember(mark.slice(5), (item.shown ?? null) as Ballot | null);
    if (answer.kind === "refused") this.refusals = [...this.refusals, { number: ++this.refused, item, answer }];
    // A later change by the same control is still under way: what it shows stays.
    const later = mark !== undefined && this.connection.queue.items.some((one) => one.mark === mark);
    if (mark !== undefined && !later) {
      this.marks.set(mark, { state: answer.kind, shown: item.shown, at: this.now(), seq: answer.kind === "saved" ? answer.seq : 0 });
      if (answer.kind !== "refused") this.world.set(kMarkTime, () => this.fade(mark));
    }
    this.tell();
  }

  // A tick mark says that something was saved; after a while that goes without saying.
  private fade(name: string): void {
    const mark = this.marks.get(name);
    if (!mark || mark.state === "sending" || mark.state === "refused" || this.now() - mark.at < kMarkTime) return;
    this.marks.delete(name);
    this.tell();
  }

  // Many messages in one moment draw the page once.
  private tell(): void {
    if (this.due) return;
    this.due = true;
    this.world.set(0, () => {
      this.due = false;
      for (const watcher of [...this.watchers]) watcher();
    });
  }
}

function items_of(view: Record<string, Json | undefined>, begin: string): [string, PlanItem][] {
  const out: [string, PlanItem][] = [];
  for (const [key, value] of Object.entries(view))
    if (key.startsWith(begin) && value !== undefined) out.push([key.slice(begin.length), value as unknown as PlanItem]);
  return out;
}

/// The name of what was refused, for the sentence about it.
export function subject_of(item: Item): Key {
  const kind = (item.mark ?? "").split("/")[0];
  switch (kind) {
    case "control":
      return "what_control";
    case "vote":
      return "what_vote";
    case "comment":
      return "what_comment";
    case "rating":
      return "what_rating";
    case "draft":
      return "what_draft";
    case "propose":
      return "what_propose";
    case "form":
      return "what_form";
    case "pen":
      return "what_pen";
    case "undo":
      return "what_undo";
    case "lead":
      return "what_lead";
    default:
      return "what_op";
  }
}

/// The sentence of a refusal, with what its arguments tell.
export function why_of(answer: Answer & { kind: "refused" }): { key: Key; args: Record<string, string | number> } {
  const { why, args } = answer;
  const text = (name: string): string | number | null => {
    const value = args[name];
    return typeof value === "string" || typeof value === "number" ? value : null;
  };
  const holder = text("holder"),
    minimum = text("minimum"),
    maximum = text("maximum"),
    by = text("by"),
    most = text("most");
  if (why === "area" && holder !== null) return { key: "why_area_pen", args: { holder, area: text("area") ?? "" } };
  if (why === "range" && minimum !== null && maximum !== null) return { key: "why_range_from", args: { minimum, maximum } };
  if (why === "stale" && by !== null) return { key: "why_stale_by", args: { by } };
  if (why === "size" && most !== null) return { key: "why_size_most", args: { most } };
  if (why === "gone" && answer.place === "to") return { key: "why_rewind", args: {} };
  if (why === "locked" && answer.place === "") return { key: "why_muted", args: {} };
  return { key: `why_${why}` as Key, args: {} };
}
