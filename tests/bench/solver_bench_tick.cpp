// Rows of whole ticks: while all negotiate, at rest, and while one volume is dragged, against a tick that evaluates everything.
#include <algorithm>
#include <filesystem>
#include <memory>

#include <nlohmann/json.hpp>

#include "core/base/hash.h"
#include "core/base/text.h"
#include "core/session/commands.h"
#include "core/session/session.h"
#include "tests/bench/random_scene.h"
#include "tests/bench/solver_bench_rows.h"
#include "ui/cli/scene_loading.h"

namespace bl::cli::bench {

namespace {

constexpr double kReadingFill = 0.7;  // of volumes among which a sensor speaks
constexpr int kMostTicksToRest = 4000, kNegotiation = 15, kFrames = 60;
constexpr int kPulls = 20;  // of each volume that is dragged
// Frames that one session takes before its rival: with one each, both would find the other's memory in the caches. The first
// frame of a turn still does, and so has a column of its own: people who drag something have no rival between two frames.
constexpr int kTurn = kPulls;
constexpr double kDragStep = 0.2;  // [m]
constexpr std::size_t kDraggedVolumes = 5;
constexpr const char* kStudy = "scenes/studies/urban_mode.json";
constexpr int kStudyTicks = 400;

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

// Of the frames after the first of each turn, and of the first ones [s].
struct Frames {
  std::vector<double> later, first;
};
struct Times {
  Frames tick, everything;
};

using Frame = std::optional<Command>;

// One session's turn: a tick per frame, after the command of the frame or none. The hash after each tick is returned.
Result<std::vector<std::uint64_t>> take_turn(Session& session, const std::vector<Frame>& frames, int threads, Frames& times) {
  std::vector<std::uint64_t> hashes;
  for (const Frame& frame : frames) {
    const Clocks before = clocks_now();
    if (frame)
      if (auto done = session.submit(*frame, "bench"); !done) return done.error();
    session.tick();
    const Clocks after = clocks_now();
    (hashes.empty() ? times.first : times.later).push_back(after.of(threads) - before.of(threads));
    hashes.push_back(session.state()->hash);
  }
  return hashes;
}

// The same frames by both, one after the other; the two have to agree after each tick.
Result<void> turn_of_both(Rivals& rivals, const std::vector<Frame>& frames, int threads, Times& times) {
  const auto mine = take_turn(*rivals.session, frames, threads, times.tick);
  if (!mine) return mine.error();
  const auto all = take_turn(*rivals.everything, frames, threads, times.everything);
  if (!all) return all.error();
  if (*mine == *all) return {};
  return Error{ErrorCode::internal, "",
               "a tick that evaluates what has changed comes to another state than the one that evaluates all"};
}

BenchTable table_of_ticks() {
  return {"tick",
          "Ticks of volumes with three links to sets, and of a study, against the same ticks with everything evaluated",
          {{"case", "case", true},
           {"fill %", "fill_percent"},
           {"volumes", "sites"},
           {"threads", "threads"},
           {"median ms", "median_ms"},
           {"p95 ms", "p95_ms"},
           {"first ms", "first_ms"},
           {"everything ms", "everything_ms"},
           {"ratio", "ratio"},
           {"hash", "hash", true}}};
}

void add_row(BenchTable& table, const std::string& name, double fill, int count, int threads, Times times, const State& state) {
  std::vector<double>& later = times.tick.later;
  std::sort(later.begin(), later.end());
  const double mine = median(later), all = median(times.everything.later), late = later[later.size() * 95 / 100];
  table.add({word(name), figure(100 * fill, 0), figure(static_cast<std::size_t>(count)),
             figure(static_cast<std::size_t>(threads)), figure(1000 * mine, 4), figure(1000 * late, 4),
             figure(1000 * median(times.tick.first), 4), figure(1000 * all, 3), figure(mine / all, 5),
             word(hex_digits(state.hash))});
}

struct Case {
  const Scene& scene;
  double fill;
  int count, threads;
};

// Frames of one kind in turns; `of_frame` gives the command of each frame.
template <class OfFrame>
Result<void> time_frames(const SolverBench& bench, Rivals& rivals, const Case& one, const std::string& name, BenchTable& table,
                         const OfFrame& of_frame, int count = kFrames) {
  Times times;
  for (int t = 0; t < count && bench.goes_on("ticks, " + name);) {
    std::vector<Frame> frames;
    for (const int end = std::min(t + kTurn, count); t < end; ++t) frames.push_back(of_frame(t));
    if (auto done = turn_of_both(rivals, frames, one.threads, times); !done) return done;
  }
  add_row(table, name, one.fill, one.count, one.threads, std::move(times), *rivals.session->state());
  return {};
}

Frame nothing(int) { return std::nullopt; }

// Some volumes, one after the other, are pulled there and back again.
Result<void> time_drag(const SolverBench& bench, Rivals& rivals, const Case& one, const std::string& name, BenchTable& table) {
  const std::vector<std::string> dragged = some_volumes(one.scene, kDraggedVolumes);
  Vector3 place;
  return time_frames(
      bench, rivals, one, name, table,
      [&](int t) -> Frame {
        const std::string& volume = dragged[static_cast<std::size_t>(t / kPulls)];
        const State& state = *rivals.session->state();
        if (t % kPulls == 0)
          place = std::get<Vector3>(state.value(*state.plan->find(state.plan->node_index(volume), {"node", "position", ""})));
        place.x += t % kPulls < kPulls / 2 ? kDragStep : -kDragStep;
        return command<SetPort>({volume, {"node.position"}, {JsonValue::of(Json::array({place.x, place.y, place.z}))}});
      },
      kPulls* static_cast<int>(dragged.size()));
}

// Each frame of it after a command: a volume moves, or the one in the middle of the list wants something else.
Result<void> time_commands(const SolverBench& bench, Rivals& rivals, const Case& one, BenchTable& table) {
  if (auto done = time_drag(bench, rivals, one, "one dragged", table); !done) return done;
  const std::string wanting = some_volumes(one.scene, 1).front();
  const State& state = *rivals.session->state();
  const double demand =
      as_number(state.value(*state.plan->find(state.plan->node_index(wanting), {"smart_volume", "demand", ""})));
  return time_frames(bench, rivals, one, "a demand changed", table, [&](int t) -> Frame {
    return command<SetPort>({wanting, {"smart_volume.demand"}, {JsonValue::of(Json(demand * (1 - 0.01 * (t % 20))))}});
  });
}

// Both come to rest together, or to where they would go on for ever; what the slower one takes for that is not measured.
void settle(const SolverBench& bench, Rivals& rivals, int most, const std::string& what) {
  for (int t = 0; t < most && !rivals.session->state()->due.is_nothing() && bench.goes_on(what + ", coming to rest"); ++t)
    rivals.session->tick();
  while (rivals.everything->state()->tick < rivals.session->state()->tick && bench.goes_on(what + ", the rival"))
    rivals.everything->tick();
}

// A study as it is, after some ticks: the one that was named, or that with everything that a city has to say. In that one a
// sensor's reading is a tick older in every tick.
Result<void> time_study(const SolverBench& bench, int threads, BenchTable& table) {
  const std::string file = bench.options.scenes.empty() ? kStudy : bench.options.scenes.front();
  const auto reading = load_scene(file);
  if (!reading) return Error{ErrorCode::parse, file, "this scene cannot be measured"};
  const std::vector<std::string> volumes = some_volumes(reading->scene, reading->scene.nodes.size());
  if (volumes.empty()) return Error{ErrorCode::missing, file, "there is no volume in it that could be dragged"};
  const Case one{reading->scene, 0, static_cast<int>(volumes.size()), threads};
  auto rivals = rivals_of(one.scene, threads);
  if (!rivals) return rivals.error();
  settle(bench, *rivals, bench.options.is_quick ? 5 : kStudyTicks, "ticks of the study");
  const std::string name = std::filesystem::path(file).stem().string();
  if (auto done = time_frames(bench, *rivals, one, name, table, nothing); !done) return done;
  return time_drag(bench, *rivals, one, name + ", one dragged", table);
}

// A sensor among volumes at rest.
Result<void> time_readings(const SolverBench& bench, int count, int threads, BenchTable& table) {
  auto scene = linked_scene(count, kReadingFill);
  if (!scene) return scene.error();
  scene->nodes["sensor"].types = {{"node", {}}, {"sensor", {{"timeout", 0.0}}}};
  const Case one{*scene, kReadingFill, count, threads};
  auto rivals = rivals_of(one.scene, threads);
  if (!rivals) return rivals.error();
  settle(bench, *rivals, bench.options.is_quick ? 5 : kMostTicksToRest, "ticks with a sensor");
  const std::int64_t begin = rivals->session->state()->tick;
  return time_frames(bench, *rivals, one, "a reading", table, [&](int t) -> Frame {
    const auto set = [](const char* port, const Json& value) {
      return command<SetPort>({"sensor", {port}, JsonValue::of(value)});
    };
    const std::vector<Command> commands{set("sensor.reading", 20 + 0.1 * t), set("sensor.reading_tick", begin + t)};
    return command<Batch>({commands});
  });
}

Result<void> time_case(const SolverBench& bench, const Case& one, BenchTable& table) {
  const std::string what = "ticks of " + std::to_string(one.count) + " volumes";
  auto rivals = rivals_of(one.scene, one.threads);
  if (!rivals) return rivals.error();
  rivals->session->tick(), rivals->everything->tick();  // the first one finds all volumes without a weight
  if (auto done = time_frames(bench, *rivals, one, "all negotiate", table, nothing, kNegotiation); !done) return done;
  settle(bench, *rivals, bench.options.is_quick ? 5 : kMostTicksToRest, what);
  const bool is_at_rest = rivals->session->state()->due.is_nothing();
  if (auto done = time_frames(bench, *rivals, one, is_at_rest ? "at rest" : "settling", table, nothing); !done) return done;
  return time_commands(bench, *rivals, one, table);
}

}  // namespace

BenchTables bench_tick(const SolverBench& bench) {
  BenchTable table = table_of_ticks();
  const std::vector<double> fills = bench.options.fills.empty() ? std::vector<double>{70, 95, 100} : bench.options.fills;
  for (const int count : bench.sites({100, 1000}, {60}))
    for (const double fill_percent : fills) {
      const double fill = fill_percent / 100;
      const auto scene = linked_scene(count, fill);
      if (!scene) return scene.error();
      for (const int threads : bench.threads())
        if (auto done = time_case(bench, {*scene, fill, count, threads}, table); !done) return done.error();
    }
  for (const int threads : bench.threads()) {
    for (const int count : bench.sites({1000}, {60}))
      if (auto done = time_readings(bench, count, threads, table); !done) return done.error();
    if (auto done = time_study(bench, threads, table); !done) return done.error();
  }
  return std::vector<BenchTable>{std::move(table)};
}

}  // namespace bl::cli::bench
