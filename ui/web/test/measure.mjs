// Measures the page with the real server in Chromium: how long it takes to come in, and to come back.
//
// usage: node measure.mjs PART...   join: scan → card, cold cache, on a LAN. slow: usable at 1.6 Mbit/s and 150 ms. back: after 1 s and 60 s
// without a network, and frozen. BEHAVIOURLINKS names the program, RUNS how often each is done.
// Times of a machine that is shared are upper bounds; the load is printed with them.
import assert from "node:assert/strict";
import { loadavg } from "node:os";
import { opened, start_room } from "./real_server.mjs";

// PAGE names the folder of another build of the page, to compare with.
const room = await start_room(process.env.PAGE ? { page: process.env.PAGE } : {});
const runs = Number(process.env.RUNS ?? 20);
const quantile = (values, share) => [...values].sort((a, b) => a - b)[Math.min(values.length - 1, Math.floor(share * values.length))];
const say = (what, times, limit) =>
  console.log(
    `${what}: p50 ${quantile(times, 0.5).toFixed(0)} ms, p95 ${quantile(times, 0.95).toFixed(0)} ms, longest ${Math.max(...times).toFixed(0)} ms of ` +
      `${times.length} (wanted: p95 at most ${limit} ms); load ${loadavg()[0].toFixed(1)}`,
  );

// The facilitator gives everybody who comes a card.
const given = new Set();
room.lead.watch(() => {
  for (const [number, seat] of Object.entries(room.lead.views.room?.seats ?? {}))
    if (seat.role === "stakeholder" && !given.has(number)) {
      given.add(number);
      room.give_card(Number(number));
    }
});

// A browser that has never been here: it opens the address, joins, and sees its card.
async function scan(network) {
  const browser = await opened();
  const context = await browser.newContext({ viewport: { width: 390, height: 844 }, locale: "en-GB" });
  const page = await context.newPage();
  const devtools = await context.newCDPSession(page);
  await devtools.send("Network.enable");
  await devtools.send("Network.setCacheDisabled", { cacheDisabled: true });
  if (network) await devtools.send("Network.emulateNetworkConditions", { offline: false, ...network });
  const began = performance.now();
  await page.goto(`${room.url}#k=${room.keys.stakeholder}`, { waitUntil: "commit" });
  await page.waitForSelector(".self");
  const usable = performance.now() - began;
  const paint = await page.evaluate(() => performance.getEntriesByName("first-contentful-paint")[0]?.startTime ?? NaN);
  await page.click(".join .main");
  await page.waitForSelector('nav button:has-text("Goals")');
  const card = performance.now() - began;
  console.error(`${usable.toFixed(0)} ${card.toFixed(0)}`);
  await browser.close();
  return { usable, paint, card };
}

// The sockets of Chromium outlive an emulated outage, so the server is reached through a door that can be shut.
async function back(milliseconds, how) {
  const browser = await opened();
  const context = await browser.newContext({ viewport: { width: 390, height: 844 }, locale: "en-GB" });
  const page = await context.newPage();
  const door = await room.door();
  await page.goto(`${door.origin}/${room.code}#k=${room.keys.facilitator}`);
  await page.click(".join .main");
  await page.waitForSelector("nav");
  await page.waitForTimeout(700);
  const devtools = await context.newCDPSession(page);
  const title = `Round ${Math.random().toString(36).slice(2, 8)}`;
  if (how === "frozen") await devtools.send("Page.setWebLifecycleState", { state: "frozen" });
  door.shut();
  await new Promise((wait) => setTimeout(wait, milliseconds));
  await room.phase(title);
  door.open();
  const began = performance.now();
  if (how === "frozen") await devtools.send("Page.setWebLifecycleState", { state: "active" });
  // People who come back look at the page, which says so to it.
  if (how !== "waiting") await page.evaluate(() => document.dispatchEvent(new Event("visibilitychange")));
  await page.waitForFunction((text) => document.body.textContent.includes(text), title, { polling: 20, timeout: 30000 });
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
  for (const n of [1, 2, 3]) assert.equal(await page.locator(`.said:text-is("Kept ${n}")`).count(), 1);
  await browser.close();
  door.end();
  console.log("queue kept over a reload: 3 of 3 comments, each once");
}

const parts = {
  async join() {
    const all = [];
    for (let run = 0; run < runs; run++) all.push(await scan(null));
    say(
      "scan to card on a LAN",
      all.map((one) => one.card),
      3000,
    );
    say(
      "scan to the question who one is",
      all.map((one) => one.usable),
      3000,
    );
  },
  async slow() {
    const all = [];
    for (let run = 0; run < runs; run++) all.push(await scan({ latency: 150, downloadThroughput: 1.6e6 / 8, uploadThroughput: 750e3 / 8 }));
    say(
      "usable at 1.6 Mbit/s and 150 ms",
      all.map((one) => one.usable),
      1500,
    );
    say(
      "first contentful paint at that",
      all.map((one) => one.paint),
      1200,
    );
    say(
      "scan to card at that",
      all.map((one) => one.card),
      6000,
    );
  },
  async back() {
    for (const [what, milliseconds, how, times] of [
      ["back after 1 s, nobody touches the page", 1000, "waiting", runs],
      ["back after 60 s, somebody looks at the page", 60000, "looking", Math.max(1, Math.floor(runs / 4))],
      ["back after 20 s frozen", 20000, "frozen", Math.max(1, Math.floor(runs / 4))],
    ])
      say(
        what,
        await Promise.all(
          Array.from({ length: times }, (_, run) =>
            new Promise((wait) => setTimeout(wait, run * 2500)).then(() => back(milliseconds, how)),
          ),
        ),
        1000,
      );
    await queue_over_reload();
  },
};
try {
  for (const name of process.argv.slice(2)) await parts[name]();
} finally {
  await room.end();
}
