// Health on the facilitator's page: what needs somebody comes first, and says what to do, in each language.
import assert from "node:assert/strict";
import test from "node:test";
import { add_table, de, findings_of, kLanguages, ko, nl, set_language } from "../../../build/web_test/modules.mjs";
import { seeded } from "./fakes.mjs";

for (const [language, table] of Object.entries({ de, nl, ko })) add_table(language, table);
const kVerdicts = ["bad", "look", "good"];

/// A computer of which nobody knows anything.
const silent = (more = {}) => ({
  t: "health",
  tick_ms: 4,
  rate: 10,
  wanted: 10,
  settled: true,
  worst: 0,
  disk_ms: 4,
  disk_slow_ms: 8,
  journal: -1,
  snapshot_age: -1,
  followers: 0,
  battery: -1,
  wireless: {},
  memory_free: -1,
  disk_free: -1,
  reached: {},
  verdicts: { ticks: "good", disk: "good" },
  ...more,
});
const findings = (more, isPaused = false) => findings_of(silent(more), isPaused, (node) => node.toUpperCase());

test("whatever a server tells, the worst stands first, and only what is not good says what to do", () => {
  const chance = seeded(5),
    any = (list) => list[Math.floor(chance() * list.length)],
    verdict = () => any(kVerdicts);
  for (let round = 0; round < 400; ++round) {
    set_language(any(kLanguages));
    const verdicts = {};
    for (const figure of ["ticks", "disk", "power", "memory", "space", "wireless/w", "reached/http://a:1"]) verdicts[figure] = verdict();
    const all = findings({
      verdicts,
      battery: any([-1, 0.4]),
      mains: any([undefined, "yes", "no"]),
      wireless: any([{}, { w: 0.3 }]),
      reached: any([{}, { "http://a:1": any([0, 1, 7]) }]),
      memory_free: any([-1, 5e8]),
      disk_free: any([-1, 5e10]),
      worst_of: any([undefined, "school"]),
      failure: any([undefined, "out of memory"]),
      problem: any([undefined, "disk full"]),
    });
    const order = all.map((one) => kVerdicts.indexOf(one.verdict));
    assert.deepEqual(order, [...order].sort(), "sorted");
    for (const { verdict, text, advice } of all) {
      assert.equal(advice !== "", verdict !== "good", text);
      assert.ok(text !== "" && !/undefined|NaN|[{}]/.test(text + advice), text);
    }
    assert.equal(new Set(all.map((one) => one.text)).size, all.length, "no sentence twice");
  }
  set_language("en");
});

test("what nobody knows is left out, and what is known is said with its unit", () => {
  const said = (more, isPaused) => findings(more, isPaused).map((one) => one.text).join("\n");
  assert.doesNotMatch(said({}), /-1|battery|memory|disk of|Wi-Fi|error|snapshot was/);
  assert.match(said({}), /^A step of the model takes 4\sms\. 10 steps a second are wanted\./);
  assert.match(said({}, true), /The model is paused\./);
  assert.match(said({ memory_free: 3.5e9 }), /3\.5\sGB of memory/);
  assert.match(said({ disk_free: 9.9e8 }), /990\sMB are free on the disk/);
  assert.match(said({ battery: 0.424, mains: "no" }), /battery is at 42%, and the computer is not plugged in/);
  assert.match(said({ worst: 0.25, worst_of: "school" }), /largest error is 25%, of SCHOOL/);
  assert.match(said({ snapshot_age: 130 }), /2 min ago/);
});

test("what has stopped or cannot be stored stands above all", () => {
  const all = findings({ problem: "disk full", verdicts: { ticks: "bad", disk: "look" } });
  assert.deepEqual(
    all.slice(0, 3).map((one) => one.verdict),
    ["bad", "bad", "look"],
  );
  assert.equal(all[0].text, "Nothing can be stored: disk full");
});
