// The page with the real server: people join, vote, change, comment and propose, and the facilitator leads.
// BEHAVIOURLINKS names the program; its room is made of the quarter and lies in a folder that is removed afterwards.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { opened, shots, start_room } from "./real_server.mjs";

const room = await start_room();
const browser = await opened();
const faults = [];
let requests = 0;

async function person(fragment, size = [390, 844], path = room.url, more = {}) {
  const context = await browser.newContext({ viewport: { width: size[0], height: size[1] }, locale: "en-GB", ...more });
  const page = await context.newPage();
  // Nothing comes from anywhere else, so that a room needs no way to the internet.
  page.on("request", (request) => {
    requests += 1;
    if (new URL(request.url()).origin !== new URL(room.url).origin) faults.push(`a request to ${request.url()}`);
  });
  page.setDefaultTimeout(15000);
  page.on("pageerror", (error) => faults.push(error.message));
  page.on("console", (message) => {
    // The page without scripts names no icon, and browsers look for one.
    if (message.type() === "error" && !message.location().url.endsWith("/favicon.ico"))
      faults.push(`${message.text()} ${message.location().url}`);
  });
  await page.goto(path + fragment);
  return page;
}
async function joined(fragment, size) {
  const page = await person(fragment, size);
  await page.waitForSelector(".self");
  await page.click(".join .main");
  await page.waitForSelector("nav");
  return page;
}
const tab = (page, name) => page.click(`nav button:has-text("${name}")`);
const picture = (page, name) => page.screenshot({ path: `${shots}/real_${name}.png` });

try {
  const lead = await joined(`#k=${room.keys.facilitator}`, [1280, 800]);
  await picture(lead, "lead");
  const heron = await joined(""),
    other = await joined("");
  await picture(heron, "now");
  const shapes = await heron.locator(".shape.volume").count();
  assert.ok(shapes >= 15, `${shapes} volumes on the plan`);

  // The facilitator starts a phase; everybody sees it.
  for (const what of ["Change", "Drafts", "Comments", "Vote"]) await lead.check(`.tick:has-text("${what}") input`);
  await lead.fill('label:has-text("Title of the phase") input', "Exploring");
  await lead.click('button:has-text("Start this phase")');
  await heron.waitForSelector('.phase:has-text("Exploring")');

  // Every kind of vote is opened, answered and closed.
  const ways = {
    "Should there be a bridge?": [".choice >> nth=0"],
    "Which use comes first?": [".choice >> nth=0", ".choice >> nth=0", ".choice >> nth=0"],
    "Where should the money go?": ['[aria-label="One more on Trees"]'],
    "Where is a tower good?": ['.pick button:has-text("Set a dot")'],
    "How high?": ['[aria-label^="More"]'],
  };
  for (const [question, steps] of Object.entries(ways)) {
    await lead.click(`.rows li:has-text("${question}") button:has-text("Open")`);
    await tab(heron, "Votes");
    await heron.waitForSelector(`.vote h2:has-text("${question}")`);
    for (const step of steps) await heron.click(`.vote:not(.closed) ${step}`);
    await heron.click('button:has-text("Send my vote")');
    await heron.waitForSelector('.counted:has-text("counted")');
    await heron.waitForTimeout(1500);
    assert.ok(await heron.isVisible('.counted:has-text("counted")'), `${question}: it stays counted`);
    await heron.reload();
    await tab(heron, "Votes");
    await heron.waitForSelector('.counted:has-text("counted")');
    await picture(heron, `vote_${Object.keys(ways).indexOf(question)}`);
    await lead.click(`.rows li:has-text("${question}") button:has-text("Close")`);
    await heron.waitForSelector(`.vote.closed:has-text("${question}")`);
    await tab(heron, "Now");
  }
  await tab(heron, "Votes");
  await heron.waitForSelector(".results");
  await picture(heron, "results");

  // A comment on a thing, rated by somebody else, and answered.
  await tab(heron, "Plan");
  await heron.click('.shape[data-node="library"]');
  await heron.waitForSelector('.what:has-text("Library")');
  await picture(heron, "what");
  await heron.click('button:has-text("Comment on this")');
  await heron.fill("textarea", "Keep it on the ground floor.");
  await heron.click('.write button:has-text("Send")');
  await tab(other, "Ideas");
  await other.waitForSelector('.said:has-text("Keep it")');
  await other.click('[aria-label^="Agree"]');
  await other.waitForSelector('[aria-label="Agree: 1 person"][aria-pressed="true"]');
  await lead.fill('.comment:has-text("Keep it") input', "Yes.");
  await lead.click('.comment:has-text("Keep it") button >> nth=0');
  await heron.waitForSelector('.answer:has-text("Yes.")');

  // With a role card, a value is changed, changed back, and proposed in a draft that the facilitator accepts.
  const row = '.people li:has-text("Lynx")';
  await lead.click(`${row} summary`);
  await lead.selectOption(`${row} label:has-text("Role card") select`, "parents");
  await lead.waitForSelector(`${row} summary:has-text("Stakeholder"):has-text("Parents")`);
  await tab(heron, "Goals");
  await heron.waitForSelector('text="Sun in the gardens"');
  const field = "#control-library-smart_volume-demand-number";
  const before = await heron.inputValue(field);
  await heron.fill(field, "2500");
  await heron.keyboard.press("Enter");
  await heron.waitForSelector('.mark:has-text("Saved")');
  await heron.waitForTimeout(1000);
  assert.equal(await heron.inputValue(field), "2,500");
  await picture(heron, "card");
  await heron.click('button:has-text("Undo my last change")');
  await heron.waitForFunction(([at, value]) => document.querySelector(at).value === value, [field, before]);
  await tab(heron, "Ideas");
  await heron.click('.segments button:has-text("Proposals")');
  await heron.fill(".pick input", "A larger library");
  await heron.click('button:has-text("Start a draft")');
  await heron.fill(field, "3000");
  await heron.keyboard.press("Enter");
  await heron.click('.banner button:has-text("Propose it")');
  await heron.waitForSelector('.steps li:has-text("Size of the library: from"):has-text("to 3,000")');
  await heron.fill("textarea", "It is full.");
  await heron.click('.proposal button:has-text("Propose it")');
  await lead.waitForSelector('.proposal:has-text("A larger library")');
  await picture(lead, "proposal");
  await lead.click('.proposal button:has-text("Accept")');
  await heron.waitForSelector('.word:has-text("Accepted")');
  await tab(heron, "Goals");
  await heron.waitForFunction((at) => document.querySelector(at).value === "3,000", field);
  await picture(other, "comment");
  const seats = await lead.locator(".people li").count();
  assert.equal(seats, 4);
  await heron.waitForSelector('.control:has-text("Last changed by")');

  // Who has no scripts joins, puts dots on things and at a place, and comments.
  const plain = await person("", [390, 844], room.url.replace(/\/([A-Z]{4})$/, "/plain/$1"), { javaScriptEnabled: false });
  await plain.click('button:has-text("Take part")');
  await lead.click('.rows li:has-text("Where is a tower good?") button:has-text("Open")');
  await lead.waitForSelector('.rows li:has-text("Where is a tower good?") button:has-text("Close")');
  await plain.click('button:has-text("Show it as it is now")');
  await plain.selectOption('select[name="d1_on"]', { label: "Library" });
  await plain.selectOption('select[name="d2_on"]', { label: "the place below" });
  await plain.selectOption('select[name="d2_is"]', { index: 1 });
  await plain.fill('input[name="d2_x"]', "12.5");
  await plain.fill('input[name="d2_y"]', "-3");
  await picture(plain, "plain_dots");
  await plain.click('section:has-text("Where is a tower good?") button');
  await plain.waitForSelector(".notice");
  assert.match(await plain.textContent(".notice"), /counted/);
  assert.equal(await plain.inputValue('input[name="d2_x"]'), "12.5");
  await plain.fill("textarea", "Without scripts.");
  await plain.click('section:has-text("Comments") button');
  await other.waitForSelector('.said:has-text("Without scripts.")');
  await plain.screenshot({ path: `${shots}/real_plain.png`, fullPage: true });

  // An area is made of a tag of the scene, and given to somebody.
  const areas = "#lead-areas";
  await lead.click(`${areas} summary`);
  await lead.selectOption(`${areas} label:has-text("A tag") select`, "living");
  await lead.click(`${areas} button:has-text("Make the area")`);
  await lead.waitForSelector(`${areas} li:has-text("Tag: living")`);
  const designer = '.people li:has-text("Badger")';
  await lead.click(`${designer} summary`);
  await lead.check(`${designer} .tick:has-text("living") input`);
  await lead.waitForSelector(`${designer} summary:has-text("Designer (living)")`);
  await lead.waitForSelector(`${areas} li:has-text("Has it: Badger")`);
  await picture(lead, "areas");
  // An area by its outline, typed; the room tells its corners, which are drawn over the plan.
  await lead.click(`${areas} .segments button:has-text("An outline")`);
  await lead.click(`${areas} summary:has-text("Corners as numbers")`);
  for (const corner of [["0", "0"], ["80.5", "0"], ["80.5", "60"]]) {
    for (const [k, axis] of ["x", "y"].entries()) await lead.fill(`${areas} label:has-text("New corner: ${axis}") input`, corner[k]);
    await lead.click(`${areas} button:has-text("Add the corner")`);
  }
  await lead.fill(`${areas} label:has-text("Name of the area") input`, "Corner");
  await lead.click(`${areas} button:has-text("Make the area")`);
  await lead.waitForSelector(`${areas} li:has-text("Inside an outline with 3 corners")`);
  await lead.waitForSelector('aside .outline:has-text("corner")');
  await picture(lead, "outline");
  // A designer takes a pen; who leads takes it away, and gives it back.
  await tab(other, "Plan");
  await other.click('#pens button:has-text("Take the pen")');
  await other.waitForSelector('#pens p:has-text("You have the pen.")');
  await picture(other, "pens");
  await lead.waitForSelector(`${areas} li:has-text("Badger has the pen.")`);
  await lead.click(`${areas} li:has-text("living") button:has-text("Take the pen away")`);
  await other.waitForSelector('#pens p:has-text("Nobody has the pen.")');
  await lead.selectOption(`${areas} label:has-text("Give the pen of living to") select`, { label: "Badger" });
  await lead.waitForSelector(`${areas} li:has-text("Badger has the pen.")`);
  await lead.click(`${areas} li:has-text("living") button:has-text("Take the pen away")`);
  await lead.waitForSelector(`${areas} li:has-text("Nobody has the pen.") >> nth=1`);

  // Who comes to a shut door is told at once; who comes while it asks is counted, and let in by a press.
  await lead.click('.segments button:text-is("Shut")');
  await lead.waitForSelector('p:has-text("Nobody new gets in by the code")');
  const began = performance.now();
  const late = await person("");
  await late.waitForSelector('p:has-text("Ask the facilitator to let you in")', { timeout: 3000 });
  const told = performance.now() - began;
  await lead.click('.segments button:text-is("People ask")');
  await lead.waitForSelector('p:has-text("New people only watch")');
  await late.reload();
  await late.click(".join .main");
  await late.waitForSelector('h1:has-text("Please wait")');
  await lead.click('.waiting button:has-text("1 person at the door")');
  await picture(lead, "door");
  await lead.click('.door button:has-text("Let in")');
  await lead.waitForSelector(".door", { state: "detached" });
  await late.waitForSelector('h1:not(:has-text("Please wait"))');
  await lead.click('.segments button:text-is("Open") >> nth=0');

  // A beamer that was opened by the code alone watches, and is nobody who votes.
  const beamer = await person("#beamer", [1920, 1080]);
  await beamer.waitForSelector(".beamer .shape");
  for (const what of ["Vote", "Comments", "Code", "Plan"]) {
    await lead.click(`.segments button:text-is("${what}")`);
    await beamer.waitForTimeout(500);
    await picture(beamer, `beamer_${what.toLowerCase()}`);
  }
  assert.ok(Object.values(room.lead.views.room.seats).some((seat) => seat.role === "viewer" && seat.here));

  // The plan as it is now goes to the programs of others, with an option that is not the usual one.
  await lead.click('summary:has-text("Choose a format")');
  await lead.selectOption('label:has-text("Format") select', "svg");
  await lead.click('summary:has-text("Options")');
  await lead.fill('label:has-text("Scale") input', "1000");
  await lead.click('label:has-text("Labels")');
  const [drawing] = await Promise.all([lead.waitForEvent("download"), lead.click('button:has-text("Save the file")')]);
  assert.match(drawing.suggestedFilename(), /-plan\.svg$/);
  assert.match(readFileSync(await drawing.path(), "utf8"), /^<\?xml[^]*scale 1:1000/);
  await lead.waitForSelector('[role=status]:has-text("was saved")');
  await lead.fill('label:has-text("Scale") input', "huge");
  await lead.click('button:has-text("Save the file")');
  await lead.waitForSelector('[role=status]:has-text("huge")');
  await lead.locator('button:has-text("Save the file")').scrollIntoViewIfNeeded();
  await picture(lead, "plan_as_a_file");
  const refused = faults.splice(0);
  assert.ok(refused.length === 1 && refused[0].endsWith("/export"), "the browser notes the refusal, and nothing else");

  // The session ends, and the facilitator reads what came of it and takes it along.
  await lead.click('.rows li:has-text("Where is a tower good?") button:has-text("Close")');
  await lead.waitForSelector('.rows li:has-text("Where is a tower good?") button:has-text("Open")');
  assert.equal(await heron.locator('button:has-text("Take the minutes home")').count(), 0);
  await lead.check('.tick:has-text("Let everybody who took part") input');
  await lead.click('button:has-text("End the session")');
  await lead.click(".sure .danger");
  const [minutes] = await Promise.all([lead.context().waitForEvent("page"), lead.click('button:has-text("Open the minutes")')]);
  await minutes.waitForSelector("h1");
  assert.match(await minutes.textContent("body"), /Without scripts\./);
  assert.notEqual(await minutes.evaluate(() => getComputedStyle(document.body).fontFamily), "", "it has its style");
  assert.ok(!minutes.url().includes("token"));
  await picture(minutes, "minutes");
  const [home] = await Promise.all([heron.context().waitForEvent("page"), heron.click('button:has-text("Take the minutes home")')]);
  await home.waitForSelector("h1");
  assert.match(await home.textContent("body"), /Without scripts\./);
  const [file] = await Promise.all([lead.waitForEvent("download"), lead.click('button:has-text("Comments, as a table")')]);
  assert.match(readFileSync(await file.path(), "utf8"), /^number,id,entry[^]*Without scripts\./);
  await picture(lead, "minutes_lead");
  assert.deepEqual(faults, []);
  console.log(`ok the page and the real server: ${requests} requests, none of them elsewhere; a shut door told after ${told.toFixed(0)} ms`);
} catch (error) {
  for (const [i, page] of browser
    .contexts()
    .flatMap((context) => context.pages())
    .entries())
    await picture(page, `failed_${i}`);
  console.log(room.said().slice(-600));
  console.log(faults.join("\n"));
  throw error;
} finally {
  await browser.close();
  await room.end();
}
