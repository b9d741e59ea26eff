// Cutting a convex polyhedron by planes, with one decision per vertex.
#include "core/geometry/clipper.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace bl {

namespace {

// A vertex is touching, not cut, within this share of the polyhedron's reach (and of its first reach, whose rounding the
// early vertices carry). About fifty roundings: enough to swallow the noise of lattices, far below any measure that matters.
constexpr double kTouchShare = 1e-14, kFirstTouchShare = 1e-15;
// Within this share of the reach another order of the cuts may decide otherwise.
constexpr double kTouchyShare = 1e-12;
// A vertex of a start is put onto the domain's own corner within this share of the domain's size.
constexpr double kSnapShare = 1e-9;

constexpr std::array<std::uint32_t, 3> kNext{1, 2, 0}, kPrevious{2, 0, 1};

// Vertices are worked through two at a time; the arrays are padded with copies of the last one.
typedef double Lanes __attribute__((vector_size(16), aligned(8)));
constexpr std::size_t kLanes = 2;
constexpr std::size_t padded(std::size_t count) { return (count + kLanes - 1) / kLanes * kLanes; }

inline Lanes load(const double* from) { return *reinterpret_cast<const Lanes*>(from); }
inline Lanes larger(const Lanes& a, const Lanes& b) { return a > b ? a : b; }
inline Lanes smaller(const Lanes& a, const Lanes& b) { return a < b ? a : b; }
inline double largest(const Lanes& a) { return std::max(a[0], a[1]); }
inline double smallest(const Lanes& a) { return std::min(a[0], a[1]); }

}  // namespace

void Clipper::reserve(std::size_t vertices) {
  if (vertices + kLanes <= x_.size()) return;
  const std::size_t room = padded(2 * vertices + 64);
  x_.resize(room);
  y_.resize(room);
  z_.resize(room);
  beyond_.resize(room);
  corners_.resize(room);
  taken_.resize(room, 0);
  leaving_.resize(room);
  fresh_.resize(room);
  places_.resize(room);
}

void Clipper::measure_reach() {
  for (std::size_t v = size_; v < padded(size_); ++v) {
    x_[v] = x_[size_ - 1];
    y_[v] = y_[size_ - 1];
    z_[v] = z_[size_ - 1];
  }
  Lanes most{0, 0};
  for (std::size_t v = 0; v < size_; v += kLanes) {
    const Lanes x = load(&x_[v]), y = load(&y_[v]), z = load(&z_[v]);
    most = larger(most, x * x + y * y + z * z);
  }
  reach_squared_ = largest(most);
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
  is_touchy_ = false;
  reserve(size_);
  sides_.clear();
  for (const Start::Side& side : from.sides_) {
    // From a corner instead of a stored offset: far from the world's origin that keeps the digits.
    sides_.push_back({side.normal, dot(side.normal, side.anchor - origin), side.kind, side.index});
  }
  for (std::uint32_t v = 0; v < size_; ++v) {
    x_[v] = from.vertices_[v].x - origin.x;
    y_[v] = from.vertices_[v].y - origin.y;
    z_[v] = from.vertices_[v].z - origin.z;
    const auto& corner = from.corners_[v];
    corners_[v] = {{corner[0], corner[1], corner[2]}, {corner[3], corner[4], corner[5]}, v};
  }
  measure_reach();
  start_reach_ = reach_;
}

void Clipper::start_box(const Vector3& minimum, const Vector3& maximum) {
  size_ = 8;
  is_touchy_ = false;
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
    x_[v] = east ? maximum.x : minimum.x;
    y_[v] = north ? maximum.y : minimum.y;
    z_[v] = up ? maximum.z : minimum.z;
    Corner corner{{east ? 1u : 0u, north ? 3u : 2u, up ? 5u : 4u}, {v ^ 1u, v ^ 2u, v ^ 4u}, v};
    if ((east != north) != up) corners_[v] = corner;  // an odd number of positive sides: x, y, z is counter-clockwise
    else corners_[v] = {{corner.plane[0], corner.plane[2], corner.plane[1]}, {corner.next[0], corner.next[2], corner.next[1]}, v};
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
  std::copy_n(other.corners_.begin(), size_, corners_.begin());
  sides_ = other.sides_;
  is_touchy_ = other.is_touchy_;
  start_reach_ = other.start_reach_;
  if (size_ > 0) measure_reach();
}

// Signed distances of all vertices from the plane. Is one of them beyond?
bool Clipper::judge(const Vector3& normal, double offset, double tolerance) {
  Lanes most{-1e300, -1e300}, nearest{1e300, 1e300};
  for (std::size_t v = 0; v < size_; v += kLanes) {
    const Lanes beyond = load(&x_[v]) * normal.x + load(&y_[v]) * normal.y + load(&z_[v]) * normal.z - offset;
    *reinterpret_cast<Lanes*>(&beyond_[v]) = beyond;
    most = larger(most, beyond);
    nearest = smaller(nearest, larger(beyond, -beyond));
  }
  if (smallest(nearest) <= tolerance * (kTouchyShare / kTouchShare)) is_touchy_ = true;
  return largest(most) > tolerance;
}

// Marks the vertices beyond; returns the number of edges between them and the others.
std::uint32_t Clipper::take_beyond(double tolerance) {
  leaving_count_ = 0;
  for (std::uint32_t v = 0; v < size_; ++v) {
    const bool leaves = beyond_[v] > tolerance;
    taken_[v] = leaves;
    leaving_[leaving_count_] = v;
    leaving_count_ += leaves;
  }
  std::uint32_t kept = 0;
  for (std::uint32_t i = 0; i < leaving_count_; ++i) {
    for (const std::uint32_t w : corners_[leaving_[i]].next) kept += !taken_[w];
  }
  return kept;
}

// The edges from taken to kept vertices in order, counter-clockwise around the new face: along the part of each face that goes.
// Each gets its fresh vertex. Returns their number.
std::uint32_t Clipper::trace_rim() {
  std::uint32_t v = kNone, slot = 0;
  for (std::uint32_t i = 0; i < leaving_count_ && v == kNone; ++i) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      if (taken_[corners_[leaving_[i]].next[k]]) continue;
      v = leaving_[i];
      slot = k;
    }
  }
  if (v == kNone) return 0;
  const std::uint32_t first = v, first_slot = slot;
  std::uint32_t count = 0;
  do {
    const Corner& corner = corners_[v];
    const std::uint32_t u = corner.next[slot];
    const auto& around = corners_[u].next;
    const std::uint32_t face = corner.plane[kPrevious[slot]];
    fresh_[count++] = {u, v, static_cast<std::uint32_t>(around[1] == v) + 2u * static_cast<std::uint32_t>(around[2] == v),
                       corner.plane[kNext[slot]], face};
    slot = kNext[slot];
    while (taken_[corners_[v].next[slot]]) {
      v = corners_[v].next[slot];
      const auto& plane = corners_[v].plane;
      slot = plane[0] == face ? kPrevious[0] : plane[1] == face ? kPrevious[1] : kPrevious[2];
    }
  } while ((v != first || slot != first_slot) && count < fresh_.size());
  return count;
}

// Where the edges meet the plane: read from the ends before the first of those that leave is written over.
void Clipper::place_fresh(std::uint32_t count) {
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t u = fresh_[i].kept, v = fresh_[i].removed;
    const double inside = std::min(0.0, beyond_[u]), share = inside / (inside - beyond_[v]);
    places_[i] = {x_[u] + share * (x_[v] - x_[u]), y_[u] + share * (y_[v] - y_[u]), z_[u] + share * (z_[v] - z_[u])};
  }
}

// Rounding has torn what goes, or what stays, into parts: only the part around the farthest vertex goes, and of what stays the
// largest part does. Rare, so no care for speed.
void Clipper::untangle(double tolerance) {
  const auto connected = [&](std::uint32_t seed, const auto& belongs, std::vector<std::uint8_t>& seen) {
    std::vector<std::uint32_t> part{seed};
    seen[seed] = 1;
    for (std::size_t i = 0; i < part.size(); ++i) {
      for (const std::uint32_t w : corners_[part[i]].next) {
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
  std::fill_n(taken_.begin(), size_, std::uint8_t{1});
  for (const std::uint32_t v : largest_part) taken_[v] = 0;
  leaving_count_ = 0;
  for (std::uint32_t v = 0; v < size_; ++v) {
    // A vertex that goes along without lying beyond counts as lying on the plane.
    if (taken_[v]) beyond_[v] = std::max(beyond_[v], tolerance);
    if (taken_[v]) leaving_[leaving_count_++] = v;
  }
}

// Links the fresh vertices in a ring around the new face. They take the places of those that leave.
void Clipper::close_rim(std::uint32_t plane, std::uint32_t count) {
  const auto place = [&](std::uint32_t i) { return i < leaving_count_ ? leaving_[i] : size_ + i - leaving_count_; };
  std::uint32_t before = place(count - 1), at = place(0);
  for (std::uint32_t i = 0; i < count; ++i) {
    const Fresh& fresh = fresh_[i];
    const std::uint32_t after = i + 1 == count ? place(0) : place(i + 1);
    corners_[fresh.kept].next[fresh.back] = at;
    corners_[at] = {{plane, fresh.left, fresh.right}, {fresh.kept, after, before}, kNone};
    x_[at] = places_[i].x;
    y_[at] = places_[i].y;
    z_[at] = places_[i].z;
    taken_[at] = 0;
    before = at;
    at = after;
  }
  if (count > leaving_count_) size_ += count - leaving_count_;
}

void Clipper::move_vertex(std::uint32_t from, std::uint32_t to) {
  x_[to] = x_[from];
  y_[to] = y_[from];
  z_[to] = z_[from];
  corners_[to] = corners_[from];
  for (const std::uint32_t w : corners_[to].next) {
    for (std::uint32_t& back : corners_[w].next) {
      if (back == from) back = to;
    }
  }
}

// Fills the places that are still free from the end.
void Clipper::remove_taken(std::uint32_t fresh) {
  for (std::uint32_t i = fresh; i < leaving_count_; ++i) {
    while (size_ > 0 && taken_[size_ - 1]) taken_[--size_] = 0;
    if (leaving_[i] >= size_) continue;
    move_vertex(size_ - 1, leaving_[i]);
    taken_[leaving_[i]] = 0;
    --size_;
  }
}

void Clipper::give_up_cut() {
  for (std::uint32_t i = 0; i < leaving_count_; ++i) taken_[leaving_[i]] = 0;
}

bool Clipper::cut(const Vector3& normal, double offset, FaceKind kind, std::uint32_t index) {
  if (size_ == 0) return false;
  if (offset > 0 && offset * offset > reach_squared_) return true;
  const double tolerance = kTouchShare * reach_ + kFirstTouchShare * start_reach_;
  if (!judge(normal, offset, tolerance)) return true;
  reserve(2 * std::size_t{size_});
  const std::uint32_t edges = take_beyond(tolerance);
  std::uint32_t count = edges > 0 ? trace_rim() : 0;
  if (count != edges) {
    untangle(tolerance);
    count = trace_rim();
  }
  if (count == 0) {
    give_up_cut();
    size_ = 0;
    reach_squared_ = reach_ = 0;
    return false;
  }
  if (count < 3) {
    // Only rounding comes to this: what would be left is no body, so the plane counts as touching.
    give_up_cut();
    is_touchy_ = true;
    return true;
  }
  sides_.push_back({normal, offset, kind, index});
  place_fresh(count);
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

}  // namespace bl
