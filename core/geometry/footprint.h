// Standing volumes: whole storeys on footprints, where a footprint is what the plan power cell, a form and the plot share.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "core/base/parallel.h"
#include "core/base/result.h"
#include "core/geometry/power_cells.h"

namespace bl::geometry {

/// What bounds a footprint besides its power cell and the plot.
enum class FootprintForm : std::uint8_t {
  round,  ///< a disc of radius sqrt(weight)
  block,  ///< a rectangle with half sides sqrt(weight · aspect) and sqrt(weight / aspect)
  cell,   ///< nothing
};

/// Storeys with the same set-back, one upon another.
struct StoreyRun {
  int storeys = 1;
  double setback = 0;    ///< how far their plates lie inside the footprint [m]
  double courtyard = 0;  ///< how far they lie behind the edge that a constant depth would give their courtyard [m]
  bool operator==(const StoreyRun&) const = default;
};

/// A volume that stands. Its plates are the footprint K eroded by their set-back, less K eroded by set-back and depth: the
/// courtyard that light needs. The erosion of an intersection is the intersection of the erosions, hence all of it is exact, and
/// each kind of side may have a distance of its own.
struct StandingSite {
  static constexpr double kAnyDepth = std::numeric_limits<double>::infinity();

  PowerSite site;  ///< the weight in plan [m²]; z is the height of the ground [m]
  FootprintForm form = FootprintForm::round;
  double angle = 0;               ///< of a block's first side, from the x axis [rad]
  double aspect = 1;              ///< of a block: first side / second side
  std::vector<StoreyRun> runs;    ///< from the ground up
  double storey_height = 3;       ///< [m]
  double depth = kAnyDepth;       ///< the greatest depth of the building between façade and courtyard [m]
  bool has_party_walls = false;   ///< plates touch those of neighbours: set-backs do not hold towards them
  bool has_border_walls = false;  ///< nor towards the border of the plot where that is no street
  double border_distance = 0;     ///< of all plates from the border of the plot, but for sides along streets [m]
  double street_distance = 0;     ///< of all plates from sides of the plot along streets [m]
  double exclusion_distance = 0;  ///< of all plates from ground inside the border that the plot leaves out [m]
  double wing_depth = kAnyDepth;  ///< the greatest depth along walls that touch neighbours or the border, if below `depth` [m]
  bool operator==(const StandingSite&) const = default;

  int storeys() const;
};

/// What one site has got.
struct FootprintMeasure {
  /// What another site's weight takes away from this one.
  struct Neighbour {
    std::uint32_t site = 0;
    double wall = 0;      ///< length of the common side of the plates of the first run [m]
    double response = 0;  ///< - d floor_area / d weight of the other site; not negative
  };
  SiteState state = SiteState::alive;
  double footprint = 0;               ///< covered by the first run, without its courtyard [m²]
  double floor_area = 0;              ///< sum of all plates [m²]
  double volume = 0;                  ///< [m³]
  double own_response = 0;            ///< d floor_area / d weight; not negative
  double free_response = 0;           ///< the part of it at sides without a neighbour, where the volume can grow at nobody's cost
  std::vector<double> plates;         ///< area of one plate of each run [m²]
  std::vector<Neighbour> neighbours;  ///< in ascending number of the site
};

/// The axis of a street. A side of the plot's border is along it where the middle of that side lies within `reach` of the axis,
/// and both run in the same direction within 30 degrees.
struct StreetAxis {
  std::vector<Point3> points;  ///< [m]; their heights are ignored
  double reach = 0;            ///< [m]
  bool operator==(const StreetAxis&) const = default;
};

/// The footprints of all sites on one plot, with memory kept between calls: where few sites have changed, only those that can be
/// touched are measured anew, with the same bits.
class FootprintDiagram {
 public:
  FootprintDiagram();
  ~FootprintDiagram();
  FootprintDiagram(FootprintDiagram&&) noexcept;
  FootprintDiagram& operator=(FootprintDiagram&&) noexcept;

  /// The plot is the horizontal section of the domain a little above its bottom. Fails where nothing is left of it. `land`: the
  /// same with the ground that the plot leaves out, such as streets and water; its border is the border of the plot, from which
  /// plates have other distances than from that ground. nullptr: the plot leaves out nothing.
  Result<void> set_domain(const Domain& domain, std::span<const StreetAxis> streets = {}, const Domain* land = nullptr);
  double plot_area() const;  ///< [m²]
  /// Is the plot the ground of this domain?
  bool is_of(const Domain& domain) const;
  /// Valid until the next call. Fails on input that is not finite or absurd.
  Result<std::span<const FootprintMeasure>> update(std::span<const StandingSite> sites, ThreadPool* pool = nullptr);
  std::span<const FootprintMeasure> footprints() const;
  /// Ascending: the sites that the last update has measured anew.
  std::span<const std::uint32_t> made() const;
  /// Ascending: the sites that were measured anew since the last call of this.
  std::vector<std::uint32_t> take_touched();
  struct Workshop;  ///< for `plates.h`, which draws outlines
  const Workshop& workshop() const { return *workshop_; }

 private:
  std::unique_ptr<Workshop> workshop_;
};

}  // namespace bl::geometry
