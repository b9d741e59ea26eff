// A district at work as a scene: the whole tick is measured, with what the traffic network takes of it.
#include "tests/bench/solver_bench_district.h"

#include <cmath>

#include "core/base/hash.h"
#include "core/graph/simulation.h"
#include "core/reading/views/traffic.h"

namespace bl::cli::bench {

namespace {

constexpr int kSide = 25;               // junctions along each side, 100 m apart
constexpr int kFirst = 20;              // ticks from nothing to rest
constexpr double kTrips[] = {50, 120};  // that leave each zone in an hour: streets with room to spare, and full ones

std::string padded(int number) { return (number < 10 ? "0" : "") + std::to_string(number); }

Scene grid_of(int zones, double trips) {
  Scene scene;
  const auto name = [](int x, int y) { return "j" + padded(x) + "_" + padded(y); };
  const auto street = [&](const std::string& id, const std::string& from, const std::string& to) {
    scene.nodes[id].types["node"];
    scene.nodes[id].types["street"] = {{"start", Shared<Selection>(Selection{{from}, "", ""})},
                                       {"end", Shared<Selection>(Selection{{to}, "", ""})}};
  };
  for (int x = 0; x < kSide; ++x)
    for (int y = 0; y < kSide; ++y) {
      NodeRecord& node = scene.nodes[name(x, y)];
      node.types["node"]["position"] = Vector3{100.0 * x, 100.0 * y, 0};
      node.types["junction"];
      if (zones > 0 && (x + y) % 2 == 0) {
        node.types["traffic_zone"] = {{"trips_out", trips}, {"trips_in", trips}};
        --zones;
      }
      if (x > 0) street("e" + padded(x) + "_" + padded(y), name(x - 1, y), name(x, y));
      if (y > 0) street("n" + padded(x) + "_" + padded(y), name(x, y - 1), name(x, y));
    }
  scene.nodes["network"].types["node"];
  scene.nodes["network"].types["traffic_network"];
  return scene;
}

// As volumes that settle do: each zone's trips swing by a fifth, out of step with its neighbours'.
void move_trips(Scene& scene, double trips, int tick) {
  int zone = 0;
  for (const auto& [id, node] : SharedMap(scene.nodes))
    if (node.types.contains("traffic_zone"))
      scene.nodes.edit(id).types["traffic_zone"]["trips_out"] = trips * (1 + 0.2 * std::sin(0.3 * tick + ++zone));
}

double gap_of(const State& state) {
  return reading::read<&reading::NetworkFigures::relative_gap>(state, state.plan->node_index("network"));
}

}  // namespace

Result<BenchTable> bench_districts(const SolverBench& bench) {
  BenchTable table{"districts",
                   "Ticks of a scene of 625 junctions while the trips of all zones change before each; the edits are not counted",
                   {{"zones", "zones"},
                    {"trips/h each", "trips"},
                    {"ticks", "ticks"},
                    {"ms at rest", "rest_milliseconds"},
                    {"ms moving", "moving_milliseconds"},
                    {"of it the network", "network_milliseconds"},
                    {"gap", "gap"},
                    {"hash", "hash", true}}};
  const int ticks = bench.options.is_quick ? 5 : 20;
  for (const int zones : bench.options.is_quick ? std::vector<int>{100} : std::vector<int>{100, 300})
    for (const double trips : kTrips) {
      Scene scene = grid_of(zones, trips);
      Simulation simulation(full_registry(), 1, processor_time);
      simulation.set_scene(scene);
      for (int tick = 0; tick < kFirst; ++tick) simulation.step();
      double resting = -processor_time();
      for (int tick = 0; tick < ticks; ++tick) simulation.step();
      resting += processor_time();
      const double before = simulation.times().solve;
      double moving = 0;
      for (int tick = 0; tick < ticks; ++tick) {
        if (!bench.goes_on("a district of " + std::to_string(zones) + " zones"))
          return Error{ErrorCode::cancelled, "", "stopped"};
        move_trips(scene, trips, tick);
        simulation.set_scene(scene);
        moving -= processor_time();
        simulation.step();
        moving += processor_time();
      }
      const auto state = simulation.state();
      const auto each = [&](double seconds) { return figure(1000 * seconds / ticks, 2); };
      table.add({figure(static_cast<std::size_t>(zones)), figure(trips, 0), figure(static_cast<std::size_t>(ticks)),
                 each(resting), each(moving), each(simulation.times().solve - before), tiny(gap_of(*state)),
                 word(hex_digits(state->hash))});
    }
  return table;
}

}  // namespace bl::cli::bench
