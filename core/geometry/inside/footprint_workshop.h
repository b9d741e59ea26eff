// What a FootprintDiagram keeps between calls.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/footprint.h"
#include "core/geometry/inside/footprint_maker.h"
#include "core/geometry/inside/plan_plot.h"

namespace bl::geometry {

struct FootprintDiagram::Workshop {
  Domain domain;
  std::vector<StreetAxis> streets;
  bool has_plot = false;
  PlanPlot plot;
  PlanGrid grid;
  std::vector<StandingSite> sites;  // of the last update
  std::vector<FootprintMeasure> measures;
  std::vector<double> reaches;  // how far from its site each footprint can reach [m]
  std::vector<std::uint32_t> made, order;
  std::vector<std::uint8_t> is_touched;  // since somebody has asked for the touched ones
  std::vector<std::uint8_t> is_covered;  // lies in the place of a heavier site

  void find_made(std::span<const StandingSite> now);
  // Can another site, as it is or was, have a side with site i as it was?
  bool cuts(const StandingSite& other, std::uint32_t i) const;
  void find_coincident();
  void measure(std::uint32_t i, FootprintMaker& maker);
};

}  // namespace bl::geometry
