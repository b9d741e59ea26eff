// What holds for every domain: pieces that are disjoint, faces that are wholly surface or wholly inner, sums that are right.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/geometry/domain_makers.h"
#include "core/geometry/solid_part.h"
#include "tests/core/geometry/geometry_support.h"

namespace bl::test {

inline double outer_area(const geometry::Domain& domain, std::uint32_t side = geometry::Domain::kInner) {
  double area = 0;
  for (const geometry::Domain::Piece& piece : domain.pieces) {
    const geometry::SolidPart part = part_of(piece);
    for (std::size_t f = 0; f < part.faces.size(); ++f)
      if (part.faces[f].side != geometry::Domain::kInner && (side == geometry::Domain::kInner || part.faces[f].side == side))
        area += norm(geometry::area_vector(part.polygon(f)));
  }
  return area;
}

/// How much of a face the faces of the other pieces cover, and how much of those is called inner.
inline double covered_area(const geometry::Domain& domain, std::size_t of, const geometry::PartFace& face,
                           const geometry::Polygon& polygon, double tolerance) {
  double covered = 0;
  for (std::size_t p = 0; p < domain.pieces.size(); ++p) {
    if (p == of) continue;
    const geometry::SolidPart other = part_of(domain.pieces[p]);
    for (std::size_t g = 0; g < other.faces.size(); ++g) {
      if (dot(other.faces[g].plane.normal, face.plane.normal) > -0.999999) continue;
      const geometry::Polygon facing = other.polygon(g);
      const bool is_coplanar = std::all_of(facing.begin(), facing.end(), [&](const Point3& q) {
        return std::abs(dot(face.plane.normal, q) - face.plane.offset) <= tolerance;
      });
      const double common = is_coplanar ? geometry::common_area(polygon, facing, face.plane.normal) : 0;
      covered += common;
      if (common > 1e-6 * norm(geometry::area_vector(polygon))) { EXPECT_EQ(other.faces[g].side, geometry::Domain::kInner); }
    }
  }
  return covered;
}

inline void expect_sound(const geometry::Domain& domain, double volume, double surface) {
  const double size = domain.size(), tolerance = 1e-8 * size;
  EXPECT_NEAR(domain.volume, volume, 1e-9 * volume);
  EXPECT_NEAR(outer_area(domain), surface, 1e-8 * surface);
  double sum = 0;
  Vector3 closing;
  for (std::size_t p = 0; p < domain.pieces.size(); ++p) {
    const geometry::Domain::Piece& piece = domain.pieces[p];
    ASSERT_EQ(piece.sides.size(), piece.shape.planes.size());
    EXPECT_TRUE(is_closed(to_mesh(piece.shape)));
    EXPECT_NEAR(enclosed_volume(to_mesh(piece.shape)), piece.shape.volume, 1e-12 * size * size * size);
    sum += piece.shape.volume;
    const geometry::SolidPart part = part_of(piece);
    for (std::size_t f = 0; f < part.faces.size(); ++f) {
      const geometry::Polygon polygon = part.polygon(f);
      const double area = norm(geometry::area_vector(polygon)),
                   covered = covered_area(domain, p, part.faces[f], polygon, tolerance);
      EXPECT_NEAR(covered, part.faces[f].side == geometry::Domain::kInner ? area : 0.0, 1e-7 * size * size)
          << "piece " << p << " face " << f;
      if (part.faces[f].side == geometry::Domain::kInner) continue;
      EXPECT_LT(part.faces[f].side, domain.side_count);
      closing += geometry::area_vector(polygon);
    }
    // The half-spaces alone give the piece back: they are what travels between nodes.
    const auto again = from_planes(piece.shape.planes);
    ASSERT_TRUE(again.ok()) << again.error().text();
    EXPECT_NEAR(again->volume, piece.shape.volume, 1e-9 * volume);
    EXPECT_TRUE(is_closed(to_mesh(*again)));
  }
  EXPECT_NEAR(sum, volume, 1e-9 * volume);
  EXPECT_LT(norm(closing), 1e-8 * surface);
  Random random(17);
  for (int k = 0; k < 400; ++k) {
    const Point3 p = random_point(random, domain.minimum, domain.maximum);
    int held = 0;
    for (const geometry::Domain::Piece& piece : domain.pieces) held += piece.shape.contains(p, -tolerance) ? 1 : 0;
    EXPECT_LE(held, 1);
  }
}

/// A star-shaped ring with bays, counter-clockwise.
inline std::vector<Point3> star_ring(Random& random, const Point3& centre, std::size_t corners, double low, double high) {
  std::vector<Point3> ring;
  for (std::size_t i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * (static_cast<double>(i) + 0.6 * random.uniform()) / static_cast<double>(corners);
    const double radius = random.uniform(low, high);
    ring.push_back({centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle), 0});
  }
  return ring;
}

inline std::vector<Point3> ring_of(std::initializer_list<std::pair<double, double>> corners) {
  std::vector<Point3> ring;
  for (const auto& [x, y] : corners) ring.push_back({x, y, 0});
  return ring;
}

}  // namespace bl::test
