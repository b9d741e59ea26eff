// What a volume that stands shares with others, and what it has below the ground.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/reading/view.h"

namespace bl::reading {

/// Whose footprint it shares.
struct SharingFigures {
  std::vector<std::string> shares;  ///< id of the host; none: it has its own
  std::int64_t storeys_held = 0;    ///< those that limits of height hold: of a host those of the whole building
  Shared<Table> building;           ///< see core/demand/shared_storeys.h

  static void declare(ViewBuilder<SharingFigures>& v);
  static const ViewDefinition& view();
};

/// The storeys below the ground.
struct CellarFigures {
  std::int64_t storeys = 0;
  double storey_height = 0;  ///< [m]
  double area = 0;           ///< of all of them; no part of the floor area [m²]

  static void declare(ViewBuilder<CellarFigures>& v);
  static const ViewDefinition& view();
};

}  // namespace bl::reading
