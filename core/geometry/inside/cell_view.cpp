// From the polyhedra of a cell to corners and faces with lasting labels.
#include "core/geometry/inside/cell_view.h"

#include <algorithm>

namespace bl::geometry {

namespace {

std::uint64_t code_of(const PolyhedronFace& face, std::span<const std::uint32_t> labels) {
  switch (face.kind) {
    case FaceKind::plane: return ElementLabel::side(face.index).code;
    case FaceKind::site: return ElementLabel::site(labels.empty() ? face.index : labels[face.index]).code;
    case FaceKind::inner:
    case FaceKind::frame: break;
  }
  return CellView::kInner;
}

double area_of(const Polyhedron& part, const PolyhedronFace& face) {
  const auto loop = part.loop(face);
  Vector3 doubled;
  for (std::size_t i = 2; i < loop.size(); ++i) {
    const Point3& origin = part.vertices[loop[0]];
    doubled += cross(part.vertices[loop[i - 1]] - origin, part.vertices[loop[i]] - origin);
  }
  return 0.5 * norm(doubled);
}

// A slab of thickness t has twice t times its area of one side: 2 V / S is its thickness, whatever its outline.
bool is_flat(const Polyhedron& part, double tolerance) {
  if (part.is_empty()) return true;
  double surface = 0;
  for (const PolyhedronFace& face : part.faces) surface += area_of(part, face);
  Point3 centroid;
  return !(2 * volume_and_centroid(part, centroid) > tolerance * surface);
}

void read_part(const Polyhedron& part, const Point3& site, std::span<const std::uint32_t> labels, double tolerance,
               CellView& view) {
  const std::uint32_t first = static_cast<std::uint32_t>(view.corners.size());
  for (const Point3& vertex : part.vertices) view.corners.push_back(site + vertex);
  view.keys.resize(view.corners.size(), {view.own.code, CellView::kInner, CellView::kInner, CellView::kInner});
  std::vector<std::uint8_t> known(part.vertices.size(), 1);
  for (const PolyhedronFace& face : part.faces) {
    const std::uint64_t code = code_of(face, labels);
    view.faces.push_back({code, static_cast<std::uint32_t>(view.loops.size()), face.count});
    const auto loop = part.loop(face);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      view.loops.push_back(first + loop[i]);
      if (known[loop[i]] < 4) view.keys[first + loop[i]][known[loop[i]]++] = code;
      const std::uint32_t next = loop[i + 1 == loop.size() ? 0 : i + 1];
      if (loop[i] < next && distance(part.vertices[loop[i]], part.vertices[next]) <= tolerance) {
        view.short_edges.push_back({first + loop[i], first + next});
      }
    }
  }
}

}  // namespace

bool CellView::is_same(const CellView& other) const {
  return own == other.own && corners == other.corners && keys == other.keys && faces == other.faces && loops == other.loops;
}

std::span<const std::uint32_t> CellView::find(const Key& key) const {
  const auto begin =
      std::lower_bound(by_key.begin(), by_key.end(), key, [&](std::uint32_t c, const Key& k) { return keys[c] < k; });
  auto end = begin;
  while (end != by_key.end() && keys[*end] == key) ++end;
  return {begin, end};
}

CellView read_cell(const Point3& site, ElementLabel own, std::span<const Polyhedron> parts, std::span<const std::uint32_t> labels,
                   double tolerance) {
  CellView view;
  view.own = own;
  for (const Polyhedron& part : parts) {
    if (!is_flat(part, tolerance)) read_part(part, site, labels, tolerance, view);
  }
  for (CellView::Key& key : view.keys) std::sort(key.begin(), key.end());
  view.by_key.resize(view.keys.size());
  for (std::uint32_t c = 0; c < view.by_key.size(); ++c) view.by_key[c] = c;
  std::sort(view.by_key.begin(), view.by_key.end(),
            [&](std::uint32_t a, std::uint32_t b) { return view.keys[a] != view.keys[b] ? view.keys[a] < view.keys[b] : a < b; });
  return view;
}

}  // namespace bl::geometry
