// What holds for all surroundings that an importer hands out, whatever bytes it was given.
#pragma once

#include <cmath>

#include "core/import/context.h"
#include "tests/fuzz/require.h"

namespace bl::fuzz {

inline void check_ring(const geometry::Ring& ring, bool is_outer) {
  require(ring.size() >= 3, "a ring of fewer than three corners");
  for (const Point3& corner : ring) require(is_finite(corner), "a corner that is not finite");
  require(is_outer ? geometry::signed_area(ring) > 0 : geometry::signed_area(ring) < 0, "a ring that turns the wrong way");
  require(!geometry::find_self_crossing(ring), "a ring that crosses itself");
}

inline void check_context(const Result<importing::Context>& context) {
  if (!context) return require(!context.error().message.empty(), "an error without a sentence");
  for (const importing::ContextBuilding& building : context->buildings) {
    check_ring(building.outer, true);
    for (const geometry::Ring& hole : building.holes) check_ring(hole, false);
    require(std::isfinite(building.base) && std::isfinite(building.height) && building.height > 0, "a building without a height");
    require(!building.solid || enclosed_volume(*building.solid) > 0, "a solid without a volume");
  }
  for (const importing::ContextArea& area : context->areas) check_ring(area.outer, true);
  for (const importing::ContextStreet& street : context->streets) {
    require(street.line.size() >= 2, "a street without length");
    require(street.start < context->junctions.size() && street.end < context->junctions.size(), "a street without junctions");
    require(street.speed > 0 && street.lanes > 0, "a street without speed or lanes");
  }
  for (const importing::ContextRestriction& turn : context->restrictions)
    require(turn.from < context->streets.size() && turn.to < context->streets.size() && turn.via < context->junctions.size(),
            "a turn to nowhere");
  for (const importing::ImportRow& row : context->report.rows())
    require(!row.reason.empty() && row.count > 0, "a row without a reason");
}

}  // namespace bl::fuzz
