// Cuts faces by the Clipper library, which rounds crossings to the grid and leaves out corners that lie on straight sides: each
// side then gets all corners that lie on it.
#include "core/geometry/plan_split.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <utility>

#include <clipper.hpp>

namespace bl::geometry {

namespace {

using ClipperLib::IntPoint;
using ClipperLib::Path;
using ClipperLib::Paths;

// How far from a side a corner of it may lie [steps]: each end of it and the corner itself may be rounded by 0.71.
constexpr double kOnSideSteps = 2;

Point3 grid_metres(const IntPoint& p, double step) {
  return {static_cast<double>(p.X) * step, static_cast<double>(p.Y) * step, 0};
}

Path grid_path(const Ring& ring, double step) {
  Path path;
  for (const Point3& corner : ring) {
    const IntPoint at(std::llround(corner.x / step), std::llround(corner.y / step));
    if (path.empty() || path.back() != at) path.push_back(at);
  }
  while (path.size() > 1 && path.front() == path.back()) path.pop_back();
  return path;
}

// The outer ring first; none where the face is too small.
Paths grid_paths(const PlateFace& face, double step) {
  Paths paths = {grid_path(face.outer, step)};
  if (paths.front().size() < 3) return {};
  for (const Ring& hole : face.holes)
    if (Path path = grid_path(hole, step); path.size() >= 3) paths.push_back(std::move(path));
  return paths;
}

// Without ways to and fro, which corners on sides may leave of parts thinner than the grid.
Path without_spikes(Path path) {
  for (std::size_t k = 0; k < path.size() && path.size() >= 3;) {
    const std::size_t next = (k + 1) % path.size(), after = (k + 2) % path.size();
    if (path[k] == path[next]) path.erase(path.begin() + static_cast<std::ptrdiff_t>(next)), k = 0;
    else if (path[k] == path[after]) path.erase(path.begin() + static_cast<std::ptrdiff_t>(next)), k = 0;
    else ++k;
  }
  return path;
}

// All corners of the face and of its parts.
class PartCorners {
 public:
  void add(const Paths& paths) {
    for (const Path& path : paths) corners_.insert(corners_.end(), path.begin(), path.end());
  }
  void sort() {
    const auto is_less = [](const IntPoint& a, const IntPoint& b) { return std::tie(a.X, a.Y) < std::tie(b.X, b.Y); };
    std::sort(corners_.begin(), corners_.end(), is_less);
    corners_.erase(std::unique(corners_.begin(), corners_.end()), corners_.end());
  }

  // Those between the ends of a side, in order. From the other end they are the same ones the other way round.
  Path between(const IntPoint& from, const IntPoint& to) const {
    const std::int64_t x = to.X - from.X, y = to.Y - from.Y, squared = x * x + y * y;
    std::vector<std::tuple<std::int64_t, std::int64_t, IntPoint>> found;
    const auto reach = static_cast<std::int64_t>(kOnSideSteps);
    const std::int64_t low = std::min(from.X, to.X) - reach, high = std::max(from.X, to.X) + reach;
    auto next =
        std::lower_bound(corners_.begin(), corners_.end(), low, [](const IntPoint& p, std::int64_t at) { return p.X < at; });
    for (; next != corners_.end() && next->X <= high; ++next) {
      const std::int64_t u = next->X - from.X, v = next->Y - from.Y;
      const std::int64_t along = x * u + y * v, aside = x * v - y * u;
      if (along <= 0 || along >= squared) continue;
      if (std::abs(static_cast<double>(aside)) > kOnSideSteps * std::sqrt(static_cast<double>(squared))) continue;
      found.emplace_back(along, aside, *next);
    }
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
      return std::tie(std::get<0>(a), std::get<1>(a)) < std::tie(std::get<0>(b), std::get<1>(b));
    });
    Path path;
    for (const auto& [along, aside, corner] : found) path.push_back(corner);
    return path;
  }

  Path refined(const Path& path) const {
    Path fine;
    for (std::size_t k = 0; k < path.size(); ++k) {
      fine.push_back(path[k]);
      const Path more = between(path[k], path[(k + 1) % path.size()]);
      fine.insert(fine.end(), more.begin(), more.end());
    }
    return without_spikes(std::move(fine));
  }

 private:
  std::vector<IntPoint> corners_;
};

Ring grid_ring(const Path& path, double step) {
  Ring ring;
  for (const IntPoint& p : path) ring.push_back(grid_metres(p, step));
  return ring;
}

Paths tree_paths(const ClipperLib::PolyTree& tree) {
  Paths paths;
  ClipperLib::PolyTreeToPaths(tree, paths);
  return paths;
}

// With all corners on their sides. A hole that a corner moves onto the outer side becomes a part of that side: two sides at one
// place, to and fro, would be walls of no thickness.
std::vector<PlateFace> tree_faces(const ClipperLib::PolyTree& tree, const PartCorners& corners, double step) {
  ClipperLib::Clipper clipper;
  for (const Path& path : tree_paths(tree))
    if (const Path fine = corners.refined(path); fine.size() >= 3) clipper.AddPath(fine, ClipperLib::ptSubject, true);
  ClipperLib::PolyTree clean;
  clipper.Execute(ClipperLib::ctUnion, clean, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
  std::vector<PlateFace> faces;
  for (const ClipperLib::PolyNode* node = clean.GetFirst(); node != nullptr; node = node->GetNext()) {
    if (node->IsHole()) continue;
    const Path outer = corners.refined(node->Contour);
    if (outer.size() < 3) continue;
    PlateFace& face = faces.emplace_back(PlateFace{grid_ring(outer, step), {}});
    for (const ClipperLib::PolyNode* hole : node->Childs)
      if (const Path inner = corners.refined(hole->Contour); inner.size() >= 3) face.holes.push_back(grid_ring(inner, step));
  }
  return faces;
}

}  // namespace

SplitFace split_face(const PlateFace& face, std::span<const PlateFace> others, double step) {
  SplitFace split;
  const Paths whole = grid_paths(face, step);
  if (whole.empty()) return split;
  PlateFace plain{grid_ring(whole.front(), step), {}};
  for (std::size_t r = 0; r < whole.size(); ++r) {
    split.rings.push_back(grid_ring(whole[r], step));
    split.on_sides.emplace_back(whole[r].size());
    if (r > 0) plain.holes.push_back(split.rings.back());
  }
  ClipperLib::Clipper clipper;
  clipper.AddPaths(whole, ClipperLib::ptSubject, true);
  for (const PlateFace& other : others) clipper.AddPaths(grid_paths(other, step), ClipperLib::ptClip, true);
  ClipperLib::PolyTree covered, free;
  clipper.Execute(ClipperLib::ctIntersection, covered, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
  clipper.Execute(ClipperLib::ctDifference, free, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
  if (covered.Total() == 0 || free.Total() == 0) {
    (covered.Total() == 0 ? split.free : split.covered).push_back(std::move(plain));
    return split;
  }
  PartCorners corners;
  corners.add(whole);
  corners.add(tree_paths(covered));
  corners.add(tree_paths(free));
  corners.sort();
  for (std::size_t r = 0; r < whole.size(); ++r)
    for (std::size_t k = 0; k < whole[r].size(); ++k)
      split.on_sides[r][k] = grid_ring(corners.between(whole[r][k], whole[r][(k + 1) % whole[r].size()]), step);
  split.covered = tree_faces(covered, corners, step);
  split.free = tree_faces(free, corners, step);
  return split;
}

}  // namespace bl::geometry
