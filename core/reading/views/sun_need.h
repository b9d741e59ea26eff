// What receivers of sun ask for, and what links leave them.
#pragma once

#include "core/reading/view.h"

namespace bl::reading {

/// What a receiver asks for, and how much of it it has; light enough to be read in every tick.
struct SunNeed {
  double required_sun = 0;    ///< per day [s]
  double required_share = 1;  ///< of its area that should get as much
  double share_met = 0;       ///< of its area that gets it
  double sun_of_share = 0;    ///< that the required share has at least [s]
  double sun_possible = 0;    ///< mean without casters [s]
  double deficit = 0;         ///< mean over the required share [s]
  std::int64_t columns = 0;   ///< of the grid; 0 where no study has measured it

  static void declare(ViewBuilder<SunNeed>& v);
  static const ViewDefinition& view();
};

/// How much a link that protects a receiver lets it lack.
struct SunRightParameters {
  double tolerance = 0;  ///< of the required sun
  double play = 0;       ///< of the tolerance, beyond it

  static void declare(ViewBuilder<SunRightParameters>& v);
  static const ViewDefinition& view();
};

}  // namespace bl::reading
