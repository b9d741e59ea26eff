// Tables and sentences in a size that is read at arm's length: 11 points on A3.
#include "core/export/overview_sheet.h"

#include <algorithm>
#include <utility>

#include "core/base/text.h"
#include "core/drawing/palette.h"
#include "core/export/drawn_levels.h"
#include "core/export/sheet_frame.h"
#include "core/reading/figures.h"

namespace bl::exporting {

namespace {

// Words of a sentence in lines of at most so many bytes, which are letters or a little more; a longer word has its own line.
std::vector<std::string> lines_of_sentence(const std::string& sentence, std::size_t most) {
  std::vector<std::string> lines(1);
  for (std::size_t at = 0; at < sentence.size();) {
    const std::size_t end = std::min(sentence.find(' ', at), sentence.size());
    const std::string word = sentence.substr(at, end - at);
    if (!lines.back().empty() && lines.back().size() + 1 + word.size() > most) lines.emplace_back();
    lines.back() += (lines.back().empty() ? "" : " ") + word;
    at = end + 1;
  }
  return lines;
}

// What stands in the table of figures.
struct FigureLine {
  std::string name, got, wanted;
  bool is_head = false;
};

std::string percent_of(double share) { return fixed(100 * share, 0) + " %"; }

std::string limit_text(const std::optional<double>& limit, int decimals, const char* unit) {
  return limit ? "at most " + fixed(*limit, decimals) + unit : "";
}

void add_indices(double fsi, double gsi, double osr, double storeys, const Land& rules, std::vector<FigureLine>& lines) {
  lines.push_back({"FSI, floor area to land", fixed(fsi, 2), limit_text(rules.fsi_max, 2, "")});
  lines.push_back({"GSI, built ground to land", fixed(gsi, 2), limit_text(rules.gsi_max, 2, "")});
  lines.push_back({"OSR, open ground to floor area", fixed(osr, 2), ""});
  lines.push_back({"Storeys, floor area to built ground", fixed(storeys, 1), ""});
}

std::string goal_of(const Indicator& one) {
  const std::string kind = one.direction == "at_least" ? "at least " : one.direction == "at_most" ? "at most " : "about ";
  return kind + reading::readable(one.target) + (one.unit.empty() ? "" : " " + one.unit) +
         (one.status.empty() ? "" : ": " + one.status);
}

std::vector<FigureLine> figure_lines(const Proposal& proposal) {
  std::vector<FigureLine> lines;
  for (const Land& land : proposal.lands) {
    if (land.is_boundary) continue;
    lines.push_back({land.name + ", gross land", fixed(land.area, 0) + " m²", "", true});
    add_indices(land.fsi, land.gsi, land.osr, land.storeys, land, lines);
    lines.push_back({"Height", fixed(land.top, 1) + " m", limit_text(land.height_max, 1, " m")});
  }
  for (const NetGround& ground : proposal.grounds) {
    lines.push_back({ground.name + ", net land", fixed(ground.area, 0) + " m²",
                     ground.open_area > 0 ? "of it open space " + fixed(ground.open_area, 0) + " m²" : "", true});
    add_indices(ground.fsi, ground.gsi, ground.osr, ground.storeys, {}, lines);
  }
  if (!proposal.indicators.empty()) lines.push_back({"Goals", "", "", true});
  for (const Indicator& one : proposal.indicators)
    lines.push_back({one.name, reading::readable(one.value) + (one.unit.empty() ? "" : " " + one.unit), goal_of(one)});
  if (!proposal.suns.empty()) lines.push_back({"Sun on open ground", "", "", true});
  for (const SunPlace& sun : proposal.suns)
    lines.push_back({sun.name + ", area with " + fixed(sun.required_hours, 1) + " h", percent_of(sun.share),
                     "at least " + percent_of(sun.required_share) + (sun.is_met() ? ": met" : ": short")});
  return lines;
}

class OverviewMaker : SheetFrame {
 public:
  OverviewMaker(const Proposal& proposal, const SheetOptions& options, double scale) : SheetFrame(proposal, options) {
    sheet_.title = proposal.name() + ", overview";
    sheet_.scale = scale;
    unit_ = std::clamp(sheet_.width / 420, 0.7, 1.5);
    left_ = sheet_.window_low.x + 6 * unit_;
    width_ = window_width() - 12 * unit_;
  }

  PlanSheet make() {
    const auto cellars = static_cast<std::size_t>(cellar_levels(proposal_));
    add_title(
        "Overview, and plans of " + reading::counted(static_cast<std::size_t>(proposal_.levels), "level") +
            (cellars > 0 ? " and " + reading::counted(cellars, "cellar") : ""),
        "Floor area " + fixed(proposal_.all.floor_area, 1) + " m² of " + fixed(proposal_.all.asked_area, 1) + " m² asked for");
    const double below = add_programme(sheet_.window_low.y + 10 * unit_) + 10 * unit_;
    add_figures(below);
    add_problems(below);
    return std::move(sheet_);
  }

 private:
  double pitch() const { return 6.4 * unit_; }
  double size() const { return 4 * unit_; }
  double end() const { return sheet_.window_high.y - 4 * unit_; }

  void write(SheetGroup& group, double x, double y, std::string words, double room, bool is_bold = false) const {
    group.texts.push_back(fitted({x, y}, size(), is_bold, std::move(words), room));
  }
  void number(SheetGroup& group, double x, double y, std::string words, bool is_bold = false) const {
    group.texts.push_back({{x, y}, size(), SheetAnchor::end, is_bold, std::move(words)});
  }
  void head(SheetGroup& group, double x, double y, std::string words) const {
    group.texts.push_back({{x, y}, 1.3 * size(), SheetAnchor::start, true, std::move(words)});
  }
  void rule(SheetGroup& group, double from, double to, double y) const {
    SheetShape line;
    line.is_closed = false;
    line.lines = {{{from, y}, {to, y}}};
    line.stroke = kGrey;
    group.shapes.push_back(std::move(line));
  }
  void patch(SheetGroup& group, double y, const drawing::Colour& colour) const {
    SheetShape box;
    box.lines = {rectangle({left_, y - 0.8 * size()}, {left_ + 1.4 * size(), y + 0.1 * size()})};
    box.is_filled = true;
    box.fill = colour;
    group.shapes.push_back(std::move(box));
  }

  // Where the columns of numbers end, as a share of the width.
  double column(int k) const {
    constexpr double kEnds[] = {0.36, 0.48, 0.59, 0.71, 0.78, 0.89, 1};
    return left_ + kEnds[k] * width_;
  }
  double name_left() const { return left_ + 2 * size(); }

  void programme_row(SheetGroup& table, double y, const std::string& name, const UseRow& use, bool is_bold) const {
    write(table, name_left(), y, name, 0.28 * width_ - 2 * size(), is_bold);
    number(table, column(0), y, std::to_string(use.buildings), is_bold);
    number(table, column(1), y, fixed(use.asked_area, 1), is_bold);
    number(table, column(2), y, fixed(use.floor_area, 1), is_bold);
    number(table, column(3), y, fixed(use.floor_area - use.asked_area, 1), is_bold);
    number(table, column(4), y, use.asked_area > 0 ? percent_of(use.floor_area / use.asked_area) : "", is_bold);
    number(table, column(5), y, fixed(use.asked_volume, 1), is_bold);
    number(table, column(6), y, fixed(use.volume, 1), is_bold);
  }

  // Returns where it ends. At most two thirds of the sheet: what has no place is in the tables of xlsx and csv.
  double add_programme(double y) {
    SheetGroup table{"schedule", "Programme", false, {}, {}};
    head(table, left_, y, "Programme");
    y += 1.4 * pitch();
    const char* heads[] = {"Volumes", "asked m²", "floor m²", "difference m²", "met", "asked m³", "volume m³"};
    write(table, name_left(), y, "Use", 0.2 * width_, true);
    for (int k = 0; k < 7; ++k) number(table, column(k), y, heads[k], true);
    rule(table, left_, left_ + width_, y + 0.4 * size());
    y += 1.1 * pitch();
    const double room = sheet_.window_low.y + 0.66 * window_height() - y;
    const auto rows = static_cast<std::size_t>(std::max(1.0, room / pitch() - 3));
    for (std::size_t k = 0; k < std::min(rows, proposal_.uses.size()); ++k, y += pitch()) {
      patch(table, y, proposal_.uses[k].colour);
      programme_row(table, y, use_name(proposal_.uses[k].use), proposal_.uses[k], false);
    }
    if (rows < proposal_.uses.size()) {
      write(table, name_left(), y, "and " + std::to_string(proposal_.uses.size() - rows) + " more uses", 0.28 * width_);
      y += pitch();
    }
    rule(table, left_, left_ + width_, y - pitch() + 0.4 * size());
    programme_row(table, y, "all", proposal_.all, true);
    y += pitch();
    add_open_rows(table, y);
    add_cellar_row(table, y);
    sheet_.groups.push_back(std::move(table));
    return y;
  }

  void add_open_rows(SheetGroup& table, double& y) const {
    const double last = sheet_.window_low.y + 0.72 * window_height();
    for (const OpenSpace& open : proposal_.open_spaces) {
      if (y > last) break;
      patch(table, y, open.colour);
      write(table, name_left(), y, open.use + ", open space", 0.28 * width_ - 2 * size());
      number(table, column(1), y, fixed(open.asked_area, 1));
      number(table, column(2), y, fixed(open.area, 1));
      number(table, column(3), y, fixed(open.area - open.asked_area, 1));
      y += pitch();
    }
  }

  void add_cellar_row(SheetGroup& table, double& y) const {
    UseRow below;
    for (const Building& b : proposal_.buildings) {
      for (const Storey& s : b.cellars) below.floor_area += s.floor_area;
      below.buildings += b.cellars.empty() ? 0 : 1;
    }
    if (below.buildings == 0) return;
    write(table, name_left(), y, "cellars, not counted above", 0.28 * width_ - 2 * size());
    number(table, column(0), y, std::to_string(below.buildings));
    number(table, column(2), y, fixed(below.floor_area, 1));
    y += pitch();
  }

  void add_figures(double y) {
    const std::vector<FigureLine> lines = figure_lines(proposal_);
    if (lines.empty()) return;
    SheetGroup group{"figures", "Figures of the land, and goals", false, {}, {}};
    const double got = left_ + 0.36 * width_, wanted = left_ + 0.38 * width_;
    head(group, left_, y, "Figures");
    y += 1.4 * pitch();
    number(group, got, y, "got", true);
    write(group, wanted, y, "wanted", 0.16 * width_, true);
    y += 0.3 * pitch();
    for (std::size_t k = 0; k < lines.size(); ++k) {
      y += lines[k].is_head ? 1.15 * pitch() : 0.92 * pitch();
      if (y + pitch() > end() && k + 1 < lines.size()) {
        write(group, left_, y, "and " + std::to_string(lines.size() - k) + " more lines; the format xlsx has them", 0.5 * width_);
        break;
      }
      write(group, left_, y, lines[k].name, 0.27 * width_, lines[k].is_head);
      number(group, got, y, lines[k].got, lines[k].is_head);
      write(group, wanted, y, lines[k].wanted, 0.18 * width_);
    }
    sheet_.groups.push_back(std::move(group));
  }

  // Names stand without the marks that programs put around them.
  static std::string plain(std::string text) {
    std::erase(text, '`');
    return text;
  }

  void add_problems(double y) {
    SheetGroup group{"problems", "Problems", false, {}, {}};
    const double x = left_ + 0.6 * width_, room = 0.4 * width_;
    head(group, x, y, "Problems");
    y += 1.4 * pitch();
    std::vector<std::string> sentences;
    if (!proposal_.is_settled) sentences.push_back("The proposal has not settled: its figures may still change.");
    for (const Trouble& one : proposal_.troubles)
      sentences.push_back(plain((one.place.empty() ? "" : one.place + ": ") + one.message));
    if (proposal_.troubles.empty()) sentences.push_back("Nothing fails, and nothing that was asked for is missing.");
    const double small = 0.9 * size(), step = 1.35 * small;
    for (std::size_t k = 0; k < sentences.size(); ++k) {
      const std::vector<std::string> lines = lines_of_sentence(sentences[k], letters_within(room, small));
      const bool is_last = k + 1 == sentences.size();
      if (y + step * static_cast<double>(lines.size() + (is_last ? 0 : 1)) > end()) {
        write(group, x, y, "and " + std::to_string(sentences.size() - k) + " more; the format xlsx has all", room, true);
        break;
      }
      for (const std::string& line : lines) {
        group.texts.push_back(fitted({x, y}, small, false, line, room));
        y += step;
      }
      y += 0.4 * step;
    }
    sheet_.groups.push_back(std::move(group));
  }

  double unit_ = 1, left_ = 0, width_ = 0;  // of A3; [mm]
};

}  // namespace

PlanSheet overview_sheet(const Proposal& proposal, const SheetOptions& options, double scale) {
  return OverviewMaker(proposal, options, scale).make();
}

}  // namespace bl::exporting
