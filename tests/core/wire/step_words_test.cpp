// Steps in parts: names instead of ids, and both values.
#include "core/wire/step_words.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/define/codec.h"
#include "core/define/json_text.h"
#include "tests/support/random_commands.h"
#include "tests/support/world.h"

namespace bl::wire {
namespace {

constexpr const char* kStreet = R"({"format": "behaviourlinks", "version": 1, "nodes": [
  {"id": "item_1", "name": "Library", "position": [0, 0, 0], "types": {"smart_volume": {"demand": 4000}}},
  {"id": "item_2", "name": "Hotel", "position": [50, 0, 0], "types": {"smart_volume": {"demand": 900}}},
  {"id": "item_3", "position": [90, 0, 0], "tags": ["work"], "types": {"smart_volume": {}}},
  {"id": "card", "types": {"stakeholder_group": {"controls": [
    {"node": "item_1", "port": "smart_volume.demand", "label": "Size of the library", "minimum": 0, "maximum": 9000}]}}}],
  "links": [{"id": "near_item_item_2", "kind": "keep_distance", "from": "item_1", "to": "item_2", "strength": 0.5},
            {"id": "near_all", "kind": "keep_distance", "from": {"tag": "work"}, "to": "item_3"}]})";

class StepWords : public ::testing::Test {
 protected:
  void SetUp() override {
    world_.tick(1);
    (void)room_.admit({.role = Role::facilitator, .areas = {}, .card = "card"}, {0, 0});
    (void)say(room::OperationKind::draft_begin, R"({"draft": "d", "title": "Larger"})", "");
  }
  room::Answer say(room::OperationKind kind, const std::string& content, const char* draft) {
    return room_.submit(1, {.run = "r", .id = ++id_, .kind = kind, .content = JsonValue(content), .draft = draft}, {0, 0});
  }
  // The last step of the draft, once it is in it.
  Json said(const Command& command) {
    const room::Answer answer =
        say(room::OperationKind::command, write_json_line(command_to_json(full_registry(), command)), "d");
    const auto* refusal = std::get_if<room::Refusal>(&answer);
    EXPECT_EQ(refusal, nullptr) << (refusal == nullptr ? "" : refusal->text);
    return draft()["said"].back();
  }
  Json draft() { return *parse_json(make_view("drafts", {world_.state(), room_, "", ""}, 1).at("d")); }

  World world_ = World::from_text(kStreet);
  room::Room room_{world_.session().ledger(), {}};
  std::int64_t id_ = 0;
};

TEST_F(StepWords, ValuesOfNodesAreNamedAsTheCardDoes) {
  EXPECT_EQ(said(command<SetPort>({"item_1", {"smart_volume.demand"}, JsonValue::of(5200.0)})),
            (Json{{"id", "set_port"},
                  {"of", "Library"},
                  {"what", {{"port", "demand"}, {"label", "Size of the library"}}},
                  {"from", 4000},
                  {"to", 5200},
                  {"unit", "m3"}}));
  EXPECT_EQ(said(command<SetPort>({"item_2", {"smart_volume.demand"}, JsonValue::of(950.0)}))["what"],
            (Json{{"port", "demand"}}));
  const Json moved = said(command<SetPort>({"item_2", {"node.position"}, JsonValue("[10, 20, 0]")}));
  EXPECT_EQ(moved["from"], Json::array({50, 0, 0}));
  EXPECT_EQ(moved["to"], Json::array({10, 20, 0}));
}

TEST_F(StepWords, LinksAreNamedByTheirKindAndEnds) {
  const std::string kind = full_registry().link("keep_distance")->label;
  const Json stronger = said(command<SetLinkStrength>({"near_item_item_2", 0.8}));
  EXPECT_EQ(stronger["of"], (Json{{"kind", kind}, {"from", "Library"}, {"to", "Hotel"}}));
  EXPECT_EQ(stronger["from"], 0.5);
  EXPECT_EQ(stronger["to"], 0.8);
  EXPECT_EQ(draft()["steps"].back(), "Set strength · " + kind + ", Library – Hotel: 0.500 to 0.800")
      << "the words that there were before have the names as well";
  EXPECT_EQ(said(command<MuteLink>({"near_all", true}))["of"], (Json{{"kind", kind}, {"from", "#work"}, {"to", "item_3"}}));
  EXPECT_EQ(said(command<MuteLink>({"near_all", false}))["id"], "not_mute_link");
  const Json added = said(command<AddLink>({"l", {R"({"kind": "keep_distance", "from": "item_2", "to": "item_1"})"}}));
  EXPECT_EQ(added["of"], (Json{{"kind", kind}, {"from", "Hotel"}, {"to", "Library"}}));
}

TEST_F(StepWords, ABatchIsNamedByWhatItIsAbout) {
  const auto add = [](const char* id) { return command<AddNode>({id, {R"({"name": "Kiosk"})"}}); };
  const Command rename = command<RenameNode>({"item_3", "Mill"}), mute = command<MuteLink>({"near_all", true});
  EXPECT_EQ(said(command<Batch>({CommandList({rename, mute})})),
            (Json{{"id", "rename_node"}, {"of", "item_3"}, {"to", "Mill"}, {"n", 1}}));
  EXPECT_EQ(said(command<Batch>({CommandList({mute, add("k1")})})), (Json{{"id", "add_node"}, {"of", "Kiosk"}}));
  EXPECT_EQ(said(command<Batch>({CommandList({add("k2"), add("k3")})})), (Json{{"id", "add_nodes"}, {"n", 2}}));
}

// Whatever somebody does: a step has an id, and no id of a link stands where people read a name.
TEST(StepWordsLaw, EveryStepHasParts) {
  World world = World::from_file("scenes/start/quarter.json");
  world.tick(1);
  room::Room room(world.session().ledger(), {});
  ASSERT_TRUE(std::holds_alternative<room::Admission>(room.admit({.role = Role::facilitator}, {0, 0})));
  const JsonValue begin(R"({"draft": "d", "title": "All"})");
  (void)room.submit(1, {.run = "r", .id = 1, .kind = room::OperationKind::draft_begin, .content = begin}, {0, 0});
  Random random(4);
  std::int64_t id = 1;
  for (int k = 0; k < 200; ++k) {
    const std::string content = write_json_line(command_to_json(full_registry(), random_command(room.scene_of("d"), random, k)));
    (void)room.submit(
        1, {.run = "r", .id = ++id, .kind = room::OperationKind::command, .content = JsonValue(content), .draft = "d"}, {0, 0});
  }
  const Json draft = *parse_json(make_view("drafts", {world.state(), room, "", ""}, 1).at("d"));
  ASSERT_GT(draft["said"].size(), 50u);
  ASSERT_EQ(draft["said"].size(), draft["steps"].size());
  for (const Json& step : draft["said"]) {
    EXPECT_FALSE(step["id"].get<std::string>().empty());
    if (!step.contains("of")) continue;
    const bool is_link = step["of"].is_string() && room.scene().links.contains(step["of"].get<std::string>()) &&
                         !room.scene().nodes.contains(step["of"].get<std::string>());
    EXPECT_FALSE(is_link) << step;
  }
}

}  // namespace
}  // namespace bl::wire
