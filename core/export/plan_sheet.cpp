// Lays out one level: the plan in a window, and under it title, legend, scale bar and north.
#include "core/export/plan_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>

#include "core/base/mathematics.h"
#include "core/base/text.h"
#include "core/export/identity.h"
#include "core/export/plan_places.h"
#include "core/export/read_proposal.h"

namespace bl::exporting {

namespace {

constexpr double kMargin = 10, kTitleHeight = 34, kGap = 6;  // [mm]
constexpr std::array<double, 13> kScales = {50, 100, 200, 250, 500, 1000, 2000, 2500, 5000, 10000, 20000, 50000, 100000};
constexpr drawing::Colour kGrey = {0.45, 0.46, 0.48}, kPale = {0.90, 0.90, 0.88};

std::pair<double, double> size_of(Paper paper) {
  constexpr std::array<std::pair<double, double>, 5> kSizes = {{{297, 210}, {420, 297}, {594, 420}, {841, 594}, {1189, 841}}};
  return kSizes[static_cast<std::size_t>(paper)];
}

class SheetMaker {
 public:
  SheetMaker(const Proposal& proposal, int level, const SheetOptions& options) : proposal_(proposal), options_(options) {
    std::tie(sheet_.width, sheet_.height) = size_of(options.paper);
    sheet_.level = level;
    sheet_.title = proposal.name() + ", level " + std::to_string(level);
    sheet_.window_low = {kMargin, kMargin};
    sheet_.window_high = {sheet_.width - kMargin, sheet_.height - kMargin - kTitleHeight};
  }

  Result<PlanSheet> make() {
    if (auto fit = choose_scale(); !fit) return fit.error();
    add_surroundings();
    add_lands();
    add_storeys();
    add_dimensions();
    add_title();
    add_legend();
    add_scale_bar();
    add_north();
    return std::move(sheet_);
  }

 private:
  double window_width() const { return sheet_.window_high.x - sheet_.window_low.x; }
  double window_height() const { return sheet_.window_high.y - sheet_.window_low.y; }
  double millimetres() const { return 1000 / sheet_.scale; }  // per metre

  Result<void> choose_scale() {
    const PlanExtent extent = plan_extent(proposal_);
    const double needed = std::max(1000 * (extent.high.x - extent.low.x) / (window_width() - 4 * kGap),
                                   1000 * (extent.high.y - extent.low.y) / (window_height() - 4 * kGap));
    const auto fit = std::find_if(kScales.begin(), kScales.end(), [&](double scale) { return scale >= needed; });
    const double best = fit == kScales.end() ? std::ceil(needed / 1e5) * 1e5 : *fit;
    if (options_.scale > 0 && options_.scale < needed)
      return Error{ErrorCode::out_of_range, "",
                   "the plan does not fit on the paper at 1:" + shortest(options_.scale) + "; 1:" + shortest(best) +
                       " does, or a larger paper"};
    sheet_.scale = options_.scale > 0 ? options_.scale : best;
    const double metres = sheet_.scale / 1000;
    const Point3 middle = 0.5 * (extent.low + extent.high);
    sheet_.origin = {middle.x - metres * window_width() / 2, middle.y + metres * window_height() / 2, 0};
    return {};
  }

  SheetPoint at(const Point3& p) const {
    return {sheet_.window_low.x + millimetres() * (p.x - sheet_.origin.x),
            sheet_.window_low.y + millimetres() * (sheet_.origin.y - p.y)};
  }
  std::vector<SheetPoint> line_of(const std::vector<Point3>& points) const {
    std::vector<SheetPoint> line;
    for (const Point3& p : points) line.push_back(at(p));
    return line;
  }
  SheetShape shape_of(const std::vector<geometry::PlateFace>& faces, const std::string& name) const {
    SheetShape shape;
    shape.name = name;
    for (const geometry::PlateFace& face : faces) {
      shape.lines.push_back(line_of(face.outer));
      for (const geometry::Ring& hole : face.holes) shape.lines.push_back(line_of(hole));
    }
    return shape;
  }

  void add_surroundings() {
    if (!options_.surroundings || (proposal_.neighbours.empty() && proposal_.streets.empty())) return;
    SheetGroup group{"surroundings", "Surroundings", true, {}, {}};
    for (const Street& street : proposal_.streets) {
      SheetShape line;
      line.lines = {line_of(street.line)};
      line.is_closed = false;
      line.stroke = kPale;
      line.width = std::max(0.5, 6 * millimetres());
      line.name = street.name;
      group.shapes.push_back(std::move(line));
    }
    for (const Neighbour& n : proposal_.neighbours) {
      SheetShape shape = shape_of({n.face}, n.name);
      shape.is_filled = true;
      shape.fill = kExistingFill;
      shape.stroke = kGrey;
      shape.width = 0.1;
      group.shapes.push_back(std::move(shape));
    }
    sheet_.groups.push_back(std::move(group));
  }

  void add_lands() {
    SheetGroup group{"plots", "Plots and boundary", true, {}, {}};
    for (const Land& land : proposal_.lands) {
      SheetShape shape = shape_of(land.faces, land.name);
      shape.is_dashed = land.is_boundary;
      shape.width = land.is_boundary ? 0.25 : 0.35;
      group.shapes.push_back(std::move(shape));
    }
    sheet_.groups.push_back(std::move(group));
  }

  // What the level cuts of buildings whose storey belongs to another level: their storeys are higher.
  const Storey* passing(const Building& building, double cut) const {
    for (const Storey& storey : building.storeys)
      if (storey.bottom <= cut && cut < storey.top) return &storey;
    return nullptr;
  }

  void add_storeys() {
    const double cut = proposal_.ground + (sheet_.level + 0.5) * proposal_.level_height;
    SheetGroup passed{"passing", "Storeys of other levels", true, {}, {}}, labels{"labels", "Labels", true, {}, {}};
    std::vector<SheetGroup> uses;
    for (const UseRow& use : proposal_.uses)
      uses.push_back({"use_" + to_identifier(use.use), use.use.empty() ? "no use" : use.use, true, {}, {}});
    uses.push_back({"use_other", "other", true, {}, {}});
    for (const Building& b : proposal_.buildings) {
      const auto own = std::find_if(b.storeys.begin(), b.storeys.end(), [&](const Storey& s) { return s.level == sheet_.level; });
      if (own == b.storeys.end()) {
        if (const Storey* storey = passing(b, cut)) {
          passed.shapes.push_back(shape_of(storey->faces, b.label));
          passed.shapes.back().stroke = kGrey;
          passed.shapes.back().is_filled = true;
          passed.shapes.back().fill = drawing::mix(b.colour, drawing::kWhite, 0.7);
          if (options_.labels) add_label(b, *storey, labels, false);
        }
        continue;
      }
      std::size_t place = 0;
      while (place < proposal_.uses.size() && proposal_.uses[place].use != b.use) ++place;
      SheetShape shape = shape_of(own->faces, b.label);
      shape.is_filled = true;
      shape.fill = b.colour;
      shape.width = 0.35;
      uses[place].shapes.push_back(std::move(shape));
      if (options_.labels) add_label(b, *own, labels);
    }
    sheet_.groups.push_back(std::move(passed));
    for (SheetGroup& group : uses)
      if (!group.shapes.empty()) sheet_.groups.push_back(std::move(group));
    sheet_.groups.push_back(std::move(labels));
  }

  // In a size that fits into the plate, as far as it can be read; else the area alone; else nothing: the schedule has it.
  void add_label(const Building& b, const Storey& storey, SheetGroup& labels, bool with_area = true) const {
    double low = 1e20, high = -1e20;
    for (const geometry::PlateFace& face : storey.faces)
      for (const Point3& p : face.outer) low = std::min(low, p.x), high = std::max(high, p.x);
    const double room = millimetres() * (high - low) * 0.9;
    // The area of a storey stands on one sheet only: where it is drawn in full.
    const std::string area = with_area ? fixed(storey.floor_area, 0) + " m²" : "(storey " + std::to_string(storey.number) + ")";
    const SheetPoint middle = at(middle_of(storey.faces));
    const auto width = [](const std::string& words) { return 0.55 * static_cast<double>(words.size()); };  // at a size of 1 mm
    const double size = std::min(2.5, room / std::max(width(b.label), width(area)));
    if (size >= 1.2) {
      labels.texts.push_back({{middle.x, middle.y - 0.2 * size}, size, SheetAnchor::middle, true, b.label});
      labels.texts.push_back({{middle.x, middle.y + 1.1 * size}, size, SheetAnchor::middle, false, area});
    } else if (const double small = std::min(2.0, room / width(area)); small >= 1.0) {
      labels.texts.push_back({{middle.x, middle.y + 0.35 * small}, small, SheetAnchor::middle, false, area});
    }
  }

  void dimension(SheetGroup& group, SheetPoint a, SheetPoint b, double length, bool is_upright) const {
    SheetShape line;
    line.is_closed = false;
    line.width = 0.13;
    const double dx = is_upright ? 1.2 : 0, dy = is_upright ? 0 : 1.2;
    line.lines = {{a, b}, {{a.x - dx, a.y - dy}, {a.x + dx, a.y + dy}}, {{b.x - dx, b.y - dy}, {b.x + dx, b.y + dy}}};
    group.shapes.push_back(std::move(line));
    const SheetPoint middle = {(a.x + b.x) / 2 + (is_upright ? 1.5 : 0), (a.y + b.y) / 2 - (is_upright ? 0 : 1)};
    group.texts.push_back({middle, 2.2, is_upright ? SheetAnchor::start : SheetAnchor::middle, false, fixed(length, 2)});
  }

  void add_dimensions() {
    const PlanExtent extent = plan_extent(proposal_);
    SheetGroup group{"dimensions", "Dimensions in metres", true, {}, {}};
    const SheetPoint low = at(extent.low), high = at(extent.high);
    dimension(group, {low.x, low.y + kGap}, {high.x, low.y + kGap}, extent.high.x - extent.low.x, false);
    dimension(group, {high.x + kGap, low.y}, {high.x + kGap, high.y}, extent.high.y - extent.low.y, true);
    sheet_.groups.push_back(std::move(group));
  }

  static std::vector<SheetPoint> rectangle(SheetPoint low, SheetPoint high) {
    return {low, {high.x, low.y}, high, {low.x, high.y}};
  }

  void add_title() {
    SheetGroup group{"title", "Title", false, {}, {}};
    SheetShape frame;
    frame.width = 0.35;
    frame.lines = {rectangle({kMargin, kMargin}, {sheet_.width - kMargin, sheet_.height - kMargin}),
                   rectangle({kMargin, sheet_.window_high.y}, {sheet_.width - kMargin, sheet_.height - kMargin})};
    group.shapes.push_back(std::move(frame));
    const double x = kMargin + 3, y = sheet_.window_high.y;
    const double bottom = proposal_.ground + sheet_.level * proposal_.level_height;
    group.texts.push_back({{x, y + 7}, 5, SheetAnchor::start, true, proposal_.name()});
    group.texts.push_back({{x, y + 13},
                           3.5,
                           SheetAnchor::start,
                           false,
                           "Level " + std::to_string(sheet_.level) + " of " + std::to_string(proposal_.levels) + ", from " +
                               fixed(bottom, 2) + " m · 1:" + shortest(sheet_.scale) + " · lengths in metres"});
    group.texts.push_back({{x, y + 19},
                           2.5,
                           SheetAnchor::start,
                           false,
                           proposal_.file + " · tick " + std::to_string(proposal_.tick) +
                               (proposal_.is_settled ? ", settled" : ", not settled") + " · hash " + proposal_.hash});
    const std::string place = place_text(proposal_);
    group.texts.push_back(
        {{x, y + 24}, 2.5, SheetAnchor::start, false, place.empty() ? "no place on Earth: metres of the scene" : place});
    double area = 0;
    for (const Building& b : proposal_.buildings)
      for (const Storey& s : b.storeys) area += s.level == sheet_.level ? s.floor_area : 0;
    group.texts.push_back(
        {{x, y + 30},
         2.5,
         SheetAnchor::start,
         false,
         "Floor area of this level " + fixed(area, 1) + " m², of all levels " + fixed(proposal_.all.floor_area, 1) + " m²"});
    sheet_.groups.push_back(std::move(group));
  }

  void add_legend() {
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
      group.texts.push_back(
          {{x + 6.5, y + 2.5}, 2.5, SheetAnchor::start, false, proposal_.uses[k].use.empty() ? "no use" : proposal_.uses[k].use});
    }
    sheet_.groups.push_back(std::move(group));
  }

  // Four parts of a round length, between 40 and 100 mm in all.
  void add_scale_bar() {
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
      group.texts.push_back(
          {{x + k * step, y + 5.5}, 2.5, SheetAnchor::middle, false, shortest(k * part) + (k == 4 ? " m" : "")});
    sheet_.groups.push_back(std::move(group));
  }

  void add_north() {
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

  static constexpr drawing::Colour kExistingFill = {0.83, 0.83, 0.81};
  const Proposal& proposal_;
  const SheetOptions& options_;
  PlanSheet sheet_;
};

}  // namespace

std::vector<Choice<Paper>> paper_choices() {
  return {{Paper::a4, "a4", "297 by 210 mm."},
          {Paper::a3, "a3", "420 by 297 mm."},
          {Paper::a2, "a2", "594 by 420 mm."},
          {Paper::a1, "a1", "841 by 594 mm."},
          {Paper::a0, "a0", "1189 by 841 mm."}};
}

Result<PlanSheet> plan_sheet(const Proposal& proposal, int level, const SheetOptions& options) {
  return SheetMaker(proposal, level, options).make();
}

}  // namespace bl::exporting
