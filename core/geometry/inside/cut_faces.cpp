// The choice of the next splitting plane decides how many pieces a solid falls into.
#include "core/geometry/inside/cut_faces.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace bl::geometry {

namespace {

// Of many crossing faces only the largest are tried, so that the cost stays linear in their number.
constexpr std::size_t kMostTried = 48;

struct Candidate {
  std::uint32_t face = 0;
  bool is_tilted = false;
  double area = 0;
  Polygon within;
};

bool is_cut(const Polygon& polygon, const Plane& plane, double tolerance) {
  bool below = false, above = false;
  for (const Point3& p : polygon) {
    const double away = dot(plane.normal, p) - plane.offset;
    below |= away < -4 * tolerance;
    above |= away > 4 * tolerance;
  }
  return below && above;
}

}  // namespace

std::vector<std::uint32_t> crossing_faces(const SolidPart& part, std::span<const CutFace> faces,
                                          std::span<const std::uint32_t> candidates, double tolerance) {
  std::vector<std::uint32_t> crossing;
  for (const std::uint32_t f : candidates) {
    if (!boxes_overlap(part.vertices, faces[f].polygon, -tolerance)) continue;
    const Polygon within = clipped(faces[f].polygon, part, 2 * tolerance);
    if (within.size() > 2 && norm(area_vector(within)) > tolerance * tolerance) crossing.push_back(f);
  }
  return crossing;
}

std::optional<Plane> best_plane(const SolidPart& part, std::span<const CutFace> faces, std::span<const std::uint32_t> crossing,
                                double tolerance) {
  std::vector<Candidate> candidates;
  for (const std::uint32_t f : crossing) {
    Polygon within = clipped(faces[f].polygon, part, 2 * tolerance);
    const double area = norm(area_vector(within));
    candidates.push_back({f, std::abs(faces[f].plane.normal.z) > 1e-9, area, std::move(within)});
  }
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return std::tuple(a.is_tilted, -a.area, a.face) < std::tuple(b.is_tilted, -b.area, b.face);
  });
  const Candidate* best = nullptr;
  std::size_t fewest = 0;
  for (std::size_t i = 0; i < candidates.size() && i < kMostTried; ++i) {
    const Candidate& candidate = candidates[i];
    if (candidate.is_tilted != candidates.front().is_tilted) break;
    std::size_t cut = 0;
    for (const Candidate& other : candidates) cut += is_cut(other.within, faces[candidate.face].plane, tolerance) ? 1 : 0;
    if (best != nullptr && cut >= fewest) continue;
    best = &candidate;
    fewest = cut;
  }
  return best != nullptr ? std::optional<Plane>(faces[best->face].plane) : std::nullopt;
}

}  // namespace bl::geometry
