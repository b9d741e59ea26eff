// Storeys below the ground in drawings, sections, models and on the page.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <regex>

#include "core/export/drawn_levels.h"
#include "core/export/format.h"
#include "core/export/option_text.h"
#include "core/export/read_proposal.h"
#include "core/export/section.h"
#include "core/export/solids.h"
#include "tests/support/world.h"

namespace bl::exporting {
namespace {

// A block with a courtyard over two cellars, a disc over one that is higher, and a shed without.
Proposal cellar_proposal() {
  World world = World::from_text(R"({"format": "behaviourlinks", "version": 1, "settings": {"title": "Cellars"}, "nodes": [
      {"id": "site", "types": {"boundary": {"form": "plan", "plan": [[-60, -30, 0], [60, -30, 0], [60, 30, 0], [-60, 30, 0]], "height": 40}}},
      {"id": "solver", "types": {"standing_solver": {}}},
      {"id": "block", "position": [-30, 0, 0], "types": {
        "footprint": {"cellar_storeys": 2, "cellar_height": 3, "depth": 8, "storeys": 3},
        "smart_volume": {"demand": 7200, "use": "housing", "storey_height": 3}}},
      {"id": "disc", "position": [25, 0, 0], "types": {
        "footprint": {"form": "round", "storeys": 2, "cellar_storeys": 1, "cellar_height": 4.2},
        "smart_volume": {"demand": 2400, "use": "shops", "storey_height": 4}}},
      {"id": "shed", "position": [52, 0, 0], "types": {
        "footprint": {"storeys": 1}, "smart_volume": {"demand": 300, "use": "shops", "storey_height": 3}}}]})");
  EXPECT_TRUE(world.settle());
  auto proposal = read_proposal(world.state(), "cellars.json");
  EXPECT_TRUE(proposal) << proposal.error().text();
  return std::move(*proposal);
}

const Building& building_of(const Proposal& proposal, const std::string& id) {
  return *std::find_if(proposal.buildings.begin(), proposal.buildings.end(), [&](const Building& b) { return b.id == id; });
}

std::map<std::string, std::string> files_of(const Proposal& proposal, const char* id, const std::vector<std::string>& options,
                                            bool is_folder, std::vector<std::string>* notes = nullptr) {
  const FormatDefinition* format = find_format(id);
  const auto values = option_values(*format, options);
  EXPECT_TRUE(values) << values.error().text();
  const auto made = format->write(proposal, *values, is_folder);
  EXPECT_TRUE(made) << id << ": " << made.error().text();
  std::map<std::string, std::string> files;
  for (const ExportFile& file : made->files) files[file.name] = file.content;
  if (notes != nullptr) *notes = made->notes;
  return files;
}

TEST(DrawnLevels, GoFromTheDeepestCellarUp) {
  const Proposal proposal = cellar_proposal();
  const std::vector<DrawnLevel> levels = drawn_levels(proposal);
  ASSERT_EQ(levels.size(), static_cast<std::size_t>(proposal.levels) + 2);
  EXPECT_EQ(cellar_levels(proposal), 2);
  EXPECT_EQ(levels[0].name(), "Cellar 2");
  EXPECT_EQ(levels[0].heights(), "from -6.00 m");
  EXPECT_EQ(levels[1].name(), "Cellar 1");
  EXPECT_EQ(levels[1].heights(), "from -4.20 to -3.00 m") << "the shops have a higher one";
  EXPECT_EQ(levels[1].file_stem(), "cellar_01");
  EXPECT_EQ(levels[2].name(), "Level 0");
  EXPECT_EQ(levels[2].file_stem(), "level_00");
  double above = 0, below = 0, floors = 0, cellars = 0;
  for (const DrawnLevel& level : levels) (level.is_cellar() ? below : above) += level.area;
  for (const Building& building : proposal.buildings) {
    floors += building.floor_area;
    for (const Storey& cellar : building.cellars) cellars += cellar.floor_area;
    const auto storeys = drawn_storeys(building);
    EXPECT_EQ(storeys.size(), building.cellars.size() + building.storeys.size());
    for (std::size_t k = 1; k < storeys.size(); ++k) EXPECT_NEAR(storeys[k]->bottom, storeys[k - 1]->top, 1e-9) << building.id;
  }
  EXPECT_NEAR(above, floors, 1e-9 * floors);
  EXPECT_NEAR(below, cellars, 1e-9 * cellars);
}

// What is filled in the groups of uses, back in square metres.
double drawn_area(const std::string& svg) {
  std::smatch found;
  EXPECT_TRUE(std::regex_search(svg, found, std::regex("scale 1:([0-9.]+)")));
  const double metres = std::stod(found[1]) / 1000;
  double sum = 0;
  const std::regex group(R"(<g id="use_[^"]*"[^>]*>([\s\S]*?)</g>)"), path(R"( d="([^"]*)\")"),
      point(R"(([MLZ])(-?[0-9.]+)? ?(-?[0-9.]+)?)");
  for (std::sregex_iterator g(svg.begin(), svg.end(), group), end; g != end; ++g) {
    const std::string inside = (*g)[1];
    for (std::sregex_iterator p(inside.begin(), inside.end(), path); p != end; ++p) {
      const std::string line = (*p)[1];
      geometry::Ring ring;
      for (std::sregex_iterator at(line.begin(), line.end(), point); at != end; ++at) {
        if ((*at)[1] == "Z") sum -= geometry::signed_area(ring) * metres * metres, ring.clear();
        else ring.push_back({std::stod((*at)[2]), std::stod((*at)[3]), 0});
      }
    }
  }
  return sum;
}

TEST(CellarPlans, EachCellarHasAPlanOfItsOwn) {
  const Proposal proposal = cellar_proposal();
  const auto files = files_of(proposal, "svg", {}, true);
  ASSERT_TRUE(files.contains("cellar_02.svg") && files.contains("cellar_01.svg") && files.contains("level_00.svg"));
  for (const DrawnLevel& level : drawn_levels(proposal)) {
    const std::string& svg = files.at(level.file_stem() + ".svg");
    EXPECT_NE(svg.find(", " + level.name() + "</title>"), std::string::npos);
    EXPECT_NEAR(drawn_area(svg), level.area, 1e-3 * level.area + 1e-9) << level.name();
  }
  EXPECT_NE(files.at("cellar_01.svg").find("Cellar 1 of 2, from -4.20 to -3.00 m"), std::string::npos);
  EXPECT_NE(files.at("cellar_01.svg").find("no part of the floor area"), std::string::npos);
  const auto one = files_of(proposal, "svg", {"cellar=2"}, false);
  EXPECT_EQ(one.begin()->second, files.at("cellar_02.svg"));
  const FormatDefinition* format = find_format("svg");
  for (const auto& [options, words] : std::vector<std::pair<std::vector<std::string>, const char*>>{
           {{"cellar=3"}, "no cellar 3; the deepest is 2"}, {{"cellar=1", "level=-1"}, "a file shows one of them"}}) {
    const auto refused = format->write(proposal, *option_values(*format, options), false);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find(words), std::string::npos) << refused.error().message;
  }
}

// By hand: the disc has one cellar of 4.2 m, as wide as its plate; the block two, and none of them has the courtyard.
TEST(CellarSection, CellarsAreCutBelowTheGround) {
  const Proposal proposal = cellar_proposal();
  const Section section = section_of(proposal, *section_line(proposal, "-60,0,60,0"), false);
  EXPECT_NEAR(section.low.y, -6, 1e-9);
  EXPECT_EQ(section.heights.front(), -6);
  std::map<std::string, const SectionPart*> parts;
  for (const SectionPart& part : section.parts) parts[part.building->id] = &part;
  ASSERT_EQ(parts.size(), 3u);
  EXPECT_EQ(parts.at("block")->cut.size(), 6u) << "on both sides of the courtyard";
  ASSERT_EQ(parts.at("block")->cellars.size(), 2u);
  ASSERT_EQ(parts.at("disc")->cellars.size(), 1u);
  EXPECT_TRUE(parts.at("shed")->cellars.empty());
  const geometry::Ring& cellar = parts.at("disc")->cellars.front();
  EXPECT_NEAR(geometry::signed_area(cellar), 4.2 * 2 * std::sqrt(300 / std::numbers::pi), 0.1) << "a plate of 300 m²";
  for (const auto& [id, part] : parts) EXPECT_EQ(part->slabs.size(), 2 * (part->cut.size() + part->cellars.size())) << id;
  for (const geometry::Ring& ring : parts.at("block")->cellars)
    for (const Point3& p : ring) EXPECT_LE(p.y, 1e-9);
  const auto sheet = files_of(proposal, "svg", {"section=-60,0,60,0", "level=-1"}, false);
  EXPECT_NE(sheet.begin()->second.find("<g id=\"cellars\""), std::string::npos);
  EXPECT_NE(sheet.begin()->second.find(">-6.00<"), std::string::npos);
  EXPECT_NE(sheet.begin()->second.find(">+0.00<"), std::string::npos) << "the ground always has its height";
  const LevelPart below = level_part(building_of(proposal, "block"), -4);
  ASSERT_NE(below.storey, nullptr);
  EXPECT_EQ(below.storey->number, -2);
  EXPECT_NEAR(area_of(below.faces), below.storey->floor_area, 1e-3 * below.storey->floor_area);
}

TEST(CellarMeshes, AreBodiesOfTheirOwnWhereTheyAreWanted) {
  const Proposal proposal = cellar_proposal();
  const std::vector<Solid> solids = solids_of(proposal, false, true);
  EXPECT_EQ(solids.size(), 5u);
  EXPECT_EQ(solids_of(proposal, false, false).size(), 3u);
  for (const Solid& solid : solids) {
    EXPECT_TRUE(is_closed(*solid.mesh)) << solid.name;
    if (!solid.is_cellar) continue;
    double volume = 0;
    for (const Storey& s : solid.building->cellars) volume += s.floor_area * (s.top - s.bottom);
    EXPECT_NEAR(enclosed_volume(*solid.mesh), volume, 1e-3 * volume) << solid.name;
  }
  // Models in metres have them, prints do not unless somebody says so; what is left out is said.
  for (const auto& [id, has_cellars] :
       std::map<const char*, bool>{{"glb", true}, {"obj", true}, {"3mf", false}, {"stl", false}}) {
    const FormatDefinition* format = find_format(id);
    const auto& option = format->ports.at(format->port_index("cellars"));
    EXPECT_EQ(std::get<bool>(option.default_value), has_cellars) << id;
    std::vector<std::string> with, without;
    const auto large = files_of(proposal, id, {"cellars=true"}, false, &with),
               small = files_of(proposal, id, {"cellars=false"}, false, &without);
    EXPECT_GT(large.begin()->second.size(), small.begin()->second.size()) << id;
    EXPECT_EQ(files_of(proposal, id, {}, false), has_cellars ? large : small) << id;
    EXPECT_TRUE(with.empty()) << id;
    ASSERT_EQ(without.size(), 1u) << id;
    EXPECT_NE(without.front().find("cellars of 2\xC2\xA0volumes"), std::string::npos) << without.front();
  }
  EXPECT_TRUE(files_of(proposal, "stl", {"cellars=yes"}, true).contains("block-cellar.stl"));
}

TEST(CellarPage, HasThemInPlansAndTables) {
  Proposal proposal = cellar_proposal();
  proposal.shell =
      "<!doctype html>\n<!-- BehaviourLinks proposal -->\n<meta name=\"data-version\" content=\"2\">\n<title>PAGE_TITLE</title>\n"
      "<script id=\"data\" type=\"application/json\">PAGE_DATA</script>\n";
  const std::string page = files_of(proposal, "html", {}, false).begin()->second;
  const std::size_t begin = page.find("json\">") + 6;
  const auto data = nlohmann::json::parse(page.substr(begin, page.find("</script>") - begin));
  const auto& levels = data["plan"]["levels"];
  ASSERT_EQ(levels.size(), drawn_levels(proposal).size());
  EXPECT_EQ(levels[0]["name"], "Cellar 2");
  EXPECT_EQ(levels[2]["number"], 0);
  std::size_t cellars = 0;
  for (const auto& building : data["buildings"])
    for (const auto& cellar : building["cellars"]) {
      EXPECT_LT(cellar["level"], 0);
      EXPECT_LT(cellar["path"], data["paths"].size());
      ++cellars;
    }
  EXPECT_EQ(cellars, 3u);
}

}  // namespace
}  // namespace bl::exporting
