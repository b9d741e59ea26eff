// The scene of the mock room: a plan, figures, a role card, votes of all kinds, comments and proposals.
import { readFileSync } from "node:fs";

const scene = JSON.parse(readFileSync(new URL("../../../scenes/start/quarter.json", import.meta.url), "utf8"));
const kFills = {
  housing: "#e8b27a",
  "assisted living": "#e3bf9a",
  cafe: "#b9a7d6",
  library: "#9db9dd",
  garage: "#b3b0aa",
  hotel: "#d8a3b4",
  office: "#9fc0cf",
  school: "#c8cf8d",
};

export const disc = (x, y, r, n, squash = 1) =>
  "M" +
  Array.from({ length: n }, (_, i) => {
    const a = (i / n) * 2 * Math.PI + 0.3;
    return `${(x + r * Math.cos(a)).toFixed(1)} ${(-(y + r * squash * Math.sin(a))).toFixed(1)}`;
  }).join("L") +
  "z";

function plan_of_scene() {
  const plan = { box: [-10, -115, 165, 10] };
  // What is no volume comes without colour and figures.
  plan["n/site/Site"] = { kind: "boundary", name: "Site", d: "M-5 -108l155 0l12 48l-12 64l-155 0z" };
  plan["n/plot/north"] = { kind: "plot", name: "North plot", d: "M0 -104l146 0l10 42l-156 0z" };
  plan["n/street/High Street"] = { kind: "street", name: "High Street", d: "M-10 2l165 0", lanes: 2 };
  plan["n/building/Old mill"] = { kind: "building", name: "Old mill", d: "M126 -20l20 0l0 16l-20 0z", use: "heritage" };
  let i = 0;
  for (const node of scene.nodes) {
    const volume = node.types?.smart_volume;
    if (!volume || !node.position) continue;
    i += 1;
    const size = 7 + ((i * 37) % 9),
      use = volume.use ?? "housing";
    plan[`n/${node.id}`] = {
      kind: "volume",
      name: node.name,
      d: disc(node.position[0], node.position[1], size, 22, 0.9),
      fill: kFills[use] ?? "#a9c7a4",
      use,
      met: i % 4 !== 0,
      figures: [
        ["volume", Math.round(size * size * 41), "m³"],
        ["demand", Math.round(size * size * 45), "m³"],
        ["floor_area", Math.round(size * size * 13.7), "m²"],
        ["height", 9 + (i % 5) * 3, "m"],
      ],
    };
  }
  return plan;
}

/// The volumes of a plan as upright bodies, and its other outlines on the ground.
export function shapes_of(plan) {
  const shapes = { space: { t: "space", origin: [0, 0, 0], is_coarse: true, left_out: 2 } };
  for (const [key, item] of Object.entries(plan)) {
    // Outlines of volumes have absolute places.
    const numbers = item.kind === "volume" ? (item.d.match(/-?[\d.]+/g) ?? []).map((value) => Math.round(100 * value)) : [];
    if (numbers.length === 0) continue;
    const ring = numbers.map((value, i) => (i % 2 ? -value : value));
    shapes[key] = { t: "prism", ring, low: 0, high: 100 * (item.figures.find(([label]) => label === "height")?.[1] ?? 10) };
  }
  return shapes;
}

const vote = (question, kind, more) => ({
  question,
  kind,
  options: [],
  points: 10,
  whole: true,
  least: 0,
  most: 100,
  unit: "",
  open: true,
  opened: true,
  secret: false,
  ends_at: 0,
  mine: null,
  count: 0,
  turnout: 0,
  electorate: 48,
  result: null,
  leading: "",
  mean: null,
  median: null,
  ...more,
});

/// The views as they are when the room opens.
/// What has come of a draft: the sun gets better, and the open ground less.
function trial(state, before, after) {
  const figure = (id, name, unit, target, was, is) => ({
    id,
    name,
    unit,
    target,
    before: { value: was, status: "close", score: 0.8 },
    after: { value: is, status: is >= target ? "met" : "close", score: 0.9 },
    difference: Math.round((is - was) * 100) / 100,
  });
  const figures = [figure("sun", "Sun in the gardens", "h", 4, before, after), figure("green", "Open ground", "%", 40, 31.5, 30)];
  return { state, ticks: 60, is_settled: state === "done", seq: 40, figures };
}

/// A laptop on mains to which phones have come; nothing has to be done.
export const health = () => ({
  t: "health",
  tick_ms: 4.2,
  rate: 10,
  wanted: 10,
  settled: false,
  worst: 0.21,
  worst_of: "hotel",
  disk_ms: 4.1,
  disk_slow_ms: 8.3,
  file: "/home/anna/Sessions of spring/quarter.blsession",
  journal: 2400000,
  snapshot_age: 45,
  followers: 1,
  battery: 0.87,
  mains: "yes",
  wireless: { wlan0: 0.8 },
  memory_free: 5.2e9,
  disk_free: 61e9,
  reached: { "http://192.168.1.5:8080": 12 },
  verdicts: {
    ticks: "good",
    disk: "good",
    power: "good",
    memory: "good",
    space: "good",
    "wireless/wlan0": "good",
    "reached/http://192.168.1.5:8080": "good",
  },
});

export function first_views() {
  return {
    plan: plan_of_scene(),
    // The last decisions, by entry.
    decisions: {
      12: { kind: "phase", seat: 1, at: Date.UTC(2026, 4, 4, 12, 5), title: "Arriving" },
      21: { kind: "proposal", seat: 1, at: Date.UTC(2026, 4, 4, 12, 31), title: "A bench at the mill", of: 2, text: "It costs little." },
      30: { kind: "vote", seat: 1, at: Date.UTC(2026, 4, 4, 12, 44), vote: "bridge" },
      33: { kind: "rewind", seat: 1, at: Date.UTC(2026, 4, 4, 12, 50) },
      38: { kind: "mark", seat: 1, at: Date.UTC(2026, 4, 4, 12, 58), text: "The mill stays." },
    },
    room: {
      title: "A mixed quarter",
      code: "BCDF",
      phase: { name: "Arriving", activities: [], ends_at: 0, forms: [] },
      door: "open",
      layout: "plan",
      cards: { parents: { name: "Parents of the quarter", interest: "A school that is large enough" } },
      forms: { smart_volume: { demand: { minimum: 0, maximum: 20000, unit: "m³" } } },
      paused: false,
      closed: false,
      rate: 10,
      scenarios: { first: { name: "Before the first vote", note: "The park is whole.", seat: 1, seq: 11, tick: 480 } },
    },
    figures: {
      sun: { name: "Sun in the gardens", value: 3.42, unit: "h", target: 4, direction: "at_least", status: "close", score: 0.8 },
      area: { name: "Total floor area", value: 24310, unit: "m²", target: 24000, status: "met", score: 1 },
      green: { name: "Open ground", value: 31.5, unit: "%", target: 40, status: "far", score: 0.5 },
    },
    card: {
      name: "Parents of the quarter",
      interest: "You want a school that is large enough and a safe way to it.",
      goals: [
        { name: "Room for the school", value: 3850, unit: "m²", target: 5200, status: "far" },
        { name: "Sun in the school yard", value: 3.1, unit: "h", target: 3, status: "met" },
        { name: "Way to the school", value: 412.5, unit: "m", target: 400, direction: "at_most", status: "close" },
      ],
      controls: [
        {
          node: "library",
          port: "smart_volume.demand",
          label: "Size of the library",
          value: 4800,
          unit: "m³",
          minimum: 2000,
          maximum: 9000,
          step: 100,
          costs: ["Hotel", "Café"],
          by: "Otter",
        },
        {
          node: "near_park",
          port: "strength",
          label: "How much the school wants to be near the park",
          minimum: 0,
          maximum: 1,
          step: 0.05,
          costs: "",
        },
      ],
      budget: { budget: 12000, spent: 7400, left: 4600 },
    },
    votes: {
      bridge: vote("Should there be a bridge over High Street?", "yes_no", {}),
      uses: vote("Which uses matter most on the ground floor?", "rank", {
        options: ["Shops", "Workshops", "Nursery", "Café"].map((label) => ({ id: label.toLowerCase().replace("é", "e"), label })),
        secret: true,
      }),
      money: vote("Where should the money for open space go?", "coins", {
        options: [
          { id: "trees", label: "Trees" },
          { id: "play", label: "Playground" },
          { id: "benches", label: "Benches and light" },
        ],
      }),
      places: vote("Where is a tower good, and where not?", "dots", {
        points: 3,
      }),
      height: vote("How high may the tallest building be?", "slider", { least: 12, most: 60, unit: "m" }),
    },
    comments: {
      c1: {
        seat: 0,
        text: "The library should stay on the ground floor, so that people with prams get in.",
        node: "library",
        plus: 6,
        minus: 1,
        state: "open",
      },
      c2: {
        seat: 0,
        text: "Too dark in the passage at night.",
        place: [70, 30, 0],
        plus: 3,
        minus: 0,
        state: "accepted",
        answer: "Lights are part of the plan now.",
      },
      c3: { seat: 0, text: "Please keep the old mill.", place: [136, 12, 0], plus: 9, minus: 2, state: "open" },
      c4: { seat: 0, text: "And make it a workshop.", parent: "c3", plus: 0, minus: 0, state: "open" },
    },
    proposals: {
      p1: {
        seat: 0,
        title: "A larger library",
        why: "It is full every afternoon.",
        state: "proposed",
        steps: 2,
        kept: 0,
        words: ["Set value · Library, demand: 4800 to 6200 m³", "Set link strength · near_item_item_2: 0.5 to 0.8"],
        said: [
          { id: "set_port", of: "Library", what: { port: "demand", label: "Size of the library" }, from: 4800, to: 6200, unit: "m3" },
          { id: "set_link_strength", of: { kind: "Stay near", from: "Library", to: "Hotel" }, what: { port: "strength" }, from: 0.5, to: 0.8 },
        ],
        conflicts: [{ place: "nodes/hotel/types/smart_volume/demand", label: "Hotel, demand", said: { of: "Hotel", what: { port: "demand" } }, by: "Otter", live: 8200, draft: 7600 }],
        misfits: [],
        trial: trial("done", 3.42, 3.9),
      },
      p2: {
        seat: 0,
        title: "Move the hotel south",
        why: "More sun for the gardens.",
        state: "proposed",
        steps: 1,
        kept: 0,
        words: ["Set value · Hotel, position"],
        said: [{ id: "set_port", of: "Hotel", what: { port: "position" }, from: [98, 41, 11.9], to: [120.4, 20, 11.9], unit: "m" }],
        conflicts: [],
        misfits: [{ step: 0, why: "the hotel has been removed" }],
        trial: trial("running", 3.42, 4.1),
      },
    },
    drafts: {},
  };
}
