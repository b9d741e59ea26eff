// Streets by flow and load, buildings in grey, sun maps in steps, shadows, plots and data points.
#include "ui/desktop/view/urban_picture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/text.h"
#include "ui/cli/report/figures.h"

namespace bl::desktop {

namespace {

// A street at its capacity has the middle colour of the diverging ramp; this load has its warm end.
constexpr double kHighestLoad = 1.5;
constexpr float kThinnest = 2, kThickest = 11;  // [points]
// Lines on the ground lie a little above it [m].
constexpr double kAboveGround = 0.12;
constexpr int kRampSteps = 24;

Colour colour_of_load(const Theme& theme, double load) {
  return theme.diverging(std::clamp((load - 1) / (kHighestLoad - 1), -1.0, 1.0));
}
Colour colour_of_sun(double share) { return Theme::ramp(0.12 + 0.88 * std::clamp(share, 0.0, 1.0)); }
Colour colour_of_value(const DataFacts& layer, double value) {
  return Theme::ramp(layer.high > layer.low ? (value - layer.low) / (layer.high - layer.low) : 0.5);
}

struct UrbanPicture {
  const SceneFacts& facts;
  const Picks& picks;
  const Theme& theme;
  ViewScene& scene;

  void line(const Point3& a, const Point3& b, Colour colour, float width, float hidden) {
    if (is_finite(a) && is_finite(b)) scene.lines.push_back({a, b, colour, width, hidden});
  }
  void ring(const std::vector<Point3>& points, Colour colour, float width, float hidden) {
    const Vector3 lift{0, 0, kAboveGround};
    for (std::size_t k = 0; k < points.size(); ++k)
      line(points[k] + lift, points[(k + 1) % points.size()] + lift, colour, width, hidden);
  }
  bool stands_out(const std::string& id) const { return picks.nodes.contains(id) || picks.hovered_node == id; }

  void add_streets();
  void add_bodies();
  void add_sun_maps();
  void add_layers();
};

// The trips of a chosen zone run in the accent's colour beside the street's own.
void UrbanPicture::add_streets() {
  const Colours& c = theme.colours();
  std::map<std::uint32_t, double> routes;
  for (const auto& [zone, flows] : facts.urban.routes)
    if (stands_out(facts.state->plan->nodes[zone].id))
      for (const auto& [street, flow] : flows) routes[street] += flow;
  const double most = std::max(facts.urban.most_flow, 1.0);
  const Vector3 lift{0, 0, kAboveGround};
  for (const StreetFacts& street : facts.urban.streets) {
    const Point3 from = facts.places[street.start] + lift, to = facts.places[street.end] + lift;
    const bool is_chosen = stands_out(street.id);
    const float width = theme.px(kThinnest + (kThickest - kThinnest) * static_cast<float>(std::sqrt(street.flow / most)));
    if (const auto route = routes.find(street.node); route != routes.end() && route->second > 0)
      line(from, to, c.accent, width + theme.px(5), 0.35f);
    Colour colour = street.flow > 0 ? colour_of_load(theme, street.load) : faded(c.text_soft, 0.55f);
    if (!street.is_open) colour = faded(c.bad, 0.35f);
    if (is_chosen) line(from, to, c.text, width + theme.px(4), 0.4f);
    line(from, to, colour, street.is_open ? width : theme.px(1.2f), 0.3f);
  }
}

void UrbanPicture::add_bodies() {
  const Colour stone = theme.is_dark() ? 0xff6d6762u : 0xffc9c5c0u;
  const Colour ink = theme.is_dark() ? 0xffb8b2adu : 0xff5a544eu;
  for (const BodyFacts& body : facts.urban.bodies) {
    ViewVolume& shown = scene.volumes.emplace_back();
    shown.node = body.node;
    shown.cell = body.cell;
    shown.colour = stone;
    shown.flags = ViewVolume::plain;
    // An assumed height is hatched, so that nobody takes it for a measured one.
    if (body.is_assumed) shown.flags |= ViewVolume::hatched;
    if (picks.hovered_node == body.id) shown.flags |= ViewVolume::hovered;
    if (picks.nodes.contains(body.id)) shown.flags |= ViewVolume::chosen;
    for (const auto& [a, b] : body.edges) line(a, b, faded(ink, 0.7f), 1, 0);
  }
  std::stable_sort(scene.volumes.begin(), scene.volumes.end(),
                   [](const ViewVolume& a, const ViewVolume& b) { return a.node < b.node; });
}

void UrbanPicture::add_sun_maps() {
  for (const SunMapFacts& map : facts.urban.sun_maps)
    for (const auto& [step, mesh] : map.steps)
      scene.surfaces.push_back({mesh, faded(colour_of_sun(static_cast<double>(step) / kSunSteps), 0.9f)});
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

std::string hours(double seconds) { return report::readable(seconds / 3600) + " h"; }

Legend ramp_of(std::string title, const std::function<Colour(double)>& colour, std::string low, std::string middle,
               std::string high) {
  Legend legend{std::move(title), {}, {}, std::move(low), std::move(middle), std::move(high)};
  for (int k = 0; k <= kRampSteps; ++k) legend.ramp.push_back(colour(static_cast<double>(k) / kRampSteps));
  return legend;
}

}  // namespace

void add_urban(const SceneFacts& facts, const Picks& picks, const Theme& theme, const std::function<bool(const char*)>& shows,
               ViewScene& scene) {
  UrbanPicture picture{facts, picks, theme, scene};
  const Colours& c = theme.colours();
  if (shows("terrain"))
    for (const auto& [node, mesh] : facts.urban.grounds)
      scene.surfaces.push_back({mesh, faded(theme.is_dark() ? 0xff4d5a52u : 0xffb4c4b8u, 0.85f)});
  if (shows("plots"))
    for (const RingFacts& plot : facts.urban.plots)
      picture.ring(plot.ring, plot.is_overshot ? c.bad : c.text_soft, theme.px(picture.stands_out(plot.id) ? 3.0f : 1.6f), 0.4f);
  if (shows("sun_maps")) picture.add_sun_maps();
  if (shows("shadow_outlines"))
    for (const RingFacts& shadow : facts.urban.shadows)
      picture.ring(shadow.ring, picture.stands_out(shadow.id) ? c.accent : faded(c.text, 0.5f),
                   theme.px(picture.stands_out(shadow.id) ? 3.0f : 1.4f), 0.5f);
  if (shows("streets")) picture.add_streets();
  if (shows("buildings")) picture.add_bodies();
  if (shows("data")) picture.add_layers();
  if (const Vector3& sun = facts.urban.sun; norm(sun) > 0) scene.sun = sun / norm(sun);
}

std::vector<Legend> urban_legends(const SceneFacts& facts, const Theme& theme, const std::function<bool(const char*)>& shows) {
  std::vector<Legend> legends;
  if (facts.urban.most_flow > 0 && shows("streets"))
    legends.push_back(ramp_of(
        "Streets: flow over capacity",
        [&](double t) { return colour_of_load(theme, kHighestLoad - 1 + t * 2 * (kHighestLoad - 1)); },
        report::readable(2 - kHighestLoad), "1", report::readable(kHighestLoad)));
  if (!facts.urban.sun_maps.empty() && shows("sun_maps")) {
    double highest = 0;
    for (const SunMapFacts& map : facts.urban.sun_maps) highest = std::max(highest, map.highest);
    std::string title = "Direct sun per day";
    if (const std::int64_t age = facts.urban.sun_age; age > 0)
      title += " (tentative: " + std::to_string(age) + (age == 1 ? " tick old)" : " ticks old)");
    legends.push_back(ramp_of(title, colour_of_sun, hours(0), hours(0.5 * highest), hours(highest)));
  }
  if (shows("data"))
    for (const DataFacts& layer : facts.urban.layers)
      legends.push_back(ramp_of(
          layer.quantity, [](double t) { return Theme::ramp(t); }, report::readable(layer.low) + " " + layer.unit, "",
          report::readable(layer.high) + " " + layer.unit));
  return legends;
}

}  // namespace bl::desktop
