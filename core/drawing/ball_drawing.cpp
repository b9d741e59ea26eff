// A ball cut by planes, drawn smoothly: one shaded outline, the visible flat faces on it, storey lines and edges.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/drawing/solid_drawing.h"

namespace bl::drawing {

namespace {

std::vector<Pixel> pixels_of(const Sheet& sheet, const reading::Corners& corners, bool is_closed = true) {
  return on_sheet(sheet, geometry::Polyline{corners, is_closed});
}

// The brightest place of a ball as the eye sees it, in radii from its middle; light is linear in the normal, up to its shaded
// side.
Pixel glint(const View& view, const Vector3& to_sun) {
  const Vector3 axis = brightest_normal(to_sun);
  return {0.92 * dot(axis, view.right), -0.92 * dot(axis, view.up)};
}

void draw_storeys(Markup& svg, const Sheet& sheet, const reading::ExactShape& shape, const SolidStyle& style,
                  const std::string& ink) {
  if (!(style.storey_height > 0) || style.storey_height * sheet.scale() < 2.5) return;
  PathText path;
  for (double z = style.bottom + style.storey_height; z < style.top - 0.1 * style.storey_height; z += style.storey_height) {
    const reading::Corners ring = section_of(shape, z);
    const std::size_t n = ring.size();
    std::vector<bool> is_seen;
    for (std::size_t i = 0; i < n; ++i)
      is_seen.push_back(dot(normal_at(shape, (ring[i] + ring[(i + 1) % n]) * 0.5), sheet.view().toward) > 0);
    const auto hidden = std::find(is_seen.begin(), is_seen.end(), false);
    if (hidden == is_seen.end()) {
      path.polyline(pixels_of(sheet, ring), true);
      continue;
    }
    // Runs of visible sides, each begun after a hidden one.
    const auto start = static_cast<std::size_t>(hidden - is_seen.begin());
    reading::Corners run;
    for (std::size_t k = 1; k <= n; ++k) {
      const std::size_t i = (start + k) % n;
      if (is_seen[i]) {
        if (run.empty()) run.push_back(ring[i]);
        run.push_back(ring[(i + 1) % n]);
      } else if (!run.empty()) {
        path.polyline(pixels_of(sheet, run, false), false);
        run.clear();
      }
    }
  }
  svg.path(path, {{"fill", "none"}, {"stroke", ink}, {"stroke-width", ".5"}, {"stroke-opacity", ".5"}});
}

}  // namespace

std::string define_ball(Markup& svg, const View& view, const SolidStyle& style, const std::string& id) {
  const Pixel focus = glint(view, style.to_sun);
  svg.open("radialGradient", {{"id", id}});
  constexpr int kStops = 8;
  for (int stop = 0; stop <= kStops; ++stop) {
    // Circles of the gradient shrink towards the glint; each takes the mean light of the normals it passes.
    const double share = 0.999 * stop / kStops;
    double light = 0;
    constexpr int kSamples = 16;
    for (int k = 0; k < kSamples; ++k) {
      const double angle = 2 * std::numbers::pi * k / kSamples;
      const double x = focus.x * (1 - share) + share * std::cos(angle), y = -focus.y * (1 - share) + share * std::sin(angle);
      const double z = std::sqrt(std::max(0.0, 1 - x * x - y * y));
      light += light_on(view.right * x + view.up * y + view.toward * z, style.to_sun) / kSamples;
    }
    svg.leaf("stop", {{"offset", pixels(100.0 * stop / kStops) + "%"}, {"stop-color", shaded(style.colour, light)}});
  }
  svg.close();
  return id;
}

void draw_ball(Markup& svg, const Sheet& sheet, const reading::ExactShape& shape, const SolidStyle& style,
               const std::string& stops, const std::string& id) {
  const std::string ink = hex(mix(style.colour, kInk, 0.62));
  const Pixel centre = sheet.at(shape.centre), focus = glint(sheet.view(), style.to_sun);
  const double radius = shape.radius * sheet.scale();
  std::vector<Pixel> places;
  for (const Point3& p : outline_of(shape, sheet.view().toward)) places.push_back(sheet.at(p));
  PathText outline;
  outline.polyline(simplified(convex_outline(std::move(places)), true), true);
  svg.leaf("radialGradient", {{"id", id},
                              {"href", "#" + stops},
                              {"gradientUnits", "userSpaceOnUse"},
                              {"cx", pixels(centre.x)},
                              {"cy", pixels(centre.y)},
                              {"r", pixels(radius)},
                              {"fx", pixels(centre.x + focus.x * radius)},
                              {"fy", pixels(centre.y + focus.y * radius)}});
  Markup details;
  for (std::size_t k = 0; k < shape.cuts.size(); ++k) {
    if (dot(shape.cuts[k].normal, sheet.view().toward) <= 1e-9) continue;
    PathText face;
    face.polyline(pixels_of(sheet, face_of(shape, k)), true);
    details.path(face, {{"fill", shaded(style.colour, light_on(shape.cuts[k].normal, style.to_sun))},
                        {"stroke", ink},
                        {"stroke-width", ".6"},
                        {"stroke-opacity", ".7"},
                        {"stroke-linejoin", "round"}});
  }
  draw_storeys(details, sheet, shape, style, ink);
  if (details.str().empty()) {
    svg.path(outline, {{"fill", "url(#" + id + ")"}, {"stroke", ink}});
    return;
  }
  svg.path(outline, {{"fill", "url(#" + id + ")"}}).raw(details.str());
  svg.path(outline, {{"fill", "none"}, {"stroke", ink}, {"stroke-width", "1"}, {"stroke-linejoin", "round"}});
}

}  // namespace bl::drawing
