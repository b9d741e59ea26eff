// Lines clipped by the convex pieces of a domain.
#include "core/geometry/inside/sample_lines.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace bl::geometry {

namespace {

// A plane whose normal is this much at right angles to a line is taken to run along it.
constexpr double kParallel = 1e-12;

// Counts and lower corner from the corners of the domain; the grid is as much too large on either side.
void spread(const Domain& domain, SampleFrame& frame, double step) {
  frame.step = step;
  Vector3 low = frame.to_frame(domain.pieces.front().shape.vertices.front()), high = low;
  for (const Domain::Piece& piece : domain.pieces) {
    for (const Point3& vertex : piece.shape.vertices) {
      const Vector3 f = frame.to_frame(vertex);
      low = {std::min(low.x, f.x), std::min(low.y, f.y), std::min(low.z, f.z)};
      high = {std::max(high.x, f.x), std::max(high.y, f.y), std::max(high.z, f.z)};
    }
  }
  const std::array<double, 3> least{low.x, low.y, low.z}, most{high.x, high.y, high.z};
  for (std::size_t k = 0; k < 3; ++k) {
    frame.count[k] = std::max(1, static_cast<int>(std::ceil((most[k] - least[k]) / step)));
    frame.low[k] = 0.5 * (least[k] + most[k]) - 0.5 * frame.count[k] * step;
  }
}

// The plane normal·f <= offset of a piece, in the frame.
struct FramePlane {
  std::array<double, 3> normal;
  double offset;
  std::uint32_t face;
};

double component(const Vector3& v, std::size_t k) { return k == 0 ? v.x : k == 1 ? v.y : v.z; }

struct FramePiece {
  std::vector<FramePlane> planes;
  std::array<double, 3> low, high;
};

// Cuts a line by one plane; false where nothing is left.
bool clip(const FramePlane& plane, std::size_t along, double rest, SampleLines::Stretch& stretch) {
  const double slope = plane.normal[along], room = plane.offset - rest;
  if (std::abs(slope) <= kParallel) return room >= 0;
  const double at = room / slope;
  if (slope > 0 && at < stretch.to) {
    stretch.to = at;
    stretch.to_face = plane.face;
  } else if (slope < 0 && at > stretch.from) {
    stretch.from = at;
    stretch.from_face = plane.face;
  }
  return stretch.from < stretch.to;
}

// The pieces of the domain in the frame; `faces` gets a row for each plane that bounds something.
std::vector<FramePiece> frame_pieces(const Domain& domain, const SampleFrame& frame, std::size_t along,
                                     std::vector<SampleLines::Face>& faces) {
  faces.clear();
  std::vector<FramePiece> pieces;
  for (const Domain::Piece& piece : domain.pieces) {
    FramePiece made;
    for (std::size_t k = 0; k < piece.shape.planes.size(); ++k) {
      if (piece.shape.faces[k].size() < 3) continue;  // bounds nothing
      const Vector3 n = frame.turned(piece.shape.planes[k].normal);
      const double offset = dot(n, frame.to_frame(piece.shape.vertices[piece.shape.faces[k].front()]));
      made.planes.push_back({{n.x, n.y, n.z}, offset, static_cast<std::uint32_t>(faces.size())});
      faces.push_back({piece.sides[k], std::abs(component(n, along))});
    }
    for (std::size_t k = 0; k < 3; ++k) made.low[k] = 1e300, made.high[k] = -1e300;
    for (const Point3& vertex : piece.shape.vertices) {
      const Vector3 f = frame.to_frame(vertex);
      for (std::size_t k = 0; k < 3; ++k) {
        made.low[k] = std::min(made.low[k], component(f, k));
        made.high[k] = std::max(made.high[k], component(f, k));
      }
    }
    pieces.push_back(std::move(made));
  }
  return pieces;
}

}  // namespace

SampleFrame tilted_frame(const Domain& domain, double step) {
  SampleFrame frame;
  // A turn by this quaternion, the best of many random ones: every axis is at least 13 degrees from each of the planes named.
  const double a = 0.4543, b = -2.2849, c = 0.4517, d = 0.6753, n = a * a + b * b + c * c + d * d;
  frame.axis = {Vector3{1 - 2 * (c * c + d * d) / n, 2 * (b * c - d * a) / n, 2 * (b * d + c * a) / n},
                Vector3{2 * (b * c + d * a) / n, 1 - 2 * (b * b + d * d) / n, 2 * (c * d - b * a) / n},
                Vector3{2 * (b * d - c * a) / n, 2 * (c * d + b * a) / n, 1 - 2 * (b * b + c * c) / n}};
  frame.origin = 0.5 * (domain.minimum + domain.maximum);
  spread(domain, frame, step);
  return frame;
}

SampleFrame upright_frame(const Domain& domain, double step) {
  SampleFrame frame;
  const double c = 1 / std::sqrt(1 + 0.3819 * 0.3819), s = 0.3819 * c;  // a turn by 21 degrees
  frame.axis = {Vector3{c, s, 0}, Vector3{-s, c, 0}, Vector3{0, 0, 1}};
  frame.origin = 0.5 * (domain.minimum + domain.maximum);
  spread(domain, frame, step);
  return frame;
}

void SampleLines::build(const Domain& domain, const SampleFrame& frame, std::size_t along, ThreadPool* pool) {
  const std::size_t across_u = (along + 1) % 3, across_v = (along + 2) % 3;
  const std::vector<FramePiece> pieces = frame_pieces(domain, frame, along, faces_);
  const auto row = [&](int v) {
    std::vector<std::pair<int, Stretch>> found;
    const double at_v = frame.line_at(across_v, v);
    for (const FramePiece& piece : pieces) {
      if (at_v < piece.low[across_v] || at_v > piece.high[across_v]) continue;
      const int first = std::max(0, static_cast<int>((piece.low[across_u] - frame.low[across_u]) / frame.step - 0.5));
      for (int u = first; u < frame.count[across_u] && frame.line_at(across_u, u) <= piece.high[across_u]; ++u) {
        Stretch stretch{piece.low[along], piece.high[along], 0, 0};
        const double at_u = frame.line_at(across_u, u);
        const bool is_met = std::all_of(piece.planes.begin(), piece.planes.end(), [&](const FramePlane& plane) {
          return clip(plane, along, plane.normal[across_u] * at_u + plane.normal[across_v] * at_v, stretch);
        });
        if (is_met) found.emplace_back(u, stretch);
      }
    }
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
      return a.first != b.first ? a.first < b.first : a.second.from < b.second.from;
    });
    Row made;
    made.first.assign(static_cast<std::size_t>(frame.count[across_u]) + 1, 0);
    for (const auto& [u, stretch] : found) {
      ++made.first[static_cast<std::size_t>(u) + 1];
      made.stretches.push_back(stretch);
    }
    for (std::size_t u = 1; u < made.first.size(); ++u) made.first[u] += made.first[u - 1];
    return made;
  };
  rows_.assign(static_cast<std::size_t>(frame.count[across_v]), {});
  const auto body = [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) rows_[v] = row(static_cast<int>(v));
  };
  if (pool != nullptr) {
    pool->for_each_chunk(rows_.size(), 8, body);
  } else {
    body(0, rows_.size());
  }
  length_ = 0;
  count_ = 0;
  for (const Row& made : rows_) {
    for (const Stretch& stretch : made.stretches) length_ += stretch.to - stretch.from;
    for (std::size_t u = 0; u + 1 < made.first.size(); ++u) count_ += made.first[u + 1] > made.first[u] ? 1 : 0;
  }
}

}  // namespace bl::geometry
