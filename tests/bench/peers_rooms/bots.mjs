// Measures one server of shared state: operations that are lost or done twice, and how long one takes to reach everybody.
//
// usage: node bots.mjs ours|tldraw|colyseus calm|breaks|loss [SECONDS] [SEED]
//   calm: no faults. breaks: every ten seconds each connection breaks with a chance of 30 %. loss: besides, 30 % of all messages are
//   lost each way before the socket, which TCP does not do and which no protocol over it has to bear.
import { readFileSync } from "node:fs";
import { cpus, loadavg } from "node:os";
import { faults, random_of, sockets } from "./faults.mjs";

process.on("unhandledRejection", () => faults.thrown++);
const [which, kind, seconds = "60", seed = "1"] = process.argv.slice(2);
const kBots = 50,
  kEditors = 5,
  kPace = 100,
  kShare = 0.3,
  kEnd = 15000;
const wait = (milliseconds) => new Promise((go) => setTimeout(go, milliseconds));
const quantile = (values, share) =>
  values.length === 0 ? NaN : values.sort((a, b) => a - b)[Math.min(values.length - 1, Math.floor(share * values.length))];
const used = (pid) => {
  const fields = readFileSync(`/proc/${pid}/stat`, "utf8").split(") ")[1].split(" ");
  return (Number(fields[11]) + Number(fields[12])) / 100;
};

const peer = await import(`./${which}.mjs`);
const server = await peer.start_server();
const said = new Map(),
  all = [];
for (let number = 0; number < kBots; number++) {
  const mine = new Set();
  all.push(
    await peer.start_bot(server, number, (id) => {
      const one = said.get(id);
      if (!one || one.by === number || mine.has(id)) return;
      mine.add(id);
      one.seen++;
      one.last = performance.now();
    }),
  );
}
const random = random_of(Number(seed)),
  began = performance.now(),
  cpu = used(server.pid),
  load = loadavg()[0];
faults.random = random;
faults.loss = kind === "loss" ? kShare : 0;
let breaks = 0;
process.on("uncaughtException", () => faults.thrown++);
const breaking = setInterval(() => {
  for (const socket of [...sockets])
    if (kind !== "calm" && random() < kShare) {
      socket.terminate();
      breaks++;
    }
}, 10000);
for (let round = 0; performance.now() - began < 1000 * Number(seconds); round++) {
  for (let editor = 0; editor < kEditors; editor++) {
    const id = `said_${editor}_${round}`;
    said.set(id, { by: editor, at: performance.now(), seen: 0, last: 0 });
    all[editor].say(id);
  }
  await wait(Math.max(0, began + (round + 1) * kPace - performance.now()));
}
clearInterval(breaking);
const share = (100 * (used(server.pid) - cpu)) / ((performance.now() - began) / 1000);
faults.loss = 0; // everybody may finish in peace, and comes back once more, so that nobody has missed anything that can be had
if (kind === "loss") for (const socket of [...sockets]) socket.terminate();
for (const end = performance.now() + kEnd; performance.now() < end && [...said.values()].some((one) => one.seen < kBots - 1);)
  await wait(100);
const gone = all.filter((bot) => bot.waiting() < 0).length,
  open = all.reduce((sum, bot) => sum + Math.max(0, bot.waiting()), 0);
const stored = await server.stored();
for (const bot of all) bot.close();
const times = [...said.values()].filter((one) => one.seen === kBots - 1).map((one) => one.last - one.at);
const lost = [...said.keys()].filter((id) => !stored.has(id)).length,
  twice = [...said.keys()].filter((id) => stored.get(id) > 1).length;
const unseen = [...said.values()].reduce((sum, one) => sum + kBots - 1 - one.seen, 0);
console.log(
  `${which} ${kind}: ${said.size} operations, ${breaks} connections broken; lost ${lost}, done twice ${twice}, waiting at the end ${open}, ` +
    `never seen ${unseen} of ${said.size * (kBots - 1)}, clients gone for good ${gone}, errors thrown ${faults.thrown}; seen by all others p50 ${quantile(times, 0.5).toFixed(0)} ms, ` +
    `p95 ${quantile(times, 0.95).toFixed(0)} ms (${times.length} operations); server ${share.toFixed(0)} % of a core; load ${load.toFixed(1)}, ` +
    `${cpus()[0].model}, node ${process.version}, seed ${seed}`,
);
process.exit(0);
