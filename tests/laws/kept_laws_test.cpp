// Laws of what solvers keep from tick to tick: whatever people do, every tick comes out as if nothing had been kept.
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/random.h"
#include "core/base/text.h"
#include "core/file/scene_file.h"
#include "core/session/commands.h"
#include "core/session/ledger.h"
#include "tests/support/every_tick.h"
#include "tests/support/sanitized.h"
#include "tests/support/world.h"

namespace bl {
namespace {

// Two solvers on two plots. The first one has so many volumes that few of them are fitted alone; all other volumes are near the
// second plot. Some volumes stand, one link draws some of them together, and a sum reads all. With footprints they stand in whole
// storeys, and every sixth of them on the roof of the one before.
std::string two_plots(std::uint64_t seed, int count, bool has_footprints) {
  static constexpr const char* kForms[] = {"round", "block", "cell"};
  const std::string solver = has_footprints ? "standing_solver" : "smart_volumes_solver";
  Random random(seed);
  std::string nodes;
  for (int v = 0; v < count; ++v) {
    const bool is_far = v % 12 == 11;
    const Point3 at{random.uniform(2, 48) + (is_far ? 100 : 0), random.uniform(2, 48), random.uniform(1, 30)};
    const std::string base = v % 6 == 5 ? R"(, "bases": ["v)" + std::to_string(999 + v) + R"("])" : "";
    const std::string footprint = has_footprints ? R"(, "footprint": {"form": ")" + std::string(kForms[v % 3]) +
                                                       R"(", "storeys": )" + std::to_string(1 + v % 4) + R"(, "setback": )" +
                                                       (v % 4 == 0 ? "0.5" : "0") + base + "}"
                                                 : "";
    const char* standing = v % 5 == 0 ? R"(, "standing": "bridge")" : v % 7 == 0 ? R"(, "standing": "ground")" : "";
    nodes += R"(, {"id": "v)" + std::to_string(1000 + v) + R"(", "position": [)" + shortest(at.x) + ", " + shortest(at.y) + ", " +
             shortest(at.z) + R"(], "tags": [")" + (is_far ? "few" : "crowd") + R"("], "types": {"smart_volume": {"demand": )" +
             shortest(random.uniform(200, 700)) + standing + "}" + footprint + "}}";
  }
  return R"({"format": "behaviourlinks", "version": 1, "settings": {}, "nodes": [)"
         R"({"id": "near", "types": {"boundary": {"form": "plan", "plan": [[0, 0, 0], [50, 0, 0], [50, 50, 0], [0, 50, 0]], "height": 40}}}, )"
         R"({"id": "far", "types": {"boundary": {"form": "plan", "plan": [[100, 0, 0], [150, 0, 0], [150, 50, 0], [100, 50, 0]], "height": 40}}}, )"
         R"({"id": "solver", "types": {")" +
         solver + R"(": {"members": {"tag": "crowd"}, "boundary": "near")" + (has_footprints ? "" : R"(, "resolution": 8)") +
         R"(}}}, {"id": "other", "types": {")" + solver +
         R"(": {"members": {"tag": "few"}, "boundary": "far"}}}, )"
         R"({"id": "sum", "types": {"statistics": {"port": "smart_volume.floor_area", "nodes": {"typification": "smart_volume"}}}})" +
         nodes + R"(], "links": [)" +
         R"({"id": "together", "kind": "attract", "from": "v1000", "to": "v1003"}, )"
         R"({"id": "stand", "kind": "stand", "from": "near", "to": "v1010"}]})";
}

// A scene that runs and is changed, without anybody beside it.
class Going {
 public:
  Going(const std::string& text, int threads, bool evaluates_everything) : simulation_(full_registry(), threads) {
    SceneReading reading = read_scene(text, full_registry());
    EXPECT_TRUE(reading.is_usable());
    ledger_ = std::make_unique<Ledger>(full_registry(), reading.scene);
    simulation_.evaluate_everything(evaluates_everything);
    simulation_.set_scene(ledger_->scene());
    is_reference_ = evaluates_everything;
  }

  void say(const Command& command) { (void)ledger_->submit(command, Author{"test"}, tick_number()); }
  void undo() { (void)ledger_->undo(Author{"test"}, tick_number()); }
  void tick() {
    if (const Ledger::Changes changes = ledger_->take_changes(); changes.is_logic_changed)
      simulation_.set_scene(ledger_->scene(), changes.placed);
    states_.push_back(simulation_.state());
    simulation_.step();
  }
  void rewind(std::size_t ticks) {
    if (ticks == 0 || ticks > states_.size()) return;
    states_.resize(states_.size() - ticks + 1);
    simulation_.return_to(states_.back());
    states_.pop_back();
  }
  void save_and_load() {
    const SavedState saved = save(*simulation_.state());
    EXPECT_TRUE(simulation_.restore_state(saved).ok());
    states_.clear();
  }
  // Goes back to an earlier state and on from there, and is here again: as a rewind that fails. The reference does nothing.
  void look_back(std::size_t ticks, int steps) {
    if (is_reference_ || ticks == 0 || ticks > states_.size()) return;
    const std::shared_ptr<const State> here = simulation_.state();
    EXPECT_TRUE(simulation_.unpack(PackedState(*states_[states_.size() - ticks], nullptr, nullptr)).ok());
    for (int step = 0; step < steps; ++step) simulation_.step();
    simulation_.put_back(here);
  }

  std::int64_t tick_number() const { return simulation_.state()->tick; }
  const Scene& scene() const { return ledger_->scene(); }
  std::shared_ptr<const State> state() const { return simulation_.state(); }

 private:
  std::unique_ptr<Ledger> ledger_;
  Simulation simulation_;
  std::vector<std::shared_ptr<const State>> states_;  // with which the last ticks began
  bool is_reference_ = false;
};

std::string some_volume(const Scene& scene, Random& random) {
  std::vector<std::string> volumes;
  for (const auto& [id, node] : scene.nodes)
    if (node.types.contains("smart_volume")) volumes.push_back(id);
  return volumes.empty() ? "near" : volumes[random.below(volumes.size())];
}

Command put(const std::string& node, const std::string& port, const Json& value) {
  return command<SetPort>({node, {port}, JsonValue::of(value)});
}

Command placed(const std::string& node, const Point3& at) { return put(node, "node.position", Json::array({at.x, at.y, at.z})); }

Point3 place_of(const Going& run, const std::string& node) {
  const State& state = *run.state();
  const std::uint32_t at = state.plan->node_index(node);
  if (at == state.plan->nodes.size()) return {20, 20, 20};  // it has not run yet
  return std::get<Vector3>(state.value(*state.plan->find(at, {"node", "position", ""})));
}

Command moved(const Going& run, const std::string& node, const Vector3& by) { return placed(node, place_of(run, node) + by); }

// What changes one volume, most often a little.
void change_volume(Going& run, Random& random) {
  const std::string node = some_volume(run.scene(), random);
  static constexpr const char* kRules[] = {"stack", "bridge", "ground"};
  switch (random.below(11)) {
    case 9: return run.say(placed(node, place_of(run, some_volume(run.scene(), random))));  // on one point
    case 10: return run.say(moved(run, node, {random.below(2) == 0 ? 1e4 : -1e4, 0, 0}));   // out of reach
    case 0: return run.say(put(node, "smart_volume.demand", random.uniform(0, 1) < 0.2 ? 0.0 : random.uniform(100, 900)));
    case 1: return run.say(put(node, "smart_volume.storey_height", random.uniform(2, 6)));
    case 2: return run.say(put(node, "smart_volume.standing", kRules[random.below(3)]));
    case 3: return run.say(put(node, "smart_volume.demand_limit", random.uniform(0, 600)));
    case 4: return run.say(moved(run, node, {0, 0, random.uniform(-6, 6)}));
    case 5: return run.say(moved(run, node, {random.uniform(-20, 20), random.uniform(-20, 20), 0}));
    default: return run.say(moved(run, node, {random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), 0}));
  }
}

// What changes how one volume stands; of volumes without a footprint it changes nothing.
void change_footprint(Going& run, Random& random) {
  const std::string node = some_volume(run.scene(), random);
  const auto storeys = static_cast<double>(1 + random.below(6));
  static constexpr const char* kForms[] = {"round", "block", "cell"};
  switch (random.below(8)) {
    case 0: return run.say(put(node, "footprint.storeys", storeys));
    case 1: return run.say(put(node, "footprint.storeys_min", storeys));
    case 2: return run.say(put(node, "footprint.setback", random.uniform(0, 2)));
    case 3: return run.say(put(node, "footprint.depth", random.uniform(2, 12)));
    case 4: return run.say(put(node, "footprint.form", kForms[random.below(3)]));
    case 5: return run.say(put(node, "footprint.height_limit", random.uniform(2, 20)));
    case 6: return run.say(put(node, "footprint.bases", Json::array()));
    default: return run.say(put(node, "footprint.bases", Json::array({some_volume(run.scene(), random)})));  // or a circle
  }
}

// What changes who is a member, or what the solvers are asked for.
void change_plan(Going& run, Random& random, int number) {
  const std::string node = some_volume(run.scene(), random), fresh = "v" + std::to_string(900 + number);
  const Command arrival = command<AddNode>({fresh,
                                            {R"({"position": [)" + std::to_string(random.below(50)) +
                                             R"(, 20, 9], "tags": ["crowd"], "types": {"smart_volume": {"demand": 400}}})"}});
  switch (random.below(13)) {
    case 0: return run.say(command<RemoveNode>({node}));
    case 1: return run.say(arrival);
    case 12: return run.say(command<Batch>({std::vector{command<RemoveNode>({node}), arrival}}));  // as many as before
    case 2: return run.say(command<Untypify>({node, "smart_volume"}));
    case 3: return run.say(put(node, "node.tags", Json::array({random.below(2) == 0 ? "crowd" : "few"})));
    case 4: return run.say(put("near", "boundary.height", random.below(3) == 0 ? 0.0 : random.uniform(20, 45)));
    case 5: return run.say(put("solver", "smart_volumes_solver.method", random.below(2) == 0 ? "feedback" : "newton"));
    case 6: return run.say(put("solver", "smart_volumes_solver.metric", random.below(2) == 0 ? "additive" : "power"));
    case 7: return run.say(put("solver", "smart_volumes_solver.boundary", random.below(2) == 0 ? "far" : "near"));
    case 8: return run.say(command<RenameNode>({node, "Somebody"}));
    case 9: return run.say(put("solver", "smart_volumes_solver.tolerance", random.uniform(0.001, 1)));
    case 10: return run.say(command<LockPort>({node, {"node.position"}}));
    default: return run.say(command<RemoveLink>({"together"}));
  }
}

void act(Going& run, Random random, int tick) {
  const std::uint64_t choice = random.below(24);
  if (choice < 12) change_volume(run, random);
  if (choice >= 9 && choice < 14) change_plan(run, random, tick);
  if (choice >= 20) change_footprint(run, random);
  if (choice == 14 || choice == 15) run.undo();
  if (choice == 16) run.rewind(1 + random.below(6));
  if (choice == 17) run.save_and_load();
  if (choice == 18 || choice == 19) run.look_back(1 + random.below(6), static_cast<int>(random.below(3)));
}

void expect_nothing_kept_shows(std::uint64_t seed, int count, int ticks, bool has_footprints = false) {
  const std::string text = two_plots(seed, count, has_footprints);
  Going kept(text, 1 + static_cast<int>(seed % 3), false), reference(text, 1, true);
  for (int tick = 0; tick < ticks && !testing::Test::HasFatalFailure(); ++tick) {
    for (Going* run : {&kept, &reference}) {
      if (tick > 5) act(*run, Random(seed, static_cast<std::uint64_t>(tick)), tick);
      run->tick();
    }
    SCOPED_TRACE("seed " + std::to_string(seed) + ", tick " + std::to_string(tick));
    expect_same(*kept.state(), *reference.state());
  }
}

TEST(KeptLaws, NothingThatIsKeptShowsInACrowd) {
  for (std::uint64_t seed = 1; seed <= 3 && !HasFatalFailure(); ++seed) expect_nothing_kept_shows(seed, 120, 40);
}

TEST(KeptLaws, NothingThatIsKeptShowsAmongFew) {
  for (std::uint64_t seed = 10; seed < 22 && !HasFatalFailure(); ++seed) expect_nothing_kept_shows(seed, 24, 60);
}

TEST(KeptLaws, NothingThatIsKeptShowsAmongThoseThatStand) {
  const std::uint64_t last = test::kIsSanitized ? 33 : 42;
  for (std::uint64_t seed = 30; seed < last && !HasFatalFailure(); ++seed) expect_nothing_kept_shows(seed, 24, 60, true);
  if (!test::kIsSanitized) expect_nothing_kept_shows(50, 120, 40, true);
}

// A volume goes back to its old place while somebody looks at the state in which it stood there: what the look leaves has cells
// like those that come next, and nobody may take these for the ones that have been answered.
TEST(KeptLaws, ALookBackIsNoAnswer) {
  const std::string text = two_plots(4, 24, false);
  Going kept(text, 1, false), reference(text, 1, true);
  for (Going* run : {&kept, &reference}) {
    for (int tick = 0; tick < 40; ++tick) run->tick();
    run->say(put("solver", "smart_volumes_solver.tolerance", 1));  // no weight follows
    for (int tick = 0; tick < 3; ++tick) run->tick();
    run->say(moved(*run, "v1002", {1, 0, 0}));
    for (int tick = 0; tick < 3; ++tick) run->tick();
    run->undo();
    run->look_back(4, 0);
    run->tick();
  }
  expect_same(*kept.state(), *reference.state());
}

}  // namespace
}  // namespace bl
