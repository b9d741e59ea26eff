// Random volumes, the same on every machine.
#include "tests/bench/random_scene.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "core/base/mathematics.h"
#include "core/base/random.h"
#include "core/define/codec.h"
#include "core/session/session.h"

namespace bl::cli::bench {

namespace {

constexpr double kSpacing = 10;  // [m]
// A script is stopped whose tables grow too large: one link leads so many volumes about.
constexpr int kMostWalkers = 10000;

std::string padded(int number, int count) {
  const std::string text = std::to_string(number), last = std::to_string(count);
  return "v" + std::string(last.size() - text.size(), '0') + text;
}

// Keeps all volumes on the move, so that no tick shares anything with the one before.
constexpr const char* kWalker = R"(return {id = 'stroll', doc = 'Walks about.',
  reads = {ids = {at = 'to', port = 'node.id', whole = true}},
  proposes = {moves = {at = 'to', port = 'node.position', whole = true}},
  evaluate = function(params, ends, tick)
    local moves = {}
    for i, id in ipairs(ends.ids) do
      moves[i] = point(random(id, tick.index, 1) - 0.5, random(id, tick.index, 2) - 0.5, random(id, tick.index, 3) - 0.5)
    end
    return {moves = moves}
  end}
)";

}  // namespace

Result<Scene> random_scene(int count, const Registry& registry, double fill) {
  Random random(2007);
  // The cube root is rounded to millimetres, so that the box does not depend on the machine's library.
  const double side = std::round(kSpacing * mathematics::cube_root(static_cast<double>(count)) * 1000) / 1000;
  std::vector<double> shares;
  double sum = 0;
  for (int i = 0; i < count; ++i) sum += shares.emplace_back(random.uniform(0.25, 1.75));
  std::vector<Command> commands;
  const auto add = [&](const std::string& id, const Json& node) {
    commands.push_back(command<AddNode>({id, JsonValue::of(node)}));
  };
  const Json plan = {{0.0, 0.0, 0.0}, {side, 0.0, 0.0}, {side, side, 0.0}, {0.0, side, 0.0}};
  add("box", {{"types", {{"boundary", {{"form", "plan"}, {"plan", plan}, {"height", side}}}}}});
  add("solver", {{"types", {{"smart_volumes_solver", Json::object()}}}});
  for (int i = 0; i < count; ++i) {
    const double x = random.uniform(0, side), y = random.uniform(0, side), z = random.uniform(0, side);
    const double demand = fill * side * side * side * shares[static_cast<std::size_t>(i)] / sum;
    add(padded(i + 1, count), {{"position", {x, y, z}}, {"types", {{"smart_volume", {{"demand", demand}}}}}});
  }
  auto session = Session::start(registry, Scene{}, nullptr, 1);
  if (!session) return session.error();
  if (auto done = (*session)->submit(command<Batch>({commands}), "bench"); !done) return done.error();
  return (*session)->scene();
}

Result<Scene> standing_scene(int count, const Registry& registry) {
  constexpr double kPlotSide = 40, kCovered = 0.5, kStorey = 3, kSetback = 1.5;  // [m] for each volume; share; [m]
  Random random(20070);
  const double side = std::round(kPlotSide * std::sqrt(static_cast<double>(count)) * 1000) / 1000;
  std::vector<double> shares;
  double sum = 0;
  for (int i = 0; i < count; ++i) sum += shares.emplace_back(random.uniform(1, 8));
  std::vector<Command> commands;
  const auto add = [&](const std::string& id, const Json& node) {
    commands.push_back(command<AddNode>({id, JsonValue::of(node)}));
  };
  const Json plan = {{0.0, 0.0, 0.0}, {side, 0.0, 0.0}, {side, side, 0.0}, {0.0, side, 0.0}};
  add("box", {{"types", {{"boundary", {{"form", "plan"}, {"plan", plan}, {"height", 60}}}}}});
  add("solver", {{"types", {{"standing_solver", Json::object()}}}});
  for (int i = 0; i < count; ++i) {
    const double x = random.uniform(0, side), y = random.uniform(0, side);
    const int storeys = 2 + static_cast<int>(random.below(6));
    const double footprint = kCovered * side * side * shares[static_cast<std::size_t>(i)] / sum;
    add(padded(i + 1, count),
        {{"position", {x, y, 0.0}},
         {"types",
          {{"smart_volume", {{"demand", footprint * storeys * kStorey}, {"storey_height", kStorey}}},
           {"footprint", {{"form", "round"}, {"storeys", storeys}, {"setback", kSetback}, {"full_storeys", storeys - 1}}}}}});
  }
  auto session = Session::start(registry, Scene{}, nullptr, 1);
  if (!session) return session.error();
  if (auto done = (*session)->submit(command<Batch>({commands}), "bench"); !done) return done.error();
  return (*session)->scene();
}

Result<Scene> linked_scene(int count, double fill) {
  auto scene = random_scene(count, full_registry(), fill);
  if (!scene) return scene.error();
  int number = 0;
  for (const auto& [id, node] : SharedMap(scene->nodes))
    if (node.types.contains("smart_volume") && number++ % 20 == 0)
      scene->nodes.edit(id).types[std::string(kBaseNode)]["tags"] = Shared<std::vector<std::string>>({"public"});
  scene->nodes["sum"].types = {
      {"node", {}},
      {"statistics", {{"port", std::string("smart_volume.volume")}, {"nodes", Shared<Selection>({{}, "smart_volume", {}})}}}};
  const auto join = [&](const char* id, const char* kind, const Selection& from, const Selection& to, PortValues parameters) {
    LinkRecord& link = scene->links[id];
    link.kind = kind;
    link.from = from;
    link.to = to;
    link.parameters = std::move(parameters);
  };
  const Selection volumes{{}, "smart_volume", {}}, tagged{{}, {}, "public"};
  join("inside", "inside_boundary", {{"box"}, {}, {}}, volumes, {{"margin", 1.0}});
  join("cap", "set_cap", {{"sum"}, {}, {}}, volumes, {{"cap", 1e12}});
  join("apart", "keep_distance", tagged, tagged, {{"minimum", 12.0}, {"maximum", 1e6}});
  return scene;
}

Result<Scene> restless_scene(int count, double fill) {
  auto scene = linked_scene(count, fill);
  if (!scene) return scene.error();
  scene->scripts = Scripts::read({{"stroll", kWalker}}, full_registry());
  const auto walk = [&](const std::string& id, const Selection& who) {
    LinkRecord& link = scene->links[id];
    link.kind = "stroll";
    link.from.ids = {"box"};
    link.to = who;
  };
  if (count <= kMostWalkers) {
    walk("stroll", {{}, "smart_volume", {}});
    return scene;
  }
  std::vector<Selection> groups;
  int number = 0;
  for (const auto& [id, node] : scene->nodes) {
    if (!node.types.contains("smart_volume")) continue;
    if (number++ % kMostWalkers == 0) groups.emplace_back();
    groups.back().ids.push_back(id);
  }
  for (std::size_t g = 0; g < groups.size(); ++g) walk("stroll" + std::to_string(g + 1), groups[g]);
  return scene;
}

std::vector<std::string> some_volumes(const Scene& scene, std::size_t count) {
  std::vector<std::string> all, some;
  for (const auto& [id, node] : SharedMap(scene.nodes))
    if (node.types.contains("smart_volume")) all.push_back(id);
  count = std::min(count, all.size());
  for (std::size_t k = 0; k < count; ++k) some.push_back(all[(2 * k + 1) * all.size() / (2 * count)]);
  return some;
}

}  // namespace bl::cli::bench
