// Casts shadow on: a name by hand, and a garden that looks at one of two casters.
#include "tests/links/link_case.h"

namespace bl {
namespace {

using Names = std::vector<std::string>;

TEST(CastsShadowOn, ProposesTheCaster) {
  LinkCase link("casts_shadow_on");
  link.from("node.id", std::string("tower")).from("shadow_caster.casts", true);
  ASSERT_EQ(link.run(), "");
  EXPECT_EQ(*std::get<Shared<Names>>(link.proposed(End::to, "shadow_receiver.casters").value()), Names{"tower"});
}

TEST(CastsShadowOn, LayingALinkMatters) {
  World world = World::from_file("scenes/links/casts_shadow_on.json");
  ASSERT_TRUE(world.settle());
  EXPECT_EQ(world.link_error("l1_shadow"), "");
  // Two casters, one link: only the hall's shadow counts in the garden.
  const double linked = world.number("garden", "shadow_receiver.sun_mean");
  const Table losses = world.table("garden", "shadow_receiver.losses");
  ASSERT_EQ(losses.rows.size(), 1u);
  EXPECT_EQ(losses.text(0, "node"), "hall");
  EXPECT_NEAR(linked + losses.number(0, "lost"), world.number("garden", "shadow_receiver.sun_possible"), 1e-6);
  EXPECT_EQ(world.number("tower", "shadow_caster.sun_shared"), 0);
  // With the second link both count.
  ASSERT_EQ(
      world.submit(command<AddLink>({.id = "l2", .link = {R"({"kind": "casts_shadow_on", "from": "tower", "to": "garden"})"}})),
      "");
  world.tick(8);
  ASSERT_TRUE(world.settle());
  const double both = world.number("garden", "shadow_receiver.sun_mean");
  EXPECT_LT(both, linked - 600);
  EXPECT_EQ(world.table("garden", "shadow_receiver.losses").rows.size(), 2u);
  // Without any link all count.
  ASSERT_EQ(world.submit(command<RemoveLink>({.id = "l1_shadow"})), "");
  ASSERT_EQ(world.submit(command<RemoveLink>({.id = "l2"})), "");
  world.tick(8);
  ASSERT_TRUE(world.settle());
  EXPECT_EQ(world.number("garden", "shadow_receiver.sun_mean"), both);
}

}  // namespace
}  // namespace bl
