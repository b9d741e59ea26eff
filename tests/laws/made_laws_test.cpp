// Laws of made objects: they follow from what is saved and hashed, so that no file holds them and nothing changes by reading
// them.
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "core/geometry/domain.h"
#include "tests/support/scene_files.h"
#include "tests/support/world.h"

namespace bl {
namespace {

std::set<std::string> made_paths() {
  std::set<std::string> paths;
  for (const auto& [id, type] : full_registry().typifications())
    for (const PortDefinition& port : type.ports)
      if (port.kind == ValueKind::made) paths.insert(id + "." + port.id);
  return paths;
}

// The domains of all boundaries, in ascending node id; asking makes them.
std::vector<std::shared_ptr<const geometry::Domain>> domains_of(const State& state) {
  std::vector<std::shared_ptr<const geometry::Domain>> domains;
  for (std::uint32_t n = 0; n < state.nodes.size(); ++n)
    if (const auto ref = state.plan->find(n, {"boundary", "domain", ""}))
      domains.push_back(std::get<Made>(state.value(*ref)).get<geometry::Domain>());
  return domains;
}

void expect_the_same(const std::vector<std::shared_ptr<const geometry::Domain>>& a,
                     const std::vector<std::shared_ptr<const geometry::Domain>>& b, const std::string& scene) {
  ASSERT_EQ(a.size(), b.size()) << scene;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i] == nullptr, b[i] == nullptr) << scene;
    if (a[i]) { EXPECT_TRUE(*a[i] == *b[i]) << scene; }
  }
}

TEST(MadeLaws, TheyFollowFromOwnResultsOfTheTick) {
  std::set<std::string> written_by_others;
  for (const auto& [id, type] : full_registry().typifications())
    for (const SetDefinition& set : type.sets)
      for (const WriteDefinition& write : set.writes) written_by_others.insert(write.path.typification + "." + write.path.port);
  EXPECT_FALSE(made_paths().empty());
  for (const auto& [id, type] : full_registry().typifications())
    for (const PortDefinition& port : type.ports) {
      ASSERT_EQ(port.kind == ValueKind::made, static_cast<bool>(port.make)) << id << "." << port.id;
      if (!port.make) continue;
      EXPECT_TRUE(port.is_computed && type.evaluate && type.latency.empty()) << id << "." << port.id;
      EXPECT_NE(port.made.type, nullptr) << id << "." << port.id;
      ASSERT_FALSE(port.made_from.empty()) << id << "." << port.id;
      for (const std::size_t from : port.made_from) {
        ASSERT_LT(from, type.ports.size()) << id << "." << port.id;
        EXPECT_TRUE(type.ports[from].is_computed && !is_derived(type.ports[from].kind)) << id << "." << port.id;
        EXPECT_FALSE(written_by_others.contains(id + "." + type.ports[from].id)) << id << "." << port.id;
      }
    }
}

// Whether to begin an analysis again is decided by a hash of what it reads, in which made objects are not.
TEST(MadeLaws, AnalysesReadNone) {
  for (const auto& [id, type] : full_registry().typifications()) {
    if (type.latency.empty()) continue;
    for (const SetDefinition& set : type.sets)
      for (const ReadDefinition& read : set.reads)
        EXPECT_FALSE(read.kind == ValueKind::made) << id << " reads " << read.path.typification << "." << read.path.port;
  }
}

// One world after the other: two would begin their sun studies at the same time, and the thread sanitizer cannot see the locks
// inside of Embree.
TEST(MadeLaws, ReadingThemChangesNoHash) {
  constexpr int kTicks = 5;
  for (const std::string& scene : small_scenes()) {
    std::vector<std::uint64_t> hashes;
    {
      World plain = World::from_file(scene);
      for (int tick = 0; tick < kTicks; ++tick) {
        plain.tick();
        hashes.push_back(plain.state().hash);
      }
      StateDraft without(plain.state());
      for (std::size_t n = 0; n < without.nodes.size(); ++n)
        for (TypeState& type : without.nodes.edit(n).types)
          for (Value& value : type.values)
            if (std::holds_alternative<Made>(value)) value = Made();
      EXPECT_EQ(hash_of(std::move(without).publish()), plain.state().hash) << scene;
    }
    World reading = World::from_file(scene);
    for (int tick = 0; tick < kTicks; ++tick) {
      (void)domains_of(reading.state());
      reading.tick();
      ASSERT_EQ(reading.state().hash, hashes[static_cast<std::size_t>(tick)]) << scene;
    }
  }
}

TEST(MadeLaws, NoFileHoldsThemAndLoadingMakesThemAgain) {
  const std::set<std::string> paths = made_paths();
  for (const std::string& scene : small_scenes()) {
    std::string text;
    std::vector<std::shared_ptr<const geometry::Domain>> before;
    {
      World world = World::from_file(scene);
      world.tick(3);
      const SavedState saved = save(world.state());
      for (const auto& [node, values] : saved.nodes)
        for (const auto& [path, value] : values) EXPECT_FALSE(paths.contains(path)) << scene << " " << node;
      text = write_scene(world.session().scene(), full_registry(), &saved);
      before = domains_of(world.state());
    }
    World loaded = World::from_text(text);
    expect_the_same(before, domains_of(loaded.state()), scene);
  }
}

// A boundary that fails stands as it was last; what was made of it must not follow the settings that it refuses.
TEST(MadeLaws, LoadingMakesThemOfTheLastGoodResults) {
  World world = World::from_file("scenes/nodes/boundary.json");
  world.tick(2);
  const auto before = domains_of(world.state());
  ASSERT_FALSE(before.empty());
  ASSERT_TRUE(before.front());
  std::string boundary;
  for (const auto& [id, node] : world.session().scene().nodes)
    if (boundary.empty() && node.types.contains("boundary")) boundary = id;
  ASSERT_EQ(world.submit(command<SetPort>({boundary, {"boundary.form"}, {"\"hull\""}})), "");
  ASSERT_EQ(world.submit(command<SetPort>({boundary, {"boundary.points"}, {"[[0, 0, 0]]"}})), "");
  world.tick();
  ASSERT_NE(world.node_error(boundary, "boundary"), "");
  EXPECT_EQ(domains_of(world.state()).front(), before.front());
  const SavedState saved = save(world.state());
  World loaded = World::from_text(write_scene(world.session().scene(), full_registry(), &saved));
  expect_the_same(domains_of(world.state()), domains_of(loaded.state()), "boundary");
}

// The same object for as long as what it is made of stands: who reads it may keep what follows from it by its address.
TEST(MadeLaws, OneStaysTheSameObjectWhileItsResultsDo) {
  World world = World::from_file("scenes/links/inside_boundary.json");
  world.tick(2);
  const auto before = domains_of(world.state());
  world.tick(2);
  EXPECT_EQ(domains_of(world.state()), before);
}

}  // namespace
}  // namespace bl
