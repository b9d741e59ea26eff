// What Lighthouse says of the page: accessibility of every screen, and the first load on a slow phone. It needs a built page.
//
// usage: npm install --ignore-scripts --no-package-lock; node run.mjs [COUNT]
//   COUNT: the first load only, so many times, and the medians
import { createRequire } from "node:module";
import { loadavg } from "node:os";
import lighthouse, { snapshot } from "lighthouse";
import { serve } from "../mock_server.mjs";

const puppeteer = createRequire(createRequire(import.meta.url).resolve("lighthouse"))("puppeteer-core");
const server = await serve();
const { room } = server;
room.phase("Exploring", ["change", "comment", "vote", "draft"], { forms: ["smart_volume"], ends_at: Date.now() + 600000 });
room.open_votes("bridge", "uses", "money", "places", "height");
const browser = await puppeteer.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox"],
  headless: true,
});
let worst = 100;

const score = (category) => Math.round(100 * category.score);
function told(name, result) {
  const value = score(result.lhr.categories.accessibility);
  worst = Math.min(worst, value);
  const failed = Object.values(result.lhr.audits).filter((audit) => audit.score === 0 && audit.scoreDisplayMode === "binary");
  console.log(`${name}: accessibility ${value}${value < 100 ? ` (${failed.map((audit) => audit.id).join(", ")})` : ""}`);
}
const flags = { onlyCategories: ["accessibility"] };
async function person(fragment, size) {
  const page = await (await browser.createBrowserContext()).newPage();
  await page.setViewport(size);
  await page.goto(`${server.address}/BCDF${fragment}`);
  return page;
}
const phone = { width: 390, height: 844, isMobile: true, hasTouch: true },
  laptop = { width: 1280, height: 800 };
const click = (page, text) =>
  page.evaluate(
    (word) =>
      [...document.querySelectorAll("nav button, .join .main, .segments button")].find((one) => one.textContent.includes(word)).click(),
    text,
  );

async function look_at_screens() {
  for (const [who, fragment, size] of [
    ["participant on a phone", "", phone],
    ["facilitator on a laptop", "#k=LEAD", laptop],
  ]) {
    const page = await person(fragment, size);
    await page.waitForSelector(".self");
    told(`${who}, joining`, await snapshot(page, { flags }));
    await click(page, "Join in");
    await page.waitForSelector("nav");
    const tabs = await page.$$eval("nav button span", (all) => all.map((one) => one.textContent));
    for (const tab of tabs) {
      await click(page, tab);
      await new Promise((wait) => setTimeout(wait, 400));
      told(`${who}, ${tab}`, await snapshot(page, { flags }));
    }
    await click(page, "Proposals");
    await new Promise((wait) => setTimeout(wait, 400));
    told(`${who}, proposals`, await snapshot(page, { flags }));
  }
  const beamer = await person("#k=SHOW&beamer", { width: 1920, height: 1080 });
  await beamer.waitForSelector(".shape");
  for (const layout of ["plan", "compare", "vote", "comments", "code"]) {
    room.room.layout = layout;
    room.publish();
    await new Promise((wait) => setTimeout(wait, 500));
    told(`beamer, ${layout}`, await snapshot(beamer, { flags }));
  }
}

const kFigures = {
  "first-contentful-paint": "first contentful paint",
  "largest-contentful-paint": "largest",
  "speed-index": "speed index",
  interactive: "interactive",
  "total-blocking-time": "blocked",
};
const figures = [];
async function load_first() {
  const page = await browser.newPage();
  const first = await lighthouse(
    `${server.address}/BCDF`,
    { onlyCategories: ["accessibility", "performance", "best-practices"] },
    undefined,
    page,
  );
  await page.close();
  told("first load", first);
  const { categories, audits } = first.lhr;
  const all = { performance: score(categories.performance), "best practices": score(categories["best-practices"]) };
  for (const [id, name] of Object.entries(kFigures)) all[`${name} [ms]`] = Math.round(audits[id].numericValue);
  all.shift = Math.round(1000 * audits["cumulative-layout-shift"].numericValue) / 1000;
  figures.push(all);
  console.log(`first load, mobile preset: ${line_of(all)}; load ${loadavg()[0].toFixed(1)}`);
  for (const audit of Object.values(audits))
    if (audit.score !== null && audit.score < 0.9 && categories["best-practices"].auditRefs.some((one) => one.id === audit.id))
      console.log(`  ${audit.id}: ${audit.title}`);
}
const line_of = (all) =>
  Object.entries(all)
    .map(([name, value]) => `${name} ${value}`)
    .join(", ");
const median = (values) => [...values].sort((a, b) => a - b)[Math.floor(values.length / 2)];

const count = Number(process.argv[2] ?? 0);
if (count === 0) await look_at_screens();
for (let k = 0; k < Math.max(1, count); ++k) await load_first();
if (count > 1)
  console.log(
    `medians of ${count}: ${line_of(Object.fromEntries(Object.keys(figures[0]).map((name) => [name, median(figures.map((one) => one[name]))])))}`,
  );
await browser.close();
server.stop();
process.exit(worst < 100 ? 1 : 0);
