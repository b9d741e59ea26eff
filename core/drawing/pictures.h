// The drawings of a report, each one SVG element with its caption.
#pragma once

#include <string>
#include <vector>

#include "core/drawing/markup.h"
#include "core/drawing/palette.h"
#include "core/reading/error_sample.h"
#include "core/reading/report_model.h"

namespace bl::drawing {

struct Picture {
  std::string svg;      ///< one element
  std::string caption;  ///< what it shows, how, and what it had to leave out
};

/// The whole proposal from above and aside, orthographic, so that lengths can be compared everywhere. All ids in it begin with
/// `id`: a page may hold several. The sheet shows all of `shown`, where it is given: with the points of several models each of
/// their pictures has the same scale and window.
Picture draw_axonometry(const reading::ReportModel& model, const Palette& palette, const std::string& id = "axonometry",
                        const std::vector<Point3>& shown = {});
/// The points that the picture of a model has to show; none where there is nothing to draw.
std::vector<Point3> points_of_axonometry(const reading::ReportModel& model);
/// Seen from above, with what is cut at eye height, the positions of all nodes, and the links between them.
Picture draw_plan(const State& state, const reading::ReportModel& model, const Palette& palette);
/// Errors and moves over the ticks, on logarithmic scales.
Picture draw_error_chart(const reading::ReportModel& model, const std::vector<reading::ErrorSample>& history);

/// Opens the element that all drawings have in common, with its title for those who cannot see it.
void open_picture(Markup& svg, double width, double height, const std::string& id, const std::string& title,
                  const std::string& description);
/// A drawing that says why there is nothing on it.
std::string empty_picture(const std::string& id, const std::string& title, const std::string& sentence);
/// Volumes by size, the largest first: the order in which labels get their places.
std::vector<const reading::VolumeRow*> by_size(const reading::ReportModel& model);
/// Above these numbers of volumes a drawing shows numbers instead of names, no storey lines, no numbers.
inline constexpr std::size_t kMostNames = 40, kMostStoreys = 200, kMostNumbers = 300;

}  // namespace bl::drawing
