// Domains from a plan and two heights: a convex polygon as one body, any other, with holes, as columns over convex polygons.
#include <algorithm>
#include <string>

#include "core/geometry/domain_makers.h"
#include "core/geometry/inside/domain_parts.h"
#include "core/geometry/inside/plan_corners.h"
#include "core/geometry/inside/plan_pieces.h"
#include "core/geometry/plan_ring.h"

namespace bl::geometry {

namespace {

Ring ring_of(const std::vector<PlanCorner>& corners) {
  Ring ring;
  for (const PlanCorner& corner : corners) ring.push_back({corner.x, corner.y, 0});
  return ring;
}

std::string hole_place(std::size_t hole) { return "holes/" + std::to_string(hole); }

// The number of a side as the ring was given: turning a ring round makes its sides begin where they ended.
std::size_t given_side(const std::vector<PlanCorner>& corners, std::size_t side) {
  const bool is_turned = corners[1].given > corners.back().given;
  return corners[is_turned ? (side + 1) % corners.size() : side].given;
}

// Each hole inside the plan and outside the other holes, none of them touching.
Result<void> check_holes(const std::vector<std::vector<PlanCorner>>& rings) {
  std::vector<Ring> lines;
  for (const auto& corners : rings) lines.push_back(ring_of(corners));
  for (std::size_t h = 1; h < rings.size(); ++h) {
    for (std::size_t other = 0; other < h; ++other) {
      const std::string name = other == 0 ? "the plan polygon" : "hole " + std::to_string(other - 1);
      if (const auto crossing = find_crossing(lines[other], lines[h])) {
        return Error{ErrorCode::geometry, hole_place(h - 1),
                     "the hole meets " + name + " at " + place_of(crossing->where.x, crossing->where.y) + ": side " +
                         std::to_string(given_side(rings[h], crossing->second_edge)) + " of the hole and side " +
                         std::to_string(given_side(rings[other], crossing->first_edge)) + " of " + name};
      }
      const bool is_inside = ring_contains(lines[other], lines[h].front());
      const std::string at = place_of(lines[h].front().x, lines[h].front().y);
      if (other == 0 && !is_inside)
        return Error{ErrorCode::geometry, hole_place(h - 1),
                     "the hole lies outside the plan polygon: its first corner is at " + at};
      if (other > 0 && (is_inside || ring_contains(lines[h], lines[other].front())))
        return Error{ErrorCode::geometry, hole_place(h - 1),
                     "the hole and " + name + " lie one within the other: keep the larger"};
    }
  }
  return {};
}

}  // namespace

Result<ConvexDomain> extrude(std::span<const Point3> plan, double bottom, double top) {
  if (auto checked = check_heights(bottom, top); !checked) return checked.error();
  auto corners = plan_corners(plan, "plan polygon", Turning::counter_clockwise);
  if (!corners) return corners.error();
  if (const std::size_t reflex = first_reflex(*corners); reflex < corners->size()) {
    const PlanCorner& corner = (*corners)[reflex];
    return Error{ErrorCode::geometry, "",
                 "the plan polygon is not convex (corner " + std::to_string(corner.given) + " at " +
                     place_of(corner.x, corner.y) + "); where one convex body is asked for, use the hull"};
  }
  return finish_domain(prism(*corners, bottom, top));
}

Result<Domain> extrude_plan(std::span<const Point3> plan, std::span<const std::vector<Point3>> holes, double bottom, double top) {
  if (auto checked = check_heights(bottom, top); !checked) return checked.error().within("plan");
  std::vector<std::vector<PlanCorner>> rings;
  auto outer = plan_corners(plan, "plan polygon", Turning::counter_clockwise);
  if (!outer) return outer.error().within("plan");
  rings.push_back(std::move(*outer));
  for (std::size_t h = 0; h < holes.size(); ++h) {
    auto hole = plan_corners(holes[h], "hole", Turning::clockwise);
    if (!hole) return hole.error().within(hole_place(h));
    rings.push_back(std::move(*hole));
  }
  if (auto checked = check_holes(rings); !checked) return checked.error();
  if (rings.size() == 1 && first_reflex(rings.front()) == rings.front().size()) {
    auto convex = finish_domain(prism(rings.front(), bottom, top));
    return convex ? Result<Domain>(Domain(std::move(*convex))) : convex.error().within("plan");
  }
  auto polygons = plan_pieces(rings);
  if (!polygons) return polygons.error().within("plan");
  std::vector<Domain::Piece> pieces;
  std::uint32_t side_count = 2;
  for (const auto& ring : rings) side_count += static_cast<std::uint32_t>(ring.size());
  for (const PlanPiece& polygon : *polygons) {
    auto column = finish_domain(prism(polygon.corners, bottom, top));
    // A sliver between corners that nearly meet takes no volume that counts.
    if (!column) continue;
    Domain::Piece piece{std::move(*column), {0, 1}};
    for (const std::uint32_t wall : polygon.walls) piece.sides.push_back(wall == PlanPiece::kNoWall ? Domain::kInner : 2 + wall);
    pieces.push_back(std::move(piece));
  }
  auto domain = join_pieces(std::move(pieces));
  if (!domain) return domain.error().within("plan");
  domain->side_count = side_count;
  return domain;
}

}  // namespace bl::geometry
