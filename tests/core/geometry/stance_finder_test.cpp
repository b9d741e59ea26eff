// Stances that are kept from call to call are those found anew, whatever has changed; and few are measured where little has.
#include "core/geometry/inside/stance_finder.h"

#include <algorithm>
#include <bit>
#include <numeric>

#include "core/geometry/site_domain.h"
#include "core/geometry/volume_tick.h"
#include "tests/core/geometry/site_zoo.h"

namespace bl::test {
namespace {

// A box, the same with a building that stays in its right half, and an L of other proportions.
const geometry::Domain& standing_place(std::size_t kind) {
  static const std::vector<geometry::Domain> places = [] {
    const std::vector<Point3> plan{{0, 0, 0}, {60, 0, 0}, {60, 20, 0}, {0, 20, 0}};
    const geometry::SitePlan with_building{plan, {}, 0, 40, {}, {{{{30, 0, 0}, {60, 0, 0}, {60, 20, 0}, {30, 20, 0}}, 0, 10}}};
    const std::vector<Point3> bend{{0, 0, 0}, {60, 0, 0}, {60, 9, 0}, {25, 9, 0}, {25, 30, 0}, {0, 30, 0}};
    return std::vector<geometry::Domain>{box({0, 0, 2}, {60, 20, 40}), geometry::site_domain(with_building).value(),
                                         geometry::extrude_plan(bend, {}, -1, 30).value()};
  }();
  return places[kind % places.size()];
}

bool same_stance(const geometry::Stance& a, const geometry::Stance& b) {
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
  return a.stands_on == b.stands_on && bits(a.hang) == bits(b.hang) && bits(a.drop) == bits(b.drop);
}

// What has been seen in all steps of a law: it would hold for nothing where all stand on the ground.
struct StancesSeen {
  std::size_t ground = 0, carried = 0, between = 0, hanging = 0, kept = 0, differing = 0;

  void add(const std::vector<geometry::Stance>& stances, const std::vector<geometry::Standing>& rules) {
    for (std::size_t i = 0; i < stances.size(); ++i) {
      ground += stances[i].stands_on == geometry::Stance::kGround;
      carried += stances[i].stands_on >= 0;
      hanging += stances[i].hang > 0;
      between += rules[i] == geometry::Standing::bridge && stances[i].stands_on == geometry::Stance::kNothing &&
                 stances[i].hang == 0 && stances[i].drop < 0;
    }
  }
};

// Asks the finder, and compares with what is found anew and with what it says to have changed.
void expect_as_anew(geometry::StanceFinder& finder, const geometry::Domain& domain, const std::vector<geometry::PowerSite>& sites,
                    std::span<const geometry::CellMeasure> cells, const std::vector<geometry::Standing>& rules,
                    std::span<const std::uint32_t> made, StancesSeen& seen) {
  const std::vector<geometry::Stance> before = finder.stances();
  finder.update(domain, sites, cells, rules, made);
  const auto anew = stances_of(domain, sites, cells, rules);
  ASSERT_EQ(finder.stances().size(), anew.size());
  std::vector<std::uint32_t> differing;
  for (std::uint32_t i = 0; i < anew.size(); ++i) {
    EXPECT_TRUE(same_stance(finder.stances()[i], anew[i])) << i << ": " << finder.stances()[i].drop << " for " << anew[i].drop;
    if (before.size() != anew.size() || !(before[i] == anew[i])) differing.push_back(i);
  }
  EXPECT_TRUE(std::equal(differing.begin(), differing.end(), finder.differing().begin(), finder.differing().end()));
  seen.add(anew, rules);
  seen.kept += anew.size() - finder.measured();
  seen.differing += before.size() == anew.size() ? differing.size() : 0;
}

struct StandingScene {
  std::size_t place = 0;
  std::vector<geometry::PowerSite> sites;
  std::vector<geometry::Standing> rules;

  explicit StandingScene(Random& random) {
    for (int i = 0; i < 40; ++i) add(random);
  }
  static Point3 anywhere(Random& random) { return random_point(random, {1, 1, 1}, {59, 19, 34}); }
  static geometry::Standing any_rule(Random& random) { return static_cast<geometry::Standing>(random.below(3)); }
  void add(Random& random) {
    const Point3 position = anywhere(random);
    sites.push_back({position, random.uniform(4, 40)});
    rules.push_back(any_rule(random));
  }

  // One of the things that people and solvers do.
  void change(Random& random) {
    const std::size_t i = random.below(sites.size());
    switch (random.below(16)) {
      case 0: sites[i].position = anywhere(random); break;
      case 1: sites[i].position.z += random.uniform(-3, 3); break;
      case 2: sites[i].weight = random.uniform(-2, 90); break;
      case 3: sites[i].weight = 0; break;
      case 4: rules[i] = any_rule(random); break;
      case 5: std::swap(sites[i], sites[random.below(sites.size())]); break;
      case 6: add(random); break;
      case 7:
        if (sites.size() < 2) break;
        sites.erase(sites.begin() + static_cast<std::ptrdiff_t>(i));
        rules.erase(rules.begin() + static_cast<std::ptrdiff_t>(i));
        break;
      case 8: place = random.below(3); break;
      case 9:
        for (auto& site : sites) site.position.z = std::max(1.0, site.position.z - random.uniform(0, 2));
        break;
      case 10: break;
      case 11:  // on top of another one
        sites[i].position = sites[random.below(sites.size())].position;
        sites[i].position.z += random.uniform(2, 9);
        break;
      case 12: sites[i].position.z = sites[i].position.x < 30 ? 0.0 : -0.0; break;
      default: sites[i].position.x += random.uniform(-0.5, 0.5);
    }
  }
};

TEST(StanceFinder, WhatIsKeptIsWhatIsFoundAnew) {
  StancesSeen seen;
  for (int round = 0; round < rounds(60); ++round) {
    Random random(static_cast<std::uint64_t>(round), 21);
    StandingScene scene(random);
    geometry::PowerDiagram diagram;
    geometry::StanceFinder finder;
    for (int step = 0; step < 40; ++step) {
      SCOPED_TRACE(std::to_string(round) + " " + std::to_string(step));
      const geometry::Domain& domain = standing_place(scene.place);
      ASSERT_TRUE(diagram.set_domain(domain));
      const auto cells = diagram.update(scene.sites);
      ASSERT_TRUE(cells);
      expect_as_anew(finder, domain, scene.sites, *cells, scene.rules, diagram.made(), seen);
      for (std::size_t changes = 1 + random.below(3); changes > 0; --changes) scene.change(random);
    }
  }
  EXPECT_GT(seen.ground, 100u);
  EXPECT_GT(seen.carried, 100u);
  EXPECT_GT(seen.between, 0u);
  EXPECT_GT(seen.hanging, 100u);
  EXPECT_GT(seen.differing, 100u);
  EXPECT_GT(seen.kept, 100u);
}

// Cells that no geometry makes: facets that only one of two knows, volumes and lowest points that come and go.
geometry::CellMeasure odd_cell(Random& random, std::size_t count) {
  geometry::CellMeasure cell;
  cell.volume = random.below(5) == 0 ? 0 : random.uniform(1, 200);
  cell.bottom = random.below(3) == 0 ? 2 : random.uniform(2, 30);
  if (random.below(6) == 0)
    cell.facets.push_back({geometry::FacetArea::Kind::plane, static_cast<std::uint32_t>(random.below(6)), 1});
  for (std::uint32_t j = 0; j < count; ++j)
    if (random.below(count) < 5) cell.facets.push_back({geometry::FacetArea::Kind::site, j, 1});
  return cell;
}

TEST(StanceFinder, FacetsThatOnlyOneOfTwoKnowsAreNoMatter) {
  StancesSeen seen;
  const geometry::Domain& domain = standing_place(0);
  for (int round = 0; round < rounds(60); ++round) {
    SCOPED_TRACE(round);
    Random random(static_cast<std::uint64_t>(round), 22);
    StandingScene scene(random);
    const std::size_t count = 130;  // more than two words of bits
    while (scene.sites.size() < count) scene.add(random);
    std::vector<geometry::CellMeasure> cells;
    for (std::size_t i = 0; i < count; ++i) cells.push_back(odd_cell(random, count));
    geometry::StanceFinder finder;
    std::vector<std::uint32_t> made;
    for (int step = 0; step < 30; ++step) {
      expect_as_anew(finder, domain, scene.sites, cells, scene.rules, made, seen);
      made = {static_cast<std::uint32_t>(random.below(count))};
      geometry::CellMeasure& cell = cells[made[0]];
      const bool only_comes_or_goes = random.below(3) == 0;
      if (only_comes_or_goes) cell.volume = cell.volume > 0 ? 0 : 50;
      if (!only_comes_or_goes) cell = odd_cell(random, count);
      const std::size_t i = random.below(count);
      if (step % 3 == 0) scene.sites[i].position = StandingScene::anywhere(random);
      if (step % 3 == 1) scene.sites[i].weight = random.uniform(-2, 90);
    }
  }
  EXPECT_GT(seen.carried, 100u);
  EXPECT_GT(seen.hanging, 100u);
  EXPECT_GT(seen.kept, 100u);
}

// Four hundred piles of three, the uppermost of which touches nothing.
TEST(StanceFinder, FewAreMeasuredAgainWhereLittleHasChanged) {
  const geometry::Domain domain = box({0, 0, 0}, {200, 200, 60});
  std::vector<geometry::PowerSite> sites;
  for (int x = 0; x < 20; ++x)
    for (int y = 0; y < 20; ++y)
      for (const double z : {3.0, 10.0, 30.0}) sites.push_back({{10.0 * x + 5, 10.0 * y + 5, z}, 16});
  const std::vector<geometry::Standing> rules(sites.size(), geometry::Standing::stack);
  geometry::PowerDiagram diagram;
  geometry::StanceFinder finder;
  StancesSeen seen;
  ASSERT_TRUE(diagram.set_domain(domain));
  const auto ask = [&] {
    const auto cells = diagram.update(sites).value();
    expect_as_anew(finder, domain, sites, cells, rules, diagram.made(), seen);
  };
  ask();
  EXPECT_EQ(finder.measured(), sites.size());
  ask();
  EXPECT_EQ(finder.measured(), 0u);
  // Someone in the middle of a pile: those around it, and hardly others.
  sites[3 * 210 + 1].position.x += 0.25;
  ask();
  EXPECT_GE(finder.measured(), 3u);
  EXPECT_LE(finder.measured(), sites.size() / 20);
  EXPECT_EQ(seen.ground, sites.size());  // a third, three times
  EXPECT_EQ(seen.hanging, sites.size());
}

struct TickRun {
  geometry::VolumeTick tick;
  geometry::Domain domain = box({0, 0, 0}, {40, 20, 30});
  std::vector<geometry::PowerSite> sites;
  std::vector<double> wanted, storeys;
  std::vector<geometry::Standing> rules;
  geometry::FitState state;

  explicit TickRun(Random& random) {
    for (int i = 0; i < 30; ++i) {
      const Point3 place = random_point(random, {1, 1, 1}, {39, 19, 25});
      sites.push_back({place, 9});
      wanted.push_back(random.uniform(50, 300));
    }
    storeys.assign(sites.size(), 3);
    rules.assign(sites.size(), geometry::Standing::stack);
    tick.samples = 24;
    tick.storey_heights = storeys;
    tick.standing = rules;
  }
};

// A tick with what is kept says the same as one without; who is not said to differ is as in the tick before. Now and then another
// metric is tried and its weights are dropped, so that the next tick has nearly the sites of the one before.
TEST(StanceFinder, TicksOfAnyMetricKeepWhatTheySaid) {
  Random random(5, 23);
  TickRun run(random);
  geometry::VolumeTick::Cache kept;
  std::vector<geometry::Stance> last;
  std::vector<double> last_volumes;
  std::size_t untouched = 0;
  for (int tick = 0; tick < 24; ++tick) {
    SCOPED_TRACE(tick);
    const bool is_trial = tick % 9 == 3;
    run.tick.metric = is_trial ? geometry::Metric::additive : geometry::Metric::power;
    run.tick.steps = is_trial ? 1 : tick % 9 < 6 ? 0 : 2;
    const auto sites_before = run.sites;
    auto sites = run.sites;
    geometry::VolumeTick::Cache fresh;
    const auto expected = run.tick.run(run.domain, sites, run.wanted, run.state, fresh);
    const auto found = run.tick.run(run.domain, run.sites, run.wanted, run.state, kept);
    ASSERT_TRUE(expected && found);
    EXPECT_EQ(sites, run.sites);
    std::vector<bool> differs(run.sites.size(), false);
    for (const std::uint32_t i : found->differing) differs[i] = true;
    for (std::size_t i = 0; i < run.sites.size(); ++i) {
      EXPECT_TRUE(same_stance(found->stances[i], expected->stances[i])) << i;
      EXPECT_EQ(found->cells[i].volume, expected->cells[i].volume);
      if (differs[i]) continue;
      ++untouched;
      EXPECT_TRUE(same_stance(found->stances[i], last[i])) << i;
      EXPECT_EQ(found->cells[i].volume, last_volumes[i]);
    }
    last.assign(found->stances.begin(), found->stances.end());
    last_volumes.clear();
    for (const auto& cell : found->cells) last_volumes.push_back(cell.volume);
    if (is_trial) run.sites = sites_before;
    if (!is_trial) run.state = found->state;
    if (tick % 2 == 0) run.sites[random.below(run.sites.size())].position.x = random.uniform(1, 39);
  }
  EXPECT_GT(untouched, 0u);
}

}  // namespace
}  // namespace bl::test
