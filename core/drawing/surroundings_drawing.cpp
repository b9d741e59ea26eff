// Draws surroundings in plan, lighter than the proposal: they are where it stands, not what it is about.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/text.h"
#include "core/drawing/palette.h"
#include "core/drawing/solid_drawing.h"
#include "core/drawing/surroundings_drawing.h"
#include "core/reading/figures.h"
#include "core/traffic/street_line.h"

namespace bl::drawing {

namespace {

constexpr double kLaneWidth = 3.25;  // [m]
constexpr double kSampleRow = 17;
constexpr Colour kRoadTone = {0.86, 0.85, 0.82}, kFootway = {0.91, 0.90, 0.86}, kBodyTone = {0.80, 0.78, 0.74},
                 kContour = {0.72, 0.62, 0.45};
constexpr Colour kLeastSun = {0.55, 0.62, 0.78}, kMostSun = {1.0, 0.90, 0.45};
constexpr Colour kLeastData = {0.90, 0.87, 0.93}, kMostData = {0.45, 0.20, 0.50};

// Loads in classes that planners read: free, busy, full, overloaded; the dash tells them apart without the colour.
struct LoadClass {
  double from;
  std::string_view colour, words;
  double width;
};
constexpr std::array kLoads = {LoadClass{0, "#7a8a99", "load below 60 %", 1.6}, LoadClass{0.6, "#b8860b", "60 to 85 %", 2.6},
                               LoadClass{0.85, "#d2691e", "85 to 100 %", 3.6}, LoadClass{1.0, "#a01818", "overloaded", 5.0}};

std::size_t load_class(double load) {
  std::size_t found = 0;
  for (std::size_t k = 0; k < kLoads.size(); ++k)
    if (load >= kLoads[k].from) found = k;
  return found;
}

Colour between(const Colour& low, const Colour& high, double share) { return mix(low, high, std::clamp(share, 0.0, 1.0)); }

PathText ring_path(const Sheet& sheet, const std::vector<std::vector<Point3>>& rings) {
  PathText path;
  for (const std::vector<Point3>& ring : rings) {
    std::vector<Pixel> places;
    for (const Point3& corner : ring) places.push_back(sheet.at(corner));
    path.polyline(places, true);
  }
  return path;
}

// The heights at which lines are drawn: about ten over all grounds, at round numbers.
double contour_step(const reading::Surroundings& surroundings, double& low, double& high) {
  bool is_first = true;
  for (const MeshPointer& mesh : surroundings.grounds)
    for (const Point3& vertex : mesh->vertices) {
      low = is_first ? vertex.z : std::min(low, vertex.z);
      high = is_first ? vertex.z : std::max(high, vertex.z);
      is_first = false;
    }
  return high - low > 0.05 ? round_length((high - low) / 6) : 0;
}

void draw_contours(Markup& svg, const Sheet& sheet, const reading::Surroundings& surroundings) {
  double low = 0, high = 0;
  const double step = contour_step(surroundings, low, high);
  if (!(step > 0)) return;
  PathText lines;
  for (const MeshPointer& mesh : surroundings.grounds)
    for (double k = std::floor(low / step) + 1; k * step < high; k += 1)
      for (const geometry::Polyline& line : geometry::section(*mesh, k * step, [](std::size_t) { return true; }))
        lines.polyline(on_sheet(sheet, line), line.is_closed);
  svg.path(lines, {{"fill", "none"}, {"stroke", hex(kContour)}, {"stroke-width", ".8"}});
}

void draw_data(Markup& svg, const Sheet& sheet, const reading::DataField& field) {
  const double span = field.high > field.low ? field.high - field.low : 1;
  for (const auto& [point, value] : field.points) {
    const Pixel at = sheet.at(point);
    const double share = (value - field.low) / span;
    svg.open("circle", {{"cx", pixels(at.x)},
                        {"cy", pixels(at.y)},
                        {"r", pixels(2 + 3 * std::clamp(share, 0.0, 1.0))},
                        {"fill", hex(between(kLeastData, kMostData, share))},
                        {"fill-opacity", ".75"}});
    svg.element("title", field.name + ": " + reading::readable(value) + (field.unit.empty() ? "" : " " + field.unit)).close();
  }
}

void draw_sun(Markup& svg, const Sheet& sheet, const reading::SunField& field, double most) {
  constexpr int kSteps = 8;
  std::array<PathText, kSteps + 1> squares;
  for (const auto& [point, sun] : field.points) {
    const double share = most > 0 ? sun / most : 0;
    const auto step = static_cast<std::size_t>(std::clamp(std::lround(share * kSteps), 0L, static_cast<long>(kSteps)));
    std::vector<Pixel> corners;
    // An upright receiver is a line in plan: its squares lie on one another.
    const Vector3 up = field.is_upright ? Vector3{} : field.half_up;
    for (const auto& [a, b] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}})
      corners.push_back(sheet.at(point + a * field.half_across + b * up));
    squares[step].polyline(corners, true);
  }
  svg.open("g").element("title", field.name + ": " + reading::quantity(field.mean, Unit::second) +
                                     " of sun per day in the mean, of " + reading::quantity(field.possible, Unit::second) +
                                     " without casters");
  for (std::size_t step = 0; step <= kSteps; ++step) {
    const std::string colour = hex(between(kLeastSun, kMostSun, static_cast<double>(step) / kSteps));
    svg.path(squares[step], {{"fill", colour}, {"stroke", colour}, {"stroke-width", field.is_upright ? "4" : ".4"}});
  }
  svg.close();
}

void draw_street(Markup& svg, const Sheet& sheet, const reading::StreetLine& street) {
  PathText path;
  std::vector<Pixel> places;
  for (const Point3& point : street.line) places.push_back(sheet.at(point));
  path.polyline(places, false);
  const double width = street.is_for_cars ? std::max(3.0, street.lanes * kLaneWidth * sheet.scale()) : 2.5;
  svg.path(path, {{"fill", "none"},
                  {"stroke", hex(street.is_for_cars ? kRoadTone : kFootway)},
                  {"stroke-width", pixels(width)},
                  {"stroke-linejoin", "round"},
                  {"stroke-linecap", "round"}});
}

void draw_load(Markup& svg, const Sheet& sheet, const reading::StreetLine& street) {
  if (!street.has_traffic && street.is_open) return;
  PathText path;
  std::vector<Pixel> places;
  for (const Point3& point : street.line) places.push_back(sheet.at(point));
  path.polyline(places, false);
  const LoadClass& load = kLoads[load_class(street.load)];
  svg.open("g").element(
      "title", street.name + ": " +
                   (street.is_open ? reading::grouped(street.flow) + " vehicles per hour, load " + reading::percent(street.load)
                                   : std::string("closed")));
  svg.path(path, {{"fill", "none"},
                  {"stroke", street.is_open ? std::string(load.colour) : hex(kInk)},
                  {"stroke-width", pixels(street.is_open ? load.width : 1.2)},
                  {"stroke-dasharray", street.is_open ? "" : "2 4"},
                  {"stroke-linecap", "round"},
                  {"stroke-linejoin", "round"}});
  svg.close();
}

bool is_within(const Box& frame, Pixel at) {
  return at.x >= frame.left && at.x <= frame.right && at.y >= frame.top && at.y <= frame.bottom;
}

// The middle of what of a line is inside the frame; streets lead out of it.
bool middle_in(const Sheet& sheet, const std::vector<Point3>& line, const Box& frame, Pixel& middle) {
  constexpr int kParts = 64;
  std::vector<Pixel> inside;
  for (int k = 0; k <= kParts; ++k) {
    const Pixel at = sheet.at(traffic::point_on_line(line, static_cast<double>(k) / kParts));
    if (is_within(frame, at)) inside.push_back(at);
  }
  if (inside.empty()) return false;
  middle = inside[inside.size() / 2];
  return true;
}

// Samples of the legend, 32 px wide, each with its words.
class SampleRow {
 public:
  SampleRow(Markup* svg, const Sheet& sheet, Pixel at) : svg_(svg), sheet_(sheet), first_(at), at_(at) {}

  // Where the next sample begins, 32 px wide; goes on in the next row where the words have no room.
  Pixel next(const std::string& words) {
    const double width = 40 + text_width(words, 10) + 16;
    if (at_.x + width > sheet_.width() - 20 && at_.x > first_.x) at_ = {first_.x, at_.y + kSampleRow};
    const Pixel place = at_;
    if (svg_ != nullptr)
      svg_->element("text", words, {{"x", pixels(place.x + 38)}, {"y", pixels(place.y)}, {"class", "figure start"}});
    at_.x += width;
    used_ = true;
    return place;
  }
  void box(Pixel at, const std::string& fill, const std::string& stroke, const std::string& dashes) {
    if (svg_ != nullptr)
      svg_->leaf("rect", {{"x", pixels(at.x)},
                          {"y", pixels(at.y - 9)},
                          {"width", "32"},
                          {"height", "10"},
                          {"fill", fill},
                          {"stroke", stroke},
                          {"stroke-width", ".8"},
                          {"stroke-dasharray", dashes}});
  }
  void line(Pixel at, const std::string& stroke, double width, const std::string& dashes) {
    if (svg_ != nullptr)
      svg_->leaf("line", {{"x1", pixels(at.x)},
                          {"y1", pixels(at.y - 3.5)},
                          {"x2", pixels(at.x + 32)},
                          {"y2", pixels(at.y - 3.5)},
                          {"stroke", stroke},
                          {"stroke-width", pixels(width)},
                          {"stroke-dasharray", dashes}});
  }
  void ramp(Pixel at, const Colour& low, const Colour& high) {
    if (svg_ == nullptr) return;
    for (int k = 0; k < 8; ++k)
      svg_->leaf("rect", {{"x", pixels(at.x + 4 * k)},
                          {"y", pixels(at.y - 9)},
                          {"width", "4.3"},
                          {"height", "10"},
                          {"fill", hex(between(low, high, k / 7.0))}});
  }
  double height() const { return used_ ? at_.y - first_.y + kSampleRow : 0; }

 private:
  Markup* svg_;
  const Sheet& sheet_;
  Pixel first_, at_;
  bool used_ = false;
};

}  // namespace

void draw_ground_layers(Markup& svg, const Sheet& sheet, const reading::Surroundings& surroundings) {
  draw_contours(svg, sheet, surroundings);
  for (const reading::SunField& field : surroundings.sun) draw_sun(svg, sheet, field, surroundings.most_sun);
}

void draw_streets_and_buildings(Markup& svg, const Sheet& sheet, const reading::Surroundings& surroundings) {
  for (const reading::StreetLine& street : surroundings.streets) draw_street(svg, sheet, street);
  for (const reading::StreetLine& street : surroundings.streets) draw_load(svg, sheet, street);
  for (const reading::BuildingShape& building : surroundings.buildings) {
    svg.open("g").element("title", building.name + (building.use.empty() ? "" : ", " + building.use) + ": " +
                                       reading::quantity(building.height, Unit::metre) + " high" +
                                       (building.is_assumed ? ", assumed" : ""));
    svg.path(ring_path(sheet, building.rings), {{"fill", hex(kBodyTone)},
                                                {"fill-rule", "evenodd"},
                                                {"stroke", hex(mix(kBodyTone, kInk, 0.5))},
                                                {"stroke-width", "1"},
                                                {"stroke-dasharray", building.is_assumed ? "4 2.5" : ""}});
    svg.close();
  }
  // Two layers of dots could not be told apart; the others are in the tables.
  if (!surroundings.data.empty()) draw_data(svg, sheet, surroundings.data.front());
}

void draw_plots(Markup& svg, const Sheet& sheet, const reading::Surroundings& surroundings) {
  for (const auto& [name, ring] : surroundings.plots) {
    svg.open("g").element("title", "Plot " + name);
    svg.path(ring_path(sheet, {ring}),
             {{"fill", "none"}, {"stroke", hex(kInk)}, {"stroke-width", "1"}, {"stroke-dasharray", "1.5 3"}});
    svg.close();
  }
}

std::vector<Label> surroundings_labels(const Sheet& sheet, const reading::Surroundings& surroundings, const Box& frame) {
  constexpr std::size_t kMost = 40;
  std::vector<Label> labels;
  if (surroundings.streets.size() <= kMost)
    for (const reading::StreetLine& street : surroundings.streets)
      if (Pixel at; street.has_traffic && street.line.size() >= 2 && middle_in(sheet, street.line, frame, at))
        labels.push_back({at, street.name, "load " + reading::percent(street.load), reading::percent(street.load)});
  if (surroundings.buildings.size() <= kMost)
    for (const reading::BuildingShape& building : surroundings.buildings) {
      Point3 middle;
      for (const Point3& corner : building.rings.front()) middle += corner / static_cast<double>(building.rings.front().size());
      // What is cut away at the frame is not on the sheet.
      if (!is_within(frame, sheet.at(middle))) continue;
      labels.push_back({sheet.at(middle), building.name,
                        reading::quantity(building.height, Unit::metre) + (building.is_assumed ? ", assumed" : ""),
                        reading::readable(building.height)});
    }
  for (const reading::SunField& field : surroundings.sun) {
    Point3 middle;
    for (const auto& [point, sun] : field.points) middle += point / static_cast<double>(field.points.size());
    if (!is_within(frame, sheet.at(middle))) continue;
    // The mean of a garden may be long while half of it lies in the shade.
    const bool has_rule = field.required > 0;
    const std::string found = has_rule ? reading::percent(field.share_met) : reading::quantity(field.mean, Unit::second);
    labels.push_back({sheet.at(middle), field.name,
                      has_rule ? found + " has " + reading::quantity(field.required, Unit::second) + " of sun" : "sun " + found,
                      found});
  }
  return labels;
}

double draw_surroundings_legend(Markup* svg, const Sheet& sheet, const reading::Surroundings& surroundings, Pixel at) {
  SampleRow row(svg, sheet, at);
  const auto any_street = [&](auto has) { return std::any_of(surroundings.streets.begin(), surroundings.streets.end(), has); };
  if (any_street([](const reading::StreetLine& s) { return !s.has_traffic; }))
    row.line(row.next("street"), hex(kRoadTone), 6, "");
  for (std::size_t k = 0; k < kLoads.size(); ++k)
    if (any_street([&](const reading::StreetLine& s) { return s.has_traffic && s.is_open && load_class(s.load) == k; }))
      row.line(row.next("street, " + std::string(kLoads[k].words)), std::string(kLoads[k].colour), kLoads[k].width, "");
  if (any_street([](const reading::StreetLine& s) { return !s.is_open; }))
    row.line(row.next("street, closed"), hex(kInk), 1.2, "2 4");
  const std::string edge = hex(mix(kBodyTone, kInk, 0.5));
  const auto any_building = [&](bool is_assumed) {
    return std::any_of(surroundings.buildings.begin(), surroundings.buildings.end(),
                       [&](const reading::BuildingShape& b) { return b.is_assumed == is_assumed; });
  };
  if (any_building(false)) row.box(row.next("existing building"), hex(kBodyTone), edge, "");
  if (any_building(true)) row.box(row.next("existing, height assumed"), hex(kBodyTone), edge, "4 2.5");
  if (!surroundings.plots.empty()) row.line(row.next("plot"), hex(kInk), 1, "1.5 3");
  if (!surroundings.sun.empty())
    row.ramp(row.next("sun per day, 0 to " + reading::quantity(surroundings.most_sun, Unit::second)), kLeastSun, kMostSun);
  if (!surroundings.data.empty()) {
    const reading::DataField& field = surroundings.data.front();
    row.ramp(row.next(field.name + ", " + reading::readable(field.low) + " to " + reading::readable(field.high) +
                      (field.unit.empty() ? "" : " " + field.unit)),
             kLeastData, kMostData);
  }
  double low = 0, high = 0;
  if (const double step = contour_step(surroundings, low, high); step > 0)
    row.line(row.next("height lines, every " + shortest(step) + " m"), hex(kContour), 0.8, "");
  return row.height();
}

void draw_ground_aside(Markup& svg, const Sheet& sheet, const reading::Surroundings& surroundings,
                       const std::vector<Point3>& frame, double ground, const std::string& id) {
  if (frame.size() != 2 || surroundings.is_empty()) return;
  PathText edge;
  edge.polyline({sheet.at({frame[0].x, frame[0].y, ground}), sheet.at({frame[1].x, frame[0].y, ground}),
                 sheet.at({frame[1].x, frame[1].y, ground}), sheet.at({frame[0].x, frame[1].y, ground})},
                true);
  svg.open("clipPath", {{"id", id + "-around"}}).path(edge, {}).close();
  svg.open("g", {{"clip-path", "url(#" + id + "-around)"}});
  for (const reading::SunField& field : surroundings.sun)
    if (!field.is_upright) draw_sun(svg, sheet, field, surroundings.most_sun);
  for (const reading::StreetLine& street : surroundings.streets) draw_street(svg, sheet, street);
  for (const reading::StreetLine& street : surroundings.streets) draw_load(svg, sheet, street);
  svg.close();
}

void draw_buildings_aside(Markup& svg, const Sheet& sheet, const reading::Surroundings& surroundings,
                          const std::vector<Point3>& frame, const Point3& middle, const Vector3& to_sun, bool before) {
  if (frame.size() != 2) return;
  std::vector<std::pair<double, const reading::BuildingShape*>> order;
  const double depth_of_middle = sheet.depth({middle.x, middle.y, 0});
  for (const reading::BuildingShape& building : surroundings.buildings) {
    if (!building.mesh || building.mesh->triangles.empty()) continue;
    Point3 centre;
    bool is_near = false;
    for (const Point3& corner : building.rings.front()) {
      centre += corner / static_cast<double>(building.rings.front().size());
      is_near = is_near || (corner.x >= frame[0].x && corner.x <= frame[1].x && corner.y >= frame[0].y && corner.y <= frame[1].y);
    }
    const double depth = sheet.depth({centre.x, centre.y, 0});
    if (is_near && (depth > depth_of_middle) == before) order.emplace_back(depth, &building);
  }
  std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [depth, building] : order) {
    svg.open("g", {{"opacity", before ? ".45" : "1"}});
    svg.element("title", building->name + ": " + reading::quantity(building->height, Unit::metre) + " high" +
                             (building->is_assumed ? ", assumed" : ""));
    draw_solid(svg, sheet, *building->mesh, {kBodyTone, to_sun, 0, 0, 0});
    svg.close();
  }
}

std::string surroundings_caption(const reading::Surroundings& surroundings) {
  if (surroundings.is_empty()) return "";
  std::string caption = " Around the site, as far as the frame reaches: what stands and runs there; the tables have all of it.";
  if (surroundings.data.size() > 1)
    caption += " Of " + reading::counted(surroundings.data.size(), "data layer") + " the first is drawn.";
  return caption;
}

}  // namespace bl::drawing
