// Cost: prices by hand, and costs of several nodes and links that add up.
#include <nlohmann/json.hpp>

#include "tests/links/link_case.h"

namespace bl {
namespace {

TEST(Cost, IsThePriceOfTheAmountAndWhatIsFixed) {
  LinkCase link("cost");
  ASSERT_EQ(link.set("price", 1200.0).set("fixed", 5000.0).from("source", 100.0).run(), "");
  EXPECT_EQ(link.number(End::to, "stakeholder_group.spent"), 125000);
  EXPECT_EQ(link.set("price", 1e308).run(), "price: the cost is too large for a number: lower the price");
}

TEST(Cost, SceneAddsUpAllNodesAllLinksAndWhatPeopleHaveSet) {
  World world = World::from_file("scenes/links/cost.json");
  ASSERT_TRUE(world.settle());
  const auto spent = [&] {
    const double floors = world.number("house_1", "smart_volume.floor_area") + world.number("house_2", "smart_volume.floor_area");
    return 1500 * floors + 400 * world.number("garage", "smart_volume.volume") + 20000;
  };
  world.tick();
  EXPECT_GT(spent(), 3e6);
  EXPECT_NEAR(world.number("investor", "stakeholder_group.spent"), spent(), 1e-3 * spent());
  EXPECT_EQ(world.tension("investor", "stakeholder_group.spent"), 0) << "amounts do not contradict each other";
  ASSERT_EQ(world.submit(command<SetPort>({"investor", {"stakeholder_group.spent"}, JsonValue::of(Json(50000.0))})), "");
  ASSERT_EQ(world.submit(command<SetLinkStrength>({"l1_houses", 0})), "");
  world.tick(3);
  EXPECT_NEAR(world.number("investor", "stakeholder_group.spent"),
              50000 + 400 * world.number("garage", "smart_volume.volume") + 20000, 1000);
}

}  // namespace
}  // namespace bl
