// Laws of meshes that are made when somebody looks: they come out as if they had been made at once, and whoever only ticks, saves
// or compares makes none.
#include <bit>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "core/file/scene_file.h"
#include "core/reading/changes.h"
#include "core/reading/report_model.h"
#include "tests/support/sanitized.h"
#include "tests/support/scene_files.h"
#include "tests/support/world.h"

namespace bl {
namespace {

using States = std::vector<std::shared_ptr<const State>>;

// Those that wait for somebody who looks, or have waited, in the order of the ports.
std::vector<MeshPointer> meshes_of(const State& state) {
  std::vector<MeshPointer> meshes;
  for (std::uint32_t n = 0; n < state.nodes.size(); ++n)
    for (const TypeState& type : state.nodes[n].types)
      for (const Value& value : type.values)
        if (const auto* mesh = std::get_if<MeshPointer>(&value); mesh != nullptr && mesh->has_recipe()) meshes.push_back(*mesh);
  return meshes;
}

void add_bits(Hash& hash, const std::vector<Point3>& points) {
  hash.add(static_cast<std::uint64_t>(points.size()));
  for (const Point3& p : points)
    for (const double coordinate : {p.x, p.y, p.z}) hash.add(std::bit_cast<std::uint64_t>(coordinate));
}

// Of every bit that can be seen of a mesh.
void add_bits(Hash& hash, const Mesh* mesh) {
  hash.add(std::uint64_t{mesh != nullptr ? 1u : 0u});
  if (mesh == nullptr) return;
  add_bits(hash, mesh->vertices);
  hash.add(static_cast<std::uint64_t>(mesh->triangles.size()));
  for (const auto& triangle : mesh->triangles)
    for (const std::uint32_t corner : triangle) hash.add(std::uint64_t{corner});
  hash.add(std::uint64_t{mesh->wrap ? 1u : 0u});
  if (const MeshWrap* wrap = mesh->wrap.get()) {
    add_bits(hash, std::vector<Point3>{wrap->ball_centre, {wrap->radius, 0, 0}});
    for (const std::uint32_t seam : wrap->seams) hash.add(std::uint64_t{seam});
    for (const MeshWrap::Part& part : wrap->parts) {
      hash.add(std::uint64_t{part.triangles});
      add_bits(hash, {part.centre});
      add_bits(hash, part.seams);
    }
  }
  add_bits(hash, mesh->coarse.get());
  add_bits(hash, mesh->whole.get());
}

std::vector<std::uint64_t> bits_of(const State& state) {
  std::vector<std::uint64_t> bits;
  for (const MeshPointer& mesh : meshes_of(state)) {
    Hash hash;
    add_bits(hash, &*mesh);
    bits.push_back(hash.value());
  }
  return bits;
}

bool has_signed_zero(const std::vector<Point3>& points) {
  return std::any_of(points.begin(), points.end(), [](const Point3& p) {
    const auto is_signed = [](double c) { return c == 0 && std::signbit(c); };
    return is_signed(p.x) || is_signed(p.y) || is_signed(p.z);
  });
}

class MeshLaws : public testing::TestWithParam<std::string> {};

// One world after the other: the thread sanitizer cannot see into the library that follows rays.
TEST_P(MeshLaws, TheyComeOutAsIfMadeAtOnceWhenSeveralLookLater) {
  constexpr int kTicks = 6;
  std::vector<std::vector<std::uint64_t>> at_once;
  std::vector<std::uint64_t> hashes;
  {
    World world = World::from_file(GetParam(), 2);
    for (int tick = 0; tick < kTicks; ++tick) {
      world.tick();
      at_once.push_back(bits_of(world.state()));
      hashes.push_back(world.state().hash);
      for (const MeshPointer& mesh : meshes_of(world.state())) ASSERT_FALSE(has_signed_zero(mesh->vertices));
    }
  }
  States states;
  {
    World world = World::from_file(GetParam());
    for (int tick = 0; tick < kTicks; ++tick) {
      world.tick();
      states.push_back(world.session().state());
    }
  }
  // Everything that has made these states has gone.
  std::vector<std::vector<std::uint64_t>> forward(kTicks), backward(kTicks);
  std::thread other([&] {
    for (std::size_t t = kTicks; t-- > 0;) backward[t] = bits_of(*states[t]);
  });
  for (std::size_t t = 0; t < kTicks; ++t) forward[t] = bits_of(*states[t]);
  other.join();
  for (std::size_t t = 0; t < kTicks; ++t) {
    EXPECT_EQ(states[t]->hash, hashes[t]);
    EXPECT_EQ(forward[t], at_once[t]);
    EXPECT_EQ(backward[t], at_once[t]);
  }
}

bool is_read_by_a_set(const Plan& plan) {
  return std::any_of(plan.sets.begin(), plan.sets.end(), [&](const SetPlan& set) {
    return std::any_of(set.reads.begin(), set.reads.end(), [&](const PortRef& ref) {
      return ref.type != PortRef::kNodeId && plan.port(ref).kind == ValueKind::mesh;
    });
  });
}

void expect_none_made(const State& state, std::size_t& unseen) {
  for (const MeshPointer& mesh : meshes_of(state)) {
    ASSERT_FALSE(mesh.is_made() || mesh.is_coarse_made());
    ++unseen;
  }
}

// What a run without a window does, and what a server does with its states.
TEST(MeshLaws, WhoOnlyTicksSavesAndComparesMakesNone) {
  std::size_t scenes = 0, unseen = 0;
  for (const std::string& scene : shipped_scenes()) {
    World world = World::from_file(scene);
    world.tick();
    if (is_read_by_a_set(*world.state().plan)) continue;
    SCOPED_TRACE(scene);
    ++scenes;
    States states{world.session().state()};
    for (int tick = 0; tick < 8; ++tick) {
      world.tick();
      (void)reading::changes_between(*states.back(), world.state());
      states.push_back(world.session().state());
    }
    const State copy = *states.back();
    const SavedState saved = save(copy);
    (void)write_scene(world.session().scene(), full_registry(), &saved);
    EXPECT_EQ(hash_of(copy), copy.hash);
    reading::ReportModel figures;
    reading::read_figures(copy, figures);
    for (const auto& state : states) expect_none_made(*state, unseen);
  }
  EXPECT_GE(scenes, 20u);
  EXPECT_GE(unseen, 5000u);
}

TEST(MeshLaws, LoadingInTheMiddleOfARunMakesNone) {
  World world = World::from_file("scenes/start/quarter.json");
  world.tick(5);
  const SavedState saved = save(world.state());
  const World loaded = World::from_text(write_scene(world.session().scene(), full_registry(), &saved));
  std::size_t unseen = 0;
  expect_none_made(loaded.state(), unseen);
  EXPECT_EQ(unseen, meshes_of(world.state()).size());
  EXPECT_GT(unseen, 0u);
  EXPECT_EQ(bits_of(loaded.state()), bits_of(world.state()));
}

// A solver that fails leaves its shapes standing; only a save looks at them.
TEST(MeshLaws, AFailingSolverMakesNone) {
  World world = World::from_file("scenes/start/quarter.json");
  world.tick(5);
  ASSERT_EQ(world.submit(command<AddNode>(
                {"plot2", {R"({"types": {"boundary": {"form": "plan", "plan": [[0, 0, 0], [60, 0, 0], [60, 24, 0]]}}})"}})),
            "");
  world.tick(3);
  ASSERT_TRUE(has_failure(world.state()));
  std::size_t unseen = 0;
  expect_none_made(world.state(), unseen);
  EXPECT_GT(unseen, 0u);
}

INSTANTIATE_TEST_SUITE_P(Scenes, MeshLaws, testing::ValuesIn(test::kIsSanitized ? small_scenes() : shipped_scenes()),
                         scene_test_name<testing::TestParamInfo<std::string>>);

}  // namespace
}  // namespace bl
