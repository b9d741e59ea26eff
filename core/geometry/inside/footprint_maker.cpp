// Clips footprints and adds up their plates; the formulas stand in the README under "Standing volumes".
#include "core/geometry/inside/footprint_maker.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/mathematics.h"

namespace bl::geometry {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Labels beside those of PlanSide. A block's sides are its first pair, across which its first side runs, and its second.
constexpr std::size_t kMostSquares = 1000;  // in a row or column
constexpr double kNothing = 1e-13;          // areas below this share of the square of the reach
constexpr std::int32_t kAlong = -10, kAcross = -11;

struct HalfSides {
  double along = 0, across = 0;  // [m]
};

HalfSides half_sides(const StandingSite& site) {
  const double weight = std::max(0.0, site.site.weight);
  return {std::sqrt(weight * site.aspect), std::sqrt(weight / site.aspect)};
}

}  // namespace

PlateOffset outer_offset(const StandingSite& site, const StoreyRun& run) {
  return {run.setback,
          site.has_party_walls ? 0 : run.setback,
          {site.border_distance + (site.has_border_walls ? 0 : run.setback), site.street_distance + run.setback,
           site.exclusion_distance + run.setback}};
}

PlateOffset courtyard_offset(const StandingSite& site, const StoreyRun& run) {
  const PlateOffset outer = outer_offset(site, run);
  const auto depth = [&](double most) { return std::max(0.0, most - run.courtyard); };
  const double own = depth(site.depth), wing = depth(std::min(site.depth, site.wing_depth));
  return {outer.own + own,
          outer.neighbour + (site.has_party_walls ? wing : own),
          {outer.plot.border + (site.has_border_walls ? wing : own), outer.plot.street + own, outer.plot.left_out + own}};
}

bool leaves_form(const StandingSite& site, const PlateOffset& offset) {
  if (site.form == FootprintForm::cell) return true;
  if (site.form == FootprintForm::round) return std::sqrt(std::max(0.0, site.site.weight)) > offset.own;
  const HalfSides half = half_sides(site);
  return half.along > offset.own && half.across > offset.own;
}

int StandingSite::storeys() const {
  int count = 0;
  for (const StoreyRun& run : runs) count += run.storeys;
  return count;
}

double reach_of(const StandingSite& site) {
  if (site.form == FootprintForm::cell) return kInfinity;
  const double weight = std::max(0.0, site.site.weight);
  return site.form == FootprintForm::round ? std::sqrt(weight) : std::sqrt(weight * (site.aspect + 1 / site.aspect));
}

void PlanGrid::fill(std::span<const StandingSite> sites) {
  low_ = {kInfinity, kInfinity};
  PlanPoint high{-kInfinity, -kInfinity};
  largest_weight_ = 0;
  for (const StandingSite& s : sites) {
    low_ = {std::min(low_.x, s.site.position.x), std::min(low_.y, s.site.position.y)};
    high = {std::max(high.x, s.site.position.x), std::max(high.y, s.site.position.y)};
    largest_weight_ = std::max(largest_weight_, s.site.weight);
  }
  if (sites.empty()) {
    sites_.clear();
    return;
  }
  sort_in(sites, high);
  if (!is_crowded()) return;
  // The box of nine tenths of the sites, and a little more.
  std::vector<double> places(sites.size());
  const auto middle = [&](const auto& place_of, double& low, double& end) {
    for (std::size_t i = 0; i < sites.size(); ++i) places[i] = place_of(sites[i]);
    std::sort(places.begin(), places.end());
    const std::size_t cut = sites.size() / 20;
    const double first = places[cut], last = places[places.size() - 1 - cut], more = 0.1 * (last - first);
    low = std::max(low, first - more);
    end = std::min(end, last + more);
  };
  middle([](const StandingSite& s) { return s.site.position.x; }, low_.x, high.x);
  middle([](const StandingSite& s) { return s.site.position.y; }, low_.y, high.y);
  sort_in(sites, high);
}

bool PlanGrid::is_crowded() const {
  constexpr std::uint32_t kMany = 64;
  std::uint32_t most = 0;
  for (std::size_t k = 1; k < starts_.size(); ++k) most = std::max(most, starts_[k] - starts_[k - 1]);
  return most > kMany && most > sites_.size() / 8;
}

void PlanGrid::sort_in(std::span<const StandingSite> sites, const PlanPoint& high) {
  const double x = high.x - low_.x, y = high.y - low_.y;
  width_ = std::max({std::sqrt(x * y / static_cast<double>(sites.size())), std::max(x, y) / kMostSquares, 1e-9});
  columns_ = rows_ = kMostSquares + 1;
  columns_ = column_of(high.x) + 1;
  rows_ = row_of(high.y) + 1;
  starts_.assign(columns_ * rows_ + 1, 0);
  const auto square = [this](const StandingSite& s) {
    return row_of(s.site.position.y) * columns_ + column_of(s.site.position.x);
  };
  for (const StandingSite& s : sites) ++starts_[square(s) + 1];
  for (std::size_t k = 1; k < starts_.size(); ++k) starts_[k] += starts_[k - 1];
  sites_.resize(sites.size());
  std::vector<std::uint32_t> at(starts_.begin(), starts_.end() - 1);
  for (std::uint32_t i = 0; i < sites.size(); ++i) sites_[at[square(sites[i])]++] = i;
}

std::size_t PlanGrid::column_of(double x) const {
  return static_cast<std::size_t>(std::clamp((x - low_.x) / width_, 0.0, static_cast<double>(columns_ - 1)));
}

std::size_t PlanGrid::row_of(double y) const {
  return static_cast<std::size_t>(std::clamp((y - low_.y) / width_, 0.0, static_cast<double>(rows_ - 1)));
}

void PlanGrid::near(std::uint32_t i, std::span<const StandingSite> sites, double reach, const PlanPoint& low,
                    const PlanPoint& high, std::vector<PlanNeighbour>& found) const {
  found.clear();
  const Point3& at = sites[i].site.position;
  const double weight = sites[i].site.weight;
  const auto column = static_cast<std::ptrdiff_t>(column_of(at.x)), row = static_cast<std::ptrdiff_t>(row_of(at.y));
  // Without a form, what is left of the box after the bisectors so far says how far to look.
  const bool is_open = std::isinf(reach);
  bool is_hidden = false;  // those found so far leave nothing of the box
  PlanPolygon rest, spare;
  if (is_open) {
    rest.corners = {{{low.x - at.x, low.y - at.y}},
                    {{high.x - at.x, low.y - at.y}},
                    {{high.x - at.x, high.y - at.y}},
                    {{low.x - at.x, high.y - at.y}}};
    reach = std::sqrt(rest.farthest_squared());
  }
  // A site at the distance d with the weight v cuts what lies within the reach R where (d² + w - v) / 2d < R.
  const auto limit = [&](double other) { return reach + std::sqrt(std::max(0.0, reach * reach - weight + other)); };
  const auto see = [&](std::size_t square) {
    for (std::uint32_t k = starts_[square]; k < starts_[square + 1] && !is_hidden; ++k) {
      const std::uint32_t j = sites_[k];
      const double dx = sites[j].site.position.x - at.x, dy = sites[j].site.position.y - at.y;
      const double squared = dx * dx + dy * dy;
      if (j == i || !(squared > 0)) continue;
      const double other = sites[j].site.weight, distance = std::sqrt(squared);
      const double offset = 0.5 * (squared + weight - other) / distance;
      if (!(offset < reach)) continue;
      found.push_back({j, distance, {dx / distance, dy / distance, offset}});
      if (!is_open || !clip(rest, found.back().half_plane, 0, spare)) continue;
      is_hidden = rest.is_empty();
      if (!is_hidden) reach = std::sqrt(rest.farthest_squared());
    }
  };
  const auto most = static_cast<std::ptrdiff_t>(std::max(columns_, rows_));
  for (std::ptrdiff_t ring = 0; ring <= most && !is_hidden; ++ring) {
    // All sites of this ring and beyond are at least so far away, those beyond the edge all the more.
    if (ring > 1 && static_cast<double>(ring - 1) * width_ > limit(largest_weight_)) break;
    for (std::ptrdiff_t r = row - ring; r <= row + ring; ++r) {
      if (r < 0 || r >= static_cast<std::ptrdiff_t>(rows_)) continue;
      const bool is_edge = r == row - ring || r == row + ring;
      for (std::ptrdiff_t c = column - ring; c <= column + ring; c += is_edge ? 1 : std::max<std::ptrdiff_t>(1, 2 * ring)) {
        if (c < 0 || c >= static_cast<std::ptrdiff_t>(columns_)) continue;
        see(static_cast<std::size_t>(r) * columns_ + static_cast<std::size_t>(c));
      }
    }
  }
  std::erase_if(found, [reach](const PlanNeighbour& n) { return !(n.half_plane.offset < reach); });
  std::sort(found.begin(), found.end(), [](const PlanNeighbour& a, const PlanNeighbour& b) {
    return std::pair(a.half_plane.offset, a.site) < std::pair(b.half_plane.offset, b.site);
  });
}

void FootprintMaker::find_neighbours(std::uint32_t i) {
  grid_.near(i, sites_, reach_of(sites_[i]), plot_.low(), plot_.high(), neighbours_);
}

bool FootprintMaker::cut(const PlanPlot::Piece& piece, std::uint32_t i, const PlateOffset& offset) {
  const StandingSite& site = sites_[i];
  const Point3& at = site.site.position;
  const double reach = reach_of(site);
  if (piece.low.x - at.x > reach || at.x - piece.high.x > reach || piece.low.y - at.y > reach || at.y - piece.high.y > reach)
    return false;
  polygon_.corners.clear();
  for (const PlanPolygon::Corner& c : piece.polygon.corners)
    polygon_.corners.push_back({{c.at.x - at.x, c.at.y - at.y}, c.beyond});
  if (site.form == FootprintForm::block) {
    const HalfSides half = half_sides(site);
    const double x = mathematics::cosine(site.angle), y = mathematics::sine(site.angle);
    clip(polygon_, {x, y, half.along - offset.own}, kAlong, spare_);
    clip(polygon_, {-x, -y, half.along - offset.own}, kAlong, spare_);
    clip(polygon_, {-y, x, half.across - offset.own}, kAcross, spare_);
    clip(polygon_, {y, -x, half.across - offset.own}, kAcross, spare_);
  }
  for (std::uint32_t k = 0; k < neighbours_.size() && !polygon_.is_empty(); ++k) {
    HalfPlane side = neighbours_[k].half_plane;
    side.offset -= offset.neighbour;
    clip(polygon_, side, static_cast<std::int32_t>(k), spare_);
  }
  return !polygon_.is_empty();
}

FootprintMaker::Sum FootprintMaker::measure_offset(std::uint32_t i, const PlateOffset& offset) {
  Sum sum;
  lengths_.assign(neighbours_.size(), 0);
  const StandingSite& site = sites_[i];
  if (!leaves_form(site, offset)) return sum;
  const double radius = site.form == FootprintForm::round ? std::sqrt(std::max(0.0, site.site.weight)) - offset.own : kInfinity;
  const PlanPlot::Pieces* pieces = plot_.made(offset.plot);
  if (pieces == nullptr) return sum;
  double scale = 0;
  for (const PlanPlot::Piece& piece : *pieces) {
    if (!cut(piece, i, offset)) continue;
    scale += std::isfinite(radius) ? radius * radius : polygon_.farthest_squared();
    side_lengths_.assign(polygon_.corners.size(), 0);
    const DiscMeasure inside = measure_in_disc(polygon_, radius, side_lengths_);
    sum.area += inside.area;
    sum.arc += inside.arc;
    for (std::size_t k = 0; k < side_lengths_.size(); ++k) {
      const std::int32_t beyond = polygon_.corners[k].beyond;
      if (beyond >= 0) lengths_[static_cast<std::size_t>(beyond)] += side_lengths_[k];
      if (beyond == kAlong) sum.along += side_lengths_[k];
      if (beyond == kAcross) sum.across += side_lengths_[k];
    }
  }
  // What is left of angles that cancel out is no area.
  if (sum.area > kNothing * scale) return sum;
  std::fill(lengths_.begin(), lengths_.end(), 0);
  return {};
}

double FootprintMaker::measure(std::uint32_t i, FootprintMeasure& into) {
  const StandingSite& site = sites_[i];
  into.plates.clear();
  into.neighbours.clear();
  into.state = SiteState::alive;
  into.footprint = into.floor_area = into.volume = into.own_response = into.free_response = 0;
  const double root = std::sqrt(std::max(0.0, site.site.weight));
  // Without a weight there is no form; a plan cell does not need one.
  if (!(root > 0) && site.form != FootprintForm::cell) {
    into.state = SiteState::starved;
    into.plates.assign(site.runs.size(), 0);
    return 0;
  }
  find_neighbours(i);
  responses_.assign(neighbours_.size(), 0);
  std::vector<double>& walls = walls_;
  walls.assign(neighbours_.size(), 0);
  // How the area follows the own weight at sides without a neighbour.
  const auto free_response = [&](const Sum& sum) {
    if (site.form == FootprintForm::cell) return 0.0;
    if (site.form == FootprintForm::round) return sum.arc / (2 * root);
    const HalfSides half = half_sides(site);
    return (sum.along * half.along + sum.across * half.across) / (2 * root * root);
  };
  for (std::size_t r = 0; r < site.runs.size(); ++r) {
    const StoreyRun& run = site.runs[r];
    const double count = run.storeys;
    Sum outer = measure_offset(i, outer_offset(site, run));
    if (r == 0) std::copy(lengths_.begin(), lengths_.end(), walls.begin());
    for (std::size_t k = 0; k < lengths_.size(); ++k) responses_[k] += count * lengths_[k];
    double response = free_response(outer);
    if (std::isfinite(site.depth) && outer.area > 0) {
      const Sum court = measure_offset(i, courtyard_offset(site, run));
      outer.area -= court.area;
      response -= free_response(court);
      for (std::size_t k = 0; k < lengths_.size(); ++k) responses_[k] -= count * lengths_[k];
    }
    into.plates.push_back(outer.area);
    into.floor_area += count * outer.area;
    into.free_response += count * response;
  }
  into.footprint = into.plates.empty() ? 0 : into.plates.front();
  into.volume = into.floor_area * site.storey_height;
  into.own_response = into.free_response;
  for (std::size_t k = 0; k < neighbours_.size(); ++k) {
    if (responses_[k] == 0 && walls[k] == 0) continue;
    const double response = responses_[k] / (2 * neighbours_[k].distance);
    into.own_response += response;
    into.neighbours.push_back({neighbours_[k].site, walls[k], response});
  }
  std::sort(into.neighbours.begin(), into.neighbours.end(),
            [](const FootprintMeasure::Neighbour& a, const FootprintMeasure::Neighbour& b) { return a.site < b.site; });
  if (!(into.floor_area > 0)) into.state = SiteState::starved;
  return reach_of(site);
}

const std::vector<PlanPolygon>& FootprintMaker::parts(std::uint32_t i, const PlateOffset& offset) {
  parts_.clear();
  find_neighbours(i);
  const PlanPlot::Pieces* pieces = plot_.made(offset.plot);
  if (pieces == nullptr) return parts_;
  for (const PlanPlot::Piece& piece : *pieces) {
    if (!cut(piece, i, offset)) continue;
    for (PlanPolygon::Corner& c : polygon_.corners) {
      if (c.beyond >= 0) c.beyond = static_cast<std::int32_t>(neighbours_[static_cast<std::size_t>(c.beyond)].site);
      if (c.beyond == kAlong || c.beyond == kAcross) c.beyond = PlanSide::kForm;
    }
    parts_.push_back(polygon_);
  }
  return parts_;
}

}  // namespace bl::geometry
