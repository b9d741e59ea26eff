// Contacts first, then who carries whom, as far as that may be otherwise than before; at last the way down of each.
#include "core/geometry/inside/stance_finder.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <numeric>
#include <queue>
#include <utility>

#include "core/base/differences.h"
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

// In place of a round: those that stand before the first one, and those that never stand.
constexpr std::int32_t kStandsAtOnce = -1, kStandsNever = 0x7fffffff;

// Rounds and sites, the first ones first.
using Coming = std::pair<std::int32_t, std::uint32_t>;
using Queue = std::priority_queue<Coming, std::vector<Coming>, std::greater<>>;

// Where even balls that meet head on would be this much farther apart than the way down that is known, rounding cannot tell
// otherwise [m].
constexpr double kSurelyFarther = 1e-6;

// Beyond this share of changed balls all that look around are measured again.
constexpr double kManyBalls = 0.25;

// Marks of a site: its cell was made, its neighbours were judged anew, its stance has to be measured.
constexpr std::uint8_t kCellMade = 1, kJudged = 2, kToMeasure = 4;

// Comparing numbers is not enough: zeros of both signs are equal, and what is kept must be what would be found anew.
bool same_bits(const Point3& a, const Point3& b) {
  using Bits = std::array<std::uint64_t, 3>;
  return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b);
}
bool same_bits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

double ball_of(const PowerSite& site) { return std::sqrt(std::max(0.0, site.weight)); }

}  // namespace

void StanceFinder::update(const Domain& domain, std::span<const PowerSite> sites, std::span<const CellMeasure> cells,
                          std::span<const Standing> rules, std::span<const std::uint32_t> made) {
  differing_.clear();
  measured_ = 0;
  is_domain_new_ = false;
  loose_.clear();
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
  for (const std::uint32_t i : changed_) marks_[i] |= kToMeasure;
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
  namers_.assign(count, {});
  holders_.assign(count, Stance::kNothing);
  rounds_.assign(count, kStandsNever);
  stances_.assign(count, {});
  buckets_.reset();
  looking_around_ = 0;
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
  visit_differences(std::span<const PowerSite>(sites_), sites, [&](std::uint32_t i) { changed_.push_back(i); });
}

void StanceFinder::take_rules(std::span<const Standing> rules) {
  for (std::size_t i = 0; i < rules.size(); ++i) {
    if (rules_[i] == rules[i]) continue;
    loose_.push_back(static_cast<std::uint32_t>(i));
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

// Those that the ball has stopped or may stop on their way down. Who has moved itself is marked for that.
void StanceFinder::mark_near(const Point3& centre, double radius) {
  buckets_->near(centre, radius, share_aside(), [&](std::size_t i) {
    if (bodies_[i].looks_around && !is_beyond_stop(centre, radius, i, stances_[i].drop)) marks_[i] |= kToMeasure;
  });
}

// Is a ball not below another one, or so far below that it cannot stop it within `drop`?
bool StanceFinder::is_beyond_stop(const Point3& lower, double radius, std::size_t upper, double drop) const {
  const double up = sites_[upper].position.z - lower.z;
  return !(up > 0) || up - radius - radius_of(upper) > drop + kSurelyFarther;
}

void StanceFinder::take_sites(std::span<const PowerSite> sites) {
  for (std::size_t i = 0; is_domain_new_ && i < sites.size(); ++i) bodies_[i].ground = ground_under(domain_, sites[i].position);
  for (const std::uint32_t i : changed_) {
    if (!is_domain_new_ && !same_bits(sites[i].position, sites_[i].position))
      bodies_[i].ground = ground_under(domain_, sites[i].position);
    sites_[i] = sites[i];
  }
}

// Of those whose cells stay, the ones that have moved, and those who have one that has moved among their neighbours.
void StanceFinder::take_cells(std::span<const CellMeasure> cells) {
  for (const std::uint32_t i : made_) {
    take_neighbours(i, cells[i]);
    find_ground(i);
  }
  const auto judge = [&](std::uint32_t i) {
    if (marks_[i] & (kCellMade | kJudged)) return;
    marks_[i] |= kJudged | kToMeasure;
    judge_neighbours(i);
    find_ground(i);
  };
  for (const std::uint32_t i : changed_) {
    judge(i);
    for (const std::uint32_t namer : namers_[i]) judge(namer);
  }
}

void StanceFinder::find_ground(std::uint32_t i) {
  Body& body = bodies_[i];
  const bool is_on_ground = body.is_there() && (body.touches_underside || body.bottom <= body.ground + kGroundReach);
  if (is_on_ground != body.is_on_ground) loose_.push_back(i);
  body.is_on_ground = is_on_ground;
}

void StanceFinder::take_neighbours(std::uint32_t i, const CellMeasure& cell) {
  Body& body = bodies_[i];
  if (body.is_there() != (cell.volume > 0)) loose_.push_back(i);
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
  loose_.push_back(i);
  name_neighbours(i);
  body.neighbours.assign(found_.begin(), found_.end());
}

// Tells the sites of the facets who names them: those that site `i` had so far, and those that it has now. Both ascend.
void StanceFinder::name_neighbours(std::uint32_t i) {
  const std::vector<Neighbour>& before = bodies_[i].neighbours;
  const auto is_before = [](const Neighbour& a, const Neighbour& b) { return a.site < b.site; };
  for (const Neighbour& neighbour : before)
    if (!std::binary_search(found_.begin(), found_.end(), neighbour, is_before)) std::erase(namers_[neighbour.site], i);
  for (const Neighbour& neighbour : found_)
    if (!std::binary_search(before.begin(), before.end(), neighbour, is_before)) namers_[neighbour.site].push_back(i);
}

void StanceFinder::judge_neighbours(std::uint32_t i) {
  for (Neighbour& neighbour : bodies_[i].neighbours) {
    const bool below = is_below(neighbour.site, i);
    if (below != neighbour.is_below) loose_.push_back(i);
    neighbour.is_below = below;
  }
}

// Who stands is found in rounds, each in the order of the sites: who comes to stand carries those above from then on. A site that
// follows comes to stand in the same round, one that comes before it in the next one. This says when each of them does; there is
// one answer only, from which those that may be carried otherwise are put right, and whoever depends on them.
void StanceFinder::find_carried() {
  std::sort(loose_.begin(), loose_.end());
  loose_.erase(std::unique(loose_.begin(), loose_.end()), loose_.end());
  std::vector<std::uint32_t> changed = let_go();
  raise(changed);
  const auto hold = [&](std::uint32_t i) {
    const std::int32_t holder = holder_of(i);
    if (holder == holders_[i]) return;
    holders_[i] = holder;
    marks_[i] |= kToMeasure;
  };
  for (const std::uint32_t i : loose_) hold(i);
  for (const std::uint32_t i : changed) {
    hold(i);
    for (const std::uint32_t namer : namers_[i]) hold(namer);
  }
}

// Takes those down that have lost what they came to stand by, in the order in which they came to stand; who they are.
std::vector<std::uint32_t> StanceFinder::let_go() {
  std::vector<std::uint32_t> fallen;
  Queue queue;
  for (const std::uint32_t i : loose_)
    if (rounds_[i] != kStandsNever) queue.push({rounds_[i], i});
  while (!queue.empty()) {
    const auto [round, i] = queue.top();
    queue.pop();
    if (rounds_[i] == kStandsNever || round_of(i) <= round) continue;
    rounds_[i] = kStandsNever;
    fallen.push_back(i);
    for (const std::uint32_t namer : namers_[i])
      if (rounds_[namer] != kStandsNever && rounds_[namer] >= 0) queue.push({rounds_[namer], namer});
  }
  return fallen;
}

// Lets those stand that can, or sooner than they did, the first ones first; adds them to those that have changed.
void StanceFinder::raise(std::vector<std::uint32_t>& changed) {
  Queue queue;
  const auto look_at = [&](std::uint32_t i) {
    if (const std::int32_t round = round_of(i); round < rounds_[i]) queue.push({round, i});
  };
  for (const auto* some : {&loose_, &changed})
    for (const std::uint32_t i : *some) look_at(i);
  while (!queue.empty()) {
    const auto [round, i] = queue.top();
    queue.pop();
    if (round >= rounds_[i]) continue;
    rounds_[i] = round;
    changed.push_back(i);
    for (const std::uint32_t namer : namers_[i]) look_at(namer);
  }
}

// In which round `lower` can carry `upper` for the first time.
std::int32_t StanceFinder::round_after(std::uint32_t lower, std::uint32_t upper) const {
  const std::int32_t round = rounds_[lower];
  return round == kStandsNever ? kStandsNever : round == kStandsAtOnce ? 0 : round + (lower > upper ? 1 : 0);
}

// In which round it comes to stand, as far as is known of the others.
std::int32_t StanceFinder::round_of(std::uint32_t i) const {
  if (!bodies_[i].is_there()) return kStandsNever;
  if (bodies_[i].is_on_ground) return kStandsAtOnce;
  std::int32_t below = kStandsNever, first = kStandsNever, second = kStandsNever;
  for (const Neighbour& neighbour : bodies_[i].neighbours) {
    if (neighbour.site == i) continue;
    const std::int32_t round = round_after(neighbour.site, i);
    if (neighbour.is_below) below = std::min(below, round);
    second = std::min(second, std::max(first, round));
    first = std::min(first, round);
  }
  return rules_[i] == Standing::bridge ? std::min(below, second) : below;
}

// The first one below that stands before it does.
std::int32_t StanceFinder::holder_of(std::uint32_t i) const {
  if (rounds_[i] == kStandsNever) return Stance::kNothing;
  if (rounds_[i] == kStandsAtOnce) return Stance::kGround;
  for (const Neighbour& neighbour : bodies_[i].neighbours)
    if (neighbour.is_below && round_after(neighbour.site, i) <= rounds_[i]) return static_cast<std::int32_t>(neighbour.site);
  return kHeldBetween;
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
    if (j != i && !is_beyond_stop(sites_[j].position, radius_of(j), i, stance.drop))
      stance.drop = std::min(stance.drop, gap_above(j, i, stance.drop));
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
