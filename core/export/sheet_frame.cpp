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

// Those that architects' rulers have, and ten times as much.
constexpr std::array<double, 21> kScales = {50,   75,   100,  125,  200,  250,  300,   400,   500,   750,   1000,
                                            1250, 2000, 2500, 3000, 4000, 5000, 10000, 20000, 50000, 100000};

std::pair<double, double> size_of(Paper paper) {
  constexpr std::array<std::pair<double, double>, 5> kSizes = {{{297, 210}, {420, 297}, {594, 420}, {841, 594}, {1189, 841}}};
  return kSizes[static_cast<std::size_t>(paper)];
}

// Letters are about so wide, as a share of their size.
constexpr double kLetter = 0.55, kBoldLetter = 0.6;
constexpr double kSmallestText = 1.8;  // [mm]

std::size_t letters_in(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

// A projection that was made for the site says nothing that its middle does not; the files for programs have it in full.
std::string place_on_paper(const Proposal& proposal) {
  const std::string place = place_text(proposal);
  if (place.empty()) return "no place on Earth: metres of the scene";
  if (!proposal.reference.crs.starts_with("+")) return place;
  return fixed(proposal.reference.latitude, 6) + "°, " + fixed(proposal.reference.longitude, 6) +
         "°: metres around that place (transverse Mercator, WGS84)";
}

}  // namespace

SheetText SheetFrame::fitted(SheetPoint place, double size, bool is_bold, std::string text, double room) {
  const double letter = is_bold ? kBoldLetter : kLetter;
  const double whole = letter * static_cast<double>(letters_in(text));
  double fit = std::min(size, room / std::max(whole, 1e-9));
  if (fit < std::min(size, kSmallestText)) {
    fit = std::min(size, kSmallestText);
    const auto most = static_cast<std::size_t>(std::max(1.0, room / (letter * fit) - 1));
    while (letters_in(text) > most) {
      while (text.size() > 1 && (static_cast<unsigned char>(text.back()) & 0xC0) == 0x80) text.pop_back();
      text.pop_back();
    }
    text += "…";
  }
  return {place, fit, SheetAnchor::start, is_bold, std::move(text)};
}

std::size_t SheetFrame::letters_within(double room, double size) {
  return static_cast<std::size_t>(std::max(1.0, room / (kLetter * size)));
}

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
  // Room for dimensions on either side.
  const double needed = std::max(1000 * width / (window_width() - 3 * kGap), 1000 * height / (window_height() - 3 * kGap));
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
  // An upright one is written below the middle, where the letter of a section stands.
  const SheetPoint middle = {(a.x + b.x) / 2 + (is_upright ? 1.5 : 0), is_upright ? 0.4 * a.y + 0.6 * b.y : (a.y + b.y) / 2 - 1};
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
  const double x = kMargin + 3, y = sheet_.window_high.y, room = legend_left() - x - 3;
  const auto write = [&](double down, double size, bool is_bold, const std::string& text) {
    group.texts.push_back(fitted({x, y + down}, size, is_bold, text, room));
  };
  write(7, 5, true, proposal_.name());
  write(13, 3.5, false, what + " · 1:" + shortest(sheet_.scale) + " · lengths in metres");
  write(19, 2.5, false,
        proposal_.file + " · tick " + std::to_string(proposal_.tick) + (proposal_.is_settled ? ", settled" : ", not settled") +
            " · hash " + proposal_.hash);
  write(24, 2.5, false, place_on_paper(proposal_));
  write(30, 2.5, false, figures + ". Volumes are drawn and measured " + reading::choice_of(proposal_.form).measured);
  sheet_.groups.push_back(std::move(group));
}

void SheetFrame::add_legend(bool with_ground) {
  std::vector<std::pair<drawing::Colour, std::string>> rows;
  for (const UseRow& use : proposal_.uses) rows.emplace_back(use.colour, use_name(use.use));
  if (with_ground) {
    for (const OpenSpace& open : proposal_.open_spaces)
      if (!open.faces.empty()) rows.emplace_back(open_fill(open.colour), open.use + ", open");
    for (const KeptGround& kept : proposal_.kept) rows.emplace_back(kPale, kept.kind + ", kept clear");
  }
  SheetGroup group{"legend", "Uses", false, {}, {}};
  // Two columns of six as long as they do; then three of nine in smaller writing, the last of which says what is left over.
  const bool is_dense = rows.size() > 12;
  const std::size_t columns = is_dense ? 3 : 2, lines = is_dense ? 9 : 6, most = columns * lines;
  const double pitch = 30.0 / static_cast<double>(lines), size = is_dense ? 2 : 2.5;
  const double width = 0.26 * (sheet_.width - 2 * kMargin) / static_cast<double>(columns);
  for (std::size_t k = 0; k < std::min(rows.size(), most); ++k) {
    const double x = legend_left() + width * static_cast<double>(k / lines),
                 y = sheet_.window_high.y + 2.5 + pitch * static_cast<double>(k % lines);
    if (rows.size() > most && k + 1 == most) {
      group.texts.push_back({{x, y + size}, size, SheetAnchor::start, false, "and " + std::to_string(rows.size() - k) + " more"});
      break;
    }
    SheetShape patch;
    patch.lines = {rectangle({x, y}, {x + 2 * size, y + 1.2 * size})};
    patch.is_filled = true;
    patch.fill = rows[k].first;
    group.shapes.push_back(std::move(patch));
    group.texts.push_back(fitted({x + 2.6 * size, y + size}, size, false, rows[k].second, width - 2.6 * size - 1));
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
