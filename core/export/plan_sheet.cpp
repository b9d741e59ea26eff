// Lays out one level: the plan in a window, in the frame that all sheets share.
#include "core/export/plan_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "core/base/text.h"
#include "core/export/drawn_levels.h"
#include "core/export/plan_places.h"
#include "core/export/read_proposal.h"
#include "core/export/section.h"
#include "core/export/sheet_frame.h"

namespace bl::exporting {

namespace {

class PlanMaker : SheetFrame {
 public:
  PlanMaker(const Proposal& proposal, const DrawnLevel& level, const SheetOptions& options)
      : SheetFrame(proposal, options), level_(level) {
    sheet_.level = level.number;
    sheet_.title = proposal.name() + ", " + level.name();
  }
  /// What a plane at that height cuts [m].
  PlanMaker(const Proposal& proposal, double height, const SheetOptions& options)
      : SheetFrame(proposal, options), height_(height) {
    sheet_.title = proposal.name() + ", level cut";
  }

  Result<PlanSheet> make() {
    const bool is_all = options_.extent == DrawnExtent::all && options_.surroundings;
    const PlanExtent extent = is_all ? whole_extent(proposal_) : plan_extent(proposal_);
    if (auto fit = choose_scale(extent.high.x - extent.low.x, extent.high.y - extent.low.y, options_.scale, "plan"); !fit)
      return fit.error();
    const double metres = sheet_.scale / 1000;
    const Point3 middle = 0.5 * (extent.low + extent.high);
    sheet_.origin = {middle.x - metres * window_width() / 2, middle.y + metres * window_height() / 2, 0};
    add_kept();
    add_surroundings();
    add_lands();
    add_open_spaces();
    add_storeys();
    add_dimensions();
    if (height_) {
      add_cut_title();
    } else {
      if (auto marked = mark_section(); !marked) return marked.error();
      add_level_title();
    }
    add_legend(true);
    add_scale_bar();
    add_north();
    return std::move(sheet_);
  }

 private:
  Result<void> mark_section() {
    if (options_.section != "none" && !level_cut(options_.section)) {
      const auto line = section_line(proposal_, options_.section == "auto" ? "" : options_.section);
      if (!line) return line.error();
      add_section_line(*line);
    }
    return {};
  }

  void add_level_title() {
    const std::string area = fixed(level_.area, 1) + " m²";
    const int last = level_.is_cellar() ? cellar_levels(proposal_) : proposal_.levels - 1;
    double cellars = 0;
    for (const Building& b : proposal_.buildings)
      for (const Storey& s : b.cellars) cellars += s.floor_area;
    add_title(level_.name() + " of " + std::to_string(last) + ", " + level_.heights(),
              level_.is_cellar()
                  ? "Area of this cellar " + area + ", of all cellars " + fixed(cellars, 1) + " m², no part of the floor area"
                  : "Floor area of this level " + area + ", of all levels " + fixed(proposal_.all.floor_area, 1) + " m²");
  }

  void add_cut_title() {
    double area = 0;
    std::size_t cut = 0;
    for (const Building& b : proposal_.buildings) {
      const LevelPart part = level_part(b, *height_);
      area += area_of(part.faces);
      cut += part.faces.empty() ? 0 : 1;
    }
    add_title("Level cut at " + std::string(*height_ >= 0 ? "+" : "") + fixed(*height_, 2) + " m",
              "Volumes cut: " + std::to_string(cut) + "; their area at this height " + fixed(area, 1) + " m²");
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

  // Below all else: streets are drawn upon their ground.
  void add_kept() {
    if (proposal_.kept.empty()) return;
    SheetGroup group{"kept_clear", "Ground kept clear", true, {}, {}};
    for (const KeptGround& kept : proposal_.kept)
      for (const geometry::PlateFace& face : kept.faces) {
        SheetShape shape = shape_of({face}, kept.kind);
        shape.is_filled = true;
        shape.fill = kPale;
        shape.is_stroked = false;
        group.shapes.push_back(std::move(shape));
      }
    sheet_.groups.push_back(std::move(group));
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

  // Nothing is built on them at any level.
  void add_open_spaces() {
    if (proposal_.open_spaces.empty()) return;
    SheetGroup group{"open_space", "Open space", true, {}, {}};
    for (const OpenSpace& open : proposal_.open_spaces)
      for (const geometry::PlateFace& face : open.faces) {
        SheetShape shape = shape_of({face}, open.use);
        shape.is_filled = true;
        shape.fill = open_fill(open.colour);
        shape.stroke = drawing::mix(open.colour, drawing::kInk, 0.4);
        group.shapes.push_back(std::move(shape));
        if (options_.labels) add_open_label(open.use, face, group);
      }
    sheet_.groups.push_back(std::move(group));
  }

  void add_open_label(const std::string& use, const geometry::PlateFace& face, SheetGroup& group) {
    const LabelPlace place = label_place({face});
    const double longest = 0.58 * static_cast<double>(use.size());
    const double size = std::min({2.5, 0.9 * millimetres() * place.width / longest, 0.9 * millimetres() * place.height});
    const SheetPoint middle = at(place.middle);
    if (size >= 1.2 && takes_place(middle, size * longest, size))
      group.texts.push_back({{middle.x, middle.y + 0.35 * size}, size, SheetAnchor::middle, false, use});
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
    std::vector<std::pair<const Building*, const Storey*>> own_labels, passing_labels;
    std::vector<SheetGroup> uses;
    for (const UseRow& use : proposal_.uses) uses.push_back({"use_" + to_identifier(use.use), use_name(use.use), true, {}, {}});
    uses.push_back({"use_other", "other", true, {}, {}});
    for (const Building& b : proposal_.buildings) {
      if (height_) {
        add_cut(b, uses[proposal_.use_number(b.use)], labels);
        continue;
      }
      const Storey* own = nullptr;
      for (const Storey* storey : drawn_storeys(b))
        if (storey->level == sheet_.level) own = storey;
      if (own == nullptr) {
        if (const Storey* storey = level_.is_cellar() ? nullptr : passing(b, cut)) {
          passed.shapes.push_back(shape_of(storey->faces, b.label));
          passed.shapes.back().stroke = kGrey;
          passed.shapes.back().is_filled = true;
          passed.shapes.back().fill = drawing::mix(b.colour, drawing::kWhite, 0.7);
          passing_labels.emplace_back(&b, storey);
        }
        continue;
      }
      SheetShape shape = shape_of(own->faces, b.label);
      shape.is_filled = true;
      shape.fill = b.colour;
      shape.width = 0.35;
      uses[proposal_.use_number(b.use)].shapes.push_back(std::move(shape));
      own_labels.emplace_back(&b, own);
    }
    if (options_.labels) {
      // Where two would cross, the larger storey keeps its words; those of other levels come last.
      std::stable_sort(own_labels.begin(), own_labels.end(),
                       [](const auto& a, const auto& c) { return a.second->floor_area > c.second->floor_area; });
      for (const auto& [building, storey] : own_labels) add_label(*building, *storey, labels);
      for (const auto& [building, storey] : passing_labels) add_label(*building, *storey, labels, false);
    }
    sheet_.groups.push_back(std::move(passed));
    for (SheetGroup& group : uses)
      if (!group.shapes.empty()) sheet_.groups.push_back(std::move(group));
    sheet_.groups.push_back(std::move(labels));
  }

  void add_cut(const Building& b, SheetGroup& use, SheetGroup& labels) {
    const LevelPart part = level_part(b, *height_);
    if (part.faces.empty()) return;
    SheetShape shape = shape_of(part.faces, b.label);
    shape.is_filled = true;
    shape.fill = b.colour;
    shape.width = 0.5;  // heavier than a plan: it is a cut
    use.shapes.push_back(std::move(shape));
    Storey cut = *part.storey;
    cut.faces = part.faces;
    if (options_.labels) add_label(b, cut, labels, *height_ < cut.top);
  }

  // In a size that fits into the plate, as far as it can be read and nothing else is written there; else the area alone; else
  // nothing: the schedule has it.
  void add_label(const Building& b, const Storey& storey, SheetGroup& labels, bool with_area = true) {
    const LabelPlace place = label_place(storey.faces);
    const double room = millimetres() * place.width * 0.9, high = millimetres() * place.height * 0.9;
    // The area of a storey stands on one sheet only: where it is drawn in full.
    const std::string area = with_area ? fixed(storey.floor_area, 0) + " m²" : "(storey " + std::to_string(storey.number) + ")";
    const SheetPoint middle = at(place.middle);
    const auto width = [](const std::string& words) { return 0.58 * static_cast<double>(words.size()); };  // at a size of 1 mm
    const double longest = std::max(width(b.label), width(area)), most = std::min({2.5, room / longest, high / kTwoLines});
    for (const double size : {most, std::min(most, 1.6)}) {
      if (size < 1.2 || !takes_place(middle, size * longest, size * kTwoLines)) continue;
      labels.texts.push_back({{middle.x, middle.y - 0.2 * size}, size, SheetAnchor::middle, true, b.label});
      labels.texts.push_back({{middle.x, middle.y + 1.1 * size}, size, SheetAnchor::middle, false, area});
      return;
    }
    if (const double small = std::min({2.0, room / width(area), high});
        small >= 1.0 && takes_place(middle, small * width(area), small))
      labels.texts.push_back({{middle.x, middle.y + 0.35 * small}, small, SheetAnchor::middle, false, area});
  }

  // Is nothing written there yet? Then something is from now on.
  bool takes_place(SheetPoint middle, double width, double height) {
    const std::array<double, 4> box{middle.x - width / 2, middle.y - height / 2, middle.x + width / 2, middle.y + height / 2};
    for (const auto& other : written_)
      if (box[0] < other[2] && other[0] < box[2] && box[1] < other[3] && other[1] < box[3]) return false;
    written_.push_back(box);
    return true;
  }

  void add_dimensions() {
    const PlanExtent extent = plan_extent(proposal_);
    SheetGroup group{"dimensions", "Dimensions in metres", true, {}, {}};
    const SheetPoint low = at(extent.low), high = at(extent.high);
    dimension(group, {low.x, low.y + kGap}, {high.x, low.y + kGap}, extent.high.x - extent.low.x, false);
    dimension(group, {high.x + kGap, low.y}, {high.x + kGap, high.y}, extent.high.y - extent.low.y, true);
    sheet_.groups.push_back(std::move(group));
  }

  // Where the section is cut: the ends of the line with its letter, so that no label is struck out.
  void add_section_line(const SectionLine& line) {
    const Section section = section_of(proposal_, line, false);
    const Vector3 way = (line.to - line.from) / distance(line.from, line.to);
    const double reach = 0.8 * kGap / millimetres();
    SheetGroup group{"section_line", "Where the section is cut", true, {}, {}};
    SheetShape shape;
    shape.is_closed = false;
    shape.width = 0.5;
    const Vector3 end = (8 / millimetres()) * way;
    const Point3 low = line.from + (section.low.x - reach) * way, high = line.from + (section.high.x + reach) * way;
    shape.lines = {{at(low), at(low + end)}, {at(high - end), at(high)}};
    group.shapes.push_back(std::move(shape));
    for (const SheetPoint& place : {at(low), at(high)})
      group.texts.push_back({{place.x, place.y - 1}, 3, SheetAnchor::middle, true, "A"});
    sheet_.groups.push_back(std::move(group));
  }

  std::optional<double> height_;  // of a level cut [m]; none: the sheet shows a level
  DrawnLevel level_;
  static constexpr double kTwoLines = 2.4;      // high, as a share of the size of their letters
  std::vector<std::array<double, 4>> written_;  // what labels cover: left, top, right and bottom [mm]
};

}  // namespace

Result<PlanSheet> level_cut_sheet(const Proposal& proposal, double height, const SheetOptions& options) {
  if (auto met = check_level_cut(proposal, height); !met) return met.error();
  return PlanMaker(proposal, height, options).make();
}

Result<PlanSheet> plan_sheet(const Proposal& proposal, const DrawnLevel& level, const SheetOptions& options) {
  return PlanMaker(proposal, level, options).make();
}

}  // namespace bl::exporting
