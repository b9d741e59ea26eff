// The picture in three dimensions with the real server: its script comes when somebody asks for it, it shows the shapes, and a change is
// seen. BEHAVIOURLINKS names the program.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { gzipSync } from "node:zlib";
import { path_of, shots, start_room } from "./real_server.mjs";
import { types_of } from "./shape_types.mjs";

const { chromium } = createRequire(new URL("../package.json", import.meta.url))("playwright-core");
const folder = process.env.SHOTS ?? shots;

// The page's types are those of the declaration.
const schema = JSON.parse(execFileSync(process.env.BEHAVIOURLINKS, ["schema", "--messages"], { encoding: "utf8", maxBuffer: 1 << 26 }));
assert.equal(readFileSync(path_of("ui/web/src/space/contents.ts"), "utf8"), types_of(schema), "make src/space/contents.ts anew");

const room = await start_room();
// Browsers without a graphics card draw by SwiftShader.
const executablePath = process.env.CHROMIUM ?? "/usr/bin/chromium";
const browser = await chromium.launch({ executablePath, args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"] });
const faults = [];

/// A person, with the scripts that were loaded and the messages of shapes that came.
async function person({ fragment = "", size = [390, 844], scheme = "light", motion = "reduce", from = browser } = {}) {
  const context = await from.newContext({ viewport: { width: size[0], height: size[1] }, colorScheme: scheme, reducedMotion: motion, locale: "en-GB", hasTouch: size[0] < 900 });
  const page = await context.newPage(),
    scripts = [],
    shapes = [];
  page.setDefaultTimeout(30000);
  page.on("request", (request) => scripts.push(new URL(request.url()).pathname));
  page.on("websocket", (socket) =>
    socket.on("framereceived", ({ payload }) => {
      const message = JSON.parse(payload.toString());
      if (message.view === "shapes") shapes.push({ at: performance.now(), bytes: payload.length, text: payload.toString(), message });
    }),
  );
  page.on("pageerror", (error) => faults.push(error.message));
  page.on("console", (message) => {
    if (message.type() === "error" && !/favicon|WebGL/.test(message.text() + message.location().url)) faults.push(message.text());
  });
  await page.goto(room.url + fragment);
  if (!fragment.includes("beamer")) {
    await page.waitForSelector(".self");
    await page.click(".join .main");
    await page.click('nav button:has-text("Plan")');
  }
  return { page, scripts, shapes, hasScript: () => scripts.some((one) => one.includes("/space-")) };
}
/// Waits until no shapes have come for three seconds.
async function rest({ page, shapes }) {
  const began = performance.now();
  while (performance.now() - began < 90000) {
    const { length } = shapes;
    await page.waitForTimeout(3000);
    if (shapes.length === length) return true;
  }
  return false;
}
const is_drawn = (page) => page.waitForSelector(".space .north").then(() => page.waitForTimeout(900));
/// The pixels of the picture, as the screen shows them: how many differ from its corner, and how many are strongly coloured.
async function pixels(page, around = ".space canvas") {
  const box = await page.locator(around).boundingBox();
  const picture = (await page.screenshot({ clip: box })).toString("base64");
  return page.evaluate(async (data) => {
    // The page's policy lets pictures be data.
    const image = new Image();
    image.src = `data:image/png;base64,${data}`;
    await image.decode();
    const canvas = document.createElement("canvas");
    canvas.width = image.width;
    canvas.height = image.height;
    const context = canvas.getContext("2d");
    context.drawImage(image, 0, 0);
    const { data: all } = context.getImageData(0, 0, image.width, image.height);
    let coloured = 0,
      sum = 0;
    const kinds = new Set();
    for (let i = 0; i < all.length; i += 4) {
      const [r, g, b] = [all[i], all[i + 1], all[i + 2]];
      if (Math.max(r, g, b) - Math.min(r, g, b) > 40) coloured += 1;
      kinds.add((r >> 5) * 64 + (g >> 5) * 8 + (b >> 5));
      sum = (sum * 31 + r * 65536 + g * 256 + b) % 2147483647;
    }
    return { coloured, kinds: kinds.size, all: all.length / 4, sum };
  }, picture);
}

try {
  await room.phase("Look");
  const one = await person();
  await one.page.waitForSelector(".shape.volume");
  assert.ok(!one.hasScript() && one.shapes.length === 0, "nothing of it comes before it is asked for");
  await one.page.click('button:text-is("3D")');
  await is_drawn(one.page);
  assert.ok(one.hasScript(), "the script comes after the press");
  const [first] = one.shapes,
    compressed = gzipSync(first.text, { level: 9 }).length;
  assert.ok(first.message.whole && compressed < 60000, `${compressed} bytes of shapes`);
  const cells = Object.values(first.message.set).filter((content) => content.t === "cell").length;
  assert.ok(cells >= 15, `${cells} volumes`);
  await one.page.screenshot({ path: `${folder}/space_phone.png` });
  const seen = await pixels(one.page);
  assert.ok(seen.coloured > 0.08 * seen.all && seen.kinds > 12, `something is drawn: ${JSON.stringify(seen)}`);

  // Turned by a button, it looks different; back home it looks as before.
  await one.page.click('button[aria-label="Turn to the left"]');
  await one.page.waitForTimeout(400);
  const turned = await pixels(one.page);
  assert.notEqual(turned.sum, seen.sum, "it turns");
  await one.page.screenshot({ path: `${folder}/space_turned.png` });
  for (const button of ["Look from higher up", "Larger", "Move instead of turning"]) await one.page.click(`button[aria-label="${button}"]`);
  await one.page.click('button[aria-label="Left"]');
  await one.page.waitForTimeout(400);
  await one.page.screenshot({ path: `${folder}/space_moved.png` });
  await one.page.click('button[aria-label="Whole plan"]');
  await one.page.click('button[aria-label="Move instead of turning"]');
  await one.page.waitForTimeout(400);

  // Once the quarter is at rest nothing comes.
  const rested = await rest(one);
  assert.ok(rested, "the quarter comes to rest");

  // A demand is changed: shapes come, no faster than allowed, and the picture changes.
  const still = await pixels(one.page),
    before = one.shapes.length;
  await room.lead.command("set_port", { node: "library", port: "smart_volume.demand", value: 12000 });
  const began = performance.now();
  while (one.shapes.length === before && performance.now() - began < 10000) await one.page.waitForTimeout(100);
  assert.ok(one.shapes.length > before, "the shapes change");
  assert.ok(one.shapes.slice(before).some(({ message }) => message.set["n/library"] && !message.whole), "the library's shape is among them");
  await one.page.waitForTimeout(5000);
  const moved = one.shapes.slice(before),
    total = moved.reduce((sum, { bytes }) => sum + bytes, 0),
    seconds = (moved[moved.length - 1].at - moved[0].at) / 1000;
  if (seconds > 2) assert.ok((total - moved[moved.length - 1].bytes) / seconds < 12500, `${total} bytes in ${seconds} s`);
  const grown = await pixels(one.page);
  assert.notEqual(grown.sum, still.sum, "the picture has changed");
  await one.page.screenshot({ path: `${folder}/space_grown.png` });

  // A touch asks what something is, as in the plan.
  const box = await one.page.locator(".space canvas").boundingBox();
  for (const [x, y] of [
    [0.5, 0.55],
    [0.4, 0.5],
    [0.6, 0.6],
    [0.5, 0.4],
  ]) {
    await one.page.mouse.click(box.x + x * box.width, box.y + y * box.height);
    await one.page.waitForTimeout(200);
    if (await one.page.isVisible(".what dl")) break;
  }
  assert.ok(await one.page.isVisible(".what dl"), "a volume was touched");
  await one.page.screenshot({ path: `${folder}/space_what.png` });

  // Back on the plan nothing more comes; asked for again, all of it comes at once.
  await one.page.click('button:text-is("3D")');
  await one.page.waitForSelector(".paper svg");
  const left = one.shapes.length;
  await room.lead.command("set_port", { node: "library", port: "smart_volume.demand", value: 3000 });
  await one.page.waitForTimeout(2500);
  assert.ok(one.shapes.length <= left + 1, "who has gone back to the plan is sent no shapes");
  await one.page.click('button:text-is("3D")');
  await is_drawn(one.page);
  assert.ok(one.shapes.slice(left).some(({ message }) => message.whole));

  // A laptop, dark; and the beamer, by its own button and as the facilitator wishes.
  const wide = await person({ size: [1280, 800], scheme: "dark" });
  await wide.page.click('button:text-is("3D")');
  await is_drawn(wide.page);
  await wide.page.screenshot({ path: `${folder}/space_wide_dark.png` });
  const light = await person({ size: [1280, 800] });
  await light.page.click('button:text-is("3D")');
  await is_drawn(light.page);
  await light.page.screenshot({ path: `${folder}/space_wide.png` });
  const beamer = await person({ fragment: "#beamer", size: [1920, 1080] });
  await beamer.page.waitForSelector(".shape.volume");
  assert.ok(!beamer.hasScript());
  await room.lead.event("show", { layout: "space" });
  await is_drawn(beamer.page);
  await beamer.page.screenshot({ path: `${folder}/space_beamer.png` });
  const shown = await pixels(beamer.page);
  assert.ok(shown.coloured > 0.05 * shown.all, JSON.stringify(shown));

  // Without WebGL there is a sentence, and the plan is a press away.
  const plain = await chromium.launch({ executablePath, args: ["--no-sandbox", "--disable-gpu", "--disable-3d-apis"] });
  const poor = await person({ from: plain });
  await poor.page.click('button:text-is("3D")');
  await poor.page.waitForSelector('.said:has-text("cannot draw in three dimensions")');
  await poor.page.click('button:text-is("3D")');
  await poor.page.waitForSelector(".shape.volume");
  await plain.close();
  assert.deepEqual(faults, []);
  console.log(
    `ok the picture in three dimensions: ${cells} volumes in ${first.bytes} bytes, ${compressed} compressed; a change came in ${moved.length} messages, ${total} bytes in ${seconds.toFixed(1)} s`,
  );
} catch (error) {
  let n = 0;
  for (const context of browser.contexts()) for (const page of context.pages()) await page.screenshot({ path: `${folder}/space_failed_${n++}.png` });
  console.log(faults.join("\n"), room.said().slice(-600));
  throw error;
} finally {
  await browser.close();
  await room.end();
}
