// What a FootprintDiagram keeps between calls.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/footprint.h"
#include "core/geometry/inside/footprint_maker.h"
#include "core/geometry/inside/plan_plot.h"

namespace bl::geometry {

struct FootprintDiagram::Workshop {
  static constexpr std::size_t kMostUnused = 64;  // distances that plots are kept eroded by

  Domain domain, land;  // without land: the domain leaves out nothing
  std::vector<StreetAxis> streets;
  bool has_plot = false;
  PlanPlot plot;
  PlanGrid grid;
  std::vector<StandingSite> sites;  // of the last update
  std::vector<FootprintMeasure> measures;
  std::vector<double> reaches;         // how far from its site each footprint can reach [m]
  double largest_reach = 0;            // of those that are finite [m]
  double largest_excess = 0;           // of the square of a reach over the weight [m²]
  std::vector<std::uint32_t> endless;  // those whose reach is not finite
  std::vector<std::uint32_t> made, order;
  std::size_t most_kept = kMostUnused;
  std::vector<std::uint8_t> is_touched;  // since somebody has asked for the touched ones
  std::vector<std::uint8_t> is_covered;  // lies in the place of a heavier site

  void find_made(std::span<const StandingSite> now);
  void find_largest_reach();
  // Those that another site, as it is or was, can have a side with.
  void mark_cut(const StandingSite& other, std::vector<std::uint8_t>& is_met) const;
  // Can another site, as it is or was, have a side with site i as it was?
  bool cuts(const StandingSite& other, std::uint32_t i) const;
  void find_coincident();
  // Makes the plots eroded as those that are measured need them, and forgets what nobody needs any more.
  void erode_plots(std::span<const StandingSite> now);
  void measure(std::uint32_t i, FootprintMaker& maker);
};

}  // namespace bl::geometry
