// Rows of times from a table that is made by hand.
#include "core/reading/time_rows.h"

#include <gtest/gtest.h>

#include "core/reading/figures.h"
#include "tests/support/world.h"

namespace bl::reading {
namespace {

// The quarter with times: link k took k+1 milliseconds in two evaluations, each role of node n took n+1 microseconds.
TimeTable made_table() {
  World world = World::from_file("scenes/start/quarter.json");
  TimeTable table;
  table.plan = world.state().plan;
  table.links.resize(table.plan->links.size());
  table.roles.resize(table.plan->dependents->sets->first_port.size());
  table.beside.resize(table.plan->analyses.size());
  double links = 0, roles = 0, sets = 0;
  for (std::size_t l = 0; l < table.links.size(); ++l) {
    table.links[l].add(1, 1e-3 * static_cast<double>(l + 1), 2, 10);
    links += table.links[l].seconds;
  }
  for (std::size_t n = 0; n < table.plan->nodes.size(); ++n)
    for (std::size_t t = 0; t < table.plan->nodes[n].types.size(); ++t) {
      WorkTime& role = table.roles[table.type_index(n, t)];
      role.add(1, 1e-6 * static_cast<double>(n + 1), 1, 0);
      (table.plan->nodes[n].types[t].definition->sets.empty() ? roles : sets) += role.seconds;
    }
  // Two threads have shared the links.
  table.parts[static_cast<std::size_t>(TickPart::links)].add(1, links / 2, 1, 0);
  table.parts[static_cast<std::size_t>(TickPart::roles)].add(1, roles, 1, 0);
  table.parts[static_cast<std::size_t>(TickPart::sets)].add(1, sets, 1, 0);
  table.ticks.add(1, links / 2 + roles + sets, 1, 0);
  return table;
}

TEST(TimeRows, TheSlowestStandsFirst) {
  const TimeTable table = made_table();
  for (const TimeGrouping grouping : {TimeGrouping::kinds, TimeGrouping::nodes, TimeGrouping::links}) {
    const std::vector<TimeRow> rows = time_rows(table, grouping, TimeSpan::recent);
    ASSERT_GT(rows.size(), 2u);
    for (std::size_t k = 1; k < rows.size(); ++k) EXPECT_GE(rows[k - 1].seconds, rows[k].seconds) << k;
  }
  const std::vector<TimeRow> links = time_rows(table, TimeGrouping::links, TimeSpan::recent);
  EXPECT_EQ(label_of(table, TimeGrouping::links, links.front()), table.plan->links[table.links.size() - 1].id);
  EXPECT_DOUBLE_EQ(links.front().each(), links.front().seconds / 2);
  EXPECT_EQ(links.front().pairs, 10);
}

TEST(TimeRows, SharesOfAllRowsMakeUpTheTickAlsoWithSeveralThreads) {
  const TimeTable table = made_table();
  double shares = 0, seconds = 0;
  for (const TimeRow& row : time_rows(table, TimeGrouping::kinds, TimeSpan::all)) {
    shares += row.share;
    seconds += row.seconds;
  }
  EXPECT_NEAR(shares, 1, 1e-12);
  EXPECT_GT(seconds, table.ticks.seconds) << "the seconds are those of both threads";
}

TEST(TimeRows, AKindIsTheSumOfItsLinks) {
  const TimeTable table = made_table();
  for (const TimeRow& kind : time_rows(table, TimeGrouping::kinds, TimeSpan::recent)) {
    if (!kind.is_link()) continue;
    double seconds = 0, pairs = 0;
    std::uint32_t members = 0;
    for (const TimeRow& link : time_rows(table, TimeGrouping::links, TimeSpan::recent)) {
      if (link.kind != kind.kind) continue;
      seconds += link.seconds;
      pairs += link.pairs;
      ++members;
    }
    EXPECT_NEAR(kind.seconds, seconds, 1e-12) << kind.kind->id;
    EXPECT_EQ(kind.pairs, pairs) << kind.kind->id;
    EXPECT_EQ(kind.members, members) << kind.kind->id;
  }
}

TEST(TimeRows, WhatIsSlowNowStandsBeforeWhatWasSlowOnce) {
  TimeTable table = made_table();
  for (std::int64_t tick = 2; tick <= 100; ++tick) {
    table.links[0].add(tick, 1e-4, 1, 1);
    table.ticks.add(tick, 1e-4, 1, 0);
  }
  for (WorkTime& link : table.links) link.fade(100);
  for (WorkTime& role : table.roles) role.fade(100);
  const auto first = [&](TimeSpan span) {
    return label_of(table, TimeGrouping::links, time_rows(table, TimeGrouping::links, span).front());
  };
  EXPECT_EQ(first(TimeSpan::recent), table.plan->links[0].id);
  EXPECT_EQ(first(TimeSpan::all), table.plan->links[table.links.size() - 1].id);
}

TEST(TimeRows, WhoWasNotEvaluatedHasNoRow) {
  TimeTable table = made_table();
  table.links[0] = {};
  EXPECT_EQ(time_rows(table, TimeGrouping::links, TimeSpan::recent).size(), table.links.size() - 1);
}

TEST(Durations, HaveTheUnitThatFits) {
  EXPECT_EQ(duration(0), "0\xC2\xA0s");
  EXPECT_EQ(duration(3.5e-8), "35.0\xC2\xA0ns");
  EXPECT_EQ(duration(8.4e-4), "840\xC2\xA0\xC2\xB5s");
  EXPECT_EQ(duration(9.999e-4), "1.000\xC2\xA0ms");
  EXPECT_EQ(duration(2.31e-3), "2.31\xC2\xA0ms");
  EXPECT_EQ(duration(1.5), "1.50\xC2\xA0s");
  EXPECT_EQ(duration(600), "10.0\xC2\xA0min");
}

}  // namespace
}  // namespace bl::reading
