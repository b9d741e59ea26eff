// Bots of our own rooms: a client of the protocol without any code of the page or the program.
import { spawn } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { FaultySocket } from "./faults.mjs";

const kWindow = 20,
  kPatience = 500; // [ms]
const root = new URL("../../../", import.meta.url).pathname;

export async function start_server() {
  const folder = mkdtempSync(join(tmpdir(), "peers-")),
    invites = join(folder, "invites.json"),
    journal = join(folder, "room.blsession");
  const program = spawn(process.env.BEHAVIOURLINKS ?? join(root, "build/release/ui/cli/behaviourlinks"), [
    "serve",
    join(root, "scenes/start/quarter.json"),
    "--port",
    "0",
    "--bind",
    "127.0.0.1",
    "--journal",
    journal,
    "--invites",
    invites,
  ]);
  const address = await new Promise((found, failed) => {
    let said = "";
    const hear = (data) => {
      const match = /http:\/\/([\d.]+:\d+)\/([A-Z]{4})/.exec((said += data));
      if (match) found({ host: match[1], code: match[2] });
    };
    program.stdout.on("data", hear);
    program.stderr.on("data", hear);
    program.on("exit", () => failed(new Error(said)));
  });
  await new Promise((wait) => setTimeout(wait, 300));
  return {
    pid: program.pid,
    ...address,
    invite: JSON.parse(readFileSync(invites, "utf8"))[address.code].designer,
    /// How often each operation stands in the file that the server has written.
    async stored() {
      program.removeAllListeners("exit");
      const gone = new Promise((end) => program.on("exit", end));
      program.kill("SIGINT");
      await gone;
      const counts = new Map();
      for (const line of rows_of(journal)) {
        const id = JSON.parse(line).arguments?.id;
        if (id) counts.set(id, (counts.get(id) ?? 0) + 1);
      }
      rmSync(folder, { recursive: true, force: true });
      return counts;
    },
  };
}

function rows_of(file) {
  const script =
    "import sqlite3,sys\nfor row in sqlite3.connect(sys.argv[1]).execute('SELECT line FROM entry ORDER BY seq'): print(row[0])";
  const { spawnSync } = createRequire(import.meta.url)("node:child_process");
  return spawnSync("python3", ["-c", script, file], { encoding: "utf8", maxBuffer: 1e9 }).stdout.split("\n").filter(Boolean);
}

export async function start_bot(server, number, seen) {
  const bot = {
    next: 1,
    waiting: new Map(),
    pushed: new Map(),
    answered: 0,
    run: `bot${number}x${process.pid}`,
    token: null,
    last: 0,
    isOpen: false,
  };
  // A window of operations is under way: what is lost costs that many, and not all that have been said since.
  const first = () => bot.waiting.keys().next().value;
  const push = (id) => {
    if (id >= first() + kWindow) return;
    bot.pushed.set(id, Date.now());
    if (bot.isOpen) bot.socket.send(bot.waiting.get(id));
  };
  const hear = (message) => {
    if (message.t === "welcome") {
      bot.token = message.token ?? bot.token;
      bot.isOpen = true;
      for (const id of bot.waiting.keys()) push(id);
      bot.joined?.();
    } else if (message.t === "ops")
      for (const entry of message.e) {
        bot.last = Math.max(bot.last, entry.s);
        const id = entry.v?.arguments?.id;
        if (id) seen(id);
      }
    else if (message.t === "ack") {
      bot.waiting.delete(message.id);
      bot.pushed.delete(message.id);
      bot.answered++;
    } else if (message.t === "nack" && message.why === "gap") {
      // One lost operation makes the server refuse all that follow; they are sent again once.
      if (Date.now() - (bot.jumped ?? 0) < kPatience / 2) return;
      bot.jumped = Date.now();
      for (const id of bot.waiting.keys()) if (id >= message.args.next) push(id);
    } else if (message.t === "nack" && message.why !== "rate" && message.why !== "storage") {
      bot.waiting.delete(message.id);
      bot.refused = message;
    }
  };
  const connect = () => {
    const socket = (bot.socket = new FaultySocket(`ws://${server.host}/ws`, "bl1"));
    socket.on("open", () => {
      const unacked = bot.waiting.size > 0 ? Math.min(...bot.waiting.keys()) - 1 : bot.next - 1;
      const key = bot.token ? { token: bot.token } : { invite: server.invite };
      socket.send(JSON.stringify({ t: "hello", room: server.code, run: bot.run, kind: "desktop", views: [], unacked, have: 0, ...key }));
    });
    socket.on("message", (data) => hear(JSON.parse(data.toString())));
    socket.on("error", () => undefined);
    socket.on("close", () => {
      bot.isOpen = false;
      if (!bot.isOver) setTimeout(connect, 200 * (0.6 + 0.8 * Math.random()));
    });
  };
  const ready = new Promise((joined) => (bot.joined = joined));
  connect();
  await ready;
  // Whatever has had no answer for half a second is said again.
  const again = setInterval(() => {
    for (const id of bot.waiting.keys()) {
      if (id >= first() + kWindow) break;
      if (Date.now() - (bot.pushed.get(id) ?? 0) > kPatience) push(id);
    }
  }, 50);
  return {
    say(id) {
      const n = bot.next++;
      bot.waiting.set(n, JSON.stringify({ t: "room", id: n, e: { event: "comment", arguments: { id, text: id } } }));
      push(n);
    },
    waiting: () => bot.waiting.size,
    close() {
      bot.isOver = true;
      clearInterval(again);
      bot.socket.close();
      if (bot.refused) console.log("refused:", JSON.stringify(bot.refused));
    },
  };
}
export const promise =
  "An operation is answered once it is on the disk, is applied once however often it is sent, and is kept by the client until then.";
