// Budget limit: limits by hand, and houses that cost no more than there is.
#include "tests/links/link_case.h"

namespace bl {
namespace {

LinkCase budget(double spent, std::vector<Value> demands, std::vector<Value> limits) {
  LinkCase link("budget_limit");
  link.set("gain", 0.5).set("tolerance", 0.0001).from("stakeholder_group.budget", 8000.0).from("stakeholder_group.spent", spent);
  link.read(End::to, "node.id", std::vector<Value>(demands.size(), std::string("house")));
  link.read(End::to, "smart_volume.wanted", limits).read(End::to, "smart_volume.fitted", limits);
  link.read(End::to, "smart_volume.demand", std::move(demands)).read(End::to, "smart_volume.demand_limit", std::move(limits));
  return link;
}

TEST(BudgetLimit, LimitsAllInOneProportion) {
  auto link = budget(10000, {4000.0, 6000.0}, {1e9, 1e9});  // a fifth too much, half of it answered at once: 0.9
  ASSERT_EQ(link.run(), "");
  EXPECT_NEAR(link.number(End::to, "smart_volume.demand_limit", 0), 3600, 0.5);
  EXPECT_NEAR(link.number(End::to, "smart_volume.demand_limit", 1), 5400, 0.5);
  EXPECT_EQ(link.remarked(LinkRemark::at_work), "from: costs of 10000 € of 8000 €");
}

TEST(BudgetLimit, SaysNothingWhereNothingIsSpentAndAsksForABudget) {
  auto idle = budget(0, {4000.0}, {1e9});
  ASSERT_EQ(idle.run(), "");
  EXPECT_FALSE(idle.proposed(End::to, "smart_volume.demand_limit").has_value());
  auto none = budget(10000, {4000.0}, {1e9});
  EXPECT_EQ(none.from("stakeholder_group.budget", 0.0).run(), "from: the group has no budget: set one, or take this link away");
}

TEST(BudgetLimit, SaysWhoKeepsTheBudgetFromBeingKept) {
  auto link = budget(9000, {4000.0, 6000.0}, {1000.0, 1500.0});
  link.read(End::to, "node.id", {std::string("hotel"), std::string("cafe")});
  link.read(End::to, "smart_volume.wanted", {3900.0, 1500.0}).read(End::to, "smart_volume.fitted", {3900.0, 1500.0});
  ASSERT_EQ(link.set("least", 0.25).run(), "");
  EXPECT_EQ(link.remarked(LinkRemark::unmet),
            "from: the budget cannot be kept: costs of 9000 € of 8000 €, held by `hotel` (3900 m³ are insisted on); raise the "
            "budget, or lower what is insisted on or `least`");
}

TEST(BudgetLimit, SceneSpendsNoMoreThanThereIs) {
  World world = World::from_file("scenes/links/budget_limit.json");
  world.tick(200);
  EXPECT_TRUE(world.state().is_settled());
  EXPECT_LE(world.number("investor", "stakeholder_group.spent"), 6000000);
  EXPECT_GE(world.number("investor", "stakeholder_group.spent"), 0.98 * 6000000) << "the band in which the limit rests";
  const double share = world.number("house_1", "smart_volume.wanted") / 4000;
  EXPECT_LT(share, 0.8);
  EXPECT_NEAR(world.number("house_2", "smart_volume.wanted") / 8000, share, 1e-9);
}

}  // namespace
}  // namespace bl
