// What only those who lead see: areas, what they can be made of, and where a rewind takes nothing back.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/define/json_text.h"
#include "core/wire/views.h"
#include "tests/support/world.h"

namespace bl::wire {
namespace {

TEST(LeadView, IsForThoseWhoLead) {
  World world = World::from_file("scenes/start/quarter.json");
  room::Room room(world.session().ledger(), {});
  for (std::size_t role = 0; role < kRoleCount; ++role)
    ASSERT_TRUE(
        std::holds_alternative<room::Admission>(room.admit({.role = static_cast<Role>(role), .areas = {}, .card = {}}, {0, 0})));
  ASSERT_TRUE(is_of_seat("lead"));
  for (std::int64_t seat = 0; seat <= static_cast<std::int64_t>(kRoleCount) + 1; ++seat) {
    const room::Seat* one = room.state().seat(seat);
    EXPECT_EQ(make_view("lead", {world.state(), room, "", ""}, seat).empty(), one == nullptr || one->role != Role::facilitator)
        << "seat " << seat;
  }
}

TEST(LeadView, HasAreasAndWhatTheyCanBeMadeOf) {
  World world = World::from_file("scenes/start/quarter.json");
  room::Room room(world.session().ledger(), {});
  ASSERT_TRUE(std::holds_alternative<room::Admission>(room.admit({.role = Role::facilitator}, {0, 0})));
  std::int64_t id = 0;
  const auto say = [&](room::OperationKind kind, const char* content) {
    return room.submit(1, {.run = "r", .id = ++id, .kind = kind, .content = JsonValue(content)}, {0, 0});
  };
  const auto key = [&](const char* name) { return *parse_json(make_view("lead", {world.state(), room, "", ""}, 1).at(name)); };
  std::map<std::string, std::int64_t> tags, roles;
  for (const auto& [node, record] : world.session().scene().nodes) {
    for (const auto& [type, values] : record.types) ++roles[type];
    const PortValues& base = record.types.at(std::string(kBaseNode));
    if (!base.contains("tags")) continue;
    for (const std::string& tag : *std::get<Shared<std::vector<std::string>>>(base.at("tags"))) ++tags[tag];
  }
  ASSERT_GT(tags.size(), 2u);
  EXPECT_EQ(key("tags"), Json(tags));
  EXPECT_EQ(key("roles")["smart_volume"]["count"], roles.at("smart_volume"));
  EXPECT_EQ(key("roles")["smart_volume"]["label"], full_registry().typification("smart_volume")->label);
  EXPECT_FALSE(key("roles").contains(std::string(kBaseNode))) << "everything is a node";
  const auto define = [&](const char* arguments) {
    const std::string event = std::string(R"({"event": "define_area", "arguments": )") + arguments + "}";
    EXPECT_TRUE(std::holds_alternative<room::Acknowledgement>(say(room::OperationKind::event, event.c_str()))) << arguments;
  };
  // In these words the page says it.
  define(R"({"area": "living", "nodes": {"tag": "living"}})");
  define(R"({"area": "volumes", "nodes": {"typification": "smart_volume"}})");
  define(R"({"area": "two", "nodes": ["library", "hotel"]})");
  define(R"({"area": "north", "outline": [[0, 0, 0], [9, 0, 0], [9, 9, 0]]})");
  EXPECT_EQ(key("areas")["living"], (Json{{"nodes", {{"tag", "living"}}}, {"corners", 0}}));
  EXPECT_EQ(key("areas")["volumes"]["nodes"]["typification"], "smart_volume");
  EXPECT_EQ(key("areas")["two"]["nodes"], Json::array({"hotel", "library"}));
  EXPECT_EQ(key("areas")["north"]["corners"], 3);
  EXPECT_EQ(key("areas")["north"]["outline"], *parse_json("[[0.0, 0.0], [9.0, 0.0], [9.0, 9.0]]"));
}

TEST(LeadView, TellsWhereARewindTakesNothingBack) {
  World world = World::from_file("scenes/start/quarter.json");
  room::Room room(world.session().ledger(), {});
  ASSERT_TRUE(std::holds_alternative<room::Admission>(room.admit({.role = Role::facilitator}, {0, 0})));
  const auto spans = [&] { return *parse_json(make_view("lead", {world.state(), room, "", ""}, 1).at("unchanged")); };
  EXPECT_EQ(spans(), (Json{{0, 1}})) << "nothing but that somebody has come";
  const JsonValue larger(
      R"({"command": "set_port", "arguments": {"node": "library", "port": "smart_volume.demand", "value": 4000}})");
  (void)room.submit(1, {.run = "r", .id = 1, .kind = room::OperationKind::command, .content = larger}, {0, 0});
  EXPECT_EQ(spans(), (Json{{2, 2}}));
  const JsonValue mark(R"({"event": "mark", "arguments": {"text": "Enough."}})");
  (void)room.submit(1, {.run = "r", .id = 2, .kind = room::OperationKind::event, .content = mark}, {0, 0});
  EXPECT_EQ(spans(), (Json{{2, 3}}));
  (void)room.submit(1, {.run = "r", .id = 3, .kind = room::OperationKind::rewind, .content = JsonValue(R"({"to": 1})")}, {0, 0});
  EXPECT_EQ(spans(), (Json{{0, 1}, {4, 4}}));
}

}  // namespace
}  // namespace bl::wire
