// `bench --solver`: the solver by itself, against the plain triangulation and Voro++ on the same sites in the same run.
#pragma once

#include "tests/bench/bench_command.h"
#include "ui/cli/commands.h"

namespace bl::cli::bench {

/// Measures all rows, or those that were asked for; prints each kind as soon as it is done.
int solver_bench(const BenchOptions& options);

}  // namespace bl::cli::bench
