// Opens the page of a proposal from its file, as people do, and fails on requests, errors, faults that axe finds, and keys that do
// nothing. Its argument is the page; pictures of it go to build/web_shots. Where it has cellars, its second argument is `cellars`.
import assert from "node:assert/strict";
import { mkdirSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { fileURLToPath, pathToFileURL } from "node:url";
import { resolve } from "node:path";

const require = createRequire(new URL("../package.json", import.meta.url));
const { chromium } = require("playwright-core");
const axe = readFileSync(require.resolve("axe-core/axe.min.js"), "utf8");
const file = resolve(process.argv[2] ?? ""),
  hasCellars = process.argv[3] === "cellars";
const shots = fileURLToPath(new URL("../../../build/web_shots", import.meta.url));
mkdirSync(shots, { recursive: true });

const kTags = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"];
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});
const faults = [];
let looked = 0;
for (const [name, width, height, scheme] of [
  ["wide", 1280, 900, "light"],
  ["dark", 1280, 900, "dark"],
  ["narrow", 360, 740, "light"],
]) {
  // The policy of the page would forbid the checker, which is no part of it.
  const context = await browser.newContext({ viewport: { width, height }, colorScheme: scheme, reducedMotion: "reduce", bypassCSP: true });
  const page = await context.newPage();
  page.on("request", (request) => {
    if (!/^(file|data|blob):/.test(request.url())) faults.push(`a request to ${request.url()}`);
  });
  page.on("pageerror", (error) => faults.push(`an error: ${error.message}`));
  page.on("console", (message) => message.type() === "error" && faults.push(`the console: ${message.text()}`));
  await page.goto(pathToFileURL(file).href);
  await page.waitForSelector("main h2");

  // By the keyboard alone: the picture turns, the level rises, a building is chosen, a table of storeys opens.
  const canvas = page.locator("#model canvas");
  const seen = () => canvas.screenshot();
  await page.waitForTimeout(700);
  const before = await seen();
  await canvas.focus();
  await page.keyboard.press("ArrowLeft");
  await page.waitForTimeout(700);
  assert.notDeepEqual(await seen(), before, "the arrow key turns the picture");
  await page.keyboard.press("0");
  const level = page.locator("#plans input[type=range]"),
    most = Number(await level.getAttribute("max"));
  if (most > 0) {
    const said = () => page.locator("#plans svg.drawn").getAttribute("aria-label");
    const first = await said();
    await level.focus();
    await page.keyboard.press("ArrowRight");
    assert.notEqual(await said(), first, "the arrow key raises the level");
    // Cut above the ground floor, the model is another one; below the ground there is what is built there.
    const cut = page.locator("#plans input[type=checkbox]");
    const looks = [await seen()];
    await page.keyboard.press("ArrowLeft");
    await cut.focus();
    await page.keyboard.press("Space");
    await page.waitForTimeout(700);
    looks.push(await seen());
    if (hasCellars) {
      await level.focus();
      await page.keyboard.press("ArrowLeft");
      assert.match(await said(), /^Plan of Cellar 1: /);
      await page.waitForTimeout(700);
      looks.push(await seen());
      await page.screenshot({ path: `${shots}/proposal_below_${name}.png` });
    } else assert.equal(await level.getAttribute("min"), "0", "nothing is below the ground");
    looks.forEach((look, i) => i > 0 && assert.notDeepEqual(look, looks[i - 1], `cut ${i}`));
    await cut.focus();
    await page.keyboard.press("Space");
  }
  await page.locator("#areas tbody button").first().focus();
  await page.keyboard.press("Enter");
  assert.match(await page.locator("#model [role=status]").innerText(), /^Chosen: /);
  await page.locator("#areas summary").focus();
  await page.keyboard.press("Enter");
  assert.ok(await page.locator("#areas details tbody tr").first().isVisible());
  assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= width, "nothing is wider than the screen");

  await page.evaluate(axe);
  const found = await page.evaluate((tags) => window.axe.run(document, { runOnly: tags, resultTypes: ["violations"] }), kTags);
  for (const fault of found.violations) faults.push(`axe, ${name}: ${fault.id}: ${fault.nodes.map((node) => node.html).slice(0, 3).join(" | ")}`);
  looked += 1;
  await page.waitForTimeout(500);
  await page.screenshot({ path: `${shots}/proposal_${hasCellars ? "cellars_" : ""}${name}.png`, fullPage: true });
  await context.close();
}
await browser.close();
for (const fault of faults) console.error(fault);
console.log(`the page of a proposal: looked at ${looked} times, ${faults.length} faults`);
process.exit(faults.length === 0 ? 0 : 1);
