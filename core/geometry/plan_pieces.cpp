// Constrained Delaunay triangulation of a plan, and its triangles put together again to few convex polygons.
#include "core/geometry/plan_pieces.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <map>
#include <numeric>
#include <tuple>

#include "core/geometry/plan_ring.h"

namespace bl {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
// Of a face: is it inside the plan?
using FaceBase = CGAL::Constrained_triangulation_face_base_2<Kernel, CGAL::Triangulation_face_base_with_info_2<bool, Kernel>>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>>;

using Edge = std::pair<std::uint32_t, std::uint32_t>;
using Loop = std::vector<std::uint32_t>;

// The corners of all rings, sorted by place, and the directed sides between them.
struct Outline {
  std::vector<PlanCorner> corners;
  std::map<Edge, std::uint32_t> walls;
};

Outline outline_of(const std::vector<std::vector<PlanCorner>>& rings) {
  std::vector<PlanCorner> given;
  for (const auto& ring : rings) given.insert(given.end(), ring.begin(), ring.end());
  std::vector<std::uint32_t> order(given.size()), place(given.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::tuple(given[a].y, given[a].x, a) < std::tuple(given[b].y, given[b].x, b);
  });
  Outline outline;
  for (const std::uint32_t g : order) {
    place[g] = static_cast<std::uint32_t>(outline.corners.size());
    outline.corners.push_back(given[g]);
  }
  std::uint32_t first = 0;
  for (const auto& ring : rings) {
    const std::uint32_t n = static_cast<std::uint32_t>(ring.size());
    for (std::uint32_t i = 0; i < n; ++i) outline.walls[{place[first + i], place[first + (i + 1) % n]}] = first + i;
    first += n;
  }
  return outline;
}

// The triangles inside: each on the left of the sides that bound it.
std::vector<std::array<std::uint32_t, 3>> inner_triangles(const Outline& outline) {
  Triangulation triangulation;
  std::vector<Triangulation::Vertex_handle> handles;
  for (std::uint32_t v = 0; v < outline.corners.size(); ++v) {
    handles.push_back(triangulation.insert(Kernel::Point_2(outline.corners[v].x, outline.corners[v].y)));
    handles.back()->info() = v;
  }
  for (const auto& [edge, wall] : outline.walls) triangulation.insert_constraint(handles[edge.first], handles[edge.second]);
  // From wall to triangle to triangle: what is reached without crossing a wall is inside as well.
  for (auto face = triangulation.all_faces_begin(); face != triangulation.all_faces_end(); ++face) face->info() = false;
  std::vector<Triangulation::Face_handle> open;
  const auto reach = [&](Triangulation::Face_handle face) {
    if (triangulation.is_infinite(face) || face->info()) return;
    face->info() = true;
    open.push_back(face);
  };
  for (auto face = triangulation.finite_faces_begin(); face != triangulation.finite_faces_end(); ++face)
    for (int i = 0; i < 3; ++i)
      if (outline.walls.count({face->vertex(Triangulation::ccw(i))->info(), face->vertex(Triangulation::cw(i))->info()}) > 0)
        reach(face);
  while (!open.empty()) {
    const Triangulation::Face_handle face = open.back();
    open.pop_back();
    for (int i = 0; i < 3; ++i)
      if (!face->is_constrained(i)) reach(face->neighbor(i));
  }
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (auto face = triangulation.finite_faces_begin(); face != triangulation.finite_faces_end(); ++face) {
    if (!face->info()) continue;
    std::array<std::uint32_t, 3> t{};
    for (unsigned i = 0; i < 3; ++i) t[i] = face->vertex(static_cast<int>(i))->info();
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    triangles.push_back(t);
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

// Takes diagonals away one by one, as long as both of their ends stay convex (after Hertel and Mehlhorn, 1983).
class Merger {
 public:
  Merger(const Outline& outline, const std::vector<std::array<std::uint32_t, 3>>& triangles) : outline_(outline) {
    for (const auto& t : triangles) loops_.emplace_back(t.begin(), t.end());
    for (std::uint32_t l = 0; l < loops_.size(); ++l) own(l);
  }

  std::vector<Edge> diagonals() const {
    std::vector<Edge> edges;
    for (const auto& [edge, loop] : owner_)
      if (edge.first < edge.second && owner_.count({edge.second, edge.first}) > 0) edges.push_back(edge);
    return edges;
  }

  double length(const Edge& edge) const {
    const PlanCorner &a = outline_.corners[edge.first], &b = outline_.corners[edge.second];
    return std::sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y));
  }

  void remove(const Edge& edge) {
    const std::uint32_t left = owner_.at(edge), right = owner_.at({edge.second, edge.first});
    Loop a = turned(loops_[left], edge.second), b = turned(loops_[right], edge.first);
    // a runs from the second end to the first, b back again.
    if (!is_convex(a[a.size() - 2], edge.first, b[1]) || !is_convex(b[b.size() - 2], edge.second, a[1])) return;
    a.insert(a.end(), b.begin() + 1, b.end() - 1);
    owner_.erase(edge);
    owner_.erase({edge.second, edge.first});
    loops_[left] = std::move(a);
    loops_[right].clear();
    own(left);
  }

  std::vector<Loop> loops() const {
    std::vector<Loop> kept;
    for (const Loop& loop : loops_)
      if (!loop.empty()) kept.push_back(turned(loop, *std::min_element(loop.begin(), loop.end())));
    std::sort(kept.begin(), kept.end());
    return kept;
  }

 private:
  void own(std::uint32_t l) {
    const Loop& loop = loops_[l];
    for (std::size_t i = 0; i < loop.size(); ++i) owner_[{loop[i], loop[(i + 1) % loop.size()]}] = l;
  }

  static Loop turned(Loop loop, std::uint32_t first) {
    std::rotate(loop.begin(), std::find(loop.begin(), loop.end(), first), loop.end());
    return loop;
  }

  bool is_convex(std::uint32_t before, std::uint32_t at, std::uint32_t after) const {
    const double bend = turn(outline_.corners[before], outline_.corners[at], outline_.corners[after]);
    return bend > 1e-9 * length({before, at}) * length({at, after});
  }

  const Outline& outline_;
  std::vector<Loop> loops_;
  std::map<Edge, std::uint32_t> owner_;
};

// Which diagonals go first decides how many pieces are left; a few orders are tried, and the first of the best is taken.
std::vector<Loop> few_loops(const Outline& outline, const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  std::vector<Loop> best;
  for (const double sign : {1.0, -1.0, 0.0}) {
    Merger merger(outline, triangles);
    std::vector<Edge> edges = merger.diagonals();
    std::stable_sort(edges.begin(), edges.end(),
                     [&](const Edge& a, const Edge& b) { return sign * merger.length(a) < sign * merger.length(b); });
    for (const Edge& edge : edges) merger.remove(edge);
    std::vector<Loop> loops = merger.loops();
    if (best.empty() || loops.size() < best.size()) best = std::move(loops);
  }
  return best;
}

}  // namespace

Result<std::vector<PlanPiece>> plan_pieces(const std::vector<std::vector<PlanCorner>>& rings) try {
  const Outline outline = outline_of(rings);
  std::vector<PlanPiece> pieces;
  for (const Loop& loop : few_loops(outline, inner_triangles(outline))) {
    PlanPiece piece;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      piece.corners.push_back(outline.corners[loop[i]]);
      const auto wall = outline.walls.find({loop[i], loop[(i + 1) % loop.size()]});
      piece.walls.push_back(wall != outline.walls.end() ? wall->second : PlanPiece::kNoWall);
    }
    pieces.push_back(std::move(piece));
  }
  double sum = 0, wanted = 0;
  for (std::size_t r = 0; r < rings.size() + pieces.size(); ++r) {
    Ring ring;
    for (const PlanCorner& c : r < rings.size() ? rings[r] : pieces[r - rings.size()].corners) ring.push_back({c.x, c.y, 0});
    (r < rings.size() ? wanted : sum) += signed_area(ring);
  }
  if (!(std::abs(sum - wanted) <= 1e-9 * wanted))
    return Error{ErrorCode::geometry, "", "the rings of the plan cross within rounding: move the corners apart"};
  return pieces;
} catch (const std::exception&) {
  return Error{ErrorCode::geometry, "", "the rings of the plan cross within rounding: move the corners apart"};
}

}  // namespace bl
