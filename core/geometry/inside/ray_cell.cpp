// A cell along rays, by the planes around its site alone: no vertices, no edges, and hence no more than a few decimals.
#include "core/geometry/inside/ray_cell.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/geometry/inside/none.h"

namespace bl::geometry {

namespace {

// A cell is looked at from a point that has this share of the demanded ball's radius around it, where it has one: at the site
// itself, or not far from it.
constexpr double kRoomToLook = 0.3;
constexpr int kMostMoves = 30;
// A cell that has no room for a ball of this share of that radius gets it: Newton has nothing to go by in an empty cell.
constexpr double kLeastRoom = 0.15;
// It need not become larger for that than this share of its demand; found by so many halvings.
constexpr double kEnoughShare = 0.5;
constexpr int kHalvings = 8;
// A plane nearer than this share of that radius counts as that near: the sums divide by it.
constexpr double kLeastDistance = 1e-3;

const Rays& rays() {
  static const Rays made;
  return made;
}

}  // namespace

bool RayCell::has_room(std::uint32_t place, Near near) const {
  const PowerSite& own = scene_.sites[place];
  const double room = kRoomToLook * scene_.ball[place], four_squares = 4 * room * room;
  if (own.weight < room * room) return false;
  for (const Plane& plane : scene_.domain.planes) {
    if (plane.offset - dot(plane.normal, own.position) < room) return false;
  }
  for (const std::uint32_t k : near) {
    const PowerSite& other = scene_.sites[k];
    const double squared = squared_norm(other.position - own.position), sum = squared + (own.weight - other.weight);
    if (sum < 0 || sum * sum < four_squares * squared) return false;
  }
  return true;
}

double RayCell::look(std::uint32_t place, Near near) {
  place_ = place;
  ball_ = scene_.ball[place];
  weight_ = scene_.sites[place].weight;
  gather(near, std::sqrt(weight_));
  eye_ = {};
  if (least_ < kRoomToLook * ball_) {
    choose_eye();
    make_room(near);
  }
  return weight_;
}

// Who cuts a ball of this radius, which is that of the cell or more. All are written, and those that do not are written over:
// no processor likes to bet on who does.
void RayCell::gather(Near near, double radius) {
  const auto& planes = scene_.domain.planes;
  if (kept_.size() < planes.size() + near.size()) kept_.resize(planes.size() + near.size());
  const PowerSite& own = scene_.sites[place_];
  std::size_t count = 0;
  least_ = radius;
  for (const Plane& plane : planes) {
    const double offset = plane.offset - dot(plane.normal, own.position);
    kept_[count] = {plane.normal, offset, 0, kNone, offset};
    count += offset < radius ? 1 : 0;
    least_ = std::min(least_, offset);
  }
  for (const std::uint32_t k : near) {
    const PowerSite& other = scene_.sites[k];
    const Vector3 to = other.position - own.position;
    const double squared = squared_norm(to), inverse = 1 / std::sqrt(squared),
                 offset = 0.5 * (squared + (own.weight - other.weight)) * inverse;
    kept_[count] = {inverse * to, offset, 2 * squared * inverse, k, offset};
    count += offset < radius ? 1 : 0;
    least_ = std::min(least_, offset);
  }
  cuts_ = std::span(kept_).first(count);
}

// A point with some room around it inside all planes and the ball: the site's own place, or one that the planes push it to in
// turns. Sides of the domain have the last word, since weights cannot move them.
void RayCell::choose_eye() {
  const double room = kRoomToLook * ball_, radius = std::sqrt(weight_);
  eye_ = {};
  bool has_moved = least_ < room;
  for (int move = 0; move < kMostMoves && has_moved; ++move) {
    has_moved = false;
    for (std::size_t k = cuts_.size(); k-- > 0;) {
      const double lack = room - (cuts_[k].offset - dot(cuts_[k].normal, eye_));
      if (!(lack > 0)) continue;
      // A little more than it takes, or it would never end.
      eye_ += (-1.05 * lack) * cuts_[k].normal;
      has_moved = true;
    }
    const double far = norm(eye_);
    if (far > 0 && far > radius - room) eye_ *= std::max(0.0, radius - room) / far;
  }
  for (std::size_t k = 0; k < cuts_.size() && has_moved; ++k) {
    const double lack = room - (cuts_[k].offset - dot(cuts_[k].normal, eye_));
    if (cuts_[k].bond == 0 && lack > 0) eye_ += -lack * cuts_[k].normal;
  }
}

void RayCell::look_from_eye() {
  for (Cut& cut : cuts_) cut.distance = cut.offset - dot(cut.normal, eye_);
}

// Raises the weight of a cell without room until there is some, and moves the eye there. How much that takes depends on where
// one looks from, so it may be far too much: of that as little as leaves the cell near its demand.
void RayCell::make_room(Near near) {
  look_from_eye();
  const double room = kLeastRoom * ball_, far = norm(eye_) + room, before = weight_;
  double high = std::max(0.0, far * far - before);
  for (const Cut& cut : cuts_) high = std::max(high, cut.bond * (room - cut.distance));
  if (high > 0) {
    // A wider ball is cut by more.
    gather(near, std::sqrt(before + high));
    double low = 0;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = 0.5 * (low + high);
      raise(before + middle);
      (is_worth_looking() ? high : low) = middle;
    }
    raise(before + high);
    choose_eye();
    look_from_eye();
  }
  for (Cut& cut : cuts_) cut.distance = std::max(cut.distance, kLeastDistance * ball_);
}

void RayCell::raise(double weight) {
  for (Cut& cut : cuts_) cut.offset += cut.bond > 0 ? (weight - weight_) / cut.bond : 0;
  weight_ = weight;
  least_ = 0;
}

bool RayCell::is_worth_looking() {
  choose_eye();
  look_from_eye();
  const auto is_away = [&](const Cut& cut) { return cut.distance > kLeastDistance * ball_; };
  if (!std::all_of(cuts_.begin(), cuts_.end(), is_away) || squared_norm(eye_) >= weight_) return false;
  Hits hits;
  cast(hits);
  const auto sum = static_cast<double>(hits.parts(rays(), static_cast<std::int32_t>(cuts_.size())).volume);
  return 4 * std::numbers::pi / 3 * sum * ball_ * ball_ * ball_ > kEnoughShare * scene_.demand[place_];
}

void RayCell::cast(Hits& hits) const {
  const auto ball = static_cast<std::int32_t>(cuts_.size());
  hits.begin_at_ball(rays(), (1 / ball_) * eye_, weight_ / (ball_ * ball_), ball);
  for (std::int32_t k = 0; k < ball; ++k) {
    const Cut& cut = cuts_[static_cast<std::size_t>(k)];
    hits.cut(rays(), (ball_ / cut.distance) * cut.normal, k);
  }
}

// With t the length of a ray and s its share of the sphere, the volume is the sum of (4π/3) s t³, and a facet's area over its
// plane's distance from the eye that of 4π s t³ over the rays that end in it.
RayCell::Measure RayCell::measure(RayResponse& others) {
  Hits hits;
  cast(hits);
  area_.assign(cuts_.size() + Hits::kFreeNames, 0);
  const Hits::Parts parts = hits.parts(rays(), static_cast<std::int32_t>(cuts_.size()));
  for (std::size_t d = 0; d < Rays::kCount; ++d) {
    area_[hits.cut_ahead[d]] += parts.response_ahead[d];
    area_[hits.cut_back[d]] += parts.response_back[d];
  }
  constexpr double kFullAngle = 4 * std::numbers::pi;
  const double cube = kFullAngle * ball_ * ball_ * ball_;
  Measure made{cube / 3 * static_cast<double>(parts.volume), cube / (ball_ * ball_) * static_cast<double>(parts.free_response)};
  for (std::size_t k = 0; k < cuts_.size(); ++k) {
    const Cut& cut = cuts_[k];
    if (!(area_[k] > 0) || cut.bond == 0) continue;
    const double value = cube * static_cast<double>(area_[k]) / (cut.distance * cut.bond);
    made.response += value;
    others.column.push_back(cut.place);
    others.value.push_back(value);
  }
  return made;
}

}  // namespace bl::geometry
