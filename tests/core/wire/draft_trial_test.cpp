// What pages are shown of drafts that were tried: figures of both sides, the plan for those who may see it, and conflicts in
// words.
#include "core/wire/draft_trial.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/define/codec.h"
#include "core/wire/views.h"
#include "tests/core/room/room_world.h"

namespace bl::wire {
namespace {

constexpr const char* kGoals = R"({"format": "behaviourlinks", "version": 1, "nodes": [
  {"id": "north", "name": "North wing", "position": [0, 50, 0], "types": {"smart_volume": {"demand": 900}}},
  {"id": "area", "name": "Floor area", "types": {"indicator": {"value": 10, "unit": "m2", "target": 20}}},
  {"id": "cost", "types": {"indicator": {"value": 5, "unit": "EUR", "target": 9, "direction": "at_most"}}}], "links": []})";

TEST(DraftTrials, FiguresStandSideBySideAlsoWhereOneSideHasNone) {
  World before = World::from_text(kGoals), after = World::from_text(kGoals);
  ASSERT_EQ(after.submit(command<SetPort>({"area", {"indicator.value"}, JsonValue::of(16)})), "");
  ASSERT_EQ(after.submit(command<RemoveNode>({"cost"})), "");
  ASSERT_EQ(after.submit(command<AddNode>({"walk", {R"({"types": {"indicator": {"value": 3}}})"}})), "");
  before.tick();
  after.tick();
  const TrialPicture picture = picture_of(before.state(), after.state());
  const Json& figures = **picture.figures.read();
  ASSERT_EQ(figures.size(), 3u);
  EXPECT_EQ(figures[0]["id"], "area");
  EXPECT_EQ(figures[0]["name"], "Floor area");
  EXPECT_EQ(figures[0]["before"]["value"], 10);
  EXPECT_EQ(figures[0]["after"]["value"], 16);
  EXPECT_EQ(figures[0]["difference"], 6);
  EXPECT_EQ(figures[1]["id"], "cost");
  EXPECT_TRUE(figures[1]["after"].is_null() && figures[1]["difference"].is_null());
  EXPECT_EQ(figures[1]["before"]["status"], "met");
  EXPECT_TRUE(figures[2]["before"].is_null());
  EXPECT_TRUE(picture.plan.contains("box"));
}

TEST(DraftTrials, ConflictsAreToldInWordsWithBothValues) {
  room::RoomWorld world;
  const auto lead = world.seat(Role::facilitator), anna = world.seat(Role::stakeholder);
  (void)world.say(anna, room::OperationKind::draft_begin, R"({"draft": "d"})");
  (void)world.command(anna, room::set_demand("north", 300), "d");
  (void)world.command(lead, room::set_demand("north", 500));
  World state = World::from_text(room::kTable);
  const View drafts = make_view("drafts", {state.state(), world.room(), "", ""}, anna);
  const Json draft = *parse_json(drafts.at("d"));
  EXPECT_TRUE(draft["trial"].is_null());
  ASSERT_EQ(draft["conflicts"].size(), 1u);
  EXPECT_EQ(draft["conflicts"][0], (Json{{"place", "nodes/north/types/smart_volume/demand"},
                                         {"label", "north, demand"},
                                         {"said", {{"of", "north"}, {"what", {{"port", "demand"}}}}},
                                         {"by", "Heron"},
                                         {"live", 500},
                                         {"draft", 300}}));
}

TEST(DraftTrials, StepsAreForTheirAuthorWhileTheDraftIsOpen) {
  room::RoomWorld world;
  const auto lead = world.seat(Role::facilitator), anna = world.seat(Role::stakeholder);
  (void)world.say(anna, room::OperationKind::draft_begin, R"({"draft": "d"})");
  for (const double demand : {300, 400, 500}) (void)world.command(anna, room::set_demand("north", demand), "d");
  World state = World::from_text(room::kTable);
  const ViewSources sources{state.state(), world.room(), "", ""};
  const auto keys = [&](std::int64_t seat) {
    std::vector<std::string> found;
    for (const auto& [key, content] : make_view("draft_steps", sources, seat)) found.push_back(key);
    return found;
  };
  EXPECT_EQ(keys(anna), (std::vector<std::string>{"/run 2", "d/0", "d/1", "d/2"}));
  EXPECT_TRUE(keys(lead).empty()) << "it is private";
  const auto last = command_from_json(full_registry(), *parse_json(make_view("draft_steps", sources, anna).at("d/2")), "");
  ASSERT_TRUE(last.ok());
  EXPECT_EQ(last->id, "set_port");
  (void)world.say(anna, room::OperationKind::draft_undo, R"({"draft": "d"})");
  (void)world.command(anna, room::set_demand("north", 600), "d");
  EXPECT_EQ(keys(anna), (std::vector<std::string>{"/run 2", "d/0", "d/1", "d/3"})) << "numbers never change";
  EXPECT_EQ(make_view("draft_steps", sources, anna).at("/run 2"), "6") << "of a beginning, four steps and one taken back";
  (void)world.event(anna, "propose", R"({"draft": "d"})");
  EXPECT_TRUE(keys(anna).empty()) << "nothing can be changed in it";
}

TEST(DraftTrials, APlanIsForThoseWhoLookAtItAndMaySeeIt) {
  room::RoomWorld world;
  const auto lead = world.seat(Role::facilitator), anna = world.seat(Role::stakeholder), ben = world.seat(Role::participant);
  (void)world.say(anna, room::OperationKind::draft_begin, R"({"draft": "d"})");
  (void)world.command(anna, room::set_demand("north", 300), "d");
  World state = World::from_text(room::kTable);
  state.tick();
  DraftTrials all;
  all.trials["d"] = {
      .state = TrialState::done, .ticks = 1, .picture = std::make_shared<TrialPicture>(picture_of(state.state(), state.state()))};
  for (const auto seat : {lead, anna, ben}) all.looked_at[seat] = {"d", "nothing"};
  const ViewSources sources{state.state(), world.room(), "", "", &all};
  EXPECT_FALSE(make_view("draft_plans", sources, anna).empty());
  EXPECT_TRUE(make_view("draft_plans", sources, lead).empty()) << "it is private";
  (void)world.event(anna, "propose", R"({"draft": "d"})");
  EXPECT_TRUE(make_view("draft_plans", sources, ben).contains("d/box"));
  all.looked_at[ben] = {};
  EXPECT_TRUE(make_view("draft_plans", sources, ben).empty()) << "nobody looks";
  const Json proposal = *parse_json(make_view("proposals", sources, ben).at("d"));
  EXPECT_EQ(proposal["trial"]["state"], "done");
  EXPECT_EQ(proposal["trial"]["ticks"], 1);
}

}  // namespace
}  // namespace bl::wire
