// Volumes that share one footprint: plates that add up, parts that never overlap, and an order from the ground up.
#include "core/geometry/shared_building.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/define/value.h"
#include "core/geometry/cellar.h"
#include "core/geometry/domain_makers.h"
#include "core/geometry/plates_table.h"
#include "core/geometry/standing_tick.h"

namespace bl::geometry {
namespace {

Domain ground(bool is_convex) {
  const std::vector<Point3> ring =
      is_convex ? std::vector<Point3>{{0, 0, 0}, {90, 0, 0}, {90, 60, 0}, {0, 60, 0}}
                : std::vector<Point3>{{0, 0, 0}, {90, 0, 0}, {90, 30, 0}, {50, 30, 0}, {50, 60, 0}, {0, 60, 0}};
  return extrude_plan(ring, {}, 0, 60).value();
}

double drawn_area(const PlateStack& stack, const Point3& centre) {
  double area = 0;
  for (const PlateFace& face : faces_of(stack, centre, 1e-4)) {
    area += signed_area(face.outer);
    for (const Ring& hole : face.holes) area += signed_area(hole);
  }
  return area;
}

bool holds(const PlateStack& stack, const Point3& centre, const Point3& at) {
  for (const PlateFace& face : faces_of(stack, centre, 1e-3)) {
    bool is_in = ring_contains(face.outer, at);
    for (const Ring& hole : face.holes) is_in = is_in && !ring_contains(hole, at);
    if (is_in) return true;
  }
  return false;
}

// A building of three to five volumes and one that stands alone, as random numbers have it.
std::vector<StandingWish> random_wishes(Random& random) {
  std::vector<StandingWish> wishes;
  const int members = 3 + static_cast<int>(random.uniform(0, 3));
  for (int i = 0; i <= members; ++i) {
    StandingWish& wish = wishes.emplace_back();
    wish.site.site.position = {random.uniform(12, 40), random.uniform(12, 40), 0};
    wish.site.form = static_cast<FootprintForm>(static_cast<int>(random.uniform(0, 3)));
    wish.site.angle = random.uniform(-2, 2);
    wish.site.aspect = random.uniform(0.5, 2);
    wish.site.storey_height = random.uniform(2.5, 5);
    wish.site.depth = random.uniform(0, 1) < 0.4 ? 6 : StandingSite::kAnyDepth;
    wish.storeys = 2 + static_cast<int>(random.uniform(0, 6));
    wish.setback = random.uniform(0, 1) < 0.4 ? 1.5 : 0;
    wish.full_storeys = 1;
    wish.volume = random.uniform(0, 1) < 0.1 ? 0 : random.uniform(100, 900) * wish.site.storey_height;
    wish.order = static_cast<int>(random.uniform(-2, 3));
    if (i > 0 && i < members) wish.host = 0;
  }
  wishes.back().site.site.position = {70, 15, 0};
  return wishes;
}

TEST(SharedBuilding, PlatesAddUpAndNeverOverlap) {
  int cut_storeys = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Random random(seed);
    std::vector<StandingWish> wishes = random_wishes(random);
    StandingTick::Cache kept;
    StandingTick::Outcome outcome;
    for (int tick = 0; tick < 6; ++tick) {
      outcome = StandingTick{.steps = 20, .tolerance = 1e-9}.run(ground(seed % 3 != 0), wishes, kept).value();
      for (std::size_t i = 0; i < wishes.size(); ++i) wishes[i].site.site.weight = outcome.results[i].weight;
    }
    const StandingResult& whole = kept.results[0];
    double floors = 0, asked = 0, volume = 0;
    for (std::size_t i = 0; i + 1 < wishes.size(); ++i) {
      floors += outcome.results[i].floor_area;
      volume += outcome.results[i].volume;
      asked += wishes[i].volume / wishes[i].site.storey_height;
      EXPECT_TRUE(outcome.results[i].is_shared);
    }
    EXPECT_NEAR(floors, whole.floor_area, 1e-12 * whole.floor_area) << seed;
    EXPECT_NEAR(volume, whole.volume, 1e-12 * whole.volume) << seed;
    if (asked > 0) { EXPECT_GT(whole.floor_area, 0) << seed; }
    const double share = whole.floor_area / asked;
    if (outcome.losses.empty() && outcome.message.empty() && asked > 0) {
      EXPECT_NEAR(share, 1, 1e-8) << seed << outcome.message;
    }
    for (std::size_t i = 0; i + 1 < wishes.size(); ++i) {
      const double wanted = wishes[i].volume / wishes[i].site.storey_height;
      EXPECT_NEAR(outcome.results[i].floor_area, share * wanted, 1e-6 * whole.floor_area) << seed << " " << i;
      double sum = 0;
      for (const PlateStack& stack : outcome.results[i].body->stacks) {
        sum += stack.storeys * stack.area;
        EXPECT_GE(stack.storey_height, wishes[i].site.storey_height - 1e-12) << "none is lower than its use asks";
        EXPECT_NEAR(drawn_area(stack, outcome.results[i].body->centre), stack.area, 1e-4 * whole.footprint + 0.02) << seed;
      }
      EXPECT_NEAR(sum, outcome.results[i].floor_area, 1e-12 * whole.floor_area);
    }
    // At each height and place no more than one of them; and one where the building is.
    for (int sample = 0; sample < 60; ++sample) {
      const Point3 at{random.uniform(0, 60), random.uniform(0, 60), 0};
      const double z = random.uniform(0, whole.height);
      int here = 0, there = 0;
      for (const PlateStack& stack : whole.body->stacks)
        there += stack.bottom < z && z < stack.top() && holds(stack, whole.body->centre, at) ? 1 : 0;
      for (std::size_t i = 0; i + 1 < wishes.size(); ++i)
        for (const PlateStack& stack : outcome.results[i].body->stacks) {
          here += stack.bottom < z && z < stack.top() && holds(stack, outcome.results[i].body->centre, at) ? 1 : 0;
          cut_storeys += stack.courtyards.empty() && stack.storeys == 1 ? 1 : 0;
        }
      EXPECT_EQ(here, there) << seed << " at " << at.x << " " << at.y << " " << z;
    }
  }
  EXPECT_GT(cut_storeys, 100);
}

TEST(SharedBuilding, FromTheGroundUpInTheirOrder) {
  std::vector<StandingWish> wishes(3);
  const double areas[] = {600, 1300, 2100}, heights[] = {4.5, 3.5, 3};
  for (std::size_t i = 0; i < 3; ++i) {
    wishes[i].site.site.position = {45, 30, 0};
    wishes[i].site.form = FootprintForm::block;
    wishes[i].site.storey_height = heights[i];
    wishes[i].volume = areas[i] * heights[i];
    wishes[i].order = static_cast<int>(i);
    if (i > 0) wishes[i].host = 0;
  }
  wishes[0].storeys = 5;  // 4000 m² in five plates of 800 m²
  StandingTick::Cache kept;
  auto outcome = StandingTick{.steps = 40, .tolerance = 1e-10}.run(ground(true), wishes, kept).value();
  const auto& [shop, offices, flats] = std::tie(outcome.results[0], outcome.results[1], outcome.results[2]);
  EXPECT_NEAR(shop.floor_area, 600, 1e-3);
  ASSERT_EQ(offices.body->stacks.size(), 3u);
  EXPECT_NEAR(offices.body->stacks[0].area, 200, 1e-3) << "beside the shop";
  EXPECT_DOUBLE_EQ(offices.body->stacks[0].storey_height, 4.5) << "as high as the shop";
  EXPECT_NEAR(offices.body->stacks[1].area, 800, 1e-3);
  EXPECT_NEAR(offices.body->stacks[2].area, 300, 1e-3);
  EXPECT_DOUBLE_EQ(flats.bottom, 4.5 + 3.5);
  EXPECT_DOUBLE_EQ(flats.bottom + flats.height, 4.5 + 3.5 + 3.5 + 3 + 3);
  EXPECT_EQ(flats.stands_on, 1);
  EXPECT_EQ(offices.stands_on, StandingWish::kGround) << "a part of it";
  EXPECT_NEAR(shop.roof_area + offices.roof_area + flats.roof_area, 800, 1e-3);
  EXPECT_NEAR(flats.roof_area, 800, 1e-3);
  // More shop and less flats: the footprint stays, and the parts follow.
  wishes[0].volume = 1600 * 4.5;
  wishes[2].volume = 1100 * 3;
  wishes[0].site.site.weight = outcome.results[0].weight;
  outcome = StandingTick{.steps = 40, .tolerance = 1e-10}.run(ground(true), wishes, kept).value();
  EXPECT_NEAR(outcome.results[0].floor_area, 1600, 1e-3);
  EXPECT_EQ(outcome.differing, (std::vector<std::uint32_t>{0, 1, 2}));
  // Somebody on its roof stands above all of it.
  wishes.push_back(wishes[0]);
  wishes[3].volume = 900;
  wishes[3].base = 2;
  outcome = StandingTick{.steps = 40, .tolerance = 1e-10}.run(ground(true), wishes, kept).value();
  EXPECT_DOUBLE_EQ(outcome.results[3].bottom, kept.results[0].height);
  // Alone again, it is as if it had always been.
  wishes.resize(3);
  wishes[1].host = wishes[2].host = StandingWish::kGround;
  wishes[1].site.site.position = {15, 30, 0};
  wishes[2].site.site.position = {75, 30, 0};
  for (int tick = 0; tick < 8; ++tick) {
    outcome = StandingTick{.steps = 40, .tolerance = 1e-10}.run(ground(true), wishes, kept).value();
    for (std::size_t i = 0; i < 3; ++i) wishes[i].site.site.weight = outcome.results[i].weight;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_FALSE(outcome.results[i].is_shared);
    EXPECT_NEAR(outcome.results[i].volume, wishes[i].volume, 1e-3);
  }
}

TEST(Cellar, LiesUnderTheWholePlate) {
  std::vector<StandingWish> wishes(1);
  wishes[0].site.site.position = {45, 30, 0};
  wishes[0].site.depth = 6;
  wishes[0].volume = 9000;
  wishes[0].storeys = 4;
  StandingTick::Cache kept;
  const auto outcome = StandingTick{.steps = 40, .tolerance = 1e-10}.run(ground(true), wishes, kept).value();
  const StandingBody& body = *outcome.results[0].body;
  const PlateStack cellar = cellar_of(body, 2, 2.8);
  EXPECT_DOUBLE_EQ(cellar.bottom, -5.6);
  EXPECT_DOUBLE_EQ(cellar.top(), 0);
  EXPECT_NEAR(cellar.area, 3.14159265358979323846 * outcome.results[0].weight, 1e-9 * cellar.area) << "a whole disc";
  EXPECT_GT(cellar.area, body.stacks.front().area) << "with the ground of the courtyard";
  EXPECT_EQ(cellar_of(body, 0, 2.8).storeys, 0);
  EXPECT_EQ(cellar_of({}, 2, 2.8).storeys, 0);
}

// 40 by 25 m with a courtyard of 20 by 10 m; the cut runs through it, at 26 2/3 m.
TEST(SharedBuilding, CellarsOfCutPlatesLieUnderTheCourtyardToo) {
  const auto ring = [](double x, double y, double width, double depth) {
    return PlateRing{{{{x, y, 0}}, {{x + width, y, 0}}, {{x + width, y + depth, 0}}, {{x, y + depth, 0}}}, 0};
  };
  StandingBody body;
  body.stacks.push_back({1, 0, 4, 800, {ring(0, 0, 40, 25)}, {ring(10, 7.5, 20, 10)}});
  const SharedBuilding building = share_out(body, std::vector<BuildingShare>{{0, 500, 4}, {1, 300, 4}}, 0);
  EXPECT_NEAR(cellar_of(building.whole, 1, 3).area, 1000, 1e-9);
  EXPECT_NEAR(cellar_of(building.parts[0], 1, 3).area, 25 * 80.0 / 3, 1e-4);
  EXPECT_NEAR(cellar_of(building.parts[1], 1, 3).area, 25 * 40.0 / 3, 1e-4);
  // As drawn, and as it is read again.
  for (const StandingBody& part : building.parts) {
    const PlateStack cellar = cellar_of(part, 2, 3);
    EXPECT_NEAR(drawn_area(cellar, part.centre), cellar.area, 1e-4);
    EXPECT_NEAR(drawn_area(part.stacks.front(), part.centre), part.stacks.front().area, 1e-4);
    Table plates;
    write_body(part, plates);
    EXPECT_EQ(cellar_of(read_body(plates), 2, 3).area, cellar.area);
  }
}

}  // namespace
}  // namespace bl::geometry
