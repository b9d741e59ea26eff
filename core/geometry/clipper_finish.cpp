// A clipper's shape as a polyhedron whose bits do not depend on the history of its cuts.
#include <algorithm>
#include <limits>

#include "core/geometry/clipper.h"

namespace bl {

namespace {

// Three planes whose normals span less than this meet too vaguely; the vertex stays where the cut has put it.
constexpr double kLeastDeterminant = 1e-9;

constexpr std::array<std::uint32_t, 3> kNext{1, 2, 0}, kPrevious{2, 0, 1};

}  // namespace

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

// Ranks of the sides by name; sides of one name keep their order. `order_` lists the sides that have a face, by rank.
void Clipper::rank_sides() {
  const std::size_t count = sides_.size();
  rank_.resize(count);
  first_corner_.assign(count, kNone);
  for (std::uint32_t corner = 0; corner < 3 * size_; ++corner) first_corner_[corners_[corner / 3].plane[corner % 3]] = corner;
  order_.clear();
  keys_.clear();
  for (std::uint32_t p = 0; p < count; ++p) {
    if (first_corner_[p] == kNone) continue;
    const std::uint64_t key = (std::uint64_t{static_cast<std::uint8_t>(sides_[p].kind)} << 32) | sides_[p].index;
    std::size_t at = order_.size();
    order_.push_back(p);
    keys_.push_back(key);
    // By insertion: there are few, and those of the start come in order.
    for (; at > 0 && keys_[at - 1] > key; --at) {
      keys_[at] = keys_[at - 1];
      order_[at] = order_[at - 1];
    }
    keys_[at] = key;
    order_[at] = p;
  }
  for (std::uint32_t r = 0; r < order_.size(); ++r) rank_[order_[r]] = r;
}

// One loop, from the corner on where the face that follows around it has the lowest rank.
bool Clipper::write_face(Polyhedron& out, std::uint32_t corner, bool is_exact) {
  bool is_sharp = true;
  const std::uint32_t p = corners_[corner / 3].plane[corner % 3];
  const Side& side = sides_[p];
  PolyhedronFace face{side.normal, side.offset, side.kind, side.index, static_cast<std::uint32_t>(out.loops.size()), 0};
  std::uint32_t v = corner / 3, k = corner % 3, lowest = kNone, first = 0, count = 0;
  do {
    const Corner& at = corners_[v];
    const std::uint32_t rank = rank_[at.plane[kNext[k]]];
    first = rank < lowest ? count : first;
    lowest = std::min(lowest, rank);
    loop_[count++] = v;
    v = at.next[kNext[k]];
    const auto& plane = corners_[v].plane;
    k = static_cast<std::uint32_t>(plane[1] == p) + 2u * static_cast<std::uint32_t>(plane[2] == p);
  } while (3 * v + k != corner && count < loop_.size());
  out.loops.resize(face.first + count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t w = loop_[first];
    first = first + 1 == count ? 0 : first + 1;
    std::uint32_t& number = number_[w];
    if (number == kNone) {
      number = static_cast<std::uint32_t>(out.vertices.size());
      Point3 at{x_[w], y_[w], z_[w]};
      if (is_exact && corners_[w].given == kNone && !meeting_point(corners_[w], at)) is_sharp = false;
      out.vertices.push_back(at);
      out.reach_squared = std::max(out.reach_squared, squared_norm(at));
    }
    out.loops[face.first + i] = number;
  }
  face.count = count;
  out.faces.push_back(face);
  return is_sharp;
}

bool Clipper::finish(Polyhedron& out, double limit) { return write(out, true, limit); }
void Clipper::finish_as_cut(Polyhedron& out) { write(out, false, std::numeric_limits<double>::infinity()); }

bool Clipper::write(Polyhedron& out, bool is_exact, double limit) {
  out.clear();
  if (size_ == 0) return true;
  rank_sides();
  number_.assign(size_, kNone);
  loop_.resize(std::size_t{size_} + 1);
  bool is_sharp = true, is_open = false;
  for (const std::uint32_t p : order_) {
    if (sides_[p].offset < limit) {
      is_sharp = write_face(out, first_corner_[p], is_exact) && is_sharp;
    } else {
      is_open = true;
    }
  }
  if (is_open) {
    out.reach_squared = std::numeric_limits<double>::infinity();
    return is_sharp;
  }
  if (out.loops.size() == 3 * std::size_t{size_}) return is_sharp;
  write_split_faces(out, is_exact);
  return false;
}

// Faces that rounding has split: the loops that are left, in the order of their corners.
void Clipper::write_split_faces(Polyhedron& out, bool is_exact) {
  std::vector<std::uint8_t> seen(3 * std::size_t{size_}, 0);
  const auto mark = [&](std::uint32_t from) {
    const std::uint32_t p = corners_[from / 3].plane[from % 3];
    std::uint32_t corner = from;
    do {
      seen[corner] = 1;
      const std::uint32_t v = corners_[corner / 3].next[kNext[corner % 3]];
      const auto& plane = corners_[v].plane;
      corner = 3 * v + (plane[0] == p ? 0u : plane[1] == p ? 1u : 2u);
    } while (!seen[corner]);
  };
  for (const std::uint32_t p : order_) mark(first_corner_[p]);
  for (std::uint32_t corner = 0; corner < 3 * size_; ++corner) {
    if (seen[corner]) continue;
    mark(corner);
    write_face(out, corner, is_exact);
  }
}

}  // namespace bl
