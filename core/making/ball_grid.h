// Finds the site with the smallest power distance to a point, by a grid of cubes: the cost hardly grows with their number.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/base/vector.h"

namespace bl::making {

/// A ball: the power distance of a point to it is |point - at|² - radius².
struct BallSite {
  Point3 at;
  double radius = 0;  ///< [m]
};

/// An index over sites that stay where they are as long as the grid is used.
class BallGrid {
 public:
  /// `cube`: side of the cubes [m], about the mean distance of sites.
  BallGrid(std::span<const BallSite> sites, double cube);

  struct Hit {
    std::size_t site = 0;
    double power = 0;  ///< [m²]
  };
  /// Equal distances go to the smaller index, so that the answer does not depend on the grid.
  Hit nearest(const Point3& point) const;
  /// Is there a site before `site` closer to it than `limit` [m]? `limit` must not exceed the side of the cubes.
  bool crowded(std::size_t site, double limit) const;

 private:
  std::size_t cube_index(long long x, long long y, long long z) const;
  long long coordinate(double value, double low, long long count) const;
  void consider(const Point3& point, std::size_t site, Hit& hit) const;
  bool visit_shell(const Point3& point, const long long (&centre)[3], long long shell, Hit& hit) const;

  std::span<const BallSite> sites_;
  Point3 low_;
  double cube_ = 1;
  long long counts_[3] = {1, 1, 1};
  std::vector<std::size_t> starts_, members_;  // members of cube k: members_[starts_[k]] to members_[starts_[k + 1]]
  std::vector<std::size_t> large_;             // sites whose reach would make the search in the grid wide; looked at always
  double reach_ = 0;                           // largest squared radius among the others [m²]
};

}  // namespace bl::making
