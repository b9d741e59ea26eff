// A workshop of an hour in a few minutes, as a facilitator leads it from the page alone, with bots as the others.
// Takes a picture of each step into build/web_shots/workshop_*, and says how long each took to be seen. By hand: it looks at nothing.
//
// usage: BEHAVIOURLINKS=... node workshop.mjs [BOTS]
import { spawn } from "node:child_process";
import { readFileSync } from "node:fs";
import { loadavg } from "node:os";
import { opened, path_of, shots, start_room } from "./real_server.mjs";

function scene() {
  const all = JSON.parse(readFileSync(path_of("scenes/studies/vote_on_demands.json"), "utf8"));
  for (const node of all.nodes) if (node.types.vote) node.types.vote.ballots = [];
  const option = (id) => ({ id, label: id[0].toUpperCase() + id.slice(1) });
  const vote = (id, types) => all.nodes.push({ id, name: id, position: [0, -60, 0], types: { vote: { electorate: 10, ...types } } });
  vote("v_hall", { question: "Should there be a market hall?" });
  vote("v_first", { question: "Which use comes first?", kind: "rank", options: ["shops", "nursery", "studios"].map(option) });
  vote("v_where", { question: "Where may it be high?", kind: "dots", points: 3 });
  const volume = all.nodes.find((node) => node.id === "work-4");
  all.nodes.push({ ...volume, id: "hall", name: "Market hall", types: { smart_volume: { ...volume.types.smart_volume, demand: 4000 } } });
  const moves = (id, from, to, option, most) =>
    all.links.push({ id, kind: "vote_to_weight", from, to, parameters: { mapping: [{ option, most }] } });
  moves("m_hall", "v_hall", "work-1", "yes", 12000);
  moves("m_first", "v_first", "work-2", "shops", 12000);
  moves("m_where", "v_where", "work-3", "plus", 12000);
  const control = { node: "hall", port: "smart_volume.demand", label: "Size of the market hall", minimum: 1000, maximum: 9000, step: 250 };
  const card = { interest: "A hall for the market of the quarter", goals: [], budget: 0, controls: [control] };
  all.nodes.push({ id: "traders", name: "Traders", position: [0, -80, 0], types: { stakeholder_group: card } });
  return all;
}

const room = await start_room({ about: scene() });
const browser = await opened();
let step = 0;
async function person(fragment, size) {
  const context = await browser.newContext({ viewport: { width: size[0], height: size[1] }, locale: "en-GB" });
  const page = await context.newPage();
  page.setDefaultTimeout(20000);
  page.on("pageerror", (error) => console.log(`an error: ${error.message}`));
  await page.goto(room.url + fragment);
  return page;
}
async function seen(what, page, wait) {
  const began = performance.now();
  if (wait) await wait();
  const time = performance.now() - began;
  step += 1;
  await page.waitForTimeout(400);
  const name = `workshop_${String(step).padStart(2, "0")}_${what.replace(/\W+/g, "_")}`;
  await page.screenshot({ path: `${shots}/${name}.png` });
  console.log(`${what}: ${time.toFixed(0)} ms; load ${loadavg()[0].toFixed(1)}`);
}

try {
  const lead = await person(`#k=${room.keys.facilitator}`, [1366, 768]);
  await seen("join", lead, () => lead.waitForSelector(".self"));
  await lead.click(".join .main");
  await seen("lead first", lead, () => lead.waitForSelector(".bigcode"));
  await lead.click('summary:has-text("Wi-Fi")');
  await lead.fill('label:has-text("Name of the network") input', "Quarter");
  await lead.fill('label:has-text("Password") input', "tulips in spring");
  await seen("wifi", lead, () => lead.waitForSelector("details .qr"));
  await lead.click('button:has-text("Show the code large")');
  await seen("large code", lead, () => lead.waitForSelector(".codes img >> nth=1"));
  await lead.click('button:has-text("Close")');
  const beamer = await person(`#beamer&w=${encodeURIComponent(JSON.stringify(["Quarter", "tulips in spring"]))}`, [1280, 720]);
  await lead.click('.segments button:text-is("Code")');
  await seen("beamer code", beamer, () => beamer.waitForSelector(".stage.code img >> nth=1"));
  const bots = spawn(process.env.BEHAVIOURLINKS, ["rehearse", `${room.url.replace("http", "room")}#k=${room.keys.facilitator}`, "--bots", process.argv[2] ?? "20", "--seconds", "240"]);
  let heard = "";
  bots.stdout.on("data", (data) => (heard += data));
  bots.stderr.on("data", (data) => (heard += data));
  const phone = await person("", [390, 844]);
  await phone.click(".join .main");
  await seen("people have come", lead, () => lead.waitForSelector(".people li >> nth=10"));
  await seen("phone before the first phase", phone);
  await lead.click('.segments button:text-is("Plan")');
  await lead.check('.tick:has-text("Comments") input');
  await lead.fill('label:has-text("Title of the phase") input', "Say what you see");
  await lead.fill('label:has-text("Minutes") input', "5");
  await lead.click('button:has-text("Start this phase")');
  await seen("phase on the phone", phone, () => phone.waitForSelector('.phase:has-text("Say what you see")'));
  await seen("phase on the lead", lead);
  await seen("phase on the beamer", beamer);
  await phone.click('nav button:has-text("Ideas")');
  await phone.click('button:has-text("Write a comment")');
  await phone.fill("textarea", "The hall should open towards the street.");
  await phone.click('.write button:has-text("Send")');
  await seen("comment for the lead", lead, () => lead.waitForSelector('.comment:has-text("The hall should open")'));
  await lead.click('.segments button:text-is("Comments")');
  await seen("comments on the beamer", beamer);
  await lead.fill('.comment:has-text("The hall should open") input', "Yes, it will.");
  await lead.click('.comment:has-text("The hall should open") button:has-text("Follow it") >> nth=0');
  await seen("answer on the phone", phone, () => phone.waitForSelector('.answer:has-text("Yes, it will.")'));
  const me = await phone.getAttribute(".me", "aria-label");
  const row = `.people li:has-text("${me.split(": ")[1]}")`;
  await lead.click(`${row} summary`);
  await seen("a person", lead);
  await lead.selectOption(`${row} label:has-text("Role card") select`, "traders");
  await phone.waitForSelector('nav button:has-text("Goals")');
  await lead.check('.tick:has-text("Change") input');
  await lead.check('.tick:has-text("Drafts") input');
  await lead.fill('label:has-text("Title of the phase") input', "Change and propose");
  await lead.click('button:has-text("Start this phase")');
  await phone.click('nav button:has-text("Now")');
  await seen("task on the phone", phone, () => phone.waitForSelector('.phase:has-text("Change and propose")'));
  await phone.click('nav button:has-text("Goals")');
  await phone.fill("#control-hall-smart_volume-demand-number", "7000");
  await phone.keyboard.press("Enter");
  await seen("change saved", phone, () => phone.waitForSelector('.mark:has-text("Saved")'));
  await phone.click('nav button:has-text("Ideas")');
  await phone.click('.segments button:has-text("Proposals")');
  await phone.fill(".pick input", "A hall for all");
  await phone.click('button:has-text("Start a draft")');
  for (const size of ["8000", "5500"]) {
    await phone.fill("#control-hall-smart_volume-demand-number", size);
    await phone.keyboard.press("Enter");
    await phone.waitForTimeout(700);
  }
  await seen("draft", phone);
  await phone.click('.banner button:has-text("Propose it")');
  await phone.fill("textarea", "So that bread and cheese fit in.");
  await phone.click('.proposal button:has-text("Propose it")');
  await seen("proposal for the lead", lead, () => lead.waitForSelector('.proposal:has-text("A hall for all")'));
  await lead.locator('.proposal:has-text("A hall for all")').scrollIntoViewIfNeeded();
  await seen("proposal in sight", lead);
  // More than two proposals are folded.
  const folded = lead.locator('.proposal:has-text("A hall for all") details:not([open]) summary:has-text("Decide")');
  if ((await folded.count()) > 0) await folded.click();
  await seen("proposal open", lead);
  const steps = lead.locator('.proposal:has-text("A hall for all") .tick input');
  if ((await steps.count()) > 1) await steps.last().uncheck();
  await lead.click('.proposal:has-text("A hall for all") button:has-text("Accept")');
  await seen("accepted in part", phone, () => phone.waitForSelector('.word:has-text("Accepted")'));
  await lead.click('.segments button:text-is("Vote")');
  // The bots have opened all votes at once; a facilitator opens one at a time.
  const close = lead.locator('.rows button:has-text("Close")');
  while ((await close.count()) > 0) {
    await close.first().click();
    await lead.waitForTimeout(300);
  }
  for (const [question, steps] of [
    ["Should there be a market hall?", [".choice >> nth=0"]],
    ["Which use comes first?", [".choice >> nth=0", ".choice >> nth=0", ".choice >> nth=0"]],
    ["What should the block be for?", ['[aria-label="One more on Homes"]']],
    ["Where may it be high?", ['.pick button:has-text("Set a dot")']],
    ["How high should a storey be?", ['[aria-label^="More"]']],
  ]) {
    await lead.click(`.rows li:has-text("${question}") button:has-text("Open")`);
    await phone.click('nav button:has-text("Votes")');
    await seen(`vote ${question}`, phone, () => phone.waitForSelector(`.vote h2:has-text("${question}")`));
    for (const one of steps) await phone.click(`.vote:not(.closed) ${one}`);
    await phone.click('button:has-text("Send my vote")');
    await phone.waitForSelector('.counted:has-text("counted")');
    await lead.waitForTimeout(4000); // the bots vote
    await seen("vote on the beamer", beamer);
    await lead.click(`.rows li:has-text("${question}") button:has-text("Close")`);
    await seen("result on the phone", phone, () => phone.waitForSelector(`.vote.closed:has-text("${question}")`));
    await seen("result on the beamer", beamer);
  }
  await lead.click('.segments button:text-is("Plan")');
  await seen("plan after the votes", beamer);
  await lead.locator('h2:has-text("Phase")').scrollIntoViewIfNeeded();
  await lead.click('button:has-text("Take back the last 30 s")');
  await seen("rewind asks", lead);
  await lead.click('.sure .danger');
  await seen("rewind done", lead);
  await lead.fill('label:has-text("Decision") input', "The hall is built.");
  await lead.click('button:has-text("Note a decision")');
  await seen("decision noted", lead, () => lead.waitForSelector('.panel:has-text("Note a decision") .mark:has-text("Saved")'));
  await lead.click('button:has-text("End the session")');
  await seen("end asks", lead);
  await lead.click(".sure .danger");
  await seen("ended lead", lead, () => lead.waitForSelector('h2:has-text("Minutes")'));
  await seen("ended phone", phone);
  await seen("ended beamer", beamer);
  bots.kill("SIGINT");
  console.log(heard.slice(-1500));
} catch (error) {
  for (const [i, page] of browser.contexts().flatMap((context) => context.pages()).entries())
    await page.screenshot({ path: `${shots}/workshop_failed_${i}.png` });
  console.log(room.said().slice(-600));
  throw error;
} finally {
  await browser.close();
  await room.end();
}
