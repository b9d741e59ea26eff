// A vertical cut through the proposal: what it cuts, the floors in it, what stands behind it, and the ground.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/export/proposal_model.h"

namespace bl::exporting {

/// Where the cut runs, in plan [m]. It goes on beyond both ends; one looks to the left of the way from `from` to `to`.
struct SectionLine {
  Point3 from, to;
};

/// "X1 Y1 X2 Y2" in metres, also with commas; empty: along the longest side of the land, through the
/// highest volume and as many others as a parallel to it can cut. Fails on other
/// texts, and on a line without length.
Result<SectionLine> section_line(const Proposal& proposal, const std::string& text);
/// The height of a level cut [m above the origin], where the text is one number; nothing where it is none.
std::optional<double> level_cut(const std::string& text);

/// Fails where a level cut misses all storeys and cellars, with the heights between which they lie.
Result<void> check_level_cut(const Proposal& proposal, double height);

/// Of one building, or of one that stands already. Rings have the way along the line as x, from `from` on, and the height as y
/// [m].
struct SectionPart {
  const Building* building = nullptr;      ///< none for what stands already
  std::vector<geometry::Ring> cut, slabs;  ///< what is cut, by the even-odd rule, and floors and roofs in it
  std::vector<geometry::Ring> cellars;     ///< what is cut of it below the ground; their floors are among `slabs`
  std::vector<geometry::Ring> beyond;      ///< outlines of what stands behind the cut
  double distance = 0;                     ///< of its nearest place from the cut, 0 where it is cut [m]
};

struct Section {
  SectionLine line;
  std::vector<SectionPart> parts;            ///< the farthest first, as they are drawn
  std::vector<std::vector<Point3>> grounds;  ///< lines of the ground, open
  std::vector<double> borders;               ///< where plots and boundaries end [m along the line]
  std::vector<double> heights;               ///< of floors and roofs that are cut, ascending [m]
  Point3 low, high;                          ///< around all parts of the proposal and its land
};

/// Thickness of floors and roofs as they are drawn [m].
inline constexpr double kSectionSlab = 0.3;
Section section_of(const Proposal& proposal, const SectionLine& line, bool with_surroundings);
/// Fails where it shows nothing: neither land nor a building lies on the line or behind it.
Result<void> check_section(const Section& section);

/// What a level plane cuts of a building.
struct LevelPart {
  const Storey* storey = nullptr;  ///< that it goes through, or that what it cuts belongs to; none: it misses the building
  std::vector<geometry::PlateFace> faces;
};
/// A standing volume and a cellar have the plate of that storey; of a rounded one the mesh is cut at just that height.
LevelPart level_part(const Building& building, double height);

}  // namespace bl::exporting
