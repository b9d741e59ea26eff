// A second laptop takes the real room over: what a page has said without a connection goes along to it, each once, by a touch.
// BEHAVIOURLINKS names the program. The first server is killed while the page has unanswered comments.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { createServer } from "node:net";
import { join } from "node:path";
import { opened, path_of, shots, start_room } from "./real_server.mjs";

const kBefore = 3,
  kAfter = 4; // comments with a connection, and without
const free_port = () =>
  new Promise((found) => {
    const server = createServer().listen(0, "127.0.0.1", () => {
      const { port } = server.address();
      server.close(() => found(port));
    });
  });

const room = await start_room();
const browser = await opened();
const port = await free_port(),
  there = `http://127.0.0.1:${port}`;
let said = "";
const second = spawn(process.env.BEHAVIOURLINKS, [
  ...["serve", "--follow", `${room.url.replace("http", "room")}`, "--token", room.keys.follow],
  ...["--journal", join(room.folder, "copy.blsession"), "--port", String(port), "--bind", "127.0.0.1", "--page", path_of("build/web"), "--safe"],
]);
for (const stream of [second.stdout, second.stderr]) stream.on("data", (data) => (said += data));
async function until(words) {
  for (const end = Date.now() + 30000; !said.includes(words); ) {
    assert.ok(Date.now() < end && second.exitCode === null, `not said: ${words}\n${said}`);
    await new Promise((wait) => setTimeout(wait, 30));
  }
}

try {
  await until(`follows room ${room.code}`);
  const context = await browser.newContext({ viewport: { width: 390, height: 844 }, locale: "en-GB" });
  const page = await context.newPage(),
    requests = [];
  page.setDefaultTimeout(30000);
  context.on("request", (request) => requests.push({ url: request.url(), referrer: request.headers().referer ?? "" }));
  await page.goto(`${room.url}#k=${room.keys.participant}`);
  await page.click(".join .main");
  await page.click('nav button:has-text("Ideas")');
  const write = async (n) => {
    await page.click('button:has-text("Write a comment")');
    await page.fill("textarea", `Comment ${n}`);
    await page.click('.write button:has-text("Send")');
  };
  for (let n = 0; n < kBefore; ++n) await write(n);
  await page.waitForSelector('.status:has-text("Everything is saved")');
  const me = await page.getAttribute(".me", "aria-label");
  await room.kill();
  for (let n = kBefore; n < kBefore + kAfter; ++n) await write(n);
  await page.waitForSelector(`.status:has-text("${kAfter} changes wait")`);
  await until("is away");
  second.kill("SIGUSR1");
  await until(`room ${room.code} at ${there}`);
  await page.waitForSelector(`.moved:has-text("${kAfter} changes that wait go along")`);
  await page.screenshot({ path: `${shots}/real_moved.png` });
  const link = await page.getAttribute(".moved a", "href");
  assert.ok(new URL(link).hash.includes("q=") && new URL(link).search === "");
  const began = performance.now();
  await page.click(".moved a");
  await page.waitForURL(`${there}/${room.code}`);
  await page.click(".join .main");
  await page.waitForSelector('.status:has-text("Everything is saved")');
  const back = performance.now() - began;
  assert.equal(await page.getAttribute(".me", "aria-label"), me, "the same seat");
  await page.click('nav button:has-text("Ideas")');
  await page.waitForSelector(`.said:text-is("Comment ${kBefore + kAfter - 1}")`);
  for (let n = 0; n < kBefore + kAfter; ++n) assert.equal(await page.locator(`.said:text-is("Comment ${n}")`).count(), 1, `comment ${n}`);
  // Once more by the same link, from a history or a second touch: nothing is done twice.
  const again = await context.newPage();
  await again.goto(link);
  await again.waitForURL(`${there}/${room.code}`);
  await again.waitForSelector('.status:has-text("Everything is saved")');
  await page.waitForTimeout(1000);
  for (let n = 0; n < kBefore + kAfter; ++n) assert.equal(await page.locator(`.said:text-is("Comment ${n}")`).count(), 1, `comment ${n}, again`);
  // What was handed over stands in no address that was asked for, and in no referrer.
  const [, token] = /[#&]t=([^&]+)/.exec(link),
    [, waiting] = /[#&]q=([^&]+)/.exec(link);
  for (const secret of [token, waiting, room.keys.participant])
    for (const { url, referrer } of requests) assert.ok(!url.split("#")[0].includes(secret) && !referrer.includes(secret), url);
  for (const secret of [token, room.keys.participant]) assert.ok(!said.includes(secret) && !room.said().includes(secret), "in no output");
  assert.ok(await page.evaluate(() => !location.hash && !document.referrer));
  console.log(`ok ${kAfter} comments went along to the second laptop, each once; ${back.toFixed(0)} ms from the touch to saved`);
} catch (error) {
  for (const [i, page] of browser.contexts().flatMap((one) => one.pages()).entries()) await page.screenshot({ path: `${shots}/real_follow_failed_${i}.png` });
  console.log(said.slice(-800));
  throw error;
} finally {
  await browser.close();
  second.kill("SIGINT");
  await new Promise((gone) => (second.exitCode === null ? second.on("exit", gone) : gone()));
  room.forget();
}
