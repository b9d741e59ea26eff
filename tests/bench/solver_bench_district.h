// Rows of a district whose trips move, tick by tick.
#pragma once

#include "tests/bench/solver_bench_rows.h"

namespace bl::cli::bench {

/// Ticks of a scene of 25 by 25 junctions, with 100 and 300 zones whose trips change a little before each tick; cancelled where
/// somebody stops it.
Result<BenchTable> bench_districts(const SolverBench& bench);

}  // namespace bl::cli::bench
