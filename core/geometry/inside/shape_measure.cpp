// Closed-form measures, facet by facet: edges inside the ball give polygon areas, edges outside it sectors of the facet's disc.
#include "core/geometry/inside/shape_measure.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/geometry/inside/facet_sum.h"
#include "core/geometry/inside/wide_registers.h"

namespace bl::geometry {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kUnknown = std::numeric_limits<double>::infinity();
// Shapes below this share of their cell (or of the ball's box) are a touch, not a volume.
constexpr double kTouchingShare = 1e-13;
// Nearer to a facet's plane than this share of the radius, the centre sees the facet's edges at angles of pure rounding.
constexpr double kApartShare = 1e-3;

double polygon_area(const Polyhedron& cell, const PolyhedronFace& face) {
  const auto loop = cell.loop(face);
  const Point3 origin = cell.vertices[loop[0]];
  Vector3 sum, before = cell.vertices[loop[1]] - origin;
  for (std::uint32_t i = 2; i < face.count; ++i) {
    const Vector3 at = cell.vertices[loop[i]] - origin;
    sum += cross(before, at);
    before = at;
  }
  return std::max(0.0, 0.5 * dot(face.normal, sum));
}

// All edges of a facet. Each place has two of them: where a moment is asked for, its spoke is worked out once.
void add_loop(FacetSum& sum, std::span<const std::uint32_t> loop, std::span<const Place> places) {
  thread_local std::vector<Spoke> spokes;
  spokes.clear();
  spokes.resize(loop.size());
  if (sum.with_moment && sum.has_disc())
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Place& place = places[loop[k]];
      if (!place.is_inside) spokes[k] = sum.spoke_to(place);
    }
  std::size_t last = loop.size() - 1;
  for (std::size_t k = 0; k < loop.size(); last = k++) {
    const std::uint32_t from = loop[last], to = loop[k];
    from < to ? sum.add_edge(places[from], places[to], 1, spokes[last], spokes[k])
              : sum.add_edge(places[to], places[from], -1, spokes[k], spokes[last]);
  }
}

// The ball holds the whole polyhedron.
void measure_unwrapped(const Polyhedron& cell, const WholeMeasure& whole, bool with_centroid, ShapeMeasure& out) {
  Point3 middle;
  for (const Point3& v : cell.vertices) middle += v;
  middle *= 1 / static_cast<double>(cell.vertices.size());
  double sum = 0;
  for (const PolyhedronFace& face : cell.faces) {
    out.areas.push_back(face.count < 3 ? 0 : polygon_area(cell, face));
    sum += out.areas.back() * (face.offset - dot(face.normal, middle));
  }
  out.volume = std::clamp(sum / 3, 0.0, whole.volume);
  out.is_empty = !(out.volume > 0);
  out.centroid = out.point_inside = middle;
  if (with_centroid) out.centroid = whole.volume < kUnknown ? whole.centroid : measure_whole(cell).centroid;
}

}  // namespace

bool is_centre_apart(const Polyhedron& cell, double radius) {
  return std::all_of(cell.faces.begin(), cell.faces.end(),
                     [&](const PolyhedronFace& face) { return std::abs(face.offset) > kApartShare * radius; });
}

WholeMeasure measure_whole(const Polyhedron& cell) {
  WholeMeasure whole;
  whole.volume = volume_and_centroid(cell, whole.centroid);
  return whole;
}

BL_WIDE_REGISTERS void measure_shape(const Polyhedron& cell, double squared_radius, const WholeMeasure& whole, bool with_centroid,
                                     ShapeMeasure& out) {
  out.areas.clear();
  out.volume = out.spherical_area = 0;
  out.is_empty = true;
  out.centroid = out.point_inside = {};
  if (cell.is_empty()) return;
  if (cell.reach_squared <= squared_radius) return measure_unwrapped(cell, whole, with_centroid, out);
  const double radius = std::sqrt(squared_radius);
  thread_local std::vector<Place> places;
  places.clear();
  for (const Point3& v : cell.vertices) places.push_back(Place::of(v, squared_radius));
  const bool counts_inside = is_centre_apart(cell, radius);
  AngleSum solid;  // half of the solid angle of the triangles
  double cones = 0, facets = 0, sectors = 0;
  bool is_centre_inside = true;
  Vector3 moment, area_vector, mean;
  for (const PolyhedronFace& face : cell.faces) {
    is_centre_inside = is_centre_inside && face.offset > 0;
    // A plane through the centre is seen edge-on: no solid angle.
    FacetSum sum(face.normal, face.offset, squared_radius, face.offset != 0 ? &solid : nullptr, counts_inside);
    sum.with_moment = with_centroid;
    if (counts_inside && !sum.has_disc()) {
      out.areas.push_back(0);
      continue;
    }
    add_loop(sum, cell.loop(face), places);
    if (sum.has_disc()) sum.close();
    out.areas.push_back(sum.area);
    if (face.offset != 0) sectors += face.offset < 0 ? -sum.sectors : sum.sectors;
    cones += face.offset * sum.area;
    facets += sum.area;
    if (!with_centroid || !(sum.area > 0)) continue;
    const Vector3 facet_moment = (face.offset * sum.area) * face.normal + sum.moment;
    mean += facet_moment;
    area_vector += sum.area * face.normal;
    moment += (face.offset / 4) * facet_moment;
  }
  const double free =
      counts_inside ? (is_centre_inside ? 4 * kPi : 0) - 2 * solid.value() - sectors : 2 * solid.value() - sectors;
  // Without facets it is a whole ball or nothing.
  out.spherical_area = squared_radius * (facets > 0 ? std::clamp(free, 0.0, 4 * kPi) : free > 2 * kPi ? 4 * kPi : 0);
  out.volume = std::clamp((cones + radius * out.spherical_area) / 3, 0.0, whole.volume);
  // A ball that touches its cell from outside: what is left is rounding, and has no inside that a mesh could be wrapped around.
  out.is_empty = out.volume <= kTouchingShare * std::min(whole.volume, 8 * squared_radius * radius);
  if (out.is_empty) {
    out.volume = out.spherical_area = 0;
    return;
  }
  if (!with_centroid) return;
  // The spherical part's first moment follows from the area vectors: those of a closed surface add up to nothing.
  moment -= (squared_radius / 4) * area_vector;
  out.point_inside = facets > 0 ? mean / facets : Point3{};
  out.centroid = moment / out.volume;
}

}  // namespace bl::geometry
