// The fits that several kinds of rows measure.
#pragma once

#include "core/geometry/fit_problem.h"
#include "tests/bench/solver_bench_rows.h"

namespace bl::cli::bench {

/// Random sites in the unit cube without weights, with random demands that fill so much of it.
geometry::FitProblem fit_problem(int count, double fill, std::uint64_t seed = 20070);

}  // namespace bl::cli::bench
