// Numbers, sentences and outlines.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync, readdirSync } from "node:fs";
import test from "node:test";
import {
  add_table,
  amount,
  best_language,
  countdown,
  de,
  duration,
  en,
  extent_of,
  in_steps,
  kLanguages,
  kScripts,
  ko,
  export_form,
  file_from_server,
  minutes_form,
  option_name,
  saved_as,
  minutes_of,
  nl,
  number,
  points_of,
  round_step,
  set_language,
  share,
  subject_of,
  t,
  typed_number,
  why_of,
  is_password,
  wifi_of_address,
  wifi_text,
  wifi_to_address,
  written,
  zone_text,
} from "../../../build/web_test/modules.mjs";
import { seeded } from "./fakes.mjs";

const kTables = { en, nl, de, ko };
for (const [language, words] of Object.entries(kTables)) add_table(language, words);
const each_language = (check) => {
  for (const language of kLanguages) {
    set_language(language);
    check(language);
  }
  set_language("en");
};

test("a number that is written can be typed back, in each language", () => {
  const chance = seeded(3);
  each_language((language) => {
    for (let i = 0; i < 300; ++i) {
      const value = Math.round((chance() - 0.5) * 10 ** (1 + Math.floor(chance() * 6)) * 100) / 100;
      assert.equal(typed_number(number(value, 0.01)), value, `${language}: ${number(value, 0.01)}`);
    }
  });
});

test("numbers and plural forms are those of the rules of each language", () => {
  each_language((language) => {
    for (let value = -1200; value <= 1200; ++value)
      assert.equal(written(value), new Intl.NumberFormat(language).format(value === 0 ? 0 : value), `${language}: ${value}`);
    for (const value of [0.5, 1234.5678, 1e6])
      for (const digits of [0, 2])
        assert.equal(written(value, "decimal", digits), new Intl.NumberFormat(language, { maximumFractionDigits: digits }).format(value));
    // One form for 1 and one for the rest is all that the page knows: a language that has more needs more of it.
    const rules = new Intl.PluralRules(language);
    for (let n = 0; n <= 1200; ++n) assert.ok(n === 1 ? ["one", "other"].includes(rules.select(n)) : rules.select(n) === "other", `${language}: ${n}`);
    if (rules.select(1) === "other")
      for (const [key, text] of Object.entries(kTables[language])) assert.ok(typeof text === "string" || text.one === text.other, `${language}: ${key}`);
  });
});

test("typed numbers", () => {
  assert.equal(typed_number(" 4,800 "), 4800);
  assert.equal(typed_number("4800"), 4800);
  for (const text of ["", "-", "4800 m", "1,2", "1e5", "NaN", "--3"]) assert.equal(typed_number(text), null, text);
  set_language("de");
  assert.equal(typed_number("0,45"), 0.45);
  assert.equal(typed_number("4.800,5"), 4800.5);
  assert.equal(typed_number("4.800"), 4800);
  set_language("en");
});

test("numbers are as long as people read at a glance", () => {
  assert.equal(number(3.14159), "3.14");
  assert.equal(number(31.4159), "31.4");
  assert.equal(number(31415.9), "31,416");
  assert.equal(number(-0), "0");
  assert.equal(number(NaN), "–");
  assert.equal(number(0.4, 0.05), "0.4");
  assert.equal(amount(3, ""), "3");
  assert.equal(amount(3, "m2"), "3\u00a0m²");
  assert.equal(amount(3, "kWh/m3"), "3\u00a0kWh/m³");
  assert.equal(amount(3, "1"), "3");
  assert.equal(share(0.126), "13%");
  assert.equal(duration(12400), "12 s");
  assert.equal(duration(150000), "2 min");
  assert.equal(countdown(247000), "4:07");
  assert.equal(countdown(-5), "0:00");
});

test("steps stay in the range of a control, and the ends can be reached", () => {
  const chance = seeded(5);
  for (let i = 0; i < 500; ++i) {
    const least = Math.round(chance() * 100) / 10,
      most = least + 1 + Math.round(chance() * 500) / 10,
      step = [0, 0.05, 0.1, 1, 7][Math.floor(chance() * 5)];
    const value = in_steps(least - 5 + chance() * (most - least + 10), least, most, step);
    assert.ok(value >= least && value <= most);
    assert.equal(in_steps(least, least, most, step), least);
    const count = (most - least) / round_step(least, most);
    assert.ok(count >= 40 && count <= 100.001, `${count} steps from ${least} to ${most}`);
  }
  assert.equal(in_steps(0.30000000000000004, 0, 1, 0.1), 0.3);
});

test("all languages say everything, with the same gaps to fill", () => {
  const gaps = (text) =>
    (typeof text === "string" ? [text] : [text.one, text.other]).map((one) => [...new Set(one.match(/\{\w+\}/g) ?? [])].sort().join());
  for (const language of kLanguages)
    for (const [key, text] of Object.entries(kTables.en)) {
      const other = kTables[language][key];
      assert.ok(other, `${language}: ${key}`);
      for (const one of gaps(other)) assert.equal(one, gaps(text)[0], `${language}: ${key}`);
    }
});

test("every sentence is used, and every reason has one", () => {
  const folder = new URL("../src/", import.meta.url),
    rooms = ["screens/", "files/", "lead/"].map((name) => new URL(name, folder));
  const all = [folder, ...rooms].map((at) =>
    readdirSync(at)
      .filter((name) => /\.tsx?$/.test(name))
      .map((name) => readFileSync(new URL(name, at), "utf8"))
      .join("\n"),
  );
  const source = all.join("\n"),
    page = all.slice(0, 2).join("\n");
  const made = [...source.matchAll(/`([a-z]+_(?:[a-z]+_)?)\$\{/g)].map((match) => match[1]);
  for (const key of Object.keys(kTables.en))
    assert.ok(
      new RegExp(`["'\`]${key}["'\`]`).test(source) || made.some((start) => key.startsWith(start)),
      `nobody says ${key}`,
    );
  // What only the script of a part has, the page cannot say before that script is here; and no sentence stands in two places.
  const { page: first, files, lead } = kScripts;
  for (const key of [...Object.keys(files), ...Object.keys(lead)]) {
    assert.ok(!new RegExp(`["'\`]${key}["'\`]`).test(page), `the page says ${key}`);
    assert.ok(!(key in first), key);
  }
  for (const key of Object.keys(files)) assert.ok(!(key in lead), key);
  const reasons = [
    "bad",
    "gone",
    "right",
    "area",
    "phase",
    "range",
    "budget",
    "stale",
    "conflict",
    "locked",
    "closed",
    "rate",
    "size",
    "storage",
    "draining",
    "gap",
    "seat",
  ];
  each_language((language) => {
    const said = reasons.map((why) => t(why_of({ kind: "refused", why, place: "nodes/a", text: "", args: {} }).key));
    assert.equal(new Set(said).size, reasons.length, `${language}: a sentence of its own for each reason`);
  });
});

test("a refusal says what its arguments tell", () => {
  const said = (why, args) => {
    const { key, args: values } = why_of({ kind: "refused", why, place: "", text: "", args });
    return t(key, values);
  };
  assert.equal(said("area", { area: "north", holder: "Bea" }), "Bea is working on the area north at the moment.");
  assert.equal(said("range", { minimum: 2000, maximum: 9000 }), "Your role card allows 2,000 to 9,000.");
  assert.equal(said("stale", { by: "Ben", now: 5 }), "Ben has changed it since.");
  assert.equal(said("stale", {}), "Somebody has changed it since.");
  const why = (reason, place) => t(why_of({ kind: "refused", why: reason, place, text: "", args: {} }).key);
  assert.equal(why("gone", "to"), "Nothing of the model can be taken back for that time.");
  assert.equal(why("gone", "nodes/a"), "It is not there any more.");
  assert.equal(why("locked", ""), "The facilitator has muted you.");
  assert.equal(why("locked", "nodes/a"), "It is locked.");
  assert.equal(subject_of({ mark: "vote/bridge" }), "what_vote");
  assert.equal(subject_of({}), "what_op");
});

test("plural forms and languages", () => {
  assert.equal(t("waits", { n: 1 }), "1 change waits");
  assert.equal(t("waits", { n: 3 }), "3 changes wait");
  assert.equal(best_language(["fr-FR", "nl-BE", "en"]), "nl");
  assert.equal(best_language([]), "en");
  set_language("xx");
  assert.match(t("go"), /^\[Jö.*~+\]$/);
  assert.match(t("consent", { name: "Heron" }), /Heron/);
  set_language("en");
});

test("outlines are read as browsers read them", () => {
  assert.deepEqual(points_of("M0 0h10v-5H2z"), [
    [0, 0],
    [10, 0],
    [10, -5],
    [2, -5],
  ]);
  assert.deepEqual(points_of("m1,1 2,0-.5.5z m5 5"), [
    [1, 1],
    [3, 1],
    [2.5, 1.5],
    [6, 6],
  ]);
  assert.deepEqual(points_of("M0 0C1 1 2 2 3 3A1 1 0 0 1 5 5"), [
    [0, 0],
    [3, 3],
    [5, 5],
  ]);
  assert.deepEqual(points_of("nonsense"), []);
  assert.deepEqual(extent_of(points_of("M1e1 2L-4 8")), { x: -4, y: 2, width: 14, height: 6 });
  assert.equal(extent_of([]), null);
});

// A reader of such codes that shares nothing with the page: fields end at a `;` that no `\\` stands before.
test("a password of a Wi-Fi has 8 to 63 signs of ASCII, or none", () => {
  for (const good of ["", "12345678", "tulips in spring", "~".repeat(63)]) assert.ok(is_password(good), good);
  for (const bad of ["1234567", "~".repeat(64), "καλημέρα 2026", "schöner Tag", "tab\tand more"]) assert.ok(!is_password(bad), bad);
});

function read_wifi(text) {
  assert.ok(text.startsWith("WIFI:") && text.endsWith(";;"));
  const fields = {};
  for (const [, name, value] of text.slice(5).matchAll(/([A-Z]):((?:\\.|[^;\\])*);/g)) fields[name] = value.replace(/\\(.)/g, "$1");
  return fields;
}

const answering =
  (asked, status, text, headers = {}) =>
  async (address, how) => {
    asked.push({ address, method: how.method, body: how.body.toString() });
    return new Response(text, { status, headers });
  };

test("files are asked for by a form, and each way to get none has a sentence", async () => {
  const asked = [],
    form = minutes_form("BKRT", "secret", "votes.csv", zone_text(-60));
  const got = await file_from_server("minutes", form, answering(asked, 200, "vote,round"));
  assert.equal(await got.blob.text(), "vote,round");
  assert.deepEqual(got.notes, []);
  assert.deepEqual(asked, [{ address: "/minutes", method: "POST", body: "room=BKRT&token=secret&file=votes.csv&zone=%2B01%3A00" }]);
  for (const what of ["minutes", "export"]) {
    const why = async (ask) => (await file_from_server(what, form, ask)).why;
    assert.equal(await why(answering(asked, 409, "busy")), `${what}_busy`);
    assert.equal(await why(answering(asked, 403, "no")), `${what}_right`);
    const full = await file_from_server(what, form, answering(asked, 500, "The disk is full.\n"));
    assert.deepEqual(full, { why: `${what}_failed`, text: "The disk is full." });
    assert.equal(await why(() => Promise.reject(new TypeError("no network"))), "files_offline");
  }
});

test("the plan is asked for with what differs from the defaults, and what it cannot hold is told", async () => {
  const format = {
    id: "dxf",
    ending: ".dxf",
    options: [
      { id: "scale", kind: "integer", default: 200 },
      { id: "with_frame", kind: "boolean", default: true },
      { id: "paper", kind: "choice", default: "a3" },
    ],
  };
  const form = export_form("BKRT", "secret", format, { scale: "200", with_frame: "no", paper: "a1", other: "x" });
  assert.deepEqual(form, { room: "BKRT", token: "secret", format: "dxf", "option.with_frame": "no", "option.paper": "a1" });
  const got = await file_from_server("export", form, answering([], 200, "0", { notes: "f%C3%BCr%20A%0Aand%20B" }));
  assert.deepEqual(got.notes, ["für A", "and B"]);
  assert.equal(saved_as("BKRT", "scenes/end.json"), "BKRT-end.json");
  assert.equal(option_name("with_frame"), "With frame");
});

test("the zone of a device is written as the server reads it", () => {
  assert.deepEqual([0, -60, -330, 150, 720].map(zone_text), ["UTC", "+01:00", "+05:30", "-02:30", "-12:00"]);
});

test("the command of the minutes takes any name of a file as one word", () => {
  const plain = minutes_of("/home/a/scene.blsession");
  assert.equal(plain.command, "./bl minutes /home/a/scene.blsession --out /home/a/scene-minutes");
  assert.equal(plain.page, "/home/a/scene-minutes/minutes.html");
  for (const file of ["/home/An na/it's; $(rm) `x`.blsession", "/tmp/\"q\"&é.blsession", "/tmp/plain.db"]) {
    const words = execFileSync("sh", ["-c", minutes_of(file).command.replace("./bl", "printf '%s\\n'")], { encoding: "utf8" }).split("\n");
    assert.deepEqual(words, ["minutes", file, "--out", minutes_of(file).page.replace("/minutes.html", ""), ""]);
  }
});

test("phones read the Wi-Fi as it was typed, and so does the beamer", () => {
  const chance = seeded(5),
    letters = ["a", "B", "7", " ", ";", ",", ":", "\\", '"', "&", "#", "=", "ü", "방", "%"];
  for (let k = 0; k < 2000; ++k) {
    const some = (most) => Array.from({ length: Math.ceil(chance() * most) }, () => letters[Math.floor(chance() * letters.length)]).join("");
    const wifi = { name: some(12), password: chance() < 0.2 ? "" : some(20) };
    const read = read_wifi(wifi_text(wifi));
    assert.deepEqual([read.S, read.P ?? "", read.T], [wifi.name, wifi.password, wifi.password === "" ? "nopass" : "WPA"]);
    const address = wifi_to_address(wifi);
    assert.doesNotMatch(address, /[&#= "]/, "one field behind the #");
    assert.deepEqual(wifi_of_address(address), wifi);
  }
  for (const odd of ["", "%", "[]", "%5B1%2C2%5D", "{}", "%5B%22%22%2C%22x%22%5D"]) assert.equal(wifi_of_address(odd), null);
});
