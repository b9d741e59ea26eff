// Shares the plates of a building out among its volumes, and cuts those that several have.
#include "core/geometry/shared_building.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>
#include <utility>

#include <clipper.hpp>

#include "core/base/mathematics.h"

namespace bl::geometry {

namespace {

// Less than this share of all floors at the edge of a plate is none.
constexpr double kNoPart = 1e-7;
constexpr double kCutGrid = 1e8;        // steps of the Clipper library's integers in a metre
constexpr double kCutTolerance = 1e-4;  // of chords in plates that are cut [m]
constexpr double kOnSide = 1e-5;        // how far from a side a point of it may lie [m]
constexpr int kHalvingsOfCut = 60;
constexpr std::size_t kNobody = static_cast<std::size_t>(-1);

// What one share has of one plate.
struct Portion {
  std::size_t share = 0;
  double area = 0;  // [m²]
};
struct SharedStorey {
  std::vector<Portion> portions;  // in order; their areas add up to that of the plate
  double height = 0;              // [m]
};

// The plates in ascending order, filled one after the other. All of `plates` is given away.
std::vector<SharedStorey> fill(std::span<const double> plates, std::span<const BuildingShare> shares) {
  double floors = 0, asked = 0;
  for (const double plate : plates) floors += plate;
  for (const BuildingShare& share : shares) asked += share.area;
  std::vector<SharedStorey> storeys(plates.size());
  if (!(asked > 0)) return storeys;
  std::vector<double> left;
  std::size_t last = 0;
  for (std::size_t m = 0; m < shares.size(); ++m) {
    left.push_back(floors * shares[m].area / asked);
    if (left[m] > 0) last = m;
  }
  std::size_t m = 0;
  for (std::size_t k = 0; k < plates.size(); ++k) {
    double room = plates[k];
    while (m <= last) {
      if (!(left[m] > kNoPart * floors)) {
        ++m;
        continue;
      }
      // The rest of a plate that nobody would see goes to who has most of it, and the last one has all that is left.
      const bool takes_rest = m == last || left[m] >= room - kNoPart * floors;
      const double part = takes_rest ? room : left[m];
      if (part > 0) storeys[k].portions.push_back({m, part});
      left[m] -= part;
      room = takes_rest ? 0 : room - part;
      if (takes_rest) break;
      ++m;
    }
    if (room > 0 && storeys[k].portions.empty()) storeys[k].portions.push_back({last, room});
    else if (room > 0 && m > last) storeys[k].portions.back().area += room;
    for (const Portion& portion : storeys[k].portions)
      storeys[k].height = std::max(storeys[k].height, shares[portion.share].storey_height);
  }
  return storeys;
}

// A straight side of a plate with something beyond it.
struct KnownSide {
  Point3 from, to;
  std::int32_t beyond = PlateRing::kFree;
};

// A plate as polygons, in a frame whose x runs along the direction that is cut across.
class CutPlate {
 public:
  CutPlate(const PlateStack& stack, const Point3& centre, double angle) : centre_(centre) {
    faces_ = faces_of(stack, centre, kCutTolerance);
    for (const std::vector<PlateRing>* rings : {&stack.outlines, &stack.courtyards})
      for (const PlateRing& ring : *rings)
        for (std::size_t k = 0; k < ring.corners.size(); ++k)
          if (!ring.corners[k].is_arc && ring.corners[k].beyond != PlateRing::kFree)
            sides_.push_back({ring.corners[k].at, ring.corners[(k + 1) % ring.corners.size()].at, ring.corners[k].beyond});
    along_ = {mathematics::cosine(angle), mathematics::sine(angle), 0};
    const auto [low, high] = extent();
    along_ = {-along_.y, along_.x, 0};
    const auto [other_low, other_high] = extent();
    if (high - low >= other_high - other_low) along_ = {along_.y, -along_.x, 0};
    std::tie(low_, high_) = extent();
    area_ = area_below(high_);
  }

  // The place along the direction below which this share of the plate lies.
  double place_of(double share) const {
    if (faces_.empty()) return 0;
    double low = low_, high = high_;
    for (int k = 0; k < kHalvingsOfCut; ++k) {
      const double middle = 0.5 * (low + high);
      (area_below(middle) < share * area_ ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }

  // What lies between two places. Beyond the cuts are two other volumes.
  std::vector<PlateRing> between(double from, double to, std::int32_t before, std::int32_t after) const {
    if (faces_.empty()) return {};
    ClipperLib::Clipper clipper;
    for (const PlateFace& face : faces_) {
      clipper.AddPath(path_of(face.outer), ClipperLib::ptSubject, true);
      for (const Ring& hole : face.holes) clipper.AddPath(path_of(hole), ClipperLib::ptSubject, true);
    }
    const double far = 1 + high_ - low_ + reach();
    const double start = before == PlateRing::kFree ? low_ - far : from, end = after == PlateRing::kFree ? high_ + far : to;
    const Vector3 across{-along_.y, along_.x, 0};
    const auto at = [&](double s, double t) { return centre_ + s * along_ + t * across; };
    clipper.AddPath(path_of({at(start, -far), at(end, -far), at(end, far), at(start, far)}), ClipperLib::ptClip, true);
    ClipperLib::Paths cut;
    clipper.Execute(ClipperLib::ctIntersection, cut, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
    std::vector<PlateRing> rings;
    for (const ClipperLib::Path& path : cut) {
      if (path.size() < 3) continue;
      PlateRing ring;
      for (const ClipperLib::IntPoint& p : path)
        ring.corners.push_back(
            {{centre_.x + static_cast<double>(p.X) / kCutGrid, centre_.y + static_cast<double>(p.Y) / kCutGrid, 0},
             PlateRing::kFree,
             false});
      for (std::size_t k = 0; k < ring.corners.size(); ++k) {
        const Point3 middle = 0.5 * (ring.corners[k].at + ring.corners[(k + 1) % ring.corners.size()].at);
        const double s = dot(middle - centre_, along_);
        ring.corners[k].beyond = before != PlateRing::kFree && std::abs(s - from) < kOnSide ? before
                                 : after != PlateRing::kFree && std::abs(s - to) < kOnSide  ? after
                                                                                            : beyond(middle);
      }
      rings.push_back(std::move(ring));
    }
    return rings;
  }

 private:
  std::pair<double, double> extent() const {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const PlateFace& face : faces_)
      for (const Point3& p : face.outer) {
        const double s = dot(p - centre_, along_);
        low = std::min(low, s);
        high = std::max(high, s);
      }
    return {low, high};
  }

  double reach() const {
    double most = 0;
    for (const PlateFace& face : faces_)
      for (const Point3& p : face.outer) most = std::max(most, distance({p.x, p.y, 0}, centre_));
    return most;
  }

  // Each side of a ring leaves its part of the strip between the axis and itself; what is cut off adds nothing.
  double area_below(double place) const {
    double twice = 0;
    const Vector3 across{-along_.y, along_.x, 0};
    const auto add = [&](const Ring& ring) {
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const Vector3 a = ring[k] - centre_, b = ring[(k + 1) % ring.size()] - centre_;
        double s0 = dot(a, along_), s1 = dot(b, along_), t0 = dot(a, across), t1 = dot(b, across);
        if (s0 >= place && s1 >= place) continue;
        if (s0 > place) t0 += (place - s0) / (s1 - s0) * (t1 - t0), s0 = place;
        else if (s1 > place) t1 = t0 + (place - s0) / (s1 - s0) * (t1 - t0), s1 = place;
        twice -= (s1 - s0) * (t0 + t1);
      }
    };
    for (const PlateFace& face : faces_) {
      add(face.outer);
      for (const Ring& hole : face.holes) add(hole);
    }
    return 0.5 * twice;
  }

  ClipperLib::Path path_of(const Ring& ring) const {
    ClipperLib::Path path;
    for (const Point3& p : ring)
      path.emplace_back(static_cast<ClipperLib::cInt>(std::llround((p.x - centre_.x) * kCutGrid)),
                        static_cast<ClipperLib::cInt>(std::llround((p.y - centre_.y) * kCutGrid)));
    return path;
  }

  std::int32_t beyond(const Point3& at) const {
    for (const KnownSide& side : sides_) {
      const Vector3 e = side.to - side.from;
      const double length = norm(e), s = dot(at - side.from, e);
      if (!(length > 0) || s < 0 || s > length * length) continue;
      if (std::abs(cross(e, at - side.from).z) < kOnSide * length) return side.beyond;
    }
    return PlateRing::kFree;
  }

  Point3 centre_;
  Vector3 along_;
  std::vector<PlateFace> faces_;
  std::vector<KnownSide> sides_;
  double low_ = 0, high_ = 0, area_ = 0;
};

// One more storey of a stack that it continues, or a stack of its own.
void add_storey(StandingBody& body, const PlateStack& plate, std::size_t plate_number, double bottom, double height,
                std::size_t& last_plate) {
  if (!body.stacks.empty() && last_plate == plate_number && body.stacks.back().storey_height == height &&
      std::abs(body.stacks.back().top() - bottom) < 1e-9) {
    ++body.stacks.back().storeys;
    return;
  }
  last_plate = plate_number;
  body.stacks.push_back(plate);
  body.stacks.back().storeys = 1;
  body.stacks.back().bottom = bottom;
  body.stacks.back().storey_height = height;
}

// The parts of a plate that several have.
void cut_storey(const PlateStack& plate, const SharedStorey& storey, double bottom, double angle,
                std::span<const BuildingShare> shares, std::vector<StandingBody>& parts) {
  const CutPlate cut(plate, parts.front().centre, angle);
  // Courtyards are no part of what is shared out. But below the ground there are none.
  PlateStack filled = plate;
  filled.courtyards.clear();
  const CutPlate ground(filled, parts.front().centre, angle);
  double before = 0;
  double from = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < storey.portions.size(); ++k) {
    const Portion& portion = storey.portions[k];
    const bool is_last = k + 1 == storey.portions.size();
    before += portion.area;
    const double to = is_last ? std::numeric_limits<double>::infinity() : cut.place_of(before / plate.area);
    const auto site_of = [&](std::size_t p) { return static_cast<std::int32_t>(shares[storey.portions[p].share].site); };
    const std::int32_t below = k > 0 ? site_of(k - 1) : PlateRing::kFree, above = is_last ? PlateRing::kFree : site_of(k + 1);
    parts[portion.share].stacks.push_back({1, bottom, storey.height, portion.area, cut.between(from, to, below, above), {}});
    if (!plate.courtyards.empty()) parts[portion.share].stacks.back().enclosed = ground.between(from, to, below, above);
    from = to;
  }
}

}  // namespace

double mean_storey_height(std::span<const BuildingShare> shares, int storeys) {
  const std::vector<double> plates(static_cast<std::size_t>(std::max(1, storeys)), 1);
  double sum = 0;
  for (const SharedStorey& storey : fill(plates, shares)) sum += storey.height;
  if (sum > 0) return sum / static_cast<double>(plates.size());
  return shares.empty() ? 3 : shares.front().storey_height;
}

SharedBuilding share_out(const StandingBody& body, std::span<const BuildingShare> shares, double angle) {
  SharedBuilding shared;
  shared.whole.centre = body.centre;
  shared.parts.resize(shares.size());
  shared.roofs.resize(shares.size(), 0);
  for (StandingBody& part : shared.parts) part.centre = body.centre;
  if (body.stacks.empty() || shares.empty()) return shared;
  std::vector<double> plates;
  std::vector<std::size_t> stack_of;
  for (std::size_t s = 0; s < body.stacks.size(); ++s)
    for (int k = 0; k < body.stacks[s].storeys; ++k) {
      plates.push_back(body.stacks[s].area);
      stack_of.push_back(s);
    }
  const std::vector<SharedStorey> storeys = fill(plates, shares);
  double bottom = body.stacks.front().bottom;
  std::size_t last_of_whole = kNobody;
  std::vector<std::size_t> last_of(shares.size(), kNobody);
  for (std::size_t k = 0; k < storeys.size(); ++k) {
    const PlateStack& plate = body.stacks[stack_of[k]];
    const double height = storeys[k].height > 0 ? storeys[k].height : plate.storey_height;
    add_storey(shared.whole, plate, stack_of[k], bottom, height, last_of_whole);
    if (storeys[k].portions.size() == 1) {
      const std::size_t share = storeys[k].portions.front().share;
      add_storey(shared.parts[share], plate, stack_of[k], bottom, height, last_of[share]);
    } else if (!storeys[k].portions.empty()) {
      cut_storey(plate, storeys[k], bottom, angle, shares, shared.parts);
      // What comes above a part of a plate is a stack of its own.
      for (const Portion& portion : storeys[k].portions) last_of[portion.share] = kNobody;
    }
    // What the next plate leaves free of this one is roof, of each as much as it has of the plate.
    const double above = k + 1 < plates.size() ? plates[k + 1] : 0;
    for (const Portion& portion : storeys[k].portions)
      shared.roofs[portion.share] += std::max(0.0, plates[k] - above) * portion.area / plates[k];
    bottom += height;
  }
  return shared;
}

}  // namespace bl::geometry
