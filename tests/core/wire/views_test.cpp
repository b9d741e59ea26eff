// Views: of a scene with volumes, votes and a role card; and the law that differences add up to the whole.
#include "core/wire/views.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sstream>

#include "core/base/random.h"
#include "core/define/json_text.h"
#include "tests/support/random_commands.h"
#include "tests/support/world.h"

namespace bl::wire {
namespace {

// A page's own table, kept by messages alone.
void apply(View& view, const std::string& message) {
  const Json json = *parse_json(message);
  for (const auto& [key, content] : json["set"].get_ref<const Json::object_t&>()) view[key] = write_json_line(content);
  if (json.contains("drop"))
    for (const Json& key : json["drop"]) view.erase(key.get<std::string>());
}

TEST(Views, DifferencesAddUpToTheWhole) {
  World world = World::from_file("scenes/start/quarter.json");
  room::Room room(world.session().ledger(), {});
  const auto admitted = room.admit({.role = Role::facilitator}, {0, 0});
  ASSERT_TRUE(std::holds_alternative<room::Admission>(admitted));
  Random random(3);
  std::map<std::string, View> before, told;
  int sent = 0;
  for (int k = 0; k < 120; ++k) {
    (void)world.session().submit(random_command(world.session().scene(), random, k), "anna");
    world.tick(1 + static_cast<int>(random.below(3)));
    const ViewSources sources{world.state(), room, "CODE", "Title"};
    for (const std::string_view view : kViewNames) {
      const std::string name(view);
      const View now = make_view(name, sources, 1);
      const auto changes = changes_of(name, before.contains(name) ? &before[name] : nullptr, now, k, k);
      if (changes) {
        apply(told[name], *changes);
        ++sent;
      }
      ASSERT_EQ(told[name], now) << name << ", step " << k;
      ASSERT_FALSE(changes_of(name, &now, now, k, k).has_value());
      before[name] = now;
    }
  }
  EXPECT_GT(sent, 100);
}

// A room sees a rule that is broken without asking: beside the indicators, with who breaks it and what to do.
TEST(Views, ABrokenRuleStandsAmongTheFigures) {
  World world = World::from_file("scenes/nodes/plot.json");
  ASSERT_EQ(world.submit(command<SetPort>({.node = "plot", .port = {"plot.height_max"}, .value = {"3"}})), "");
  world.tick(30);
  room::Room room(world.session().ledger(), {});
  const View view = make_view("figures", {world.state(), room, "CODE", "Title"}, 1);
  ASSERT_TRUE(view.contains("plot/height_max"));
  const Json figure = *parse_json(view.at("plot/height_max"));
  EXPECT_EQ(figure["name"], "Plot: height");
  EXPECT_EQ(figure["target"], 3);
  EXPECT_EQ(figure["direction"], "at_most");
  EXPECT_EQ(figure["status"], "far");
  EXPECT_GT(figure["value"].get<double>(), 3);
  EXPECT_NE(figure["why"].get<std::string>().find("nothing holds it"), std::string::npos);
  EXPECT_FALSE(view.contains("plot/fsi_max"));
}

TEST(Views, KeysAreForWhoLeads) {
  World world = World::from_file("scenes/start/quarter.json");
  room::Room room(world.session().ledger(), {});
  const std::map<std::string, std::string> invites = {{"designer", "0123"}, {"viewer", "4567"}};
  for (std::size_t role = 0; role < kRoleCount; ++role)
    ASSERT_TRUE(
        std::holds_alternative<room::Admission>(room.admit({.role = static_cast<Role>(role), .areas = {}, .card = {}}, {0, 0})));
  for (std::int64_t seat = 0; seat <= static_cast<std::int64_t>(kRoleCount) + 1; ++seat) {
    const View keys = make_view("keys", {world.state(), room, "", "", nullptr, &invites}, seat);
    const View expected = {{"designer", "\"0123\""}, {"viewer", "\"4567\""}};
    EXPECT_EQ(keys, seat == 1 ? expected : View()) << "seat " << seat;
    EXPECT_TRUE(make_view("keys", {world.state(), room, "", ""}, seat).empty());
  }
}

TEST(Views, DecisionsHaveTheirWordsUntilTheseAreErased) {
  World world = World::from_file("scenes/start/quarter.json");
  room::Room room(world.session().ledger(), {});
  ASSERT_TRUE(std::holds_alternative<room::Admission>(room.admit({.role = Role::facilitator}, {0, 0})));
  std::int64_t id = 0;
  const auto say = [&](const char* event) {
    room::Operation operation{.run = "r", .id = ++id, .kind = room::OperationKind::event};
    operation.content = std::string(event);
    (void)room.submit(1, operation, {0, 500});
  };
  say(R"({"event": "set_phase", "arguments": {"name": "Explore"}})");
  say(R"({"event": "mark", "arguments": {"text": "We keep the mill."}})");
  const auto shown = [&] {
    std::string all;
    for (const auto& [key, content] : make_view("decisions", {world.state(), room, "", ""}, 1)) {
      const Json one = *parse_json(content);
      all += one["kind"].get<std::string>() + ":" + one.value("title", "") + one.value("text", "") + " ";
      EXPECT_EQ(one["at"], 500);
      EXPECT_EQ(one["seat"], 1);
    }
    return all;
  };
  EXPECT_EQ(shown(), "phase:Explore mark:We keep the mill. ");
  say(R"({"event": "forget", "arguments": {"seat": 1}})");
  EXPECT_EQ(shown().find("mill"), std::string::npos);
}

// Path data as `plan_view` writes it: corners of each ring [m].
std::vector<std::vector<std::pair<double, double>>> rings_of(const std::string& path) {
  std::vector<std::vector<std::pair<double, double>>> rings;
  std::istringstream in(path);
  double x = 0, y = 0;
  for (char letter = 0; in >> letter;) {
    if (letter == 'z') continue;
    double across = 0, down = 0;
    in >> across >> down;
    if (letter == 'M') rings.emplace_back(), x = across, y = down;
    else x += across, y += down;
    rings.back().emplace_back(x, y);
  }
  return rings;
}

TEST(Views, WhatStandsShowsItsOutlineAndItsCourtyard) {
  World world = World::from_text(R"({"format": "behaviourlinks", "version": 1, "settings": {}, "nodes": [
    {"id": "plot", "types": {"boundary": {"form": "plan", "height": 40,
      "plan": [[0,0,0],[80,0,0],[80,30,0],[30,30,0],[30,80,0],[0,80,0]]}}},
    {"id": "solver", "types": {"standing_solver": {}}},
    {"id": "it", "position": [28, 25, 0], "types": {"smart_volume": {"demand": 12000, "storey_height": 3},
      "footprint": {"form": "round", "storeys": 3, "depth": 9}}}]})");
  ASSERT_TRUE(world.settle());
  room::Room room(world.session().ledger(), {});
  const View plan = make_view("plan", {world.state(), room, "", ""}, 0);
  const auto rings = rings_of((*parse_json(plan.at("n/it")))["d"].get<std::string>());
  ASSERT_EQ(rings.size(), 2u);
  double area = 0;
  for (const auto& ring : rings)
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const auto& [x, y] = ring[k];
      const auto& [u, v] = ring[(k + 1) % ring.size()];
      area += (x * v - u * y) / 2;
      EXPECT_FALSE(x > 30.1 && y < -30.1) << "outside the plot: " << x << ", " << y;
    }
  // The outline is as y downwards makes it, and its courtyard the other way round.
  EXPECT_NEAR(-area, world.number("it", "smart_volume.footprint"), 0.01 * world.number("it", "smart_volume.footprint"));
}

TEST(Views, ThePlanHasEveryVolumeAndItsBoxHoldsThem) {
  World world = World::from_file("scenes/start/quarter.json");
  world.settle();
  room::Room room(world.session().ledger(), {});
  const View plan = make_view("plan", {world.state(), room, "", ""}, 0);
  std::size_t volumes = 0;
  for (const auto& [key, content] : plan) {
    const Json node = *parse_json(content);
    if (key == "box" || node["kind"] != "volume") continue;
    ++volumes;
    EXPECT_EQ(node["d"].get<std::string>().substr(0, 1), "M");
    EXPECT_TRUE(node["d"].get<std::string>().ends_with("z"));
    EXPECT_EQ(node["figures"].size(), 4u);
  }
  std::size_t carried = 0;
  for (const auto& [id, node] : world.session().scene().nodes) carried += node.types.contains("smart_volume") ? 1 : 0;
  EXPECT_EQ(volumes, carried);
  EXPECT_EQ(parse_json(plan.at("box"))->size(), 4u);
}

TEST(Views, ThePageKnowsCardsFormsDirectionsAndWhoChangedAValue) {
  World world = World::from_file("scenes/nodes/stakeholder_group.json");
  room::Room room(world.session().ledger(), {});
  const auto admitted = room.admit({.role = Role::stakeholder, .areas = {"north"}, .card = "residents"}, {0, 0});
  ASSERT_TRUE(std::holds_alternative<room::Admission>(admitted));
  world.tick(1);
  const ViewSources sources{world.state(), room, "CODE", "Title"};
  const View view = make_view("room", sources, 1);
  const Json seat = (*parse_json(view.at("seats")))["1"];
  EXPECT_EQ(seat["card"], "residents");
  EXPECT_EQ(seat["areas"], Json::array({"north"}));
  const Json cards = *parse_json(view.at("cards"));
  std::size_t groups = 0;
  for (const auto& [id, node] : world.session().scene().nodes) groups += node.types.contains("stakeholder_group") ? 1 : 0;
  EXPECT_EQ(cards.size(), groups);
  EXPECT_GT(groups, 0u);
  for (const auto& [id, content] : make_view("figures", sources, 1)) {
    const std::string direction = (*parse_json(content))["direction"];
    EXPECT_TRUE(direction == "at_least" || direction == "at_most" || direction == "near") << id;
  }
}

// A card on a value that a link acts on as well, on the strength of that link, and on a parameter of another.
constexpr const char* kSharedValue = R"({"format": "behaviourlinks", "version": 1, "nodes": [
  {"id": "hall", "types": {"smart_volume": {"demand": 4000}}},
  {"id": "dial", "types": {"control": {"value": 9000, "maximum": 10000, "unit": "m3"}}},
  {"id": "card", "types": {"stakeholder_group": {"controls": [
    {"node": "hall", "port": "smart_volume.demand", "label": "Hall", "minimum": 0, "maximum": 9000},
    {"node": "hall", "port": "smart_volume.storey_height", "label": "Storey", "minimum": 3, "maximum": 5},
    {"node": "moves", "port": "strength", "label": "", "minimum": 0, "maximum": 1},
    {"node": "moves", "port": "in_max", "label": "Top", "minimum": 0, "maximum": 9}]}}}],
  "links": [{"id": "moves", "kind": "map_value", "from": "dial", "to": "hall", "strength": 0.75, "parameters": {"in_max": 3}}]})";

TEST(Views, ControlsOfLinksHaveValuesAndThoseThatLinksMoveTellTheOutcome) {
  World world = World::from_text(kSharedValue);
  room::Room room(world.session().ledger(), {});
  ASSERT_TRUE(
      std::holds_alternative<room::Admission>(room.admit({.role = Role::stakeholder, .areas = {}, .card = "card"}, {0, 0})));
  world.tick(2);
  const View card = make_view("card", {world.state(), room, "", ""}, 1);
  const Json controls = *parse_json(card.at("controls"));
  ASSERT_EQ(controls.size(), 4u);
  EXPECT_EQ(controls[0]["value"], 4000);
  EXPECT_EQ(controls[0]["outcome"], world.number("hall", "smart_volume.demand"));
  EXPECT_NE(controls[0]["outcome"], 4000);
  EXPECT_FALSE(controls[1].contains("outcome")) << "no link acts on it";
  EXPECT_EQ(controls[2]["value"], 0.75);
  EXPECT_EQ(controls[2]["label"], "strength");
  EXPECT_EQ(controls[3]["value"], 3);
  EXPECT_FALSE(controls[3].contains("by"));
  const auto said = room.submit(
      1,
      {.run = "r",
       .id = 1,
       .kind = room::OperationKind::command,
       .content =
           JsonValue(R"({"command": "set_link_parameter", "arguments": {"id": "moves", "parameter": "in_max", "value": 5}})"),
       .draft = ""},
      {0, 0});
  EXPECT_TRUE(std::holds_alternative<room::Acknowledgement>(said)) << "the page says it in these words";
  const View later = make_view("card", {world.state(), room, "", ""}, 1);
  const Json now = *parse_json(later.at("controls"));
  EXPECT_EQ(now[3]["value"], 5);
  EXPECT_TRUE(now[3].contains("by"));
}

TEST(Views, StepsAndControlsNameValuesAndWhoSetThem) {
  World world = World::from_file("scenes/start/quarter.json");
  room::Room room(world.session().ledger(), {});
  const auto admitted = room.admit({.role = Role::facilitator}, {0, 0});
  ASSERT_TRUE(std::holds_alternative<room::Admission>(admitted));
  const auto set = [](const char* value) {
    return JsonValue(
        std::string(R"({"command": "set_port", "arguments": {"node": "library", "port": "smart_volume.demand", "value": )") +
        value + "}}");
  };
  const auto say = [&](std::int64_t id, room::OperationKind kind, const JsonValue& content, const char* draft) {
    return room.submit(1, {.run = "r", .id = id, .kind = kind, .content = content, .draft = draft}, {0, 0});
  };
  const Touch place{ScenePart::node, "library", "types/smart_volume/demand"};
  EXPECT_EQ(room.last_writer(place), "");
  (void)say(1, room::OperationKind::command, set("4000"), "");
  EXPECT_EQ(room.last_writer(place), room::RoomState::author_of_seat(1));
  (void)say(2, room::OperationKind::draft_begin, JsonValue(R"({"draft": "d", "title": "Larger"})"), "");
  (void)say(3, room::OperationKind::command, set("5200"), "d");
  const View drafts = make_view("drafts", {world.state(), room, "", ""}, 1);
  ASSERT_TRUE(drafts.contains("d"));
  const std::string words = (*parse_json(drafts.at("d")))["steps"][0];
  EXPECT_TRUE(words.ends_with(": 4000 to 5200 m³")) << words;
}

TEST(Views, AVisitorsFormKnowsItsRange) {
  World world = World::from_file("scenes/start/quarter.json");
  room::Room room(world.session().ledger(), {});
  (void)room.admit({.role = Role::facilitator}, {0, 0});
  const JsonValue phase(
      R"({"event": "set_phase", "arguments": {"name": "Visitors", "activities": [], "forms": ["smart_volume"]}})");
  (void)room.submit(1, {.run = "r", .id = 1, .kind = room::OperationKind::event, .content = phase}, {0, 0});
  const View view = make_view("room", {world.state(), room, "", ""}, 1);
  const Json demand = (*parse_json(view.at("forms")))["smart_volume"]["demand"];
  EXPECT_EQ(demand["minimum"], 0);
  EXPECT_EQ(demand["maximum"], 20000);
}

TEST(Views, AVoteKnowsWhetherItWasEverOpen) {
  World world = World::from_text(
      R"({"format": "behaviourlinks", "version": 1, "nodes": [{"id": "poll", "types": {"vote": {}}}, {"id": "other", "types": {"vote": {}}}]})");
  world.tick(1);
  room::Room room(world.session().ledger(), {});
  ASSERT_TRUE(std::holds_alternative<room::Admission>(room.admit({.role = Role::facilitator}, {0, 0})));
  const auto opened = [&](const char* vote) {
    return (*parse_json(make_view("votes", {world.state(), room, "", ""}, 1).at(vote)))["opened"].get<bool>();
  };
  EXPECT_FALSE(opened("poll"));
  std::int64_t id = 0;
  for (const char* event : {"open_vote", "close_vote"}) {
    const JsonValue said(std::string(R"({"event": ")") + event + R"(", "arguments": {"vote": "poll"}})");
    (void)room.submit(1, {.run = "r", .id = ++id, .kind = room::OperationKind::event, .content = said}, {0, 0});
    EXPECT_TRUE(opened("poll")) << event;
    EXPECT_FALSE(opened("other")) << event;
  }
}

TEST(Views, WhoWaitsAtTheDoorIsMarked) {
  World world = World::from_file("scenes/start/quarter.json");
  room::Room room(world.session().ledger(), {});
  ASSERT_TRUE(std::holds_alternative<room::Admission>(room.admit({.role = Role::facilitator}, {0, 0})));
  const JsonValue door(R"({"event": "set_door", "arguments": {"door": "asks"}})");
  (void)room.submit(1, {.run = "r", .id = 1, .kind = room::OperationKind::event, .content = door}, {0, 0});
  ASSERT_TRUE(std::holds_alternative<room::Admission>(room.admit({.is_by_code = true}, {0, 0})));
  const View view = make_view("room", {world.state(), room, "", ""}, 1);
  const Json seats = *parse_json(view.at("seats"));
  EXPECT_FALSE(seats["1"].contains("waits"));
  EXPECT_EQ(seats["2"]["waits"], true);
}

TEST(Views, AnUnknownViewIsEmpty) {
  EXPECT_FALSE(is_view("secrets"));
  EXPECT_TRUE(is_view("plan"));
  EXPECT_TRUE(is_of_seat("card"));
}

}  // namespace
}  // namespace bl::wire
