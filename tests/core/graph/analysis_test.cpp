// Analyses beside the loop: results come with a declared latency and are the same whatever thread, save or rewind.
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "core/define/typification_builder.h"
#include "core/file/scene_file.h"
#include "core/graph/simulation.h"
#include "tests/support/deadline.h"
#include "tests/support/world.h"

namespace bl {
namespace {

// Adds up what its members' meshes enclose, and tells each member's watcher.
struct Survey {
  struct In {
    Selection volumes{{}, "smart_volume", {}}, watchers{{}, "watcher", {}};
    int latency = 3;
    bool fails = false;
  };
  struct Member {
    MeshPointer mesh;
  };
  struct Watcher {
    std::string id;
  };
  struct Sets {
    std::vector<Member> volumes;
    std::vector<Watcher> watchers;
  };
  struct Reply {
    double seen = 0;
  };
  struct Out {
    double enclosed = 0;
    std::int64_t tick = 0;
    std::vector<Reply> replies;
  };
  static void declare(TypificationBuilder<Survey>& t) {
    t.id("survey").label("Survey").doc("Adds up volumes.");
    t.in(&In::volumes, "volumes").doc("Who is surveyed.");
    t.in(&In::watchers, "watchers").doc("Who is told.");
    t.latency(&In::latency, "latency").doc("Ticks until the result counts.");
    t.in(&In::fails, "fails").doc("Fails on purpose.");
    t.out(&Out::enclosed, "enclosed").unit(Unit::cubic_metre).doc("What the meshes enclose.");
    t.out(&Out::tick, "tick").doc("The tick that was surveyed.");
    t.set("volumes", &Sets::volumes).reads(&Member::mesh, "smart_volume.mesh");
    t.set("watchers", &Sets::watchers, &Out::replies).reads(&Watcher::id, "node.id").writes(&Reply::seen, "watcher.seen");
  }
  static Result<Out> evaluate(const In& in, const Sets& sets, const Tick& tick) {
    if (in.fails) return Error{ErrorCode::conflict, "fails", "was told to fail"};
    Out out;
    out.tick = tick.index;
    for (const Member& member : sets.volumes)
      if (member.mesh) out.enclosed += enclosed_volume(*member.mesh);
    for (const Watcher& watcher : sets.watchers) out.replies.push_back({out.enclosed + static_cast<double>(watcher.id.size())});
    return out;
  }
};

struct WatcherRole {
  struct In {};
  struct Out {
    double seen = 0;
  };
  static void declare(TypificationBuilder<WatcherRole>& t) {
    t.id("watcher").label("Watcher").doc("Is told.");
    t.out(&Out::seen, "seen").unit(Unit::cubic_metre).doc("What it was told.");
  }
};

const Registry& registry() {
  static const Registry kRegistry = [] {
    Registry made = full_registry();
    made.add(TypificationBuilder<Survey>::build());
    made.add(TypificationBuilder<WatcherRole>::build());
    return made;
  }();
  return kRegistry;
}

constexpr const char* kText = R"({"format": "behaviourlinks", "version": 1, "nodes": [
  {"id": "a", "position": [10, 10, 5], "types": {"smart_volume": {"demand": 900}}},
  {"id": "b", "position": [30, 30, 5], "types": {"smart_volume": {"demand": 900}}},
  {"id": "eye", "types": {"watcher": {}}},
  {"id": "gone", "types": {"watcher": {}}},
  {"id": "site", "types": {"boundary": {}}},
  {"id": "solver", "types": {"smart_volumes_solver": {"steps": 1}}},
  {"id": "survey", "types": {"survey": {}}}],
  "links": [{"id": "pull", "kind": "attract", "from": "a", "to": "b"}]})";

Scene scene() {
  const SceneReading reading = read_scene(kText, registry());
  EXPECT_TRUE(reading.is_usable());
  return reading.scene;
}

struct Course {
  explicit Course(const Scene& what = scene(), int threads = 1) : simulation(registry(), threads) { simulation.set_scene(what); }
  Course& ticks(int count) {
    for (int k = 0; k < count; ++k) simulation.step();
    return *this;
  }
  const State& state() const { return *simulation.state(); }
  double number(const char* node, const char* path) const { return as_number(value_in(state(), node, path)); }
  Simulation simulation;
};

TEST(Analysis, ItsResultIsOfTheTickThatBeganItAndComesInDueTime) {
  Course run;
  run.ticks(3);
  EXPECT_EQ(run.number("survey", "survey.enclosed"), 0) << "begun in tick 1 with latency 3: nothing before tick 4";
  EXPECT_EQ(run.state().analyses.front().due, 4);
  run.ticks(1);
  EXPECT_EQ(run.number("survey", "survey.tick"), 1);
  run.ticks(3);
  EXPECT_EQ(run.number("survey", "survey.tick"), 4);
  double enclosed_then = 0;
  Course then;
  then.ticks(3);
  // What set evaluations read in tick 4 are the shapes that tick 3 has left.
  for (const char* node : {"a", "b"})
    enclosed_then += enclosed_volume(*std::get<MeshPointer>(value_in(then.state(), node, "smart_volume.mesh")));
  EXPECT_EQ(run.number("survey", "survey.enclosed"), enclosed_then);
  EXPECT_EQ(run.number("eye", "watcher.seen"), enclosed_then + 3);
}

TEST(Analysis, ThreadsChangeNothing) {
  const std::uint64_t hash = Course().ticks(17).state().hash;
  for (const int threads : {2, 8}) EXPECT_EQ(Course(scene(), threads).ticks(17).state().hash, hash);
}

TEST(Analysis, GoesOnAfterSavingAndLoadingAtAnyTick) {
  const std::uint64_t hash = Course().ticks(20).state().hash;
  for (int at = 1; at < 12; ++at) {
    Course first;
    first.ticks(at);
    const SavedState saved = save(first.state());
    const std::string text = write_scene(scene(), registry(), &saved);
    const SceneReading reading = read_scene(text, registry());
    ASSERT_TRUE(reading.is_usable()) << reading.first_error().text();
    EXPECT_EQ(write_scene(reading.scene, registry(), &*reading.state), text);
    Course second(reading.scene);
    ASSERT_TRUE(second.simulation.restore_state(*reading.state).ok());
    EXPECT_EQ(second.state().hash, first.state().hash) << "saved after tick " << at;
    EXPECT_EQ(second.ticks(20 - at).state().hash, hash) << "saved after tick " << at;
  }
}

TEST(Analysis, RewindsWithTheRest) {
  Course run;
  run.ticks(6);
  const auto earlier = run.simulation.state();
  const std::uint64_t hash = run.ticks(7).state().hash;
  run.simulation.return_to(earlier);
  EXPECT_EQ(run.ticks(7).state().hash, hash);
}

TEST(Analysis, ToleratesThatAMemberGoesMeanwhile) {
  Course run;
  run.ticks(5);
  Scene without = scene();
  without.nodes.erase("gone");
  run.simulation.set_scene(without);
  run.ticks(2);
  EXPECT_GT(run.number("eye", "watcher.seen"), 3);
  EXPECT_EQ(run.state().plan->node_index("gone"), run.state().plan->nodes.size());
}

TEST(Analysis, AFailureIsShownAndTheLastResultKept) {
  Course run;
  run.ticks(8);
  Scene failing = scene();
  failing.nodes.edit("survey").types["survey"]["fails"] = true;
  run.simulation.set_scene(failing);
  run.ticks(3);  // the one that was running ends well
  const double before = run.number("survey", "survey.enclosed");
  run.ticks(5);
  EXPECT_GT(before, 0);
  EXPECT_EQ(run.number("survey", "survey.enclosed"), before);
  const State& state = run.state();
  const auto ref = state.plan->find(state.plan->node_index("survey"), {"survey", "fails", ""});
  ASSERT_TRUE(state.nodes[ref->node].types[ref->type].error.has_value());
  EXPECT_EQ(state.nodes[ref->node].types[ref->type].error->text(), "nodes/survey/survey/fails: was told to fail");
}

TEST(Analysis, ASceneSettlesOnlyWhenItsAnalysesHaveSeenIt) {
  Scene slow = scene();
  slow.links.clear();
  slow.nodes.edit("survey").types["survey"]["latency"] = std::int64_t{40};
  Course run(slow);
  int settled_at = 0;
  for (int k = 1; k < 200 && settled_at == 0; ++k)
    if (run.ticks(1).state().is_settled()) settled_at = k;
  EXPECT_GT(settled_at, 80) << "one survey of the restless start, one of the calm end";
  EXPECT_LT(settled_at, 100);
  const State& state = run.state();
  EXPECT_EQ(state.analyses.front().as_of, state.tick);
}

TEST(Analysis, LatencyZeroIsWithinTheTick) {
  Scene quick = scene();
  quick.nodes.edit("survey").types["survey"]["latency"] = std::int64_t{0};
  Course run(quick);
  run.ticks(4);
  EXPECT_EQ(run.number("survey", "survey.tick"), 4);
}

// Evaluates without end, unless it is told to stop; only the second attempt, which nobody may stop, comes to an end.
struct Endless {
  std::atomic<int> begun = 0;
  TypificationDefinition definition;
  Endless() {
    definition.id = "endless";
    definition.evaluate = [this](std::span<Value>, std::span<SetValues>, const Tick&) -> Result<void> {
      ++begun;
      while (stop_wish() != nullptr && !(*stop_wish())()) std::this_thread::yield();
      if (stop_wish() != nullptr) return Error{ErrorCode::cancelled, "", "was stopped"};
      return Error{ErrorCode::conflict, "", "came to its end"};
    };
  }
  std::shared_ptr<Analysis> analysis() {
    AnalysisInput input;
    input.definition = &definition;
    return std::make_shared<Analysis>(std::move(input));
  }
  void wait_until_begun() const {
    while (begun == 0) std::this_thread::yield();
  }
};

TEST(Analysis, IsStoppedWhenNobodyWantsItAnyMore) {
  const Deadline deadline(60, "an analysis that nobody wants any more is stopped");
  Endless endless;
  AnalysisRunner runner;
  auto unwanted = endless.analysis();
  runner.begin(unwanted);
  endless.wait_until_begun();
  const std::weak_ptr<Analysis> watched = unwanted;
  unwanted.reset();
  while (!watched.expired()) std::this_thread::yield();
  EXPECT_EQ(endless.begun, 1) << "nobody began it again";
}

TEST(Analysis, StoppedByTheEndOfTheRunnerItIsLeftToWhoeverHoldsIt) {
  const Deadline deadline(60, "the end of a runner stops what it runs");
  Endless endless;
  const auto held = endless.analysis();
  {
    AnalysisRunner runner;
    runner.begin(held);
    endless.wait_until_begun();
  }
  ASSERT_TRUE(held->result()->error.has_value());
  EXPECT_EQ(held->result()->error->message, "came to its end");
  EXPECT_EQ(endless.begun, 2);
}

// What an evaluation keeps is there for the next one of the same node.
TEST(Analysis, KeepsAMemoForTheNextOne) {
  int last = 0;
  TypificationDefinition definition;
  definition.evaluate = [&](std::span<Value>, std::span<SetValues>, const Tick& tick) -> Result<void> {
    last = ++tick.memo->of<int>();
    return {};
  };
  AnalysisInput input;
  input.definition = &definition;
  input.memo = std::make_shared<AnalysisMemo>();
  for (int k = 1; k <= 3; ++k) {
    Analysis(input).run();
    EXPECT_EQ(last, k);
  }
}

}  // namespace
}  // namespace bl
