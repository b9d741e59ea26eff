// Steps of drafts in words of each language, and areas with their names.
import assert from "node:assert/strict";
import test from "node:test";
import {
  add_table,
  area_id,
  area_name,
  area_words,
  conflict_place,
  de,
  en,
  kLanguages,
  ko,
  nl,
  place_words,
  set_language,
  step_words,
  steps_words,
} from "../../../build/web_test/modules.mjs";

for (const [language, words] of Object.entries({ en, nl, de, ko })) add_table(language, words);
const link = { kind: "Stay near", from: "Library", to: "Hotel" };
// All that the server tells of steps (core/wire/step_words).
const kSteps = [
  { id: "set_port", of: "Library", what: { port: "demand" }, from: 4800, to: 6200, unit: "m3" },
  { id: "set_port", of: "Library", what: { port: "position" }, from: [0, 0, 0], to: [4.5, 4, 0], unit: "" },
  { id: "set_port", of: "Library", what: { port: "plan" } },
  { id: "set_cell", of: "Library", what: { port: "floors" } },
  { id: "set_setting", of: "tolerance", to: 0.01 },
  { id: "set_link_strength", of: link, what: { port: "strength" }, from: 0.5, to: 0.8 },
  { id: "set_link_parameter", of: link, what: { port: "distance" }, from: 5, to: 8, unit: "m" },
  ...["add_row", "remove_row", "lock_port", "unlock_port"].map((id) => ({ id, of: "Library", what: { port: "use" } })),
  ...["add_node", "remove_node"].map((id) => ({ id, of: "Library" })),
  ...["add_nodes", "remove_nodes"].map((id) => ({ id, n: 3 })),
  ...["rename_node", "typify", "untypify"].map((id) => ({ id, of: "Library", to: "Mill" })),
  ...["add_link", "remove_link", "set_link_ends", "enable_link", "not_enable_link", "mute_link", "not_mute_link"].map((id) => ({ id, of: link })),
];

test("each step has words of its own in each language, with its names and values, and no gap is left open", () => {
  for (const language of kLanguages) {
    set_language(language);
    const all = kSteps.map((said) => step_words(said, "ENGLISH"));
    for (const [i, words] of all.entries()) {
      assert.ok(!words.includes("ENGLISH") && !/[{}]|undefined/.test(words), `${language}: ${words}`);
      const { of, n } = kSteps[i];
      if (typeof of === "object") for (const name of Object.values(of)) assert.ok(words.includes(name), `${language}: ${words}`);
      else if (of !== undefined) assert.ok(words.includes(of), `${language}: ${words}`);
      else assert.ok(words.includes(String(n)), `${language}: ${words}`);
    }
    assert.equal(new Set(all).size, all.length, `${language}: two steps with the same words`);
  }
  set_language("en");
});

test("values are told with their unit, and small changes in so many digits that they differ", () => {
  const [first] = kSteps;
  assert.equal(step_words(first, ""), "Library, wanted size: from 4,800 to 6,200\u00a0m³");
  assert.equal(step_words({ ...first, from: 4800.2, to: 4800.4 }, ""), "Library, wanted size: from 4,800.2 to 4,800.4\u00a0m³");
  assert.equal(step_words({ ...first, from: undefined }, ""), "Library, wanted size: 6,200\u00a0m³");
  assert.equal(step_words({ ...first, what: { port: "is_open" }, from: false, to: true, unit: "" }, ""), "Library, is open: from No to Yes");
  assert.equal(step_words({ ...first, n: 2 }, ""), "Library, wanted size: from 4,800 to 6,200\u00a0m³, and 2 more");
  set_language("de");
  assert.equal(step_words(first, ""), "Library, gewünschte Größe: von 4.800 auf 6.200\u00a0m³");
  set_language("en");
});

test("a role card's words come before those of the page, and the thing is named once", () => {
  assert.equal(place_words({ of: "Library", what: { port: "demand", label: "Size of the library" } }), "Size of the library");
  assert.equal(place_words({ of: "Library", what: { port: "demand", label: "Size" } }), "Library, Size");
  assert.equal(place_words({ of: link, what: { port: "strength", label: "How near to the park" } }), "How near to the park");
  assert.equal(place_words({ of: "Library", what: { port: "types.smart_volume.storey_height" } }), "Library, height of a storey");
  assert.equal(conflict_place({ place: "nodes/a", label: "A, demand", by: "Otter" }), "A, demand", "a server that tells no parts");
  assert.equal(conflict_place({ place: "nodes/a", label: "A, demand", said: { of: "A", what: { port: "demand" } }, by: "Otter" }), "A, wanted size");
});

test("what the page has no words for is told in English, and what was taken back not at all", () => {
  assert.equal(step_words({ id: "dance", of: "Library" }, "Dance · Library"), "Dance · Library");
  assert.equal(step_words(null, "Dance"), "Dance");
  assert.deepEqual(steps_words(["A", "", "B"], undefined), ["A", "", "B"]);
  assert.deepEqual(steps_words(["A", "", "B"], [{ id: "add_node", of: "Mill" }, null, null]), ["New: Mill", "", "B"]);
});

test("names of areas are such that the server takes them", () => {
  for (const name of ["North", "Südliche Höfe", "  A & B ", "École 2", "x".repeat(90), "Straße", "__a__"]) {
    const id = area_id(name);
    assert.match(id, /^[a-z0-9][a-z0-9_]{0,63}$/, name);
    assert.equal(area_id(id), id, "a name stays as it is");
  }
  assert.equal(area_id("Südliche Höfe"), "sudliche_hofe");
  assert.equal(area_name("북쪽", ["area_1", "north"]), "area_2");
  assert.equal(area_name("  ", []), "", "nothing was typed");
  assert.equal(area_name("North", ["north"]), "north", "that one is changed");
});

test("what lies in an area is told by names", () => {
  const roles = { smart_volume: { label: "Volume", count: 3 } },
    words = (nodes, corners = 0) => area_words({ nodes, corners }, roles, (node) => node.toUpperCase());
  assert.equal(words("hotel"), "HOTEL");
  assert.equal(words(["hotel", "library"]), "HOTEL, LIBRARY");
  assert.equal(words({ tag: "work" }), "Tag: work");
  assert.equal(words({ typification: "smart_volume", tag: "work" }), "Tag: work, Role: Volume");
  assert.equal(words({ typification: "unknown" }), "Role: unknown");
  assert.equal(words([], 4), "Inside an outline with 4 corners");
});
