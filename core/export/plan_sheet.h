// The plan of one level on a sheet of paper at a scale: shapes and texts in millimetres, for whoever draws them.
#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/define/port_builder.h"
#include "core/export/drawn_levels.h"
#include "core/export/forms.h"
#include "core/export/proposal_model.h"

namespace bl::exporting {

/// A place on the sheet [mm], from its upper left corner, y downwards.
struct SheetPoint {
  double x = 0, y = 0;
};

/// Lines, closed or not, filled by the even-odd rule or not.
struct SheetShape {
  std::vector<std::vector<SheetPoint>> lines;
  bool is_closed = true, is_filled = false, is_stroked = true, is_dashed = false;
  drawing::Colour fill, stroke = drawing::kInk;
  double width = 0.18;  ///< of the stroke [mm]
  std::string name;     ///< what it is, for those who look
};

enum class SheetAnchor { start, middle, end };

struct SheetText {
  SheetPoint at;      ///< on the base line
  double size = 2.5;  ///< [mm]
  SheetAnchor anchor = SheetAnchor::start;
  bool is_bold = false;
  std::string words;
};

struct SheetGroup {
  std::string id, label;
  bool is_clipped = false;  ///< nothing is seen of it beyond the window
  std::vector<SheetShape> shapes;
  std::vector<SheetText> texts;
};

struct PlanSheet {
  std::string title;
  int level = 0;
  double width = 420, height = 297;    ///< [mm]
  double scale = 500;                  ///< 1:n
  SheetPoint window_low, window_high;  ///< where the plan is seen [mm]
  Point3 origin;                       ///< the place of the scene at `window_low`, the upper left corner [m]
  std::vector<SheetGroup> groups;      ///< in the order in which they are drawn
};

enum class Paper { a4, a3, a2, a1, a0 };
/// The sizes for a declaration of options.
std::vector<Choice<Paper>> paper_choices();

/// What a plan shows: the site, with as much of the surroundings as the sheet has room for, or all of them.
enum class DrawnExtent { site, all };

struct SheetOptions : FormOptions {
  Paper paper = Paper::a3;
  DrawnExtent extent = DrawnExtent::site;
  double scale = 0;  ///< n of 1:n; 0: the largest of the usual ones that fits
  bool surroundings = true, labels = true;
  /// A line as `section_line` reads it, or one height; `auto`: along the longest side, through
  /// the highest volume; `none`: no section.
  std::string section = "auto";
};

/// Fails where the scale does not fit on the paper; the sentence names one that does.
Result<PlanSheet> plan_sheet(const Proposal& proposal, const DrawnLevel& level, const SheetOptions& options);
/// The plan that a level plane at a height cuts [m above the origin]. Fails as above.
Result<PlanSheet> level_cut_sheet(const Proposal& proposal, double height, const SheetOptions& options);
/// The cut along the line or at the height that the options name. Fails as above, and on what is neither.
Result<PlanSheet> section_sheet(const Proposal& proposal, const SheetOptions& options);

}  // namespace bl::exporting
