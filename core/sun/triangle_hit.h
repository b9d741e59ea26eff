// Does a ray meet a triangle? The one test that decides it, in doubles and without cracks between neighbours.
#pragma once

#include <cmath>
#include <utility>

#include "core/base/vector.h"

namespace bl::sun {

/// A ray made ready for many triangles (after Woop, Benthin and Wald 2013): space is sheared so that the ray runs along one axis;
/// then three signed areas tell on which side of each edge it passes. Neighbours compute the same number for their common edge,
/// with the other sign, so a ray that meets an edge or a corner meets at least one of them.
class RayTest {
 public:
  RayTest(const Point3& origin, const Vector3& toward) : origin_(origin) {
    const double d[3] = {toward.x, toward.y, toward.z};
    along_ = std::abs(d[0]) > std::abs(d[1]) ? 0 : 1;
    if (std::abs(d[2]) >= std::abs(d[along_])) along_ = 2;
    first_ = (along_ + 1) % 3;
    second_ = (along_ + 2) % 3;
    shear_first_ = d[first_] / d[along_];
    shear_second_ = d[second_] / d[along_];
    scale_ = 1 / d[along_];
  }

  /// Is the triangle met further than `nearest` [lengths of `toward`] from the origin? Triangles seen edge-on are not met.
  bool meets(const Point3& a, const Point3& b, const Point3& c, double nearest) const {
    const Sheared p = sheared(a), q = sheared(b), r = sheared(c);
    const double u = r.x * q.y - r.y * q.x, v = p.x * r.y - p.y * r.x, w = q.x * p.y - q.y * p.x;
    if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return false;
    const double area = u + v + w;
    if (area == 0) return false;
    const double depth = (u * p.z + v * q.z + w * r.z) * scale_;
    return area > 0 ? depth > nearest * area : depth < nearest * area;
  }

 private:
  struct Sheared {
    double x, y, z;
  };
  Sheared sheared(const Point3& point) const {
    const double d[3] = {point.x - origin_.x, point.y - origin_.y, point.z - origin_.z};
    return {d[first_] - shear_first_ * d[along_], d[second_] - shear_second_ * d[along_], d[along_]};
  }

  Point3 origin_;
  int along_, first_, second_;
  double shear_first_, shear_second_, scale_;
};

}  // namespace bl::sun
