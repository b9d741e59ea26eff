// Rows of growth of whole ticks: at rest, one volume dragged, all moving beside the solver alone, and memory, over the number of
// volumes.
#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>

#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/drawing/line_chart.h"
#include "core/file/file_io.h"
#include "core/geometry/volume_tick.h"
#include "core/session/commands.h"
#include "core/session/session.h"
#include "tests/bench/random_scene.h"
#include "tests/bench/solver_bench_rows.h"

namespace bl::cli::bench {

namespace {

constexpr double kTickGrowthFill = 0.7, kPull = 0.2;  // kPull in [m]
constexpr int kFirstTicks = 3, kMovingTicks = 12, kPulledTicks = 40, kRestingTicks = 20, kMostTicksUntilRest = 4000;
constexpr std::size_t kPulledVolumes = 9;

struct TickCurve {
  const char *label, *key, *colour, *dashes;
};
constexpr std::array kTickCurves = {
    TickCurve{"all move", "moving", "#aa3311", ""}, TickCurve{"all move, the solver alone", "alone", "#aa3311", "6 2.5"},
    TickCurve{"one dragged", "dragged", "#225599", ""}, TickCurve{"at rest", "resting", "#666a73", ""}};
enum : std::size_t { kMoving, kAlone, kDragged, kResting };

struct TickGrowthRow {
  int volumes = 0;
  std::array<std::optional<double>, kTickCurves.size()> seconds;  // of a tick
  std::optional<double> bytes;                                    // of all volumes
  std::string moved_hash, dragged_hash;
};

// The solver by itself on what a session's volumes do: the same sites and demands, tick by tick, with weights of its own.
class Alone {
 public:
  Result<double> follow(const State& state) {
    if (!domain_) domain_ = domain_of(state);
    if (!domain_) return Error{ErrorCode::missing, "", "there is no boundary to divide"};
    const std::vector<geometry::PowerSite> sites = sites_of(state);
    weights_.resize(sites.size(), 0);
    std::vector<geometry::PowerSite> mine = sites;
    for (std::size_t i = 0; i < sites.size(); ++i) mine[i].weight = weights_[i];
    read_rules(state);
    const double begin = processor_time();
    const geometry::VolumeTick tick{.storey_heights = storeys_, .standing = standing_};
    auto done = tick.run(*domain_, mine, wanted_, fit_, kept_);
    const double seconds = processor_time() - begin;
    if (!done) return done.error();
    fit_ = std::move(done->state);
    for (std::size_t i = 0; i < sites.size(); ++i) {
      if (mine[i].weight != sites[i].weight)
        return Error{ErrorCode::internal, "", "the solver alone comes to another weight of site " + std::to_string(i)};
      weights_[i] = mine[i].weight;
    }
    return seconds;
  }

 private:
  void read_rules(const State& state) {
    storeys_.clear(), wanted_.clear();
    for (std::uint32_t n = 0; n < state.plan->nodes.size(); ++n) {
      const auto wanted = state.plan->find(n, {"smart_volume", "wanted", ""}),
                 storey = state.plan->find(n, {"smart_volume", "storey_height", ""});
      if (!wanted || !storey) continue;
      wanted_.push_back(as_number(state.value(*wanted)));
      storeys_.push_back(as_number(state.value(*storey)));
    }
    standing_.assign(wanted_.size(), geometry::Standing::stack);
  }

  std::optional<geometry::Domain> domain_;
  std::vector<double> weights_, storeys_, wanted_;
  std::vector<geometry::Standing> standing_;
  geometry::FitState fit_;
  geometry::VolumeTick::Cache kept_;
};

// All volumes move in every tick, and the solver alone makes the same moves.
Result<void> time_moving(const SolverBench& bench, TickGrowthRow& row) {
  const auto scene = restless_scene(row.volumes, kTickGrowthFill);
  if (!scene) return scene.error();
  const auto session = Session::start(full_registry(), *scene, nullptr, 1);
  if (!session) return session.error();
  Alone alone;
  std::vector<double> whole, part;
  for (int t = 0; t < kFirstTicks + kMovingTicks && bench.goes_on(std::to_string(row.volumes) + " volumes, all moving"); ++t) {
    const double begin = processor_time();
    (*session)->tick();
    const double seconds = processor_time() - begin;
    // Who is not led about any more stands still, which looks like speed.
    if (const auto failure = first_failure(*(*session)->state()); failure) return *failure;
    const auto solver = alone.follow(*(*session)->state());
    if (!solver) return solver.error();
    if (t < kFirstTicks) continue;
    whole.push_back(seconds);
    part.push_back(*solver);
  }
  row.seconds[kMoving] = median(whole);
  row.seconds[kAlone] = median(part);
  row.moved_hash = hex_digits((*session)->state()->hash);
  return {};
}

// There and back again; adds the time of each tick.
Result<void> drag_one(const SolverBench& bench, Session& session, const std::string& dragged, std::vector<double>& seconds) {
  const State& state = *session.state();
  const auto position = state.plan->find(state.plan->node_index(dragged), {"node", "position", ""});
  if (!position) return Error{ErrorCode::not_found, "", "there is no node `" + dragged + "` to be dragged"};
  Vector3 place = std::get<Vector3>(state.value(*position));
  for (int t = 0; t < kPulledTicks && bench.goes_on("`" + dragged + "` dragged"); ++t) {
    place.x += t < kPulledTicks / 2 ? kPull : -kPull;
    const Command pull =
        command<SetPort>({dragged, {"node.position"}, {JsonValue::of(Json::array({place.x, place.y, place.z}))}});
    const double begin = processor_time();
    if (auto done = session.submit(pull, "bench"); !done) return done.error();
    session.tick();
    seconds.push_back(processor_time() - begin);
  }
  return {};
}

Result<void> drag_some(const SolverBench& bench, Session& session, const Scene& scene, TickGrowthRow& row) {
  std::vector<double> seconds;
  for (const std::string& volume : some_volumes(scene, kPulledVolumes))
    if (auto done = drag_one(bench, session, volume, seconds); !done) return done;
  row.seconds[kDragged] = median(seconds);
  row.dragged_hash = hex_digits(session.state()->hash);
  return {};
}

// What a session takes in memory until it is at rest; then it rests, then one volume after the other is dragged.
Result<void> time_settled(const SolverBench& bench, TickGrowthRow& row) {
  const auto scene = linked_scene(row.volumes, kTickGrowthFill);
  if (!scene) return scene.error();
  std::unique_ptr<Session> session;
  const int most = bench.options.is_quick ? 5 : kMostTicksUntilRest;
  const auto settle = [&]() -> Result<void> {
    auto started = Session::start(full_registry(), *scene, nullptr, 1);
    if (!started) return started.error();
    session = std::move(*started);
    for (int t = 0; t < most && bench.goes_on(std::to_string(row.volumes) + " volumes, coming to rest"); ++t) {
      session->tick();
      if (session->state()->due.is_nothing()) break;
    }
    return {};
  };
  Result<void> settled;
  const auto bytes = peak_bytes([&] { settled = settle(); });
  if (row.volumes >= kLeastMeasured) row.bytes = bytes;
  if (!settled) return settled;
  std::vector<double> resting;
  for (int t = 0; t < kRestingTicks && session->state()->due.is_nothing(); ++t) {
    const double begin = processor_time();
    session->tick();
    resting.push_back(processor_time() - begin);
  }
  if (!resting.empty()) row.seconds[kResting] = median(resting);
  return drag_some(bench, *session, *scene, row);
}

Result<void> draw(const std::vector<TickGrowthRow>& rows, const std::string& folder) {
  drawing::ChartPanel time{"time of a tick [ms], one thread", "volumes", {}, 0, ""};
  drawing::ChartPanel memory{"peak memory per volume [kB]", "volumes", {}, 0, ""};
  for (std::size_t c = 0; c < kTickCurves.size(); ++c) {
    drawing::ChartLine line{kTickCurves[c].label, kTickCurves[c].colour, kTickCurves[c].dashes, {}};
    for (const TickGrowthRow& row : rows)
      if (row.seconds[c]) line.points.push_back({static_cast<double>(row.volumes), 1e3 * *row.seconds[c]});
    if (!line.points.empty()) time.lines.push_back(std::move(line));
  }
  drawing::ChartLine bytes{"a session that comes to rest", "#225599", "", {}};
  for (const TickGrowthRow& row : rows)
    if (row.bytes) bytes.points.push_back({static_cast<double>(row.volumes), 1e-3 * *row.bytes / row.volumes});
  if (!bytes.points.empty()) memory.lines.push_back(std::move(bytes));
  std::error_code ignored;  // a folder that cannot be made is told by the file that cannot be written
  std::filesystem::create_directories(folder, ignored);
  return write_file(folder + "/tick_growth.svg",
                    drawing::draw_chart({"tick-growth",
                                         "Growth of ticks",
                                         "Time of a tick and peak memory per volume over the number of volumes, on logarithmic "
                                         "scales: all volumes moving, the solver alone on the same moves, one volume dragged "
                                         "among volumes at rest, and all at rest.",
                                         {time, memory}}));
}

}  // namespace

BenchTables bench_tick_growth(const SolverBench& bench) {
  std::vector<BenchTable::Column> columns = {{"volumes", "sites"}};
  for (const TickCurve& curve : kTickCurves) columns.push_back({std::string(curve.key) + " ms", std::string(curve.key) + "_ms"});
  columns.insert(columns.end(), {{"moving/alone", "ratio"},
                                 {"kB/volume", "kilobytes_per_volume"},
                                 {"hash moved", "moved_hash", true},
                                 {"hash dragged", "hash", true}});
  BenchTable table(
      "tick_growth",
      "Growth of ticks: three links to sets, filled to 70 %, one thread; alone: the solver on the same moves, to the "
      "same weights; dragged: median over nine volumes, one after the other; kB: growth of the process until all are at rest",
      columns);
  std::vector<TickGrowthRow> rows;
  for (const int count : bench.sites({100, 300, 1000, 3000, 10000, 30000}, {60})) {
    TickGrowthRow& row = rows.emplace_back();
    row.volumes = count;
    if (auto done = time_settled(bench, row); !done) return done.error();
    if (auto done = time_moving(bench, row); !done) return done.error();
    std::vector<BenchCell> cells = {figure(static_cast<std::size_t>(count))};
    add_figures(cells, row.seconds, 1e3, 4);
    cells.push_back(figure(*row.seconds[kMoving] / *row.seconds[kAlone], 2));
    cells.push_back(row.bytes ? figure(1e-3 * *row.bytes / count, 1) : no_figure());
    cells.push_back(word(row.moved_hash));
    cells.push_back(word(row.dragged_hash));
    table.add(std::move(cells));
  }
  if (!bench.options.chart.empty()) {
    if (auto drawn = draw(rows, bench.options.chart); !drawn) return drawn.error();
  }
  return std::vector<BenchTable>{table};
}

}  // namespace bl::cli::bench
