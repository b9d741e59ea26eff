// Faces of equal shade become one path each, so that a smooth drawing stays small and shows no seams between triangles.
#include "core/drawing/solid_drawing.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace bl::drawing {

namespace {

constexpr int kShades = 40;
// Creases are drawn where two visible faces meet at more than this angle.
constexpr double kCreaseCosine = 0.77;
constexpr double kUpright = 1e-6;   // of a unit normal
constexpr double kStraight = 0.04;  // [px] that a point may be off the line through its neighbours

bool is_straight(Pixel a, Pixel b, Pixel c) {
  const double x = c.x - a.x, y = c.y - a.y, length = std::hypot(x, y);
  if (length < 1e-9) return false;
  const double along = ((b.x - a.x) * x + (b.y - a.y) * y) / length;
  return std::abs((b.x - a.x) * y - (b.y - a.y) * x) / length < kStraight && along > 0 && along < length;
}

double twice_area(Pixel a, Pixel b, Pixel c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

// Quantised, so that faces of one plane stay one face.
int shade_of(const Vector3& normal, const Vector3& to_sun) {
  return static_cast<int>(std::lround(light_on(normal, to_sun) * kShades));
}

std::string shade_colour(const Colour& colour, int shade) { return shaded(colour, static_cast<double>(shade) / kShades); }

// One mesh under one view: what faces the eye, and what of it overlaps.
class Solid {
 public:
  Solid(const Sheet& sheet, const Mesh& mesh) : sheet_(sheet), mesh_(mesh), normals_(geometry::unit_normals(mesh)) {
    for (const Point3& vertex : mesh.vertices) pixels_.push_back(sheet.at(vertex));
  }
  bool faces_eye(std::size_t triangle) const { return dot(normals_[triangle], sheet_.view().toward) > 1e-9; }

  // Faces, then lines on top of them: of a body that hides no part of itself.
  void draw_simple(Markup& svg, const SolidStyle& style, const std::string& ink) const {
    std::map<int, std::vector<std::uint32_t>> by_shade;
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      if (faces_eye(t)) by_shade[shade_of(normals_[t], style.to_sun)].push_back(t);
    // A hair of the same colour around each region closes the gaps that smoothing leaves between neighbours.
    svg.open("g", {{"stroke-width", ".5"}, {"stroke-linejoin", "round"}, {"fill-rule", "evenodd"}});
    for (const auto& [shade, triangles] : by_shade) draw_region(svg, triangles, shade_colour(style.colour, shade));
    svg.close();
    draw_storeys(svg, style.storey_height, ink);
    draw_edges(svg, ink);
  }

  // What is hidden first, each face with its own lines, so that what is nearer hides those too.
  void draw_by_depth(Markup& svg, const SolidStyle& style, const std::string& ink) const {
    std::vector<std::pair<Order, std::uint32_t>> by_depth;
    const bool is_upright = sheet_.view().toward.z > 0 && std::all_of(normals_.begin(), normals_.end(), [](const Vector3& n) {
                              return std::abs(n.z) < kUpright || std::abs(n.z) > 1 - kUpright;
                            });
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      if (faces_eye(t)) by_depth.emplace_back(is_upright ? order_of(t) : Order{0, 0, depth_of(t)}, t);
    std::sort(by_depth.begin(), by_depth.end());
    std::map<std::uint32_t, Edges> edges;
    for (const geometry::MeshEdge& edge : geometry::mesh_edges(mesh_))
      if (const Line line = line_at(edge); line != Line::none)
        for (const std::uint32_t t : {edge.first, edge.second})
          if (faces_eye(t)) edges[t].emplace_back(edge.a, edge.b);
    const std::vector<double> heights = storeys_of(style.storey_height);
    svg.open("g", {{"stroke-width", ".5"}, {"stroke-linejoin", "round"}, {"fill-rule", "evenodd"}});
    for (const auto& [order, t] : by_depth) {
      draw_region(svg, {t}, shade_colour(style.colour, shade_of(normals_[t], style.to_sun)));
      svg.path(storeys_on(t, heights), {{"fill", "none"}, {"stroke", ink}, {"stroke-opacity", ".5"}});
      if (const auto own = edges.find(t); own != edges.end())
        svg.path(lines_of(own->second), {{"fill", "none"}, {"stroke", ink}, {"stroke-width", ".8"}});
    }
    svg.close();
  }

  void draw_storeys(Markup& svg, double storey_height, const std::string& ink) const {
    PathText path;
    for (const double z : storeys_of(storey_height))
      for (const geometry::Polyline& line : geometry::section(mesh_, z, [&](std::size_t t) { return faces_eye(t); }))
        path.polyline(on_sheet(sheet_, line), line.is_closed);
    svg.path(path, {{"fill", "none"}, {"stroke", ink}, {"stroke-width", ".5"}, {"stroke-opacity", ".5"}});
  }

  void draw_edges(Markup& svg, const std::string& ink) const {
    Edges creases, silhouette;
    for (const geometry::MeshEdge& edge : geometry::mesh_edges(mesh_))
      if (const Line line = line_at(edge); line != Line::none)
        (line == Line::crease ? creases : silhouette).emplace_back(edge.a, edge.b);
    svg.path(lines_of(creases), {{"fill", "none"}, {"stroke", ink}, {"stroke-width", ".6"}, {"stroke-opacity", ".8"}});
    svg.path(lines_of(silhouette), {{"fill", "none"}, {"stroke", ink}, {"stroke-width", "1"}});
  }

  // Faces of a convex body never hide each other, and together cover its convex outline exactly.
  bool is_simple() const {
    double covered = 0, outlined = 0;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const auto& [a, b, c] = mesh_.triangles[t];
      if (faces_eye(t)) covered += std::abs(twice_area(pixels_[a], pixels_[b], pixels_[c]));
    }
    const std::vector<Pixel> hull = convex_outline(sheet_, mesh_);
    for (std::size_t i = 2; i < hull.size(); ++i) outlined += std::abs(twice_area(hull[0], hull[i - 1], hull[i]));
    return std::abs(covered - outlined) <= 0.01 * outlined;
  }

 private:
  using Edges = std::vector<std::pair<std::uint64_t, std::uint64_t>>;
  enum class Line { none, crease, silhouette };
  using Order = std::tuple<double, int, double>;

  Line line_at(const geometry::MeshEdge& edge) const {
    const bool first = faces_eye(edge.first), second = faces_eye(edge.second);
    if (first != second || (edge.first == edge.second && first)) return Line::silhouette;
    return first && dot(normals_[edge.first], normals_[edge.second]) < kCreaseCosine ? Line::crease : Line::none;
  }

  // Heights of floors; none where their lines would run into each other.
  std::vector<double> storeys_of(double storey_height) const {
    std::vector<double> heights;
    if (!(storey_height > 0) || mesh_.vertices.empty() || storey_height * sheet_.scale() < 2.5) return heights;
    const auto [low, high] = std::minmax_element(mesh_.vertices.begin(), mesh_.vertices.end(),
                                                 [](const Point3& a, const Point3& b) { return a.z < b.z; });
    for (double z = low->z + storey_height; z < high->z - 0.1 * storey_height; z += storey_height) heights.push_back(z);
    return heights;
  }

  PathText storeys_on(std::uint32_t t, const std::vector<double>& heights) const {
    PathText path;
    for (const double z : heights) {
      std::vector<Pixel> ends;
      for (std::size_t k = 0; k < 3; ++k) {
        const Point3 &a = mesh_.vertices[mesh_.triangles[t][k]], &b = mesh_.vertices[mesh_.triangles[t][(k + 1) % 3]];
        if ((a.z > z) != (b.z > z)) ends.push_back(sheet_.at(a + ((z - a.z) / (b.z - a.z)) * (b - a)));
      }
      path.polyline(ends, false);
    }
    return path;
  }

  PathText lines_of(const Edges& edges) const {
    PathText path;
    for (const geometry::Chain& chain : geometry::chain_edges(edges)) {
      geometry::Polyline line{{}, chain.is_closed};
      for (const std::uint64_t v : chain.points) line.points.push_back(mesh_.vertices[v]);
      path.polyline(on_sheet(sheet_, line), line.is_closed);
    }
    return path;
  }

  void draw_region(Markup& svg, const std::vector<std::uint32_t>& triangles, const std::string& colour) const {
    std::vector<std::pair<std::uint64_t, std::uint64_t>> sides, border;
    for (const std::uint32_t t : triangles)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint64_t a = mesh_.triangles[t][k], b = mesh_.triangles[t][(k + 1) % 3];
        sides.emplace_back(std::min(a, b), std::max(a, b));
      }
    std::sort(sides.begin(), sides.end());
    for (std::size_t i = 0; i < sides.size(); ++i) {
      if (i + 1 < sides.size() && sides[i] == sides[i + 1]) ++i;
      else border.push_back(sides[i]);
    }
    svg.path(lines_of(border), {{"fill", colour}, {"stroke", colour}});
  }

  // Of prisms upon prisms, seen from above: nothing hides what stands higher, and no wall a roof of its own height. So walls come
  // before the roof that they carry, and that before the walls upon it; walls among themselves go by depth.
  Order order_of(std::uint32_t t) const {
    const auto& [a, b, c] = mesh_.triangles[t];
    const double lowest = std::min({mesh_.vertices[a].z, mesh_.vertices[b].z, mesh_.vertices[c].z});
    return {std::round(lowest * 1e6), normals_[t].z > 0.5 ? 0 : 1, depth_of(t)};
  }

  double depth_of(std::uint32_t t) const {
    double depth = 0;
    for (const std::uint32_t v : mesh_.triangles[t]) depth += sheet_.depth(mesh_.vertices[v]);
    return depth;
  }

  const Sheet& sheet_;
  const Mesh& mesh_;
  std::vector<Vector3> normals_;
  std::vector<Pixel> pixels_;
};

constexpr double kSky = 0.32, kSun = 0.68;

}  // namespace

double light_on(const Vector3& normal, const Vector3& to_sun) {
  return kSky * (0.5 + 0.5 * normal.z) + kSun * std::max(0.0, dot(normal, to_sun));
}

Vector3 brightest_normal(const Vector3& to_sun) {
  const Vector3 sum = to_sun * kSun + Vector3{0, 0, 0.5 * kSky};
  return sum / norm(sum);
}

std::string shaded(const Colour& colour, double light) {
  if (light > 0.7) return hex(mix(colour, kWhite, (light - 0.7) * 1.5));
  return hex(mix(colour, kShade, (0.7 - light) * 0.85));
}

std::vector<Pixel> on_sheet(const Sheet& sheet, const geometry::Polyline& line) {
  std::vector<Pixel> all;
  for (const Point3& point : line.points) all.push_back(sheet.at(point));
  return simplified(all, line.is_closed);
}

std::vector<Pixel> simplified(const std::vector<Pixel>& line, bool is_closed) {
  std::vector<Pixel> kept;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool is_end = i == 0 || (i + 1 == line.size() && !is_closed);
    if (is_end || !is_straight(kept.back(), line[i], line[(i + 1) % line.size()])) kept.push_back(line[i]);
  }
  return kept;
}

void draw_solid(Markup& svg, const Sheet& sheet, const Mesh& mesh, const SolidStyle& style) {
  const Solid solid(sheet, mesh);
  const std::string ink = hex(mix(style.colour, kInk, 0.62));
  if (solid.is_simple()) solid.draw_simple(svg, style, ink);
  else solid.draw_by_depth(svg, style, ink);
}

// Andrew's monotone chain (1979).
std::vector<Pixel> convex_outline(std::vector<Pixel> places) {
  const auto is_before = [](Pixel a, Pixel b) { return a.x != b.x ? a.x < b.x : a.y < b.y; };
  std::sort(places.begin(), places.end(), is_before);
  std::vector<Pixel> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t first = hull.size();
    for (const Pixel place : places) {
      while (hull.size() >= first + 2 && !(twice_area(hull[hull.size() - 2], hull.back(), place) > 0)) hull.pop_back();
      hull.push_back(place);
    }
    if (!hull.empty()) hull.pop_back();  // the other side starts with it
    std::reverse(places.begin(), places.end());
  }
  return hull;
}

std::vector<std::vector<Pixel>> common_outline(const std::vector<std::vector<Pixel>>& pieces) {
  constexpr double kOnePlace = 0.05;  // [pixels] no eye tells such places apart
  std::vector<Pixel> places;
  std::vector<std::vector<std::uint64_t>> rings;
  for (const std::vector<Pixel>& piece : pieces) {
    std::vector<std::uint64_t>& ring = rings.emplace_back();
    for (const Pixel& p : piece) {
      const auto found = std::find_if(places.begin(), places.end(),
                                      [&](const Pixel& q) { return std::hypot(p.x - q.x, p.y - q.y) <= kOnePlace; });
      ring.push_back(static_cast<std::uint64_t>(found - places.begin()));
      if (found == places.end()) places.push_back(p);
    }
  }
  // Edges are cut at all places on the way; what is there twice lies between two pieces.
  std::map<std::pair<std::uint64_t, std::uint64_t>, int> edges;
  for (const std::vector<std::uint64_t>& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const std::uint64_t a = ring[i], b = ring[(i + 1) % ring.size()];
      const Pixel from = places[a], way{places[b].x - from.x, places[b].y - from.y};
      const double length = std::hypot(way.x, way.y);
      std::vector<std::pair<double, std::uint64_t>> stops{{0, a}, {length, b}};
      for (std::uint64_t k = 0; k < places.size() && length > 0; ++k) {
        const double x = places[k].x - from.x, y = places[k].y - from.y, along = (x * way.x + y * way.y) / length;
        if (k != a && k != b && along > 0 && along < length && std::abs(x * way.y - y * way.x) <= kOnePlace * length)
          stops.emplace_back(along, k);
      }
      std::sort(stops.begin(), stops.end());
      for (std::size_t s = 1; s < stops.size(); ++s)
        if (stops[s - 1].second != stops[s].second) ++edges[std::minmax(stops[s - 1].second, stops[s].second)];
    }
  std::vector<std::pair<std::uint64_t, std::uint64_t>> border;
  for (const auto& [edge, count] : edges)
    if (count % 2 == 1) border.push_back(edge);
  std::vector<std::vector<Pixel>> outlines;
  for (const geometry::Chain& chain : geometry::chain_edges(border)) {
    std::vector<Pixel>& line = outlines.emplace_back();
    for (const std::uint64_t place : chain.points) line.push_back(places[place]);
  }
  return outlines;
}

std::vector<Pixel> convex_outline(const Sheet& sheet, const Mesh& mesh) {
  std::vector<Pixel> places;
  for (const Point3& vertex : mesh.vertices) places.push_back(sheet.at(vertex));
  return convex_outline(std::move(places));
}

std::vector<Pixel> convex_outline(const Sheet& sheet, const reading::VolumeRow& volume) {
  if (!(volume.exact.radius > 0)) return convex_outline(sheet, *volume.mesh);
  std::vector<Pixel> places;
  for (const Point3& point : outline_of(volume.exact, sheet.view().toward)) places.push_back(sheet.at(point));
  return convex_outline(std::move(places));
}

bool is_inside(const std::vector<Pixel>& outline, Pixel place) {
  for (std::size_t i = 0; i < outline.size(); ++i)
    if (twice_area(outline[i], outline[(i + 1) % outline.size()], place) < 0) return false;
  return outline.size() > 2;
}

}  // namespace bl::drawing
