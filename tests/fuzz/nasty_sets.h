// What the fuzzers of the geometry make of bytes: domains, and nasty sets of sites in them.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/geometry/convex_domain.h"
#include "core/geometry/power_cells.h"

namespace bl::fuzz {

// Bytes one after the other; zeros once they are used up.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  std::uint8_t next() { return at_ < size_ ? data_[at_++] : std::uint8_t{0}; }
  bool is_used_up() const { return at_ >= size_; }
  double share() { return (next() + 256.0 * next()) / 65535.0; }

 private:
  const std::uint8_t* data_;
  std::size_t size_, at_ = 0;
};

inline geometry::ConvexDomain make_domain(Bytes& bytes) {
  const unsigned kind = bytes.next() % 4u;
  const double shift = kind == 1 ? 10000 : 0;
  const std::vector<Point3> square{{shift, 0, 0}, {shift + 10, 0, 0}, {shift + 10, 10, 0}, {shift, 10, 0}};
  if (kind < 2) return geometry::extrude(square, 0, 10).value();
  if (kind == 2) return geometry::extrude(square, 0, 0.1).value();
  std::vector<Point3> points;
  for (int i = 0; i < 9; ++i) {
    const double x = 10 * bytes.share(), y = 10 * bytes.share();
    points.push_back({x, y, 10 * bytes.share()});
  }
  const auto hull = geometry::convex_hull(points);
  return hull ? *hull : geometry::extrude(square, 0, 10).value();
}

inline double make_weight(Bytes& bytes) {
  static constexpr double kSpecial[] = {0, 1, 0.25, 3, -1, 1e-12, 1e12, 1e18, -1e18, 1e-300, 100, 25, 0.75, 2, 4, 1e4};
  const std::uint8_t choice = bytes.next();
  if (choice < 64) return kSpecial[choice % 16];
  return choice < 224 ? 9 * bytes.share() : 1e3 * bytes.share() - 100;
}

/// At most `most` sites in and about a box of 10 m whose lowest corner is `minimum`.
inline std::vector<geometry::PowerSite> make_sites(Bytes& bytes, const Vector3& minimum, std::size_t most) {
  std::vector<geometry::PowerSite> sites;
  while (!bytes.is_used_up() && sites.size() < most) {
    const std::uint8_t how = bytes.next();
    Point3 p{bytes.share() * 14 - 2, bytes.share() * 14 - 2, bytes.share() * 14 - 2};
    if (how & 1u) p = {std::round(p.x), std::round(p.y), std::round(p.z)};
    if (how & 2u) p.z = 5;
    if ((how & 12u) == 12u) p.y = p.x;
    p.x += minimum.x;
    if ((how & 48u) == 48u && !sites.empty()) {
      p = sites[bytes.next() % sites.size()].position;
      if (how & 64u) p.x += 1e-4 * bytes.share();
      if (how & 128u) p.z += 1e-5 * bytes.share();
    }
    sites.push_back({p, (how & 192u) == 64u && !sites.empty() ? sites.back().weight : make_weight(bytes)});
  }
  return sites;
}

}  // namespace bl::fuzz
