// Footprints, plates and their responses: figures that a reader can do by hand, derivatives, and the bits of kept diagrams.
#include <cmath>

#include <gtest/gtest.h>

#include "core/base/parallel.h"
#include "core/geometry/site_domain.h"
#include "tests/core/geometry/standing_zoo.h"

namespace bl::test {
namespace {

using geometry::FootprintDiagram;
using geometry::FootprintForm;
using geometry::FootprintMeasure;
using geometry::SiteState;
using geometry::StandingSite;

StandingSite round_one(double x, double y, double weight) {
  StandingSite site;
  site.site = {{x, y, 0}, weight};
  site.runs = {{1, 0}};
  return site;
}

// Measured anew. The plot is kept, because to erode one that is not convex takes longer than all the rest.
std::vector<FootprintMeasure> measured(const geometry::Domain& plot, const std::vector<StandingSite>& sites) {
  static FootprintDiagram diagram;
  EXPECT_TRUE(diagram.set_domain(plot));
  const auto none = diagram.update({});
  EXPECT_TRUE(none && none->empty());
  const auto found = diagram.update(sites);
  EXPECT_TRUE(found) << found.error().text();
  return {found->begin(), found->end()};
}

geometry::Domain square_of_40() { return plot_of({{0, 0, 0}, {40, 0, 0}, {40, 40, 0}, {0, 40, 0}}); }

// The part of a disc on the near side of a chord at this distance from the centre.
double beside_chord(double radius, double distance) {
  const double half = std::sqrt(radius * radius - distance * distance);
  return kUnitDisc * radius * radius - radius * radius * std::acos(distance / radius) + distance * half;
}

TEST(Footprint, ADiscAlone) {
  StandingSite site = round_one(20, 20, 25);
  site.runs = {{3, 0}};
  const FootprintMeasure m = measured(square_of_40(), {site}).front();
  EXPECT_EQ(m.state, SiteState::alive);
  EXPECT_NEAR(m.footprint, 25 * kUnitDisc, 1e-12);
  EXPECT_NEAR(m.floor_area, 75 * kUnitDisc, 1e-11);
  EXPECT_NEAR(m.volume, 225 * kUnitDisc, 1e-10);
  EXPECT_NEAR(m.own_response, 3 * kUnitDisc, 1e-12) << "the area of a disc is pi times its weight";
  EXPECT_EQ(m.own_response, m.free_response);
  EXPECT_TRUE(m.neighbours.empty());
}

TEST(Footprint, ADiscAtAStraightBorder) {
  const FootprintMeasure m = measured(square_of_40(), {round_one(3, 20, 25)}).front();
  EXPECT_NEAR(m.floor_area, beside_chord(5, 3), 1e-12);
  EXPECT_NEAR(m.own_response, (2 * kUnitDisc - 2 * std::acos(0.6)) * 5 / 10, 1e-12)
      << "the length of its arc over twice its radius";
}

TEST(Footprint, TwoDiscsWithACommonChord) {
  const auto both = measured(square_of_40(), {round_one(10, 20, 25), round_one(16, 20, 25)});
  for (std::uint32_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(both[i].floor_area, beside_chord(5, 3), 1e-12);
    ASSERT_EQ(both[i].neighbours.size(), 1u);
    EXPECT_EQ(both[i].neighbours[0].site, 1 - i);
    EXPECT_NEAR(both[i].neighbours[0].wall, 8, 1e-12);
    EXPECT_NEAR(both[i].neighbours[0].response, 8.0 / 12, 1e-12);
  }
}

TEST(Footprint, ABlockAtAnAngleAndWithinASetback) {
  StandingSite site = round_one(20, 20, 18);
  site.form = FootprintForm::block;
  site.angle = kUnitDisc / 6;
  site.aspect = 2;
  site.runs = {{2, 0}, {1, 1}};
  const FootprintMeasure m = measured(square_of_40(), {site}).front();
  ASSERT_EQ(m.plates.size(), 2u);
  EXPECT_NEAR(m.plates[0], 72, 1e-11) << "12 m by 6 m";
  EXPECT_NEAR(m.plates[1], 40, 1e-11) << "10 m by 4 m";
  EXPECT_NEAR(m.floor_area, 2 * 72 + 40, 1e-11);
  // Its first side reaches 6 m either way along the angle, and no farther.
  site.site.position = {40 - 6 * std::cos(kUnitDisc / 6) - 3 * std::sin(kUnitDisc / 6), 20, 0};
  EXPECT_NEAR(measured(square_of_40(), {site}).front().plates[0], 72, 1e-10);
  site.site.position.x += 0.1;
  EXPECT_LT(measured(square_of_40(), {site}).front().plates[0], 71.99);
}

TEST(Footprint, ACourtyardIsWhatLiesDeeperThanTheDepth) {
  StandingSite site = round_one(20, 20, 100);
  site.depth = 4;
  site.runs = {{1, 0}, {1, 2}, {1, 7}};
  const FootprintMeasure m = measured(square_of_40(), {site}).front();
  EXPECT_NEAR(m.plates[0], kUnitDisc * (100 - 36), 1e-11);
  EXPECT_NEAR(m.plates[1], kUnitDisc * (64 - 16), 1e-11);
  EXPECT_NEAR(m.plates[2], kUnitDisc * 9, 1e-11) << "too small for a courtyard";
  EXPECT_NEAR(m.own_response, (2 * kUnitDisc / 20) * ((10 - 6) + (8 - 4) + 3), 1e-12);
}

TEST(Footprint, SetbacksLeaveLessAndThenNothing) {
  StandingSite site = round_one(20, 20, 25);
  site.runs = {{2, 0}, {1, 2}, {4, 6}};
  const FootprintMeasure m = measured(square_of_40(), {site}).front();
  EXPECT_EQ(m.state, SiteState::alive);
  EXPECT_NEAR(m.plates[1], 9 * kUnitDisc, 1e-12);
  EXPECT_EQ(m.plates[2], 0);
  EXPECT_NEAR(m.floor_area, (50 + 9) * kUnitDisc, 1e-11);
}

TEST(Footprint, PartyWallsStandOnTheBorder) {
  std::vector<StandingSite> sites{round_one(10, 20, 25), round_one(16, 20, 25)};
  for (StandingSite& site : sites) site.runs = {{1, 1}};
  EXPECT_NEAR(measured(square_of_40(), sites)[0].floor_area, beside_chord(4, 2), 1e-12);
  sites[0].has_party_walls = true;
  const auto both = measured(square_of_40(), sites);
  EXPECT_NEAR(both[0].floor_area, beside_chord(4, 3), 1e-12);
  EXPECT_NEAR(both[1].floor_area, beside_chord(4, 2), 1e-12) << "the other one keeps its distance";
}

TEST(Footprint, InnerFacesOfAPlotAreNoWalls) {
  const geometry::Domain plot = plot_of({{0, 0, 0}, {30, 0, 0}, {30, 10, 0}, {10, 10, 0}, {10, 30, 0}, {0, 30, 0}});
  // However the plot is cut into convex pieces, one of these lies across the cut.
  for (const Point3& at : {Point3{5, 10, 0}, Point3{10, 5, 0}, Point3{6, 6, 0}}) {
    StandingSite site = round_one(at.x, at.y, 16);
    site.runs = {{1, 0}, {1, 1}};
    const FootprintMeasure m = measured(plot, {site}).front();
    EXPECT_NEAR(m.plates[0], 16 * kUnitDisc, 1e-11);
    EXPECT_NEAR(m.plates[1], 9 * kUnitDisc, 1e-7);
    EXPECT_NEAR(m.own_response, kUnitDisc + 2 * kUnitDisc * 3 / 8, 1e-7);
  }
  StandingSite all = round_one(5, 5, 0);
  all.form = FootprintForm::cell;
  all.runs = {{1, 0}, {1, 2}};
  const FootprintMeasure m = measured(plot, {all}).front();
  EXPECT_NEAR(m.plates[0], 500, 1e-9);
  EXPECT_NEAR(m.plates[1], 280 - kUnitDisc, 1e-6) << "a quarter of a circle about the inner corner";
}

TEST(Footprint, AHoleKeepsItsDistance) {
  const geometry::Domain plot =
      plot_of({{0, 0, 0}, {40, 0, 0}, {40, 40, 0}, {0, 40, 0}}, {{{15, 15, 0}, {15, 25, 0}, {25, 25, 0}, {25, 15, 0}}});
  StandingSite all = round_one(5, 5, 0);
  all.form = FootprintForm::cell;
  all.runs = {{1, 0}, {1, 1}};
  const FootprintMeasure m = measured(plot, {all}).front();
  EXPECT_NEAR(m.plates[0], 1500, 1e-9);
  EXPECT_NEAR(m.plates[1], 38 * 38 - (100 + 40 + kUnitDisc), 1e-6);
  EXPECT_NEAR(measured(plot, {round_one(20, 20, 100)}).front().floor_area, 100 * kUnitDisc - 100, 1e-10)
      << "a disc around the hole";
}

TEST(Footprint, SitesWithoutRoomSayWhy) {
  const auto m =
      measured(square_of_40(), {round_one(20, 20, 25), round_one(20, 20, 9), round_one(21, 20, 0), round_one(60, 20, 4)});
  EXPECT_EQ(m[0].state, SiteState::alive);
  EXPECT_EQ(m[1].state, SiteState::coincident);
  EXPECT_EQ(m[2].state, SiteState::starved);
  EXPECT_EQ(m[3].state, SiteState::starved);
  for (std::size_t i = 1; i < 4; ++i) EXPECT_EQ(m[i].floor_area, 0);
}

TEST(Footprint, AbsurdSitesAreRefusedWithTheirNumber) {
  FootprintDiagram diagram;
  ASSERT_TRUE(diagram.set_domain(square_of_40()));
  const auto refused = [&](auto change) {
    std::vector<StandingSite> sites(2, round_one(20, 20, 25));
    change(sites[1]);
    const auto found = diagram.update(sites);
    return !found && found.error().place == "sites/1";
  };
  EXPECT_TRUE(refused([](StandingSite& s) { s.site.weight = std::nan(""); }));
  EXPECT_TRUE(refused([](StandingSite& s) { s.site.position.x = 1e300; }));
  EXPECT_TRUE(refused([](StandingSite& s) { s.depth = 0; }));
  EXPECT_TRUE(refused([](StandingSite& s) { s.aspect = 0; }));
  EXPECT_TRUE(refused([](StandingSite& s) { s.angle = std::nan(""); }));
  EXPECT_TRUE(refused([](StandingSite& s) { s.storey_height = -1; }));
  EXPECT_TRUE(refused([](StandingSite& s) { s.runs = {{0, 0}}; }));
  EXPECT_TRUE(refused([](StandingSite& s) { s.runs = {{1, -1}}; }));
}

// --- Laws over random sets ---------------------------------------------------------------------------------------------------

TEST(FootprintLaws, ResponsesAreDerivatives) {
  double worst = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    // Of plots that are not convex, an eroded border has chords for arcs, and the difference is no derivative of a smooth thing.
    const geometry::Domain plot = plot_of(seed % 2 == 0 ? PlotShape::square : PlotShape::hexagon);
    std::vector<StandingSite> sites = random_standing(12, seed);
    const auto before = measured(plot, sites);
    const auto moved = static_cast<std::uint32_t>(seed % 12);
    const double weight = sites[moved].site.weight, step = 1e-4;
    sites[moved].site.weight = weight + step;
    const auto more = measured(plot, sites);
    sites[moved].site.weight = weight - step;
    const auto less = measured(plot, sites);
    for (std::uint32_t i = 0; i < sites.size(); ++i) {
      double expected = i == moved ? before[i].own_response : 0;
      for (const FootprintMeasure::Neighbour& n : before[i].neighbours)
        if (n.site == moved) expected = -n.response;
      const double found = (more[i].floor_area - less[i].floor_area) / (2 * step);
      EXPECT_NEAR(found, expected, 2e-5 * (1 + std::abs(expected))) << "seed " << seed << ", site " << i;
      worst = std::max(worst, std::abs(found - expected));
    }
  }
  EXPECT_GT(worst, 0) << "nothing was compared";
}

TEST(FootprintLaws, ResponsesHaveTheirSignsAndBalance) {
  for (const PlotShape shape : kPlotShapes)
    for (std::uint64_t seed = 1; seed <= 20; ++seed)
      for (const FootprintMeasure& m : measured(plot_of(shape), random_standing(20, seed))) {
        double others = 0;
        for (const FootprintMeasure::Neighbour& n : m.neighbours) others += n.response;
        EXPECT_NEAR(m.own_response, others + m.free_response, 1e-9 * (1 + m.own_response));
        if (shape != PlotShape::square && shape != PlotShape::hexagon) continue;
        EXPECT_GE(m.free_response, -1e-9);
        for (const FootprintMeasure::Neighbour& n : m.neighbours) EXPECT_GE(n.response, -1e-9);
      }
}

TEST(FootprintLaws, PlatesAddUpToFloors) {
  for (const PlotShape shape : kPlotShapes)
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      const std::vector<StandingSite> sites = random_standing(20, seed);
      const auto found = measured(plot_of(shape), sites);
      for (std::size_t i = 0; i < sites.size(); ++i) {
        double sum = 0;
        for (std::size_t r = 0; r < sites[i].runs.size(); ++r) sum += sites[i].runs[r].storeys * found[i].plates[r];
        EXPECT_NEAR(found[i].floor_area, sum, 1e-12 * sum);
        EXPECT_NEAR(found[i].volume, sum * sites[i].storey_height, 1e-12 * found[i].volume);
      }
    }
}

bool is_same(const FootprintMeasure& a, const FootprintMeasure& b) {
  if (a.state != b.state || a.plates != b.plates || a.neighbours.size() != b.neighbours.size()) return false;
  if (a.footprint != b.footprint || a.floor_area != b.floor_area || a.volume != b.volume) return false;
  if (a.own_response != b.own_response || a.free_response != b.free_response) return false;
  for (std::size_t k = 0; k < a.neighbours.size(); ++k) {
    const auto &x = a.neighbours[k], &y = b.neighbours[k];
    if (x.site != y.site || x.wall != y.wall || x.response != y.response) return false;
  }
  return true;
}

TEST(FootprintLaws, KeptDiagramsEqualFreshOnesAfterAnyMove) {
  for (const PlotShape shape : kPlotShapes) {
    const geometry::Domain plot = plot_of(shape);
    std::vector<StandingSite> sites = random_standing(30, 7);
    const std::vector<StandingSite> others = random_standing(200, 11);
    FootprintDiagram kept;
    ASSERT_TRUE(kept.set_domain(plot));
    Random random(5);
    std::size_t left_out = 0;
    for (int move = 0; move < 60; ++move) {
      StandingSite& site = sites[random.below(sites.size())];
      const std::uint64_t kind = random.below(6);
      if (kind == 0) site.site.position.x += random.uniform(-3, 3);
      if (kind == 1) site.site.weight *= random.uniform(0.5, 1.5);
      if (kind == 2) site = others[random.below(others.size())];
      if (kind == 3) site.site.position = sites[random.below(sites.size())].site.position;
      if (kind == 4) sites.push_back(others[random.below(others.size())]);
      if (kind == 5) sites.pop_back();
      const auto now = kept.update(sites);
      ASSERT_TRUE(now);
      left_out += sites.size() - kept.made().size();
      const auto fresh = measured(plot, sites);
      for (std::size_t i = 0; i < sites.size(); ++i)
        ASSERT_TRUE(is_same((*now)[i], fresh[i])) << "move " << move << ", site " << i;
    }
    EXPECT_GT(left_out, 60u) << "most moves touch a few only";
  }
}

TEST(FootprintLaws, ThreadsChangeNoBit) {
  for (const PlotShape shape : kPlotShapes) {
    const std::vector<StandingSite> sites = random_standing(300, 3);
    const auto one = measured(plot_of(shape), sites);
    for (const int threads : {2, 3}) {
      ThreadPool pool(threads);
      FootprintDiagram diagram;
      ASSERT_TRUE(diagram.set_domain(plot_of(shape)));
      const auto found = diagram.update(sites, &pool);
      ASSERT_TRUE(found);
      for (std::size_t i = 0; i < sites.size(); ++i) ASSERT_TRUE(is_same((*found)[i], one[i])) << "site " << i;
    }
  }
}

// Each kind of side has its distance: 40 m by 40 m, the street along the south, and one more volume to the east.
TEST(Footprint, EachKindOfSideHasItsDistance) {
  FootprintDiagram diagram;
  const std::vector<geometry::StreetAxis> streets{{{{-10, -5, 0}, {50, -6, 0}}, 8}};
  ASSERT_TRUE(diagram.set_domain(square_of_40(), streets));
  StandingSite west = round_one(10, 20, 0), east = round_one(30, 20, 0);
  west.form = east.form = FootprintForm::cell;
  west.runs = {{1, 0}, {1, 2}};
  west.border_distance = 1;
  west.street_distance = 5;
  const auto area = [&](const StandingSite& site, std::size_t run) {
    const auto found = diagram.update(std::vector<StandingSite>{site, east});
    EXPECT_TRUE(found) << found.error().text();
    return found->front().plates[run];
  };
  EXPECT_NEAR(area(west, 0), 19 * 34, 1e-9) << "1 m in the west and north, 5 m in the south, none towards the neighbour";
  EXPECT_NEAR(area(west, 1), 15 * 30, 1e-9) << "2 m more on each side";
  west.has_party_walls = true;
  EXPECT_NEAR(area(west, 1), 17 * 30, 1e-9);
  west.has_border_walls = true;
  EXPECT_NEAR(area(west, 1), 19 * 32, 1e-9) << "2 m at the street alone";
  west.depth = 10;
  EXPECT_NEAR(area(west, 0), 19 * 34, 1e-9) << "10 m from the west and from the east: nothing is left for a courtyard";
  west.wing_depth = 4;
  EXPECT_NEAR(area(west, 0), 19 * 34 - 11 * 20, 1e-9) << "wings of 4 m along the walls that touch, 10 m along the street";
  EXPECT_NEAR(area(west, 1), 19 * 32 - 11 * 18, 1e-9);
  west.runs[1].courtyard = 2;
  EXPECT_NEAR(area(west, 1), 19 * 32 - 15 * 22, 1e-9) << "2 m behind that edge on each side";
  // Where a street meets a border in a wide corner, the border keeps its distance beyond its end.
  StandingSite alone = west;
  alone = round_one(20, 20, 0);
  alone.form = FootprintForm::cell;
  alone.border_distance = 5;
  ASSERT_TRUE(diagram.set_domain(plot_of({{0, 0, 0}, {40, 0, 0}, {60, 20, 0}, {60, 40, 0}, {0, 40, 0}}), streets));
  const auto wide = diagram.update(std::vector<StandingSite>{alone});
  ASSERT_TRUE(wide) << wide.error().text();
  // 2 200 m², less strips of 5 m: west 200 and north 300 share 25; the slope 141.42 ends in a sector of 45 degrees at the street,
  // and shares with the east what lies between the bisector and both: 25 tan(22.5 deg); the east 100 shares 25 with the north.
  const double slope = 5 * 20 * std::sqrt(2.0), sector = 25 * kUnitDisc / 8, wedge = 25 * std::tan(kUnitDisc / 8);
  EXPECT_NEAR(wide->front().plates[0], 2200 - (200 + 300 - 25) - (slope + sector) - (100 - 25) + wedge, 1e-4);
}

// What is left of 40 m by 40 m for one volume, where the plot leaves out one polygon.
double left_beside(const std::vector<Point3>& gone, double border, double exclusion, double setback = 0) {
  const std::vector<Point3> plan{{0, 0, 0}, {40, 0, 0}, {40, 40, 0}, {0, 40, 0}};
  const auto domain = geometry::site_domain({plan, {}, 0, 60, {}, {{gone, 0, 60}}});
  EXPECT_TRUE(domain) << domain.error().text();
  const geometry::Domain land = square_of_40();
  FootprintDiagram diagram;
  EXPECT_TRUE(diagram.set_domain(*domain, {}, &land));
  StandingSite alone = round_one(10, 10, 0);
  alone.form = FootprintForm::cell;
  alone.runs = {{1, setback}};
  alone.border_distance = alone.street_distance = border;
  alone.exclusion_distance = exclusion;
  const auto found = diagram.update(std::vector<StandingSite>{alone});
  EXPECT_TRUE(found) << found.error().text();
  return found->front().plates[0];
}

// The border of the plot is one thing, a tree or a street inside it another one.
TEST(Footprint, GroundThatIsLeftOutHasADistanceOfItsOwn) {
  const std::vector<Point3> pit{{18, 18, 0}, {22, 18, 0}, {22, 22, 0}, {18, 22, 0}};
  EXPECT_NEAR(left_beside(pit, 0, 0), 1600 - 16, 1e-9);
  EXPECT_NEAR(left_beside(pit, 3, 0), 34 * 34 - 16, 1e-4) << "the border alone has 3 m";
  EXPECT_NEAR(left_beside(pit, 3, 1), 34 * 34 - 16 - 16 - kUnitDisc, 1e-4) << "1 m about the pit, round at its corners";
  EXPECT_NEAR(left_beside(pit, 0, 1), 1600 - 16 - 16 - kUnitDisc, 1e-4);
  EXPECT_NEAR(left_beside(pit, 3, 1, 1), 32 * 32 - 16 - 4 * 4 * 2 - 4 * kUnitDisc, 1e-4) << "upper storeys step back from both";
  EXPECT_EQ(left_beside(pit, 0, 57), 0) << "no place is so far from it";
  // A street that takes a strip of the border: the border behind it still counts.
  const std::vector<Point3> street{{39, -5, 0}, {45, -5, 0}, {45, 45, 0}, {39, 45, 0}};
  EXPECT_NEAR(left_beside(street, 3, 0), 34 * 34, 1e-4);
  EXPECT_NEAR(left_beside(street, 0, 0), 39 * 40, 1e-9);
  EXPECT_NEAR(left_beside(street, 3, 5), 31 * 34, 1e-4);
  // A pond at the border, wider there than inside: about its ends there are parts of a disc.
  const std::vector<Point3> pond{{16, -4, 0}, {28, -4, 0}, {24, 4, 0}, {20, 4, 0}};
  const double around = 24 + 10 * std::sqrt(20.0) + 20 + 12.5 * kUnitDisc;
  EXPECT_NEAR(left_beside(pond, 0, 5), 1600 - around, 1e-4);
}

// A block of 20 m by 16 m whose eastern side comes to lie behind the wall that it shares with a neighbour. Its floor follows the
// wall without a jump, and falls nowhere by more than the wall takes: weights can give it every floor area in between.
TEST(Footprint, ASideThatGetsHiddenGivesUpItsDepthLittleByLittle) {
  StandingSite block = round_one(20, 20, 80);
  block.form = FootprintForm::block;
  block.aspect = 100.0 / 80;
  block.depth = 5;
  block.wing_depth = 3;
  block.has_party_walls = true;
  StandingSite neighbour = round_one(50, 20, 0);
  neighbour.form = FootprintForm::cell;
  const geometry::Domain plot = plot_of({{0, 0, 0}, {80, 0, 0}, {80, 40, 0}, {0, 40, 0}});
  // The wall at this distance from the middle of the block.
  const auto floor_at = [&](double wall) {
    neighbour.site.weight = 900 + 80 - 60 * wall;
    return measured(plot, {block, neighbour}).front().floor_area;
  };
  EXPECT_NEAR(floor_at(12), 20 * 16 - 10 * 6, 1e-9) << "a facade: 5 m on each side";
  EXPECT_NEAR(floor_at(10), 20 * 16 - 10 * 6, 1e-9);
  EXPECT_NEAR(floor_at(9), 19 * 16 - 10 * 6, 1e-9) << "the side behind the wall still keeps 5 m: 4 m from the wall";
  EXPECT_NEAR(floor_at(8), 18 * 16 - 10 * 6, 1e-9) << "3 m from the wall";
  EXPECT_NEAR(floor_at(6), 16 * 16 - 8 * 6, 1e-9) << "and no less";
  double before = floor_at(12);
  for (double wall = 12; wall > 6; wall -= 0.01) {
    const double now = floor_at(wall);
    EXPECT_LE(now, before + 1e-9) << wall;
    EXPECT_GE(now, before - 0.01 * 16 - 1e-9) << wall;
    before = now;
  }
}

}  // namespace
}  // namespace bl::test
