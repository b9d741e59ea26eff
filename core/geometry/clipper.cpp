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
// Three planes whose normals span less than this meet too vaguely; the vertex stays where the cut has put it.
constexpr double kLeastDeterminant = 1e-9;
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
    corners_.push_back({corner.plane[0] - 6, corner.plane[1] - 6, corner.plane[2] - 6, corner.next[0], corner.next[1],
                        corner.next[2]});
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
  start_reach_ = std::sqrt(reach_squared_);
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
  start_reach_ = std::sqrt(reach_squared_);
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

// All vertices beyond that hang together with the seed; counts the edges between them and the others.
std::uint32_t Clipper::take_connected(std::uint32_t seed, double tolerance) {
  leaving_.clear();
  leaving_.push_back(seed);
  taken_[seed] = 1;
  std::uint32_t edges = 0;
  for (std::size_t i = 0; i < leaving_.size(); ++i) {
    for (const std::uint32_t w : corners_[leaving_[i]].next) {
      if (taken_[w]) continue;
      if (beyond_[w] > tolerance) {
        taken_[w] = 1;
        leaving_.push_back(w);
      } else {
        ++edges;
      }
    }
  }
  return edges;
}

// The edges from taken to kept vertices in order, counter-clockwise around the new face: along the part of each face that goes.
bool Clipper::trace_rim() {
  rim_.clear();
  std::uint32_t v = kNone, slot = 0;
  for (const std::uint32_t candidate : leaving_) {
    for (std::uint32_t k = 0; k < 3 && v == kNone; ++k) {
      if (!taken_[corners_[candidate].next[k]]) {
        v = candidate;
        slot = k;
      }
    }
    if (v != kNone) break;
  }
  if (v == kNone) return false;
  const std::uint32_t first = v, first_slot = slot;
  do {
    rim_.push_back({corners_[v].next[slot], v, slot});
    const std::uint32_t face = corners_[v].plane[kPrevious[slot]];
    slot = kNext[slot];
    while (taken_[corners_[v].next[slot]]) {
      v = corners_[v].next[slot];
      const auto& plane = corners_[v].plane;
      const std::uint32_t k = plane[0] == face ? 0 : plane[1] == face ? 1 : 2;
      slot = kPrevious[k];
    }
  } while ((v != first || slot != first_slot) && rim_.size() <= 3 * std::size_t{size_});
  return true;
}

// Rounding has cut the kept part in two: the largest part stays, the others go too. Rare, so no care for speed.
bool Clipper::take_in_islands() {
  std::vector<std::uint32_t> part(size_, kNone), count;
  for (std::uint32_t seed = 0; seed < size_; ++seed) {
    if (taken_[seed] || part[seed] != kNone) continue;
    const std::uint32_t number = static_cast<std::uint32_t>(count.size());
    std::vector<std::uint32_t> open{seed};
    part[seed] = number;
    count.push_back(0);
    while (!open.empty()) {
      const std::uint32_t v = open.back();
      open.pop_back();
      ++count[number];
      for (const std::uint32_t w : corners_[v].next) {
        if (taken_[w] || part[w] != kNone) continue;
        part[w] = number;
        open.push_back(w);
      }
    }
  }
  if (count.empty()) return false;
  const auto largest_part = static_cast<std::uint32_t>(std::max_element(count.begin(), count.end()) - count.begin());
  for (std::uint32_t v = 0; v < size_; ++v) {
    if (taken_[v] || part[v] == largest_part) continue;
    taken_[v] = 1;
    leaving_.push_back(v);
  }
  return trace_rim();
}

// New vertices on the edges of the rim, linked in a ring around the new face. They take the places of those that leave.
void Clipper::close_rim(std::uint32_t plane) {
  const std::uint32_t count = static_cast<std::uint32_t>(rim_.size());
  reserve(size_ + count);
  const auto place = [&](std::uint32_t i) {
    return i < leaving_.size() ? leaving_[i] : size_ + i - static_cast<std::uint32_t>(leaving_.size());
  };
  // Everything of the leaving vertices is read before the first of them is written over.
  order_.resize(2 * count);
  number_.resize(count);
  first_corner_.resize(count);
  std::array<double, 3 * 64> stack_places;
  std::vector<double> heap_places;
  double* places = stack_places.data();
  if (count > 64) {
    heap_places.resize(3 * std::size_t{count});
    places = heap_places.data();
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    const Crossing& crossing = rim_[i];
    const std::uint32_t u = crossing.kept, v = crossing.removed;
    const Corner& corner = corners_[v];
    order_[2 * i] = corner.plane[kNext[crossing.slot]];
    order_[2 * i + 1] = corner.plane[kPrevious[crossing.slot]];
    const double inside = std::min(0.0, beyond_[u]);
    const double share = inside / (inside - beyond_[v]);
    places[3 * i] = x_[u] + share * (x_[v] - x_[u]);
    places[3 * i + 1] = y_[u] + share * (y_[v] - y_[u]);
    places[3 * i + 2] = z_[u] + share * (z_[v] - z_[u]);
    const Corner& other = corners_[u];
    std::uint32_t t = 0;
    while (t < 2 && !(other.next[t] == v && other.plane[t] != order_[2 * i] && other.plane[t] != order_[2 * i + 1])) ++t;
    first_corner_[i] = t;
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t at = place(i);
    corners_[rim_[i].kept].next[first_corner_[i]] = at;
    corners_[at] = {{plane, order_[2 * i], order_[2 * i + 1]},
                    {rim_[i].kept, place(i + 1 == count ? 0 : i + 1), place(i == 0 ? count - 1 : i - 1)},
                    kNone};
    x_[at] = places[3 * i];
    y_[at] = places[3 * i + 1];
    z_[at] = places[3 * i + 2];
    taken_[at] = 0;
  }
  if (count > leaving_.size()) size_ += count - static_cast<std::uint32_t>(leaving_.size());
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
void Clipper::remove_taken() {
  for (std::size_t i = rim_.size(); i < leaving_.size(); ++i) {
    while (size_ > 0 && taken_[size_ - 1]) taken_[--size_] = 0;
    if (leaving_[i] >= size_) continue;
    move_vertex(size_ - 1, leaving_[i]);
    taken_[leaving_[i]] = 0;
    --size_;
  }
}

bool Clipper::cut(const Vector3& normal, double offset, FaceKind kind, std::uint32_t index) {
  if (size_ == 0) return false;
  if (offset > 0 && offset * offset > reach_squared_) return true;
  const double tolerance = kTouchShare * std::sqrt(reach_squared_) + kFirstTouchShare * start_reach_;
  if (!judge(normal, offset, tolerance)) return true;
  std::uint32_t seed = 0;
  for (std::uint32_t v = 1; v < size_; ++v) {
    if (beyond_[v] > beyond_[seed]) seed = v;
  }
  const std::uint32_t edges = take_connected(seed, tolerance);
  bool has_rim = edges > 0 && trace_rim();
  if (has_rim && rim_.size() != edges) has_rim = take_in_islands();
  if (!has_rim) {
    for (const std::uint32_t v : leaving_) taken_[v] = 0;
    size_ = 0;
    reach_squared_ = 0;
    return false;
  }
  if (rim_.size() < 3) {
    // Only rounding comes to this: what would be left is no body, so the plane counts as touching.
    for (const std::uint32_t v : leaving_) taken_[v] = 0;
    is_touchy_ = true;
    return true;
  }
  sides_.push_back({normal, offset, kind, index});
  close_rim(static_cast<std::uint32_t>(sides_.size() - 1));
  remove_taken();
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

// The point on three planes (Cramer's rule), the face of lowest rank first so that the bits do not depend on the history.
bool Clipper::meeting_point(const Corner& corner, Point3& at) const {
  const auto& p = corner.plane;
  const std::uint32_t k = rank_[p[0]] < rank_[p[1]] ? (rank_[p[0]] < rank_[p[2]] ? 0 : 2) : (rank_[p[1]] < rank_[p[2]] ? 1 : 2);
  const Side &a = sides_[p[k]], &b = sides_[p[kNext[k]]], &c = sides_[p[kPrevious[k]]];
  const Vector3 bc = cross(b.normal, c.normal);
  const double determinant = dot(a.normal, bc);
  if (!(determinant > kLeastDeterminant)) return false;
  at = (a.offset * bc + b.offset * cross(c.normal, a.normal) + c.offset * cross(a.normal, b.normal)) * (1 / determinant);
  return true;
}

// Ranks of the sides by name; sides of one name keep their order.
void Clipper::rank_sides() {
  rank_.assign(sides_.size(), kNone);
  order_.clear();
  for (std::uint32_t v = 0; v < size_; ++v) {
    for (const std::uint32_t p : corners_[v].plane) {
      if (rank_[p] != kNone) continue;
      rank_[p] = 0;
      order_.push_back(p);
    }
  }
  const auto is_before = [&](std::uint32_t a, std::uint32_t b) {
    const Side &s = sides_[a], &t = sides_[b];
    return s.kind != t.kind ? s.kind < t.kind : s.index != t.index ? s.index < t.index : a < b;
  };
  std::sort(order_.begin(), order_.end(), is_before);
  for (std::uint32_t r = 0; r < order_.size(); ++r) rank_[order_[r]] = r;
}

bool Clipper::finish(Polyhedron& out) { return write(out, true); }
void Clipper::finish_as_cut(Polyhedron& out) { write(out, false); }

bool Clipper::write(Polyhedron& out, bool is_exact) {
  out.clear();
  if (size_ == 0) return true;
  bool is_sharp = true;
  rank_sides();
  // The first corner of each face: where its two other faces have the lowest ranks.
  first_corner_.assign(sides_.size(), kNone);
  const auto key = [&](std::uint32_t corner) {
    const auto& plane = corners_[corner / 3].plane;
    const std::uint32_t k = corner % 3;
    return (std::uint64_t{rank_[plane[kNext[k]]]} << 32) | rank_[plane[kPrevious[k]]];
  };
  for (std::uint32_t corner = 0; corner < 3 * size_; ++corner) {
    std::uint32_t& first = first_corner_[corners_[corner / 3].plane[corner % 3]];
    if (first == kNone || key(corner) < key(first)) first = corner;
  }
  number_.assign(size_, kNone);
  const auto walk = [&](std::uint32_t p, std::uint32_t from) {
    const Side& side = sides_[p];
    PolyhedronFace face{side.normal, side.offset, side.kind, side.index, static_cast<std::uint32_t>(out.loops.size()), 0};
    std::uint32_t v = from / 3, k = from % 3;
    do {
      if (number_[v] == kNone) {
        number_[v] = static_cast<std::uint32_t>(out.vertices.size());
        Point3 at{x_[v], y_[v], z_[v]};
        if (is_exact && corners_[v].given == kNone && !meeting_point(corners_[v], at)) is_sharp = false;
        out.vertices.push_back(at);
        out.reach_squared = std::max(out.reach_squared, squared_norm(at));
      }
      out.loops.push_back(number_[v]);
      v = corners_[v].next[kNext[k]];
      const auto& plane = corners_[v].plane;
      k = plane[0] == p ? 0 : plane[1] == p ? 1 : 2;
    } while (3 * v + k != from && out.loops.size() <= 3 * std::size_t{size_});
    face.count = static_cast<std::uint32_t>(out.loops.size()) - face.first;
    out.faces.push_back(face);
  };
  for (const std::uint32_t p : order_) walk(p, first_corner_[p]);
  if (out.loops.size() == 3 * std::size_t{size_}) return is_sharp;
  // A face that rounding has split: the loops that are left, in the order of their corners.
  std::vector<std::uint8_t> seen(3 * std::size_t{size_}, 0);
  const auto mark = [&](std::uint32_t p, std::uint32_t from) {
    std::uint32_t corner = from;
    do {
      seen[corner] = 1;
      const std::uint32_t v = corners_[corner / 3].next[kNext[corner % 3]];
      const auto& plane = corners_[v].plane;
      corner = 3 * v + (plane[0] == p ? 0u : plane[1] == p ? 1u : 2u);
    } while (!seen[corner]);
  };
  for (const std::uint32_t p : order_) mark(p, first_corner_[p]);
  for (std::uint32_t corner = 0; corner < 3 * size_; ++corner) {
    if (seen[corner]) continue;
    const std::uint32_t p = corners_[corner / 3].plane[corner % 3];
    mark(p, corner);
    walk(p, corner);
  }
  return is_sharp;
}

}  // namespace bl
