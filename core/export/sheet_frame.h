// What all drawings on a sheet of paper share: its size and scale, and what surrounds the drawing.
#pragma once

#include <string>
#include <vector>

#include "core/export/plan_sheet.h"

namespace bl::exporting {

/// Colours of what is not the proposal itself.
inline constexpr drawing::Colour kGrey = {0.45, 0.46, 0.48}, kPale = {0.90, 0.90, 0.88}, kExistingFill = {0.83, 0.83, 0.81};

/// Ground that is kept open, in a pale tone of its use.
inline drawing::Colour open_fill(const drawing::Colour& use) { return drawing::mix(use, drawing::kWhite, 0.5); }

/// A sheet with an empty window, which makers of drawings fill.
class SheetFrame {
 protected:
  static constexpr double kMargin = 10, kTitleHeight = 34, kGap = 6;  // [mm]

  SheetFrame(const Proposal& proposal, const SheetOptions& options);

  double window_width() const { return sheet_.window_high.x - sheet_.window_low.x; }
  double window_height() const { return sheet_.window_high.y - sheet_.window_low.y; }
  double legend_left() const { return kMargin + 0.42 * (sheet_.width - 2 * kMargin); }
  double millimetres() const { return 1000 / sheet_.scale; }  // per metre
  /// Where a point of the drawing [m] is on the sheet [mm], by its first two coordinates.
  SheetPoint at(const Point3& p) const;
  std::vector<SheetPoint> line_of(const std::vector<Point3>& points) const;

  /// For a drawing of this size [m]; `wanted`: n of 1:n, 0 for the largest usual one that fits. Fails where it does not fit.
  Result<void> choose_scale(double width, double height, double wanted, const char* what);
  /// A line with its ends marked, and its length in metres beside it.
  void dimension(SheetGroup& group, SheetPoint a, SheetPoint b, double length, bool is_upright) const;
  static std::vector<SheetPoint> rectangle(SheetPoint low, SheetPoint high);
  /// A text in its size, else in a smaller one, else cut off where its room ends [mm].
  static SheetText fitted(SheetPoint place, double size, bool is_bold, std::string text, double room);
  /// How many letters of a size are about as wide as the room.
  static std::size_t letters_within(double room, double size);
  /// `what` the sheet shows, and its `figures` in the last line.
  void add_title(const std::string& what, const std::string& figures);
  /// Uses, and where the drawing shows the ground as well, what is kept open and clear.
  void add_legend(bool with_ground);
  void add_scale_bar();
  void add_north();

  const Proposal& proposal_;
  const SheetOptions& options_;
  PlanSheet sheet_;
};

}  // namespace bl::exporting
