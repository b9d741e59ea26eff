// The real server with a room made of the quarter, a facilitator's connection of its own, and doors that can be shut.
import { spawn } from "node:child_process";
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { connect, createServer } from "node:net";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

const require = createRequire(new URL("../package.json", import.meta.url));
const { chromium } = require("playwright-core");
const { WebSocket } = require("ws");
export const path_of = (name) => fileURLToPath(new URL(`../../../${name}`, import.meta.url));
export const shots = path_of("build/web_shots");
mkdirSync(shots, { recursive: true });

export const opened = () => chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox"] });

function scene() {
  const all = JSON.parse(readFileSync(path_of("scenes/start/quarter.json"), "utf8"));
  const option = (id) => ({ id, label: id[0].toUpperCase() + id.slice(1) });
  const vote = (id, types) => all.nodes.push({ id, name: id, position: [0, -60, 0], types: { vote: types } });
  vote("v_bridge", { question: "Should there be a bridge?", electorate: 10 });
  vote("v_uses", {
    question: "Which use comes first?",
    kind: "rank",
    options: ["shops", "workshops", "nursery"].map(option),
    electorate: 10,
  });
  vote("v_money", {
    question: "Where should the money go?",
    kind: "coins",
    options: ["trees", "play"].map(option),
    points: 5,
    is_secret: true,
  });
  vote("v_places", { question: "Where is a tower good?", kind: "dots", points: 3 });
  vote("v_height", { question: "How high?", kind: "slider", least: 10, most: 60, unit: "m" });
  all.nodes.push({
    id: "sun",
    name: "Sun in the gardens",
    position: [0, -70, 0],
    types: { indicator: { value: 3.4, unit: "h", target: 4 } },
  });
  all.nodes.push({
    id: "parents",
    name: "Parents",
    position: [0, -80, 0],
    types: {
      stakeholder_group: {
        interest: "A library near the school",
        goals: ["sun"],
        budget: 12000,
        controls: [
          {
            node: "library",
            port: "smart_volume.demand",
            label: "Size of the library",
            minimum: 500,
            maximum: 6000,
            step: 100,
            costs_whom: "the hotel",
          },
        ],
      },
    },
  });
  return all;
}

/// A connection of the facilitator: its operations resolve once they are answered.
async function leader(origin, code, invite) {
  const socket = new WebSocket(`${origin.replace("http", "ws")}/ws`, "bl1", { origin });
  const waiting = new Map(),
    views = {};
  let next = 1,
    changed = () => undefined;
  await new Promise((open) => socket.on("open", open));
  socket.on("message", (data) => {
    const message = JSON.parse(data.toString());
    if (message.t === "ack" || message.t === "nack") {
      waiting.get(message.id)?.(message);
      waiting.delete(message.id);
    } else if (message.t === "state") {
      views[message.view] = { ...views[message.view], ...message.set };
      for (const key of message.drop ?? []) delete views[message.view][key];
    }
    if (message.t === "welcome" || message.t === "state") changed();
  });
  socket.send(
    JSON.stringify({ t: "hello", room: code, run: `lead${Date.now()}`, kind: "page", invite, views: ["room", "comments", "proposals"] }),
  );
  await new Promise((come) => (changed = come));
  changed = () => undefined;
  const say = (message) =>
    new Promise((answered) => {
      const id = next++;
      waiting.set(id, answered);
      socket.send(JSON.stringify({ ...message, id }));
    });
  return {
    views,
    event: (event, args) => say({ t: "room", e: { event, arguments: args } }),
    command: (command, args) => say({ t: "op", c: { command, arguments: args } }),
    watch: (watcher) => (changed = watcher),
    end: () => socket.close(),
  };
}

/// A way to the server that can be shut: then connections break and no new ones are taken.
async function door_to(port, host) {
  const links = new Set();
  let is_open = true,
    keeps_pages = false;
  const server = createServer((near) => {
    const far = connect(port, host);
    let is_socket = false;
    near.on("data", (data) => {
      is_socket = is_socket || data.includes("Upgrade: websocket");
      if (is_open || (keeps_pages && !is_socket)) far.write(data);
      else near.destroy();
    });
    far.on("data", (data) => near.write(data));
    for (const [one, other] of [
      [near, far],
      [far, near],
    ]) {
      one.on("error", () => undefined);
      one.on("close", () => other.destroy());
    }
    if (!is_open && !keeps_pages) near.destroy();
    links.add(near);
    near.on("close", () => links.delete(near));
  });
  await new Promise((ready) => server.listen(0, "127.0.0.1", ready));
  return {
    origin: `http://127.0.0.1:${server.address().port}`,
    shut(how = {}) {
      is_open = false;
      keeps_pages = how.keepsPages ?? false;
      for (const link of links) link.destroy();
    },
    open() {
      is_open = true;
    },
    end() {
      for (const link of links) link.destroy();
      server.close();
    },
  };
}

/// A slow way to the server: each connection costs a round trip to open, each part takes `oneWay` [ms], and all that comes down shares
/// `down` [bytes a second]. A browser's own emulation slows neither handshakes nor sockets.
async function slow_way_to(port, host, { oneWay, down }) {
  let free = 0; // when the line down has sent all that it was given
  const server = createServer((near) => {
    const far = connect(port, host),
      opened = performance.now() + 2 * oneWay;
    const later = (at, then) => setTimeout(then, Math.max(0, at - performance.now()));
    near.setNoDelay(true);
    far.setNoDelay(true);
    near.on("data", (data) => later(Math.max(opened, performance.now()) + oneWay, () => far.write(data)));
    far.on("data", (data) => {
      // In packets, so that a long answer does not hold back what comes on another connection.
      for (let at = 0; at < data.length; at += 1400) {
        const part = data.subarray(at, at + 1400);
        free = Math.max(free, performance.now()) + (part.length / down) * 1000;
        later(free + oneWay, () => near.write(part));
      }
    });
    for (const [one, other] of [
      [near, far],
      [far, near],
    ]) {
      one.on("error", () => undefined);
      one.on("close", () => later(Math.max(free, performance.now()) + 2 * oneWay, () => other.destroy()));
    }
  });
  await new Promise((ready) => server.listen(0, "127.0.0.1", ready));
  return { origin: `http://127.0.0.1:${server.address().port}`, end: () => server.close() };
}

/// `about`: the scene of the room; `page`: the folder of the built page.
export async function start_room({ about = scene(), page = path_of("build/web") } = {}) {
  const folder = mkdtempSync(join(tmpdir(), "room-"));
  const invites = join(folder, "invites.json"),
    source = join(folder, "room.json");
  writeFileSync(source, JSON.stringify(about));
  const program = spawn(process.env.BEHAVIOURLINKS, [
    "serve",
    source,
    "--port",
    "0",
    "--bind",
    "127.0.0.1",
    "--journal",
    folder,
    "--invites",
    invites,
    "--page",
    page,
  ]);
  let said = "";
  const address = await new Promise((found, failed) => {
    const hear = (data) => {
      said += data;
      const match = /http:\/\/[\d.]+:\d+\/([A-Z]{4})/.exec(said);
      if (match) found({ url: match[0], code: match[1] });
    };
    program.stdout.on("data", hear);
    program.stderr.on("data", hear);
    program.on("exit", () => failed(new Error(said)));
  });
  await new Promise((wait) => setTimeout(wait, 300));
  const keys = JSON.parse(readFileSync(invites, "utf8"))[address.code];
  const end = () => {
    program.removeAllListeners("exit");
    program.kill("SIGINT");
    return new Promise((gone) => program.on("exit", gone)).then(() => rmSync(folder, { recursive: true, force: true }));
  };
  const { origin, hostname, port } = new URL(address.url);
  const lead = await leader(origin, address.code, keys.facilitator);
  return {
    ...address,
    keys,
    lead,
    end: () => {
      lead.end();
      return end();
    },
    said: () => said,
    folder,
    forget: () => rmSync(folder, { recursive: true, force: true }),
    kill: () => {
      program.removeAllListeners("exit");
      program.kill("SIGKILL");
      return new Promise((gone) => program.on("exit", gone));
    },
    slow_way: (how) => slow_way_to(Number(port), hostname, how),
    door: () => door_to(Number(port), hostname),
    give_card: (seat) => lead.event("set_role", { seat, role: "stakeholder", areas: [], card: "parents" }),
    phase: (name) => lead.event("set_phase", { name, activities: ["change", "draft", "comment", "vote"], forms: [], ends_at: 0 }),
  };
}
