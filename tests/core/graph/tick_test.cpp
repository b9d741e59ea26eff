// The tick by hand: combine rules, locks, tension, step limits, failing links, muting and settling on toy types.
#include <cmath>

#include <gtest/gtest.h>

#include "core/define/link_builder.h"
#include "core/define/typification_builder.h"
#include "core/graph/simulation.h"
#include "tests/support/world.h"

namespace bl {
namespace {

// A thing with one port for each rule.
struct Toy {
  struct In {
    double blended = 10, smallest = 100, largest = 0, total = 5;
    std::vector<std::string> friends;
  };
  struct Out {
    double doubled = 0;
  };
  static void declare(TypificationBuilder<Toy>& t) {
    t.id("toy").label("Toy").doc("A toy.");
    t.in(&In::blended, "blended").combine(CombineRule::blend).range(-1000, 1000).doc("Mean.");
    t.in(&In::smallest, "smallest").combine(CombineRule::min).doc("Minimum.");
    t.in(&In::largest, "largest").combine(CombineRule::max).step_limit(3).doc("Maximum, 3 a tick.");
    t.in(&In::friends, "friends").collect().doc("Names.");
    t.in(&In::total, "total").combine(CombineRule::total).range(-1000, 1000).doc("Total.");
    t.out(&Out::doubled, "doubled").doc("Twice the blended.");
  }
  static Result<Out> evaluate(const In& in, const Tick&) {
    if (in.blended > 900) return Error{ErrorCode::out_of_range, "blended", "too much for a toy"};
    return Out{2 * in.blended};
  }
};

// Wants a value on all three ports; fails when asked to.
struct Want {
  struct In {
    double value = 0;
    bool is_failing = false;
  };
  struct Ends {
    double source = 0;
  };
  struct Out {
    std::optional<double> blended, smallest, largest;
  };
  static void declare(LinkBuilder<Want>& l) {
    l.id("want").label("Want").doc("Wants a value.");
    l.param(&In::value, "value").doc("The value.");
    l.param(&In::is_failing, "fail").doc("Fail.");
    l.reads(&Ends::source, End::from, "toy.blended");
    l.proposes(&Out::blended, End::to, "toy.blended")
        .proposes(&Out::smallest, End::to, "toy.smallest")
        .proposes(&Out::largest, End::to, "toy.largest");
  }
  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick&) {
    if (in.is_failing || ends.source > 500) return Error{ErrorCode::conflict, "value", "does not want to"};
    return Out{in.value, in.value, in.value};
  }
};

// Adds itself and a name to the friends of others.
struct Befriend {
  struct In {
    std::string name;
  };
  struct Ends {
    std::string id;
  };
  struct Out {
    std::vector<std::string> friends;
  };
  static void declare(LinkBuilder<Befriend>& l) {
    l.id("befriend").label("Befriend").doc("Adds names.");
    l.param(&In::name, "name").doc("Another name.");
    l.reads(&Ends::id, End::from, "node.id").proposes(&Out::friends, End::to, "toy.friends");
  }
  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick&) {
    if (in.name == "fail") return Error{ErrorCode::conflict, "name", "does not want to"};
    return Out{{in.name, ends.id}};
  }
};

struct Push {
  struct In {
    Vector3 move;
  };
  struct Ends {
    Point3 to;
  };
  struct Out {
    Vector3 to;
  };
  static void declare(LinkBuilder<Push>& l) {
    l.id("push").label("Push").doc("Pushes.");
    l.param(&In::move, "move").doc("The move.");
    l.reads(&Ends::to, End::to, "node.position", Unit::metre).proposes(&Out::to, End::to, "node.position", Unit::metre);
  }
  static Result<Out> evaluate(const In& in, const Ends&, const Tick&) { return Out{in.move}; }
};

struct Pay {
  struct In {
    double amount = 0;
  };
  struct Ends {
    std::string id;
  };
  struct Out {
    double total = 0;
  };
  static void declare(LinkBuilder<Pay>& l) {
    l.id("pay").label("Pay").doc("Pays.");
    l.param(&In::amount, "amount").doc("The amount.");
    l.reads(&Ends::id, End::from, "node.id").proposes(&Out::total, End::to, "toy.total");
  }
  static Result<Out> evaluate(const In& in, const Ends&, const Tick&) { return Out{in.amount}; }
};

const Registry& toys() {
  static const Registry kRegistry = [] {
    Registry registry;
    register_base_node(registry);
    registry.add(TypificationBuilder<Toy>::build());
    registry.add(LinkBuilder<Want>::build());
    registry.add(LinkBuilder<Push>::build());
    registry.add(LinkBuilder<Befriend>::build());
    registry.add(LinkBuilder<Pay>::build());
    return registry;
  }();
  return kRegistry;
}

class TickTest : public testing::Test {
 protected:
  void node(const std::string& id, PortValues toy = {}) { scene_.nodes[id].types = {{"node", {}}, {"toy", std::move(toy)}}; }
  void link(const std::string& id, const std::string& kind, const std::string& from, const std::string& to, PortValues parameters,
            double strength = 1) {
    scene_.links[id] = LinkRecord{kind, {{from}, "", ""}, {{to}, "", ""}, true, false, strength, std::move(parameters), ""};
  }
  Simulation& start() {
    simulation_.set_scene(scene_);
    return simulation_;
  }
  double number(const char* id, const char* path) { return as_number(value_in(*simulation_.state(), id, path)); }
  double tension(const char* id, std::uint16_t type, std::uint16_t port) {
    return simulation_.state()->nodes[simulation_.state()->plan->node_index(id)].types[type].tension[port];
  }

  Scene scene_;
  Simulation simulation_{toys(), 1};
};

TEST_F(TickTest, BlendIsTheStrengthWeightedMeanWithTheSetValueAsOneVoice) {
  node("a");
  node("b", {{"blended", 20.0}});
  link("l1", "want", "a", "b", {{"value", 40.0}}, 0.5);
  link("l2", "want", "a", "b", {{"value", 60.0}}, 0.5);
  start().step();
  EXPECT_DOUBLE_EQ(number("b", "toy.blended"), (20 + 0.5 * 40 + 0.5 * 60) / 2);
  EXPECT_DOUBLE_EQ(number("b", "toy.doubled"), 70);
  EXPECT_DOUBLE_EQ(tension("b", 1, 0), 0.5 * 5 + 0.5 * 25 + 15);
}

// The lock lets go what the link has brought about, without another set value: what is computed follows in the same tick.
TEST_F(TickTest, ALockOfAMovedPortIsReadAtOnce) {
  node("a");
  node("b", {{"blended", 20.0}});
  link("l1", "want", "a", "b", {{"value", 40.0}});
  start().step();
  simulation_.step();
  EXPECT_DOUBLE_EQ(number("b", "toy.doubled"), 60);
  scene_.nodes["b"].locked.insert("toy.blended");
  simulation_.set_scene(scene_);
  simulation_.step();
  EXPECT_DOUBLE_EQ(number("b", "toy.blended"), 20);
  EXPECT_DOUBLE_EQ(number("b", "toy.doubled"), 40);
}

TEST_F(TickTest, ADefaultIsNoVoice) {
  node("a");
  node("b");
  link("l1", "want", "a", "b", {{"value", 40.0}}, 0.3);
  start().step();
  EXPECT_DOUBLE_EQ(number("b", "toy.blended"), 40);
  EXPECT_DOUBLE_EQ(tension("b", 1, 0), 0);
}

// All pairs and all links, each with its strength, beside what people have set; the default counts too. Anew in each tick.
TEST_F(TickTest, TotalAddsUpAllAmountsAnewInEachTick) {
  node("a");
  node("b");
  node("c", {{"total", 100.0}});
  link("l1", "pay", "a", "c", {{"amount", 7.0}});
  scene_.links["l1"].from.ids = {"a", "b"};
  link("l2", "pay", "a", "c", {{"amount", 30.0}}, 0.5);
  link("l3", "pay", "a", "b", {{"amount", -1.0}});
  start().step();
  simulation_.step();
  EXPECT_DOUBLE_EQ(number("c", "toy.total"), 100 + 2 * 7 + 0.5 * 30);
  EXPECT_DOUBLE_EQ(number("b", "toy.total"), 5 - 1);
  EXPECT_EQ(tension("c", 1, 4), 0) << "amounts that are added up do not contradict each other";
  scene_.links["l2"].parameters["amount"] = 2000.0;
  scene_.nodes["b"].locked.insert("toy.total");
  simulation_.set_scene(scene_);
  simulation_.step();
  EXPECT_DOUBLE_EQ(number("c", "toy.total"), 1000) << "within its range";
  EXPECT_DOUBLE_EQ(tension("c", 1, 4), 114);
  EXPECT_DOUBLE_EQ(number("b", "toy.total"), 5);
  EXPECT_DOUBLE_EQ(tension("b", 1, 4), 1) << "what the lock keeps out";
  for (const char* id : {"l1", "l2"}) scene_.links[id].parameters["amount"] = 1e308;
  scene_.links["l2"].strength = 1;
  simulation_.set_scene(scene_);
  simulation_.step();
  EXPECT_TRUE(std::isfinite(tension("c", 1, 4))) << "more than a number holds";
}

using Names = std::vector<std::string>;

TEST_F(TickTest, CollectUnitesWhatPeopleSetWithWhatLinksPropose) {
  node("a");
  node("b", {{"friends", Shared<Names>(Names{"zoe", "ann"})}});
  link("l1", "befriend", "a", "b", {{"name", std::string("max")}}, 0.3);
  link("l2", "befriend", "a", "b", {{"name", std::string("ann")}});
  link("l3", "befriend", "a", "b", {{"name", std::string("nobody")}}, 0);
  start().step();
  EXPECT_EQ(*std::get<Shared<Names>>(value_in(*simulation_.state(), "b", "toy.friends")), (Names{"a", "ann", "max", "zoe"}));
  EXPECT_EQ(*std::get<Shared<Names>>(value_in(*simulation_.state(), "a", "toy.friends")), Names{});
  EXPECT_EQ(simulation_.state()->largest_change, 1);  // the list is new: the scene is not at rest
  simulation_.step();
  EXPECT_EQ(simulation_.state()->largest_change, 0);
}

TEST_F(TickTest, CollectTakesAllPairsOfALinkAndALockKeepsThemOut) {
  node("a");
  node("b");
  node("c", {{"friends", Shared<Names>(Names{"ann"})}});
  link("l1", "befriend", "a", "c", {{"name", std::string("")}});
  scene_.links["l1"].from.ids = {"a", "b"};
  start().step();
  EXPECT_EQ(*std::get<Shared<Names>>(value_in(*simulation_.state(), "c", "toy.friends")), (Names{"a", "ann", "b"}));
  scene_.nodes["c"].locked.insert("toy.friends");
  simulation_.set_scene(scene_);
  simulation_.step();
  EXPECT_EQ(*std::get<Shared<Names>>(value_in(*simulation_.state(), "c", "toy.friends")), Names{"ann"});
  EXPECT_EQ(tension("c", 1, 3), 2);
}

TEST_F(TickTest, AFailingLinkStaysInTheCollection) {
  node("a");
  node("b");
  link("l1", "befriend", "a", "b", {{"name", std::string("max")}});
  start().step();
  scene_.links["l1"].parameters["name"] = std::string("fail");
  simulation_.set_scene(scene_);
  simulation_.step();
  EXPECT_TRUE(simulation_.state()->links[0].error.has_value());
  EXPECT_EQ(*std::get<Shared<Names>>(value_in(*simulation_.state(), "b", "toy.friends")), (Names{"a", "max"}));
}

TEST_F(TickTest, MinAndMaxTakeTheExtremesAndStepLimitsHold) {
  node("a");
  node("b");
  link("l1", "want", "a", "b", {{"value", 40.0}});
  link("l2", "want", "a", "b", {{"value", 60.0}});
  start().step();
  EXPECT_DOUBLE_EQ(number("b", "toy.smallest"), 40);
  EXPECT_DOUBLE_EQ(number("b", "toy.largest"), 3);
  simulation_.step();
  EXPECT_DOUBLE_EQ(number("b", "toy.largest"), 6);
}

TEST_F(TickTest, ALockedPortStaysAndShowsItsTension) {
  node("a");
  node("b", {{"blended", 20.0}});
  scene_.nodes["b"].locked = {"toy.blended", "node.position"};
  link("l1", "want", "a", "b", {{"value", 50.0}});
  link("p", "push", "a", "b", {{"move", Vector3{3, 4, 0}}});
  start().step();
  EXPECT_DOUBLE_EQ(number("b", "toy.blended"), 20);
  EXPECT_DOUBLE_EQ(tension("b", 1, 0), 30);
  EXPECT_EQ(std::get<Vector3>(value_in(*simulation_.state(), "b", "node.position")), Vector3());
  EXPECT_DOUBLE_EQ(tension("b", 0, 0), 5);
}

TEST_F(TickTest, MovesAddUpWithinTheStepLimit) {
  node("b");
  link("p1", "push", "b", "b", {{"move", Vector3{3, 0, 0}}});
  link("p2", "push", "b", "b", {{"move", Vector3{-1, 0, 0}}}, 0.5);
  start().step();
  EXPECT_EQ(std::get<Vector3>(value_in(*simulation_.state(), "b", "node.position")), (Vector3{2.5, 0, 0}));
  EXPECT_DOUBLE_EQ(tension("b", 0, 0), 3 + 0.5 - 2.5);
  scene_.links["p1"].parameters["move"] = Vector3{30, 0, 0};
  start().step();
  EXPECT_EQ(std::get<Vector3>(value_in(*simulation_.state(), "b", "node.position")), (Vector3{7.5, 0, 0}));
}

TEST_F(TickTest, AMutedLinkIsShownButDoesNotCount) {
  node("a");
  node("b");
  link("l1", "want", "a", "b", {{"value", 40.0}});
  scene_.links["l1"].is_muted = true;
  start().step();
  EXPECT_DOUBLE_EQ(number("b", "toy.blended"), 10);
  EXPECT_EQ(simulation_.state()->links[0].voices.size(), 3u);
  scene_.links["l1"].is_muted = false;
  scene_.links["l1"].is_enabled = false;
  start().step();
  EXPECT_DOUBLE_EQ(number("b", "toy.blended"), 10);
  EXPECT_TRUE(simulation_.state()->links[0].voices.empty());
}

TEST_F(TickTest, AFailingLinkKeepsItsLastGoodValueAndSaysSo) {
  node("a");
  node("b");
  link("l1", "want", "a", "b", {{"value", 40.0}});
  start().step();
  scene_.links["l1"].parameters["fail"] = true;
  start().step();
  EXPECT_DOUBLE_EQ(number("b", "toy.blended"), 40);
  ASSERT_TRUE(simulation_.state()->links[0].error.has_value());
  EXPECT_EQ(simulation_.state()->links[0].error->text(), "links/l1/value: does not want to");
  for (int i = 0; i < 20; ++i) simulation_.step();
  EXPECT_FALSE(simulation_.state()->is_settled());
  scene_.links["l1"].is_enabled = false;
  start();
  for (int i = 0; i < 20; ++i) simulation_.step();
  EXPECT_TRUE(simulation_.state()->is_settled());
}

TEST_F(TickTest, AFailingNodeKeepsItsLastGoodValue) {
  node("b", {{"blended", 30.0}});
  start().step();
  scene_.nodes["b"].types["toy"]["blended"] = 950.0;
  start().step();
  EXPECT_DOUBLE_EQ(number("b", "toy.doubled"), 60);
  EXPECT_EQ(simulation_.state()->nodes[0].types[1].error->text(), "nodes/b/toy/blended: too much for a toy");
  scene_.nodes["b"].types["toy"]["blended"] = 40.0;
  start().step();
  EXPECT_DOUBLE_EQ(number("b", "toy.doubled"), 80);
  EXPECT_FALSE(simulation_.state()->nodes[0].types[1].error.has_value());
}

TEST_F(TickTest, AnEffectCrossesOneLinkPerTickAndCyclesAreFine) {
  node("a", {{"blended", 20.0}});
  node("b");
  link("ab", "want", "a", "b", {{"value", 1.0}});
  link("ba", "want", "b", "a", {{"value", 3.0}});
  start().step();
  EXPECT_DOUBLE_EQ(number("a", "toy.blended"), 11.5);
  EXPECT_DOUBLE_EQ(number("b", "toy.blended"), 1);
}

TEST_F(TickTest, LinksToSetsReachEveryMemberOnceAndSkipThemselves) {
  for (const char* id : {"a", "b", "c"}) node(id);
  link("p", "push", "a", "a", {{"move", Vector3{1, 0, 0}}});
  scene_.links["p"].from = Selection{{}, "toy", ""};
  scene_.links["p"].to = Selection{{}, "toy", ""};
  start().step();
  // Unordered pairs (a,b), (a,c), (b,c): b is reached once, c twice, but a link speaks with one voice.
  EXPECT_EQ(std::get<Vector3>(value_in(*simulation_.state(), "a", "node.position")).x, 0);
  EXPECT_EQ(std::get<Vector3>(value_in(*simulation_.state(), "b", "node.position")).x, 1);
  EXPECT_EQ(std::get<Vector3>(value_in(*simulation_.state(), "c", "node.position")).x, 1);
}

TEST_F(TickTest, SettlesAfterCalmTicks) {
  node("b");
  scene_.settings["calm_ticks"] = std::int64_t{3};
  start();
  for (int i = 0; i < 2; ++i) simulation_.step();
  EXPECT_FALSE(simulation_.state()->is_settled());
  simulation_.step();
  EXPECT_TRUE(simulation_.state()->is_settled());
  link("p", "push", "b", "b", {{"move", Vector3{1, 0, 0}}});
  start().step();
  EXPECT_FALSE(simulation_.state()->is_settled());
}

TEST_F(TickTest, APlacedPositionStartsAgainFromItsSetValue) {
  node("b");
  link("p", "push", "b", "b", {{"move", Vector3{1, 0, 0}}});
  start().step();
  simulation_.set_scene(scene_);
  EXPECT_EQ(std::get<Vector3>(value_in(*simulation_.state(), "b", "node.position")).x, 1);
  simulation_.set_scene(scene_, {{"b", "node.position"}});
  EXPECT_EQ(std::get<Vector3>(value_in(*simulation_.state(), "b", "node.position")).x, 0);
}

TEST_F(TickTest, ALinkThatDoesNotFitSaysWhy) {
  scene_.nodes["a"].types = {{"node", {}}};
  node("b");
  link("l1", "want", "a", "b", {});
  start().step();
  EXPECT_EQ(simulation_.state()->links[0].error->text(), "links/l1/from: the node `a` has no `toy.blended`, which `want` needs");
}

// Of a query, too: it leaves out the nodes that lack the port, and where those are all it says which port that is.
TEST_F(TickTest, AnEndThatFitsNothingNamesThePortThatIsMissing) {
  scene_.nodes["a"].types = {{"node", {}}};
  scene_.nodes["b"].types = {{"node", {}}};
  const auto said = [&](const Selection& from) {
    scene_.links["l1"].kind = "want";
    scene_.links["l1"].from = from;
    scene_.links["l1"].to = {{"b"}, "", ""};
    start().step();
    return simulation_.state()->links[0].error->text();
  };
  const std::string nothing = "links/l1/from: no node fits this end; the link does nothing";
  EXPECT_EQ(said({{}, "toy", ""}), nothing);
  EXPECT_EQ(said({{}, "node", ""}), nothing + ": none of the 2 nodes that it chooses has `toy.blended`, which `want` needs");
}

TEST_F(TickTest, SnapshotsStayAsTheyWere) {
  node("b");
  link("p", "push", "b", "b", {{"move", Vector3{1, 0, 0}}});
  start();
  const auto before = simulation_.state();
  simulation_.step();
  EXPECT_EQ(before->tick, 0);
  EXPECT_EQ(std::get<Vector3>(value_in(*before, "b", "node.position")).x, 0);
  EXPECT_EQ(simulation_.state()->tick, 1);
}

}  // namespace
}  // namespace bl
