// How many digits files have, and what models say that cannot name their place.
#include <gtest/gtest.h>

#include <regex>
#include <string>

#include "tests/core/export/two_houses.h"

namespace bl::exporting {
namespace {

// No more than six decimals; the sums of what is written stay what they are.
TEST(Digits, TablesHaveAsManyAsCanBeMeasured) {
  const Proposal proposal = proposal_of(settled_world());
  const std::string csv = file_of(proposal, "csv", {"form=slabs"}) + file_of(proposal, "csv"),
                    map = file_of(proposal, "geojson", {"coordinates=scene"});
  for (const std::string& text : {csv, map}) {
    std::smatch found;
    EXPECT_FALSE(std::regex_search(text, found, std::regex("[,:\\[]-?[0-9]+\\.[0-9]{7,}"))) << found.str();
  }
  const std::string degrees = file_of(proposal, "geojson");
  std::smatch found;
  EXPECT_FALSE(std::regex_search(degrees, found, std::regex("[,:\\[]-?[0-9]+\\.[0-9]{11,}"))) << found.str();
}

// What was drawn on a map in degrees has a projection of its own, which city models and building models cannot name.
TEST(Place, AMissingSystemIsNamedWithAWayToOne) {
  Proposal proposal = proposal_of(settled_world());
  proposal.reference.crs = "+proj=tmerc +lat_0=51.99 +lon_0=4.37";
  for (const char* id : {"cityjson", "ifc"}) {
    const ExportFiles made = files_of(proposal, id);
    ASSERT_FALSE(made.notes.empty()) << id;
    EXPECT_NE(made.notes.front().find("new --crs EPSG:32631"), std::string::npos) << made.notes.front();
  }
  proposal.reference.latitude = -33.9, proposal.reference.longitude = 18.4;
  EXPECT_NE(files_of(proposal, "ifc").notes.front().find("EPSG:32734"), std::string::npos);
}

}  // namespace
}  // namespace bl::exporting
