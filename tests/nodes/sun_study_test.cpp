// Sun studies: who takes how much from whom, who counts, what is missing, and when a result counts.
#include <gtest/gtest.h>

#include "tests/nodes/scene_text.h"
#include "tests/support/world.h"

namespace bl {
namespace {

const std::string kStudyPlot = node_text("plot", "[0, 0, 0]", "boundary",
                                         R"("form": "plan", "plan": [[0,0,0],[60,0,0],[60,24,0],[0,24,0]], "height": 40)"),
                  kStudySolver = node_text("solver", "[0, 0, 0]", "smart_volumes_solver"),
                  kSun = node_text("sun", "[0, 0, 0]", "sun_and_sky"), kStudy = node_text("study", "[0, 0, 0]", "sun_study");

std::string caster(const std::string& id, const std::string& position, double demand) {
  return R"({"id": ")" + id + R"(", "position": )" + position + R"(, "types": {"smart_volume": {"demand": )" +
         std::to_string(demand) + R"(}, "shadow_caster": {}}})";
}

World quarter(const std::string& more, int threads = 1) {
  return World::from_text(
      scene_text(kStudyPlot + "," + kStudySolver + "," + kSun + "," + kStudy + "," + caster("low", "[12, 12, 4]", 1500) + "," +
                 caster("tower", "[36, 12, 15]", 9000) + "," + more),
      threads);
}

const std::string kGarden = node_text("garden", "[30, 34, 0]", "shadow_receiver", R"("width": 50, "depth": 16, "spacing": 3)");

TEST(SunStudy, AccountsAddUp) {
  World world = quarter(kGarden);
  ASSERT_TRUE(world.settle(200));
  EXPECT_EQ(world.node_error("study", "sun_study"), "");
  const double mean = world.number("garden", "shadow_receiver.sun_mean"),
               possible = world.number("garden", "shadow_receiver.sun_possible");
  EXPECT_NEAR(possible, world.number("sun", "sun_and_sky.possible"), 1e-6);
  EXPECT_LT(mean, possible - 600);
  EXPECT_LE(world.number("garden", "shadow_receiver.sun_min"), mean);
  EXPECT_GE(world.number("garden", "shadow_receiver.sun_max"), mean);
  const Table& losses = world.table("garden", "shadow_receiver.losses");
  ASSERT_EQ(losses.rows.size(), 2u);
  EXPECT_EQ(losses.text(0, "node"), "low");
  EXPECT_EQ(losses.text(1, "node"), "tower");
  EXPECT_NEAR(mean + losses.number(0, "shared") + losses.number(1, "shared"), possible, 1e-6);
  EXPECT_GT(losses.number(1, "lost"), 3 * losses.number(0, "lost"));
  EXPECT_LE(losses.number(1, "lost"), losses.number(1, "shared"));
  // The casters' accounts are the same figures.
  EXPECT_NEAR(world.number("tower", "shadow_caster.sun_lost"), losses.number(1, "lost"), 1e-9);
  EXPECT_EQ(world.text("tower", "shadow_caster.worst"), "garden");
  EXPECT_EQ(world.table("tower", "shadow_caster.taken").text(0, "receiver"), "garden");
  EXPECT_EQ(world.number("study", "sun_study.caster_count"), 2);
  EXPECT_NE(world.text("study", "sun_study.message").find("`tower` takes most"), std::string::npos);
  const Table& map = world.table("garden", "shadow_receiver.map");
  EXPECT_EQ(map.rows.size(), 17u * 6);
  EXPECT_EQ(world.number("garden", "shadow_receiver.columns"), 17);
  double sum = 0;
  for (std::size_t row = 0; row < map.rows.size(); ++row) sum += map.number(row, "sun") / static_cast<double>(map.rows.size());
  EXPECT_NEAR(sum, mean, 1e-6);
}

TEST(SunStudy, TakingACasterAwayGivesBackWhatItLost) {
  World world = quarter(kGarden);
  ASSERT_TRUE(world.settle(200));
  const double before = world.number("garden", "shadow_receiver.sun_mean"),
               lost = world.number("tower", "shadow_caster.sun_lost");
  ASSERT_EQ(world.submit(command<SetPort>({.node = "tower", .port = {"shadow_caster.casts"}, .value = {"false"}})), "");
  world.tick(10);
  EXPECT_NEAR(world.number("garden", "shadow_receiver.sun_mean"), before + lost, 1e-6);
  EXPECT_EQ(world.number("study", "sun_study.caster_count"), 1);
  EXPECT_EQ(world.number("tower", "shadow_caster.sun_shared"), 0);
}

TEST(SunStudy, RequiredSunIsJudgedPointByPoint) {
  World world = quarter(kGarden);
  ASSERT_TRUE(world.settle(200));
  const auto required = [&](double seconds) {
    ASSERT_EQ(world.submit(command<SetPort>(
                  {.node = "garden", .port = {"shadow_receiver.required_sun"}, .value = {std::to_string(seconds)}})),
              "");
    world.tick(10);
  };
  required(world.number("garden", "shadow_receiver.sun_min") - 1);
  EXPECT_EQ(world.number("garden", "shadow_receiver.share_met"), 1);
  EXPECT_EQ(world.number("garden", "shadow_receiver.deficit"), 0);
  const double most = world.number("garden", "shadow_receiver.sun_max"),
               mean = world.number("garden", "shadow_receiver.sun_mean");
  required(most + 100);
  EXPECT_EQ(world.number("garden", "shadow_receiver.share_met"), 0);
  EXPECT_NEAR(world.number("garden", "shadow_receiver.deficit"), most + 100 - mean, 1e-3);
}

TEST(SunStudy, OnlyNamedCastersCountAndUnknownNamesAreTold) {
  World world = quarter(node_text("garden", "[30, 34, 0]", "shadow_receiver",
                                  R"("width": 50, "depth": 16, "spacing": 3, "casters": ["low", "nobody"])"));
  ASSERT_TRUE(world.settle(200));
  const Table& losses = world.table("garden", "shadow_receiver.losses");
  ASSERT_EQ(losses.rows.size(), 1u);
  EXPECT_EQ(losses.text(0, "node"), "low");
  EXPECT_NE(world.text("study", "sun_study.message").find("`garden` names the caster `nobody`, which this study does not know"),
            std::string::npos);
}

TEST(SunStudy, AFreeRoofHasTheWholeDay) {
  World world = quarter(node_text("roof", "[30, 12, 60]", "shadow_receiver", R"("width": 50, "depth": 16)"));
  ASSERT_TRUE(world.settle(200));
  EXPECT_NEAR(world.number("roof", "shadow_receiver.sun_min"), world.number("sun", "sun_and_sky.possible"), 1e-6);
  EXPECT_NEAR(world.number("roof", "shadow_receiver.sun_max"), world.number("sun", "sun_and_sky.possible"), 1e-6);
  EXPECT_TRUE(world.table("roof", "shadow_receiver.losses").rows.empty());
}

TEST(SunStudy, NeedsExactlyOneSun) {
  World none = World::from_text(scene_text(kStudy));
  none.tick(5);
  EXPECT_EQ(none.node_error("study", "sun_study"),
            "nodes/study/sun_study/sun: a sun is needed and none was found: add a node `sun_and_sky`, or choose one here");
  World two = World::from_text(scene_text(kStudy + "," + kSun + "," + node_text("moon", "[0, 0, 0]", "sun_and_sky")));
  two.tick(5);
  EXPECT_EQ(two.node_error("study", "sun_study"),
            "nodes/study/sun_study/sun: `moon` and `sun` are both suns: choose the one that is studied here");
  World empty = World::from_text(scene_text(kStudy + "," + kSun));
  EXPECT_TRUE(empty.settle());
  EXPECT_EQ(empty.number("study", "sun_study.receiver_count"), 0);
}

TEST(SunStudy, ThreadsAndTheWayThereChangeNothing) {
  World one = quarter(kGarden, 1), three = quarter(kGarden, 3);
  for (int i = 0; i < 12; ++i) {
    one.tick();
    three.tick();
    ASSERT_EQ(one.state().hash, three.state().hash) << "tick " << i;
  }
  // The same place reached another way: required sun changed and changed back.
  const auto required = [&](const char* seconds) {
    ASSERT_EQ(three.submit(command<SetPort>({.node = "garden", .port = {"shadow_receiver.required_sun"}, .value = {seconds}})),
              "");
    three.tick(10);
  };
  ASSERT_TRUE(one.settle(200));
  required("100");
  required("7200");
  ASSERT_TRUE(three.settle(200));
  EXPECT_EQ(one.number("garden", "shadow_receiver.deficit"), three.number("garden", "shadow_receiver.deficit"));
  EXPECT_EQ(one.table("garden", "shadow_receiver.losses"), three.table("garden", "shadow_receiver.losses"));
}

TEST(SunStudy, ResultsCountAfterTheLatency) {
  World world =
      World::from_text(scene_text(kSun + "," + node_text("study", "[0, 0, 0]", "sun_study", R"("latency": 4)") + "," + kGarden));
  world.tick(4);
  EXPECT_EQ(world.number("garden", "shadow_receiver.sun_mean"), 0);
  world.tick(1);
  EXPECT_NEAR(world.number("garden", "shadow_receiver.sun_mean"), world.number("sun", "sun_and_sky.possible"), 1e-6);
}

TEST(SunStudy, Scene) {
  World world = World::from_file("scenes/nodes/sun_study.json");
  ASSERT_TRUE(world.settle());
  EXPECT_GT(world.number("tower", "shadow_caster.sun_lost"), world.number("house", "shadow_caster.sun_lost"));
  EXPECT_EQ(world.text("tower", "shadow_caster.worst"), "garden_north");
  EXPECT_EQ(world.text("old_mill", "shadow_caster.worst"), "garden_east");
  EXPECT_EQ(world.number("study", "sun_study.caster_count"), 4);
}

TEST(SunStudy, SaysWhenNoSunCounts) {
  World world = World::from_text(
      scene_text(kStudy + "," + node_text("sun", "[0, 0, 0]", "sun_and_sky", R"("min_altitude": 90)") + "," + kGarden));
  ASSERT_TRUE(world.settle());
  EXPECT_EQ(world.node_error("study", "sun_study"), "");
  EXPECT_EQ(world.text("study", "sun_study.message"), "no sun counts in the period of `sun`, which says why");
}

// A node that is both a SmartVolume and an existing building is one caster, with both shapes.
TEST(SunStudy, ANodeWithTwoShapesIsOneCaster) {
  const std::string both = R"({"id": "both", "position": [0, -20, 0], "types": {"existing_building": {"height": 20},
                               "smart_volume": {"demand": 900}, "shadow_caster": {}}})";
  const std::string receiver = node_text("garden", "[0, 10, 0]", "shadow_receiver", R"("spacing": 4)");
  World world = World::from_text(scene_text(both + "," + kSun + "," + receiver + "," + kStudy));
  world.tick(8);  // without a solver the volume has no shape
  EXPECT_EQ(world.node_error("study", "sun_study"), "");
  const Table& losses = world.table("garden", "shadow_receiver.losses");
  ASSERT_EQ(losses.rows.size(), 1u);
  EXPECT_GT(losses.number(0, "lost"), 0);
  EXPECT_EQ(world.number("both", "shadow_caster.sun_lost"), losses.number(0, "lost"));
  EXPECT_EQ(world.table("both", "shadow_caster.taken").rows.size(), 1u);
  const double alone = losses.number(0, "lost");
  // With a shape of its own the volume takes as well.
  World larger = World::from_text(
      scene_text(both + "," + kSun + "," + receiver + "," + kStudy + "," + kStudySolver + "," +
                 node_text("site", "[0, 0, 0]", "boundary",
                           R"("form": "plan", "plan": [[-40,-30,0],[40,-30,0],[40,-4,0],[-40,-4,0]], "height": 60)")));
  ASSERT_EQ(larger.submit(command<SetPort>({.node = "both", .port = {"smart_volume.demand"}, .value = {"30000"}})), "");
  ASSERT_TRUE(larger.settle(300));
  EXPECT_EQ(larger.node_error("study", "sun_study"), "");
  EXPECT_EQ(larger.number("study", "sun_study.caster_count"), 1);
  EXPECT_GT(larger.number("both", "shadow_caster.sun_lost"), alone + 60);
}

TEST(SunStudy, TheClocksHandMovesOutlinesOnly) {
  World world = quarter(kGarden);
  ASSERT_TRUE(world.settle(200));
  const Table losses = world.table("garden", "shadow_receiver.losses");
  const auto outline = [&] {
    return *std::get<Shared<std::vector<Point3>>>(value_in(world.state(), "tower", "shadow_caster.outline"));
  };
  const auto before = outline();
  ASSERT_EQ(world.submit(command<SetPort>({.node = "sun", .port = {"sun_and_sky.time"}, .value = {"50000"}})), "");
  world.tick(8);
  EXPECT_TRUE(outline() != before);
  EXPECT_EQ(world.table("garden", "shadow_receiver.losses"), losses);
}

TEST(SunStudy, RefusesMoreRaysThanItCanFollow) {
  World world = World::from_text(scene_text(
      kStudy + "," +
      node_text("sun", "[0, 0, 0]", "sun_and_sky",
                R"("first_date": "2026-01-01", "last_date": "2026-12-31", "day_step": 1, "step": 400, "min_altitude": 0)") +
      "," + node_text("garden", "[0, 0, 0]", "shadow_receiver", R"("width": 500, "depth": 500, "spacing": 1)") + "," +
      node_text("park", "[0, 900, 0]", "shadow_receiver", R"("width": 500, "depth": 500, "spacing": 1)")));
  world.tick(6);
  EXPECT_NE(world.node_error("study", "sun_study").find("nodes/study/sun_study/receivers: the study would follow"),
            std::string::npos)
      << world.node_error("study", "sun_study");
}

}  // namespace
}  // namespace bl
