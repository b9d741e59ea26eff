// What the bench is told, and the function that measures it and gives the exit code.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/file/scene_file.h"

namespace bl::cli::bench {

struct BenchOptions {
  std::vector<std::string> scenes;
  std::vector<int> sites, threads;
  int repeat = 0;  ///< 0: what suits the rows
  int ticks = 20;
  std::string json;
  bool is_times = false;                     ///< where the time of a tick goes, instead of rows beside rivals
  bool is_solver = false, is_quick = false;  ///< the solver alone; small sizes only
  std::vector<std::string> rows;             ///< of the solver's rows these only; empty: all
  int seeds = 0;                             ///< of the solver's cold fits: so many random sets besides
  std::vector<double> fills;                 ///< [%] of the solver's ticks these only; empty: all
  std::string tntp;                          ///< folder of networks for the rows of traffic; empty: made-up ones only
  std::string chart;                         ///< folder for the solver's charts; empty: none
};

/// A scene to measure.
struct BenchCase {
  std::string name;
  Scene scene;
  std::optional<SavedState> state;
};

int bench_command(const BenchOptions& options);

}  // namespace bl::cli::bench
