// What every node is: an entity with a place.
#pragma once

#include "core/reading/view.h"

namespace bl::reading {

/// Where a node stands.
struct NodePlace {
  Point3 position;     ///< [m]
  double tension = 0;  ///< how far proposals on its place disagree [m]

  static void declare(ViewBuilder<NodePlace>& v);
  static const ViewDefinition& view();
};

}  // namespace bl::reading
