// The cases that `cells` and `fit` read: a boundary, sites and, for a fit, their demands.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/geometry/footprint.h"
#include "core/geometry/volume_fit.h"
#include "ui/cli/boundary_fields.h"

namespace bl::cli {

enum class CasePurpose { cells, fit };

struct SiteCase {
  std::string place;  ///< "cases/3" in a list, else empty
  BoundaryReading boundary;
  geometry::FitProblem problem;                  ///< without demands where only cells are wanted
  std::vector<geometry::StandingSite> standing;  ///< one for each site where the volumes stand; empty: they are balls
  std::vector<geometry::StreetAxis> streets;     ///< sides of the plot along them have distances of their own
  std::vector<std::string> names;                ///< names of the sites; empty: they have numbers only
  std::vector<std::string> notes;                ///< what may surprise, one sentence each, with its place
};

struct SiteCases {
  std::vector<SiteCase> cases;
  bool is_list = false;  ///< {"cases": [...]}: the output is a list as well
};

/// The cases of a text, or all of its errors.
struct CaseReading {
  SiteCases content;
  std::vector<std::string> notes;  ///< what was assumed, one sentence each
  std::vector<Error> errors;       ///< where there are any, the content must not be used
};

/// `boundary`: for cases without one of their own; may be null.
CaseReading read_site_cases(const std::string& text, bool is_table, const BoundaryReading* boundary, CasePurpose purpose);
/// A boundary alone, or that of a case.
Result<BoundaryReading> read_boundary(const std::string& text);

struct CaseFiles {
  std::string input;     ///< JSON; a table where the name ends in .csv, .tsv or .txt
  std::string boundary;  ///< JSON of a boundary, for input without one; may be empty
  std::string output;    ///< must differ from the other files
};

/// All cases, or nothing after all of their errors were printed.
std::optional<SiteCases> load_site_cases(const CaseFiles& files, CasePurpose purpose);

}  // namespace bl::cli
