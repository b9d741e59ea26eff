// Rows of a study: the feedback of 2007 with its best gain, the feedback without one, and Newton, from the same start.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/drawing/line_chart.h"
#include "core/file/file_io.h"
#include "core/geometry/demand_fit.h"
#include "core/geometry/yardstick.h"
#include "core/reading/account.h"
#include "core/session/session.h"
#include "tests/bench/solver_bench_rows.h"
#include "ui/cli/scene_loading.h"

namespace bl::cli::bench {

namespace {

constexpr const char* kUsualScene = "scenes/studies/sixty_volumes.json";
// To one per cent, and how far the curves are followed: beyond it rounding decides.
constexpr double kGoal = 0.01, kFloor = 1e-11;
constexpr int kMostTicks = 3000;

struct Study {
  geometry::Domain domain;
  std::vector<geometry::PowerSite> sites;
  std::vector<double> demands;
  double fill = 0;
};

struct Curve {
  std::string name;
  double gain = 0;
  std::vector<double> errors;  // after each evaluation
  int to_goal = 0;             // evaluations until the goal; 0: never
  double seconds = 0;          // processor time until the goal
  std::string hash;
};

// Where the volumes are and what they want, when the scene has begun.
Result<Study> read_study(const std::string& file) {
  auto reading = load_scene(file);
  if (!reading) return Error{ErrorCode::parse, file, "this scene cannot be measured"};
  auto session = Session::start(full_registry(), reading->scene, nullptr, 1);
  if (!session) return session.error();
  (*session)->tick();
  const State& state = *(*session)->state();
  auto domain = domain_of(state);
  if (!domain) return Error{ErrorCode::geometry, file, "a study needs one boundary"};
  Study study;
  study.domain = std::move(*domain);
  study.sites = without_weights(sites_of(state));
  for (const reading::VolumeAccount& volume : reading::accounts_of(state).volumes) {
    study.demands.push_back(volume.limited);
    study.fill += volume.limited / study.domain.volume;
  }
  const auto start = initial_weights(study.domain, study.sites, study.demands);
  for (std::size_t i = 0; i < start.size(); ++i) study.sites[i].weight = start[i];
  return study;
}

// As a scene does it: one evaluation a tick, with what the last one remembered.
Result<Curve> follow(const Study& study, const std::string& name, geometry::FitMethod method, double gain, double floor,
                     int most) {
  Curve curve{name, gain, {}, 0, 0, ""};
  const geometry::FitOptions options{.method = method, .gain = gain, .steps = 1, .tolerance = floor};
  std::vector<geometry::PowerSite> sites = study.sites;
  geometry::FitState state;
  const double began = processor_time();
  while (static_cast<int>(curve.errors.size()) < most) {
    auto report = adapt_weights(study.domain, sites, study.demands, {}, state, options);
    if (!report) return report.error();
    curve.errors.push_back(report->error);
    if (curve.to_goal == 0 && report->error <= kGoal) {
      curve.to_goal = static_cast<int>(curve.errors.size());
      curve.seconds = processor_time() - began;
      curve.hash = hash_of(report->volumes);
    }
    if (report->is_met || !std::isfinite(report->error)) break;
    for (std::size_t i = 0; i < sites.size(); ++i) sites[i].weight = report->weights[i];
    state = std::move(report->state);
  }
  return curve;
}

// The constant gain that needs the fewest ticks to the goal, of steps by the root of two.
Result<Curve> best_of_2007(const SolverBench& bench, const Study& study) {
  Curve best;
  double gain = 0.2;
  for (int step = 0; step < 20; ++step, gain /= std::sqrt(2.0)) {
    if (!bench.goes_on("feedback of 2007, gain " + std::to_string(step + 1))) break;
    auto curve = follow(study, "feedback of 2007", geometry::FitMethod::feedback, gain, kGoal,
                        best.to_goal > 0 ? best.to_goal : kMostTicks);
    if (!curve) return curve.error();
    if (curve->to_goal > 0 && (best.to_goal == 0 || curve->to_goal < best.to_goal)) best = std::move(*curve);
  }
  if (best.to_goal == 0) return Error{ErrorCode::infeasible, "", "no constant gain leads to 1 % here"};
  return follow(study, "feedback of 2007", geometry::FitMethod::feedback, best.gain, kFloor, 4 * best.to_goal);
}

Result<void> draw(const Study& study, const std::vector<Curve>& curves, const std::string& folder) {
  static constexpr const char* kColours[] = {"#8a5a00", "#225599", "#aa3311"};
  static constexpr const char* kDashes[] = {"2 2.5", "6 2.5", ""};
  drawing::ChartPanel panel{"largest relative error of a volume", "evaluations of the diagram (one a tick)", {}, kGoal, "1 %"};
  for (std::size_t c = 0; c < curves.size(); ++c) {
    drawing::ChartLine line{curves[c].name + " (" + std::to_string(curves[c].to_goal) + " to 1 %)", kColours[c], kDashes[c], {}};
    for (std::size_t k = 0; k < curves[c].errors.size(); ++k) {
      line.points.push_back({static_cast<double>(k + 1), curves[c].errors[k]});
    }
    panel.lines.push_back(std::move(line));
  }
  std::error_code ignored;
  std::filesystem::create_directories(folder, ignored);
  return write_file(
      folder + "/feedback_newton.svg",
      drawing::draw_chart({"feedback-newton",
                           "Feedback against Newton",
                           "The largest relative error of " + std::to_string(study.sites.size()) +
                               " volumes over the evaluations of the diagram, on logarithmic scales; the numbers are "
                               "evaluations to one per cent.",
                           {panel}}));
}

}  // namespace

BenchTables bench_study(const SolverBench& bench) {
  BenchTable table("study", "Feedback against Newton, from the same start to 1 %",
                   {{"method", "method", true},
                    {"sites", "sites"},
                    {"fill %", "fill_percent"},
                    {"gain 1/m", "gain"},
                    {"evaluations", "evaluations_to_goal"},
                    {"ms", "milliseconds"},
                    {"/CGAL", "ratio_to_cgal"},
                    {"last error", "last_error"},
                    {"hash", "hash", true}});
  const bool is_named = !bench.options.scenes.empty();
  const std::string file = is_named ? bench.options.scenes.front() : kUsualScene;
  if (!is_named && !std::filesystem::exists(file)) {
    complain("there is no `" + file + "` here; `--rows study SCENE` takes another scene.");
    return std::vector<BenchTable>{};
  }
  const auto study = read_study(file);
  if (!study) return study.error();
  std::vector<Contender> yardstick = {{[&] { (void)plain_triangulation(study->sites); }, {}, {}}};
  take_turns(yardstick, bench.rounds, bench.turn_seconds, [] { return true; });
  std::vector<Curve> curves;
  auto old = best_of_2007(bench, *study);
  if (!old) return old.error();
  curves.push_back(std::move(*old));
  for (const geometry::FitMethod method : {geometry::FitMethod::feedback, geometry::FitMethod::newton}) {
    auto curve = follow(*study, method == geometry::FitMethod::newton ? "Newton" : "feedback without gain", method, 0, kFloor,
                        method == geometry::FitMethod::newton ? 60 : static_cast<int>(curves.front().errors.size()));
    if (!curve) return curve.error();
    curves.push_back(std::move(*curve));
  }
  for (const Curve& curve : curves) {
    table.add({word(curve.name), figure(study->sites.size()), figure(100 * study->fill, 1),
               curve.gain > 0 ? figure(curve.gain, 5) : no_figure(), figure(static_cast<std::size_t>(curve.to_goal)),
               figure(1e3 * curve.seconds, 2), figure(curve.seconds / yardstick.front().median.processor, 1),
               tiny(curve.errors.back()), word(curve.hash)});
  }
  if (!bench.options.chart.empty()) {
    if (auto drawn = draw(*study, curves, bench.options.chart); !drawn) return drawn.error();
  }
  return std::vector<BenchTable>{table};
}

}  // namespace bl::cli::bench
