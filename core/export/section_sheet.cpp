// Lays out a section: what is cut in the colours of uses with floors and roofs, what stands behind it pale, heights at the side.
#include <algorithm>
#include <cmath>

#include "core/base/text.h"
#include "core/export/section.h"
#include "core/export/sheet_frame.h"

namespace bl::exporting {

namespace {

class SectionMaker : SheetFrame {
 public:
  SectionMaker(const Proposal& proposal, const SheetOptions& options, const SectionLine& line)
      : SheetFrame(proposal, options), section_(section_of(proposal, line, options.surroundings)) {
    sheet_.title = proposal.name() + ", section A";
  }

  Result<PlanSheet> make() {
    if (auto shown = check_section(section_); !shown) return shown.error();
    const double width = section_.high.x - section_.low.x, height = section_.high.y - section_.low.y;
    // Beside it, room for heights.
    if (auto fit = choose_scale(width * 1.12, height * 1.1, options_.scale, "section"); !fit) return fit.error();
    const double metres = sheet_.scale / 1000;
    sheet_.origin = {(section_.low.x + section_.high.x) / 2 - metres * window_width() / 2,
                     (section_.low.y + section_.high.y) / 2 + metres * window_height() / 2, 0};
    add_beyond();
    add_grounds();
    add_cuts();
    add_heights();
    add_widths();
    const auto cut = std::count_if(section_.parts.begin(), section_.parts.end(),
                                   [](const SectionPart& part) { return part.building != nullptr && !part.cut.empty(); });
    const SectionLine& line = section_.line;
    add_title("Section A, from " + place(line.from) + " towards " + place(line.to),
              "Buildings cut: " + std::to_string(cut) + "; floors and roofs drawn " + shortest(kSectionSlab) + " m thick");
    add_legend(false);
    add_scale_bar();
    return std::move(sheet_);
  }

 private:
  static std::string place(const Point3& p) { return "(" + fixed(p.x, 1) + ", " + fixed(p.y, 1) + ")"; }

  SheetShape shape_of(const std::vector<geometry::Ring>& rings, const std::string& name) const {
    SheetShape shape;
    shape.name = name;
    for (const geometry::Ring& ring : rings) shape.lines.push_back(line_of(ring));
    return shape;
  }

  void add_beyond() {
    SheetGroup group{"beyond", "What stands behind the cut", true, {}, {}};
    for (const SectionPart& part : section_.parts)
      for (const geometry::Ring& ring : part.beyond) {
        // Each ring by itself: where they lie on one another the even-odd rule would leave holes.
        SheetShape shape = shape_of({ring}, part.building ? part.building->label : "Existing building");
        shape.is_filled = true;
        shape.fill = part.building ? drawing::mix(part.building->colour, drawing::kWhite, 0.75) : kPale;
        shape.stroke = kGrey;
        shape.width = 0.1;
        group.shapes.push_back(std::move(shape));
      }
    sheet_.groups.push_back(std::move(group));
  }

  void add_grounds() {
    SheetGroup group{"ground", "Ground and borders of plots", true, {}, {}};
    for (const auto& line : section_.grounds) {
      SheetShape shape;
      shape.lines = {line_of(line)};
      shape.is_closed = false;
      shape.width = 0.7;
      group.shapes.push_back(std::move(shape));
    }
    for (const double border : section_.borders) {
      SheetShape shape;
      shape.lines = {{at({border, section_.low.y, 0}), at({border, section_.high.y, 0})}};
      shape.is_closed = false;
      shape.is_dashed = true;
      shape.width = 0.13;
      group.shapes.push_back(std::move(shape));
    }
    sheet_.groups.push_back(std::move(group));
  }

  void add_cuts() {
    SheetGroup cellars{"cellars", "Cellars that are cut", true, {}, {}}, cut{"cut", "What is cut", true, {}, {}},
        slabs{"slabs", "Floors and roofs", true, {}, {}}, labels{"labels", "Labels", true, {}, {}};
    for (const SectionPart& part : section_.parts) {
      for (const geometry::Ring& ring : part.cut) {
        SheetShape shape = shape_of({ring}, part.building ? part.building->label : "Existing building");
        shape.is_filled = true;
        shape.fill = part.building ? part.building->colour : kExistingFill;
        shape.stroke = part.building ? drawing::kInk : kGrey;
        shape.width = part.building ? 0.35 : 0.13;
        cut.shapes.push_back(std::move(shape));
      }
      // Paler, since it is no floor area.
      for (const geometry::Ring& ring : part.cellars) {
        SheetShape shape = shape_of({ring}, part.building->label + ", cellar");
        shape.is_filled = true;
        shape.fill = drawing::mix(part.building->colour, drawing::kWhite, 0.55);
        shape.width = 0.35;
        cellars.shapes.push_back(std::move(shape));
      }
      for (const geometry::Ring& ring : part.slabs) {
        SheetShape shape = shape_of({ring}, "");
        shape.is_filled = true;
        shape.fill = drawing::kInk;
        shape.is_stroked = false;
        slabs.shapes.push_back(std::move(shape));
      }
      if (options_.labels && part.building && !part.cut.empty()) add_label(part, labels);
    }
    for (SheetGroup* group : {&cellars, &cut, &slabs, &labels}) sheet_.groups.push_back(std::move(*group));
  }

  // Above the roof, where it does not reach beyond the building.
  void add_label(const SectionPart& part, SheetGroup& labels) const {
    double left = 1e20, right = -1e20, top = -1e20;
    for (const geometry::Ring& ring : part.cut)
      for (const Point3& p : ring) left = std::min(left, p.x), right = std::max(right, p.x), top = std::max(top, p.y);
    const std::string& name = part.building->label;
    const double size =
        std::min(2.5, millimetres() * (right - left) / (0.55 * static_cast<double>(std::max<std::size_t>(1, name.size()))));
    const SheetPoint middle = at({(left + right) / 2, top, 0});
    if (size >= 1.2) labels.texts.push_back({{middle.x, middle.y - 1.2}, size, SheetAnchor::middle, true, name});
  }

  // As far apart as they can be read: the highest, that of the ground and the lowest before all others.
  void add_heights() {
    SheetGroup group{"heights", "Heights in metres above the origin", true, {}, {}};
    constexpr double kApart = 3.2;  // [mm]
    const double x = at(section_.low).x - kGap;
    std::vector<double> heights = section_.heights;
    if (heights.empty()) heights = {section_.low.y, section_.high.y};
    const auto on_ground = std::find_if(heights.begin(), heights.end(), [&](double h) { return h >= proposal_.ground - 0.01; });
    std::vector<double> ranked{heights.back(), on_ground == heights.end() ? heights.front() : *on_ground, heights.front()};
    ranked.insert(ranked.end(), heights.begin(), heights.end());
    std::vector<double> written;  // [mm]
    for (const double height : ranked) {
      const double y = at({0, height, 0}).y;
      if (std::any_of(written.begin(), written.end(), [&](double other) { return std::abs(other - y) < kApart; })) continue;
      written.push_back(y);
      SheetShape tick;
      tick.is_closed = false;
      tick.width = 0.13;
      tick.lines = {{{x - 2, y}, {x + 2, y}}};
      group.shapes.push_back(std::move(tick));
      group.texts.push_back({{x - 3, y + 0.8}, 2.2, SheetAnchor::end, false, (height >= 0 ? "+" : "") + fixed(height, 2)});
    }
    SheetShape axis;
    axis.is_closed = false;
    axis.width = 0.13;
    axis.lines = {{{x, at({0, heights.front(), 0}).y}, {x, at({0, heights.back(), 0}).y}}};
    group.shapes.push_back(std::move(axis));
    sheet_.groups.push_back(std::move(group));
  }

  void add_widths() {
    SheetGroup group{"dimensions", "Dimensions in metres", true, {}, {}};
    const SheetPoint low = at(section_.low), high = at({section_.high.x, section_.low.y, 0});
    dimension(group, {low.x, low.y + kGap}, {high.x, high.y + kGap}, section_.high.x - section_.low.x, false);
    sheet_.groups.push_back(std::move(group));
  }

  Section section_;
};

}  // namespace

Result<PlanSheet> section_sheet(const Proposal& proposal, const SheetOptions& options) {
  if (const auto height = level_cut(options.section)) return level_cut_sheet(proposal, *height, options);
  const auto line = section_line(proposal, options.section == "auto" ? "" : options.section);
  if (!line) return line.error();
  return SectionMaker(proposal, options, *line).make();
}

}  // namespace bl::exporting
