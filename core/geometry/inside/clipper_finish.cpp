// A clipper's shape as a polyhedron whose bits do not depend on the history of its cuts.
#include <algorithm>
#include <limits>

#include "core/geometry/inside/clipper.h"
#include "core/geometry/inside/wide_registers.h"

namespace bl::geometry {

namespace {

// Three planes whose normals span less than this meet too vaguely; the vertex stays where the cut has put it.
constexpr double kLeastDeterminant = 1e-9;

// Fewer faces are ranked faster by comparing each with each.
constexpr std::uint32_t kManyFaces = 64;

constexpr std::array<std::uint32_t, 3> kNextCorner{1, 2, 0}, kPreviousCorner{2, 0, 1};

}  // namespace

// The point on three planes (Cramer's rule), the face of lowest rank first so that the bits do not depend on the history.
bool Clipper::meeting_point(const Corner& corner, Point3& at) const {
  const auto& p = corner.plane;
  const std::uint32_t r0 = rank_[p[0]], r1 = rank_[p[1]], r2 = rank_[p[2]];
  const std::uint32_t k = (static_cast<std::uint32_t>(r1 < r0) & static_cast<std::uint32_t>(r1 < r2)) +
                          2u * (static_cast<std::uint32_t>(r2 < r0) & static_cast<std::uint32_t>(r2 < r1));
  const Side &a = sides_[p[k]], &b = sides_[p[kNextCorner[k]]], &c = sides_[p[kPreviousCorner[k]]];
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
  first_edge_.assign(count, kNone);
  std::uint32_t* const first_edge = first_edge_.data();
  for (std::uint32_t v = 0; v < size_; ++v) {
    const auto& plane = corners_[v].plane;
    for (std::uint32_t k = 0; k < 3; ++k) first_edge[plane[k]] = 4 * v + kNextCorner[k];
  }
  keys_.resize(count);
  std::uint32_t faces = 0;
  for (std::uint32_t p = 0; p < count; ++p) {
    // Kind and index as one number: no side's index comes near 2^30, but that of inner faces, which all share one.
    const auto kind = static_cast<std::uint32_t>(sides_[p].kind);
    keys_[faces] = {static_cast<std::int32_t>((kind << 30 | (sides_[p].index & 0x3fffffffu)) ^ 0x80000000u), p};
    faces += first_edge[p] != kNone;
  }
  order_.resize(faces);
  if (faces > kManyFaces) {
    std::sort(keys_.begin(), keys_.begin() + faces,
              [](const Key& a, const Key& b) { return a.name != b.name ? a.name < b.name : a.side < b.side; });
    for (std::uint32_t r = 0; r < faces; ++r) rank_[keys_[r].side] = r;
  } else {
    // By counting, without a branch that depends on the names.
    for (std::uint32_t r = 0; r < faces; ++r) {
      const std::int32_t name = keys_[r].name;
      std::uint32_t rank = 0;
      for (std::uint32_t q = 0; q < faces; ++q) {
        rank += static_cast<std::uint32_t>(keys_[q].name < name) |
                (static_cast<std::uint32_t>(keys_[q].name == name) & static_cast<std::uint32_t>(q < r));
      }
      rank_[keys_[r].side] = rank;
    }
  }
  for (std::uint32_t r = 0; r < faces; ++r) order_[rank_[keys_[r].side]] = keys_[r].side;
}

// One loop, from the corner on where the face that follows around it has the lowest rank. Vertices are numbered as they come.
void Clipper::write_face(Polyhedron& out, std::uint32_t first_edge) {
  const Corner* const corners = corners_.data();
  const std::uint32_t* const rank = rank_.data();
  std::uint32_t *const loop = loop_.data(), *const number = number_.data(), *const seen = seen_.data();
  const std::uint32_t most = static_cast<std::uint32_t>(loop_.size());
  std::uint32_t edge = first_edge, count = 0;
  std::uint64_t lowest = ~std::uint64_t{0};  // rank and place of the lowest so far as one number
  do {
    const std::uint32_t v = edge / 4, slot = edge % 4;
    lowest = std::min(lowest, std::uint64_t{rank[corners[v].plane[slot]]} << 32 | count);
    loop[count++] = v;
    edge = corners[v].next[slot];
  } while (edge != first_edge && count < most);
  const std::uint32_t first = static_cast<std::uint32_t>(lowest), begin = static_cast<std::uint32_t>(out.loops.size());
  out.loops.resize(begin + count);
  std::uint32_t* const to = out.loops.data() + begin;
  std::uint32_t seen_count = seen_count_;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t place = first + i, w = loop[place < count ? place : place - count];
    seen[seen_count] = w;
    const bool is_new = number[w] == kNone;
    number[w] = is_new ? seen_count : number[w];
    seen_count += is_new;
    to[i] = number[w];
  }
  seen_count_ = seen_count;
  const Side& side = sides_[corners[first_edge / 4].plane[kPreviousCorner[first_edge % 4]]];
  out.faces.push_back({side.normal, side.offset, side.kind, side.index, begin, count});
}

// The vertices that the loops have come by, in that order.
bool Clipper::write_vertices(Polyhedron& out, bool is_exact) const {
  bool is_sharp = true;
  out.vertices.resize(seen_count_);
  for (std::uint32_t i = 0; i < seen_count_; ++i) {
    const std::uint32_t v = seen_[i];
    Point3 at{x_[v], y_[v], z_[v]};
    if (is_exact && corners_[v].given == kNone && !meeting_point(corners_[v], at)) is_sharp = false;
    out.vertices[i] = at;
    out.reach_squared = std::max(out.reach_squared, squared_norm(at));
  }
  return is_sharp;
}

bool Clipper::finish(Polyhedron& out, double limit) { return write(out, true, limit); }
void Clipper::finish_as_cut(Polyhedron& out) { write(out, false, std::numeric_limits<double>::infinity()); }

BL_WIDE_REGISTERS bool Clipper::write(Polyhedron& out, bool is_exact, double limit) {
  out.clear();
  if (size_ == 0) return true;
  rank_sides();
  number_.assign(size_, kNone);
  loop_.resize(std::size_t{size_} + 1);
  seen_.resize(std::size_t{size_} + 1);
  seen_count_ = 0;
  bool is_open = false;
  for (const std::uint32_t p : order_) {
    if (sides_[p].offset < limit) {
      write_face(out, first_edge_[p]);
    } else {
      is_open = true;
    }
  }
  const bool is_split = !is_open && out.loops.size() != 3 * std::size_t{size_};
  if (is_split) write_split_faces(out);
  const bool is_sharp = write_vertices(out, is_exact);
  if (is_open) out.reach_squared = std::numeric_limits<double>::infinity();
  return is_sharp && !is_split;
}

// Faces that rounding has split: the loops that are left, in the order of their corners.
void Clipper::write_split_faces(Polyhedron& out) {
  std::vector<std::uint8_t> seen(4 * std::size_t{size_}, 0);
  const auto mark = [&](std::uint32_t edge) {
    for (; !seen[edge]; edge = corners_[edge / 4].next[edge % 4]) seen[edge] = 1;
  };
  for (const std::uint32_t p : order_) mark(first_edge_[p]);
  for (std::uint32_t corner = 0; corner < 3 * size_; ++corner) {
    const std::uint32_t edge = 4 * (corner / 3) + kNextCorner[corner % 3];
    if (seen[edge]) continue;
    mark(edge);
    write_face(out, edge);
  }
}

}  // namespace bl::geometry
