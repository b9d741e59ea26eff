// The corner that is farthest beyond the ball goes, by a plane along the ball where the corner would be wrapped to, again and
// again.
#include "core/geometry/inside/cell_trim.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/geometry/cell_mesh.h"
#include "core/geometry/inside/none.h"
#include "core/geometry/tessellate.h"

namespace bl::geometry {

namespace {

// A ball in the middle of a box needs 6 to 8 cuts, and a cap that is thin for its ball some 20.
constexpr int kMostCuts = 48;
// Of the radius: the planes stay so far off the ball, so that no edge touches it by rounding.
constexpr double kGap = 1e-6;

// A convex polyhedron without what lies beyond a plane.
class TrimCut {
 public:
  TrimCut(const Polyhedron& whole, const Vector3& normal, double offset) : whole_(whole) {
    for (const Point3& v : whole.vertices) away_.push_back(dot(normal, v) - offset);
    number_.assign(whole.vertices.size(), kNone);
    for (const PolyhedronFace& face : whole.faces) add(face);
    close(normal, offset);
    for (const Point3& v : left_.vertices) left_.reach_squared = std::max(left_.reach_squared, squared_norm(v));
  }

  Polyhedron take() { return std::move(left_); }

 private:
  bool stays(std::uint32_t v) const { return away_[v] <= 0; }

  std::uint32_t kept(std::uint32_t v) {
    if (number_[v] == kNone) {
      number_[v] = static_cast<std::uint32_t>(left_.vertices.size());
      left_.vertices.push_back(whole_.vertices[v]);
    }
    return number_[v];
  }

  // The place where an edge goes through the plane: made by the first of its two faces.
  std::uint32_t crossing(std::uint32_t a, std::uint32_t b) {
    if (a > b) std::swap(a, b);
    for (const auto& [edge, number] : crossings_)
      if (edge == std::pair{a, b}) return number;
    const auto number = static_cast<std::uint32_t>(left_.vertices.size());
    left_.vertices.push_back(whole_.vertices[a] + away_[a] / (away_[a] - away_[b]) * (whole_.vertices[b] - whole_.vertices[a]));
    crossings_.emplace_back(std::pair{a, b}, number);
    return number;
  }

  void add(const PolyhedronFace& face) {
    const auto loop = whole_.loop(face);
    PolyhedronFace piece = face;
    piece.first = static_cast<std::uint32_t>(left_.loops.size());
    std::uint32_t leaves = kNone, returns = kNone;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t a = loop[i], b = loop[(i + 1) % loop.size()];
      if (stays(a)) left_.loops.push_back(kept(a));
      if (stays(a) == stays(b)) continue;
      left_.loops.push_back(crossing(a, b));
      (stays(a) ? leaves : returns) = left_.loops.back();
    }
    piece.count = static_cast<std::uint32_t>(left_.loops.size()) - piece.first;
    if (piece.count < 3) {
      left_.loops.resize(piece.first);
      return;
    }
    left_.faces.push_back(piece);
    if (leaves != kNone) rim_.emplace_back(returns, leaves);
  }

  // The new face goes along the edges that lack a twin, the other way round.
  void close(const Vector3& normal, double offset) {
    if (rim_.size() < 3) return;
    const auto count = static_cast<std::uint32_t>(rim_.size());
    left_.faces.push_back({normal, offset, FaceKind::frame, 0, static_cast<std::uint32_t>(left_.loops.size()), count});
    std::uint32_t at = rim_.front().first;
    for (std::uint32_t i = 0; i < count; ++i) {
      left_.loops.push_back(at);
      const auto next = std::find_if(rim_.begin(), rim_.end(), [at](const auto& edge) { return edge.first == at; });
      if (next != rim_.end()) at = next->second;
    }
  }

  const Polyhedron& whole_;
  Polyhedron left_;
  std::vector<double> away_;
  std::vector<std::uint32_t> number_;
  std::vector<std::pair<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t>> crossings_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> rim_;  // of the new face, in its own direction
};

// A convex polyhedron is closed where each edge has its twin, and has at least four faces.
bool is_whole(const Polyhedron& shape) {
  if (shape.faces.size() < 4) return false;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const PolyhedronFace& face : shape.faces) {
    const auto loop = shape.loop(face);
    for (std::size_t i = 0; i < loop.size(); ++i) edges.emplace_back(loop[i], loop[(i + 1) % loop.size()]);
  }
  std::sort(edges.begin(), edges.end());
  return std::adjacent_find(edges.begin(), edges.end()) == edges.end() &&
         std::all_of(edges.begin(), edges.end(), [&](const auto& edge) {
           return std::binary_search(edges.begin(), edges.end(), std::pair{edge.second, edge.first});
         });
}

}  // namespace

std::optional<std::vector<Polyhedron>> trimmed_parts(std::span<const Polyhedron> parts, std::span<const ShapeMeasure> shapes,
                                                     const PowerSite& site, const Point3& centroid) {
  const double radius = std::sqrt(site.weight), beyond = radius * (1 + kGap);
  double wanted = 0, volume = 0;
  std::vector<Point3> centres(parts.size());
  const auto volume_of_part = [](const Polyhedron& part) {
    Point3 middle;
    return volume_and_centroid(part, middle);
  };
  for (std::size_t k = 0; k < parts.size(); ++k) {
    centres[k] = wrap_centre(parts[k], site.weight, parts.size() == 1 ? centroid : shapes[k].centroid);
    if (shapes[k].is_empty) continue;
    wanted += shapes[k].volume;
    volume += volume_of_part(parts[k]);
  }
  if (!(volume > kMostTrimmedShare * wanted)) return std::nullopt;
  std::vector<Polyhedron> left(parts.begin(), parts.end());
  for (int cut = 0; cut < kMostCuts && volume > kMostTrimmedShare * wanted; ++cut) {
    double farthest = beyond * beyond;
    Point3 place;
    for (std::size_t k = 0; k < left.size(); ++k) {
      if (shapes[k].is_empty) continue;
      for (const Point3& v : left[k].vertices)
        if (squared_norm(v) > farthest) {
          farthest = squared_norm(v);
          place = place_on_ball(site.weight, centres[k], v);
        }
    }
    if (farthest == beyond * beyond) break;
    const Vector3 normal = place / norm(place);
    std::vector<Polyhedron> next(left.size());
    volume = 0;
    for (std::size_t k = 0; k < left.size(); ++k) {
      if (shapes[k].is_empty) continue;
      next[k] = TrimCut(left[k], normal, beyond).take();
      // Where rounding has torn a piece, what was there before serves as well.
      if (!is_whole(next[k])) return left;
      volume += volume_of_part(next[k]);
    }
    left = std::move(next);
  }
  return left;
}

}  // namespace bl::geometry
