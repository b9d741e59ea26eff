// Façade styles by link: who gets one, and that taking the link away undresses.
#include "tests/links/link_case.h"

namespace bl {
namespace {

LinkCase style(const std::string& use, double height) {
  LinkCase link("facade_style");
  link.set("uses", Shared<std::vector<std::string>>(std::vector<std::string>{"office"})).set("above", 10.0);
  link.from("facade_style.name", std::string("glass")).to("smart_volume.use", use).to("smart_volume.height", height);
  return link;
}

TEST(FacadeStyleLink, GoesByUseAndHeight) {
  auto meant = style("office", 12), low = style("office", 9), other = style("housing", 20);
  ASSERT_EQ(meant.run(), "");
  ASSERT_EQ(low.run(), "");
  ASSERT_EQ(other.run(), "");
  const auto given = meant.proposed(End::to, "facade.style");
  ASSERT_TRUE(given);
  EXPECT_EQ(*std::get<Shared<std::vector<std::string>>>(*given), std::vector<std::string>{"glass"});
  EXPECT_FALSE(low.proposed(End::to, "facade.style"));
  EXPECT_FALSE(other.proposed(End::to, "facade.style"));
}

TEST(FacadeStyleLink, SceneDressesEachUse) {
  World world = World::from_file("scenes/links/facade_style.json");
  ASSERT_TRUE(world.settle());
  EXPECT_EQ(world.text("flats_1", "facade.style_in_force"), "brick");
  EXPECT_EQ(world.text("corner", "facade.style_in_force"), "brick");
  EXPECT_EQ(world.text("offices", "facade.style_in_force"), "glass");
  EXPECT_EQ(world.text("offices", "facade.message"), "");
}

}  // namespace
}  // namespace bl
