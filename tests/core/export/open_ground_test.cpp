// Ground that is kept open or clear: its name, its place and its sun in drawings, models, maps and tables.
#include <gtest/gtest.h>

#include <iterator>
#include <regex>
#include <set>
#include <string>

#include <nlohmann/json.hpp>

#include "core/drawing/use_colours.h"
#include "tests/core/export/two_houses.h"

namespace bl::exporting {
namespace {

geometry::PlateFace ground_face(double west, double south, double east, double north) {
  return {{{west, south, 0}, {east, south, 0}, {east, north, 0}, {west, north, 0}}, {}};
}

Proposal with_open_ground() {
  Proposal proposal = proposal_of(settled_world());
  proposal.open_spaces.push_back(
      {"garden", drawing::use_colour("garden").colour, 100, 100, "", {ground_face(-28, -18, -18, -8)}});
  proposal.open_spaces.push_back({"pond", drawing::use_colour("pond").colour, 0, 50, "", {ground_face(18, 10, 28, 15)}});
  proposal.kept.push_back({"street", {ground_face(-30, 16, 30, 20)}});
  proposal.suns.push_back({"garden", "Back garden", 2, 0.8, 0.5, 4.7});
  return proposal;
}

TEST(OpenGround, HasItsNameInDrawings) {
  const Proposal proposal = with_open_ground();
  const std::string svg = file_of(proposal, "svg"), dxf = file_of(proposal, "dxf");
  for (const char* words : {"id=\"open_space\"", ">garden, open<", ">pond, open<", "id=\"kept_clear\"", ">street, kept clear<"})
    EXPECT_NE(svg.find(words), std::string::npos) << words;
  for (const char* words : {"\nOPEN-GARDEN\n", "\nOPEN-POND\n", "\nKEPT-STREET\n", "garden  100.0 m"})
    EXPECT_NE(dxf.find(words), std::string::npos) << words;
}

TEST(OpenGround, IsPartOfModelsAndMaps) {
  const Proposal proposal = with_open_ground();
  const auto city = nlohmann::json::parse(file_of(proposal, "cityjson"))["CityObjects"];
  EXPECT_EQ(city["open_space/garden"]["type"], "PlantCover");
  EXPECT_EQ(city["open_space/pond"]["type"], "WaterBody");
  EXPECT_EQ(city["kept_clear/street"]["type"], "LandUse");
  const std::string ifc = file_of(proposal, "ifc");
  const std::regex elements("IFCGEOGRAPHICELEMENT\\('[^']*',\\$,'(garden|pond|street)'");
  EXPECT_EQ(std::distance(std::sregex_iterator(ifc.begin(), ifc.end(), elements), std::sregex_iterator()), 3);
  EXPECT_NE(ifc.find("'OpenArea',$,$,100."), std::string::npos);
  std::set<std::string> ids;
  const auto map = nlohmann::json::parse(file_of(proposal, "geojson"));
  for (const auto& feature : map["features"]) ids.insert(feature["id"].get<std::string>());
  for (const char* id : {"open_space/garden", "open_space/pond", "kept_clear/street"}) EXPECT_TRUE(ids.contains(id)) << id;
  EXPECT_NE(file_of(proposal, "csv").find("sun,,Back garden,"), std::string::npos);
  EXPECT_NE(file_of(proposal, "csv").find(",0.8,0.5,share of the area with 2 h,met,"), std::string::npos);
}

}  // namespace
}  // namespace bl::exporting
