// Columns over the parts of a plan: each with the heights that are left to it, and walls named after the rings they stand on.
#include "core/geometry/site_domain.h"

#include <algorithm>
#include <map>
#include <string>
#include <tuple>

#include "core/geometry/inside/domain_parts.h"
#include "core/geometry/inside/part_faces.h"
#include "core/geometry/inside/plan_corners.h"
#include "core/geometry/inside/plan_pieces.h"
#include "core/geometry/plan_ring.h"

namespace bl::geometry {

namespace {

// What is built over one place, from a height to a height, and the sides that its ends lie in.
struct Storey {
  double low = 0, high = 0;
  std::uint32_t bottom_side = 0, top_side = 0;
  auto operator<=>(const Storey&) const = default;
};
using Stack = std::vector<Storey>;

struct Layer {
  std::vector<PlanCorner> corners;
  Ring ring;
  Vector3 low, high;
  Storey storey;
  std::uint32_t first_wall = 0;
  enum class Kind { plan, hole, step, exclusion } kind = Kind::plan;
};

bool covers(const Layer& layer, const Point3& p) {
  return p.x > layer.low.x && p.x < layer.high.x && p.y > layer.low.y && p.y < layer.high.y && ring_contains(layer.ring, p);
}

void add(Stack& stack, Storey storey) {
  for (auto other = stack.begin(); other != stack.end();) {
    if (other->high < storey.low || other->low > storey.high) {
      ++other;
      continue;
    }
    if (other->low <= storey.low) std::tie(storey.low, storey.bottom_side) = std::pair(other->low, other->bottom_side);
    if (other->high >= storey.high) std::tie(storey.high, storey.top_side) = std::pair(other->high, other->top_side);
    other = stack.erase(other);
  }
  stack.insert(std::lower_bound(stack.begin(), stack.end(), storey), storey);
}

Stack without(const Stack& stack, const Storey& gone) {
  Stack rest;
  for (const Storey& storey : stack) {
    if (gone.high <= storey.low || gone.low >= storey.high) {
      rest.push_back(storey);
      continue;
    }
    // The surface below a solid is its underside, and the one above it its top.
    if (storey.low < gone.low) rest.push_back({storey.low, gone.low, storey.bottom_side, gone.bottom_side});
    if (storey.high > gone.high) rest.push_back({gone.high, storey.high, gone.top_side, storey.top_side});
  }
  return rest;
}

class Site {
 public:
  explicit Site(const SitePlan& plan) : plan_(plan) {}

  Result<Domain> make() {
    if (auto added = add_layers(); !added) return added.error();
    std::vector<std::vector<PlanCorner>> rings;
    for (const Layer& layer : layers_) rings.push_back(layer.corners);
    auto polygons = labelled_pieces(rings, [this](const Point3& p) { return label_at(p); });
    if (!polygons) return polygons.error().within("plan");
    std::vector<LoosePart> parts;
    Vector3 low = layers_[0].low, high = layers_[0].high;
    for (const LabelledPolygon& polygon : *polygons) {
      for (const Storey& storey : stacks_[static_cast<std::size_t>(polygon.label)]) {
        auto column = finish_domain(prism(polygon.corners, storey.low, storey.high));
        if (!column) continue;  // thinner than rounding
        low = {std::min(low.x, column->minimum.x), std::min(low.y, column->minimum.y), std::min(low.z, column->minimum.z)};
        high = {std::max(high.x, column->maximum.x), std::max(high.y, column->maximum.y), std::max(high.z, column->maximum.z)};
        Domain::Piece piece{std::move(*column), {storey.bottom_side, storey.top_side}};
        piece.sides.resize(piece.shape.planes.size(), Domain::kInner);
        parts.push_back({part_of(piece), nullptr});
      }
    }
    if (parts.empty()) return Error{ErrorCode::geometry, "exclusions", "the exclusions take away the whole boundary"};
    return settled_domain(parts, walls(), place_tolerance(low, high), side_count_);
  }

 private:
  Result<void> add_layers() {
    auto base = extrude_plan(plan_.plan, plan_.holes, plan_.bottom, plan_.top);
    if (!base) return base.error();
    const Storey storey{plan_.bottom, plan_.top, 0, 1};
    side_count_ = 2;
    if (auto added = add_ring(plan_.plan, Layer::Kind::plan, storey, "plan"); !added) return added;
    for (const auto& hole : plan_.holes)
      if (auto added = add_ring(hole, Layer::Kind::hole, storey, "holes"); !added) return added;
    if (auto added = add_solids(plan_.steps, Layer::Kind::step, "steps/"); !added) return added;
    return add_solids(plan_.exclusions, Layer::Kind::exclusion, "exclusions/");
  }

  Result<void> add_solids(const std::vector<PlanSolid>& solids, Layer::Kind kind, const std::string& port) {
    for (std::size_t k = 0; k < solids.size(); ++k) {
      const std::string place = port + std::to_string(k);
      if (auto checked = check_heights(solids[k].bottom, solids[k].top); !checked) return checked.error().within(place);
      const Storey storey{solids[k].bottom, solids[k].top, side_count_, side_count_ + 1};
      side_count_ += 2;
      if (auto added = add_ring(solids[k].ring, kind, storey, place); !added) return added;
    }
    return {};
  }

  Result<void> add_ring(const std::vector<Point3>& ring, Layer::Kind kind, const Storey& storey, const std::string& place) {
    const auto turning = kind == Layer::Kind::hole ? Turning::clockwise : Turning::counter_clockwise;
    auto corners = plan_corners(ring, "plan polygon", turning);
    if (!corners) return corners.error().within(place);
    Layer layer{std::move(*corners), {}, {}, {}, storey, side_count_, kind};
    for (const PlanCorner& c : layer.corners) layer.ring.push_back({c.x, c.y, 0});
    layer.low = layer.high = layer.ring.front();
    for (const Point3& p : layer.ring) {
      layer.low = {std::min(layer.low.x, p.x), std::min(layer.low.y, p.y), storey.low};
      layer.high = {std::max(layer.high.x, p.x), std::max(layer.high.y, p.y), storey.high};
    }
    side_count_ += static_cast<std::uint32_t>(layer.corners.size());
    layers_.push_back(std::move(layer));
    return {};
  }

  int label_at(const Point3& p) {
    Stack stack;
    bool is_open = false;
    for (const Layer& layer : layers_) {
      if (layer.kind == Layer::Kind::plan) is_open = covers(layer, p);
      else if (layer.kind == Layer::Kind::hole) is_open = is_open && !covers(layer, p);
    }
    if (is_open) stack.push_back(layers_.front().storey);
    for (const Layer& layer : layers_)
      if (layer.kind == Layer::Kind::step && covers(layer, p)) add(stack, layer.storey);
    for (const Layer& layer : layers_)
      if (layer.kind == Layer::Kind::exclusion && covers(layer, p)) stack = without(stack, layer.storey);
    if (stack.empty()) return -1;
    const auto [known, is_new] = labels_.emplace(stack, static_cast<int>(stacks_.size()));
    if (is_new) stacks_.push_back(stack);
    return known->second;
  }

  std::vector<Wall> walls() const {
    std::vector<Wall> result;
    for (const Layer& layer : layers_) {
      const double sign = layer.kind == Layer::Kind::exclusion ? -1 : 1;
      const std::size_t n = layer.ring.size();
      for (std::size_t i = 0; i < n; ++i) {
        const Point3 &a = layer.ring[i], &b = layer.ring[(i + 1) % n];
        const double low = layer.storey.low, high = layer.storey.high, length = distance(a, b);
        result.push_back({{{a.x, a.y, low}, {b.x, b.y, low}, {b.x, b.y, high}, {a.x, a.y, high}},
                          sign * Vector3{(b.y - a.y) / length, (a.x - b.x) / length, 0},
                          layer.first_wall + static_cast<std::uint32_t>(i)});
      }
    }
    return result;
  }

  const SitePlan& plan_;
  std::vector<Layer> layers_;
  std::uint32_t side_count_ = 0;
  std::map<Stack, int> labels_;
  std::vector<Stack> stacks_;
};

}  // namespace

Result<Domain> site_domain(const SitePlan& site) {
  if (site.steps.empty() && site.exclusions.empty()) return extrude_plan(site.plan, site.holes, site.bottom, site.top);
  return Site(site).make();
}

Result<Domain> without_solids(const Domain& domain, const std::vector<PlanSolid>& exclusions) {
  if (exclusions.empty()) return domain;
  std::vector<Domain> solids;
  for (std::size_t k = 0; k < exclusions.size(); ++k) {
    auto solid = extrude_plan(exclusions[k].ring, {}, exclusions[k].bottom, exclusions[k].top);
    if (!solid) {
      Error error = solid.error();
      error.place = "exclusions/" + std::to_string(k);  // instead of `plan`: the ring is the only one there is
      return error;
    }
    solids.push_back(std::move(*solid));
  }
  auto left = exclude(domain, solids);
  return left ? left : Result<Domain>(left.error().within("exclusions"));
}

}  // namespace bl::geometry
