// Each part is convex and its faces are fans, so that a cut is one new face for each part.
#include "core/reading/cell_cut.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "core/base/mathematics.h"

namespace bl::reading {

namespace {

// What lies so near to the cut lies on it [m]: a face of the cell along the cut is not cut again.
constexpr double kOnCut = 1e-6;

class CellCutter {
 public:
  CellCutter(const Mesh& cell, double height, Kept kept)
      : cell_(cell), height_(height), sign_(kept == Kept::below ? 1 : -1), wrap_(*cell.wrap) {}

  MeshPointer cut() {
    std::uint32_t first = 0;
    for (const MeshWrap::Part& part : cell_.wrap->parts) {
      cut_part(part, first);
      first += part.triangles;
    }
    if (made_.triangles.empty()) return nullptr;
    wrap_.parts = std::move(parts_);
    wrap_.seams = std::move(seams_);
    made_.wrap = std::make_shared<const MeshWrap>(std::move(wrap_));
    return std::make_shared<const Mesh>(std::move(made_));
  }

 private:
  // Corners of a face in their order, with its centre.
  struct Face {
    std::uint32_t centre = 0;
    std::vector<std::uint32_t> corners;
  };

  // How far inside the kept half a point lies [m].
  double depth(const Point3& p) const { return sign_ * (height_ - p.z); }
  bool is_kept(std::uint32_t vertex) const { return depth(cell_.vertices[vertex]) >= -kOnCut; }

  std::vector<Face> faces_of(std::uint32_t first, std::uint32_t count) const {
    std::map<std::uint32_t, std::map<std::uint32_t, std::uint32_t>> sides;  // by centre: from each corner to the next one
    for (std::uint32_t t = first; t < first + count; ++t)
      sides[cell_.triangles[t][0]][cell_.triangles[t][1]] = cell_.triangles[t][2];
    std::vector<Face> faces;
    for (const auto& [centre, next] : sides) {
      Face face{centre, {next.begin()->first}};
      for (auto at = next.begin(); at != next.end() && at->second != face.corners.front() && face.corners.size() < next.size();
           at = next.find(at->second))
        face.corners.push_back(at->second);
      faces.push_back(std::move(face));
    }
    return faces;
  }

  std::uint32_t add(const Point3& at, std::uint32_t seams) {
    made_.vertices.push_back(at);
    seams_.push_back(seams);
    return static_cast<std::uint32_t>(made_.vertices.size() - 1);
  }
  std::uint32_t taken_over(std::uint32_t vertex) {
    const auto [at, is_new] = vertices_.try_emplace(vertex, 0);
    if (is_new) at->second = add(cell_.vertices[vertex], cell_.wrap->seams[vertex]);
    return at->second;
  }
  // Where an edge meets the cut: the same vertex for both faces beside it.
  std::uint32_t crossing(std::uint32_t a, std::uint32_t b) {
    if (a > b) std::swap(a, b);
    const auto [at, is_new] = crossings_.try_emplace({a, b}, 0);
    if (!is_new) return at->second;
    const Point3 &p = cell_.vertices[a], &q = cell_.vertices[b];
    const Point3 where = p + std::clamp((height_ - p.z) / (q.z - p.z), 0.0, 1.0) * (q - p);
    return at->second = add(where, cell_.wrap->seams[a] & cell_.wrap->seams[b]);
  }

  void add_fan(std::uint32_t centre, const std::vector<std::uint32_t>& corners) {
    for (std::size_t k = 0; k < corners.size(); ++k)
      made_.triangles.push_back({centre, corners[k], corners[(k + 1) % corners.size()]});
  }
  Point3 middle_of(const std::vector<std::uint32_t>& corners) const {
    Point3 middle;
    for (const std::uint32_t corner : corners) middle += made_.vertices[corner] / static_cast<double>(corners.size());
    return middle;
  }

  void cut_face(const Face& face, std::vector<std::uint32_t>& rim) {
    std::vector<std::uint32_t> left;
    bool is_whole = true;
    for (std::size_t k = 0; k < face.corners.size(); ++k) {
      const std::uint32_t a = face.corners[k], b = face.corners[(k + 1) % face.corners.size()];
      if (is_kept(a)) left.push_back(taken_over(a));
      else is_whole = false;
      if (is_kept(a) == is_kept(b)) continue;
      left.push_back(crossing(a, b));
      rim.push_back(left.back());
    }
    if (left.size() < 3) return;
    // A centre lies on no seam.
    if (is_whole) add_fan(taken_over(face.centre), left);
    else add_fan(add(middle_of(left), 0), left);
  }

  void cut_part(const MeshWrap::Part& part, std::uint32_t first) {
    const auto begin = static_cast<std::uint32_t>(made_.triangles.size());
    const std::size_t vertices = made_.vertices.size();
    vertices_.clear();
    crossings_.clear();
    std::vector<std::uint32_t> rim;
    for (const Face& face : faces_of(first, part.triangles)) cut_face(face, rim);
    std::sort(rim.begin(), rim.end());
    rim.erase(std::unique(rim.begin(), rim.end()), rim.end());
    if (rim.size() >= 3) {
      const Point3 middle = middle_of(rim);
      const auto angle = [&](std::uint32_t v) {
        return sign_ * mathematics::arc_tangent(made_.vertices[v].y - middle.y, made_.vertices[v].x - middle.x);
      };
      std::sort(rim.begin(), rim.end(), [&](std::uint32_t a, std::uint32_t b) { return angle(a) < angle(b); });
      add_fan(add(middle, 0), rim);
    }
    const auto count = static_cast<std::uint32_t>(made_.triangles.size()) - begin;
    if (count == 0) return;
    MeshWrap::Part left{count, part.centre, part.seams};
    const bool has_room = move_centre(left.centre, vertices, [](std::uint32_t) { return true; });
    for (std::size_t s = 0; s < left.seams.size(); ++s)
      move_centre(left.seams[s], vertices, [s](std::uint32_t seams) { return (seams >> s & 1u) != 0; });
    if (has_room) return parts_.push_back(std::move(left));
    // Beyond the cut there is only what the ball takes away.
    made_.triangles.resize(begin);
    made_.vertices.resize(vertices);
    seams_.resize(vertices);
  }

  // Vertices beyond the ball move towards a centre inside it. One that was cut away is replaced by the mean of what is left,
  // which lies inside too, since the part and the ball are convex.
  template <class Counts>
  bool move_centre(Point3& centre, std::size_t from, const Counts& counts) const {
    Point3 sum;
    std::size_t found = 0;
    const Point3& ball = cell_.wrap->ball_centre;
    const double radius = cell_.wrap->radius;
    for (std::size_t v = from; v < made_.vertices.size(); ++v) {
      if (!counts(seams_[v])) continue;
      Point3 p = made_.vertices[v];
      if (distance(p, ball) > radius) {
        // Along the line to the centre until it lies on the ball.
        const Vector3 way = centre - p, off = p - ball;
        const double a = dot(way, way), b = dot(off, way), c = dot(off, off) - radius * radius, inside = b * b - a * c;
        if (!(a > 0) || inside < 0) continue;
        p = p + (-b - std::sqrt(inside)) / a * way;
      }
      if (!(depth(p) > 0)) continue;
      sum += p;
      ++found;
    }
    if (found == 0) return false;
    if (!(depth(centre) > 0)) centre = sum / static_cast<double>(found);
    return true;
  }

  const Mesh& cell_;
  double height_, sign_;
  MeshWrap wrap_;
  Mesh made_;
  std::vector<MeshWrap::Part> parts_;
  std::vector<std::uint32_t> seams_;
  std::map<std::uint32_t, std::uint32_t> vertices_;  // of the cell: those of what is made, in this part
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> crossings_;
};

}  // namespace

MeshPointer cut_cell(const Mesh& cell, double height, Kept kept) {
  if (!cell.wrap || cell.triangles.empty()) return nullptr;
  return CellCutter(cell, height, kept).cut();
}

}  // namespace bl::reading
