// Finds which volumes carry others: contacts first, then repeatedly from all standing volumes until no further one is found.
#include "core/geometry/standing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "core/geometry/inside/plan_buckets.h"
#include "core/geometry/touching_balls.h"

namespace bl::geometry {

namespace {

// The way down of a body that hangs although its ball has sunk into something, because others cut it off from below: a share of
// what is missing, and no more than a share of the radius that it would have alone. Such bodies change their shape with every
// move, so that more would overshoot.
constexpr double kCreepOfHang = 0.25, kCreepOfRadius = 0.1;

// What stands on another volume stays there until the way between them is this flat: with one limit for coming and staying, who
// comes to rest at it would be carried in one tick and not in the next.
constexpr double kSteepnessToStay = 0.9 * kLeastSteepness;

struct HeightSpan {
  double bottom, top;
};

// The stretch of a vertical line inside one piece; empty where bottom > top.
HeightSpan height_span_inside(const ConvexDomain& piece, const Point3& point) {
  HeightSpan heights{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  for (const Plane& plane : piece.planes) {
    const double room = plane.offset - plane.normal.x * point.x - plane.normal.y * point.y;
    if (std::abs(plane.normal.z) < 1e-12) {
      if (room < -1e-9) return {1, 0};
    } else if (plane.normal.z > 0) {
      heights.top = std::min(heights.top, room / plane.normal.z);
    } else {
      heights.bottom = std::max(heights.bottom, room / plane.normal.z);
    }
  }
  return heights;
}

class StanceFinder {
 public:
  StanceFinder(const Domain& domain, std::span<const PowerSite> sites, std::span<const CellMeasure> cells,
               std::span<const Standing> rules)
      : domain_(domain), sites_(sites), cells_(cells), rules_(rules), stances_(sites.size()), is_carried_(sites.size(), false) {}

  std::vector<Stance> run() {
    find_undersides();
    for (std::size_t i = 0; i < sites_.size(); ++i)
      if (is_on_ground(i)) {
        stances_[i].stands_on = Stance::kGround;
        is_carried_[i] = true;
      }
    find_carried();
    for (std::size_t i = 0; i < sites_.size(); ++i)
      if (cells_[i].volume > 0) measure(i);
    return std::move(stances_);
  }

 private:
  void find_undersides() {
    is_underside_.assign(domain_.side_count, false);
    for (const Domain::Piece& piece : domain_.pieces)
      for (std::size_t k = 0; k < piece.sides.size(); ++k)
        if (piece.sides[k] != Domain::kInner && piece.shape.planes[k].normal.z < -kLeastSteepness)
          is_underside_[piece.sides[k]] = true;
  }

  bool is_on_ground(std::size_t i) const {
    const CellMeasure& cell = cells_[i];
    if (!(cell.volume > 0)) return false;
    for (const FacetArea& facet : cell.facets)
      if (facet.kind == FaceKind::plane && facet.index < is_underside_.size() && is_underside_[facet.index]) return true;
    return cell.bottom <= ground_under(domain_, sites_[i].position) + kGroundReach;
  }

  bool is_below(std::size_t lower, std::size_t upper) const {
    const Vector3 up = sites_[upper].position - sites_[lower].position;
    return up.z > 0 && up.z >= kSteepnessToStay * norm(up);
  }

  // In rounds in the order of the sites, in which only those are looked at who have a neighbour that has come to stand since.
  void find_carried() {
    std::set<std::size_t> round, next;
    for (std::size_t i = 0; i < sites_.size(); ++i) round.insert(round.end(), i);
    for (; !round.empty(); round.swap(next))
      while (!round.empty()) {
        const std::size_t i = *round.begin();
        round.erase(round.begin());
        if (is_carried_[i] || !(cells_[i].volume > 0) || !carries(i)) continue;
        is_carried_[i] = true;
        for (const FacetArea& facet : cells_[i].facets)
          if (facet.kind == FaceKind::site && !is_carried_[facet.index]) (facet.index > i ? round : next).insert(facet.index);
      }
  }

  // Do those who stand carry it, as far as is known?
  bool carries(std::size_t i) {
    int holders = 0;
    for (const FacetArea& facet : cells_[i].facets) {
      if (facet.kind != FaceKind::site || !is_carried_[facet.index]) continue;
      ++holders;
      if (stances_[i].stands_on == Stance::kNothing && is_below(facet.index, i))
        stances_[i].stands_on = static_cast<std::int32_t>(facet.index);
    }
    return stances_[i].stands_on != Stance::kNothing || (rules_[i] == Standing::bridge && holders >= 2);
  }

  double radius_of(std::size_t i) const { return std::sqrt(std::max(0.0, sites_[i].weight)); }

  // Made when the first body is found to hang.
  const PlanBuckets& buckets() {
    if (!buckets_) {
      std::vector<Point3> centres;
      std::vector<double> radii;
      for (std::size_t i = 0; i < sites_.size(); ++i) {
        centres.push_back(sites_[i].position);
        radii.push_back(cells_[i].volume > 0 ? radius_of(i) : 0);
      }
      buckets_.emplace(centres, radii);
    }
    return *buckets_;
  }

  void measure(std::size_t i) {
    Stance& stance = stances_[i];
    const double ground = ground_under(domain_, sites_[i].position), radius = radius_of(i);
    const bool is_content = rules_[i] == Standing::ground ? stance.stands_on == Stance::kGround : is_carried_[i];
    if (!is_content) stance.hang = std::max(0.0, cells_[i].bottom - ground);
    stance.drop = sites_[i].position.z - radius - ground;
    const double creep = std::min(kCreepOfHang * stance.hang, kCreepOfRadius * ball_radius(cells_[i].volume));
    if (rules_[i] == Standing::ground) {
      if (!is_content) stance.drop = std::max(stance.drop, creep);
    } else if (is_content) {
      if (stance.stands_on == Stance::kNothing) stance.drop = std::min(stance.drop, -radius);
      for (const FacetArea& facet : cells_[i].facets)
        if (facet.kind == FaceKind::site) stance.drop = std::min(stance.drop, gap_above(facet.index, i, stance.drop));
    } else {
      // A hair wider than gap_above() looks, for rounding.
      const double aside = std::sqrt(1 - kLeastSteepness * kLeastSteepness) * (1 + 1e-9);
      buckets().near(sites_[i].position, radius, aside, [&](std::size_t j) {
        if (j != i) stance.drop = std::min(stance.drop, gap_above(j, i, stance.drop));
      });
      stance.drop = std::max(stance.drop, creep);
    }
  }

  // How far `upper` can go down until the two balls touch; `otherwise` where they do not meet, or not from above.
  double gap_above(std::size_t lower, std::size_t upper, double otherwise) const {
    const Vector3 up = sites_[upper].position - sites_[lower].position;
    if (!(up.z > 0)) return otherwise;
    const double radii = radius_of(upper) + radius_of(lower);
    const double steep_reach = radii * radii * (1 - kLeastSteepness * kLeastSteepness), aside = up.x * up.x + up.y * up.y;
    if (!(aside <= steep_reach)) return otherwise;
    const double gap = up.z - std::sqrt(radii * radii - aside);
    // Balls that overlap carry each other where they share a facet that is level enough; without one a third ball is between
    // them.
    return gap > 0 || (share_facet(lower, upper) && is_below(lower, upper)) ? gap : otherwise;
  }

  bool share_facet(std::size_t a, std::size_t b) const {
    return std::any_of(cells_[b].facets.begin(), cells_[b].facets.end(),
                       [&](const FacetArea& f) { return f.kind == FaceKind::site && f.index == a; });
  }

  const Domain& domain_;
  std::span<const PowerSite> sites_;
  std::span<const CellMeasure> cells_;
  std::span<const Standing> rules_;
  std::vector<bool> is_underside_;  // per side of the domain
  std::vector<Stance> stances_;
  std::vector<bool> is_carried_;
  std::optional<PlanBuckets> buckets_;
};

}  // namespace

double ground_under(const Domain& domain, const Point3& point) {
  constexpr double kSame = 1e-6;  // [m] between pieces that touch
  std::vector<HeightSpan> spans;
  for (const Domain::Piece& piece : domain.pieces)
    if (const HeightSpan heights = height_span_inside(piece.shape, point); heights.bottom <= heights.top)
      spans.push_back(heights);
  if (spans.empty()) return domain.minimum.z;
  std::sort(spans.begin(), spans.end(), [](const HeightSpan& a, const HeightSpan& b) { return a.bottom < b.bottom; });
  double best = spans.front().bottom, nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < spans.size();) {
    HeightSpan whole = spans[k];
    for (++k; k < spans.size() && spans[k].bottom <= whole.top + kSame; ++k) whole.top = std::max(whole.top, spans[k].top);
    const double away = std::max({0.0, whole.bottom - point.z, point.z - whole.top});
    if (away >= nearest) continue;
    nearest = away;
    best = whole.bottom;
  }
  return best;
}

std::vector<Stance> stances_of(const Domain& domain, std::span<const PowerSite> sites, std::span<const CellMeasure> cells,
                               std::span<const Standing> rules) {
  return StanceFinder(domain, sites, cells, rules).run();
}

}  // namespace bl::geometry
