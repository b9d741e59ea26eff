// The visitors of the study come one by one, as by a form: the steps have a trace of their own, and lead to the shipped scene.
#include <cstdlib>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/define/codec.h"
#include "core/file/file_io.h"
#include "tests/support/place/source_folder.h"
#include "tests/support/world.h"

namespace bl {
namespace {

constexpr const char* kForm = "scenes/studies/visitors_form.json";
constexpr int kTicksBetween = 3;

struct VisitorsForm {
  std::string empty;            // the scene before the first visitor
  std::vector<Command> visits;  // what each of them adds
};

VisitorsForm visitors_form() {
  VisitorsForm form;
  Json scene = *parse_json(project_file(kForm)), others = Json::array();
  for (const Json& node : scene["nodes"]) {
    const std::string id = node["id"].get<std::string>();
    Json record = node;
    record.erase("id");
    if (id.starts_with("visitor-")) form.visits.push_back(command<AddNode>({id, JsonValue::of(record)}));
    else others.push_back(node);
  }
  scene["nodes"] = others;
  form.empty = scene.dump();
  return form;
}

TEST(VisitorsForm, StepsHaveTheirTraceAndLeadToTheShippedScene) {
  const VisitorsForm form = visitors_form();
  ASSERT_GE(form.visits.size(), 20u);
  World world = World::from_text(form.empty);
  std::string trace = "visitor tick largest_residual largest_move hash\n", log = log_header(form.empty);
  for (std::size_t visit = 0; visit < form.visits.size(); ++visit) {
    ASSERT_EQ(world.submit(form.visits[visit], "visitor" + std::to_string(visit + 1)), "");
    world.tick(kTicksBetween);
    const State& state = world.state();
    trace += std::to_string(visit + 1) + " " + std::to_string(state.tick) + " " + shortest(state.largest_residual) + " " +
             shortest(state.largest_move) + " " + hex_digits(state.hash) + "\n";
  }
  const std::string path = test::source_folder() + "/tests/golden/steps-visitors_form.trace";
  if (std::getenv("BL_UPDATE_GOLDEN") != nullptr) { ASSERT_TRUE(write_file(path, trace).ok()); }
  const auto kept = read_file(path);
  ASSERT_TRUE(kept.ok()) << kept.error().text();
  EXPECT_EQ(trace, *kept);
  EXPECT_EQ(write_scene(world.session().scene(), full_registry()), project_file(kForm));
  // The recorded steps give the same hash again.
  for (const LogEntry& entry : world.session().log()) log += log_line(entry, full_registry());
  log += log_line(LogCheck{world.state().tick, hex_digits(world.state().hash), true});
  const auto file = read_log(log, full_registry());
  ASSERT_TRUE(file.ok()) << file.error().text();
  const auto report = replay(*file, full_registry(), 2);
  ASSERT_TRUE(report.ok()) << report.error().text();
  EXPECT_FALSE(report->first_mismatch.has_value());
  EXPECT_EQ(report->checks, 1u);
}

// Nobody's visit hangs on another one: each visitor can take back the own volume, and that of nobody else.
TEST(VisitorsForm, EachVisitorTakesBackTheOwnVolumeOnly) {
  const VisitorsForm form = visitors_form();
  World world = World::from_text(form.empty);
  for (std::size_t visit = 0; visit < form.visits.size(); ++visit)
    ASSERT_EQ(world.submit(form.visits[visit], "visitor" + std::to_string(visit + 1)), "");
  std::size_t nodes = world.session().scene().nodes.size();
  for (std::size_t visit = 0; visit < form.visits.size(); visit += 2) {
    const auto undone = world.session().undo("visitor" + std::to_string(visit + 1));
    ASSERT_TRUE(undone.ok() && undone->left.empty());
    EXPECT_EQ(world.session().scene().nodes.size(), --nodes);
    EXPECT_FALSE(world.session().scene().nodes.contains(std::get<std::string>(form.visits[visit].arguments.at("id"))));
  }
}

}  // namespace
}  // namespace bl
