// Imports the plan boundary of a site from GeoJSON: one polygon in a local metric frame with its place on Earth.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/geometry/plan_ring.h"
#include "core/import/local_frame.h"

namespace bl::importing {

struct PlanOptions {
  std::string feature;        ///< which feature: its index from 0 ("3"), or "property=value"; empty: the only or largest one
  std::string crs;            ///< used instead of what the file says, such as "EPSG:28992"
  std::string proj_database;  ///< path of PROJ's proj.db; empty: PROJ finds its own
};

/// A simple polygon at z = 0 in local metres.
struct PlanBoundary {
  std::string place;       ///< the feature that was taken, such as "features/3"; empty for a bare one
  std::string source_crs;  ///< the CRS of the file's coordinates
  GeoReference reference;
  geometry::Ring outer;               ///< counter-clockwise, starts at the file's first point
  std::vector<geometry::Ring> holes;  ///< clockwise
  double area = 0;                    ///< of the outer ring less the holes [m²]
  double outer_area = 0;              ///< of the outer ring alone [m²]
  bool is_convex = false;             ///< no holes, and no point more than a millimetre inside the hull
  geometry::Ring hull;                ///< convex hull of the outer ring, counter-clockwise
  double hull_area = 0;               ///< [m²]
  std::vector<std::string> notes;     ///< what was assumed, mended or left out, one sentence each
};

Result<PlanBoundary> read_plan_boundary(std::string_view geojson_text, const PlanOptions& options = {});

/// A convex plan in place of one that is not.
struct ConvexPlan {
  geometry::Ring ring;    ///< counter-clockwise
  double area = 0;        ///< [m²]
  double added_area = 0;  ///< what the hull covers beyond the plan, its holes among it [m²]
};

/// The convex hull, for those who want a convex site. Whether the added area is bearable is the caller's decision.
ConvexPlan convex_hull_plan(const PlanBoundary& plan);

}  // namespace bl::importing
