// Streets by flow and load, buildings in grey, sun maps in steps, shadows, plots and data points.
#include "ui/desktop/view/urban_picture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/text.h"
#include "core/reading/figures.h"
#include "core/reading/report_model.h"
#include "core/traffic/street_line.h"

namespace bl::desktop {

namespace {

// A street at its capacity has the middle colour of the diverging ramp; this load has its warm end.
constexpr double kHighestLoad = 1.5;
constexpr float kThinnest = 2, kThickest = 11;  // [points]
// Lines on the ground lie a little above it [m].
constexpr double kAboveGround = 0.12;
constexpr int kUrbanRampSteps = 24;
// A band is seen on both sides of its street, also where routes run beside it [points].
constexpr float kBandWidth = 17;

Colour colour_of_load(const Theme& theme, double load) {
  return theme.diverging(std::clamp((load - 1) / (kHighestLoad - 1), -1.0, 1.0));
}
Colour colour_of_sun(double share) { return Theme::ramp(0.12 + 0.88 * std::clamp(share, 0.0, 1.0)); }
// Nearer bands stand out more from the ground; lilac and lime are no colours of load or sun.
Colour colour_of_band(const Theme& theme, std::size_t band, std::size_t count) {
  const float far = static_cast<float>(band) / static_cast<float>(std::max<std::size_t>(2, count) - 1);
  const Colour near_end = theme.is_dark() ? 0xff8af5e9u : 0xff7a1d4au, middle = theme.is_dark() ? 0xffa8b83fu : 0xffb04b9bu;
  const Colour far_end = theme.is_dark() ? 0xffc05f86u : 0xffe6b4d0u;
  return far < 0.5f ? mixed(near_end, middle, 2 * far) : mixed(middle, far_end, 2 * far - 1);
}
Colour colour_of_shade(const Theme& theme) { return theme.is_dark() ? 0x66c48f6au : 0x5c8a5c3cu; }
Colour colour_of_value(const DataFacts& layer, double value) {
  return Theme::ramp(layer.high > layer.low ? (value - layer.low) / (layer.high - layer.low) : 0.5);
}

struct UrbanPicture {
  const SceneFacts& facts;
  const ViewChoices& choices;
  const Picks& picks;
  const Theme& theme;
  ViewScene& scene;

  void line(const Point3& a, const Point3& b, Colour colour, float width, float hidden) {
    if (is_finite(a) && is_finite(b)) scene.lines.push_back({a, b, colour, width, hidden});
  }
  // A line of several pieces, each of which knows its neighbours; points that fall together count once.
  void path(std::vector<Point3> points, Colour colour, float width, float hidden) {
    for (Point3& point : points) point += Vector3{0, 0, kAboveGround};
    std::erase_if(points, [](const Point3& point) { return !is_finite(point); });
    points.erase(std::unique(points.begin(), points.end()), points.end());
    const std::size_t last = points.size() - 1;
    const bool is_round = points.size() > 3 && points.front() == points.back();
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
      ViewLine& piece = scene.lines.emplace_back(ViewLine{points[k], points[k + 1], colour, width, hidden});
      if (k > 0 || is_round) piece.came = points[k] - points[k > 0 ? k - 1 : last - 1];
      if (k + 1 < last || is_round) piece.goes = points[k + 1 < last ? k + 2 : 1] - points[k + 1];
    }
  }
  void ring(const std::vector<Point3>& points, Colour colour, float width, float hidden) {
    const Vector3 lift{0, 0, kAboveGround};
    for (std::size_t k = 0; k < points.size(); ++k)
      line(points[k] + lift, points[(k + 1) % points.size()] + lift, colour, width, hidden);
  }
  bool stands_out(const std::string& id) const { return picks.nodes.contains(id) || picks.hovered_node == id; }

  float width_of(const StreetFacts& street) const {
    const double share = street.flow / std::max(facts.urban.most_flow, 1.0);
    return theme.px(kThinnest + (kThickest - kThinnest) * static_cast<float>(std::sqrt(share)));
  }
  void add_isochrones();
  void add_streets();
  void add_shade();
  void add_edges();
  void add_sun_maps();
  void add_layers();
};

// Under the streets, so that their own colours stay: as far as one gets, and no farther.
void UrbanPicture::add_isochrones() {
  if (!choices.isochrones) return;
  const Isochrones& shown = *choices.isochrones;
  std::map<std::uint32_t, const StreetFacts*> streets;
  for (const StreetFacts& street : facts.urban.streets) streets[street.node] = &street;
  for (const Isochrones::Part& part : shown.parts) {
    const auto street = streets.find(part.street);
    if (street == streets.end()) continue;  // hidden
    path(traffic::part_of_line(line_of(*street->second, choices.held), part.begin, part.end),
         colour_of_band(theme, part.band, shown.times.size()), width_of(*street->second) + theme.px(kBandWidth), 0.3f);
  }
}

// The trips of a chosen zone run in the accent's colour beside the street's own.
void UrbanPicture::add_streets() {
  const Colours& c = theme.colours();
  std::map<std::uint32_t, double> routes;
  for (const auto& [zone, flows] : facts.urban.routes)
    if (stands_out(facts.state->plan->nodes[zone].id))
      for (const auto& [street, flow] : flows) routes[street] += flow;
  for (const StreetFacts& street : facts.urban.streets) {
    const std::vector<Point3> way = line_of(street, choices.held);
    const bool is_chosen = stands_out(street.id);
    const float width = width_of(street);
    if (const auto route = routes.find(street.node); route != routes.end() && route->second > 0)
      path(way, c.accent, width + theme.px(5), 0.35f);
    Colour colour = street.flow > 0 ? colour_of_load(theme, street.load) : faded(c.text_soft, 0.55f);
    if (!street.is_open) colour = faded(c.bad, 0.35f);
    if (is_chosen) path(way, c.text, width + theme.px(4), 0.4f);
    path(way, colour, street.is_open ? width : theme.px(1.2f), 0.3f);
  }
}

void UrbanPicture::add_edges() {
  const Colour ink = theme.is_dark() ? 0xffb8b2adu : 0xff5a544eu;
  for (const BodyFacts& body : facts.urban.bodies)
    for (const auto& [a, b] : body.edges) line(a, b, faded(ink, 0.7f), 1, 0);
}

void UrbanPicture::add_sun_maps() {
  for (const SunMapFacts& map : facts.urban.sun_maps)
    for (const auto& [step, mesh] : map.steps)
      scene.surfaces.push_back({mesh, faded(colour_of_sun(static_cast<double>(step) / kSunSteps), 0.9f)});
}

// All in one colour: shade on shade is no darker, and no order of drawing is to be seen.
void UrbanPicture::add_shade() {
  for (const ShadeBody& body : choices.sun.bodies) {
    scene.bodies.push_back({body.walls, colour_of_shade(theme)});
    ring(body.outline, stands_out(body.id) ? theme.colours().accent : faded(theme.colours().text, 0.45f),
         theme.px(stands_out(body.id) ? 2.4f : 1.2f), 0);
  }
}

// Points as small flat stars: their size does not grow when the camera comes near the ground.
void UrbanPicture::add_layers() {
  for (const DataFacts& layer : facts.urban.layers)
    for (const auto& [place, value] : layer.values) {
      const Point3 at{place.x, place.y, facts.ground + kAboveGround};
      const double reach = 0.004 * facts.radius;
      const Colour colour = colour_of_value(layer, value);
      line(at - Vector3{reach, 0, 0}, at + Vector3{reach, 0, 0}, colour, theme.px(5), 0.25f);
    }
}

std::string hours(double seconds) { return reading::readable(seconds / 3600) + " h"; }

Legend ramp_of(std::string title, const std::function<Colour(double)>& colour, std::string low, std::string middle,
               std::string high) {
  Legend legend{std::move(title), {}, {}, std::move(low), std::move(middle), std::move(high)};
  for (int k = 0; k <= kUrbanRampSteps; ++k) legend.ramp.push_back(colour(static_cast<double>(k) / kUrbanRampSteps));
  return legend;
}

}  // namespace

void add_urban(const SceneFacts& facts, const ViewChoices& choices, const Picks& picks, const Theme& theme,
               const std::function<bool(const char*)>& shows, ViewScene& scene) {
  UrbanPicture picture{facts, choices, picks, theme, scene};
  const Colours& c = theme.colours();
  if (shows("terrain"))
    for (const auto& [node, mesh] : facts.urban.grounds)
      scene.surfaces.push_back({mesh, faded(theme.is_dark() ? 0xff4d5a52u : 0xffb4c4b8u, 0.85f)});
  if (shows("plots"))
    for (const RingFacts& plot : facts.urban.plots)
      picture.ring(plot.ring, plot.is_overshot ? c.bad : c.text_soft, theme.px(picture.stands_out(plot.id) ? 3.0f : 1.6f), 0.4f);
  if (shows("sun_maps")) picture.add_sun_maps();
  if (shows("shadow_outlines"))
    for (const RingFacts& shadow : choices.sun.is_preview ? choices.sun.outlines : facts.urban.shadows)
      picture.ring(shadow.ring, picture.stands_out(shadow.id) ? c.accent : faded(c.text, 0.5f),
                   theme.px(picture.stands_out(shadow.id) ? 3.0f : 1.4f), 0.5f);
  if (shows("isochrones")) picture.add_isochrones();
  if (shows("streets")) picture.add_streets();
  if (shows("buildings")) picture.add_edges();
  if (shows("data")) picture.add_layers();
  if (shows("shade_bodies")) picture.add_shade();
  if (const Vector3& sun = choices.sun.is_there ? choices.sun.toward : facts.urban.sun; sun.z > 0) scene.sun = sun / norm(sun);
  // At night the model has a light to be seen by, and no shadows that anybody could take for the sun's.
  if (choices.sun.is_there && !(choices.sun.toward.z > 0)) scene.layers.shadows = false;
}

namespace {

std::string minutes(double seconds) { return shortest(std::round(seconds / 6) / 10); }

// " (tentative: 3 ticks old)"; nothing for what fits the state.
std::string told_age(std::int64_t age, bool is_ahead) {
  if (age > 0) return " (tentative: " + std::to_string(age) + (age == 1 ? " tick old)" : " ticks old)");
  return is_ahead ? " (tentative: of an earlier sun)" : "";
}

Legend legend_of(const SceneFacts& facts, const Isochrones& shown, const Theme& theme) {
  Legend legend;
  const std::string speed = shortest(shown.walking_speed) + " m/s";
  legend.title = facts.state->plan->nodes[shown.node].name + ", reached " +
                 (shown.is_by_car ? "by car at these flows" : "on foot at " + speed);
  if (!shown.tentative.empty()) legend.title += " (" + shown.tentative + ")";
  if (!shown.reason.empty()) legend.rows.push_back({shown.reason, 0});
  for (std::size_t k = 0; k < shown.times.size() && shown.reason.empty(); ++k)
    legend.rows.push_back({k == 0 ? "within " + minutes(shown.times[0]) + " min"
                                  : minutes(shown.times[k - 1]) + " to " + minutes(shown.times[k]) + " min",
                           colour_of_band(theme, k, shown.times.size())});
  return legend;
}

// What the sun casts just now, and how old it is.
Legend legend_of_shade(const SceneFacts& facts, const SunLook& sun, const Theme& theme,
                       const std::function<bool(const char*)>& shows) {
  Legend legend;
  legend.title = "Shade";
  const std::string when = sun.clock.empty() ? "" : " at " + sun.clock + (sun.is_preview ? " (preview)" : "");
  if (shows("shade_bodies") && !sun.bodies.empty())
    legend.rows.push_back({"Bodies of shade" + when, colour_of_shade(theme) | 0xff000000u});
  const bool is_ahead = !facts.urban.suns.empty() && facts.urban.suns.front().is_ahead;
  if (shows("shadow_outlines") && !(sun.is_preview ? sun.outlines : facts.urban.shadows).empty())
    legend.rows.push_back({"Outlines on the ground" + when + (sun.is_preview ? "" : told_age(facts.urban.sun_age, is_ahead)),
                           faded(theme.colours().text, 0.5f)});
  return legend;
}

}  // namespace

std::vector<Legend> urban_legends(const SceneFacts& facts, const ViewChoices& choices, const Theme& theme,
                                  const std::function<bool(const char*)>& shows) {
  std::vector<Legend> legends;
  if (facts.urban.most_flow > 0 && shows("streets"))
    legends.push_back(ramp_of(
        "Streets: flow over capacity",
        [&](double t) { return colour_of_load(theme, kHighestLoad - 1 + t * 2 * (kHighestLoad - 1)); },
        reading::readable(2 - kHighestLoad), "1", reading::readable(kHighestLoad)));
  if (!facts.urban.sun_maps.empty() && shows("sun_maps")) {
    double highest = 0;
    for (const SunMapFacts& map : facts.urban.sun_maps) highest = std::max(highest, map.highest);
    legends.push_back(ramp_of(std::string("Direct sun per day") + (choices.sun.is_preview ? ", of the scene's days" : "") +
                                  told_age(facts.urban.sun_age, false),
                              colour_of_sun, hours(0), hours(0.5 * highest), hours(highest)));
  }
  legends.push_back(legend_of_shade(facts, choices.sun, theme, shows));
  if (shows("data"))
    for (const DataFacts& layer : facts.urban.layers)
      legends.push_back(ramp_of(
          layer.quantity, [](double t) { return Theme::ramp(t); }, reading::readable(layer.low) + " " + layer.unit, "",
          reading::readable(layer.high) + " " + layer.unit));
  return legends;
}

Legend isochrone_legend(const SceneFacts& facts, const Isochrones* shown, const Theme& theme) {
  return shown != nullptr ? legend_of(facts, *shown, theme) : Legend{};
}

}  // namespace bl::desktop
