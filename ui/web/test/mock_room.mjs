// A room with a small scene that speaks the contract of messages, so that the page can be tested without the real server.
import { disc, first_views, health, shapes_of } from "./mock_scene.mjs";

const kAnimals = ["Heron", "Otter", "Lynx", "Badger", "Curlew", "Marten", "Beaver", "Swift", "Stoat", "Plover"];
const kColours = ["#1f6f8b", "#8a5a00", "#6d3f9c", "#2c6e49", "#a0341b", "#34507a", "#7a3555", "#4d6b12", "#0b6b60", "#5a4a3a"];
export class MockRoom {
  seq = 40;
  tick = 900;
  seats = {};
  tokens = new Map();
  areas = {};
  pens = {}; // by area: its holder, and who asks
  asked_minutes = [];
  asked_plans = [];
  minutes_fault = 0; // the status of the answer, where there are none
  runs = new Map();
  links = new Set();
  log = [];
  ballots = new Map(); // vote -> seat -> ballot
  ratings = new Map();
  presences = {};
  renewals = 0; // of keys
  addresses = []; // where else the room can be found
  health = health();
  mute = false; // swallows everything, as a network that hangs
  busy = null;
  constructor() {
    Object.assign(this, first_views());
    for (let i = 0; i < 6; ++i) this.take_seat("participant");
    const others = Object.keys(this.seats).map(Number);
    [...Object.values(this.comments), ...Object.values(this.proposals)].forEach((one, i) => (one.seat = others[i % others.length]));
    this.ballots.set("bridge", new Map(others.map((seat, i) => [seat, i % 3 === 0 ? "no" : "yes"])));
  }

  take_seat(role) {
    const n = Object.keys(this.seats).length + 1;
    this.seats[n] = {
      role,
      name: kAnimals[(n - 1) % kAnimals.length],
      colour: kColours[(n - 1) % kColours.length],
      here: true,
      muted: false,
      card: "",
      areas: [],
    };
    return n;
  }

  // The plans of the drafts that this seat looks at: the library stands elsewhere in each.
  draft_plans(seat) {
    const looked = [...this.links].filter((link) => link.seat === seat).flatMap((link) => link.drafts ?? []);
    const out = {};
    looked.forEach((draft, i) => {
      for (const [key, content] of Object.entries(this.plan)) out[`${draft}/${key}`] = content;
      out[`${draft}/n/library`] = { ...this.plan["n/library"], d: disc(40 + 30 * i, 40, 9, 12) };
    });
    return out;
  }

  // The library stood elsewhere before the last decision. Of the others this server has no plan, as one that was started since.
  past_plans() {
    const last = Object.keys(this.decisions).at(-1),
      out = {};
    for (const [key, content] of Object.entries(this.plan)) out[`${last}/${key}`] = content;
    return { ...out, [`${last}/n/library`]: { ...this.plan["n/library"], d: disc(40, 40, 9, 12) } };
  }

  // --- Views ----------------------------------------------------------------------------------------------------

  view(name, seat) {
    if (name === "room") {
      const areas = Object.fromEntries(Object.keys(this.areas).map((area) => [area, this.pens[area] ?? { pen: 0, asking: [] }]));
      return { ...this.room, seats: this.seats, areas };
    }
    if (name === "lead") return this.seats[seat]?.role === "facilitator" ? this.lead_view() : {};
    if (name === "plan") return this.plan;
    if (name === "decisions") return this.decisions;
    if (name === "past") return this.past_plans();
    if (name === "shapes") return shapes_of(this.plan);
    if (name === "draft_plans") return this.draft_plans(seat);
    if (name === "figures") return this.figures;
    if (name === "card") return ["facilitator", "viewer"].includes(this.seats[seat]?.role) ? {} : this.card;
    if (name === "votes")
      return Object.fromEntries(
        Object.entries(this.votes).map(([id, one]) => {
          const count = this.ballots.get(id)?.size ?? 0;
          return [
            id,
            {
              ...one,
              mine: one.secret ? null : (this.ballots.get(id)?.get(seat) ?? null), // nobody can tell whose a secret ballot is
              count,
              turnout: count / one.electorate,
              ...(one.open ? {} : this.result(id)),
            },
          ];
        }),
      );
    if (name === "comments")
      return Object.fromEntries(
        Object.entries(this.comments).map(([id, one]) => [id, { ...one, mine: this.ratings.get(`${id}/${seat}`) ?? 0 }]),
      );
    if (name === "proposals")
      return Object.fromEntries(
        Object.entries(this.proposals).map(([id, one]) => {
          const { conflicts, misfits, ...rest } = one;
          return [id, one.state === "proposed" ? one : rest];
        }),
      );
    if (name === "keys") return this.seats[seat]?.role === "facilitator" ? this.keys() : {};
    if (name === "drafts") return Object.fromEntries(Object.entries(this.drafts).filter(([, one]) => one.seat === seat));
    return {};
  }

  lead_view() {
    return {
      areas: this.areas,
      tags: { living: 6, work: 4 },
      roles: { smart_volume: { label: "Volume", count: 17 }, street: { label: "Street", count: 3 } },
    };
  }

  keys() {
    const roles = ["facilitator", "designer", "stakeholder", "participant", "viewer", "recorder"];
    return Object.fromEntries(roles.map((role) => [role, `${role}-${this.renewals}`]));
  }

  result(id) {
    const one = this.votes[id],
      given = [...(this.ballots.get(id)?.values() ?? [])];
    if (one.kind === "slider") {
      const values = given.map(Number).sort((a, b) => a - b);
      return {
        result: [],
        mean: values.reduce((a, b) => a + b, 0) / Math.max(1, values.length),
        median: values[values.length >> 1] ?? null,
      };
    }
    const fixed = { yes_no: ["Yes", "No"], dots: ["Plus", "Minus"] }[one.kind];
    const options = fixed ? fixed.map((label) => ({ id: label.toLowerCase(), label })) : one.options;
    const points = Object.fromEntries(options.map((option) => [option.id, 0]));
    for (const ballot of given) {
      if (typeof ballot === "string") points[ballot] += 1;
      else if (one.kind === "rank") ballot.forEach((option, i) => (points[option] += options.length - 1 - i));
      else if (one.kind === "coins") for (const [option, n] of Object.entries(ballot)) points[option] += n;
      else if (one.kind === "dots") for (const dot of ballot) points[dot.option] += 1;
    }
    const all = Object.values(points).reduce((a, b) => a + b, 0),
      most = Math.max(...Object.values(points));
    const leads = options.filter((option) => points[option.id] === most);
    return {
      result: options.map((option) => ({
        option: option.id,
        label: option.label,
        points: points[option.id],
        share: all ? points[option.id] / all : 0,
      })),
      leading: all > 0 && leads.length === 1 ? leads[0].id : "",
    };
  }

  /// Sends what has changed of each view that a page looks at.
  publish() {
    this.tick += 1;
    for (const link of this.links) {
      for (const name of link.views) {
        const now = this.view(name, link.seat),
          before = link.shown.get(name),
          set = {},
          texts = {};
        for (const [key, value] of Object.entries(now)) {
          texts[key] = JSON.stringify(value);
          if (before?.[key] !== texts[key]) set[key] = value;
        }
        const drop = before ? Object.keys(before).filter((key) => !(key in texts)) : [];
        if (before && Object.keys(set).length === 0 && drop.length === 0) continue;
        link.shown.set(name, texts);
        this.tell(link, { t: "state", view: name, k: this.tick, s: this.seq, set, drop, ...(before ? {} : { whole: true }) });
      }
    }
  }

  tell(link, message) {
    if (!this.mute) link.send(JSON.stringify(message));
  }

  // --- Messages -------------------------------------------------------------------------------------------------

  connected(link) {
    link.views = new Set();
    link.shown = new Map();
  }

  closed(link) {
    this.links.delete(link);
    const seat = this.seats[link.seat];
    if (seat && ![...this.links].some((one) => one.seat === link.seat)) seat.here = false;
    this.publish();
  }

  receive(link, text) {
    if (this.mute) return;
    const m = JSON.parse(text);
    this.log.push(m);
    if (m.t === "hello") return this.hello(link, m);
    if (m.t === "ping") return this.tell(link, { t: "pong", n: m.n, k: this.tick });
    if (m.t === "want") {
      link.views = new Set(m.views);
      link.drafts = m.drafts ?? [];
      for (const name of [...link.shown.keys()]) if (!link.views.has(name)) link.shown.delete(name);
      return this.publish();
    }
    if (m.t === "presence") {
      const { hidden, holds } = m;
      this.presences[link.seat] = { hidden, holds };
      for (const other of this.links) this.tell(other, { t: "presence", seats: { [link.seat]: { hidden, holds } } });
      return;
    }
    if (["op", "room", "undo", "redo", "rewind", "draft"].includes(m.t)) return this.operate(link, m);
  }

  hello(link, m) {
    const roles = { LEAD: "facilitator", SHOW: "viewer", LOOK: "viewer" };
    let seat = m.token ? this.tokens.get(m.token) : undefined,
      token;
    if (m.token && seat === undefined) return link.close(4401);
    if (seat === undefined) {
      if (this.room.door === "shut") return link.close(4401);
      const waits = this.room.door === "asks" && !m.invite && m.kind !== "beamer";
      seat = this.take_seat(waits ? "viewer" : (roles[m.invite] ?? "participant"));
      if (waits) this.seats[seat].waits = true;
      token = `token-${seat}-${Math.random().toString(36).slice(2)}`;
      this.tokens.set(token, seat);
    }
    const run = this.runs.get(m.run) ?? { last: 0, answers: new Map() };
    this.runs.set(m.run, run);
    run.last = Math.max(run.last, m.unacked ?? 0);
    for (const other of this.links) if (other.run === m.run) other.close(4409);
    Object.assign(link, { seat, run: m.run, views: new Set(m.views ?? []) });
    link.shown.clear();
    this.links.add(link);
    this.seats[seat].here = true;
    const { role, name, colour } = this.seats[seat];
    this.tell(link, {
      t: "welcome",
      you: { seat, role, name, colour, areas: [], card: "parents" },
      epoch: 1,
      seq: this.seq,
      tick: this.tick,
      rate: 10,
      done: run.last,
      resume: "snapshot",
      ...(token ? { token } : {}),
      room: { code: this.room.code, title: this.room.title },
      addresses: this.addresses,
      limits: {},
    });
    this.tell(link, { t: "presence", seats: this.presences });
    if (role === "facilitator") this.tell(link, this.health);
    this.publish();
  }

  operate(link, m) {
    const run = this.runs.get(link.run);
    if (m.id <= run.last) return this.tell(link, run.answers.get(m.id) ?? { t: "ack", id: m.id, s: this.seq, k: this.tick });
    if (m.id > run.last + 1)
      return this.tell(link, { t: "nack", id: m.id, why: "gap", place: "id", text: "", args: { next: run.last + 1 } });
    run.last = m.id;
    const why = this.busy ?? this.apply(link.seat, m);
    if (!why) this.seq += 1;
    const answer = why ? { t: "nack", id: m.id, place: "", text: "", args: {}, ...why } : { t: "ack", id: m.id, s: this.seq, k: this.tick };
    run.answers.set(m.id, answer);
    this.tell(link, answer);
    this.publish();
  }

  apply(seat, m) {
    if (m.t === "op") return this.command(seat, m);
    if (m.t === "room") return this.event(seat, m.e.event, m.e.arguments);
    if (m.t === "draft" && m.do === "begin") this.drafts[m.draft] = { seat, title: m.title, state: "open", steps: [], misfits: [] };
    if (m.t === "draft" && m.do === "drop") delete this.drafts[m.draft];
    if (m.t === "draft" && m.do === "undo") this.drafts[m.draft].steps.pop();
    return null;
  }

  command(seat, m) {
    const { command, arguments: a } = m.c;
    if (command === "set_port" || command === "set_link_strength") {
      const control = this.card.controls.find((one) => one.node === (a.node ?? a.id)),
        value = a.value ?? a.strength;
      if (!control) return { why: "gone", place: `nodes/${a.node}`, text: "there is no such node" };
      for (const one of m.if ?? [])
        if (one.was !== control.value)
          return { why: "stale", place: one.key, text: "has been changed since", args: { now: control.value, by: "Otter", seq: this.seq } };
      if (value === 6600)
        return {
          why: "area",
          place: "nodes/library",
          text: "Otter holds the pen of the area north",
          args: { area: "north", holder: "Otter" },
        };
      if (m.draft) {
        const draft = this.drafts[m.draft],
          said = { id: command, of: control.node, what: { port: control.port, label: control.label }, from: control.value, to: value, unit: control.unit };
        draft.steps.push(`${control.label}: ${control.value} to ${value}`);
        draft.said = [...(draft.said ?? []), said];
      }
      else this.card.controls = this.card.controls.map((one) => (one === control ? { ...one, value } : one));
      return null;
    }
    if (command === "cast_vote") {
      if (!this.votes[a.node]?.open) return { why: "closed", place: "node", text: "this vote is not open" };
      if (a.voter !== `seat ${seat}`) return { why: "right", place: "voter", text: "not your seat" };
      const given = this.ballots.get(a.node) ?? new Map();
      this.ballots.set(a.node, given);
      if (a.ballot === null) given.delete(seat);
      else given.set(seat, a.ballot);
      return null;
    }
    if (command === "add_node") {
      const { position, name, types } = a.node,
        r = Math.cbrt(types.smart_volume.demand) * 0.6;
      this.plan[`n/${a.id}`] = {
        kind: "volume",
        name,
        d: disc(position[0], position[1], r, 20),
        fill: "#d7c35a",
        use: "",
        met: false,
        figures: [["Volume", types.smart_volume.demand, "m³"]],
      };
      return null;
    }
    return { why: "bad", place: "command", text: "unknown" };
  }

  event(seat, event, a) {
    const leads = this.seats[seat].role === "facilitator";
    if (event === "comment")
      this.comments[a.id] = { seat, text: a.text, node: a.node, place: a.place?.[0], parent: a.parent, plus: 0, minus: 0, state: "open" };
    else if (event === "rate_comment") {
      const one = this.comments[a.comment],
        key = `${a.comment}/${seat}`,
        before = this.ratings.get(key) ?? 0;
      one.plus += (a.rating === 1) - (before === 1);
      one.minus += (a.rating === -1) - (before === -1);
      this.ratings.set(key, a.rating);
    } else if (event === "propose") {
      const draft = this.drafts[a.draft];
      this.proposals[a.draft] = {
        seat,
        title: a.title,
        why: a.why,
        state: "proposed",
        steps: draft.steps.length,
        kept: 0,
        words: draft.steps,
        said: draft.said,
        conflicts: [],
        misfits: [],
      };
      draft.state = "proposed";
    } else if (event === "ask_pen" || event === "give_pen") return this.pen(seat, event, a);
    else if (!leads) return { why: "right", place: "event", text: "only the facilitator" };
    else if (event === "answer_comment") Object.assign(this.comments[a.comment], { state: a.state, answer: a.answer });
    else if (event === "decide_proposal")
      Object.assign(this.proposals[a.draft], {
        state: a.is_accepted ? "accepted" : "rejected",
        answer: a.answer,
        kept: a.keep?.length ?? this.proposals[a.draft].steps,
      });
    else if (event === "open_vote") Object.assign(this.votes[a.vote], { open: true, opened: true, ends_at: a.ends_at });
    else if (event === "close_vote") this.votes[a.vote].open = false;
    else if (event === "set_phase") this.room.phase = { name: a.name, activities: a.activities, forms: a.forms, ends_at: a.ends_at };
    else if (event === "set_pace") Object.assign(this.room, { rate: a.rate, paused: a.is_paused });
    else if (event === "show") this.room.layout = a.layout;
    else if (event === "renew_keys") this.renewals += 1;
    else if (event === "set_door") this.room.door = a.door;
    else if (event === "mute") this.seats[a.seat].muted = a.is_muted;
    else if (event === "set_role") Object.assign(this.seats[a.seat], { role: a.role, card: a.card, areas: a.areas, waits: undefined });
    else if (event === "define_area") this.define_area(a);
    else if (event === "drop_area") {
      delete this.areas[a.area];
      for (const one of Object.values(this.seats)) one.areas = one.areas.filter((area) => area !== a.area);
    }
    else if (event === "close_room") {
      if (Object.values(this.votes).some((vote) => vote.open)) return { why: "closed", place: "event", text: "a vote is open" };
      Object.assign(this.room, { closed: true, shares_minutes: a.shares_minutes === true });
    } else if (event === "save_scenario")
      this.room.scenarios = { ...this.room.scenarios, [a.id]: { name: a.name, note: "", seat, seq: this.seq, tick: 1200 } };
    else if (event === "restart") this.restarted = a.scenario;
    return null;
  }

  define_area({ area, nodes = [], outline = [] }) {
    this.areas[area] = { nodes, corners: outline.length, ...(outline.length > 0 ? { outline: outline.map(([x, y]) => [x, y]) } : {}) };
  }

  // As the room does it, but for the time that passes.
  pen(seat, event, { area, asks, seat: to }) {
    const one = (this.pens[area] = { asking: [], pen: 0, ...this.pens[area] }),
      { role, areas } = this.seats[seat];
    if (event === "ask_pen") {
      if (!areas.includes(area)) return { why: "conflict", place: "area", text: "not yours" };
      one.asking = one.asking.filter((other) => other !== seat);
      if (asks && one.pen === 0) one.pen = seat;
      else if (asks) one.asking.push(seat);
    } else {
      if (one.pen !== seat && role !== "facilitator") return { why: "conflict", place: "area", text: "somebody else has the pen" };
      one.pen = to;
      one.asking = one.asking.filter((other) => other !== to);
    }
    return null;
  }

  /// For tests: facilitators hear how the computer is from now on.
  tell_health(change) {
    this.health = { ...this.health, ...change };
    for (const link of this.links) if (this.seats[link.seat].role === "facilitator") this.tell(link, this.health);
  }
  /// For tests: the phase, and which votes are open.
  phase(name, activities, more = {}) {
    this.room.phase = { name, activities, ends_at: 0, forms: [], ...more };
    this.publish();
  }
  open_votes(...names) {
    for (const [id, one] of Object.entries(this.votes)) one.open = names.includes(id);
    this.publish();
  }
}
