// Undo and redo in a draft: the law against a model of two stacks, then examples.
#include "tests/core/room/room_world.h"

namespace bl::room {
namespace {

constexpr const char* kBegin = R"({"draft": "d"})";

struct DraftWorld : RoomWorld {
  DraftWorld() : lead(seat(Role::facilitator)), anna(seat(Role::stakeholder)) {
    EXPECT_EQ(sentence(say(anna, OperationKind::draft_begin, kBegin)), "");
  }
  Answer undo() { return say(anna, OperationKind::draft_undo, kBegin); }
  Answer redo() { return say(anna, OperationKind::draft_redo, kBegin); }
  std::vector<Command> steps() {
    std::vector<Command> list;
    for (const Command& step : room().drafts().at("d").steps())
      if (!step.id.empty()) list.push_back(step);
    return list;
  }
  double drafted(const std::string& node) {
    return std::get<double>(room().scene_of("d").nodes.at(node).types.at("smart_volume").at("demand"));
  }
  const std::int64_t lead, anna;
};

TEST(DraftRedo, LawOfTwoStacks) {
  DraftWorld world;
  Random random(3);
  std::vector<double> done, undone;
  int redone = 0;
  for (int k = 0; k < 600; ++k) {
    const double chance = random.uniform();
    if (chance < 0.4) {
      done.push_back(100 + k);
      undone.clear();
      ASSERT_EQ(sentence(world.command(world.anna, set_demand("north", done.back()), "d")), "");
    } else if (chance < 0.7) {
      ASSERT_EQ(sentence(world.undo()).empty(), !done.empty());
      if (done.empty()) continue;
      undone.push_back(done.back());
      done.pop_back();
    } else if (chance < 0.97) {
      ASSERT_EQ(sentence(world.redo()).empty(), !undone.empty());
      if (undone.empty()) continue;
      done.push_back(undone.back());
      undone.pop_back();
      ++redone;
    } else {
      ASSERT_EQ(sentence(world.command(world.lead, set_demand("south", 100 + k))), "") << "the head moves on";
    }
    std::vector<Command> expected;
    for (const double value : done) expected.push_back(set_demand("north", value));
    const std::vector<Command> steps = world.steps();
    ASSERT_EQ(steps.size(), expected.size()) << k;
    for (std::size_t i = 0; i < steps.size(); ++i) ASSERT_EQ(steps[i].arguments, expected[i].arguments) << k;
    EXPECT_EQ(world.drafted("north"), done.empty() ? 900 : done.back());
  }
  EXPECT_GT(redone, 50);
  // What is stored is the same: another program that goes on from it has these steps.
  const auto before = world.steps().size();
  world.crash();
  EXPECT_EQ(world.steps().size(), before);
  EXPECT_EQ(world.drafted("north"), done.empty() ? 900 : done.back());
  EXPECT_EQ(sentence(world.redo()), "gone draft: no step of the draft was taken back since the last one was added");
}

TEST(DraftRedo, WhatFitsNoMoreOrIsNotAllowedAnyMoreStaysTakenBack) {
  DraftWorld world;
  ASSERT_EQ(sentence(world.command(world.anna, command<RemoveLink>({"inner"}), "d")), "");
  ASSERT_EQ(sentence(world.undo()), "");
  ASSERT_EQ(sentence(world.event(world.lead, "set_phase", R"({"activities": ["comment"]})")), "");
  EXPECT_EQ(why(world.redo()), "phase");
  ASSERT_EQ(sentence(world.event(world.lead, "set_phase", R"({"activities": ["draft"]})")), "");
  ASSERT_EQ(sentence(world.command(world.lead, command<RemoveLink>({"inner"}))), "");
  EXPECT_EQ(why(world.redo()), "gone");
  EXPECT_TRUE(world.steps().empty());
  ASSERT_EQ(sentence(world.say(world.lead, OperationKind::undo, "{}")), "");
  EXPECT_EQ(sentence(world.redo()), "");
  EXPECT_EQ(world.steps().size(), 1u);
  EXPECT_FALSE(world.room().scene_of("d").links.contains("inner"));
}

}  // namespace
}  // namespace bl::room
