// Rows of edits: what it takes until the plan and the state of the edited scene are there, against compiling the scene anew.
#include <functional>
#include <memory>

#include "core/base/text.h"
#include "core/define/registry.h"
#include "core/graph/amend.h"
#include "core/graph/simulation.h"
#include "tests/bench/random_scene.h"
#include "tests/bench/solver_bench_rows.h"

namespace bl::cli::bench {

namespace {

struct EditCase {
  const char* name;
  std::function<void(Scene&)> edit;
};

// Links to sets, and a chain of links from each volume to the next.
Result<Scene> chained_scene(int count) {
  auto scene = linked_scene(count, 0.7);
  if (!scene) return scene.error();
  std::string last;
  for (const auto& [id, node] : scene->nodes) {
    if (!node.types.contains("smart_volume")) continue;
    if (!last.empty()) {
      LinkRecord& link = scene->links["to_" + id];
      link.kind = "attract";
      link.from.ids = {last};
      link.to.ids = {id};
    }
    last = id;
  }
  return scene;
}

std::vector<EditCase> edit_cases(const Scene& scene) {
  const auto volume = std::next(scene.nodes.begin(), static_cast<std::ptrdiff_t>(scene.nodes.size() / 2));
  const std::string node = volume->first, link = "to_" + node, next = std::next(volume)->first;
  const NodeRecord another = volume->second;
  const LinkRecord single = scene.links.at(link), to_all = scene.links.at("inside");
  return {{"a link's strength", [=](Scene& s) { s.links.edit(link).strength = 0.5; }},
          {"a parameter of a link to all", [](Scene& s) { s.links.edit("inside").parameters["margin"] = 2.0; }},
          {"a link switched off", [=](Scene& s) { s.links.edit(link).is_enabled = false; }},
          {"an end of a link", [=](Scene& s) { s.links.edit(link).to.ids = {next}; }},
          {"a link added", [=](Scene& s) { s.links.emplace("another", single); }},
          {"a link removed", [=](Scene& s) { s.links.erase(link); }},
          {"a link to all added", [=](Scene& s) { s.links.emplace("inside_too", to_all); }},
          {"a volume moved",
           [=](Scene& s) {
             s.nodes.edit(node).types["node"]["position"] = Vector3{1, 2, 3};
           }},
          {"a volume tagged",
           [=](Scene& s) { s.nodes.edit(node).types["node"]["tags"] = Shared<std::vector<std::string>>({"public"}); }},
          {"a volume renamed", [=](Scene& s) { s.nodes.edit(node).name = "Tower"; }},
          {"a volume added", [=](Scene& s) { s.nodes.emplace("another", another); }},
          {"a volume removed", [=](Scene& s) { s.nodes.erase(node); }}};
}

Result<void> time_edits(const SolverBench& bench, int count, BenchTable& table) {
  const auto scene = chained_scene(count);
  if (!scene) return scene.error();
  Simulation simulation(full_registry(), 1);
  simulation.set_scene(*scene);
  simulation.step();
  const Plan& plan = *simulation.state()->plan;
  for (const EditCase& one : edit_cases(*scene)) {
    Scene edited = *scene;
    one.edit(edited);
    std::optional<Amended> amended;
    std::shared_ptr<const State> carried;
    std::shared_ptr<const Plan> compiled;
    const bool can_amend = amend(plan, edited, full_registry()).has_value();
    std::vector<Contender> contenders{
        {.work = [&] { amended = amend(plan, edited, full_registry()); }, .median = {}, .least = {}},
        {.work = [&] { carried = simulation.with_scene(edited); }, .median = {}, .least = {}},
        {.work = [&] { compiled = compile(edited, full_registry()); }, .median = {}, .least = {}}};
    take_turns(contenders, bench.rounds, bench.turn_seconds,
               [&] { return bench.goes_on("edits of " + std::to_string(count) + " volumes, " + one.name); });
    const double quick = contenders[0].median.processor, with_state = contenders[1].median.processor,
                 whole = contenders[2].median.processor;
    table.add({word(one.name), figure(static_cast<std::size_t>(count)), figure(edited.links.size()),
               can_amend ? figure(1000 * quick, 3) : no_figure(), figure(1000 * with_state, 3), figure(1000 * whole, 2),
               word(hex_digits(carried->hash))});
  }
  return {};
}

}  // namespace

BenchTables bench_plan(const SolverBench& bench) {
  BenchTable table{"plan",
                   "Plans after one edit, made from the last plan, against compiling all; and with the state that goes on",
                   {{"edit", "case", true},
                    {"volumes", "sites"},
                    {"links", "links"},
                    {"amended ms", "amended_ms"},
                    {"with state ms", "state_ms"},
                    {"compiled ms", "compiled_ms"},
                    {"hash", "hash", true}}};
  for (const int count : bench.sites({1000, 10000, 30000}, {60}))
    if (auto done = time_edits(bench, count, table); !done) return done.error();
  return std::vector<BenchTable>{std::move(table)};
}

}  // namespace bl::cli::bench
