// The cases that `cells` and `fit` read: a boundary, sites and, for a fit, what each of them is to have.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/geometry/volume_fit.h"
#include "ui/cli/boundary_fields.h"

namespace bl::cli {

enum class CasePurpose { cells, fit };

struct SiteCase {
  std::string place;  ///< "cases/3" in a list, else empty
  BoundaryReading boundary;
  geometry::FitProblem problem;    ///< without demands where only cells are wanted
  std::vector<std::string> names;  ///< what people call the sites; empty: nothing but their numbers
};

struct SiteCases {
  std::vector<SiteCase> cases;
  bool is_list = false;  ///< {"cases": [...]}: the output is a list as well
};

/// What a text holds, or everything that is wrong with it.
struct CaseReading {
  SiteCases content;
  std::vector<std::string> notes;  ///< what was assumed, one sentence each
  std::vector<Error> errors;       ///< any: the content is not to be used
};

/// `boundary`: of cases without one of their own; may be null.
CaseReading read_site_cases(const std::string& text, bool is_table, const BoundaryReading* boundary, CasePurpose purpose);
/// A boundary alone, or that of a case.
Result<BoundaryReading> read_boundary(const std::string& text);

struct CaseFiles {
  std::string input;     ///< JSON; a table where the name ends in .csv, .tsv or .txt
  std::string boundary;  ///< JSON of a boundary, for input without one; may be empty
  std::string output;    ///< must be none of the others
};

/// All cases, or nothing after everything that is wrong with them was printed.
std::optional<SiteCases> load_site_cases(const CaseFiles& files, CasePurpose purpose);

}  // namespace bl::cli
