// Drafts in line: two are tried at once, and the others say how many come first.
#include "core/serve/trial_runner.h"

#include <chrono>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/wire/views.h"
#include "tests/core/room/room_world.h"

namespace bl::serve {
namespace {

using wire::TrialState;

class TrialRunners : public ::testing::Test {
 protected:
  void SetUp() override {
    lead_ = world_.seat(Role::facilitator);
    anna_ = world_.seat(Role::stakeholder);
    for (int k = 0; k < 4; ++k) {
      const std::string id = "d" + std::to_string(k);
      (void)world_.say(anna_, room::OperationKind::draft_begin, R"({"draft": ")" + id + "\"}");
      (void)world_.command(anna_, room::set_demand("north", 300 + 50 * k), id);
    }
    follow();
  }
  void follow() {
    state_ = World::from_text(room::kTable).session().state();
    runner_.follow(world_.room(), looked_at_, [this] { return state_; });
  }
  const wire::DraftTrial& trial(const std::string& id) { return runner_.shown().trials.at(id); }
  bool is_done(const std::string& id) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(2);
    while (std::chrono::steady_clock::now() < end) {
      follow();
      const auto found = runner_.shown().trials.find(id);
      if (found != runner_.shown().trials.end() && found->second.state == TrialState::done) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return false;
  }

  room::RoomWorld world_;
  std::int64_t lead_ = 0, anna_ = 0;
  std::shared_ptr<const State> state_;
  std::map<std::int64_t, std::set<std::string>> looked_at_;
  TrialRunner runner_;
};

TEST_F(TrialRunners, TwoAtOnceAndTheOthersWaitInLine) {
  EXPECT_TRUE(runner_.shown().trials.empty()) << "nobody looks at them";
  looked_at_[anna_] = {"d0", "d1", "d2", "d3"};
  follow();
  // The first ones may be done by now.
  std::int64_t running = 0;
  for (const char* id : {"d0", "d1"}) {
    EXPECT_TRUE(trial(id).state == TrialState::running || trial(id).state == TrialState::done) << id;
    running += trial(id).state == TrialState::running ? 1 : 0;
  }
  EXPECT_EQ(trial("d2").state, TrialState::waiting);
  EXPECT_EQ(trial("d3").state, TrialState::waiting);
  EXPECT_EQ(trial("d2").line, running);
  EXPECT_EQ(trial("d3").line, running + 1);
  for (const char* id : {"d0", "d1", "d2", "d3"}) {
    ASSERT_TRUE(is_done(id)) << id;
    EXPECT_GT(trial(id).ticks, 0);
    ASSERT_NE(trial(id).picture, nullptr);
  }
}

TEST_F(TrialRunners, OnlyItsOwnerHasADraftTriedAndTheFacilitatorAProposal) {
  const auto ben = world_.seat(Role::participant);
  looked_at_[ben] = looked_at_[lead_] = {"d0"};
  follow();
  EXPECT_TRUE(runner_.shown().trials.empty());
  (void)world_.event(anna_, "propose", R"({"draft": "d0"})");
  looked_at_[lead_] = {};
  follow();
  EXPECT_TRUE(runner_.shown().trials.empty()) << "others see what has come of it, and start nothing";
  looked_at_[lead_] = {"d0"};
  EXPECT_TRUE(is_done("d0"));
  const wire::View seen = wire::make_view("draft_plans", {*state_, world_.room(), "", "", &runner_.shown()}, ben);
  EXPECT_TRUE(seen.contains("d0/box"));
}

TEST_F(TrialRunners, WhatWasTriedGrowsOldAndIsTriedAgainForWhoLooks) {
  looked_at_[anna_] = {"d0"};
  ASSERT_TRUE(is_done("d0"));
  const std::int64_t seq = trial("d0").seq;
  looked_at_[anna_] = {};
  (void)world_.command(lead_, room::set_demand("south", 650));
  follow();
  EXPECT_EQ(trial("d0").state, TrialState::old);
  ASSERT_NE(trial("d0").picture, nullptr) << "still shown";
  looked_at_[anna_] = {"d0"};
  ASSERT_TRUE(is_done("d0"));
  EXPECT_GT(trial("d0").seq, seq);
  const auto picture = trial("d0").picture;
  (void)world_.command(anna_, room::set_demand("north_2", 350), "d0");
  ASSERT_TRUE(is_done("d0"));
  EXPECT_NE(trial("d0").picture, picture) << "it has another step";
  (void)world_.say(anna_, room::OperationKind::draft_drop, R"({"draft": "d0"})");
  follow();
  EXPECT_NE(trial("d0").state, TrialState::running);
}

TEST_F(TrialRunners, TheSameStateAndStepsGiveTheSameFigures) {
  looked_at_[anna_] = {"d0"};
  ASSERT_TRUE(is_done("d0"));
  const auto first = trial("d0").picture;
  const std::int64_t ticks = trial("d0").ticks;
  runner_.clear();
  ASSERT_TRUE(is_done("d0"));
  EXPECT_EQ(trial("d0").picture->figures, first->figures);
  EXPECT_EQ(trial("d0").picture->plan, first->plan);
  EXPECT_EQ(trial("d0").ticks, ticks);
}

}  // namespace
}  // namespace bl::serve
