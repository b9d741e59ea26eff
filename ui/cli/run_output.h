// The results of a run: tables for people, JSON for programs.
#pragma once

#include <string>
#include <string_view>

#include "core/define/json_text.h"
#include "core/graph/state.h"
#include "core/reading/survey.h"

namespace bl::cli {

/// The message where there are no figures, since figures are those of the last tick.
inline constexpr std::string_view kNothingComputed = "nothing has been computed yet; run a tick or more";

/// Empty for a scene that has not run a tick.
void print_survey(const reading::Survey& survey, const State& state);

/// The content of --json. `outcome`: the last line of the run.
Json survey_json(const reading::Survey& survey, const State& state, const std::string& outcome);

}  // namespace bl::cli
