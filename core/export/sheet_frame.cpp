// Sizes of paper, the scale, and what surrounds a drawing: title, legend, scale bar, north, dimensions.
#include "core/export/sheet_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>

#include "core/base/mathematics.h"
#include "core/base/text.h"
#include "core/export/identity.h"

namespace bl::exporting {

namespace {

constexpr std::array<double, 13> kScales = {50, 100, 200, 250, 500, 1000, 2000, 2500, 5000, 10000, 20000, 50000, 100000};

std::pair<double, double> size_of(Paper paper) {
  constexpr std::array<std::pair<double, double>, 5> kSizes = {{{297, 210}, {420, 297}, {594, 420}, {841, 594}, {1189, 841}}};
  return kSizes[static_cast<std::size_t>(paper)];
}

}  // namespace

SheetFrame::SheetFrame(const Proposal& proposal, const SheetOptions& options) : proposal_(proposal), options_(options) {
  std::tie(sheet_.width, sheet_.height) = size_of(options.paper);
  sheet_.window_low = {kMargin, kMargin};
  sheet_.window_high = {sheet_.width - kMargin, sheet_.height - kMargin - kTitleHeight};
}

SheetPoint SheetFrame::at(const Point3& p) const {
  return {sheet_.window_low.x + millimetres() * (p.x - sheet_.origin.x),
          sheet_.window_low.y + millimetres() * (sheet_.origin.y - p.y)};
}

std::vector<SheetPoint> SheetFrame::line_of(const std::vector<Point3>& points) const {
  std::vector<SheetPoint> line;
  for (const Point3& p : points) line.push_back(at(p));
  return line;
}

Result<void> SheetFrame::choose_scale(double width, double height, double wanted, const char* what) {
  const double needed = std::max(1000 * width / (window_width() - 4 * kGap), 1000 * height / (window_height() - 4 * kGap));
  const auto fit = std::find_if(kScales.begin(), kScales.end(), [&](double scale) { return scale >= needed; });
  const double best = fit == kScales.end() ? std::ceil(needed / 1e5) * 1e5 : *fit;
  if (wanted > 0 && wanted < needed)
    return Error{ErrorCode::out_of_range, "",
                 "the " + std::string(what) + " does not fit on the paper at 1:" + shortest(wanted) + "; 1:" + shortest(best) +
                     " does, or a larger paper"};
  sheet_.scale = wanted > 0 ? wanted : best;
  return {};
}

void SheetFrame::dimension(SheetGroup& group, SheetPoint a, SheetPoint b, double length, bool is_upright) const {
  SheetShape line;
  line.is_closed = false;
  line.width = 0.13;
  const double dx = is_upright ? 1.2 : 0, dy = is_upright ? 0 : 1.2;
  line.lines = {{a, b}, {{a.x - dx, a.y - dy}, {a.x + dx, a.y + dy}}, {{b.x - dx, b.y - dy}, {b.x + dx, b.y + dy}}};
  group.shapes.push_back(std::move(line));
  const SheetPoint middle = {(a.x + b.x) / 2 + (is_upright ? 1.5 : 0), (a.y + b.y) / 2 - (is_upright ? 0 : 1)};
  group.texts.push_back({middle, 2.2, is_upright ? SheetAnchor::start : SheetAnchor::middle, false, fixed(length, 2)});
}

std::vector<SheetPoint> SheetFrame::rectangle(SheetPoint low, SheetPoint high) {
  return {low, {high.x, low.y}, high, {low.x, high.y}};
}

void SheetFrame::add_title(const std::string& what, const std::string& figures) {
  SheetGroup group{"title", "Title", false, {}, {}};
  SheetShape frame;
  frame.width = 0.35;
  frame.lines = {rectangle({kMargin, kMargin}, {sheet_.width - kMargin, sheet_.height - kMargin}),
                 rectangle({kMargin, sheet_.window_high.y}, {sheet_.width - kMargin, sheet_.height - kMargin})};
  group.shapes.push_back(std::move(frame));
  const double x = kMargin + 3, y = sheet_.window_high.y;
  group.texts.push_back({{x, y + 7}, 5, SheetAnchor::start, true, proposal_.name()});
  group.texts.push_back(
      {{x, y + 13}, 3.5, SheetAnchor::start, false, what + " · 1:" + shortest(sheet_.scale) + " · lengths in metres"});
  group.texts.push_back({{x, y + 19},
                         2.5,
                         SheetAnchor::start,
                         false,
                         proposal_.file + " · tick " + std::to_string(proposal_.tick) +
                             (proposal_.is_settled ? ", settled" : ", not settled") + " · hash " + proposal_.hash});
  const std::string place = place_text(proposal_);
  group.texts.push_back(
      {{x, y + 24}, 2.5, SheetAnchor::start, false, place.empty() ? "no place on Earth: metres of the scene" : place});
  group.texts.push_back({{x, y + 30},
                         2.5,
                         SheetAnchor::start,
                         false,
                         figures + ". Volumes are drawn and measured " + reading::choice_of(proposal_.form).measured});
  sheet_.groups.push_back(std::move(group));
}

void SheetFrame::add_legend() {
  SheetGroup group{"legend", "Uses", false, {}, {}};
  const double left = kMargin + 0.42 * (sheet_.width - 2 * kMargin), width = 0.13 * (sheet_.width - 2 * kMargin);
  constexpr std::size_t kRows = 6;
  for (std::size_t k = 0; k < std::min<std::size_t>(proposal_.uses.size(), 2 * kRows); ++k) {
    const double x = left + width * static_cast<double>(k / kRows),
                 y = sheet_.window_high.y + 3 + 5 * static_cast<double>(k % kRows);
    SheetShape patch;
    patch.lines = {rectangle({x, y}, {x + 5, y + 3})};
    patch.is_filled = true;
    patch.fill = proposal_.uses[k].colour;
    group.shapes.push_back(std::move(patch));
    group.texts.push_back({{x + 6.5, y + 2.5}, 2.5, SheetAnchor::start, false, use_name(proposal_.uses[k].use)});
  }
  sheet_.groups.push_back(std::move(group));
}

// Four parts of a round length, between 40 and 100 mm in all.
void SheetFrame::add_scale_bar() {
  double part = 1;
  for (const double step : {0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0})
    if (4 * step * millimetres() <= 80) part = step;
  SheetGroup group{"scale_bar", "Scale bar", false, {}, {}};
  const double x = kMargin + 0.70 * (sheet_.width - 2 * kMargin), y = sheet_.window_high.y + 14, step = part * millimetres();
  for (int k = 0; k < 4; ++k) {
    SheetShape box;
    box.lines = {rectangle({x + k * step, y}, {x + (k + 1) * step, y + 2})};
    box.is_filled = true;
    box.fill = k % 2 == 0 ? drawing::kInk : drawing::kWhite;
    group.shapes.push_back(std::move(box));
  }
  for (const int k : {0, 2, 4})
    group.texts.push_back({{x + k * step, y + 5.5}, 2.5, SheetAnchor::middle, false, shortest(k * part) + (k == 4 ? " m" : "")});
  sheet_.groups.push_back(std::move(group));
}

void SheetFrame::add_north() {
  SheetGroup group{"north", "North", false, {}, {}};
  const double turn = proposal_.reference.true_north * std::numbers::pi / 180;
  const double s = mathematics::sine(turn), c = mathematics::cosine(turn);
  const SheetPoint middle = {sheet_.width - kMargin - 14, sheet_.window_high.y + 18};
  // (right, up) of the arrow as a place on the sheet.
  const auto put = [&](double right, double up) {
    return SheetPoint{middle.x + c * right + s * up, middle.y + s * right - c * up};
  };
  SheetShape arrow;
  arrow.lines = {{put(0, 10), put(3, -6), put(0, -3), put(-3, -6)}};
  arrow.is_filled = true;
  arrow.fill = drawing::kInk;
  group.shapes.push_back(std::move(arrow));
  const SheetPoint letter = put(0, 12);
  group.texts.push_back({{letter.x, letter.y + 1}, 3, SheetAnchor::middle, true, "N"});
  sheet_.groups.push_back(std::move(group));
}

std::vector<Choice<Paper>> paper_choices() {
  return {{Paper::a4, "a4", "297 by 210 mm."},
          {Paper::a3, "a3", "420 by 297 mm."},
          {Paper::a2, "a2", "594 by 420 mm."},
          {Paper::a1, "a1", "841 by 594 mm."},
          {Paper::a0, "a0", "1189 by 841 mm."}};
}

}  // namespace bl::exporting
