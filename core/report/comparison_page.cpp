// The page of a comparison: both drawings, bars of what differs most, and every number.
#include <algorithm>
#include <cmath>

#include "core/drawing/furniture.h"
#include "core/reading/figures.h"
#include "core/report/comparison.h"
#include "core/report/page.h"

namespace bl::report {

namespace {

constexpr std::size_t kMostBars = 40;
constexpr double kPageWidth = 1000, kLine = 22, kLabels = 400, kFigures = 190;
constexpr double kBarTextSize = 10;  // of the class `figure` [px]

std::string who(const IndicatorRow& row) { return row.name.empty() ? "All" : row.name; }

// Who and what, cut at a letter where there is no room for all of it.
std::string fitting(const IndicatorRow& row) {
  std::string label = who(row) + " \xC2\xB7 " + row.label;
  if (drawing::text_width(label, kBarTextSize) <= kLabels - 16) return label;
  while (!label.empty() && drawing::text_width(label + "...", kBarTextSize) > kLabels - 16) {
    while (label.size() > 1 && (static_cast<unsigned char>(label.back()) & 0xC0u) == 0x80u) label.pop_back();
    label.pop_back();
  }
  return label + "...";
}

// Of what changed its sign the difference is more than the larger value: such a bar ends where the chart does.
// Bars from the middle: to the right what became more, to the left what became less, as a share of the larger value.
std::string bars(const std::vector<IndicatorRow>& rows, const std::string& id, const std::string& title) {
  const std::size_t count = std::min(rows.size(), kMostBars);
  const double height = 30 + kLine * static_cast<double>(count);
  const double left = kLabels, right = kPageWidth - kFigures, middle = 0.5 * (left + right), half = 0.5 * (right - left) - 4;
  drawing::Markup svg;
  open_picture(svg, kPageWidth, height, id, title, "Bars to the right: more in the second proposal; to the left: less.");
  svg.leaf("line", {{"class", "leader"},
                    {"x1", drawing::pixels(middle)},
                    {"x2", drawing::pixels(middle)},
                    {"y1", "18"},
                    {"y2", drawing::pixels(height - 6)}});
  svg.element("text", "less", {{"x", drawing::pixels(left)}, {"y", "12"}, {"class", "figure start"}});
  svg.element("text", "more", {{"x", drawing::pixels(right)}, {"y", "12"}, {"class", "figure end"}});
  for (std::size_t k = 0; k < count; ++k) {
    const IndicatorRow& row = rows[k];
    const double y = 22 + kLine * static_cast<double>(k), length = half * std::min(1.0, row.share());
    const bool is_more = row.after > row.before;
    svg.element("text", fitting(row),
                {{"x", drawing::pixels(left - 8)}, {"y", drawing::pixels(y + 14)}, {"class", "figure end"}});
    svg.leaf("rect", {{"x", drawing::pixels(is_more ? middle : middle - length)},
                      {"y", drawing::pixels(y + 3)},
                      {"width", drawing::pixels(std::max(1.0, length))},
                      {"height", drawing::pixels(kLine - 6)},
                      {"fill", is_more ? "#0072b2" : "#d55e00"}});
    svg.element("text", row.first() + " \xE2\x86\x92 " + row.second(),
                {{"x", drawing::pixels(right + 8)}, {"y", drawing::pixels(y + 14)}, {"class", "figure start"}});
  }
  svg.close();
  return svg.str();
}

void list(drawing::Markup& page, const std::string& heading, const std::vector<std::string>& sentences) {
  if (sentences.empty()) return;
  page.element("h2", heading).open("ul");
  for (const std::string& sentence : sentences) page.element("li", sentence);
  page.close();
}

void table(drawing::Markup& page, const std::vector<IndicatorRow>& rows, const std::string& first, const std::string& second) {
  page.open("div", {{"class", "wide"}}).open("table").open("thead").open("tr");
  for (const std::string& head : {std::string("Node"), std::string("Indicator")}) page.element("th", head, {{"scope", "col"}});
  for (const std::string& head : {first, second, std::string("Difference")})
    page.element("th", head, {{"scope", "col"}, {"class", "n"}});
  page.close().close().open("tbody");
  for (const IndicatorRow& row : rows) {
    page.open("tr").element("td", who(row)).element("td", row.label);
    for (const std::string& cell : {row.first(), row.second(), row.difference()}) page.element("td", cell, {{"class", "n"}});
    page.close();
  }
  page.close().close().close();
}

// Both states one above the other, at the same scale, in the same window and in the same colours: else nobody could compare them.
// Two drawings of one page must not mean each other's parts.
void drawings(drawing::Markup& page, const State& before, const State& after, const std::string& name_before,
              const std::string& name_after) {
  reading::ReportModel first, second;
  read_model(before, first);
  read_model(after, second);
  std::vector<Point3> shown = drawing::points_of_axonometry(first);
  const std::vector<Point3> more = drawing::points_of_axonometry(second);
  shown.insert(shown.end(), more.begin(), more.end());
  std::vector<std::string> uses = first.use_names();
  for (const std::string& use : second.use_names())
    if (std::find(uses.begin(), uses.end(), use) == uses.end()) uses.push_back(use);
  const drawing::Palette palette(uses);
  const auto draw = [&](const reading::ReportModel& model, const std::string& name, const std::string& id) {
    page.element("h3", name).open("figure").raw(draw_axonometry(model, palette, id, shown).svg).close();
  };
  draw(first, name_before, "first");
  draw(second, name_after, "second");
}

}  // namespace

std::string told_of_same(const Comparison& comparison) {
  const std::string close = comparison.within_tolerance == 0
                                ? ""
                                : "; " + reading::counted(comparison.within_tolerance, "number") +
                                      (comparison.within_tolerance == 1 ? " differs" : " differ") +
                                      " by less than the tolerance of the solvers, " + reading::percent(comparison.tolerance);
  return reading::counted(comparison.same, "number") + " of nodes in both " + (comparison.same == 1 ? "is" : "are") +
         " the same" + close + ".";
}

std::string comparison_page(const State& before, const State& after, const Comparison& comparison, const std::string& name_before,
                            const std::string& name_after) {
  drawing::Markup page;
  const std::string title = name_before + " against " + name_after;
  page.raw("<!DOCTYPE html>\n");
  page.open("html", {{"xmlns", "http://www.w3.org/1999/xhtml"}, {"lang", "en"}}).open("head");
  page.leaf("meta", {{"charset", "utf-8"}})
      .leaf("meta", {{"name", "viewport"}, {"content", "width=device-width, initial-scale=1"}});
  page.element("title", title).open("style").raw(page_style()).close().close();
  page.open("body").open("header").element("h1", title).close().open("main");
  drawings(page, before, after, name_before, name_after);
  page.element("h2", "What it is judged by");
  table(page, comparison.first, name_before, name_after);
  list(page, "What holds back the first", comparison.reasons_before);
  list(page, "What holds back the second", comparison.reasons_after);
  page.element("h2", "Volumes");
  if (comparison.volumes.empty()) page.element("p", "No figure of a volume that both have differs.");
  else page.open("figure").raw(bars(comparison.volumes, "volumes", "What differs most")).close();
  table(page, comparison.volumes, name_before, name_after);
  list(page, "What was set differently", comparison.inputs);
  list(page, "Only in the first", comparison.only_before);
  list(page, "Only in the second", comparison.only_after);
  std::vector<IndicatorRow> totals;
  std::copy_if(comparison.totals.begin(), comparison.totals.end(), std::back_inserter(totals),
               [](const IndicatorRow& row) { return row.is_seen(0); });
  page.element("h2", "What came of it, over all nodes");
  if (totals.empty()) page.element("p", "No indicator differs.");
  else page.open("figure").raw(bars(totals, "totals", "Totals and means")).close();
  table(page, totals, name_before, name_after);
  page.element("h2", "Other nodes");
  if (!comparison.nodes.empty()) page.open("figure").raw(bars(comparison.nodes, "nodes", "What differs most")).close();
  table(page, comparison.nodes, name_before, name_after);
  page.element("p", told_of_same(comparison));
  page.close().close().close();
  return page.str();
}

}  // namespace bl::report
