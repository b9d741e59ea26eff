// Extents and centroids in plan.
#include "core/export/plan_places.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/plan_ring.h"
#include "core/import/plan_cover.h"

namespace bl::exporting {

namespace {

void widen_extent(PlanExtent& extent, const std::vector<Point3>& points) {
  for (const Point3& p : points) {
    extent.low = {std::min(extent.low.x, p.x), std::min(extent.low.y, p.y), 0};
    extent.high = {std::max(extent.high.x, p.x), std::max(extent.high.y, p.y), 0};
  }
}

}  // namespace

PlanExtent plan_extent(const Proposal& proposal) {
  PlanExtent extent{{1e20, 1e20, 0}, {-1e20, -1e20, 0}};
  const auto take = [&](const std::vector<geometry::PlateFace>& faces) {
    for (const geometry::PlateFace& face : faces) widen_extent(extent, face.outer);
  };
  for (const Land& land : proposal.lands) take(land.faces);
  for (const Building& building : proposal.buildings)
    for (const Storey& storey : building.storeys) take(storey.faces);
  return extent;
}

PlanExtent whole_extent(const Proposal& proposal) {
  PlanExtent extent = plan_extent(proposal);
  for (const Neighbour& neighbour : proposal.neighbours) widen_extent(extent, neighbour.face.outer);
  for (const Street& street : proposal.streets) widen_extent(extent, street.line);
  return extent;
}

namespace {

struct Box {
  double west = 1e20, south = 1e20, east = -1e20, north = -1e20;
};
Box box_of(const geometry::Ring& ring) {
  Box box;
  for (const Point3& p : ring) {
    box.west = std::min(box.west, p.x), box.east = std::max(box.east, p.x);
    box.south = std::min(box.south, p.y), box.north = std::max(box.north, p.y);
  }
  return box;
}

}  // namespace

LabelPlace label_place(const std::vector<geometry::PlateFace>& faces) {
  const auto largest = std::max_element(faces.begin(), faces.end(), [](const auto& a, const auto& b) {
    return std::abs(geometry::signed_area(a.outer)) < std::abs(geometry::signed_area(b.outer));
  });
  if (largest == faces.end() || largest->outer.size() < 3) return {};
  const Box all = box_of(largest->outer);
  LabelPlace place{geometry::middle_of(faces), all.east - all.west, all.north - all.south};
  const auto hole = std::find_if(largest->holes.begin(), largest->holes.end(), [&](const geometry::Ring& ring) {
    const Box box = box_of(ring);
    // Words reach beyond their middle: a courtyard beside it is struck as well.
    return box.south - 0.1 * place.height < place.middle.y && place.middle.y < box.north + 0.1 * place.height;
  });
  if (hole != largest->holes.end()) {
    const Box court = box_of(*hole);
    const double above = all.north - court.north, below = court.south - all.south;
    place.height = std::max(above, below);
    place.middle.y = above > below ? court.north + above / 2 : all.south + below / 2;
  }
  if (!geometry::ring_contains(largest->outer, place.middle)) place.middle = importing::place_inside(largest->outer);
  return place;
}

}  // namespace bl::exporting
