// How a run is told: as tables to people, as JSON to programs.
#pragma once

#include <string>

#include "core/define/json_text.h"
#include "core/graph/state.h"
#include "ui/cli/survey.h"

namespace bl::cli {

void print_survey(const Survey& survey, const State& state);

/// The content of --json. `outcome`: the last line of the run.
Json survey_json(const Survey& survey, const State& state, const std::string& outcome);

}  // namespace bl::cli
