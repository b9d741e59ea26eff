// A scene at rest comes to a standstill: moves die away and the last little of values is not followed, until somebody wants more.
#include <gtest/gtest.h>

#include "core/define/link_builder.h"
#include "core/define/link_remark.h"
#include "core/define/typification_builder.h"
#include "core/graph/simulation.h"
#include "tests/support/world.h"

namespace bl {
namespace {

struct Scale {
  struct In {
    double reading = 100, push = 0;
  };
  struct Out {};
  static void declare(TypificationBuilder<Scale>& t) {
    t.id("scale").label("Scale").doc("Something to be read and set.");
    t.in(&In::reading, "reading").combine(CombineRule::blend).doc("What links agree on.");
    t.in(&In::push, "push").doc("What the creeping link pushes by.");
  }
};

// Pushes by what its source says, and never ends; so does the value that it wants.
struct Creep {
  struct In {
    std::string says;
    double after = 1e9;
  };
  struct Ends {
    double push = 0, reading = 0;
  };
  struct Out {
    Vector3 move;
    std::optional<double> reading;
  };
  static void declare(LinkBuilder<Creep>& l) {
    l.reads_time().id("creep").label("Creep").doc("Creeps.");
    l.param(&In::says, "says").doc("What it remarks: `short`, `work`, `unmet` or nothing.");
    l.param(&In::after, "after").doc("The tick from which on it pushes ten times as hard.");
    l.reads(&Ends::push, End::from, "scale.push").reads(&Ends::reading, End::to, "scale.reading");
    l.proposes(&Out::move, End::to, "node.position", Unit::metre).proposes(&Out::reading, End::to, "scale.reading");
  }
  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick& tick) {
    const double push = ends.push * (static_cast<double>(tick.index) >= in.after ? 10 : 1);
    if (in.says == "short") remark(tick, LinkRemark::short_of, {ErrorCode::missing, "says", "goes without"});
    if (in.says == "work") remark(tick, LinkRemark::at_work, {ErrorCode::infeasible, "says", "is on its way"});
    if (in.says == "unmet") remark(tick, LinkRemark::unmet, {ErrorCode::infeasible, "says", "cannot be met"});
    return Out{{push, 0, 0}, ends.reading * (1 + 0.01 * push)};
  }
};

const Registry& creepers() {
  static const Registry kRegistry = [] {
    Registry registry;
    register_base_node(registry);
    registry.add(TypificationBuilder<Scale>::build());
    registry.add(LinkBuilder<Creep>::build());
    return registry;
  }();
  return kRegistry;
}

// Settings as every scene has them: 0.02 m and 0.1 % a tick for 5 ticks are calm.
class RestTest : public testing::Test {
 protected:
  RestTest() {
    scene_.nodes["a"].types = {{"node", {}}, {"scale", {{"push", 0.01}}}};
    scene_.nodes["b"].types = {{"node", {}}, {"scale", {}}};
    scene_.links["l"] = LinkRecord{"creep", {{"a"}, "", ""}, {{"b"}, "", ""}, true, false, 1, {}, ""};
    simulation_.set_scene(scene_);
  }
  void steps(int count) {
    for (int i = 0; i < count; ++i) simulation_.step();
  }
  double x() { return std::get<Vector3>(value_in(*simulation_.state(), "b", "node.position")).x; }
  double reading() { return as_number(value_in(*simulation_.state(), "b", "scale.reading")); }
  bool is_settled() { return simulation_.state()->is_settled(); }
  const LinkState& link() { return simulation_.state()->links[0]; }

  Scene scene_;
  Simulation simulation_{creepers(), 1};
};

TEST_F(RestTest, WhatIsCalmComesToAStandstill) {
  scene_.nodes["a"].types["scale"]["push"] = 0.004;
  simulation_.set_scene(scene_);
  steps(5);
  ASSERT_TRUE(is_settled());
  EXPECT_NEAR(x(), 0.02, 1e-12);
  const double reads = reading();
  double last = 0.02;
  for (int i = 0; i < 1100; ++i) {
    steps(1);
    ASSERT_TRUE(is_settled());
    ASSERT_EQ(reading(), reads) << "0.004 % a tick is less than half of what counts as calm";
    ASSERT_LE(simulation_.state()->largest_move, last);
    last = simulation_.state()->largest_move;
  }
  EXPECT_EQ(last, 0) << "a push that never ends moves nobody any more";
  EXPECT_LT(x(), 2) << "all that is left of it is the sum of 0.02 m times 0.99, times 0.99, ...";
  // The push is still there to be seen.
  EXPECT_NEAR(std::get<Vector3>(link().voices.front().value).x, 0.004, 1e-12);
}

TEST_F(RestTest, MovesBelowTheLeastAreNotMadeAndStayVisible) {
  scene_.nodes["a"].types["scale"]["push"] = 0.004;
  scene_.settings["least_move"] = 0.005;
  simulation_.set_scene(scene_);
  steps(3);
  EXPECT_EQ(x(), 0);
  EXPECT_EQ(simulation_.state()->largest_move, 0);
  EXPECT_NEAR(
      simulation_.state()->nodes[1].types[0].tension[simulation_.state()->plan->find(1, *parse_port_path("node.position"))->port],
      0.004, 1e-12);
  scene_.settings["least_move"] = 0.004;
  simulation_.set_scene(scene_);
  steps(1);
  EXPECT_NEAR(x(), 0.004, 1e-12) << "as long as the least move is a move";
}

TEST_F(RestTest, MoreThanCalmWakesIt) {
  scene_.links["l"].parameters["after"] = 20.0;
  simulation_.set_scene(scene_);
  steps(20);
  const double there = x();
  steps(3);
  EXPECT_FALSE(is_settled());
  EXPECT_NEAR(x(), there + 0.3, 1e-12);
}

TEST_F(RestTest, AnEditWakesItAndANameDoesNot) {
  steps(10);
  double there = x();
  scene_.nodes["b"].name = "Another name";
  scene_.settings["title"] = std::string("Another title");
  simulation_.set_scene(scene_);
  EXPECT_TRUE(is_settled());
  const std::int64_t calm = simulation_.state()->calm;
  steps(3);
  EXPECT_EQ(simulation_.state()->calm, calm + 3);
  EXPECT_LE(x(), there + 3 * 0.01);
  there = x();
  scene_.nodes["a"].types["scale"]["push"] = 0.005;  // less than calm, but somebody wants it
  simulation_.set_scene(scene_);
  EXPECT_FALSE(is_settled());
  steps(3);
  EXPECT_NEAR(x(), there + 0.015, 1e-12);
}

TEST_F(RestTest, RestIsPartOfTheState) {
  steps(10);
  const SavedState saved = save(*simulation_.state());
  Simulation again(creepers(), 1);
  again.set_scene(scene_);
  ASSERT_TRUE(again.restore_state(saved).ok());
  again.step();
  steps(1);
  EXPECT_EQ(again.state()->hash, simulation_.state()->hash);
  EXPECT_TRUE(again.state()->is_settled());
}

// Whatever a link remarks, its proposals are those of this tick; only what it calls unmet or unfinished keeps a scene from
// settling.
TEST_F(RestTest, RemarksLeaveProposalsInForce) {
  const std::map<std::string, bool> settles{{"short", true}, {"work", false}, {"unmet", false}};
  for (const auto& [word, is_fine] : settles) {
    scene_.links["l"].parameters["says"] = word;
    Simulation fresh(creepers(), 1);
    fresh.set_scene(scene_);
    for (int i = 0; i < 8; ++i) fresh.step();
    const LinkState& state = fresh.state()->links[0];
    EXPECT_EQ(fresh.state()->is_settled(), is_fine) << word;
    EXPECT_EQ(state.voices.size(), 2u) << word;
    EXPECT_FALSE(state.has_failed()) << word;
    EXPECT_EQ(state.error.has_value(), word != "work") << word;
    EXPECT_EQ(has_failure(*fresh.state()), word == "unmet") << word;
    EXPECT_EQ(first_work(*fresh.state()).has_value(), word == "work") << word;
    EXPECT_EQ(word == "unmet" ? state.error->text() : "", word == "unmet" ? "links/l/says: cannot be met" : "") << word;
    EXPECT_TRUE(save(*fresh.state()).link_errors.empty()) << word << ": a remark is made anew in every tick";
    scene_.links["l"].is_muted = true;
    fresh.set_scene(scene_);
    for (int i = 0; i < 6; ++i) fresh.step();
    EXPECT_TRUE(fresh.state()->is_settled()) << word << ": who is not heard hinders nobody";
    scene_.links["l"].is_muted = false;
  }
}

// A rule that is at work while nothing changes any more is a problem with a name; it wakes what rests.
TEST_F(RestTest, WhoIsAtWorkInVainIsAProblem) {
  scene_.links["l"].parameters["says"] = std::string("work");
  scene_.nodes["a"].types["scale"]["push"] = 0.0;
  Simulation fresh(creepers(), 1);
  fresh.set_scene(scene_);
  for (int i = 0; i < 8; ++i) fresh.step();
  const State& state = *fresh.state();
  EXPECT_FALSE(state.is_settled());
  EXPECT_FALSE(first_work(state));
  ASSERT_TRUE(has_failure(state));
  EXPECT_EQ(state.links[0].error->text().rfind("links/l/says: cannot be met: is on its way, and nothing changes any more; ", 0),
            0u);
  EXPECT_EQ(state.links[0].remark, LinkRemark::unmet);
}

}  // namespace
}  // namespace bl
