// The bench's --times: where the time of the ticks of a scene goes.
#pragma once

#include <vector>

#include "tests/bench/bench_command.h"

namespace bl::cli::bench {

/// Gives the exit code.
int times_bench(const std::vector<BenchCase>& cases, const BenchOptions& options);

}  // namespace bl::cli::bench
