// Surveys that are kept: whoever has changed beside a shape counts by what of it they cover.
#include "core/facade/survey_cache.h"

#include <gtest/gtest.h>

#include "core/geometry/power_cells.h"
#include "core/geometry/site_domain.h"

namespace bl::facade {
namespace {

// Two volumes side by side, whose wall stands where their weights put it.
std::vector<geometry::CellMeasure> pair_of(double weight) {
  const auto domain = *geometry::site_domain({{{0, 0, 0}, {20, 0, 0}, {20, 10, 0}, {0, 10, 0}}, {}, 0, 9, {}, {}});
  geometry::CellOptions options;
  options.with_coarse_mesh = true;
  options.tessellation_depth = 1;
  const std::vector<geometry::PowerSite> sites{{{5, 5, 4}, 400}, {{15, 5, 4}, weight}};
  return *power_cells(domain, sites, options);
}

SurveyCase case_of(const MeshPointer& mesh, const MeshPointer& beside) { return {"left", mesh, {beside}, {}}; }

TEST(SurveyCache, AnotherNeighbourThatCoversTheSameIsNoNews) {
  const auto cells = pair_of(400);
  SurveyCache cache;
  const FacadeSurvey* first = cache.of({case_of(cells[0].mesh, cells[1].mesh)}, nullptr)[0];
  EXPECT_NEAR(first->shared, 90, 1e-9);
  ASSERT_FALSE(first->rows.empty());
  const FacadeRow* const rows = first->rows.data();
  EXPECT_EQ(cache.of({case_of(cells[0].mesh, pair_of(400)[1].mesh)}, nullptr)[0]->rows.data(), rows) << "it was surveyed again";
}

TEST(SurveyCache, WhatANeighbourLetsGoIsFacade) {
  const auto cells = pair_of(400);
  SurveyCache cache;
  const FacadeSurvey before = *cache.of({case_of(cells[0].mesh, cells[1].mesh)}, nullptr)[0];
  const FacadeSurvey alone = *cache.of({case_of(cells[0].mesh, pair_of(380)[1].mesh)}, nullptr)[0];
  EXPECT_EQ(alone.shared, 0) << "their walls stand elsewhere";
  EXPECT_NEAR(alone.facade, before.facade + 90, 1e-9);
  EXPECT_EQ(cache.of({case_of(cells[0].mesh, cells[1].mesh)}, nullptr)[0]->facade, before.facade);
}

TEST(SurveyCache, AnotherShapeAndOtherOptionsAreSurveyedAnew) {
  const auto cells = pair_of(400), others = pair_of(380);
  SurveyCache cache;
  const FacadeSurvey before = *cache.of({case_of(cells[0].mesh, cells[1].mesh)}, nullptr)[0];
  const FacadeSurvey wider = *cache.of({case_of(others[0].mesh, others[1].mesh)}, nullptr)[0];
  EXPECT_GT(wider.facade, before.facade + 1);
  SurveyCase lower = case_of(others[0].mesh, others[1].mesh);
  lower.options.ground = 3;
  EXPECT_NEAR(cache.of({lower}, nullptr)[0]->facade, wider.facade * 2 / 3, 1e-9);
}

}  // namespace
}  // namespace bl::facade
