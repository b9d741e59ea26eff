// A small plan of a scene, and two of them beside each other: as it is now, and with a proposal.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <imgui.h>

#include "core/define/payload.h"
#include "ui/desktop/look/theme.h"

namespace bl::desktop {

struct PlanPoint {
  double x = 0, y = 0;  ///< [m], y downwards as on a screen
  bool operator==(const PlanPoint&) const = default;
};
struct PlanLine {
  std::vector<PlanPoint> points;
  bool is_closed = false;
  bool operator==(const PlanLine&) const = default;
};
struct PlanShape {
  std::string kind, fill;  ///< such as `volume`; a colour as pages have it
  std::vector<PlanLine> lines;
  std::vector<PlanPoint> triangles = {};  ///< of a volume, three corners each: it may have courtyards
};
/// By id: volumes, plots, boundaries, buildings and streets.
using PlanPicture = std::map<std::string, PlanShape>;

/// What is shown of the drafts of a room.
struct PlanPictures {
  PlanPicture now;
  std::map<std::string, PlanPicture> with;  ///< by draft, as the views were at `revision`
  std::uint64_t revision = 0;
  double made_at = -1e9;  ///< `now`, on the window's clock [s]
};

/// Outlines as rooms write them: `M1 2l3 0l0 4zM...`, in metres. What comes after a fault is left out.
std::vector<PlanLine> lines_of_path(const std::string& path);
/// Triangles over closed lines: one that turns as the first one does begins another part, others are holes of the part before.
std::vector<PlanPoint> filled(const std::vector<PlanLine>& lines);
/// The keys `BEGINn/ID` of a view of a room.
PlanPicture plan_in(const std::map<std::string, JsonValue>& view, const std::string& begin);
/// The volumes that one of them lacks, or has elsewhere.
std::set<std::string> differing_volumes(const PlanPicture& one, const PlanPicture& other);
/// Both at the same scale, side by side where there is room for it, else one below the other. Volumes that differ have thick
/// outlines.
void draw_two_plans(const Theme& theme, const PlanPicture& now, const PlanPicture& with);

}  // namespace bl::desktop
