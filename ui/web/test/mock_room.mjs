// A room with a small scene that speaks the contract of messages, so that the page can be tested without the real server.
import { readFileSync } from "node:fs";

const scene = JSON.parse(readFileSync(new URL("../../../scenes/start/quarter.json", import.meta.url), "utf8"));
const kAnimals = ["Heron", "Otter", "Lynx", "Badger", "Curlew", "Marten", "Beaver", "Swift", "Stoat", "Plover"];
const kColours = ["#1f6f8b", "#8a5a00", "#6d3f9c", "#2c6e49", "#a0341b", "#34507a", "#7a3555", "#4d6b12", "#0b6b60", "#5a4a3a"];
const kFills = { housing: "#e8b27a", "assisted living": "#e3bf9a", cafe: "#b9a7d6", library: "#9db9dd", garage: "#b3b0aa", hotel: "#d8a3b4", office: "#9fc0cf", school: "#c8cf8d" };

const disc = (x, y, r, n, squash = 1) =>
  "M" + Array.from({ length: n }, (_, i) => {
    const a = (i / n) * 2 * Math.PI + 0.3;
    return `${(x + r * Math.cos(a)).toFixed(1)} ${(-(y + r * squash * Math.sin(a))).toFixed(1)}`;
  }).join("L") + "z";

function plan_of_scene() {
  const plan = { box: [-10, -115, 165, 10] };
  plan["n/boundary"] = { kind: "boundary", name: "Site", d: "M-5 -108L150 -108L162 -60L150 4L-5 4z", fill: "none", use: "", met: null, figures: [["Area", 17300, "m²"]] };
  plan["n/plot_north"] = { kind: "plot", name: "North plot", d: "M0 -104L146 -104L156 -62L0 -62z", fill: "#dcd8c9", use: "", met: null, figures: [["Area", 6340, "m²"]] };
  plan["n/high_street"] = { kind: "street", name: "High Street", d: "M-10 2L155 2", fill: "#888888", use: "", met: null, figures: [["Load", 61, "%"]] };
  plan["n/old_mill"] = { kind: "building", name: "Old mill", d: "M126 -20h20v16h-20z", fill: "#c9c4ba", use: "heritage", met: null, figures: [["Height", 14, "m"]] };
  let i = 0;
  for (const node of scene.nodes) {
    const volume = node.types?.smart_volume;
    if (!volume || !node.position) continue;
    i += 1;
    const size = 7 + ((i * 37) % 9), use = volume.use ?? "housing";
    plan[`n/${node.id}`] = {
      kind: "volume", name: node.name, d: disc(node.position[0], node.position[1], size, 22, 0.9), fill: kFills[use] ?? "#a9c7a4", use, met: i % 4 !== 0,
      figures: [["Floor area", Math.round(size * size * 13.7), "m²"], ["Volume", Math.round(size * size * 41), "m³"], ["Sun on 21 March", 1.2 + (i % 5) * 0.83, "h"]],
    };
  }
  return plan;
}

const vote = (question, kind, more) => ({
  question, kind, options: [], points: 10, whole: true, least: 0, most: 100, unit: "", open: true, secret: false, ends_at: 0, mine: null, count: 0,
  turnout: 0, electorate: 48, result: null, leading: null, mean: null, median: null, ...more,
});

export class MockRoom {
  seq = 40;
  tick = 900;
  seats = {};
  tokens = new Map();
  runs = new Map();
  links = new Set();
  log = [];
  ballots = new Map();     // vote -> seat -> ballot
  ratings = new Map();
  mute = false;            // swallows everything, as a network that hangs
  busy = null;
  plan = plan_of_scene();
  room = {
    title: "A mixed quarter", code: "BCDF", phase: { name: "Arriving", activities: [], ends_at: 0, forms: [] }, door: "open", layout: "plan", paused: false,
    closed: false, rate: 10,
  };
  figures = {
    sun: { name: "Sun in the gardens", value: 3.42, unit: "h", target: 4, status: "close", score: 0.8 },
    area: { name: "Total floor area", value: 24310, unit: "m²", target: 24000, status: "met", score: 1 },
    green: { name: "Open ground", value: 31.5, unit: "%", target: 40, status: "far", score: 0.5 },
  };
  card = {
    name: "Parents of the quarter", interest: "You want a school that is large enough and a safe way to it.",
    goals: [
      { name: "Room for the school", value: 3850, unit: "m²", target: 5200, status: "far" },
      { name: "Sun in the school yard", value: 3.1, unit: "h", target: 3, status: "met" },
      { name: "Way to the school", value: 412.5, unit: "m", target: 400, status: "close" },
    ],
    controls: [
      { node: "library", port: "smart_volume.demand", label: "Size of the library", value: 4800, unit: "m³", minimum: 2000, maximum: 9000, step: 100, costs: ["Hotel", "Café"] },
      { node: "near_park", port: "strength", label: "How much the school wants to be near the park", value: 0.4, unit: "", minimum: 0, maximum: 1, step: 0.05, costs: "" },
    ],
    budget: { budget: 12000, spent: 7400, left: 4600 },
  };
  votes = {
    bridge: vote("Should there be a bridge over High Street?", "yes_no", {}),
    uses: vote("Which uses matter most on the ground floor?", "rank", { options: ["Shops", "Workshops", "Nursery", "Café"].map((label) => ({ id: label.toLowerCase().replace("é", "e"), label })), secret: true }),
    money: vote("Where should the money for open space go?", "coins", { options: [{ id: "trees", label: "Trees" }, { id: "play", label: "Playground" }, { id: "benches", label: "Benches and light" }] }),
    places: vote("Where is a tower good, and where not?", "dots", { options: [{ id: "plus", label: "Plus" }, { id: "minus", label: "Minus" }], points: 3 }),
    height: vote("How high may the tallest building be?", "slider", { least: 12, most: 60, unit: "m" }),
  };
  comments = {
    c1: { seat: 0, text: "The library should stay on the ground floor, so that people with prams get in.", node: "library", plus: 6, minus: 1, state: "open" },
    c2: { seat: 0, text: "Too dark in the passage at night.", place: [70, 30, 0], plus: 3, minus: 0, state: "accepted", answer: "Lights are part of the plan now." },
    c3: { seat: 0, text: "Please keep the old mill.", node: "old_mill", plus: 9, minus: 2, state: "open" },
    c4: { seat: 0, text: "And make it a workshop.", parent: "c3", plus: 0, minus: 0, state: "open" },
  };
  proposals = {
    p1: { seat: 0, title: "A larger library", why: "It is full every afternoon.", state: "proposed", steps: 2, kept: 0, words: ["Library: demand from 4800 m³ to 6200 m³", "Hotel: demand from 9000 m³ to 7600 m³"], conflicts: [{ place: "Hotel, demand", by: "Otter" }], misfits: [] },
    p2: { seat: 0, title: "Move the hotel south", why: "More sun for the gardens.", state: "proposed", steps: 1, kept: 0, words: ["Hotel: moved to 120.4, 20, 11.9"], conflicts: [], misfits: [{ step: 0, why: "the hotel has been removed" }] },
  };
  drafts = {};

  constructor() {
    for (let i = 0; i < 6; ++i) this.take_seat("participant");
    const others = Object.keys(this.seats).map(Number);
    [...Object.values(this.comments), ...Object.values(this.proposals)].forEach((one, i) => (one.seat = others[i % others.length]));
    this.ballots.set("bridge", new Map(others.map((seat, i) => [seat, i % 3 === 0 ? "no" : "yes"])));
  }

  take_seat(role) {
    const n = Object.keys(this.seats).length + 1;
    this.seats[n] = { role, name: kAnimals[(n - 1) % kAnimals.length], colour: kColours[(n - 1) % kColours.length], here: true };
    return n;
  }

  // --- Views ----------------------------------------------------------------------------------------------------

  view(name, seat) {
    if (name === "room") return { ...this.room, seats: this.seats };
    if (name === "plan") return this.plan;
    if (name === "figures") return this.figures;
    if (name === "card") return ["facilitator", "viewer", "beamer"].includes(this.seats[seat]?.role) ? {} : this.card;
    if (name === "votes") return Object.fromEntries(Object.entries(this.votes).map(([id, one]) => {
      const count = this.ballots.get(id)?.size ?? 0;
      return [id, { ...one, mine: this.ballots.get(id)?.get(seat) ?? null, count, turnout: count / one.electorate, ...(one.open ? {} : this.result(id)) }];
    }));
    if (name === "comments") return Object.fromEntries(Object.entries(this.comments).map(([id, one]) => [id, { ...one, mine: this.ratings.get(`${id}/${seat}`) ?? 0 }]));
    if (name === "proposals") return this.proposals;
    if (name === "drafts") return Object.fromEntries(Object.entries(this.drafts).filter(([, one]) => one.seat === seat));
    return {};
  }

  result(id) {
    const one = this.votes[id], given = [...(this.ballots.get(id)?.values() ?? [])];
    if (one.kind === "slider") {
      const values = given.map(Number).sort((a, b) => a - b);
      return { result: [], mean: values.reduce((a, b) => a + b, 0) / Math.max(1, values.length), median: values[values.length >> 1] ?? null };
    }
    const options = one.kind === "yes_no" ? [{ id: "yes", label: "Yes" }, { id: "no", label: "No" }] : one.options;
    const points = Object.fromEntries(options.map((option) => [option.id, 0]));
    for (const ballot of given) {
      if (typeof ballot === "string") points[ballot] += 1;
      else if (one.kind === "rank") ballot.forEach((option, i) => (points[option] += options.length - 1 - i));
      else if (one.kind === "coins") for (const [option, n] of Object.entries(ballot)) points[option] += n;
      else if (one.kind === "dots") for (const dot of ballot) points[dot.option] += 1;
    }
    const all = Object.values(points).reduce((a, b) => a + b, 0), most = Math.max(...Object.values(points));
    const leads = options.filter((option) => points[option.id] === most);
    return {
      result: options.map((option) => ({ option: option.id, label: option.label, points: points[option.id], share: all ? points[option.id] / all : 0 })),
      leading: all > 0 && leads.length === 1 ? leads[0].id : null,
    };
  }

  /// Sends what has changed of each view that a page looks at.
  publish() {
    this.tick += 1;
    for (const link of this.links) {
      for (const name of link.views) {
        const now = this.view(name, link.seat), before = link.shown.get(name), set = {}, texts = {};
        for (const [key, value] of Object.entries(now)) {
          texts[key] = JSON.stringify(value);
          if (before?.[key] !== texts[key]) set[key] = value;
        }
        const drop = before ? Object.keys(before).filter((key) => !(key in texts)) : [];
        if (before && Object.keys(set).length === 0 && drop.length === 0) continue;
        link.shown.set(name, texts);
        this.tell(link, { t: "state", view: name, k: this.tick, s: this.seq, set, drop });
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
      return this.publish();
    }
    if (["op", "room", "undo", "redo", "rewind", "draft"].includes(m.t)) return this.operate(link, m);
  }

  hello(link, m) {
    const roles = { LEAD: "facilitator", SHOW: "beamer", LOOK: "viewer" };
    let seat = m.token ? this.tokens.get(m.token) : undefined, token;
    if (m.token && seat === undefined) return link.close(4401);
    if (seat === undefined) {
      if (this.room.door === "shut") return link.close(4401);
      seat = this.take_seat(roles[m.invite] ?? "participant");
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
      t: "welcome", you: { seat, role, name, colour, areas: [], card: "parents" }, epoch: 1, seq: this.seq, tick: this.tick, rate: 10, done: run.last,
      resume: "snapshot", ...(token ? { token } : {}), room: { code: this.room.code, title: this.room.title }, limits: {},
    });
    this.publish();
  }

  operate(link, m) {
    const run = this.runs.get(link.run);
    if (m.id <= run.last) return this.tell(link, run.answers.get(m.id) ?? { t: "ack", id: m.id, s: this.seq, k: this.tick });
    if (m.id > run.last + 1) return this.tell(link, { t: "nack", id: m.id, why: "gap", place: "id", text: "", args: { next: run.last + 1 } });
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
      const control = this.card.controls.find((one) => one.node === (a.node ?? a.id)), value = a.value ?? a.strength;
      if (!control) return { why: "gone", place: `nodes/${a.node}`, text: "there is no such node" };
      for (const one of m.if ?? []) if (one.was !== control.value) return { why: "stale", place: one.key, text: "has been changed since", args: { now: control.value, by: "Otter", seq: this.seq } };
      if (value === 6600) return { why: "area", place: "nodes/library", text: "Otter holds the pen of the area north", args: { area: "north", holder: "Otter" } };
      if (m.draft) this.drafts[m.draft].steps.push(`${control.label}: ${control.value} to ${value}`);
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
      const { position, name, types } = a.node, r = Math.cbrt(types.smart_volume.demand) * 0.6;
      this.plan[`n/${a.id}`] = { kind: "volume", name, d: disc(position[0], position[1], r, 20), fill: "#d7c35a", use: "", met: false, figures: [["Volume", types.smart_volume.demand, "m³"]] };
      return null;
    }
    return { why: "bad", place: "command", text: "unknown" };
  }

  event(seat, event, a) {
    const leads = this.seats[seat].role === "facilitator";
    if (event === "comment") this.comments[a.id] = { seat, text: a.text, node: a.node, place: a.place?.[0], parent: a.parent, plus: 0, minus: 0, state: "open" };
    else if (event === "rate_comment") {
      const one = this.comments[a.comment], key = `${a.comment}/${seat}`, before = this.ratings.get(key) ?? 0;
      one.plus += (a.rating === 1) - (before === 1);
      one.minus += (a.rating === -1) - (before === -1);
      this.ratings.set(key, a.rating);
    } else if (event === "propose") {
      const draft = this.drafts[a.draft];
      this.proposals[a.draft] = { seat, title: a.title, why: a.why, state: "proposed", steps: draft.steps.length, kept: 0, words: draft.steps, conflicts: [], misfits: [] };
      draft.state = "proposed";
    } else if (!leads) return { why: "right", place: "event", text: "only the facilitator" };
    else if (event === "answer_comment") Object.assign(this.comments[a.comment], { state: a.state, answer: a.answer });
    else if (event === "decide_proposal") Object.assign(this.proposals[a.draft], { state: a.is_accepted ? "accepted" : "rejected", answer: a.answer, kept: a.keep?.length ?? this.proposals[a.draft].steps });
    else if (event === "open_vote") Object.assign(this.votes[a.vote], { open: true, ends_at: a.ends_at });
    else if (event === "close_vote") this.votes[a.vote].open = false;
    else if (event === "set_phase") this.room.phase = { name: a.name, activities: a.activities, forms: a.forms, ends_at: a.ends_at };
    else if (event === "set_pace") Object.assign(this.room, { rate: a.rate, paused: a.is_paused });
    else if (event === "show") this.room.layout = a.layout;
    else if (event === "set_door") this.room.door = a.door;
    else if (event === "set_role") this.seats[a.seat].role = a.role;
    else if (event === "close_room") this.room.closed = true;
    return null;
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
