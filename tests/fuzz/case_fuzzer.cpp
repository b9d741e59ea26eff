// Feeds bytes to the reader of the cases of `cells` and `fit`; what it accepts must be measured and fitted without a fault.
#include <cmath>
#include <cstdint>
#include <string>

#include "core/geometry/power_cells.h"
#include "tests/fuzz/require.h"
#include "ui/cli/site_case.h"

namespace {

using bl::cli::CasePurpose;
using bl::fuzz::require;

// Work is bounded, so that the fuzzer looks for faults and not for patience.
bool is_small(const bl::cli::SiteCase& c) { return c.problem.sites.size() <= 40 && c.boundary.domain.pieces.size() <= 20; }

void solve(const bl::cli::SiteCase& c, CasePurpose purpose) {
  if (!is_small(c)) return;
  const std::size_t count = c.problem.sites.size();
  require(c.names.empty() || c.names.size() == count, "each site has a name, or none has");
  if (purpose == CasePurpose::cells) {
    const auto cells = bl::geometry::power_cells(c.boundary.domain, c.problem.sites, {.with_shape = false});
    require(cells.ok() && cells->size() == count, "every site gets a record");
    return;
  }
  bl::geometry::VolumeFitOptions options;
  options.most_steps = 4;
  const auto fit = bl::geometry::fit_volumes(c.boundary.domain, c.problem, options);
  require(fit.ok(), "what the reader accepts can be fitted");
  require(fit->weights.size() == count && fit->evaluations <= 4, "every site is accounted for, in so many steps");
  for (const double weight : fit->weights) require(std::isfinite(weight), "weights are finite");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
  const CasePurpose purpose = (data[0] & 1u) != 0 ? CasePurpose::fit : CasePurpose::cells;
  bl::cli::BoundaryReading box;
  box.domain = bl::geometry::convex_hull(std::vector<bl::Point3>{{0, 0, 0}, {9, 0, 0}, {0, 9, 0}, {0, 0, 9}}).value();
  const bool is_table = (data[0] & 2u) != 0, has_boundary = (data[0] & 4u) != 0;
  const bl::cli::CaseReading reading = bl::cli::read_site_cases(text, is_table, has_boundary ? &box : nullptr, purpose);
  for (const bl::Error& error : reading.errors) require(!error.message.empty(), "an error without a sentence");
  if (!reading.errors.empty()) return 0;
  for (const bl::cli::SiteCase& c : reading.content.cases) solve(c, purpose);
  return 0;
}
