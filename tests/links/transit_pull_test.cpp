// Transit pull: the step by hand, and blocks that come into the catchment.
#include <cmath>

#include "tests/links/link_case.h"

namespace bl {
namespace {

LinkCase pull(const Vector3& volume) {
  LinkCase link("transit_pull");
  link.set("gain", 0.5).set("fade", 100.0);
  link.from("node.position", Vector3{0, 0, 0}).from("transit_stop.radius", 400.0);
  link.to("node.position", volume).to("smart_volume.demand", 1.0);
  return link;
}

TEST(TransitPull, FadesWithTheWay) {
  auto link = pull({500, 0, 30});
  ASSERT_EQ(link.run(), "");
  expect_near(link.move(End::to), {-0.5 * 100 * std::exp(-1.0), 0, 0});
}

TEST(TransitPull, IsSilentInside) {
  for (const Vector3& at : {Vector3{399, 0, 0}, Vector3{0, 0, 900}, Vector3{0, 0, 0}}) {
    auto link = pull(at);
    ASSERT_EQ(link.run(), "");
    expect_near(link.move(End::to), {});
  }
}

TEST(TransitPull, SceneBringsThemIn) {
  World world = World::from_file("scenes/links/transit_pull.json");
  ASSERT_TRUE(world.settle(300));
  for (const char* block : {"near", "far"}) {
    Vector3 at = world.point(block, "node.position");
    at.z = 0;
    EXPECT_LT(norm(at), 61) << block;
  }
  expect_near(world.point("tower", "node.position"), {-30, 0, 12}, 1e-9);
}

}  // namespace
}  // namespace bl
