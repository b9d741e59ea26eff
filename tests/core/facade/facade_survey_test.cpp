// Façades by hand: boxes, balls, and cells of a diagram, whose parts have to add up to the surface that the solver knows.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/random.h"
#include "core/facade/dressing.h"
#include "core/geometry/power_cells.h"
#include "core/geometry/site_domain.h"

namespace bl::facade {
namespace {

geometry::Domain box(double x, double y, double z) {
  return *geometry::site_domain({{{0, 0, 0}, {x, 0, 0}, {x, y, 0}, {0, y, 0}}, {}, 0, z, {}, {}});
}

std::vector<geometry::CellMeasure> cells_of(const geometry::Domain& domain, const std::vector<geometry::PowerSite>& sites) {
  geometry::CellOptions options;
  options.with_coarse_mesh = true;
  options.tessellation_depth = 1;
  return *power_cells(domain, sites, options);
}

SurveyOptions every(double storey, double sill, double head) {
  SurveyOptions options;
  options.storey_height = storey;
  options.bands.fill({sill, head});
  return options;
}

double of(const FacadeSurvey& survey, Orientation orientation) {
  double sum = 0;
  for (const FacadeRow& row : survey.rows) sum += row.orientation == orientation ? row.area() : 0;
  return sum;
}

TEST(Orientations, TurnWithTrueNorth) {
  EXPECT_EQ(orientation_of({0, 1, 0}, 0), Orientation::north);
  EXPECT_EQ(orientation_of({1, 0, 0.5}, 0), Orientation::east);
  EXPECT_EQ(orientation_of({-1, -1, 0}, 0), Orientation::south_west);
  EXPECT_EQ(orientation_of({0, 1, 0}, 90), Orientation::west) << "true north lies along x";
  EXPECT_EQ(orientation_of({0, 1, 0}, -1000), orientation_of({0, 1, 0}, 80));
  for (std::size_t k = 0; k < kOrientations; ++k)
    EXPECT_EQ(orientation_named(name_of(static_cast<Orientation>(k))), static_cast<Orientation>(k));
  EXPECT_FALSE(orientation_named("up"));
}

TEST(Orientations, ACompassTellsTheSameQuickly) {
  Random random(11);
  for (const double true_north : {0.0, 12.5, -300.0, 45.0}) {
    const Compass compass(true_north);
    for (int i = 0; i < 2000; ++i) {
      // Half of them within a hair of a border between sectors.
      const double border = (22.5 + 45 * std::floor(random.uniform(0, 8)) + true_north) * std::numbers::pi / 180;
      const double bearing = i % 2 == 0 ? random.uniform(0, 7) : border + random.uniform(-2e-11, 2e-11);
      const Vector3 normal = random.uniform(0.1, 3) * Vector3{std::sin(bearing), std::cos(bearing), random.uniform(-1, 1)};
      ASSERT_EQ(compass.of(normal), orientation_of(normal, true_north)) << bearing << " " << true_north;
    }
  }
  EXPECT_EQ(Compass(0).of({0, 0, 1}), Orientation::north);
}

TEST(FacadeSurvey, OfABoxByHand) {
  // One volume that fills 20 x 10 x 9 m: three storeys.
  const auto cells = cells_of(box(20, 10, 9), {{{10, 5, 4}, 1e4}});
  const Mesh& mesh = whole_cell(cells[0].mesh);
  const FacadeSurvey survey = survey_facade(mesh, faces_of(mesh), every(3, 1, 2.5));
  EXPECT_NEAR(survey.facade, 2 * (20 + 10) * 9, 1e-9);
  EXPECT_NEAR(survey.roof, 200, 1e-9);
  EXPECT_NEAR(survey.ground, 200, 1e-9);
  EXPECT_EQ(survey.underside + survey.shared, 0);
  ASSERT_EQ(survey.rows.size(), 12u);
  EXPECT_NEAR(of(survey, Orientation::south), 180, 1e-9);
  EXPECT_NEAR(of(survey, Orientation::east), 90, 1e-9);
  for (const FacadeRow& row : survey.rows) {
    const double width = row.orientation == Orientation::east || row.orientation == Orientation::west ? 10 : 20;
    EXPECT_NEAR(row.below, width, 1e-9);
    EXPECT_NEAR(row.band, 1.5 * width, 1e-9);
    EXPECT_NEAR(row.above, 0.5 * width, 1e-9);
  }
}

TEST(FacadeSurvey, WhatStandsInTheGroundIsNoFacade) {
  const auto cells = cells_of(box(20, 10, 9), {{{10, 5, 4}, 1e4}});
  const Mesh& mesh = whole_cell(cells[0].mesh);
  SurveyOptions options = every(3, 1, 2.5);
  options.ground = 4;
  const FacadeSurvey survey = survey_facade(mesh, faces_of(mesh), options);
  EXPECT_NEAR(survey.facade, 60 * 5, 1e-9);
  EXPECT_NEAR(survey.ground, 200 + 60 * 4, 1e-9);
  EXPECT_EQ(survey.rows.front().storey, 1);
  EXPECT_NEAR(survey.rows.front().below, 0, 1e-9);
  options.ground = -1;
  EXPECT_NEAR(survey_facade(mesh, faces_of(mesh), options).underside, 200, 1e-9) << "it hovers";
}

TEST(FacadeSurvey, OfABallInTheAir) {
  const auto cells = cells_of(box(100, 100, 100), {{{50, 50, 50}, 100}});
  const Mesh& mesh = whole_cell(cells[0].mesh);
  SurveyOptions options = every(4, 1, 3);
  options.spherical_area = cells[0].spherical_area;
  const FacadeSurvey survey = survey_facade(mesh, faces_of(mesh), options);
  const double all = 4 * std::numbers::pi * 100, steep = all * std::numbers::sqrt2 / 2;
  EXPECT_NEAR(survey.facade, steep, 0.02 * steep);
  EXPECT_NEAR(survey.roof, (all - steep) / 2, 0.03 * steep);
  EXPECT_NEAR(survey.roof, survey.underside, 0.01 * steep);
  EXPECT_NEAR(of(survey, Orientation::north), steep / 8, 0.03 * steep);
}

TEST(FacadeSurvey, ACutBallHasExactFlatFaces) {
  // The side x = 0 cuts the ball of radius 10 in 6 m distance: a disc of radius 8.
  const auto cells = cells_of(box(100, 100, 100), {{{6, 50, 50}, 100}});
  const Mesh& mesh = whole_cell(cells[0].mesh);
  SurveyOptions options = every(4, 1, 3);
  options.spherical_area = 0;
  const FacadeSurvey survey = survey_facade(mesh, faces_of(mesh), options);
  EXPECT_NEAR(survey.facade, std::numbers::pi * 64, 1e-9);
  EXPECT_NEAR(of(survey, Orientation::west), std::numbers::pi * 64, 1e-9);
}

// The law: every square metre is counted once, whatever the diagram.
void expect_all_surface(const geometry::Domain& domain, const std::vector<geometry::PowerSite>& sites, double roughness) {
  const auto cells = cells_of(domain, sites);
  std::vector<std::vector<ShapeFace>> faces;
  for (const geometry::CellMeasure& cell : cells)
    faces.push_back(cell.mesh ? faces_of(whole_cell(cell.mesh)) : std::vector<ShapeFace>());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (!cells[i].mesh) continue;
    double shared = 0;
    for (const geometry::FacetArea& facet : cells[i].facets) {
      if (facet.kind != geometry::FacetArea::Kind::site) continue;
      shared += facet.area;
      mark_shared(faces[i], faces[facet.index], 2 * std::sqrt(sites[i].weight));
    }
    SurveyOptions options = every(3.3, 0.9, 2.7);
    options.base = cells[i].bottom;
    const double measured = survey_facade(whole_cell(cells[i].mesh), faces[i], options).facade;
    options.spherical_area = cells[i].spherical_area;
    const FacadeSurvey survey = survey_facade(whole_cell(cells[i].mesh), faces[i], options);
    const double sum = survey.facade + survey.roof + survey.underside + survey.shared + survey.ground;
    EXPECT_NEAR(sum, cells[i].surface_area, 1e-7 * cells[i].surface_area) << i;
    EXPECT_NEAR(survey.shared, shared, 1e-7 * cells[i].surface_area) << i;
    EXPECT_NEAR(measured, survey.facade, roughness * cells[i].surface_area) << i;
    FacadeRules rules;
    rules[2].glazing = 0.9;
    const Dressing dressing = dress(survey, rules, 1.2, 3.3);
    EXPECT_NEAR(dressing.all.area(), survey.facade, 1e-9 * survey.facade + 1e-12) << i;
    double by_orientation = 0, by_storey = 0;
    for (const DressedArea& part : dressing.by_orientation) by_orientation += part.glazed;
    for (const DressedArea& part : dressing.by_storey) by_storey += part.glazed;
    EXPECT_NEAR(by_orientation, dressing.all.glazed, 1e-9 * survey.facade + 1e-12);
    EXPECT_NEAR(by_storey, dressing.all.glazed, 1e-9 * survey.facade + 1e-12);
  }
}

TEST(FacadeSurvey, AllSurfaceIsCountedOnce) {
  Random random(11);
  std::vector<geometry::PowerSite> sites;
  for (int i = 0; i < 40; ++i) {
    const double x = 80 * random.uniform(), y = 60 * random.uniform(), z = 30 * random.uniform(), r = 5 + 8 * random.uniform();
    sites.push_back({{x, y, z}, r * r});
  }
  expect_all_surface(box(80, 60, 30), sites, 0.01);
}

TEST(FacadeSurvey, AllSurfaceOfCellsInSeveralPieces) {
  const auto angle =
      geometry::site_domain({{{0, 0, 0}, {60, 0, 0}, {60, 25, 0}, {25, 25, 0}, {25, 60, 0}, {0, 60, 0}}, {}, 0, 20, {}, {}});
  ASSERT_TRUE(angle.ok());
  // Pieces leave slits along their seams, which only the scale makes up for.
  expect_all_surface(*angle, {{{24, 24, 8}, 300}, {{10, 45, 10}, 160}, {{45, 12, 9}, 200}, {{8, 8, 10}, 90}, {{27, 20, 4}, 60}},
                     0.05);
}

TEST(Dressing, WindowsStandBetweenSillAndBand) {
  const FacadeRule rule{0.5, 3, 1, 0.5, 1000, 100};
  EXPECT_NEAR(most_glazing(rule, 3), 0.5, 1e-15);
  EXPECT_NEAR(window_width(rule, 1, 3), 1, 1e-15);
  EXPECT_NEAR(window_width(rule, 0.5, 3), 0.5, 1e-15);
  EXPECT_EQ(window_width(FacadeRule{0.5, 3, 2, 2, 0, 0}, 1, 3), 0) << "no room at all";
  FacadeSurvey survey;
  survey.facade = 90;
  survey.rows = {{0, Orientation::south, 30, 45, 15}};
  FacadeRules rules;
  rules.fill(rule);
  const Dressing half = dress(survey, rules, 0.5, 3), most = dress(survey, rules, 2, 3);
  EXPECT_NEAR(half.all.glazed, 22.5, 1e-12);
  EXPECT_NEAR(half.all.cost, 22.5 * 1000 + 67.5 * 100, 1e-9);
  EXPECT_NEAR(half.all.panels, 10, 1e-12);
  EXPECT_EQ(half.missing, 0);
  EXPECT_NEAR(most.all.glazed, 45, 1e-12);
  EXPECT_NEAR(most.missing, 45, 1e-12);
}

TEST(PolygonInADisc, ByHand) {
  const std::vector<std::array<double, 2>> square{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  EXPECT_NEAR(polygon_disc_area(square, 100), 4, 1e-12);
  EXPECT_NEAR(polygon_disc_area(square, 0.25), 0.25 * std::numbers::pi, 1e-12);
  const std::vector<std::array<double, 2>> half{{0, -9}, {9, -9}, {9, 9}, {0, 9}};
  EXPECT_NEAR(polygon_disc_area(half, 4), 2 * std::numbers::pi, 1e-12);
  const std::vector<std::array<double, 2>> away{{5, 5}, {6, 5}, {6, 6}};
  EXPECT_NEAR(polygon_disc_area(away, 4), 0, 1e-12);
}

}  // namespace
}  // namespace bl::facade
