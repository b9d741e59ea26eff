// Contacts first, then who carries whom, from all that stand until no further one is found; at last the way down of each.
#include "core/geometry/inside/stance_finder.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>

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

// A hair wider than gap_above() looks, for rounding.
double share_aside() { return std::sqrt(1 - kLeastSteepness * kLeastSteepness) * (1 + 1e-9); }

// In place of a holder: two or more hold a bridge, and none of them is below it.
constexpr std::int32_t kHeldBetween = -3;

// Beyond this share of changed balls all that look around are measured again.
constexpr double kManyBalls = 0.25;

// Marks of a site: its cell was made, its position or weight is another one, its stance has to be measured.
constexpr std::uint8_t kCellMade = 1, kSiteChanged = 2, kToMeasure = 4;

// Comparing numbers is not enough: zeros of both signs are equal, and what is kept must be what would be found anew.
bool same_bits(const Point3& a, const Point3& b) {
  using Bits = std::array<std::uint64_t, 3>;
  return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b);
}
bool same_bits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

double ball_of(const PowerSite& site) { return std::sqrt(std::max(0.0, site.weight)); }

void put(std::vector<std::uint64_t>& bits, std::uint32_t i) { bits[i / 64] |= std::uint64_t{1} << (i % 64); }

}  // namespace

void StanceFinder::update(const Domain& domain, std::span<const PowerSite> sites, std::span<const CellMeasure> cells,
                          std::span<const Standing> rules, std::span<const std::uint32_t> made) {
  differing_.clear();
  measured_ = 0;
  may_carry_otherwise_ = is_domain_new_ = false;
  const bool is_start = sites.size() != bodies_.size();
  if (is_start) {
    start(sites.size());
  } else {
    made_.assign(made.begin(), made.end());
  }
  if (is_start || (made_.size() == sites.size() && !(domain == domain_))) take_domain(domain);
  find_changed(sites);
  if (made_.empty() && changed_.empty() && std::equal(rules.begin(), rules.end(), rules_.begin(), rules_.end())) return;
  marks_.assign(sites.size(), 0);
  for (const std::uint32_t i : made_) marks_[i] |= kCellMade | kToMeasure;
  for (const std::uint32_t i : changed_) marks_[i] |= kSiteChanged | kToMeasure;
  take_rules(rules);
  mark_who_look_around(sites, cells);
  take_sites(sites);
  take_cells(cells);
  find_carried();
  measure_marked();
  if (!is_start) return;
  differing_.resize(sites.size());
  std::iota(differing_.begin(), differing_.end(), 0u);
}

void StanceFinder::start(std::size_t count) {
  sites_.assign(count, {});
  rules_.assign(count, Standing::stack);
  bodies_.assign(count, {});
  holders_.assign(count, Stance::kNothing);
  stances_.assign(count, {});
  buckets_.reset();
  looking_around_ = 0;
  may_carry_otherwise_ = true;
  made_.resize(count);
  std::iota(made_.begin(), made_.end(), 0u);
}

void StanceFinder::take_domain(const Domain& domain) {
  domain_ = domain;
  is_domain_new_ = true;
  is_underside_.assign(domain_.side_count, false);
  for (const Domain::Piece& piece : domain_.pieces)
    for (std::size_t k = 0; k < piece.sides.size(); ++k)
      if (piece.sides[k] != Domain::kInner && piece.shape.planes[k].normal.z < -kLeastSteepness)
        is_underside_[piece.sides[k]] = true;
}

void StanceFinder::find_changed(std::span<const PowerSite> sites) {
  changed_.clear();
  for (std::uint32_t i = 0; i < sites.size(); ++i)
    if (!same_bits(sites[i].position, sites_[i].position) || !same_bits(sites[i].weight, sites_[i].weight)) changed_.push_back(i);
}

void StanceFinder::take_rules(std::span<const Standing> rules) {
  for (std::size_t i = 0; i < rules.size(); ++i) {
    if (rules_[i] == rules[i]) continue;
    may_carry_otherwise_ = true;
    marks_[i] |= kToMeasure;
    rules_[i] = rules[i];
  }
}

// Those in whose reach a ball has been or is now. Comes before sites and cells are taken, so that both are known.
void StanceFinder::mark_who_look_around(std::span<const PowerSite> sites, std::span<const CellMeasure> cells) {
  if (looking_around_ == 0 ||
      static_cast<double>(made_.size() + changed_.size()) > kManyBalls * static_cast<double>(sites.size())) {
    buckets_.reset();
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      if (bodies_[i].looks_around) marks_[i] |= kToMeasure;
    return;
  }
  const auto follow = [&](std::uint32_t i) {
    const double before = bodies_[i].is_there() ? radius_of(i) : 0, after = cells[i].volume > 0 ? ball_of(sites[i]) : 0;
    if (same_bits(sites_[i].position, sites[i].position) && same_bits(before, after)) return;
    if (before > 0) mark_near(sites_[i].position, before);
    buckets_->change(i, sites[i].position, after);
    if (after > 0) mark_near(sites[i].position, after);
  };
  for (const std::uint32_t i : made_) follow(i);
  for (const std::uint32_t i : changed_)
    if (!(marks_[i] & kCellMade)) follow(i);
}

void StanceFinder::mark_near(const Point3& centre, double radius) {
  buckets_->near(centre, radius, share_aside(), [&](std::size_t i) {
    if (bodies_[i].looks_around) marks_[i] |= kToMeasure;
  });
}

void StanceFinder::take_sites(std::span<const PowerSite> sites) {
  for (std::size_t i = 0; is_domain_new_ && i < sites.size(); ++i) bodies_[i].ground = ground_under(domain_, sites[i].position);
  for (const std::uint32_t i : changed_) {
    if (!is_domain_new_ && !same_bits(sites[i].position, sites_[i].position))
      bodies_[i].ground = ground_under(domain_, sites[i].position);
    sites_[i] = sites[i];
  }
}

void StanceFinder::take_cells(std::span<const CellMeasure> cells) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (marks_[i] & kCellMade) {
      take_neighbours(i, cells[i]);
    } else if ((marks_[i] & kSiteChanged) || has_changed_neighbour(i)) {
      marks_[i] |= kToMeasure;
      judge_neighbours(i);
    } else {
      continue;
    }
    Body& body = bodies_[i];
    const bool is_on_ground = body.is_there() && (body.touches_underside || body.bottom <= body.ground + kGroundReach);
    may_carry_otherwise_ = may_carry_otherwise_ || is_on_ground != body.is_on_ground;
    body.is_on_ground = is_on_ground;
  }
}

void StanceFinder::take_neighbours(std::size_t i, const CellMeasure& cell) {
  Body& body = bodies_[i];
  may_carry_otherwise_ = may_carry_otherwise_ || body.is_there() != (cell.volume > 0);
  body.volume = cell.volume;
  body.bottom = cell.bottom;
  body.touches_underside = false;
  found_.clear();
  for (const FacetArea& facet : cell.facets) {
    if (facet.kind == FaceKind::plane && facet.index < is_underside_.size() && is_underside_[facet.index])
      body.touches_underside = true;
    if (facet.kind == FaceKind::site) found_.push_back({facet.index, is_below(facet.index, i)});
  }
  if (found_ == body.neighbours) return;
  may_carry_otherwise_ = true;
  body.neighbours.assign(found_.begin(), found_.end());
}

bool StanceFinder::has_changed_neighbour(std::size_t i) const {
  return !changed_.empty() && std::any_of(bodies_[i].neighbours.begin(), bodies_[i].neighbours.end(),
                                          [&](const Neighbour& n) { return (marks_[n.site] & kSiteChanged) != 0; });
}

void StanceFinder::judge_neighbours(std::size_t i) {
  for (Neighbour& neighbour : bodies_[i].neighbours) {
    const bool below = is_below(neighbour.site, i);
    may_carry_otherwise_ = may_carry_otherwise_ || below != neighbour.is_below;
    neighbour.is_below = below;
  }
}

// In rounds in the order of the sites, in which only those are looked at who have a neighbour that has come to stand since. Who
// comes to stand first is the holder of those above, so that the rounds run from the beginning.
void StanceFinder::find_carried() {
  if (!may_carry_otherwise_) return;
  holders_before_.swap(holders_);
  holders_.resize(bodies_.size());
  const std::size_t words = (bodies_.size() + 63) / 64;
  round_.assign(words, 0);
  next_.assign(words, 0);
  for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
    holders_[i] = bodies_[i].is_on_ground ? Stance::kGround : Stance::kNothing;
    if (bodies_[i].is_there() && !bodies_[i].is_on_ground) put(round_, i);
  }
  for (bool has_next = true; has_next; round_.swap(next_)) {
    has_next = false;
    for (std::size_t word = 0; word < words; ++word)
      while (round_[word] != 0) {
        const auto i = static_cast<std::uint32_t>(word * 64 + static_cast<std::size_t>(std::countr_zero(round_[word])));
        round_[word] &= round_[word] - 1;
        if (holders_[i] != Stance::kNothing || !finds_holders(i)) continue;
        for (const Neighbour& n : bodies_[i].neighbours) {
          if (holders_[n.site] != Stance::kNothing || !bodies_[n.site].is_there()) continue;
          has_next = has_next || n.site < i;
          put(n.site > i ? round_ : next_, n.site);
        }
      }
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (holders_[i] != holders_before_[i]) marks_[i] |= kToMeasure;
}

// Do those who stand carry it, as far as is known?
bool StanceFinder::finds_holders(std::uint32_t i) {
  int around = 0;
  for (const Neighbour& neighbour : bodies_[i].neighbours) {
    if (holders_[neighbour.site] == Stance::kNothing) continue;
    ++around;
    if (!neighbour.is_below) continue;
    holders_[i] = static_cast<std::int32_t>(neighbour.site);
    return true;
  }
  if (rules_[i] != Standing::bridge || around < 2) return false;
  holders_[i] = kHeldBetween;
  return true;
}

void StanceFinder::measure_marked() {
  for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
    if (!(marks_[i] & kToMeasure)) continue;
    looking_around_ -= bodies_[i].looks_around ? 1 : 0;
    bodies_[i].looks_around = false;
    const Stance stance = bodies_[i].is_there() ? measure(i) : Stance{};
    looking_around_ += bodies_[i].looks_around ? 1 : 0;
    ++measured_;
    if (!(stance == stances_[i])) differing_.push_back(i);
    stances_[i] = stance;
  }
}

Stance StanceFinder::measure(std::size_t i) {
  Stance stance;
  stance.stands_on = holders_[i] == kHeldBetween ? Stance::kNothing : holders_[i];
  const Body& body = bodies_[i];
  const double radius = radius_of(i);
  const bool is_content = rules_[i] == Standing::ground ? stance.stands_on == Stance::kGround : holders_[i] != Stance::kNothing;
  if (!is_content) stance.hang = std::max(0.0, body.bottom - body.ground);
  stance.drop = sites_[i].position.z - radius - body.ground;
  if (!is_content && rules_[i] != Standing::ground) look_around(i, stance);
  if (is_content && rules_[i] != Standing::ground) {
    if (stance.stands_on == Stance::kNothing) stance.drop = std::min(stance.drop, -radius);
    for (const Neighbour& neighbour : body.neighbours)
      stance.drop = std::min(stance.drop, gap_above(neighbour.site, i, stance.drop));
  }
  const double creep = std::min(kCreepOfHang * stance.hang, kCreepOfRadius * ball_radius(body.volume));
  if (!is_content) stance.drop = std::max(stance.drop, creep);
  return stance;
}

void StanceFinder::look_around(std::size_t i, Stance& stance) {
  bodies_[i].looks_around = true;
  buckets().near(sites_[i].position, radius_of(i), share_aside(), [&](std::size_t j) {
    if (j != i) stance.drop = std::min(stance.drop, gap_above(j, i, stance.drop));
  });
}

// How far `upper` can go down until the two balls touch; `otherwise` where they do not meet, or not from above.
double StanceFinder::gap_above(std::size_t lower, std::size_t upper, double otherwise) const {
  const Vector3 up = sites_[upper].position - sites_[lower].position;
  if (!(up.z > 0)) return otherwise;
  const double radii = radius_of(upper) + radius_of(lower);
  const double steep_reach = radii * radii * (1 - kLeastSteepness * kLeastSteepness), aside = up.x * up.x + up.y * up.y;
  if (!(aside <= steep_reach)) return otherwise;
  const double gap = up.z - std::sqrt(radii * radii - aside);
  // Balls that overlap carry each other where they share a facet that is level enough; without one a third ball is between
  // them.
  return gap > 0 || is_carried_by(lower, upper) ? gap : otherwise;
}

bool StanceFinder::is_carried_by(std::size_t lower, std::size_t upper) const {
  const std::vector<Neighbour>& neighbours = bodies_[upper].neighbours;
  return std::any_of(neighbours.begin(), neighbours.end(), [&](const Neighbour& n) { return n.site == lower && n.is_below; });
}

bool StanceFinder::is_below(std::size_t lower, std::size_t upper) const {
  const Vector3 up = sites_[upper].position - sites_[lower].position;
  return up.z > 0 && up.z >= kSteepnessToStay * norm(up);
}

double StanceFinder::radius_of(std::size_t i) const { return ball_of(sites_[i]); }

const PlanBuckets& StanceFinder::buckets() {
  if (!buckets_) {
    std::vector<Point3> centres;
    std::vector<double> radii;
    for (std::size_t i = 0; i < sites_.size(); ++i) {
      centres.push_back(sites_[i].position);
      radii.push_back(bodies_[i].is_there() ? radius_of(i) : 0);
    }
    buckets_.emplace(domain_.minimum, domain_.maximum, centres, radii);
  }
  return *buckets_;
}

}  // namespace bl::geometry
