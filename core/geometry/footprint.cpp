// Keeps the footprints of sites from call to call and measures anew what a change can have touched.
#include "core/geometry/footprint.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "core/geometry/inside/footprint_workshop.h"

namespace bl::geometry {

namespace {

constexpr std::size_t kGrain = 64;  // sites that one thread measures at a time

bool is_distance(double metres) { return metres >= 0 && std::isfinite(metres); }

Result<void> check(std::span<const StandingSite> sites) {
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const StandingSite& s = sites[i];
    const std::string place = "sites/" + std::to_string(i);
    const auto wrong = [&place](const std::string& what) { return Error{ErrorCode::out_of_range, place, what}; };
    if (!is_finite(s.site.position) || norm(s.site.position) > kLargestCoordinate)
      return wrong("its position is not a place within 100 000 km");
    if (!std::isfinite(s.site.weight) || std::abs(s.site.weight) > kLargestWeight)
      return wrong("its weight is not a number of use");
    if (!(s.aspect >= 1e-3 && s.aspect <= 1e3)) return wrong("the aspect of its block is not between 0.001 and 1000");
    if (!std::isfinite(s.angle)) return wrong("the angle of its block is not a number");
    if (!(s.storey_height > 0) || !std::isfinite(s.storey_height)) return wrong("its storey height is not above 0");
    if (!(s.depth > 0)) return wrong("its depth is not above 0");
    if (!(s.wing_depth > 0)) return wrong("the depth of its wings is not above 0");
    if (!is_distance(s.border_distance) || !is_distance(s.street_distance) || !is_distance(s.exclusion_distance))
      return wrong("a distance from the border of the plot, or from ground that it leaves out, is below 0 or no number");
    for (const StoreyRun& run : s.runs) {
      if (run.storeys < 1 || run.storeys > kMostStoreys) return wrong("a run of its storeys is not between 1 and 10 000");
      if (!is_distance(run.setback) || !is_distance(run.courtyard)) return wrong("a set-back is below 0 or no number");
    }
  }
  return {};
}

}  // namespace

FootprintDiagram::FootprintDiagram() : workshop_(std::make_unique<Workshop>()) {}
FootprintDiagram::~FootprintDiagram() = default;
FootprintDiagram::FootprintDiagram(FootprintDiagram&&) noexcept = default;
FootprintDiagram& FootprintDiagram::operator=(FootprintDiagram&&) noexcept = default;

Result<void> FootprintDiagram::set_domain(const Domain& domain, std::span<const StreetAxis> streets, const Domain* land) {
  const auto is_same_land = [&] { return land == nullptr ? workshop_->land.pieces.empty() : workshop_->land == *land; };
  if (workshop_->has_plot && workshop_->domain == domain && std::ranges::equal(workshop_->streets, streets) && is_same_land())
    return {};
  auto plot = PlanPlot::section(domain, streets, land);
  if (!plot) return plot.error();
  *workshop_ = Workshop();
  workshop_->domain = domain;
  if (land != nullptr) workshop_->land = *land;
  workshop_->streets.assign(streets.begin(), streets.end());
  workshop_->plot = std::move(*plot);
  workshop_->has_plot = true;
  return {};
}

bool FootprintDiagram::is_of(const Domain& domain) const { return workshop_->has_plot && workshop_->domain == domain; }
double FootprintDiagram::plot_area() const { return workshop_->plot.area(); }
std::span<const FootprintMeasure> FootprintDiagram::footprints() const { return workshop_->measures; }
std::span<const std::uint32_t> FootprintDiagram::made() const { return workshop_->made; }

Result<std::span<const FootprintMeasure>> FootprintDiagram::update(std::span<const StandingSite> sites, ThreadPool* pool) {
  Workshop& w = *workshop_;
  if (auto sound = check(sites); !sound) return sound.error();
  w.find_made(sites);
  if (w.made.empty() && !sites.empty()) return std::span<const FootprintMeasure>(w.measures);
  w.erode_plots(sites);
  w.sites.assign(sites.begin(), sites.end());
  w.measures.resize(sites.size());
  w.reaches.resize(sites.size());
  w.is_touched.resize(sites.size(), 0);
  for (const std::uint32_t i : w.made) w.is_touched[i] = 1;
  w.grid.fill(w.sites);
  w.find_coincident();
  const auto measure = [&w](std::size_t begin, std::size_t end) {
    FootprintMaker maker(w.plot, w.grid, w.sites);
    for (std::size_t k = begin; k < end; ++k) w.measure(w.made[k], maker);
  };
  if (pool != nullptr) pool->for_each_chunk(w.made.size(), kGrain, measure);
  else measure(0, w.made.size());
  w.find_largest_reach();
  return std::span<const FootprintMeasure>(w.measures);
}

std::vector<std::uint32_t> FootprintDiagram::take_touched() {
  std::vector<std::uint32_t> touched;
  std::vector<std::uint8_t>& marks = workshop_->is_touched;
  for (std::uint32_t i = 0; i < marks.size(); ++i)
    if (std::exchange(marks[i], std::uint8_t{0}) != 0) touched.push_back(i);
  return touched;
}

void FootprintDiagram::Workshop::erode_plots(std::span<const StandingSite> now) {
  const auto each_offset = [](const StandingSite& site, const auto& take) {
    for (const StoreyRun& run : site.runs) {
      take(outer_offset(site, run).plot);
      if (!std::isfinite(site.depth)) continue;
      const PlateOffset court = courtyard_offset(site, run);
      if (leaves_form(site, court)) take(court.plot);
    }
  };
  for (const std::uint32_t i : made) each_offset(now[i], [this](const PlotOffset& by) { plot.eroded(by); });
  if (plot.kept() <= most_kept) return;
  std::vector<PlotOffset> used;
  for (const StandingSite& site : now) each_offset(site, [&used](const PlotOffset& by) { used.push_back(by); });
  plot.keep_only(std::move(used));
  // Where so many are used they are not looked through in each frame.
  most_kept = std::max(kMostUnused, 2 * plot.kept());
}

void FootprintDiagram::Workshop::find_made(std::span<const StandingSite> now) {
  made.clear();
  if (now.size() != sites.size()) {
    for (std::uint32_t i = 0; i < now.size(); ++i) made.push_back(i);
    return;
  }
  std::vector<std::uint32_t> changed;
  for (std::uint32_t i = 0; i < now.size(); ++i)
    if (!(now[i] == sites[i])) changed.push_back(i);
  if (changed.empty()) return;
  // Whoever had a part of a changed site within its reach, or has it now. Where many have changed, nearly all are touched.
  const bool is_all = changed.size() * 8 > now.size();
  std::vector<std::uint8_t> is_met(now.size(), is_all ? 1 : 0);
  for (const std::uint32_t i : endless) is_met[i] = 1;
  if (!is_all)
    for (const std::uint32_t k : changed) {
      is_met[k] = 1;
      mark_cut(sites[k], is_met);
      mark_cut(now[k], is_met);
    }
  for (std::uint32_t i = 0; i < now.size(); ++i)
    if (is_met[i] != 0) made.push_back(i);
}

// A site at the distance d with the weight v cuts what lies within the reach R of one with the weight w where d² + w - v < 2 R d:
// no farther away than R + sqrt(R² - w + v).
void FootprintDiagram::Workshop::mark_cut(const StandingSite& other, std::vector<std::uint8_t>& is_met) const {
  const double weight = std::max(0.0, other.site.weight);
  const double farthest = largest_reach + std::sqrt(largest_excess + weight);
  grid.around(other.site.position, 1e-9 + (1 + 1e-9) * farthest, [&](std::uint32_t i) {
    if (is_met[i] == 0 && cuts(other, i)) is_met[i] = 1;
  });
}

void FootprintDiagram::Workshop::find_largest_reach() {
  largest_reach = largest_excess = 0;
  endless.clear();
  for (std::uint32_t i = 0; i < reaches.size(); ++i) {
    if (std::isinf(reaches[i])) {
      endless.push_back(i);
      continue;
    }
    largest_reach = std::max(largest_reach, reaches[i]);
    largest_excess = std::max(largest_excess, reaches[i] * reaches[i] - sites[i].site.weight);
  }
}

bool FootprintDiagram::Workshop::cuts(const StandingSite& other, std::uint32_t i) const {
  const double reach = reaches[i];
  if (std::isinf(reach)) return true;
  const double dx = other.site.position.x - sites[i].site.position.x, dy = other.site.position.y - sites[i].site.position.y;
  const double squared = dx * dx + dy * dy;
  return !(squared + sites[i].site.weight - other.site.weight >= 2 * reach * std::sqrt(squared)) || squared == 0;
}

void FootprintDiagram::Workshop::find_coincident() {
  order.resize(sites.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto place = [this](std::uint32_t i) { return std::pair(sites[i].site.position.x, sites[i].site.position.y); };
  // A form without a weight has no footprint, and takes none from a cell, whose weight may be below zero.
  const auto weight = [this](std::uint32_t i) {
    const double own = sites[i].site.weight;
    return sites[i].form == FootprintForm::cell || own > 0 ? own : -std::numeric_limits<double>::infinity();
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    if (place(a) != place(b)) return place(a) < place(b);
    return weight(a) != weight(b) ? weight(a) > weight(b) : a < b;
  });
  is_covered.assign(sites.size(), 0);
  for (std::size_t k = 1; k < order.size(); ++k) is_covered[order[k]] = place(order[k]) == place(order[k - 1]) ? 1 : 0;
}

void FootprintDiagram::Workshop::measure(std::uint32_t i, FootprintMaker& maker) {
  FootprintMeasure& measure = measures[i];
  reaches[i] = maker.measure(i, measure);
  if (is_covered[i] == 0) return;
  const std::size_t runs = measure.plates.size();
  measure = FootprintMeasure();
  measure.state = SiteState::coincident;
  measure.plates.assign(runs, 0);
}

}  // namespace bl::geometry
