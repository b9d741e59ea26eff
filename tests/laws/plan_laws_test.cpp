// Laws of plans that follow from the plan before: they are those that compiling gives, and the ticks under them are the same.
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/file/scene_file.h"
#include "core/graph/amend.h"
#include "core/graph/carry.h"
#include "core/graph/simulation.h"
#include "tests/support/plan_differences.h"
#include "tests/support/random_scenes.h"
#include "tests/support/random_values.h"
#include "tests/support/scene_files.h"
#include "tests/support/world.h"

namespace bl {
namespace {

template <class Map>
std::string some_name(const Map& map, Random& random) {
  return std::next(map.begin(), static_cast<std::ptrdiff_t>(random.below(map.size())))->first;
}

Selection some_end(const Scene& scene, Random& random) {
  if (random.below(2) == 0) return {{some_name(scene.nodes, random)}, "", ""};
  if (random.below(3) == 0) return {{}, "smart_volume", ""};
  const LinkRecord& other = scene.links.at(some_name(scene.links, random));
  return random.below(2) == 0 ? other.from : other.to;
}

void set_some_parameter(LinkRecord& link, Random& random) {
  const LinkDefinition* kind = full_registry().link(link.kind);
  if (kind == nullptr || kind->ports.empty()) return;
  const PortDefinition& port = kind->ports[random.below(kind->ports.size())];
  link.parameters[port.id] = random_value(port, random);
}

void edit_some_link(Scene& scene, Random& random) {
  LinkRecord& link = scene.links.edit(some_name(scene.links, random));
  switch (random.below(7)) {
    case 0: link.strength = random.uniform(); break;
    case 1: link.is_enabled = !link.is_enabled; break;
    case 2: link.is_muted = !link.is_muted; break;
    case 3: link.from = some_end(scene, random); break;
    case 4: link.to = some_end(scene, random); break;
    case 5: link.kind = random.below(4) == 0 ? "nothing" : scene.links.at(some_name(scene.links, random)).kind; break;
    default: set_some_parameter(link, random);
  }
}

// Of any port, also of one that names other nodes or ports, or a unit.
void set_some_value(Scene& scene, const std::string& id, Random& random) {
  auto& types = scene.nodes.edit(id).types;
  const std::string name = some_name(types, random);
  const TypificationDefinition* type = full_registry().typification(name);
  if (type == nullptr || type->ports.empty()) return;
  const PortDefinition& port = type->ports[random.below(type->ports.size())];
  if (port.is_computed) return;
  types[name][port.id] =
      port.kind == ValueKind::selection ? Value(Shared<Selection>(some_end(scene, random))) : random_value(port, random);
}

void set_some_tag(Scene& scene, const std::string& id, Random& random) {
  std::vector<std::string> tags;
  for (const auto& [other, link] : scene.links)
    for (const Selection* end : {&link.from, &link.to})
      if (!end->tag.empty()) tags.push_back(end->tag);
  const std::string tag = tags.empty() ? "public" : tags[random.below(tags.size())];
  PortValues& values = scene.nodes.edit(id).types["node"];
  if (!values.erase("tags")) values["tags"] = Shared<std::vector<std::string>>({tag});
}

void edit_some_node(Scene& scene, Random& random, const std::string& fresh) {
  const std::string id = some_name(scene.nodes, random);
  switch (random.below(12)) {
    case 0: scene.nodes.edit(id).name = fresh; break;
    case 1: set_some_tag(scene, id, random); break;
    case 2: scene.nodes.emplace(fresh, scene.nodes.at(id)); break;
    case 3:
      if (scene.nodes.size() > 2) scene.nodes.erase(id);
      break;
    case 4:
      if (!scene.nodes.edit(id).locked.erase("node.position")) scene.nodes.edit(id).locked.insert("node.position");
      break;
    case 5: scene.nodes.edit(id).types["control"]; break;
    case 6: set_some_tag(scene, id, random); break;
    case 7:
    case 8:
    case 9: set_some_value(scene, id, random); break;
    default: scene.nodes.edit(id).types["node"]["position"] = Vector3{random.uniform(-9, 9), random.uniform(-9, 9), 1};
  }
}

void edit(Scene& scene, Random& random, int number) {
  static constexpr const char* kFirstLetters[] = {"a", "m", "zz"};
  const std::string fresh = kFirstLetters[random.below(3)] + std::to_string(number);
  if (scene.links.empty()) {
    LinkRecord& link = scene.links["first"];
    link.kind = "attract";
    link.from = link.to = {{some_name(scene.nodes, random)}, "", ""};
  }
  switch (random.below(8)) {
    case 0: {
      LinkRecord link = scene.links.at(some_name(scene.links, random));
      if (random.below(2) == 0) link.from = some_end(scene, random);
      scene.links.emplace(fresh, std::move(link));
      break;
    }
    case 1: scene.links.erase(some_name(scene.links, random)); break;
    case 2:
    case 3:
    case 4: edit_some_node(scene, random, fresh); break;
    default: edit_some_link(scene, random);
  }
}

void expect_same_states(const State& a, const State& b) {
  ASSERT_EQ(a.hash, b.hash);
  EXPECT_EQ(a.calm, b.calm);
  for (std::uint32_t n = 0; n < a.nodes.size(); ++n)
    for (std::size_t t = 0; t < a.nodes[n].types.size(); ++t)
      EXPECT_EQ(a.nodes[n].types[t].is_evaluated, b.nodes[n].types[t].is_evaluated) << a.plan->nodes[n].id;
}

void expect_same_ticks(Simulation& a, Simulation& b) {
  a.step();
  b.step();
  ASSERT_EQ(a.state()->hash, b.state()->hash);
  for (std::size_t n = 0; n < a.state()->nodes.size(); ++n)
    for (std::size_t t = 0; t < a.state()->nodes[n].types.size(); ++t)
      EXPECT_EQ(a.state()->nodes[n].types[t].tension, b.state()->nodes[n].types[t].tension) << a.state()->plan->nodes[n].id;
  for (std::size_t l = 0; l < a.state()->links.size(); ++l)
    EXPECT_TRUE(a.state()->links[l].says_the_same(b.state()->links[l])) << a.state()->plan->links[l].id;
}

struct Tally {
  int amended = 0, compiled = 0;
};

void expect_amended_as_compiled(const std::string& text, int rounds, std::uint64_t seed, Tally& tally) {
  const SceneReading reading = read_scene(text, full_registry());
  ASSERT_TRUE(reading.is_usable());
  Simulation amended(full_registry(), 1), compiled(full_registry(), 1);
  amended.set_scene(reading.scene);
  for (int tick = 0; tick < 3; ++tick) amended.step();
  Scene scene = reading.scene;
  for (int round = 0; round < rounds && !testing::Test::HasFatalFailure(); ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    Random random(seed, static_cast<std::uint64_t>(round));
    for (std::uint64_t edits = 1 + random.below(3); edits > 0; --edits) edit(scene, random, 10 * round + static_cast<int>(edits));
    const std::shared_ptr<const State> before = amended.state();
    const auto whole = compile(scene, full_registry());
    const auto quick = amend(*before->plan, scene, full_registry());
    ++(quick ? tally.amended : tally.compiled);
    EXPECT_EQ(quick ? plan_difference(*quick->plan, *whole) : "", "");
    amended.set_scene(scene);
    compiled.put_back(std::make_shared<State>(carry(*before, whole, {})));
    expect_same_states(*amended.state(), *compiled.state());
    for (int tick = 0; tick < 2 && !testing::Test::HasFatalFailure(); ++tick) expect_same_ticks(amended, compiled);
  }
}

TEST(PlanLaws, EditsOfAllScenesAmendThePlanToTheOneThatCompilingGives) {
  Tally tally;
  for (const std::string& path : shipped_scenes()) {
    if (testing::Test::HasFatalFailure()) return;
    SCOPED_TRACE(path);
    expect_amended_as_compiled(project_file(path), path.starts_with("scenes/studies/") ? 6 : 20, path.size(), tally);
  }
  EXPECT_GT(tally.amended, 500);
  EXPECT_GT(tally.compiled, 50) << "other typifications have to be compiled";
}

TEST(PlanLaws, SoTheyDoInRandomScenes) {
  Tally tally;
  for (std::uint64_t seed = 500; seed < 540 && !testing::Test::HasFatalFailure(); ++seed) {
    SCOPED_TRACE("scene " + std::to_string(seed));
    expect_amended_as_compiled(random_scene(seed), 12, seed, tally);
  }
  EXPECT_GT(tally.amended, 200);
}

}  // namespace
}  // namespace bl
