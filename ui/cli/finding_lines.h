// Findings of a check or a rehearsal as lines on the terminal.
#pragma once

#include <vector>

#include "core/serve/readiness.h"

namespace bl::cli {

/// Prints a line for each; whether one of them is bad.
bool print_findings(const std::vector<serve::Finding>& findings);

}  // namespace bl::cli
