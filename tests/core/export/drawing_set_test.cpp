// Sheets: the site as large as it fits, and an overview that can be read.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/export/drawn_levels.h"
#include "core/export/overview_sheet.h"
#include "core/export/plan_sheet.h"
#include "tests/core/export/two_houses.h"

namespace bl::exporting {
namespace {

geometry::PlateFace rectangle_face(double west, double south, double east, double north) {
  return {{{west, south, 0}, {east, south, 0}, {east, north, 0}, {west, north, 0}}, {}};
}

// The two houses on a site of this size, with a house of the surroundings 400 m away.
Proposal on_site(double width, double depth) {
  Proposal proposal = proposal_of(settled_world());
  proposal.lands.front().faces = {rectangle_face(-width / 2, -depth / 2, width / 2, depth / 2)};
  proposal.neighbours.push_back({"far", "far", "", rectangle_face(400, 0, 420, 10), 0, 9, nullptr});
  return proposal;
}

PlanSheet ground_floor(const Proposal& proposal, const SheetOptions& options) {
  auto sheet = plan_sheet(proposal, drawn_levels(proposal).front(), options);
  EXPECT_TRUE(sheet) << sheet.error().text();
  return std::move(*sheet);
}

const SheetGroup& group_of(const PlanSheet& sheet, const std::string& id) {
  const auto found =
      std::find_if(sheet.groups.begin(), sheet.groups.end(), [&](const SheetGroup& group) { return group.id == id; });
  EXPECT_NE(found, sheet.groups.end()) << id;
  return *found;
}

// Two sites of a trial on A3: the first lacked a hand's breadth and was drawn at half the size, the second at less than half.
TEST(DrawingSet, TheSiteIsAsLargeAsItFits) {
  EXPECT_EQ(ground_floor(on_site(260.88, 222.83), {}).scale, 1000);
  EXPECT_EQ(ground_floor(on_site(140, 130), {}).scale, 750);
  for (const double size : {30.0, 90.0, 333.0, 1234.0}) {
    const PlanSheet sheet = ground_floor(on_site(size, 0.6 * size), {});
    for (const SheetShape& shape : group_of(sheet, "plots").shapes)
      for (const auto& line : shape.lines)
        for (const SheetPoint& p : line) {
          EXPECT_GE(p.x, sheet.window_low.x + 6) << size;
          EXPECT_LE(p.x, sheet.window_high.x - 6) << size;
          EXPECT_GE(p.y, sheet.window_low.y + 6) << size;
          EXPECT_LE(p.y, sheet.window_high.y - 6) << size;
        }
  }
}

TEST(DrawingSet, SurroundingsAreCutOffOrAllShown) {
  const Proposal proposal = on_site(140, 130);
  SheetOptions options;
  const PlanSheet site = ground_floor(proposal, options);
  EXPECT_TRUE(group_of(site, "surroundings").is_clipped);
  options.extent = DrawnExtent::all;
  const PlanSheet all = ground_floor(proposal, options);
  EXPECT_GT(all.scale, site.scale);
  for (const auto& line : group_of(all, "surroundings").shapes.back().lines)
    for (const SheetPoint& p : line) EXPECT_TRUE(p.x > all.window_low.x && p.x < all.window_high.x);
  options.surroundings = false;
  EXPECT_EQ(ground_floor(proposal, options).scale, site.scale) << "what is not drawn needs no room";
  EXPECT_NE(file_of(proposal, "svg", {"extent=all"}), file_of(proposal, "svg", {"extent=site"}));
}

std::string words_of_sheet(const PlanSheet& sheet) {
  std::string words;
  for (const SheetGroup& group : sheet.groups)
    for (const SheetText& text : group.texts) words += text.words + "\n";
  return words;
}

TEST(DrawingSet, TheFirstSheetSaysWhatAClientAsks) {
  Proposal proposal = proposal_of(settled_world());
  Land plot;
  plot.id = plot.name = "Plot A";
  plot.faces = {rectangle_face(-20, -20, 20, 20)};
  plot.area = 1600, plot.fsi = 1.25, plot.gsi = 0.3125, plot.osr = 0.55, plot.storeys = 4, plot.top = 12;
  plot.fsi_max = 1.5, plot.height_max = 15;
  proposal.lands.push_back(plot);
  proposal.indicators.push_back({"green", "Green", 42, 40, "%", "at_least", "met", 1});
  proposal.troubles.push_back({"`housing`", "has 5 of 7 storeys, because `sun_of_garden` leaves 18.02 m"});
  proposal.suns.push_back({"garden", "Garden", 2, 0.8, 0.5, 4.7});
  for (const Paper paper : {Paper::a4, Paper::a3, Paper::a0}) {
    SheetOptions options;
    options.paper = paper;
    const PlanSheet sheet = overview_sheet(proposal, options, 500);
    const std::string words = words_of_sheet(sheet);
    for (const char* wanted :
         {"housing", "shops", "Plot A, gross land", "1600 m²", "1.25", "at most 1.50", "0.31", "0.55", "at most 15.0 m",
          "at least 40.0 %: met", "Garden, area with 2.0 h", "80 %", "at least 50 %: met", "housing: has 5 of 7"})
      EXPECT_NE(words.find(wanted), std::string::npos) << wanted << " in\n" << words;
    EXPECT_EQ(words.find('`'), std::string::npos) << words;
    for (const char* id : {"schedule", "figures", "problems"})
      for (const SheetText& text : group_of(sheet, id).texts) {
        EXPECT_GE(text.size, paper == Paper::a4 ? 2 : 2.5) << text.words;
        EXPECT_LE(text.at.y, sheet.window_high.y) << text.words;
        EXPECT_LE(text.at.x, sheet.window_high.x) << text.words;
      }
    EXPECT_GE(group_of(sheet, "schedule").texts.back().size, paper == Paper::a4 ? 2.5 : 3.9);
  }
}

// Many uses and many problems: what has no room is counted, and nothing runs out of the sheet.
TEST(DrawingSet, TheFirstSheetSaysWhatItLeavesOut) {
  Proposal proposal = proposal_of(settled_world());
  for (int k = 0; k < 90; ++k) {
    UseRow row = proposal.uses.front();
    row.use = "use " + std::to_string(k);
    proposal.uses.push_back(row);
    proposal.troubles.push_back({"volume " + std::to_string(k), "is short of what was asked for, since there is no room for it"});
  }
  const PlanSheet sheet = overview_sheet(proposal, {}, 500);
  const std::string words = words_of_sheet(sheet);
  EXPECT_NE(words.find("more uses"), std::string::npos);
  EXPECT_NE(words.find("more; the format xlsx has all"), std::string::npos);
  for (const SheetGroup& group : sheet.groups)
    for (const SheetText& text : group.texts) EXPECT_LE(text.at.y, sheet.height - 10) << text.words;
}

}  // namespace
}  // namespace bl::exporting
