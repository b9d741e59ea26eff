// Outlines rounded to a decimetre: a change that nobody can see is not sent.
#include "core/wire/plan_view.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/define/json_text.h"
#include "core/drawing/palette.h"
#include "core/geometry/plan_ring.h"
#include "core/reading/report_model.h"
#include "core/wire/plan_keys.h"

namespace bl::wire {

namespace {

// Path data, and the box around all of it.
class Paths {
 public:
  std::string path(const std::vector<Point3>& points, bool is_closed) {
    std::string text;
    long last_x = 0, last_y = 0;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const long x = std::lround(points[k].x * 10), y = std::lround(-points[k].y * 10);
      low_x_ = std::min(low_x_, x), high_x_ = std::max(high_x_, x);
      low_y_ = std::min(low_y_, y), high_y_ = std::max(high_y_, y);
      if (k > 0 && x == last_x && y == last_y) continue;
      // Relative steps are shorter than places.
      text += k == 0 ? "M" : "l";
      text += shortest(static_cast<double>(k == 0 ? x : x - last_x) / 10) + " " +
              shortest(static_cast<double>(k == 0 ? y : y - last_y) / 10);
      last_x = x, last_y = y;
    }
    return is_closed && !text.empty() ? text + "z" : text;
  }
  Json box() const {
    if (low_x_ > high_x_) return {-50, -50, 50, 50};
    const auto metres = [](long decimetres) { return static_cast<double>(decimetres) / 10; };
    return {metres(low_x_), metres(low_y_), metres(high_x_), metres(high_y_)};
  }

 private:
  long low_x_ = 1L << 60, high_x_ = -(1L << 60), low_y_ = 1L << 60, high_y_ = -(1L << 60);
};

Json figure(const char* label, double number, const char* unit) { return {label, std::round(number), unit}; }

// Finer than what is rounded away.
constexpr double kPlanTolerance = 0.05;  // [m] that an arc may lie off its chords

// What stands shows its footprint with its courtyards, everything else the outline of its mesh, which is convex.
std::string outline_of(const reading::VolumeRow& volume, Paths& paths) {
  if (volume.body.stacks.empty()) return paths.path(geometry::hull_of_plan(volume.mesh->vertices), true);
  std::string d;
  for (const geometry::PlateFace& face : geometry::faces_of(volume.body.stacks.front(), volume.body.centre, kPlanTolerance)) {
    d += paths.path(face.outer, true);
    for (const geometry::Ring& courtyard : face.holes) d += paths.path(courtyard, true);
  }
  return d;
}

Json volume_of(const State& state, const reading::VolumeRow& volume, Paths& paths, const drawing::Palette& palette) {
  Json node = {{"kind", "volume"}, {"name", volume.name.empty() ? volume.id : volume.name}, {"use", volume.figures.use}};
  node["d"] = outline_of(volume, paths);
  node["fill"] = drawing::hex(palette.colour(volume.use));
  node["met"] = volume.limited > 0 ? Json(!volume.is_short(state.plan->settings.tolerance)) : Json();
  node["figures"] = {figure("volume", volume.volume, "m³"), figure("demand", volume.asked, "m³"),
                     figure("floor_area", volume.floor_area, "m²"), figure("height", volume.figures.height, "m")};
  return node;
}

}  // namespace

std::map<std::string, std::string> plan_view(const State& state) {
  std::map<std::string, std::string> view;
  Paths paths;
  reading::ReportModel model;
  reading::read_model(state, model);
  const drawing::Palette palette(model.use_names());
  PlanKeys keys;
  const auto put = [&](const std::string& key, const Json& node) { view["n/" + key] = write_json_line(node); };
  for (const reading::SiteRow& site : model.sites) {
    std::string d;
    for (const geometry::Polyline& line : site.plan) d += paths.path(line.points, line.is_closed);
    put(keys.key("site", site.name), {{"kind", "boundary"}, {"name", site.name}, {"d", d}});
  }
  for (const auto& [name, ring] : model.surroundings.plots)
    put(keys.key("plot", name), {{"kind", "plot"}, {"name", name}, {"d", paths.path(ring, true)}});
  for (const reading::BuildingShape& building : model.surroundings.buildings) {
    std::string d;
    for (const auto& ring : building.rings) d += paths.path(ring, true);
    put(keys.key("building", building.name), {{"kind", "building"}, {"name", building.name}, {"d", d}, {"use", building.use}});
  }
  for (const reading::StreetLine& street : model.surroundings.streets)
    put(keys.key("street", street.name),
        {{"kind", "street"}, {"name", street.name}, {"d", paths.path(street.line, false)}, {"lanes", street.lanes}});
  for (const reading::VolumeRow& volume : model.volumes)
    if (volume.mesh) put(volume.id, volume_of(state, volume, paths, palette));
  view["box"] = write_json_line(paths.box());
  return view;
}

}  // namespace bl::wire
