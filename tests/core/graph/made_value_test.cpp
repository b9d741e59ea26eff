// Made objects and lists between nodes and links: who reads another type is told at compilation, and states carry what is made.
#include <gtest/gtest.h>

#include "core/define/link_builder.h"
#include "core/define/typification_builder.h"
#include "core/graph/simulation.h"
#include "tests/support/made_objects.h"
#include "tests/support/world.h"

namespace bl {
namespace {

int routes_made = 0;

// Adds up a list of lengths, and hands on a route of that length.
struct Walk {
  struct In {
    Numbers lengths;
  };
  struct Out {
    double whole = 0;
  };
  static void declare(TypificationBuilder<Walk>& t) {
    t.id("walk").label("Walk").doc("A walk.");
    t.in(&In::lengths, "lengths").doc("Its parts.");
    t.out(&Out::whole, "whole").doc("All of them.");
    t.made("route", {"whole"}, &route_of).doc("The walk as a route.");
  }
  static std::shared_ptr<const MadeRoute> route_of(const double& whole) {
    ++routes_made;
    return whole > 0 ? std::make_shared<const MadeRoute>(MadeRoute{whole}) : nullptr;
  }
  static Result<Out> evaluate(const In& in, const Tick&) {
    double whole = 0;
    for (const double length : *in.lengths) whole += length;
    if (whole < 0) return Error{ErrorCode::infeasible, "lengths", "a walk is not shorter than nothing"};
    return Out{whole};
  }
};

template <class Object>
struct Follow {
  struct In {};
  struct Ends {
    std::shared_ptr<const Object> object;
  };
  struct Out {
    Vector3 move;
  };
  static void declare(LinkBuilder<Follow>& l) {
    l.id("follow_" + std::string(Object::kMadeName.substr(2))).label("Follow").doc("Moves by what it reads.");
    l.reads(&Ends::object, End::from, "walk.route");
    l.proposes(&Out::move, End::to, "node.position", Unit::metre);
  }
  static Result<Out> evaluate(const In&, const Ends& ends, const Tick&) { return Out{{ends.object ? 1.0 : 0.0, 0, 0}}; }
};

// A set that reads the object as what it is not.
struct Dig {
  struct In {
    Selection walks{{}, "walk", {}};
  };
  struct Member {
    std::shared_ptr<const MadeTunnel> tunnel;
  };
  struct Sets {
    std::vector<Member> members;
  };
  struct Out {};
  static void declare(TypificationBuilder<Dig>& t) {
    t.id("dig").label("Dig").doc("Digs.");
    t.in(&In::walks, "walks").doc("Where.");
    t.set("walks", &Sets::members).reads(&Member::tunnel, "walk.route");
  }
  static Result<Out> evaluate(const In&, const Sets&, const Tick&) { return Out{}; }
};

const Registry& walkers() {
  static const Registry kRegistry = [] {
    Registry registry;
    register_base_node(registry);
    registry.add(TypificationBuilder<Walk>::build());
    registry.add(TypificationBuilder<Dig>::build());
    registry.add(LinkBuilder<Follow<MadeRoute>>::build());
    registry.add(LinkBuilder<Follow<MadeTunnel>>::build());
    return registry;
  }();
  return kRegistry;
}

class MadeValue : public testing::Test {
 protected:
  MadeValue() {
    scene_.nodes["a"].types = {{"node", {}}, {"walk", {{"lengths", Numbers({2, 3})}}}};
    scene_.nodes["b"].types = {{"node", {}}};
    link("follow_route");
    simulation_.set_scene(scene_);
  }
  void link(const std::string& kind) {
    scene_.links["l"] = LinkRecord{kind, {{"a"}, "", ""}, {{"b"}, "", ""}, true, false, 1, {}, ""};
  }
  void set(Numbers lengths) {
    scene_.nodes["a"].types["walk"]["lengths"] = std::move(lengths);
    simulation_.set_scene(scene_);
  }
  static Made made_in(const State& state) { return std::get<Made>(value_in(state, "a", "walk.route")); }
  std::shared_ptr<const MadeRoute> route() const { return made_in(*simulation_.state()).get<MadeRoute>(); }

  Scene scene_;
  Simulation simulation_{walkers(), 1};
};

TEST_F(MadeValue, LinksReadWhatItsNodeMade) {
  EXPECT_EQ(route(), nullptr) << "no tick has been";
  simulation_.step();
  ASSERT_NE(route(), nullptr);
  EXPECT_EQ(route()->length, 5);
  simulation_.step();
  EXPECT_EQ(std::get<Vector3>(value_in(*simulation_.state(), "b", "node.position")).x, 1);
}

TEST_F(MadeValue, IsMadeOnlyWhereSomebodyReads) {
  scene_.links.clear();
  simulation_.set_scene(scene_);
  routes_made = 0;
  simulation_.step();
  simulation_.step();
  EXPECT_EQ(routes_made, 0);
  (void)route();
  EXPECT_EQ(routes_made, 1);
}

TEST_F(MadeValue, StaysWhileWhatItIsMadeOfStays) {
  simulation_.step();
  const Made before = made_in(*simulation_.state());
  set(Numbers({1, 4}));
  simulation_.step();
  EXPECT_EQ(made_in(*simulation_.state()), before) << "the whole length is the same";
  set(Numbers({1, 5}));
  EXPECT_EQ(made_in(*simulation_.state()), before) << "no tick has been";
  simulation_.step();
  EXPECT_FALSE(made_in(*simulation_.state()) == before);
  EXPECT_EQ(route()->length, 6);
}

TEST_F(MadeValue, IsMadeAgainOfWhatWasSaved) {
  simulation_.step();
  set(Numbers({-1}));
  simulation_.step();
  ASSERT_TRUE(has_failure(*simulation_.state()));
  const SavedState saved = save(*simulation_.state());
  EXPECT_FALSE(saved.nodes.at("a").contains("walk.route"));
  Simulation other(walkers(), 1);
  other.set_scene(scene_);
  ASSERT_TRUE(other.restore_state(saved));
  ASSERT_NE(made_in(*other.state()).get<MadeRoute>(), nullptr);
  EXPECT_EQ(made_in(*other.state()).get<MadeRoute>()->length, 5) << "the last good length";
  EXPECT_EQ(other.state()->hash, simulation_.state()->hash);
  simulation_.step();
  other.step();
  EXPECT_EQ(other.state()->hash, simulation_.state()->hash);
}

TEST_F(MadeValue, WhoReadsAnotherTypeIsToldSoWhenTheSceneIsCompiled) {
  link("follow_tunnel");
  scene_.nodes["c"].types = {{"node", {}}, {"dig", {}}};
  const auto plan = compile(scene_, walkers());
  ASSERT_TRUE(plan->links[0].error);
  EXPECT_EQ(plan->links[0].error->text(), "links/l: the link reads a tunnel, but `walk.route` holds a route");
  ASSERT_TRUE(plan->sets[0].error);
  EXPECT_EQ(plan->sets[0].error->text(), "nodes/c/dig/walks: the evaluation reads a tunnel, but `walk.route` holds a route");
}

}  // namespace
}  // namespace bl
