// The façade of a volume, as its style dresses it.
#pragma once

#include "core/reading/view.h"

namespace bl::reading {

/// Areas and cost, whole and by orientation.
struct FacadeFigures {
  std::string style_in_force;  ///< empty where none dresses it
  double facade_area = 0;      ///< [m²]
  double glazed_area = 0;      ///< [m²]
  double opaque_area = 0;      ///< [m²]
  double cost = 0;             ///< [€]
  double true_north = 0;       ///< [degrees]
  Shared<Table> by_orientation;

  static void declare(ViewBuilder<FacadeFigures>& v);
  static const ViewDefinition& view();
};

}  // namespace bl::reading
