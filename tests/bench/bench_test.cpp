// The bench measures every kind of row, and what it measures does not depend on the number of threads.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "core/drawing/line_chart.h"
#include "tests/support/place/source_folder.h"
#include "tests/ui/cli/program.h"

namespace bl::test {

namespace {

TEST(Bench, RowsHoldWhatWasAsked) {
  const Workplace place;
  const Outcome outcome =
      place.bench({"--sites", "30", "50", "--threads", "1", "2", "--repeat", "1", "--ticks", "3", "--json", "b.json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const nlohmann::json rows = place.json("b.json");
  ASSERT_EQ(rows.size(), 4u);
  for (const auto& row : rows)
    for (const char* key :
         {"case", "sites", "threads", "seconds", "microseconds_per_cell", "yardstick_seconds", "voropp_seconds", "hash"})
      EXPECT_TRUE(row.contains(key)) << key;
  EXPECT_EQ(rows[0]["hash"], rows[1]["hash"]) << "the threads must not change the result";
  EXPECT_EQ(rows[2]["sites"], 50);
}

// Measured by kinds, nodes and links, the ticks are those of the rows beside rivals.
TEST(Bench, TimesAreThoseOfTheSameTicksSlowestFirst) {
  const Workplace place;
  const std::string scene = test::source_folder() + "/scenes/start/quarter.json";
  const Outcome plain = place.bench({scene, "--repeat", "1", "--ticks", "6", "--json", "rows.json"});
  ASSERT_EQ(plain.code, 0) << plain.err;
  const Outcome outcome = place.bench({scene, "--times", "--ticks", "6", "--threads", "1", "2", "--json", "times.json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const nlohmann::json cases = place.json("times.json");
  ASSERT_EQ(cases.size(), 2u);
  for (const auto& one : cases) {
    EXPECT_EQ(one["hash"], place.json("rows.json")[0]["hash"]);
    EXPECT_NE(outcome.out.find(one["hash"].get<std::string>()), std::string::npos);
    EXPECT_EQ(one["ticks"], 6);
    EXPECT_EQ(one["parts"].size(), 6u);
    double shares = 0;
    for (const auto& kind : one["kinds"]) shares += kind["share"].get<double>();
    EXPECT_LE(shares, 1 + 1e-9);
    for (const char* rows : {"kinds", "nodes", "links"}) {
      ASSERT_GT(one[rows].size(), 1u) << rows;
      for (std::size_t k = 1; k < one[rows].size(); ++k)
        EXPECT_GE(one[rows][k - 1]["seconds"].get<double>(), one[rows][k]["seconds"].get<double>()) << rows << " " << k;
    }
  }
}

std::string study_scene() { return scene_text(volume_text("a", "[8, 0, 8]") + "," + volume_text("b", "[-8, 0, 8]", "2000")); }

TEST(SolverBench, QuickRunHasAllRowsAndOneHashForAllThreads) {
  const Workplace place;
  place.write("study.json", study_scene());
  const Outcome outcome = place.bench(
      {"--solver", "--quick", "--seeds", "2", "--sites", "60", "--json", "rows.json", "--chart", "charts", "study.json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(outcome.out.starts_with("Machine: ")) << outcome.out;
  const auto all = place.json("rows.json");
  EXPECT_TRUE(all["machine"].get<std::string>().find("core") != std::string::npos);
  std::map<std::string, int> kinds;
  std::map<std::string, std::set<std::string>> hashes;  // of rows that differ in their threads only
  std::map<std::string, std::set<int>> threads;
  for (const auto& row : all["rows"]) {
    const std::string kind = row["rows"];
    ++kinds[kind];
    if (kind == "growth") {
      EXPECT_EQ(row["diagram_hash"].get<std::string>().size(), 16u) << row;
      EXPECT_EQ(row["fit_hash"].get<std::string>().size(), 16u) << row;
      continue;
    }
    if (kind == "tick_growth") { EXPECT_GT(row["moving_ms"].get<double>(), row["alone_ms"].get<double>()) << row; }
    if (kind == "rays") { EXPECT_EQ(row["differing_rays"], 0) << row; }
    if (kind == "ways") { EXPECT_EQ(row["same"], "yes") << row; }
    if (kind == "traffic") {
      EXPECT_LE(row["reached"].get<double>(), row["gap"].get<double>()) << row;
      EXPECT_LE(row["peer_reached"].get<double>(), row["gap"].get<double>()) << row;
      EXPECT_LE(row["objectives_apart"].get<double>(), row["gap"].get<double>()) << "two methods, one equilibrium: " << row;
    }
    EXPECT_EQ(row["hash"].get<std::string>().size(), 16u) << row;
    EXPECT_NE(outcome.out.find(row["hash"].get<std::string>()), std::string::npos) << row;
    if (!row.contains("threads")) continue;
    const std::string work = kind + row.value("balls", "") + row.value("case", "") + row["sites"].dump() +
                             std::to_string(row.value("fill_percent", 0.0));
    hashes[work].insert(row["hash"].get<std::string>());
    threads[work].insert(row["threads"].get<int>());
  }
  EXPECT_EQ(kinds, (std::map<std::string, int>{{"diagram", 2},
                                               {"wrapped", 4},
                                               {"fit", 5},
                                               {"seeds", 5},
                                               {"drag", 8},
                                               {"standing", 3},
                                               {"growth", 1},
                                               {"complex", 2},
                                               {"rays", 2},
                                               {"traffic", 3},
                                               {"ways", 1},
                                               {"districts", 2},
                                               {"study", 3},
                                               {"tick", 30},
                                               {"plan", 12},
                                               {"past", 1},
                                               {"load", 1},
                                               {"journal", 3},
                                               {"tick_growth", 1}}));
  EXPECT_EQ(hashes.size(), 23u);
  for (const auto& [work, found] : hashes) EXPECT_EQ(found.size(), 1u) << work;
  for (const auto& [work, found] : threads) EXPECT_EQ(found, (std::set<int>{1, 2})) << work;
}

TEST(SolverBench, FitsAreMetAndDragsKeepTheirTolerance) {
  const Workplace place;
  const Outcome outcome = place.bench({"--solver", "--quick", "--rows", "fit", "drag", "--sites", "80", "--json", "rows.json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto all = place.json("rows.json");
  EXPECT_EQ(all["rows"].size(), 13u);
  for (const auto& row : all["rows"]) {
    if (row["rows"] == "fit") {
      EXPECT_EQ(row["status"], "met") << row;
      EXPECT_LE(row["largest_relative_error"].get<double>(), 1e-6) << row;
    } else {
      EXPECT_LE(row["largest_error_percent"].get<double>(), 0.1) << row;
    }
  }
}

TEST(SolverBench, ChartsAreWholeDrawings) {
  const Workplace place;
  const Outcome outcome = place.bench({"--solver", "--quick", "--rows", "growth", "tick_growth", "study", "--sites", "30", "60",
                                       "--chart", "charts", "--json", "rows.json", "--threads", "1"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("sixty_volumes"), std::string::npos) << "there is no such study in the folder";
  for (const char* name : {"charts/growth.svg", "charts/tick_growth.svg"}) {
    const std::string growth = place.text(name);
    EXPECT_TRUE(growth.starts_with("<svg ")) << growth.substr(0, 80);
    EXPECT_NE(growth.find("</svg>"), std::string::npos) << name;
  }
  EXPECT_FALSE(std::filesystem::exists(place.path("charts/feedback_newton.svg")));
}

TEST(SolverBench, SmallMarksOfAChartAreWhatTheySay) {
  drawing::Chart chart{
      "small", "", "", {{"panel", "sites", {{"line", "#000", "", {{10, 0.001}, {20, 0.002}, {50, 0.005}}}}, 0, ""}}};
  const std::string svg = drawing::draw_chart(chart);
  for (const char* mark : {">10⁻³<", ">2·10⁻³<", ">5·10⁻³<"}) {
    const std::size_t first = svg.find(mark);
    ASSERT_NE(first, std::string::npos) << mark << " in " << svg;
    EXPECT_EQ(svg.find(mark, first + 1), std::string::npos) << mark << " stands at two places";
  }
}

// What is printed is lines of text: headings have been printed with the letters `\\n` in them.
TEST(SolverBench, HeadingsAreLinesOfText) {
  const Workplace place;
  place.write("study.json", study_scene());
  const Outcome outcome = place.bench({"study.json", "--solver", "--quick", "--seeds", "1", "--sites", "30", "--threads", "1"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.find('\\'), std::string::npos) << outcome.out;
  for (const char c : outcome.out) EXPECT_TRUE(static_cast<unsigned char>(c) >= 0x20 || c == '\n') << static_cast<int>(c);
  // The machine, a free line, and the first heading on a line of its own.
  EXPECT_TRUE(outcome.out.starts_with("Machine: ")) << outcome.out;
  EXPECT_NE(outcome.out.find("\n\n"), std::string::npos);
}

TEST(SolverBench, ItsOptionsWantTheSolver) {
  const Workplace place;
  EXPECT_EQ(place.bench({"--quick"}).code, 2);
  EXPECT_EQ(place.bench({"--solver", "--rows", "cells"}).code, 2);
  EXPECT_EQ(place.bench({"--solver", "--seeds", "0"}).code, 2);
}

}  // namespace

}  // namespace bl::test
