// Measures the page with the real server in Chromium: how long it takes to come in, and to come back.
//
// usage: node measure.mjs PART...   join: scan → card, cold cache, on a LAN. slow: usable at 1.6 Mbit/s and 150 ms. way: the same, with
// a proxy that slows handshakes and sockets as well. back_1, back_60, back_1800, back_looking, back_frozen: after so many seconds without a network.
// queue: what is said without one, over a reload. BEHAVIOURLINKS names the program, RUNS how often each is done.
// Times of a machine that is shared are upper bounds; the load is printed with them.
import assert from "node:assert/strict";
import { loadavg } from "node:os";
import { opened, start_room } from "./real_server.mjs";

const room = await start_room();
// OLD names the folder of another build of the page: the two are measured in turn, so that a machine that is shared treats them alike.
const old_room = process.env.OLD ? await start_room({ page: process.env.OLD }) : null;
const kRest = 2000; // [ms]
const kTogether = 10000; // outages that are longer run beside each other [ms]
const runs = Number(process.env.RUNS ?? 20);
const quantile = (values, share) => [...values].sort((a, b) => a - b)[Math.min(values.length - 1, Math.floor(share * values.length))];
const say = (what, times, limit) =>
  console.log(
    `${what}: p50 ${quantile(times, 0.5).toFixed(0)} ms, p95 ${quantile(times, 0.95).toFixed(0)} ms, longest ${Math.max(...times).toFixed(0)} ms of ` +
      `${times.length} (wanted: p95 at most ${limit} ms); load ${loadavg()[0].toFixed(1)}`,
  );

// The facilitator gives everybody who comes a card.
for (const one of old_room ? [room, old_room] : [room]) {
  const given = new Set();
  one.lead.watch(() => {
    for (const [number, seat] of Object.entries(one.lead.views.room?.seats ?? {}))
      if (seat.role === "stakeholder" && !given.has(number)) {
        given.add(number);
        one.give_card(Number(number));
      }
  });
}

// When the parts of the way were reached, in the clock of the page [ms since the navigation began].
function note_steps() {
  window.steps = {};
  const Socket = window.WebSocket;
  window.WebSocket = class extends Socket {
    constructor(...all) {
      super(...all);
      window.steps.asked ??= performance.now();
      this.addEventListener("open", () => (window.steps.socket ??= performance.now()));
      this.addEventListener("message", () => (window.steps.welcome ??= performance.now()));
    }
  };
}
const read_steps = () => {
  const [page] = performance.getEntriesByType("navigation"),
    script = performance.getEntriesByType("resource").find((one) => one.name.includes("/page-"));
  return {
    page: page.responseEnd,
    script: script?.responseEnd ?? NaN,
    ...window.steps,
    paint: performance.getEntriesByName("first-contentful-paint")[0]?.startTime ?? NaN,
  };
};

// A browser that has never been here: it opens the address, joins, and sees its card.
async function scan(room, network, origin) {
  const browser = await opened();
  const context = await browser.newContext({ viewport: { width: 390, height: 844 }, locale: "en-GB" });
  const page = await context.newPage();
  const devtools = await context.newCDPSession(page);
  await devtools.send("Network.enable");
  await devtools.send("Network.setCacheDisabled", { cacheDisabled: true });
  if (network) await devtools.send("Network.emulateNetworkConditions", { offline: false, ...network });
  await page.addInitScript(note_steps);
  // What a browser does after its own start is not the page's: phones have theirs running.
  await page.waitForTimeout(kRest);
  const began = performance.now();
  await page.goto(`${origin ?? new URL(room.url).origin}/${room.code}#k=${room.keys.stakeholder}`, { waitUntil: "commit" });
  await page.waitForSelector(".self");
  const usable = performance.now() - began;
  const steps = await page.evaluate(read_steps);
  await page.click(".join .main");
  await page.waitForSelector('nav button:has-text("Goals")');
  const card = performance.now() - began;
  console.error(`${usable.toFixed(0)} ${card.toFixed(0)}`);
  await browser.close();
  return { ...steps, usable, card };
}

let rounds = 0;

// The sockets of Chromium outlive an emulated outage, so the server is reached through a door that can be shut.
async function come_in(room) {
  const browser = await opened();
  const context = await browser.newContext({ viewport: { width: 390, height: 844 }, locale: "en-GB" });
  const page = await context.newPage();
  const door = await room.door();
  await page.goto(`${door.origin}/${room.code}#k=${room.keys.facilitator}`);
  await page.click(".join .main");
  await page.waitForSelector("nav");
  return { room, browser, context, page, door };
}

async function back({ room, browser, context, page, door }, milliseconds, how) {
  await page.waitForTimeout(700);
  const devtools = await context.newCDPSession(page);
  const number = ++rounds; // another run may set a later phase before this page is back
  if (how === "frozen") await devtools.send("Page.setWebLifecycleState", { state: "frozen" });
  door.shut();
  await new Promise((wait) => setTimeout(wait, milliseconds));
  await room.phase(`Round ${number}.`);
  door.open();
  const began = performance.now();
  if (how === "frozen") await devtools.send("Page.setWebLifecycleState", { state: "active" });
  // People who come back look at the page, which says so to it.
  if (how !== "waiting") await page.evaluate(() => document.dispatchEvent(new Event("visibilitychange")));
  const is_current = (least) => Number(/Round (\d+)\./.exec(document.body.textContent)?.[1] ?? 0) >= least;
  await page.waitForFunction(is_current, number, { polling: 20, timeout: 30000 });
  const time = performance.now() - began;
  console.error(`${how} ${time.toFixed(0)}`);
  await browser.close();
  door.end();
  return time;
}

// What is done without a connection is there after the page is loaded again, and is sent once there is one.
async function queue_over_reload() {
  const browser = await opened();
  const page = await (await browser.newContext({ viewport: { width: 390, height: 844 }, locale: "en-GB" })).newPage();
  const door = await room.door();
  await page.goto(`${door.origin}/${room.code}#k=${room.keys.facilitator}`);
  await page.click(".join .main");
  await page.waitForSelector("nav");
  door.shut({ keepsPages: true });
  await page.click('nav button:has-text("Ideas")');
  for (const n of [1, 2, 3]) {
    if (await page.isVisible('button:has-text("Write a comment")')) await page.click('button:has-text("Write a comment")');
    await page.fill("textarea", `Kept ${n}`);
    await page.click('.write button:has-text("Send")');
  }
  await page.waitForSelector('.status:has-text("3 changes wait")');
  await page.reload();
  await page.waitForSelector('.status:has-text("3 changes wait")');
  door.open();
  await page.waitForSelector('.status:has-text("Everything is saved")', { timeout: 15000 });
  await page.click('nav button:has-text("Ideas")');
  // An answer says that it is stored; the view follows with the next tick.
  for (const n of [1, 2, 3]) await page.waitForSelector(`.said:text-is("Kept ${n}")`);
  for (const n of [1, 2, 3]) assert.equal(await page.locator(`.said:text-is("Kept ${n}")`).count(), 1);
  await browser.close();
  door.end();
  console.log("queue kept over a reload: 3 of 3 comments, each once");
}

// Each of the builds in turn; the medians of the steps tell where the time goes.
async function scans(what, network, limits, way = null) {
  const rooms = old_room ? { before: old_room, now: room } : { now: room },
    all = Object.fromEntries(Object.keys(rooms).map((name) => [name, []]));
  const ways = {};
  for (const [name, one] of Object.entries(rooms)) ways[name] = way ? await one.slow_way(way) : null;
  for (let run = 0; run < runs; run++)
    for (const [name, one] of Object.entries(rooms)) all[name].push(await scan(one, network, ways[name]?.origin));
  for (const one of Object.values(ways)) one?.end();
  for (const [name, times] of Object.entries(all)) {
    for (const [step, limit] of Object.entries(limits))
      say(
        `${what}, ${step}, ${name}`,
        times.map((one) => one[step]),
        limit,
      );
    const steps = ["page", "asked", "script", "socket", "paint", "welcome"];
    const at = steps.map((step) => `${step} ${quantile(times.map((one) => one[step]), 0.5).toFixed(0)}`);
    console.log(`  medians of the steps, ${name}: ${at.join(", ")} ms`);
  }
}

async function backs(what, milliseconds, how, times) {
  for (const [name, one] of Object.entries(old_room ? { before: old_room, now: room } : { now: room })) {
    const waits = [];
    // Everybody is in before the first outage: a browser that starts takes the time of those that come back.
    const people = [];
    if (milliseconds > kTogether) for (let run = 0; run < times; run++) people.push(await come_in(one));
    for (let run = 0; run < times; run++) {
      const wait = back(people[run] ?? (await come_in(one)), milliseconds, how);
      waits.push(wait);
      await (milliseconds > kTogether ? new Promise((next) => setTimeout(next, 2500)) : wait);
    }
    say(`${what}, ${name}`, await Promise.all(waits), 1000);
  }
}

const parts = {
  join: () => scans("LAN", null, { usable: 3000, card: 3000 }),
  slow: () =>
    scans(
      "1.6 Mbit/s and 150 ms",
      { latency: 150, downloadThroughput: 1.6e6 / 8, uploadThroughput: 750e3 / 8 },
      { usable: 1500, paint: 1200, card: 6000 },
    ),
  way: () =>
    scans("1.6 Mbit/s and 150 ms, handshakes and sockets too", null, { usable: 1500, paint: 1200, card: 6000 }, { oneWay: 75, down: 200000 }),
  back_1: () => backs("back after 1 s, nobody touches the page", 1000, "waiting", runs),
  back_60: () => backs("back after 60 s, nobody touches the page", 60000, "waiting", runs),
  back_1800: () => backs("back after 30 min, nobody touches the page", 1800000, "waiting", runs),
  back_looking: () => backs("back after 60 s, somebody looks at the page", 60000, "looking", runs),
  back_frozen: () => backs("back after 20 s frozen", 20000, "frozen", runs),
  queue: queue_over_reload,
};
try {
  for (const name of process.argv.slice(2)) await parts[name]();
} finally {
  await room.end();
  await old_room?.end();
}
