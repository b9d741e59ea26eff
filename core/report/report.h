// The report of a run: one page for people, a table and a mesh file for programs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/graph/state.h"
#include "core/reading/error_sample.h"

namespace bl::report {

struct ReportData {
  const State* state = nullptr;
  std::vector<reading::ErrorSample> history;  ///< ascending tick; may be empty
  std::string scene_path;                     ///< as it was typed
  std::string outcome;                        ///< the last line of the run
};

/// Writes report.html, volumes.obj and tables (volumes.csv, uses.csv, conflicts.csv, and one for each kind of thing that the
/// scene has, such as streets.csv) into `directory`, which is made where it is missing; what others have put there is not
/// written over (`may_fill_with_report`). The files depend on `data` alone: no
/// clock, no locale, no machine.
Result<void> write_report(const std::string& directory, const ReportData& data);

/// Checks that a report overwrites no other file in `directory`: files under its names must be empty or of an earlier report. A
/// missing folder is accepted.
Result<void> may_fill_with_report(const std::string& directory);

}  // namespace bl::report
