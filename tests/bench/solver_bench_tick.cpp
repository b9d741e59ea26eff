// Rows of whole ticks: while all negotiate, at rest, and while one volume is dragged, against a tick that evaluates everything.
#include <algorithm>
#include <memory>

#include <nlohmann/json.hpp>

#include "core/base/hash.h"
#include "core/base/text.h"
#include "core/session/commands.h"
#include "core/session/session.h"
#include "tests/bench/random_scene.h"
#include "tests/bench/solver_bench_rows.h"

namespace bl::cli::bench {

namespace {

constexpr int kMostTicksToRest = 4000, kNegotiation = 15, kFrames = 60;
constexpr double kTickFills[] = {0.7, 0.95, 1};
constexpr double kDragStep = 0.2;  // [m]

// One session as people have it, and one of the same scene that evaluates everything.
struct Rivals {
  std::unique_ptr<Session> session, everything;
};

Result<Rivals> rivals_of(const Scene& scene, int threads) {
  Rivals rivals;
  for (auto* one : {&rivals.session, &rivals.everything}) {
    auto started = Session::start(full_registry(), scene, nullptr, threads);
    if (!started) return started.error();
    *one = std::move(*started);
  }
  rivals.everything->evaluate_everything(true);
  return rivals;
}

struct Times {
  std::vector<double> tick, everything;
};

// One tick of both, each after its command; the two have to agree.
Result<void> tick_both(Rivals& rivals, const Command* command, int threads, Times& times) {
  for (const auto& [session, list] :
       {std::pair{rivals.session.get(), &times.tick}, {rivals.everything.get(), &times.everything}}) {
    const Clocks before = clocks_now();
    if (command != nullptr)
      if (auto done = session->submit(*command, "bench"); !done) return done.error();
    session->tick();
    const Clocks after = clocks_now();
    list->push_back(after.of(threads) - before.of(threads));
  }
  if (rivals.session->state()->hash == rivals.everything->state()->hash) return {};
  return Error{ErrorCode::internal, "",
               "the tick that evaluates what has changed comes to another state than the one that evaluates all"};
}

BenchTable table_of_ticks() {
  return {"tick",
          "Ticks of volumes with three links to sets, against the same ticks with everything evaluated",
          {{"case", "case", true},
           {"fill %", "fill_percent"},
           {"volumes", "sites"},
           {"threads", "threads"},
           {"median ms", "median_ms"},
           {"p95 ms", "p95_ms"},
           {"everything ms", "everything_ms"},
           {"ratio", "ratio"},
           {"hash", "hash", true}}};
}

void add_row(BenchTable& table, const std::string& name, double fill, int count, int threads, Times times, const State& state) {
  std::sort(times.tick.begin(), times.tick.end());
  const double mine = median(times.tick), all = median(times.everything), late = times.tick[times.tick.size() * 95 / 100];
  table.add({word(name), figure(100 * fill, 0), figure(static_cast<std::size_t>(count)),
             figure(static_cast<std::size_t>(threads)), figure(1000 * mine, 4), figure(1000 * late, 4), figure(1000 * all, 3),
             figure(mine / all, 5), word(hex_digits(state.hash))});
}

struct Case {
  const Scene& scene;
  double fill;
  int count, threads;
};

// Each frame of it after a command: the volume in the middle of the list moves, or wants something else.
Result<void> time_commands(const SolverBench& bench, Rivals& rivals, const Case& one, BenchTable& table) {
  const auto middle = std::next(one.scene.nodes.begin(), static_cast<std::ptrdiff_t>(one.scene.nodes.size() / 2));
  const std::string dragged = middle->first;
  const State& rest = *rivals.session->state();
  const std::uint32_t node = rest.plan->node_index(dragged);
  Vector3 place = std::get<Vector3>(rest.value(*rest.plan->find(node, {"node", "position", ""})));
  const double demand = as_number(rest.value(*rest.plan->find(node, {"smart_volume", "demand", ""})));
  Times drag, demanded;
  for (int t = 0; t < kFrames && bench.goes_on("ticks, one dragged"); ++t) {
    place.x += t < kFrames / 2 ? kDragStep : -kDragStep;
    const Command move =
        command<SetPort>({dragged, {"node.position"}, {JsonValue::of(Json::array({place.x, place.y, place.z}))}});
    if (auto done = tick_both(rivals, &move, one.threads, drag); !done) return done;
  }
  add_row(table, "one dragged", one.fill, one.count, one.threads, drag, *rivals.session->state());
  for (int t = 0; t < kFrames && bench.goes_on("ticks, one demand changed"); ++t) {
    const Command wish =
        command<SetPort>({dragged, {"smart_volume.demand"}, {JsonValue::of(Json(demand * (1 - 0.01 * (t % 20))))}});
    if (auto done = tick_both(rivals, &wish, one.threads, demanded); !done) return done;
  }
  add_row(table, "a demand changed", one.fill, one.count, one.threads, demanded, *rivals.session->state());
  return {};
}

Result<void> time_case(const SolverBench& bench, const Case& one, BenchTable& table) {
  const std::string what = "ticks of " + std::to_string(one.count) + " volumes";
  auto rivals = rivals_of(one.scene, one.threads);
  if (!rivals) return rivals.error();
  rivals->session->tick(), rivals->everything->tick();  // the first one finds all volumes without a weight
  Times negotiation, rest, waiting;
  for (int t = 0; t < kNegotiation && bench.goes_on(what + ", negotiating"); ++t)
    if (auto done = tick_both(*rivals, nullptr, one.threads, negotiation); !done) return done;
  add_row(table, "all negotiate", one.fill, one.count, one.threads, negotiation, *rivals->session->state());
  // Both get to rest together; what the slower one takes for that is not measured.
  const int most = bench.options.is_quick ? 5 : kMostTicksToRest;
  for (int t = 0; t < most && !rivals->session->state()->due.is_nothing() && bench.goes_on(what + ", coming to rest"); ++t)
    rivals->session->tick();
  while (rivals->everything->state()->tick < rivals->session->state()->tick && bench.goes_on(what + ", the rival"))
    rivals->everything->tick();
  for (int t = 0; t < kFrames && bench.goes_on(what + ", at rest"); ++t)
    if (auto done = tick_both(*rivals, nullptr, one.threads, rest); !done) return done;
  const bool is_at_rest = rivals->session->state()->due.is_nothing();
  add_row(table, is_at_rest ? "at rest" : "settling", one.fill, one.count, one.threads, rest, *rivals->session->state());
  return time_commands(bench, *rivals, one, table);
}

}  // namespace

BenchTables bench_tick(const SolverBench& bench) {
  BenchTable table = table_of_ticks();
  for (const int count : bench.sites({100, 1000}, {60}))
    for (const double fill : kTickFills) {
      const auto scene = linked_scene(count, fill);
      if (!scene) return scene.error();
      for (const int threads : bench.threads())
        if (auto done = time_case(bench, {*scene, fill, count, threads}, table); !done) return done.error();
    }
  return std::vector<BenchTable>{std::move(table)};
}

}  // namespace bl::cli::bench
