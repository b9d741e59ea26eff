// Fits the demands of a case whose volumes stand, with the same outcome as one of balls has.
#pragma once

#include <string>
#include <vector>

#include "core/geometry/footprint.h"
#include "core/geometry/volume_fit.h"
#include "ui/cli/site_case.h"

namespace bl::cli {

/// What a case of `fit` has come to.
struct CaseFit {
  geometry::VolumeFit fit;
  std::vector<geometry::FootprintMeasure> footprints;  ///< of each site where the volumes stand, else empty
  std::vector<std::string> notes;                      ///< what may surprise though the demands are met
};

/// `how.most_steps` counts evaluations, as for balls.
Result<CaseFit> fit_standing(const SiteCase& c, const geometry::VolumeFitOptions& how);

/// The area of each storey's plate from the ground up [m²].
std::vector<double> plates_of(const geometry::StandingSite& site, const geometry::FootprintMeasure& measure);

}  // namespace bl::cli
