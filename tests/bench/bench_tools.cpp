// Clocks and memory come from the system; the figures of a bench are the only results of the program that depend on them.
#include "tests/bench/bench_tools.h"

#include <ctime>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <thread>
#include <variant>
#if defined(BL_JEMALLOC)
#include <jemalloc/jemalloc.h>
#elif defined(__GLIBC__)
#include <malloc.h>
#endif

#include "core/base/text.h"
#include "core/geometry/domain_table.h"
#include "core/reading/views/solver.h"
#include "core/reading/views/volume.h"
#include "ui/cli/scene_loading.h"
#include "ui/cli/terminal.h"

namespace bl::cli::bench {

namespace {

// The value behind `key:` in a file of the system that has one such line each; empty where there is none.
std::string system_value(const char* file, std::string_view key) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t colon = line.find(':');
    if (!line.starts_with(key) || colon == std::string::npos) continue;
    const std::size_t begin = line.find_first_not_of(" \t", colon + 1);
    return begin == std::string::npos ? "" : line.substr(begin);
  }
  return "";
}

// What was freed before a measurement is not counted as held.
void give_back_free_memory() {
#if defined(BL_JEMALLOC)
  const std::string all_arenas = "arena." + std::to_string(MALLCTL_ARENAS_ALL);
  mallctl("thread.tcache.flush", nullptr, nullptr, nullptr, 0);
  mallctl((all_arenas + ".purge").c_str(), nullptr, nullptr, nullptr, 0);
#elif defined(__GLIBC__)
  malloc_trim(0);
#endif
}

// In bytes; the system writes "1234 kB".
std::optional<double> own_memory(std::string_view key) {
  std::istringstream text(system_value("/proc/self/status", key));
  double kilobytes = 0;
  if (!(text >> kilobytes)) return std::nullopt;
  return 1024 * kilobytes;
}

std::string compiler_name() {
#if defined(__clang__)
  return "clang++ " + std::to_string(__clang_major__) + "." + std::to_string(__clang_minor__);
#elif defined(__GNUC__)
  return "g++ " + std::to_string(__GNUC__) + "." + std::to_string(__GNUC_MINOR__);
#else
  return "an unknown compiler";
#endif
}

Clocks time_of(const Contender& contender, int calls) {
  Clocks sum;
  // Without preparation all calls are one measurement: some are shorter than a look at the clock.
  const int parts = contender.prepare ? calls : 1;
  for (int part = 0; part < parts; ++part) {
    if (contender.prepare) contender.prepare();
    const Clocks before = clocks_now();
    for (int k = 0; k < calls / parts; ++k) contender.work();
    const Clocks after = clocks_now();
    sum.wall += after.wall - before.wall;
    sum.processor += after.processor - before.processor;
  }
  return {sum.wall / calls, sum.processor / calls};
}

}  // namespace

double median_seconds(int repeat, const std::function<void()>& work) {
  std::vector<double> seconds;
  for (int r = 0; r < repeat; ++r) {
    const double began = now();
    work();
    seconds.push_back(now() - began);
  }
  return median(std::move(seconds));
}

double processor_time() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

Clocks clocks_now() { return {now(), processor_time()}; }

void take_turns(std::vector<Contender>& contenders, int rounds, double turn_seconds, const std::function<bool()>& next) {
  std::vector<std::vector<double>> wall(contenders.size()), processor(contenders.size());
  std::vector<int> calls(contenders.size(), 0);
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t c = 0; c < contenders.size(); ++c) {
      if (!next()) return;
      const bool is_first = calls[c] == 0;
      if (is_first) calls[c] = 1;
      Clocks each = time_of(contenders[c], calls[c]);
      if (is_first && each.wall < turn_seconds) {  // that one filled caches, and says how many of them are a turn
        calls[c] = static_cast<int>(std::clamp(turn_seconds / std::max(1e-7, each.wall), 1.0, 1e5));
        each = time_of(contenders[c], calls[c]);
      }
      wall[c].push_back(each.wall);
      processor[c].push_back(each.processor);
      contenders[c].median = {median(wall[c]), median(processor[c])};
      contenders[c].least = {*std::min_element(wall[c].begin(), wall[c].end()),
                             *std::min_element(processor[c].begin(), processor[c].end())};
    }
  }
}

std::optional<double> peak_bytes(const std::function<void()>& work) {
  give_back_free_memory();
  std::ofstream("/proc/self/clear_refs") << "5";  // the peak starts anew from what is held now
  const auto before = own_memory("VmRSS"), start = own_memory("VmHWM");
  work();
  const auto peak = own_memory("VmHWM");
  // Where the peak could not be set back, it is that of something else.
  if (!before || !start || !peak || *start > *before + 1e6) return std::nullopt;
  return std::max(0.0, *peak - *before);
}

std::string machine_line() {
  const std::string model = system_value("/proc/cpuinfo", "model name");
  std::string load = "unknown";
  std::ifstream("/proc/loadavg") >> load;
#ifdef NDEBUG
  const std::string build = "optimised";
#else
  const std::string build = "with assertions";
#endif
  return "Machine: " + (model.empty() ? "unknown processor" : model) + ", " +
         counted(std::thread::hardware_concurrency(), "core") + ", load " + load + "; " + compiler_name() + ", " + build + ".";
}

std::vector<geometry::PowerSite> sites_of(const State& state) {
  std::vector<geometry::PowerSite> sites;
  for (const auto& [node, volume] : reading::rows<reading::VolumeFigures>(state))
    sites.push_back({volume.position, volume.weight});
  return sites;
}

std::optional<geometry::Domain> domain_of(const State& state) {
  std::optional<geometry::Domain> found;
  for (const auto& [node, boundary] : reading::rows<reading::BoundaryFigures>(state)) {
    if (found) return std::nullopt;  // several plots: there is no one domain to measure
    auto domain = geometry::read_domain(*boundary.planes);
    if (!domain) return std::nullopt;
    found = std::move(*domain);
  }
  return found;
}

}  // namespace bl::cli::bench
