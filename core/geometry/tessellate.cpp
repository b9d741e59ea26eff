// Fans of finely divided triangles, with every edge point made once.
#include "core/geometry/tessellate.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace bl::geometry {

namespace {

class Tessellator {
 public:
  Tessellator(std::span<const Point3> corners, std::span<const std::uint32_t> corner_marks, std::span<const FaceLoop> faces,
              int depth)
      : parts_(1u << static_cast<unsigned>(std::clamp(depth, 0, kDeepestTessellation))) {
    std::size_t edges = 0;
    for (const FaceLoop& face : faces) edges += face.size();
    mesh.vertices.assign(corners.begin(), corners.end());
    mesh.vertices.reserve(corners.size() + faces.size() + edges * (parts_ * parts_) / 2 + edges * parts_);
    mesh.triangles.reserve(edges * parts_ * parts_);
    edges_.reserve(edges / 2);
    if (!corner_marks.empty()) marks.assign(corner_marks.begin(), corner_marks.end());
    for (const FaceLoop& face : faces) add_face(face);
  }

  Mesh mesh;
  std::vector<std::uint32_t> marks;  // of the vertices so far; none at all where no corner lies on a seam

  // The vertices on edges that only one face has.
  std::vector<std::uint32_t> border() const {
    std::vector<std::uint32_t> found;
    for (const Line& line : edges_)
      for (std::uint32_t i = 0; i <= parts_; ++i) found.push_back(line.at(i, parts_));
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

 private:
  // The points of a divided line from a to b: end points named by index, inner points consecutive, in one of two directions.
  struct Line {
    std::uint32_t from = 0, to = 0, inner = 0;
    bool is_reversed = false;
    std::uint32_t at(std::uint32_t step, std::uint32_t parts) const {
      if (step == 0) return from;
      if (step == parts) return to;
      return inner + (is_reversed ? parts - step : step) - 1;
    }
  };

  Line make_line(std::uint32_t from, std::uint32_t to) {
    const Line line{from, to, static_cast<std::uint32_t>(mesh.vertices.size()), false};
    const Point3 a = mesh.vertices[from], b = mesh.vertices[to];
    for (std::uint32_t i = 1; i < parts_; ++i) mesh.vertices.push_back(a + (i / static_cast<double>(parts_)) * (b - a));
    return line;
  }

  // An edge of the polyhedron: divided when the first of its two faces asks, read backwards by the other.
  Line edge(std::uint32_t from, std::uint32_t to) {
    for (std::size_t e = edges_.size(); e-- > 0;) {
      if (edges_[e].from != to || edges_[e].to != from) continue;
      const Line found{from, to, edges_[e].inner, true};
      edges_[e] = edges_.back();
      edges_.pop_back();
      return found;
    }
    edges_.push_back(make_line(from, to));
    // Only edges between corners lie on seams: what is made inside a face has no mark.
    if (const std::uint32_t both = mark_of(from) & mark_of(to); both != 0) {
      marks.resize(mesh.vertices.size(), 0);
      std::fill(marks.begin() + edges_.back().inner, marks.end(), both);
    }
    return edges_.back();
  }

  std::uint32_t mark_of(std::uint32_t vertex) const { return vertex < marks.size() ? marks[vertex] : 0; }

  void add_face(const FaceLoop& face) {
    const std::uint32_t count = static_cast<std::uint32_t>(face.size());
    Point3 middle;
    for (const std::uint32_t v : face) middle += mesh.vertices[v];
    const std::uint32_t centre = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back(middle / static_cast<double>(count));
    const Line first = make_line(centre, face[0]);
    Line left = first;
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t a = face[i], b = face[(i + 1) % count];
      const Line right = i + 1 == count ? first : make_line(centre, b);
      add_triangle(left, right, edge(a, b));
      left = right;
    }
  }

  // The triangle between two spokes and an edge, in rows of growing length from the centre outwards.
  void add_triangle(const Line& left, const Line& right, const Line& rim) {
    above_.assign(1, left.from);
    for (std::uint32_t row = 1; row <= parts_; ++row) {
      below_.clear();
      if (row == parts_) {
        for (std::uint32_t i = 0; i <= parts_; ++i) below_.push_back(rim.at(i, parts_));
      } else {
        const std::uint32_t start = left.at(row, parts_), end = right.at(row, parts_);
        const Point3 a = mesh.vertices[start], b = mesh.vertices[end];
        below_.push_back(start);
        for (std::uint32_t i = 1; i < row; ++i) {
          below_.push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
          mesh.vertices.push_back(a + (i / static_cast<double>(row)) * (b - a));
        }
        below_.push_back(end);
      }
      for (std::uint32_t i = 0; i < row; ++i) {
        mesh.triangles.push_back({above_[i], below_[i], below_[i + 1]});
        if (i + 1 < row) mesh.triangles.push_back({above_[i], below_[i + 1], above_[i + 1]});
      }
      above_.swap(below_);
    }
  }

  std::uint32_t parts_;
  std::vector<Line> edges_;  // divided by one face, still waiting for the other
  std::vector<std::uint32_t> above_, below_;
};

}  // namespace

Point3 place_on_ball(double squared_radius, const Point3& inside, const Point3& beyond) {
  // inside + t (beyond - inside) on the sphere; t in (0, 1] because `inside` is in the ball and `beyond` is not.
  const Vector3 way = beyond - inside;
  const double a = squared_norm(way), b = dot(way, inside), rest = std::max(0.0, squared_radius - squared_norm(inside));
  const double root = std::sqrt(b * b + a * rest), t = b > 0 ? rest / (b + root) : (root - b) / a;
  return inside + std::min(1.0, t) * way;
}

Mesh tessellate(std::span<const Point3> corners, std::span<const FaceLoop> faces, int depth, double radius,
                const WrapTargets& targets, const Vector3& offset, std::vector<std::uint32_t>* border) {
  Tessellator work(corners, targets.marks, faces, depth);
  if (border != nullptr) *border = work.border();
  Mesh mesh = std::move(work.mesh);
  const double squared = radius * radius;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    Point3& vertex = mesh.vertices[v];
    if (squared_norm(vertex) > squared) {
      const std::uint32_t marks = v < work.marks.size() ? work.marks[v] : 0;
      const auto seam = static_cast<std::size_t>(std::countr_zero(marks));
      vertex = place_on_ball(squared, marks == 0 ? targets.centre : targets.seams[seam], vertex);
    }
    vertex += offset;
  }
  return mesh;
}

}  // namespace bl::geometry
