// Constrained Delaunay triangulation of a plan, and its triangles put together again to few convex polygons.
#include "core/geometry/inside/plan_pieces.h"

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

namespace bl::geometry {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
// Of a face: is it inside the plan?
using FaceBase = CGAL::Constrained_triangulation_face_base_2<Kernel, CGAL::Triangulation_face_base_with_info_2<bool, Kernel>>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>>;

// Constraints that cross get a new corner there, rounded; which side of which is decided exactly all the same.
using CrossingTriangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
                                               CGAL::Exact_predicates_tag>;

using Edge = std::pair<std::uint32_t, std::uint32_t>;
using Loop = std::vector<std::uint32_t>;

// Pieces of a plan turn at each corner by more than this, so that no two walls of one are as good as one.
constexpr double kBend = 1e-9;

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
  /// A corner stays convex where it turns by more than `least_bend`, in terms of the lengths of its sides.
  Merger(const std::vector<PlanCorner>& corners, const std::vector<std::array<std::uint32_t, 3>>& triangles, double least_bend)
      : corners_(corners), least_bend_(least_bend) {
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
    const PlanCorner &a = corners_[edge.first], &b = corners_[edge.second];
    return std::sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y));
  }

  void remove(const Edge& edge) {
    const auto here = owner_.find(edge), there = owner_.find({edge.second, edge.first});
    if (here == owner_.end() || there == owner_.end() || here->second == there->second) return;  // gone with another one
    const std::uint32_t left = here->second, right = there->second;
    // a runs from the second end to the first, b back again; what else they share next to the edge goes with it.
    Loop a = turned(loops_[left], edge.second), b = turned(loops_[right], edge.first);
    std::vector<Edge> shared{edge};
    while (a.size() > 2 && b.size() > 2 && a[1] == b[b.size() - 2]) {
      shared.push_back({a[0], a[1]});
      a.erase(a.begin());
      b.pop_back();
    }
    while (a.size() > 2 && b.size() > 2 && a[a.size() - 2] == b[1]) {
      shared.push_back({b[0], b[1]});
      a.pop_back();
      b.erase(b.begin());
    }
    if (a.size() < 3 && b.size() < 3) return;
    if (!is_convex(a[a.size() - 2], b.front(), b[1]) || !is_convex(b[b.size() - 2], a.front(), a[1])) return;
    a.insert(a.end(), b.begin() + 1, b.end() - 1);
    for (const Edge& gone : shared) {
      owner_.erase(gone);
      owner_.erase({gone.second, gone.first});
    }
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
    const double bend = turn(corners_[before], corners_[at], corners_[after]);
    return bend > least_bend_ * length({before, at}) * length({at, after});
  }

  const std::vector<PlanCorner>& corners_;
  double least_bend_;
  std::vector<Loop> loops_;
  std::map<Edge, std::uint32_t> owner_;
};

// Which diagonals go first decides how many pieces are left; a few orders are tried, and the first of the best is taken.
std::vector<Loop> few_loops(const std::vector<PlanCorner>& corners, const std::vector<std::array<std::uint32_t, 3>>& triangles,
                            double least_bend) {
  std::vector<Loop> best;
  for (const double sign : {1.0, -1.0, 0.0}) {
    Merger merger(corners, triangles, least_bend);
    std::vector<Edge> edges = merger.diagonals();
    std::stable_sort(edges.begin(), edges.end(),
                     [&](const Edge& a, const Edge& b) { return sign * merger.length(a) < sign * merger.length(b); });
    for (const Edge& edge : edges) merger.remove(edge);
    std::vector<Loop> loops = merger.loops();
    if (best.empty() || loops.size() < best.size()) best = std::move(loops);
  }
  return best;
}

struct CutPlane {
  std::vector<PlanCorner> corners;
  std::map<int, std::vector<std::array<std::uint32_t, 3>>> triangles;  // per label
};

double extent_of(const std::vector<std::vector<PlanCorner>>& rings) {
  double extent = 0;
  for (const auto& ring : rings)
    for (const PlanCorner& c : ring) extent = std::max({extent, std::abs(c.x - rings[0][0].x), std::abs(c.y - rings[0][0].y)});
  return extent;
}

CutPlane cut_plane(const std::vector<std::vector<PlanCorner>>& rings, const std::function<int(const Point3&)>& label_at) {
  CrossingTriangulation triangulation;
  std::vector<std::array<double, 4>> sides;
  for (const auto& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const PlanCorner &a = ring[i], &b = ring[(i + 1) % ring.size()];
      // From the lower end on, so that the way a ring turns does not matter.
      if (std::tuple(a.y, a.x) < std::tuple(b.y, b.x)) sides.push_back({a.y, a.x, b.y, b.x});
      else sides.push_back({b.y, b.x, a.y, a.x});
    }
  }
  std::sort(sides.begin(), sides.end());
  for (const auto& s : sides) triangulation.insert_constraint(Kernel::Point_2(s[1], s[0]), Kernel::Point_2(s[3], s[2]));
  std::vector<CrossingTriangulation::Vertex_handle> order;
  for (auto v = triangulation.finite_vertices_begin(); v != triangulation.finite_vertices_end(); ++v) order.push_back(v);
  std::sort(order.begin(), order.end(), [](const auto& a, const auto& b) {
    return std::tuple(a->point().y(), a->point().x()) < std::tuple(b->point().y(), b->point().x());
  });
  CutPlane cut;
  // Crossings that fall together but for rounding are one corner, in all triangles alike.
  const double same = 1e-11 * extent_of(rings);
  for (const auto& vertex : order) {
    const double x = vertex->point().x(), y = vertex->point().y();
    std::size_t known = cut.corners.size();
    while (known > 0 && cut.corners[known - 1].y >= y - same && std::abs(cut.corners[known - 1].x - x) > same) --known;
    if (known > 0 && cut.corners[known - 1].y >= y - same) {
      vertex->info() = static_cast<std::uint32_t>(known - 1);
      continue;
    }
    vertex->info() = static_cast<std::uint32_t>(cut.corners.size());
    cut.corners.push_back({x, y, 0});
  }
  for (auto face = triangulation.finite_faces_begin(); face != triangulation.finite_faces_end(); ++face) {
    std::array<std::uint32_t, 3> t{};
    Vector3 sum;
    for (unsigned i = 0; i < 3; ++i) {
      t[i] = face->vertex(static_cast<int>(i))->info();
      sum += {cut.corners[t[i]].x, cut.corners[t[i]].y, 0};
    }
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    if (const int label = label_at(sum / 3); label >= 0) cut.triangles[label].push_back(t);
  }
  for (auto& [label, triangles] : cut.triangles) std::sort(triangles.begin(), triangles.end());
  return cut;
}

}  // namespace

Result<std::vector<LabelledPolygon>> labelled_pieces(const std::vector<std::vector<PlanCorner>>& rings,
                                                     const std::function<int(const Point3&)>& label_at) try {
  const CutPlane cut = cut_plane(rings, label_at);
  std::vector<LabelledPolygon> polygons;
  for (const auto& [label, triangles] : cut.triangles) {
    for (const Loop& loop : few_loops(cut.corners, triangles, -1e-12)) {
      LabelledPolygon polygon{{}, label};
      const std::size_t n = loop.size();
      for (std::size_t i = 0; i < n; ++i) {
        const PlanCorner &before = cut.corners[loop[(i + n - 1) % n]], &at = cut.corners[loop[i]],
                         &after = cut.corners[loop[(i + 1) % n]];
        const double in = (at.x - before.x) * (at.x - before.x) + (at.y - before.y) * (at.y - before.y);
        const double out = (after.x - at.x) * (after.x - at.x) + (after.y - at.y) * (after.y - at.y);
        if (turn(before, at, after) > 1e-11 * std::sqrt(in * out)) polygon.corners.push_back(at);
      }
      if (polygon.corners.size() > 2) polygons.push_back(std::move(polygon));
    }
  }
  return polygons;
} catch (const std::exception&) {
  return Error{ErrorCode::geometry, "", "the rings of the plan cross within rounding: move the corners apart"};
}

Result<std::vector<PlanPiece>> plan_pieces(const std::vector<std::vector<PlanCorner>>& rings) try {
  const Outline outline = outline_of(rings);
  std::vector<PlanPiece> pieces;
  for (const Loop& loop : few_loops(outline.corners, inner_triangles(outline), kBend)) {
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

}  // namespace bl::geometry
