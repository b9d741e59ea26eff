// One cell looked at along rays: the planes that cut its ball, a point to look from with room around it, and what rays tell.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/vector.h"
#include "core/geometry/convex_domain.h"
#include "core/geometry/inside/ray_cast.h"
#include "core/geometry/power_cells.h"

namespace bl::geometry {

/// What all cells see of each other: a place for each site, those of neighbours near to each other in memory.
struct RayScene {
  const ConvexDomain& domain;
  std::vector<PowerSite> sites;      ///< with the weights of the step before
  std::vector<double> demand, ball;  ///< [m³], and the radius of the whole ball that has it [m]
};

/// How the volumes follow the weights: of each cell what its neighbours take when they get heavier.
struct RayResponse {
  std::vector<std::uint32_t> column;
  std::vector<double> value;
};

/// A desk for one cell after the other; it keeps its memory.
class RayCell {
 public:
  using Near = std::span<const std::uint32_t>;  ///< places of the sites that may cut the ball

  explicit RayCell(const RayScene& scene) : scene_(scene) {}

  /// Has the site enough room around itself? Most have: told without roots and lists.
  bool has_room(std::uint32_t place, Near near) const;

  /// Chooses the point to look from. Returns the weight that the cell needs to have some room there: its own, or more.
  double look(std::uint32_t place, Near near);

  struct Measure {
    double volume, response;  ///< [m³]; by its own weight [m]
  };
  /// Volume and response of the cell looked at last; what neighbours take of it is added to `others`.
  Measure measure(RayResponse& others);

 private:
  // A plane that cuts the ball, relative to the site.
  struct Cut {
    Vector3 normal;
    double offset;        // from the site
    double bond;          // twice the distance of the other site; 0: a side of the domain
    std::uint32_t place;  // of the other site
    double distance;      // from the eye
  };

  void gather(Near near, double radius);
  void choose_eye();
  void look_from_eye();
  void make_room(Near near);
  void raise(double weight);
  bool is_worth_looking();
  void cast(Hits& hits) const;

  const RayScene& scene_;
  std::uint32_t place_ = 0;
  double ball_ = 0, weight_ = 0;  // radius of the demanded ball; what the cell has now
  double least_ = 0;              // of the offsets
  Point3 eye_;                    // relative to the site
  std::vector<Cut> kept_;
  std::span<Cut> cuts_;  // the first of those
  std::vector<float> area_;
};

}  // namespace bl::geometry
