// Cutting a convex polyhedron by planes, with one decision per vertex.
#include "core/geometry/clipper.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace bl {

namespace {

constexpr std::uint32_t kNone = 0xffffffffu;
// A vertex is touching, not cut, within this share of the polyhedron's reach (and of its first reach, whose rounding the
// early vertices carry). About fifty roundings: enough to swallow the noise of lattices, far below any measure that matters.
constexpr double kTouchShare = 1e-14, kFirstTouchShare = 1e-15;

}  // namespace

void Clipper::measure_reach() {
  reach_squared_ = 0;
  for (const Point3& v : vertices) reach_squared_ = std::max(reach_squared_, squared_norm(v));
}

void Clipper::start(const ConvexDomain& domain, const Point3& origin) {
  vertices.clear();
  faces.clear();
  loops.clear();
  for (const Point3& v : domain.vertices) vertices.push_back(v - origin);
  for (std::uint32_t k = 0; k < domain.faces.size(); ++k) {
    const auto& loop = domain.faces[k];
    if (loop.size() < 3) continue;
    ClippedFace face;
    face.normal = domain.planes[k].normal;
    // From a corner instead of the stored offset: far from the world's origin that keeps the digits.
    face.offset = dot(face.normal, vertices[loop.front()]);
    face.index = k;
    face.first = static_cast<std::uint32_t>(loops.size());
    face.count = static_cast<std::uint32_t>(loop.size());
    loops.insert(loops.end(), loop.begin(), loop.end());
    faces.push_back(face);
  }
  measure_reach();
  start_reach_ = std::sqrt(reach_squared_);
}

void Clipper::start_box(const Vector3& minimum, const Vector3& maximum, std::uint32_t box_index) {
  static constexpr std::array<std::array<std::uint32_t, 4>, 6> kLoops{
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  vertices.clear();
  faces.clear();
  loops.clear();
  for (unsigned corner = 0; corner < 8; ++corner) {
    vertices.push_back(
        {(corner & 1u) ? maximum.x : minimum.x, (corner & 2u) ? maximum.y : minimum.y, (corner & 4u) ? maximum.z : minimum.z});
  }
  const std::array<Plane, 6> planes{{{{-1, 0, 0}, -minimum.x},
                                     {{1, 0, 0}, maximum.x},
                                     {{0, -1, 0}, -minimum.y},
                                     {{0, 1, 0}, maximum.y},
                                     {{0, 0, -1}, -minimum.z},
                                     {{0, 0, 1}, maximum.z}}};
  for (unsigned side = 0; side < 6; ++side) {
    ClippedFace face{planes[side].normal, planes[side].offset, FacetArea::Kind::plane, box_index, 4 * side, 4};
    loops.insert(loops.end(), kLoops[side].begin(), kLoops[side].end());
    faces.push_back(face);
  }
  measure_reach();
  start_reach_ = std::sqrt(reach_squared_);
}

// The vertex where the edge from a staying to a leaving vertex meets the plane: made once, found again by the other face.
std::uint32_t Clipper::crossing(std::uint32_t inner, std::uint32_t outer) {
  for (std::uint32_t c = 0; c < crossings_.size(); ++c) {
    if (crossings_[c].inner == inner && crossings_[c].outer == outer) return c;
  }
  const double s_inner = std::min(0.0, side_[inner]);
  const double share = s_inner / (s_inner - side_[outer]);
  new_vertices_.push_back(vertices[inner] + share * (vertices[outer] - vertices[inner]));
  crossings_.push_back({inner, outer, kNone});
  return static_cast<std::uint32_t>(crossings_.size() - 1);
}

// Rewrites one face's loop without the vertices that leave, and links its new edge, reversed, into the new face.
void Clipper::cut_face(const ClippedFace& face) {
  const std::uint32_t first = static_cast<std::uint32_t>(new_loops_.size());
  std::uint32_t last_exit = kNone, unpaired_entry = kNone;
  for (std::uint32_t i = 0; i < face.count; ++i) {
    const std::uint32_t a = loops[face.first + i], b = loops[face.first + (i + 1 == face.count ? 0 : i + 1)];
    const bool a_stays = number_[a] != kNone, b_stays = number_[b] != kNone;
    if (a_stays) new_loops_.push_back(number_[a]);
    if (a_stays == b_stays) continue;
    const std::uint32_t c = a_stays ? crossing(a, b) : crossing(b, a);
    new_loops_.push_back(kept_ + c);
    if (a_stays) {
      last_exit = c;
    } else if (last_exit == kNone) {
      unpaired_entry = c;
    } else {
      crossings_[c].next = last_exit;
      last_exit = kNone;
    }
  }
  if (unpaired_entry != kNone) crossings_[unpaired_entry].next = last_exit;
  const std::uint32_t count = static_cast<std::uint32_t>(new_loops_.size()) - first;
  if (count == 0) return;
  new_faces_.push_back(face);
  new_faces_.back().first = first;
  new_faces_.back().count = count;
}

// The new face: the cycles of the links. There is one, unless rounding has split what is cut away.
void Clipper::close_cut(const Vector3& normal, double offset, FacetArea::Kind kind, std::uint32_t index) {
  for (std::uint32_t start = 0; start < crossings_.size(); ++start) {
    if (crossings_[start].next == kNone) continue;
    const std::uint32_t first = static_cast<std::uint32_t>(new_loops_.size());
    for (std::uint32_t c = start; crossings_[c].next != kNone;) {
      new_loops_.push_back(kept_ + c);
      const std::uint32_t next = crossings_[c].next;
      crossings_[c].next = kNone;
      c = next;
    }
    const std::uint32_t count = static_cast<std::uint32_t>(new_loops_.size()) - first;
    if (count < 3) {
      new_loops_.resize(first);  // the two faces along the new edge are already each other's twins
    } else {
      new_faces_.push_back({normal, offset, kind, index, first, count});
    }
  }
}

bool Clipper::cut(const Vector3& normal, double offset, FacetArea::Kind kind, std::uint32_t index) {
  if (vertices.empty()) return false;
  const double reach = std::sqrt(reach_squared_);
  if (offset > reach) return true;
  const double tolerance = kTouchShare * reach + kFirstTouchShare * start_reach_;
  const std::size_t count = vertices.size();
  side_.resize(count);
  number_.resize(count);
  new_vertices_.clear();
  for (std::size_t v = 0; v < count; ++v) {
    side_[v] = dot(normal, vertices[v]) - offset;
    const bool stays = !(side_[v] > tolerance);
    number_[v] = stays ? static_cast<std::uint32_t>(new_vertices_.size()) : kNone;
    if (stays) new_vertices_.push_back(vertices[v]);
  }
  if (new_vertices_.size() == count) return true;
  if (new_vertices_.empty()) {
    vertices.clear();
    faces.clear();
    loops.clear();
    reach_squared_ = 0;
    return false;
  }
  kept_ = static_cast<std::uint32_t>(new_vertices_.size());
  crossings_.clear();
  new_faces_.clear();
  new_loops_.clear();
  for (const ClippedFace& face : faces) cut_face(face);
  close_cut(normal, offset, kind, index);
  vertices.swap(new_vertices_);
  faces.swap(new_faces_);
  loops.swap(new_loops_);
  measure_reach();
  return true;
}

double Clipper::volume_and_centroid(Point3& centroid) const {
  if (vertices.empty()) return 0;
  Point3 middle;
  for (const Point3& v : vertices) middle += v;
  middle *= 1 / static_cast<double>(vertices.size());
  double six_volumes = 0;
  Vector3 moment;
  for (const ClippedFace& face : faces) {
    const Vector3 a = vertices[loops[face.first]] - middle;
    for (std::uint32_t i = 1; i + 1 < face.count; ++i) {
      const Vector3 b = vertices[loops[face.first + i]] - middle, c = vertices[loops[face.first + i + 1]] - middle;
      const double six = dot(a, cross(b, c));
      six_volumes += six;
      moment += six * (a + b + c);
    }
  }
  centroid = six_volumes > 0 ? middle + moment / (4 * six_volumes) : middle;
  return std::max(0.0, six_volumes / 6);
}

}  // namespace bl
