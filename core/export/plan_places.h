// Places in plans: how far a proposal reaches, and where a label stands.
#pragma once

#include <vector>

#include "core/export/proposal_model.h"

namespace bl::exporting {

struct PlanExtent {
  Point3 low, high;  ///< [m]; z is 0
};

/// Around the site: all buildings, plots and boundaries; existing buildings and streets may lie outside.
PlanExtent plan_extent(const Proposal& proposal);
/// The same with existing buildings and streets.
PlanExtent whole_extent(const Proposal& proposal);
/// Where words stand on the largest face: a strip of it without holes, as wide and high as that is [m].
struct LabelPlace {
  Point3 middle;
  double width = 0, height = 0;
};
LabelPlace label_place(const std::vector<geometry::PlateFace>& faces);

}  // namespace bl::exporting
