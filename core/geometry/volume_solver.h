// The incremental fit: sites are moved, added and removed, and demands change, while every volume keeps its demand.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "core/base/parallel.h"
#include "core/base/result.h"
#include "core/geometry/domain.h"
#include "core/geometry/volume_fit.h"

namespace bl::geometry {

struct SolveOptions {
  double tolerance = 1e-3;  ///< of the largest relative error
  int most_rounds = 30;     ///< of a local solve; after them everything is fitted anew
  ThreadPool* pool = nullptr;
};

/// The work of a solve.
struct SolveReport {
  FitStatus status = FitStatus::met;
  double error = 0;  ///< largest relative error; of cells that were not made anew, with their volumes as predicted
  int rounds = 0;    ///< linear systems solved
  std::size_t cells_made = 0;
  bool was_local = true;  ///< false: all sites were fitted anew
  std::vector<std::string> reasons;
};

/// Holds sites with one demand each. Sites change between solves, and a solve does only the work that the changes need. Cells
/// next to a change are computed anew. All weights follow the known response of all volumes. A cell is measured again only where
/// its bisectors have moved so far that the response could be wrong by a share of the tolerance. Deterministic: the same calls
/// give the same bits, with any number of threads.
class VolumeSolver {
 public:
  VolumeSolver();
  ~VolumeSolver();
  VolumeSolver(VolumeSolver&&) noexcept;
  VolumeSolver& operator=(VolumeSolver&&) noexcept;

  /// Sites with their demands [m³]; weights that are not positive are found.
  Result<void> start(const Domain& domain, std::span<const PowerSite> sites, std::span<const double> demands);
  Result<void> move(std::uint32_t site, const Point3& position);
  Result<void> set_demand(std::uint32_t site, double demand);
  /// The index of the new site: that of a removed site, or the end.
  Result<std::uint32_t> add(const Point3& position, double demand);
  Result<void> remove(std::uint32_t site);

  Result<SolveReport> solve(const SolveOptions& options = {});

  /// Per place; a removed site has weight and volume 0.
  std::span<const PowerSite> sites() const;
  std::span<const double> volumes() const;
  std::span<const double> demands() const;

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace bl::geometry
