// Laws of pairs between sets: what lies too far apart is not looked at, and every tick comes out as if it had been.
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/random.h"
#include "core/base/text.h"
#include "core/define/link_remark.h"
#include "core/session/commands.h"
#include "tests/support/every_tick.h"
#include "tests/support/random_values.h"
#include "tests/support/sanitized.h"

namespace bl {
namespace {

JsonValue place_of(const Point3& at) { return JsonValue::of(Json::array({at.x, at.y, at.z})); }

std::string name_of_node(std::uint64_t number) { return "n" + std::to_string(100 + number); }

// Nodes in clusters, on one line, on one point and far out, in two sets that overlap; links of every kind with silent pairs
// between a set and itself, the other set, or one node. Every other crowd is loose, so that few of its nodes move.
class Crowd {
 public:
  explicit Crowd(std::uint64_t seed) : random_(seed), is_loose_(seed % 2 == 0) {
    for (const auto& [id, kind] : full_registry().links())
      if (kind.silent_band) kinds_.push_back(id);
    for (int n = 0; n < kNodes; ++n) nodes_.push_back(node(name_of_node(n)));
    for (int l = 0; l < 3; ++l) links_.push_back(link("l" + std::to_string(l)));
  }

  static constexpr int kNodes = 40;

  std::string text() const {
    Json scene = {
        {"format", "behaviourlinks"}, {"version", 1}, {"settings", Json::object()}, {"nodes", nodes_}, {"links", links_}};
    return scene.dump();
  }

 private:
  Point3 place() {
    if (is_loose_) return {random_.uniform(0, 150), random_.uniform(0, 150), 0};
    switch (random_.below(8)) {
      case 0: return {0, 0, 0};
      case 1: return {random_.uniform(-1e7, 1e7), random_.uniform(-1e7, 1e7), 0};
      case 2: return {10.0 * static_cast<double>(random_.below(6)), 0, 0};
      default: return {random_.uniform(0, 60), random_.uniform(0, 60), random_.uniform(0, 20)};
    }
  }
  Json node(const std::string& id) {
    const Point3 at = place();
    Json tags = Json::array();
    for (const char* tag : {"a", "b"})
      if (random_.below(3) > 0) tags.push_back(tag);
    Json one = {{"id", id}, {"position", {at.x, at.y, at.z}}, {"tags", tags}, {"types", {{"control", Json::object()}}}};
    if (random_.below(10) == 0) one["locked"] = Json::array({"node.position"});
    return one;
  }
  Json end() {
    switch (random_.below(5)) {
      case 0: return {{"typification", "control"}};
      case 1: return Json(name_of_node(random_.below(kNodes)));
      case 2: return {{"tag", "b"}};
      default: return {{"tag", "a"}};
    }
  }
  Json link(const std::string& id) {
    const std::string kind = kinds_[random_.below(kinds_.size())];
    Json parameters = {{"in_plan", random_.below(3) == 0}, {"stiffness", random_.uniform(0.05, is_loose_ ? 1 : 0.3)}};
    for (const PortDefinition& port : full_registry().link(kind)->ports) {
      const bool is_most = port.id == "maximum" || port.id == "rest";
      if (port.unit == Unit::metre)
        parameters[port.id] = is_most ? (is_loose_ ? 500 : random_.uniform(10, 40)) : random_.uniform(5, is_loose_ ? 30 : 10);
    }
    return {{"id", id},
            {"kind", kind},
            {"from", end()},
            {"to", end()},
            {"parameters", parameters},
            {"strength", random_.uniform(0.1, 1)}};
  }

  Random random_;
  bool is_loose_;
  std::vector<std::string> kinds_;
  Json nodes_ = Json::array(), links_ = Json::array();
};

// A hand that moves nodes, little or far, and now and then changes who belongs where, what a link wants, or takes it back.
void meddle(World& world, std::uint64_t seed, int tick) {
  Random random(seed, static_cast<std::uint64_t>(tick));
  // The same one for some ticks: it is moved on from where the links have just moved it.
  const std::string node = name_of_node(Random(seed, static_cast<std::uint64_t>(1000 + tick / 4)).below(Crowd::kNodes));
  const auto submit = [&](const Command& command) { (void)world.submit(command); };
  const bool is_wild = seed % 4 > 1;
  switch (random.below(is_wild ? 12 : 40)) {
    case 0: return submit(command<SetPort>({node, {"node.tags"}, JsonValue::of(Json::array({"b"}))}));
    case 1:
      return submit(command<SetLinkParameter>({"l0", random.below(2) == 0 ? "minimum" : "reach", JsonValue::of(Json(15.0))}));
    // Above the largest distance: every pair fails.
    case 2: return submit(command<SetLinkParameter>({"l1", "minimum", JsonValue::of(Json(100.0))}));
    case 3: return submit(command<SetLinkStrength>({"l2", random.uniform()}));
    case 11: return submit(command<SetLinkParameter>({"l2", "maximum", JsonValue::of(Json(1e15))}));
    case 4: return submit(command<RemoveNode>({node}));
    case 5: return (void)world.session().undo(Author{"test"});
    case 6: return submit(command<EnableLink>({"l0", random.below(2) == 0}));
    case 7: return submit(command<SetPort>({node, {"node.position"}, place_of({random.uniform(-600, 600), 0, 0})}));
    default: {
      const auto at = world.state().plan->node_index(node);
      if (at == world.state().plan->nodes.size()) return;
      const Point3 now = world.point(node, "node.position");
      const double most = random.below(2) == 0 ? 40 : 3;
      return submit(command<SetPort>(
          {node, {"node.position"}, place_of(now + Vector3{random.uniform(-most, most), random.uniform(-most, most), 0})}));
    }
  }
}

TEST(ReachLaws, EveryTickIsAsIfAllPairsHadBeenAsked) {
  const std::uint64_t crowds = test::kIsSanitized ? 16 : 100;
  for (std::uint64_t seed = 0; seed < crowds && !testing::Test::HasFatalFailure(); ++seed) {
    SCOPED_TRACE("crowd " + std::to_string(seed));
    expect_the_same_states(Crowd(seed).text(), 30, 1 + static_cast<int>(seed % 3),
                           [&](World& world, int tick) { meddle(world, seed, tick); });
  }
}

// A node that links have pushed out of the reach of another one, and that is then set elsewhere before anybody was asked: the
// other one heard it last where it was at first. Locks hold all others in their places, so that nothing else is news.
TEST(ReachLaws, PartnersOfTheFirstPlaceAreAsked) {
  Json nodes = Json::array();
  for (std::uint64_t n = 0; n < 12; ++n) {
    const double at = n == 0 ? 0 : n == 1 ? 15 : n == 2 ? 19 : 1000.0 * static_cast<double>(n);
    Json one = {{"id", name_of_node(n)}, {"position", {at, 0, 0}}, {"types", {{"control", Json::object()}}}};
    if (n != 2) one["locked"] = Json::array({"node.position"});
    nodes.push_back(one);
  }
  const Json all = {{"typification", "control"}};
  const Json link = {
      {"id", "apart"}, {"kind", "repel"}, {"from", all}, {"to", all}, {"parameters", {{"reach", 20}, {"stiffness", 1}}}};
  const Json scene = {{"format", "behaviourlinks"},
                      {"version", 1},
                      {"settings", Json::object()},
                      {"nodes", nodes},
                      {"links", Json::array({link})}};
  expect_the_same_states(scene.dump(), 4, 1, [](World& world, int tick) {
    if (tick == 1) (void)world.submit(command<SetPort>({name_of_node(2), {"node.position"}, place_of({500, 0, 0})}));
  });
}

// What one pair reads.
struct Pair {
  LinkReads reads;
  std::vector<Value> storage;
};

// The id of a node is read like a port, and is none.
PortDefinition port_of(const LinkRead& read) {
  PortDefinition port;
  port.kind = read.kind;
  if (const auto found = full_registry().port(read.path)) port = **found;
  return port;
}

Pair pair_of(const LinkDefinition& kind, const Point3& from, const Point3& to, Random& random) {
  Pair pair;
  pair.storage.reserve(kind.reads.size());
  for (std::size_t r = 0; r < kind.reads.size(); ++r) {
    const LinkRead& read = kind.reads[r];
    if (r == kind.silent_reads[0]) pair.storage.emplace_back(from);
    else if (r == kind.silent_reads[1]) pair.storage.emplace_back(to);
    else pair.storage.push_back(random_value(port_of(read), random));
    pair.reads.values.push_back({&pair.storage.back()});
  }
  return pair;
}

TEST(ReachLaws, PairsInTheBandOfTheirKindSayNothing) {
  std::size_t kinds = 0, silent = 0;
  for (const auto& [id, kind] : full_registry().links()) {
    if (!kind.silent_band) continue;
    ++kinds;
    for (const LinkRead& read : kind.reads) {
      EXPECT_FALSE(read.is_whole) << id;
      EXPECT_FALSE(port_of(read).is_computed) << id << " reads " << read.path.port << ", which can fail";
    }
    Random random(17, id.size());
    for (int i = 0; i < 3000; ++i) {
      std::vector<Value> parameters;
      for (const PortDefinition& port : kind.ports) parameters.push_back(random_value(port, random));
      const auto in = kind.instantiate(parameters);
      const SilentBand band = kind.silent_band(in.get());
      if (band.least > band.most) continue;
      // Now and then at the very bounds, but for a hair.
      const double least = band.least * (1 + 1e-9) + 1e-9, most = std::min(band.most * (1 - 1e-9) - 1e-9, least + 1e4);
      const double way = i % 5 == 0 ? least : i % 5 == 1 ? most : random.uniform(least, most), turn = random.uniform(0, 6.3);
      if (least > most) continue;
      const double level = band.in_plan ? 0 : random.uniform(-1, 1), across = std::sqrt(1 - level * level);
      Vector3 by = Vector3{across * std::cos(turn), across * std::sin(turn), level} * way;
      if (band.in_plan) by.z = random.uniform(-100, 100);
      const Point3 from{random.uniform(-100, 100), random.uniform(-100, 100), 0};
      // The sum is rounded, which may bring it to the other side of a bound.
      const Vector3 between = (from + by) - from;
      const double found = norm({between.x, between.y, band.in_plan ? 0 : between.z});
      if (found < least || found > most) continue;
      const Pair pair = pair_of(kind, from, from + by, random);
      LinkWrites writes;
      for (std::size_t w = 0; w < kind.proposes.size(); ++w) writes.values.emplace_back(1);
      LinkRemarks remarks;
      const auto done = kind.evaluate(in.get(), pair.reads, writes, Tick{.remarks = &remarks});
      ASSERT_TRUE(done.ok()) << id << ": " << done.error().text();
      EXPECT_FALSE(remarks.said) << id;
      for (const auto& values : writes.values) ASSERT_FALSE(values.front()) << id << " speaks at " << shortest(found) << " m";
      ++silent;
    }
  }
  EXPECT_GE(kinds, 3u);
  EXPECT_GE(silent, 1000 * kinds);
}

// Two thousand nodes on a lattice that all rest, each with eight others in reach.
std::string lattice() {
  Json nodes = Json::array();
  for (int n = 0; n < 2000; ++n)
    nodes.push_back({{"id", "n" + std::to_string(10000 + n)},
                     {"position", {10 * (n % 50), 10 * (n / 50), 0}},
                     {"types", {{"control", Json::object()}}}});
  const Json all = {{"typification", "control"}};
  const Json links =
      Json::array({{{"id", "apart"}, {"kind", "repel"}, {"from", all}, {"to", all}, {"parameters", {{"reach", 9}}}},
                   {{"id", "kept"},
                    {"kind", "keep_distance"},
                    {"from", all},
                    {"to", all},
                    {"parameters", {{"minimum", 8}, {"maximum", 1000}}}}});
  return Json{{"format", "behaviourlinks"}, {"version", 1}, {"settings", Json::object()}, {"nodes", nodes}, {"links", links}}
      .dump();
}

TEST(ReachLaws, AMovedNodeCostsItsNeighboursAndNoCrowdCostsItsSquare) {
  World world = World::from_text(lattice());
  world.tick();
  EXPECT_LE(world.session().counts().pairs, 2u * 2000u);
  world.tick(5);
  ASSERT_TRUE(world.state().due.is_nothing());
  for (int frame = 0; frame < 10; ++frame) {
    const std::size_t before = world.session().counts().pairs;
    (void)world.submit(command<SetPort>({"n11020", {"node.position"}, place_of({200 + 0.5 * frame, 205, 0})}));
    world.tick();
    EXPECT_GT(world.session().counts().pairs, before) << "frame " << frame;
    EXPECT_LE(world.session().counts().pairs - before, 60u) << "frame " << frame;
  }
}

}  // namespace
}  // namespace bl
