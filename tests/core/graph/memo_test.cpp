// What is kept for the evaluations of a node goes when the node does: a long session must not fill up with nodes that are gone.
#include <memory>

#include <gtest/gtest.h>

#include "core/define/typification_builder.h"
#include "core/file/scene_file.h"
#include "core/graph/simulation.h"
#include "tests/support/world.h"

namespace bl {
namespace {

std::weak_ptr<int> g_kept;  // by the evaluation that came last

struct Hoarder {
  struct In {
    Selection nodes{{}, "smart_volume", {}};
  };
  struct Member {
    std::string id;
  };
  struct Sets {
    std::vector<Member> nodes;
  };
  struct Out {
    std::int64_t count = 0;
  };
  static void declare(TypificationBuilder<Hoarder>& t) {
    t.id("hoarder").label("Hoarder").doc("Keeps something from tick to tick.");
    t.in(&In::nodes, "nodes").doc("Whom it counts.");
    t.out(&Out::count, "count").doc("How many there are.");
    t.set("nodes", &Sets::nodes).reads(&Member::id, "node.id");
  }
  static Result<Out> evaluate(const In&, const Sets& sets, const Tick& tick) {
    auto& kept = tick.memo->of<std::shared_ptr<int>>();
    if (!kept) kept = std::make_shared<int>(1);
    g_kept = kept;
    return Out{static_cast<std::int64_t>(sets.nodes.size())};
  }
};

class Memos : public testing::Test {
 protected:
  void SetUp() override {
    registry_ = full_registry();
    registry_.add(TypificationBuilder<Hoarder>::build());
    const SceneReading reading =
        read_scene(R"({"format": "behaviourlinks", "version": 1, "nodes": [{"id": "h", "types": {"hoarder": {}}}, {"id": "b"}]})",
                   registry_);
    ASSERT_TRUE(reading.is_usable());
    scene_ = reading.scene;
    simulation_ = std::make_unique<Simulation>(registry_, 1);
    simulation_->set_scene(scene_);
    simulation_->step();
    ASSERT_FALSE(g_kept.expired());
  }

  Registry registry_;
  Scene scene_;
  std::unique_ptr<Simulation> simulation_;
};

TEST_F(Memos, StayWhileTheNodeDoes) {
  const auto before = g_kept.lock();
  scene_.nodes.edit("b").name = "B";
  simulation_->set_scene(scene_);
  simulation_->step();
  EXPECT_EQ(g_kept.lock(), before);
}

TEST_F(Memos, GoWithTheNode) {
  scene_.nodes.erase("h");
  simulation_->set_scene(scene_);
  EXPECT_TRUE(g_kept.expired());
}

TEST_F(Memos, GoWithTheRole) {
  scene_.nodes.edit("h").types.erase("hoarder");
  simulation_->set_scene(scene_);
  EXPECT_TRUE(g_kept.expired());
}

}  // namespace
}  // namespace bl
