// The live cell complex: names, incidence, degenerate corners, and that updates end where building anew ends.
#include "core/geometry/cell_complex.h"

#include <map>
#include <numeric>

#include "core/geometry/domain_makers.h"
#include "tests/core/geometry/geometry_support.h"

namespace bl::test {
namespace {

using Kind = ElementKind;

ElementName named(const char* text) {
  const auto name = ElementName::parse(text);
  EXPECT_TRUE(name.ok()) << text;
  return name.ok() ? *name : ElementName{};
}

std::string joined(const std::vector<ElementName>& names) {
  std::string text;
  for (const ElementName& name : names) text += (text.empty() ? "" : " ") + name.text();
  return text;
}

CellOptions outlines() {
  CellOptions options;
  options.with_outlines = true;
  return options;
}

/// A diagram and the complex that follows it.
struct Live {
  PowerDiagram diagram;
  CellComplex complex;
  explicit Live(const Domain& domain) { EXPECT_TRUE(diagram.set_domain(domain).ok()); }
  void update(const std::vector<PowerSite>& sites) {
    const auto cells = diagram.update(sites, outlines());
    ASSERT_TRUE(cells.ok()) << cells.error().text();
    const auto done = complex.update(diagram, sites);
    ASSERT_TRUE(done.ok()) << done.error().text();
  }
};

std::string rebuilt(const Domain& domain, const std::vector<PowerSite>& sites, const std::vector<std::uint32_t>& labels = {}) {
  Live fresh(domain);
  EXPECT_TRUE(fresh.complex.set_labels(labels).ok());
  fresh.update(sites);
  return fresh.complex.listing();
}

void expect_whole(const CellComplex& complex, const std::string& what) {
  for (const std::string& complaint : complex.verify()) ADD_FAILURE() << what << ": " << complaint;
}

/// Incidence asked from one side is what is answered from the other.
void expect_symmetric(const CellComplex& complex) {
  for (const Kind kind : {Kind::cell, Kind::facet, Kind::edge, Kind::vertex}) {
    for (const Kind other : {Kind::cell, Kind::facet, Kind::edge, Kind::vertex}) {
      if (kind == other) continue;
      std::size_t there = 0, back = 0;
      for (const ElementName& name : complex.names(kind)) {
        for (const ElementName& found : complex.incident({kind, name}, other)) {
          ++there;
          const auto answers = complex.incident({other, found}, kind);
          EXPECT_TRUE(std::binary_search(answers.begin(), answers.end(), name)) << name.text() << " " << found.text();
        }
      }
      for (const ElementName& name : complex.names(other)) back += complex.incident({other, name}, kind).size();
      EXPECT_EQ(there, back);
    }
  }
}

std::vector<PowerSite> lattice(int n, double weight = 0) {
  std::vector<PowerSite> sites;
  for (int i = 0; i < n * n * n; ++i) {
    const auto at = [&](int k) { return (k + 0.5) / n; };
    sites.push_back({{at(i % n), at(i / n % n), at(i / n / n)}, weight});
  }
  return sites;
}

TEST(ElementNames, AreSortedSetsWithATextOfTheirOwn) {
  EXPECT_EQ(named("{3,7,#2}").text(), "{3,7,#2}");
  EXPECT_EQ(named(" { #2, 7 ,3 } ").text(), "{3,7,#2}");
  EXPECT_EQ((ElementName{ElementLabel::side(0), ElementLabel::site(4294967295u)}).text(), "{4294967295,#0}");
  EXPECT_EQ(named("{9,8,7,6,5,4,#1}").text(), "{4,5,6,7,8,9,#1}");
  EXPECT_EQ((ElementName{ElementLabel::site(2), ElementLabel::site(1), ElementLabel::site(2)}).size(), 2u);
  EXPECT_LT(named("{1,2}"), named("{1,2,3}"));
  EXPECT_LT(named("{1,2,3}"), named("{1,3}"));
  EXPECT_LT(named("{900,901}"), named("{900,#0}"));
  EXPECT_LT(named("{1,2,3,4,5,6}"), named("{1,2,3,4,5,7}"));
  EXPECT_EQ(named("{5,#4}").sites(), std::vector<std::uint32_t>{5});
  for (const char* text : {"", "{", "{}", "3,7", "{3,,7}", "{3;7}", "{3,3}", "{-1}", "{#}", "{1.5}", "{4294967296}", "{1,2"}) {
    EXPECT_FALSE(ElementName::parse(text).ok()) << text;
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
  const CellComplex& complex = live.complex;
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
  const CellComplex& complex = live.complex;
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
    std::vector<PowerSite> turned = lattice(n);
    const auto turn = [](const Point3& p) {
      const Point3 q{0.8 * p.x - 0.6 * p.y, 0.6 * p.x + 0.8 * p.y, p.z};
      return Point3{q.x + 1234.5, 0.28 * q.y - 0.96 * q.z - 987.6, 0.96 * q.y + 0.28 * q.z};
    };
    for (PowerSite& site : turned) site.position = turn(site.position);
    std::vector<Point3> corners;
    for (const Point3& p : unit_cube().vertices) corners.push_back(turn(p));
    Live far(convex_hull(corners).value());
    far.update(turned);
    EXPECT_EQ(far.complex.count(Kind::vertex), live.complex.count(Kind::vertex));
    EXPECT_EQ(far.complex.count(Kind::edge), live.complex.count(Kind::edge));
    EXPECT_EQ(far.complex.count(Kind::facet), live.complex.count(Kind::facet));
    expect_whole(far.complex, "turned lattice");
  }
}

std::vector<std::pair<std::string, std::vector<PowerSite>>> zoo() {
  std::vector<std::pair<std::string, std::vector<PowerSite>>> zoo;
  zoo.emplace_back("none", std::vector<PowerSite>{});
  zoo.emplace_back("lattice", lattice(4));
  std::vector<PowerSite> coplanar, collinear, ring, sphere,
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
  std::vector<PowerSite> twins = random_sites(20, 3, 0, 0.01), outside = random_sites(20, 4, 0, 0.01), crowd;
  for (std::size_t i = 0; i < 5; ++i) twins.push_back(twins[3 * i]);
  for (std::size_t i = 0; i < 20; i += 2) outside[i].position += Vector3{0.9, 0, 0.2};
  crowd = random_sites(60, 5, 0, 0.2);  // many of them hidden
  std::vector<PowerSite> centred = lattice(3);
  for (const PowerSite& site : lattice(2)) centred.push_back(site);  // body-centred
  std::vector<PowerSite> tiny = random_sites(30, 6, 0, 1e-8);
  for (PowerSite& site : tiny) site.position = Point3{0.5, 0.5, 0.5} + 1e-4 * (site.position - Point3{0.5, 0.5, 0.5});
  std::vector<PowerSite> noisy = lattice(4);
  Random random(8);
  for (PowerSite& site : noisy) site.position += random_point(random, {-1e-12, -1e-12, -1e-12}, {1e-12, 1e-12, 1e-12});
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
      std::vector<PowerSite> moved = sites;
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
      for (const ElementName& name : live.complex.names(kind)) EXPECT_FALSE(name.contains(ElementLabel::site(i)));
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
    for (const ElementName& name : live.complex.names(Kind::edge)) EXPECT_EQ(name.size(), 3u);
    for (const ElementName& name : live.complex.names(Kind::vertex)) EXPECT_EQ(name.size(), 4u);
  }
}

/// Sites with labels of their own, changed at random.
struct Crowd {
  std::vector<PowerSite> sites;
  std::vector<std::uint32_t> labels;
  std::uint32_t next = 0;
  void add(const PowerSite& site, std::size_t at) {
    sites.insert(sites.begin() + static_cast<std::ptrdiff_t>(at), site);
    labels.insert(labels.begin() + static_cast<std::ptrdiff_t>(at), next++);
  }
  void remove(std::size_t at) {
    sites.erase(sites.begin() + static_cast<std::ptrdiff_t>(at));
    labels.erase(labels.begin() + static_cast<std::ptrdiff_t>(at));
  }
  void change(Random& random) {
    const auto at = static_cast<std::size_t>(random.uniform(0, static_cast<double>(sites.size()) - 1e-9));
    const double dice = random.uniform(0, 1);
    if (dice < 0.45) sites[at].position = random_point(random, {-0.05, -0.05, -0.05}, {1.05, 1.05, 1.05});
    else if (dice < 0.7) sites[at].weight = random.uniform(-0.01, 0.08);
    else if (dice < 0.85 || sites.size() < 20) add({random_point(random, {0, 0, 0}, {1, 1, 1}), random.uniform(0, 0.02)}, at);
    else remove(at);
  }
};

TEST(CellComplex, TwoHundredChangesEndWhereBuildingAnewEnds) {
  const Domain domain = unit_cube();
  Live live(domain);
  Random random(17);
  Crowd crowd;
  for (int i = 0; i < 60; ++i) crowd.add({random_point(random, {0, 0, 0}, {1, 1, 1}), random.uniform(0, 0.01)}, 0);
  for (int step = 0; step < 200; ++step) {
    crowd.change(random);
    ASSERT_TRUE(live.complex.set_labels(crowd.labels).ok());
    live.update(crowd.sites);
    ASSERT_EQ(live.complex.listing(), rebuilt(domain, crowd.sites, crowd.labels)) << step;
    if (step % 20 == 0) expect_whole(live.complex, "step " + std::to_string(step));
  }
}

// The lists of changes alone keep a copy true: nothing changes that they do not name.
TEST(CellComplex, ListsOfChangesAreComplete) {
  const auto numbers = [](const CellComplex& complex) {
    std::map<ElementKey, std::vector<Point3>> all;
    for (const Kind kind : {Kind::facet, Kind::edge, Kind::vertex}) {
      for (const ElementName& name : complex.names(kind)) {
        auto& mine = all[{kind, name}];
        if (kind == Kind::vertex) mine.push_back(*complex.position(name));
        if (kind == Kind::edge) mine.push_back({complex.length(name), 0, 0});
        if (kind == Kind::facet) mine = complex.polygons(name).front();
      }
    }
    return all;
  };
  Live live(unit_cube());
  Random random(23);
  Crowd crowd;
  for (int i = 0; i < 80; ++i) crowd.add({random_point(random, {0, 0, 0}, {1, 1, 1}), random.uniform(0, 0.01)}, 0);
  std::map<ElementKey, std::vector<Point3>> before;
  for (int step = 0; step < 40; ++step) {
    if (step > 0) crowd.change(random);
    ASSERT_TRUE(live.complex.set_labels(crowd.labels).ok());
    live.update(crowd.sites);
    auto now = numbers(live.complex);
    const ComplexChange& change = live.complex.change();
    for (const ElementKey& key : change.removed) EXPECT_TRUE(key.kind == Kind::cell || before.erase(key) == 1);
    for (const ElementKey& key : change.added) EXPECT_TRUE(key.kind == Kind::cell || before.emplace(key, now[key]).second);
    for (const ElementKey& key : change.changed) {
      if (key.kind == Kind::cell) continue;
      EXPECT_TRUE(before.contains(key));
      before[key] = now[key];
    }
    EXPECT_EQ(before, now) << step;
    const std::size_t touched = change.added.size() + change.removed.size() + change.changed.size();
    EXPECT_TRUE(step == 0 || touched < before.size()) << touched;
  }
}

// What a person has hung on a facet is found again after every re-solve in which the two volumes are still neighbours.
TEST(CellComplex, WhatHangsOnANameSurvives) {
  Live live(unit_cube());
  Crowd crowd;
  crowd.sites = random_sites(50, 31, 0, 0.01);
  for (std::uint32_t i = 0; i < 50; ++i) crowd.labels.push_back(100 + i);
  crowd.next = 150;
  ASSERT_TRUE(live.complex.set_labels(crowd.labels).ok());
  live.update(crowd.sites);
  std::map<ElementName, std::string> doors;
  for (const ElementName& name : live.complex.names(Kind::facet)) doors[name] = "door in " + name.text();
  const std::vector<ElementName> before = live.complex.names(Kind::facet);
  // Another site comes in at the front and one leaves: the indices of all others shift, their names do not.
  crowd.remove(20);
  crowd.add({{0.5, 0.5, 0.5}, 0.005}, 0);
  ASSERT_TRUE(live.complex.set_labels(crowd.labels).ok());
  live.update(crowd.sites);
  for (const ElementKey& key : live.complex.change().removed) doors.erase(key.name);
  std::size_t kept = 0;
  for (const ElementName& name : before) kept += live.complex.has({Kind::facet, name});
  EXPECT_EQ(doors.size(), kept);
  EXPECT_GT(kept, before.size() * 2 / 3);
  EXPECT_LT(live.complex.work().cells_replaced, 45u);
  EXPECT_TRUE(live.complex.has({Kind::cell, named("{150}")}));
  EXPECT_FALSE(live.complex.has({Kind::cell, named("{120}")}));
}

// 2007 froze the points because its database of cells could not follow. Counts, not times: they are the same everywhere.
TEST(CellComplex, OneSiteOfThousandsTouchesAFewElements) {
  const Domain domain = unit_cube();
  std::vector<PowerSite> sites = random_sites(5000, 1, 0.0005, 0.0015);
  Live live(domain);
  live.update(sites);
  const std::size_t all = live.complex.work().elements_made;
  EXPECT_GT(all, 100000u);
  for (int step = 0; step < 4; ++step) {
    if (step % 2 == 0) sites[2500 + step].position += Vector3{0.004, -0.003, 0.005};
    else sites[100 + step].weight += 2e-4;
    live.update(sites);
    const ComplexWork& work = live.complex.work();
    EXPECT_GT(work.cells_replaced, 5u);
    EXPECT_LT(work.cells_replaced, 60u);
    EXPECT_LT(work.cells_visited, 250u);
    EXPECT_LT(work.elements_made, 1500u);
    const ComplexChange& change = live.complex.change();
    EXPECT_LT(change.added.size() + change.removed.size() + change.changed.size(), 1500u);
  }
  EXPECT_EQ(live.complex.listing(), rebuilt(domain, sites));
  expect_whole(live.complex, "5000 sites");
  // Nothing changed: nothing is touched, even where every cell is read.
  ASSERT_TRUE(live.complex.update(live.diagram, sites, true).ok());
  EXPECT_EQ(live.complex.work().cells_read, 5000u);
  EXPECT_EQ(live.complex.work().elements_made, 0u);
  EXPECT_TRUE(live.complex.change().changed.empty());
}

/// An L of two by two metres without its far corner, one metre high.
Domain corner_building() {
  const std::vector<Point3> plan{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
  return extrude_plan(plan, {}, 0, 1).value();
}

// By hand: the pieces of the domain and the faces between them are not to be seen.
TEST(CellComplex, PiecesOfTheDomainDoNotShow) {
  Live live(corner_building());
  live.update({{{0.5, 0.5, 0.5}, 0.1}});
  EXPECT_EQ(live.complex.count(Kind::facet), 8u);
  EXPECT_EQ(live.complex.count(Kind::edge), 18u);
  EXPECT_EQ(live.complex.count(Kind::vertex), 12u);
  expect_whole(live.complex, "corner building");
  double surface = 0;
  for (const ElementName& name : live.complex.names(Kind::facet)) surface += live.complex.area(name);
  EXPECT_NEAR(surface, 2 * 3 + 8, 1e-12);
  // A facet that runs through all pieces is one, of several polygons.
  live.update({{{0.5, 0.5, 0.3}, 0.1}, {{0.5, 0.5, 0.7}, 0.1}});
  EXPECT_NEAR(live.complex.area(named("{0,1}")), 3, 1e-12);
  EXPECT_GT(live.complex.polygons(named("{0,1}")).size(), 1u);
  EXPECT_EQ(live.complex.incident({Kind::facet, named("{0,1}")}, Kind::edge).size(), 6u);
  EXPECT_EQ(live.complex.incident({Kind::facet, named("{0,1}")}, Kind::vertex).size(), 6u);
  expect_whole(live.complex, "corner building of two storeys");
}

TEST(CellComplex, UpdatesFollowInDomainsOfSeveralPieces) {
  const Domain domain = corner_building();
  Live live(domain);
  Random random(41);
  std::vector<PowerSite> sites = random_sites(70, 42, 0, 0.02);
  for (PowerSite& site : sites) site.position = {2 * site.position.x, 2 * site.position.y, site.position.z};
  for (int step = 0; step < 60; ++step) {
    PowerSite& site = sites[random.below(sites.size())];
    if (step % 2 == 0) site.position = random_point(random, {0, 0, 0}, {2, 2, 1});
    else site.weight = random.uniform(-0.02, 0.05);
    live.update(sites);
    ASSERT_EQ(live.complex.listing(), rebuilt(domain, sites)) << step;
    if (step % 15 == 0) expect_whole(live.complex, "pieces");
  }
  expect_symmetric(live.complex);
}

TEST(CellComplex, RefusesWhatItCannotRead) {
  PowerDiagram diagram;
  ASSERT_TRUE(diagram.set_domain(unit_cube()).ok());
  const auto sites = random_sites(5, 1, 0.01, 0.02);
  ASSERT_TRUE(diagram.update(sites).ok());
  CellComplex complex;
  EXPECT_EQ(complex.update(diagram, sites).error().code, ErrorCode::missing);
  ASSERT_TRUE(diagram.update(sites, outlines()).ok());
  EXPECT_EQ(complex.update(diagram, std::span(sites).first(4)).error().code, ErrorCode::conflict);
  EXPECT_EQ(complex.set_labels(std::vector<std::uint32_t>{1, 2, 1}).error().code, ErrorCode::duplicate);
  ASSERT_TRUE(complex.set_labels(std::vector<std::uint32_t>{1, 2}).ok());
  EXPECT_EQ(complex.update(diagram, sites).error().code, ErrorCode::conflict);
  ASSERT_TRUE(complex.set_labels({}).ok());
  EXPECT_TRUE(complex.update(diagram, sites).ok());
  expect_whole(complex, "after refusals");
}

}  // namespace
}  // namespace bl::test
