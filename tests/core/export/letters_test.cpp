// Letters beyond ASCII, and letters that a format has another meaning for.
#include <gtest/gtest.h>

#include <set>
#include <sstream>

#include "tests/core/export/two_houses.h"

namespace bl::exporting {
namespace {

// Of a DXF text: the values of a group code, in order.
std::vector<std::string> groups_of(const std::string& text, const std::string& wanted) {
  std::istringstream lines(text);
  std::string code, value;
  std::vector<std::string> found;
  while (std::getline(lines, code) && std::getline(lines, value))
    if (code == wanted) found.push_back(value);
  return found;
}

// Names of equal length beyond ASCII, names that differ in their case or in signs, and the name of the layer of texts.
TEST(Letters, EachUseHasLayersOfItsOwnInADrawing) {
  Proposal proposal = proposal_of(settled_world());
  const std::vector<std::string> uses = {"住宅", "商业", "Büro", "shop a", "Shop-a", "shop_a", "text"};
  const Building one = proposal.buildings.front();
  proposal.buildings.clear();
  for (const std::string& use : uses) {
    proposal.buildings.push_back(one);
    proposal.buildings.back().id += use;
    proposal.buildings.back().use = use;
  }
  const ExportFiles made = files_of(proposal, "dxf");
  std::set<std::string> layers;
  for (const std::string& layer : groups_of(made.files.front().content, "8"))
    if (layer.starts_with("L00-")) layers.insert(layer);
  EXPECT_EQ(layers.size(), uses.size() + 1) << "and one of texts";
  EXPECT_TRUE(layers.contains("L00-B_RO"));
  EXPECT_TRUE(layers.contains("L00-__"));
  ASSERT_EQ(made.notes.size(), 1u);
  EXPECT_NE(made.notes.front().find("`___2` is 商业"), std::string::npos) << made.notes.front();
  EXPECT_EQ(made.notes.front().find("Büro"), std::string::npos) << made.notes.front();
}

TEST(Letters, TextsOfADrawingMeanWhatTheySay) {
  Proposal proposal = proposal_of(settled_world());
  proposal.buildings.front().label = "A^B 50% %%c \xF0\x9F\x8F\xA0";
  const ExportFiles made = files_of(proposal, "dxf");
  bool is_found = false;
  for (const std::string& words : groups_of(made.files.front().content, "1"))
    is_found = is_found || words.starts_with("A^ B 50% %%%%%%c ?");
  EXPECT_TRUE(is_found);
  ASSERT_EQ(made.notes.size(), 1u);
  EXPECT_NE(made.notes.front().find("question marks"), std::string::npos) << made.notes.front();
}

// All that the code page 1252 has beyond the numbers of Unicode, and a title too long for its place, which ends in three dots.
TEST(Letters, APdfHasTheSignsOfWesternEurope) {
  Proposal proposal = proposal_of(settled_world());
  proposal.title = "€ ‚ ƒ „ … † ‡ ˆ ‰ Š ‹ Œ Ž ‘ ’ “ ” • – — ˜ ™ š › œ ž Ÿ";
  EXPECT_TRUE(files_of(proposal, "pdf").notes.empty());
  proposal.title = std::string(2000, 'a');
  EXPECT_TRUE(files_of(proposal, "pdf").notes.empty());
  proposal.title = "住宅";
  ASSERT_EQ(files_of(proposal, "pdf").notes.size(), 1u);
}

}  // namespace
}  // namespace bl::exporting
