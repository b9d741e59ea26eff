// Request traffic: trips by hand, and two volumes that ask for theirs.
#include "tests/links/link_case.h"

namespace bl {
namespace {

TEST(RequestTraffic, TripsByHand) {
  LinkCase link("request_traffic");
  link.set("trips_per_100", 20.0).set("car_share", 0.5).set("out_share", 0.75);
  link.from("smart_volume.floor_area", 4000.0).to("traffic_network.peak_share", 0.1);
  ASSERT_EQ(link.run(), "");  // 40 · 20 · 0.5 · 0.1 = 40 trips
  EXPECT_NEAR(link.number(End::from, "traffic_zone.trips_out"), 30, 1e-12);
  EXPECT_NEAR(link.number(End::from, "traffic_zone.trips_in"), 10, 1e-12);
}

TEST(RequestTraffic, FiguresOfTheUseGoBeforeTheSettings) {
  LinkCase link("request_traffic");
  link.set("trips_per_100", 20.0).set("car_share", 0.5).set("out_share", 0.75);
  link.from("smart_volume.floor_area", 4000.0).to("traffic_network.peak_share", 0.1);
  link.from("use_figures.trips", 500.0);
  link.from("use_figures.car_share", 0.4).from("use_figures.out_share", 0.8);
  ASSERT_EQ(link.run(), "");  // 500 · 0.4 · 0.1 = 20 trips
  EXPECT_NEAR(link.number(End::from, "traffic_zone.trips_out"), 16, 1e-12);
  EXPECT_NEAR(link.number(End::from, "traffic_zone.trips_in"), 4, 1e-12);
  link.from("use_figures.trips", 0.0);  // the use has no figure for trips
  ASSERT_EQ(link.run(), "");
  EXPECT_NEAR(link.number(End::from, "traffic_zone.trips_out"), 30, 1e-12);
}

TEST(RequestTraffic, SceneFillsTheStreet) {
  World world = World::from_file("scenes/links/request_traffic.json");
  ASSERT_TRUE(world.settle(100));
  const double trips = world.number("housing", "smart_volume.floor_area") / 100 * 10 * 0.5 * 0.1;
  EXPECT_NEAR(world.number("housing", "traffic_zone.trips_out"), 0.8 * trips, 0.01 * trips);
  EXPECT_NEAR(world.number("street", "street.flow_forth"), world.number("housing", "traffic_zone.trips_out"), 0.01 * trips);
  EXPECT_GT(world.number("offices", "traffic_zone.trips_in"), world.number("offices", "traffic_zone.trips_out"));
}

}  // namespace
}  // namespace bl
