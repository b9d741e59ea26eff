// Places of open space in a new plan: inside, apart, of the wanted size, and the same every time.
#include <gtest/gtest.h>

#include <cmath>

#include "core/making/open_places.h"

namespace bl::making {
namespace {

importing::ProgrammeRow open_row(const std::string& use, double area, int count = 1) {
  importing::ProgrammeRow row;
  row.use = row.name = use;
  row.floor_area = area;
  row.count = count;
  row.is_open = true;
  return row;
}

const geometry::Ring kOpenPlan = {{0, 0, 0}, {100, 0, 0}, {100, 60, 0}, {40, 60, 0}, {40, 30, 0}, {0, 30, 0}};  // an L of 4800 m²

void expect_sound(const std::vector<OpenPlace>& places, const geometry::Ring& plan, const std::vector<geometry::Ring>& holes) {
  for (std::size_t a = 0; a < places.size(); ++a) {
    EXPECT_FALSE(geometry::find_crossing(places[a].ring, plan));
    for (const Point3& corner : places[a].ring) EXPECT_TRUE(geometry::ring_contains(plan, corner));
    std::vector<geometry::Ring> others = holes;
    for (std::size_t b = 0; b < a; ++b) others.push_back(places[b].ring);
    for (const geometry::Ring& other : others) {
      EXPECT_FALSE(geometry::find_crossing(places[a].ring, other));
      EXPECT_FALSE(geometry::ring_contains(other, places[a].ring.front()));
      EXPECT_FALSE(geometry::ring_contains(places[a].ring, other.front()));
    }
    EXPECT_GT(geometry::signed_area(places[a].ring), 0);
    EXPECT_NEAR(geometry::signed_area(places[a].ring), places[a].area, 1e-12);
  }
}

TEST(OpenPlaces, LieInsideApartAndHaveTheirSize) {
  const std::vector<geometry::Ring> holes = {{{60, 20, 0}, {60, 40, 0}, {80, 40, 0}, {80, 20, 0}}};
  importing::ProgrammeRow housing = open_row("housing", 5000);
  housing.is_open = false;
  std::vector<std::string> notes;
  const auto places = lay_open_places(kOpenPlan, holes, {open_row("garden", 150, 4), housing, open_row("square", 400)}, notes);
  ASSERT_EQ(places.size(), 5u);
  expect_sound(places, kOpenPlan, holes);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(places[k].area, 150, 1e-3) << places[k].name;
  EXPECT_EQ(places[0].name, "garden 1");
  EXPECT_EQ(places[4].name, "square");
  EXPECT_EQ(places[4].row, 2u);
  EXPECT_NEAR(places[4].area, 400, 1e-3);
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_EQ(notes[1].substr(0, 62), "`square` is open space: 1 rectangle of 400.0 m² is kept open,");
  std::vector<std::string> again;
  EXPECT_EQ(lay_open_places(kOpenPlan, holes, {open_row("garden", 150, 4), housing, open_row("square", 400)}, again).at(4).ring,
            places[4].ring);
}

TEST(OpenPlaces, FollowTheMainDirectionOfATurnedPlan) {
  geometry::Ring turned;
  for (const Point3& p : {Point3{0, 0, 0}, {80, 0, 0}, {80, 40, 0}, {0, 40, 0}})
    turned.push_back({0.8 * p.x - 0.6 * p.y + 500, 0.6 * p.x + 0.8 * p.y - 900, 0});
  std::vector<std::string> notes;
  const auto places = lay_open_places(turned, {}, {open_row("park", 900)}, notes);
  ASSERT_EQ(places.size(), 1u);
  expect_sound(places, turned, {});
  const Vector3 side = places[0].ring[1] - places[0].ring[0];
  EXPECT_NEAR(side.y / side.x, 0.75, 1e-6);
  EXPECT_NEAR(places[0].area, 900, 1e-3);
}

TEST(OpenPlaces, WhatDoesNotFitBecomesSmallerAndIsTold) {
  std::vector<std::string> notes;
  auto places = lay_open_places(kOpenPlan, {}, {open_row("park", 6000)}, notes);
  ASSERT_EQ(places.size(), 1u);
  expect_sound(places, kOpenPlan, {});
  EXPECT_LT(places[0].area, 4800);
  EXPECT_GT(places[0].area, 2000);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("No more of the 6000.0 m² that are asked for fits in one piece."), std::string::npos) << notes[0];
  notes.clear();
  places = lay_open_places(kOpenPlan, {}, {open_row("forest", 1e7)}, notes);
  EXPECT_TRUE(places.empty());
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("no place for it was found"), std::string::npos) << notes[0];
}

}  // namespace
}  // namespace bl::making
