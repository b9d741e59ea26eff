// The live cell complex: names, incidence and degenerate corners.
#include <map>
#include <numeric>

#include "core/geometry/domain_makers.h"
#include "tests/core/geometry/complex_support.h"

namespace bl::test {
namespace {

TEST(ElementNames, AreSortedSetsWithATextOfTheirOwn) {
  EXPECT_EQ(named("{3,7,#2}").text(), "{3,7,#2}");
  EXPECT_EQ(named(" { #2, 7 ,3 } ").text(), "{3,7,#2}");
  EXPECT_EQ((geometry::ElementName{geometry::ElementLabel::side(0), geometry::ElementLabel::site(4294967295u)}).text(),
            "{4294967295,#0}");
  EXPECT_EQ(named("{9,8,7,6,5,4,#1}").text(), "{4,5,6,7,8,9,#1}");
  EXPECT_EQ(
      (geometry::ElementName{geometry::ElementLabel::site(2), geometry::ElementLabel::site(1), geometry::ElementLabel::site(2)})
          .size(),
      2u);
  EXPECT_LT(named("{1,2}"), named("{1,2,3}"));
  EXPECT_LT(named("{1,2,3}"), named("{1,3}"));
  EXPECT_LT(named("{900,901}"), named("{900,#0}"));
  EXPECT_LT(named("{1,2,3,4,5,6}"), named("{1,2,3,4,5,7}"));
  EXPECT_EQ(named("{5,#4}").sites(), std::vector<std::uint32_t>{5});
  for (const char* text : {"", "{", "{}", "3,7", "{3,,7}", "{3;7}", "{3,3}", "{-1}", "{#}", "{1.5}", "{4294967296}", "{1,2"}) {
    EXPECT_FALSE(geometry::ElementName::parse(text).ok()) << text;
  }
}

TEST(CellComplex, OneSiteIsTheDomain) {
  Live live(unit_cube());
  live.update({{{0.3, 0.4, 0.5}, 0.1}});
  EXPECT_EQ(live.complex.count(Kind::cell), 1u);
  EXPECT_EQ(joined(live.complex.names(Kind::facet)), "{0,#0} {0,#1} {0,#2} {0,#3} {0,#4} {0,#5}");
  EXPECT_EQ(live.complex.count(Kind::edge), 12u);
  EXPECT_EQ(live.complex.count(Kind::vertex), 8u);
  EXPECT_EQ(live.complex.position(named("{0,#0,#2,#5}")), (Point3{0, 0, 0}));
  EXPECT_DOUBLE_EQ(live.complex.area(named("{0,#1}")), 1);
  expect_whole(live.complex, "one site");
}

// By hand: a cube halved by the plane x = 1/2.
TEST(CellComplex, TwoSitesShareOneFacet) {
  Live live(unit_cube());
  live.update({{{0.25, 0.5, 0.5}, 0.1}, {{0.75, 0.5, 0.5}, 0.1}});
  const geometry::CellComplex& complex = live.complex;
  EXPECT_EQ(complex.count(Kind::facet), 11u);
  EXPECT_EQ(complex.count(Kind::edge), 20u);
  EXPECT_EQ(complex.count(Kind::vertex), 12u);
  EXPECT_DOUBLE_EQ(complex.area(named("{0,1}")), 1);
  EXPECT_EQ(joined(complex.incident({Kind::facet, named("{0,1}")}, Kind::cell)), "{0} {1}");
  EXPECT_EQ(joined(complex.incident({Kind::facet, named("{0,#0}")}, Kind::cell)), "{0}");
  EXPECT_EQ(joined(complex.incident({Kind::facet, named("{0,1}")}, Kind::edge)), "{0,1,#0} {0,1,#1} {0,1,#2} {0,1,#4}");
  EXPECT_EQ(joined(complex.incident({Kind::edge, named("{0,1,#0}")}, Kind::facet)), "{0,1} {0,#0} {1,#0}");
  EXPECT_EQ(joined(complex.incident({Kind::edge, named("{0,1,#0}")}, Kind::vertex)), "{0,1,#0,#2} {0,1,#0,#4}");
  EXPECT_EQ(complex.incident({Kind::vertex, named("{0,1,#0,#2}")}, Kind::edge).size(), 4u);
  EXPECT_EQ(complex.position(named("{0,1,#0,#2}")), (Point3{0.5, 0, 0}));
  EXPECT_DOUBLE_EQ(complex.length(named("{0,1,#0}")), 1);
  EXPECT_EQ(complex.euler(0), 2);
  const auto polygon = complex.polygons(named("{0,1}")).front();
  EXPECT_GT(cross(polygon[1] - polygon[0], polygon[2] - polygon[1]).x, 0);  // from 0 to 1
  EXPECT_FALSE(complex.has({Kind::facet, named("{1,2}")}));
  EXPECT_TRUE(complex.incident({Kind::facet, named("{1,2}")}, Kind::edge).empty());
  expect_symmetric(complex);
  expect_whole(complex, "two sites");
}

// By hand: all eight cells meet in the middle, four along each half axis, and no two of them diagonally.
TEST(CellComplex, ALatticeOfEightMeetsInOneVertex) {
  Live live(unit_cube());
  live.update(lattice(2, 0.01));
  const geometry::CellComplex& complex = live.complex;
  EXPECT_EQ(complex.count(Kind::vertex), 27u);
  EXPECT_EQ(complex.count(Kind::edge), 54u);
  EXPECT_EQ(complex.count(Kind::facet), 36u);
  EXPECT_EQ(complex.position(named("{0,1,2,3,4,5,6,7}")), (Point3{0.5, 0.5, 0.5}));
  EXPECT_EQ(joined(complex.incident({Kind::vertex, named("{0,1,2,3,4,5,6,7}")}, Kind::edge)),
            "{0,1,2,3} {0,1,4,5} {0,2,4,6} {1,3,5,7} {2,3,6,7} {4,5,6,7}");
  EXPECT_EQ(joined(complex.incident({Kind::edge, named("{0,1,2,3}")}, Kind::facet)), "{0,1} {0,2} {1,3} {2,3}");
  EXPECT_FALSE(complex.has({Kind::facet, named("{0,3}")}));
  expect_symmetric(complex);
  expect_whole(complex, "lattice of eight");
}

TEST(CellComplex, LatticesHoldWhereverTheyLie) {
  for (int n = 3; n <= 5; ++n) {
    Live live(unit_cube());
    live.update(lattice(n));
    const std::size_t m = static_cast<std::size_t>(n);
    EXPECT_EQ(live.complex.count(Kind::vertex), (m + 1) * (m + 1) * (m + 1));
    EXPECT_EQ(live.complex.count(Kind::edge), 3 * m * (m + 1) * (m + 1));
    EXPECT_EQ(live.complex.count(Kind::facet), 3 * m * m * (m + 1));
    expect_whole(live.complex, "lattice");
    // Turned and far away, so that every coordinate is rounded: the same names.
    std::vector<geometry::PowerSite> turned = lattice(n);
    const auto turn = [](const Point3& p) {
      const Point3 q{0.8 * p.x - 0.6 * p.y, 0.6 * p.x + 0.8 * p.y, p.z};
      return Point3{q.x + 1234.5, 0.28 * q.y - 0.96 * q.z - 987.6, 0.96 * q.y + 0.28 * q.z};
    };
    for (geometry::PowerSite& site : turned) site.position = turn(site.position);
    std::vector<Point3> corners;
    for (const Point3& p : unit_cube().vertices) corners.push_back(turn(p));
    Live far(geometry::convex_hull(corners).value());
    far.update(turned);
    EXPECT_EQ(far.complex.count(Kind::vertex), live.complex.count(Kind::vertex));
    EXPECT_EQ(far.complex.count(Kind::edge), live.complex.count(Kind::edge));
    EXPECT_EQ(far.complex.count(Kind::facet), live.complex.count(Kind::facet));
    expect_whole(far.complex, "turned lattice");
  }
}

std::vector<std::pair<std::string, std::vector<geometry::PowerSite>>> zoo() {
  std::vector<std::pair<std::string, std::vector<geometry::PowerSite>>> zoo;
  zoo.emplace_back("none", std::vector<geometry::PowerSite>{});
  zoo.emplace_back("lattice", lattice(4));
  std::vector<geometry::PowerSite> coplanar, collinear, ring, sphere,
      flat{{{0.2, 0.5, 0.5}, 0}, {{0.4, 0.5, 0.5}, -0.04}, {{0.6, 0.5, 0.5}, 0}};
  for (int i = 0; i < 25; ++i) coplanar.push_back({{0.1 + 0.2 * (i % 5), 0.1 + 0.2 * (i / 5), 0.5}, 0.01});
  for (int i = 0; i < 9; ++i) collinear.push_back({{0.1 + 0.1 * i, 0.5, 0.5}, 0.01 * (i % 3)});
  for (int i = 0; i < 12; ++i) ring.push_back({{0.5 + 0.3 * std::cos(i * M_PI / 6), 0.5 + 0.3 * std::sin(i * M_PI / 6), 0.5}, 0});
  for (int i = 0; i < 12; ++i) {  // the corners of an icosahedron: all bisectors through the middle
    const double a = 0.2, b = a * (1 + std::sqrt(5.0)) / 2, s = i % 2 ? a : -a, t = i / 2 % 2 ? b : -b;
    sphere.push_back({i / 4 == 0   ? Point3{0.5, 0.5 + s, 0.5 + t}
                      : i / 4 == 1 ? Point3{0.5 + s, 0.5 + t, 0.5}
                                   : Point3{0.5 + t, 0.5, 0.5 + s},
                      0});
  }
  zoo.emplace_back("coplanar", coplanar);
  zoo.emplace_back("collinear", collinear);
  zoo.emplace_back("ring", ring);
  zoo.emplace_back("sphere", sphere);
  zoo.emplace_back("a cell without thickness", flat);
  std::vector<geometry::PowerSite> twins = random_sites(20, 3, 0, 0.01), outside = random_sites(20, 4, 0, 0.01), crowd;
  for (std::size_t i = 0; i < 5; ++i) twins.push_back(twins[3 * i]);
  for (std::size_t i = 0; i < 20; i += 2) outside[i].position += Vector3{0.9, 0, 0.2};
  crowd = random_sites(60, 5, 0, 0.2);  // many of them hidden
  std::vector<geometry::PowerSite> centred = lattice(3);
  for (const geometry::PowerSite& site : lattice(2)) centred.push_back(site);  // body-centred
  std::vector<geometry::PowerSite> tiny = random_sites(30, 6, 0, 1e-8);
  for (geometry::PowerSite& site : tiny) site.position = Point3{0.5, 0.5, 0.5} + 1e-4 * (site.position - Point3{0.5, 0.5, 0.5});
  std::vector<geometry::PowerSite> noisy = lattice(4);
  Random random(8);
  for (geometry::PowerSite& site : noisy) site.position += random_point(random, {-1e-12, -1e-12, -1e-12}, {1e-12, 1e-12, 1e-12});
  zoo.emplace_back("twins", twins);
  zoo.emplace_back("outside", outside);
  zoo.emplace_back("crowd", crowd);
  zoo.emplace_back("body-centred", centred);
  zoo.emplace_back("tiny", tiny);
  zoo.emplace_back("noisy lattice", noisy);
  return zoo;
}

TEST(CellComplex, HoldsInTheDegenerateZoo) {
  for (const auto& [name, sites] : zoo()) {
    Live live(unit_cube());
    live.update(sites);
    expect_whole(live.complex, name);
    // Every site moved away and back: what lies in degenerate corners changes in parts.
    for (std::size_t i = 0; i < std::min<std::size_t>(sites.size(), 9); ++i) {
      std::vector<geometry::PowerSite> moved = sites;
      moved[i].position += Vector3{0.013, -0.007, 0.011};
      live.update(moved);
      EXPECT_EQ(live.complex.listing(), rebuilt(unit_cube(), moved)) << name << " " << i;
      if (i == 0) expect_whole(live.complex, name + ", one moved");
      live.update(sites);
      EXPECT_EQ(live.complex.listing(), rebuilt(unit_cube(), sites)) << name << " " << i;
    }
  }
}

// The cell between the two bisectors is too thin to be one: those on its sides are neighbours.
TEST(CellComplex, ACellWithoutThicknessIsNone) {
  Live live(unit_cube());
  live.update({{{0.2, 0.5, 0.5}, 0}, {{0.4, 0.5, 0.5}, -0.04}, {{0.6, 0.5, 0.5}, 0}});
  EXPECT_EQ(joined(live.complex.names(Kind::cell)), "{0} {2}");
  EXPECT_NEAR(live.complex.area(named("{0,2}")), 1, 1e-12);
  EXPECT_FALSE(live.complex.has({Kind::facet, named("{0,1}")}));
}

TEST(CellComplex, HiddenSitesHaveNoElements) {
  const auto sites = random_sites(80, 11, 0, 0.15);
  Live live(unit_cube());
  live.update(sites);
  std::size_t hidden = 0;
  for (std::uint32_t i = 0; i < sites.size(); ++i) {
    if (live.diagram.cells()[i].cell_volume > 0) continue;
    ++hidden;
    for (const Kind kind : {Kind::cell, Kind::facet, Kind::edge, Kind::vertex}) {
      for (const geometry::ElementName& name : live.complex.names(kind))
        EXPECT_FALSE(name.contains(geometry::ElementLabel::site(i)));
    }
  }
  EXPECT_GT(hidden, 10u);
  EXPECT_EQ(live.complex.count(Kind::cell) + hidden, sites.size());
  expect_whole(live.complex, "hidden");
}

TEST(CellComplex, RandomSetsHold) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Live live(unit_cube());
    live.update(random_sites(10 * seed, seed, 0, 0.002 * static_cast<double>(seed)));
    expect_whole(live.complex, "random");
    if (seed < 4) expect_symmetric(live.complex);
    // In general position every name has the length of its kind.
    for (const geometry::ElementName& name : live.complex.names(Kind::edge)) EXPECT_EQ(name.size(), 3u);
    for (const geometry::ElementName& name : live.complex.names(Kind::vertex)) EXPECT_EQ(name.size(), 4u);
  }
}

}  // namespace
}  // namespace bl::test
