// The live cell complex under changes: updates end where building anew ends, names last, lists of changes are complete.
#include <map>
#include <numeric>

#include "core/geometry/domain_makers.h"
#include "tests/core/geometry/complex_support.h"

namespace bl::test {
namespace {

/// Sites with labels of their own, changed at random.
struct Crowd {
  std::vector<geometry::PowerSite> sites;
  std::vector<std::uint32_t> labels;
  std::uint32_t next = 0;
  void add(const geometry::PowerSite& site, std::size_t at) {
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
  const geometry::Domain domain = unit_cube();
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
  const auto numbers = [](const geometry::CellComplex& complex) {
    std::map<geometry::ElementKey, std::vector<Point3>> all;
    for (const Kind kind : {Kind::facet, Kind::edge, Kind::vertex}) {
      for (const geometry::ElementName& name : complex.names(kind)) {
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
  std::map<geometry::ElementKey, std::vector<Point3>> before;
  for (int step = 0; step < 40; ++step) {
    if (step > 0) crowd.change(random);
    ASSERT_TRUE(live.complex.set_labels(crowd.labels).ok());
    live.update(crowd.sites);
    auto now = numbers(live.complex);
    const geometry::ComplexChange& change = live.complex.change();
    for (const geometry::ElementKey& key : change.removed) EXPECT_TRUE(key.kind == Kind::cell || before.erase(key) == 1);
    for (const geometry::ElementKey& key : change.added)
      EXPECT_TRUE(key.kind == Kind::cell || before.emplace(key, now[key]).second);
    for (const geometry::ElementKey& key : change.changed) {
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
  std::map<geometry::ElementName, std::string> doors;
  for (const geometry::ElementName& name : live.complex.names(Kind::facet)) doors[name] = "door in " + name.text();
  const std::vector<geometry::ElementName> before = live.complex.names(Kind::facet);
  // Another site comes in at the front and one leaves: the indices of all others shift, their names do not.
  crowd.remove(20);
  crowd.add({{0.5, 0.5, 0.5}, 0.005}, 0);
  ASSERT_TRUE(live.complex.set_labels(crowd.labels).ok());
  live.update(crowd.sites);
  for (const geometry::ElementKey& key : live.complex.change().removed) doors.erase(key.name);
  std::size_t kept = 0;
  for (const geometry::ElementName& name : before) kept += live.complex.has({Kind::facet, name});
  EXPECT_EQ(doors.size(), kept);
  EXPECT_GT(kept, before.size() * 2 / 3);
  EXPECT_LT(live.complex.work().cells_replaced, 45u);
  EXPECT_TRUE(live.complex.has({Kind::cell, named("{150}")}));
  EXPECT_FALSE(live.complex.has({Kind::cell, named("{120}")}));
}

// 2007 froze the points because its database of cells could not follow. Counts, not times: they are the same everywhere.
TEST(CellComplex, OneSiteOfThousandsTouchesAFewElements) {
  const geometry::Domain domain = unit_cube();
  std::vector<geometry::PowerSite> sites = random_sites(5000, 1, 0.0005, 0.0015);
  Live live(domain);
  live.update(sites);
  const std::size_t all = live.complex.work().elements_made;
  EXPECT_GT(all, 100000u);
  for (int step = 0; step < 4; ++step) {
    if (step % 2 == 0) sites[2500 + step].position += Vector3{0.004, -0.003, 0.005};
    else sites[100 + step].weight += 2e-4;
    live.update(sites);
    const geometry::ComplexWork& work = live.complex.work();
    EXPECT_GT(work.cells_replaced, 5u);
    EXPECT_LT(work.cells_replaced, 60u);
    EXPECT_LT(work.cells_visited, 200u);
    EXPECT_LT(work.elements_made, 500u);
    const geometry::ComplexChange& change = live.complex.change();
    EXPECT_LT(change.added.size() + change.removed.size() + change.changed.size(), 600u);
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
geometry::Domain corner_building() {
  const std::vector<Point3> plan{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
  return geometry::extrude_plan(plan, {}, 0, 1).value();
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
  for (const geometry::ElementName& name : live.complex.names(Kind::facet)) surface += live.complex.area(name);
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
  const geometry::Domain domain = corner_building();
  Live live(domain);
  Random random(41);
  std::vector<geometry::PowerSite> sites = random_sites(70, 42, 0, 0.02);
  for (geometry::PowerSite& site : sites) site.position = {2 * site.position.x, 2 * site.position.y, site.position.z};
  for (int step = 0; step < 60; ++step) {
    geometry::PowerSite& site = sites[random.below(sites.size())];
    if (step % 2 == 0) site.position = random_point(random, {0, 0, 0}, {2, 2, 1});
    else site.weight = random.uniform(-0.02, 0.05);
    live.update(sites);
    ASSERT_EQ(live.complex.listing(), rebuilt(domain, sites)) << step;
    if (step % 15 == 0) expect_whole(live.complex, "pieces");
  }
  expect_symmetric(live.complex);
}

// Most corners are the same in both, but the faces and edges between them are not.
TEST(CellComplex, AnotherDomainOfTheSameExtentEndsWhereBuildingAnewEnds) {
  const auto cornered = [](double x, double y) {
    const std::vector<Point3> plan{{0, 0, 0}, {2, 0, 0}, {2, y, 0}, {x, y, 0}, {x, 2, 0}, {0, 2, 0}};
    return geometry::extrude_plan(plan, {}, 0, 1).value();
  };
  const std::vector<geometry::Domain> domains{corner_building(), cornered(0.5, 1), cornered(0.5, 0.25), box({0, 0, 0}, {2, 2, 1}),
                                              cornered(1.5, 1.75)};
  for (const std::size_t count : {1u, 2u, 12u}) {
    std::vector<geometry::PowerSite> sites = random_sites(count, 43, 0, 0.02);
    for (geometry::PowerSite& site : sites) site.position = {2 * site.position.x, 2 * site.position.y, site.position.z};
    Live live(domains.front());
    for (const std::size_t k : {0u, 1u, 2u, 3u, 4u, 0u, 2u, 4u, 1u, 3u, 0u}) {
      ASSERT_TRUE(live.diagram.set_domain(domains[k]).ok());
      live.update(sites);
      ASSERT_EQ(live.complex.listing(), rebuilt(domains[k], sites)) << count << " sites, domain " << k;
      expect_whole(live.complex, "domain " + std::to_string(k));
    }
  }
}

TEST(CellComplex, RefusesWhatItCannotRead) {
  geometry::PowerDiagram diagram;
  ASSERT_TRUE(diagram.set_domain(unit_cube()).ok());
  const auto sites = random_sites(5, 1, 0.01, 0.02);
  ASSERT_TRUE(diagram.update(sites).ok());
  geometry::CellComplex complex;
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
