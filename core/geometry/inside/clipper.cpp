// Cutting a convex polyhedron by planes, with one decision per vertex.
#include "core/geometry/inside/clipper.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>
#include "core/geometry/inside/wide_registers.h"

namespace bl::geometry {

namespace {

// A vertex is touching, not cut, within this share of the polyhedron's reach (and of its first reach, whose rounding the
// early vertices carry). About fifty roundings: enough to swallow the noise of lattices, far below any measure that matters.
constexpr double kTouchShare = 1e-14, kFirstTouchShare = 1e-15;
// Within this share of the reach another order of the cuts may decide otherwise.
constexpr double kTouchyShare = 1e-12;
// A plane that is farther away than so many tolerances neither cuts nor is touchy, whatever the rounding says.
constexpr double kClearTolerances = 1e5;
// A vertex of a start is put onto the domain's own corner within this share of the domain's size.
constexpr double kSnapShare = 1e-9;

constexpr std::array<std::uint32_t, 3> kNext{1, 2, 0}, kPrevious{2, 0, 1};

}  // namespace

// An edge to a vertex where it is the one in slot `slot_back`; and that slot again.
std::uint32_t Clipper::edge_to(std::uint32_t vertex, std::uint32_t slot_back) { return 4 * vertex + kPrevious[slot_back]; }
std::uint32_t Clipper::slot_back(std::uint32_t edge) { return kNext[edge % 4]; }

void Clipper::reserve(std::size_t vertices) {
  if (vertices + kVertexLanes <= x_.size()) return;
  const std::size_t room = padded_to_lanes(2 * vertices + 64);
  x_.resize(room);
  y_.resize(room);
  z_.resize(room);
  beyond_.resize(room);
  corners_.resize(room);
  squared_.resize(room);
  taken_.resize(room / 64 + 1);
  leaving_.resize(room);
  rim_.resize(3 * room);
  fresh_.resize(3 * room);
}

void Clipper::set_place(std::uint32_t vertex, const Point3& at) {
  x_[vertex] = at.x;
  y_[vertex] = at.y;
  z_[vertex] = at.z;
  squared_[vertex] = squared_norm(at);
}

void Clipper::measure_reach() {
  for (std::size_t v = size_; v < padded_to_lanes(size_); ++v) {
    x_[v] = x_[size_ - 1];
    y_[v] = y_[size_ - 1];
    z_[v] = z_[size_ - 1];
    squared_[v] = squared_[size_ - 1];
  }
  reach_squared_ = largest_of_lanes(squared_.data(), size_);
  reach_ = std::sqrt(reach_squared_);
}

Clipper::Start::Start(const ConvexDomain& domain, const std::vector<std::uint32_t>& sides) {
  // Cut from a box around the domain: that splits corners where more than three faces meet.
  const Point3 origin = domain.centroid;
  const double size = domain.size();
  const Vector3 margin{0.25 * size, 0.25 * size, 0.25 * size};
  Clipper shape;
  shape.start_box(domain.minimum - origin - margin, domain.maximum - origin + margin);
  const Polyhedron planes = polyhedron_of(domain, origin);
  for (const PolyhedronFace& face : planes.faces) {
    const std::uint32_t side = sides.empty() ? face.index : sides[face.index];
    shape.cut(face.normal, face.offset, side == kInnerSide ? FaceKind::inner : FaceKind::plane, side);
    sides_.push_back({face.normal, domain.vertices[domain.faces[face.index].front()],
                      side == kInnerSide ? FaceKind::inner : FaceKind::plane, side});
  }
  // Sides of the clipper: six of the box, then those that cut, in the order above; a plane that did not cut has no face.
  std::vector<Side> kept;
  for (std::size_t k = 6; k < shape.sides_.size(); ++k) {
    const auto same = std::find_if(sides_.begin(), sides_.end(), [&](const Side& side) {
      return side.normal == shape.sides_[k].normal && side.index == shape.sides_[k].index;
    });
    kept.push_back(*same);
  }
  sides_ = std::move(kept);
  for (std::uint32_t v = 0; v < shape.size_; ++v) {
    const Point3 at = Point3{shape.x_[v], shape.y_[v], shape.z_[v]} + origin;
    const auto nearest = std::min_element(domain.vertices.begin(), domain.vertices.end(), [&](const Point3& a, const Point3& b) {
      return squared_norm(a - at) < squared_norm(b - at);
    });
    vertices_.push_back(distance(*nearest, at) <= kSnapShare * size ? *nearest : at);
    const Corner& corner = shape.corners_[v];
    corners_.push_back(
        {corner.plane[0] - 6, corner.plane[1] - 6, corner.plane[2] - 6, corner.next[0], corner.next[1], corner.next[2]});
  }
}

void Clipper::start(const Start& from, const Point3& origin) {
  size_ = static_cast<std::uint32_t>(from.vertices_.size());
  is_touchy_ = has_reaches_ = false;
  reserve(size_);
  sides_.clear();
  for (const Start::Side& side : from.sides_) {
    // From a corner instead of a stored offset: far from the world's origin that keeps the digits.
    sides_.push_back({side.normal, dot(side.normal, side.anchor - origin), side.kind, side.index});
  }
  for (std::uint32_t v = 0; v < size_; ++v) {
    set_place(v, from.vertices_[v] - origin);
    const auto& corner = from.corners_[v];
    corners_[v] = {{corner[0], corner[1], corner[2]}, {corner[3], corner[4], corner[5]}, v};
  }
  measure_reach();
  start_reach_ = reach_;
}

void Clipper::start_box(const Vector3& minimum, const Vector3& maximum) {
  size_ = 8;
  is_touchy_ = has_reaches_ = false;
  reserve(size_);
  sides_.clear();
  const std::array<Plane, 6> planes{{{{-1, 0, 0}, -minimum.x},
                                     {{1, 0, 0}, maximum.x},
                                     {{0, -1, 0}, -minimum.y},
                                     {{0, 1, 0}, maximum.y},
                                     {{0, 0, -1}, -minimum.z},
                                     {{0, 0, 1}, maximum.z}}};
  for (std::uint32_t k = 0; k < 6; ++k) sides_.push_back({planes[k].normal, planes[k].offset, FaceKind::frame, k});
  for (std::uint32_t v = 0; v < 8; ++v) {
    const bool east = (v & 1u) != 0, north = (v & 2u) != 0, up = (v & 4u) != 0;
    set_place(v, {east ? maximum.x : minimum.x, north ? maximum.y : minimum.y, up ? maximum.z : minimum.z});
    const std::uint32_t x = east ? 1 : 0, y = north ? 3 : 2, z = up ? 5 : 4;
    // Around a vertex with an odd number of positive sides x, y, z is counter-clockwise; around its neighbours x, z, y is.
    if ((east != north) != up) {
      corners_[v] = {{x, y, z}, {edge_to(v ^ 1u, 0), edge_to(v ^ 2u, 2), edge_to(v ^ 4u, 1)}, v};
    } else {
      corners_[v] = {{x, z, y}, {edge_to(v ^ 1u, 0), edge_to(v ^ 4u, 2), edge_to(v ^ 2u, 1)}, v};
    }
  }
  measure_reach();
  start_reach_ = reach_;
}

void Clipper::copy(const Clipper& other) {
  size_ = other.size_;
  reserve(size_);
  std::copy_n(other.x_.begin(), size_, x_.begin());
  std::copy_n(other.y_.begin(), size_, y_.begin());
  std::copy_n(other.z_.begin(), size_, z_.begin());
  std::copy_n(other.squared_.begin(), size_, squared_.begin());
  std::copy_n(other.corners_.begin(), size_, corners_.begin());
  sides_ = other.sides_;
  is_touchy_ = other.is_touchy_;
  has_reaches_ = false;
  start_reach_ = other.start_reach_;
  if (size_ > 0) measure_reach();
}

double Clipper::tolerance() const { return kTouchShare * reach_ + kFirstTouchShare * start_reach_; }

void Clipper::measure_reaches() {
  has_reaches_ = size_ > 0;
  if (has_reaches_) reaches_.measure({x_.data(), y_.data(), z_.data(), size_});
}

bool Clipper::is_clear_of(const Vector3& along, double most) const {
  if (!has_reaches_) return false;
  const double size = std::abs(along.x) + std::abs(along.y) + std::abs(along.z);
  return reaches_.bound(along) + kClearTolerances * tolerance() * size < most;
}

// Signed distances of all vertices from the plane; those beyond are taken. Is there one?
bool Clipper::judge(const Vector3& normal, double offset, double tolerance) {
  const PlaneSides sides =
      find_plane_sides({x_.data(), y_.data(), z_.data(), size_}, normal, offset, tolerance, beyond_.data(), taken_.data());
  if (sides.nearest <= tolerance * (kTouchyShare / kTouchShare)) is_touchy_ = true;
  return sides.is_any_beyond;
}

// Lists the vertices that go, and the edges from them to vertices that stay, in any order. Returns the number of these edges.
std::uint32_t Clipper::find_rim() {
  const std::uint64_t* const taken = taken_.data();
  const Corner* const corners = corners_.data();
  std::uint32_t *const leaving = leaving_.data(), *const rim = rim_.data();
  std::uint32_t count = 0, leaving_count = 0;
  for (std::uint32_t first = 0; first < size_; first += 64) {
    for (std::uint64_t bits = taken[first / 64]; bits != 0; bits &= bits - 1) {
      const std::uint32_t v = first + static_cast<std::uint32_t>(std::countr_zero(bits));
      leaving[leaving_count++] = v;
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t u = end_of(corners[v].next[k]);
        rim[count] = 4 * v + k;
        count += (~taken[u / 64] >> (u % 64)) & 1u;
      }
    }
  }
  leaving_count_ = leaving_count;
  return count;
}

// A fresh vertex for each edge of the rim.
void Clipper::place_fresh(std::uint32_t count) {
  if (left_of_.size() < sides_.size()) left_of_.resize(2 * sides_.size(), 0);
  const double *const x = x_.data(), *const y = y_.data(), *const z = z_.data(), *const beyond = beyond_.data();
  const Corner* const corners = corners_.data();
  const std::uint32_t* const rim = rim_.data();
  std::uint32_t* const left_of = left_of_.data();
  Fresh* const all_fresh = fresh_.data();
  for (std::uint32_t i = 0; i < count; ++i) {
    Fresh& fresh = all_fresh[i];
    const std::uint32_t v = rim[i] / 4, k = rim[i] % 4, edge = corners[v].next[k], u = end_of(edge);
    const double inside = std::min(0.0, beyond[u]), share = inside / (inside - beyond[v]);
    fresh.at = {x[u] + share * (x[v] - x[u]), y[u] + share * (y[v] - y[u]), z[u] + share * (z[v] - z[u])};
    fresh.kept = u;
    fresh.back = slot_back(edge);
    fresh.left = corners[v].plane[kNext[k]];
    fresh.right = corners[v].plane[kPrevious[k]];
    left_of[fresh.left] = i;
  }
}

// Do the fresh vertices, each followed by the one that has its right face on the left, make one ring around what goes?
bool Clipper::is_ring(std::uint32_t count) const {
  const std::uint32_t* const left_of = left_of_.data();
  const Fresh* const fresh = fresh_.data();
  std::uint32_t at = 0, steps = 0;
  do {
    const std::uint32_t face = fresh[at].right;
    at = left_of[face];
    if (at >= count || fresh[at].left != face) return false;
    ++steps;
  } while (at != 0 && steps < count);
  return at == 0 && steps == count;
}

// Rounding has torn what goes, or what stays, into parts: only the part around the farthest vertex goes, and of what stays the
// largest part does. Rare, so no care for speed.
void Clipper::untangle(double tolerance) {
  const auto connected = [&](std::uint32_t seed, const auto& belongs, std::vector<std::uint8_t>& seen) {
    std::vector<std::uint32_t> part{seed};
    seen[seed] = 1;
    for (std::size_t i = 0; i < part.size(); ++i) {
      for (const std::uint32_t edge : corners_[part[i]].next) {
        const std::uint32_t w = end_of(edge);
        if (seen[w] || !belongs(w)) continue;
        seen[w] = 1;
        part.push_back(w);
      }
    }
    return part;
  };
  const auto farthest = std::max_element(beyond_.begin(), beyond_.begin() + size_) - beyond_.begin();
  std::vector<std::uint8_t> seen(size_, 0);
  connected(
      static_cast<std::uint32_t>(farthest), [&](std::uint32_t w) { return beyond_[w] > tolerance; }, seen);
  const std::vector<std::uint8_t> gone = seen;
  std::vector<std::uint32_t> largest_part;
  for (std::uint32_t v = 0; v < size_; ++v) {
    if (seen[v]) continue;
    const auto part = connected(
        v, [&](std::uint32_t w) { return !gone[w]; }, seen);
    if (part.size() > largest_part.size()) largest_part = part;
  }
  for (std::uint32_t v = 0; v < size_; ++v) taken_[v / 64] |= std::uint64_t{1} << (v % 64);
  for (const std::uint32_t v : largest_part) taken_[v / 64] &= ~(std::uint64_t{1} << (v % 64));
  for (std::uint32_t v = 0; v < size_; ++v) {
    // A vertex that goes along without lying beyond counts as lying on the plane.
    if (is_taken(v)) beyond_[v] = std::max(beyond_[v], tolerance);
  }
}

// Links the fresh vertices in a ring around the new face. They take the places of those that leave.
void Clipper::close_rim(std::uint32_t plane, std::uint32_t count) {
  std::uint32_t* const places = leaving_.data();
  const std::uint32_t* const left_of = left_of_.data();
  const Fresh* const all_fresh = fresh_.data();
  Corner* const corners = corners_.data();
  for (std::uint32_t i = leaving_count_; i < count; ++i) places[i] = size_ + i - leaving_count_;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Fresh& fresh = all_fresh[i];
    const std::uint32_t at = places[i], after = places[left_of[fresh.right]];
    corners[fresh.kept].next[fresh.back] = edge_to(at, 0);
    Corner& corner = corners[at];
    corner.plane = {plane, fresh.left, fresh.right};
    corner.next[0] = edge_to(fresh.kept, fresh.back);
    corner.next[1] = edge_to(after, 2);
    corner.given = kNone;
    corners[after].next[2] = edge_to(at, 1);
    set_place(at, fresh.at);
  }
  size_ += std::max(count, leaving_count_) - leaving_count_;
}

void Clipper::move_vertex(std::uint32_t from, std::uint32_t to) {
  x_[to] = x_[from];
  y_[to] = y_[from];
  z_[to] = z_[from];
  squared_[to] = squared_[from];
  corners_[to] = corners_[from];
  for (std::uint32_t k = 0; k < 3; ++k) {
    const std::uint32_t edge = corners_[to].next[k];
    corners_[end_of(edge)].next[slot_back(edge)] = edge_to(to, k);
  }
}

// Fills the places that are still free from the end. Places before `fresh` in the list of those that leave are filled already.
void Clipper::remove_taken(std::uint32_t fresh) {
  std::uint32_t last = leaving_count_;  // the list ascends: what leaves at the end of the arrays is at the end of the list
  for (std::uint32_t i = fresh; i < last; ++i) {
    while (i < last && leaving_[last - 1] == size_ - 1) {
      --last;
      --size_;
    }
    if (i == last) return;
    move_vertex(--size_, leaving_[i]);
  }
}

BL_WIDE_REGISTERS bool Clipper::cut(const Vector3& normal, double offset, FaceKind kind, std::uint32_t index) {
  if (size_ == 0) return false;
  if (offset > 0 && offset * offset > reach_squared_) return true;
  const double tolerance = this->tolerance();
  if (!judge(normal, offset, tolerance)) return true;
  reserve(2 * std::size_t{size_});
  std::uint32_t count = find_rim();
  place_fresh(count);
  bool is_sound = count > 0 && is_ring(count);
  if (!is_sound && count > 0) {
    untangle(tolerance);
    count = find_rim();
    place_fresh(count);
    is_sound = count > 0 && is_ring(count);
  }
  if (count == 0) {
    size_ = 0;
    reach_squared_ = reach_ = 0;
    return false;
  }
  if (count < 3 || !is_sound) {
    // Only rounding comes to this: what would be left is no body, so the plane counts as touching.
    is_touchy_ = true;
    return true;
  }
  sides_.push_back({normal, offset, kind, index});
  close_rim(static_cast<std::uint32_t>(sides_.size() - 1), count);
  if (count < leaving_count_) remove_taken(count);
  measure_reach();
  return true;
}

bool Clipper::cut(const Start& piece, const Point3& origin, double limit) {
  for (const Start::Side& side : piece.sides_) {
    const double offset = dot(side.normal, side.anchor - origin);
    if (offset < limit && !cut(side.normal, offset, side.kind, side.index)) return false;
  }
  return size_ > 0;
}

void Clipper::name_by(const Start& piece, const Point3& origin) {
  const double near = 4 * tolerance();
  for (const Start::Side& surface : piece.sides_) {
    if (surface.kind != FaceKind::plane) continue;
    const double offset = dot(surface.normal, surface.anchor - origin);
    for (Side& side : sides_) {
      const bool is_same = side.kind == FaceKind::site && std::abs(side.offset - offset) <= near &&
                           squared_norm(side.normal - surface.normal) <= kTouchyShare * kTouchyShare;
      if (!is_same) continue;
      side.kind = FaceKind::plane;
      side.index = surface.index;
    }
  }
}

bool Clipper::is_flat() const {
  const double thick = 4 * tolerance();
  return std::any_of(sides_.begin(), sides_.end(), [&](const Side& side) {
    for (std::uint32_t v = 0; v < size_; ++v) {
      if (side.normal.x * x_[v] + side.normal.y * y_[v] + side.normal.z * z_[v] < side.offset - thick) return false;
    }
    return true;
  });
}

}  // namespace bl::geometry
