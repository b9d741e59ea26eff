// `compare`: what people set differently, what became of it, and scenes that cannot be compared.
#include <cctype>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/report/comparison.h"
#include "tests/ui/cli/program.h"

namespace bl::test {

namespace {

// The same scene with one demand, one link and one node changed.
std::string changed_scene() {
  nlohmann::json scene = nlohmann::json::parse(moving_scene());
  for (auto& node : scene["nodes"])
    if (node["id"] == "east") node["types"]["smart_volume"]["demand"] = 2500;
  scene["nodes"].push_back({{"id", "newcomer"}, {"position", {5, 5, 5}}, {"types", {{"smart_volume", {{"demand", 300}}}}}});
  return scene.dump();
}

TEST(Compare, TellsInputsAndIndicators) {
  const Workplace place;
  place.write("a.json", moving_scene());
  place.write("b.json", changed_scene());
  const Outcome outcome = place.run({"compare", "a.json", "b.json", "--report", "difference.html"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("nodes/east/smart_volume/demand: "), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("-> 2500"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("newcomer: only in the second"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("SmartVolume: volume, sum"), std::string::npos) << outcome.out;
  const std::string page = place.text("difference.html");
  EXPECT_NE(page.find("a against b"), std::string::npos);
  EXPECT_NE(page.find("<rect"), std::string::npos);
}

// Who looks from one drawing to the other compares lengths: both have one scale and one window, whatever stands in each.
TEST(Compare, BothDrawingsHaveTheSameScaleAndWindow) {
  const Workplace place;
  const auto plan = [](const std::string& height) {
    return R"({"form": "plan", "plan": [[-20, -20, 0], [20, -20, 0], [20, 20, 0], [-20, 20, 0]], "height": )" + height + "}";
  };
  place.write("a.json", scene_text(volume_text("east", "[8, 0, 8]", "2000"), "", plan("20")));
  place.write("b.json", scene_text(volume_text("east", "[8, 0, 8]", "6000"), "", plan("90")));
  const Outcome outcome = place.run({"compare", "a.json", "b.json", "--report", "d.html"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::string page = place.text("d.html");
  const auto after = [&page](const std::string& before, const std::string& opening, std::size_t from) {
    const std::size_t at = page.find(opening, page.find(before, from)) + opening.size();
    return page.substr(at, page.find('"', at) - at);
  };
  const std::size_t first = page.find("<svg"), second = page.find("<svg", first + 1);
  ASSERT_NE(second, std::string::npos);
  EXPECT_EQ(after("<svg", "viewBox=\"", first), after("<svg", "viewBox=\"", second));
  const std::string plot = after("first-plot", " d=\"", first);
  EXPECT_GT(plot.size(), 20u);
  EXPECT_EQ(plot, after("second-plot", " d=\"", second)) << "the same ground lies at the same place";
}

// A programme of many rows, as people have it: the row that differs stands far behind what a line has room for.
std::string scene_of_brief(const std::vector<std::string>& rows) {
  std::string text;
  for (const std::string& row : rows) text += (text.empty() ? "" : ", ") + row;
  return scene_text(volume_text("east", "[8, 0, 8]") + R"(, {"id": "brief", "types": {"programme": {"rows": [)" + text + "]}}}");
}

std::string brief_row(const std::string& use, int area, int count = 1) {
  return R"({"use": ")" + use + R"(", "floor_area": )" + std::to_string(area) + R"(, "count": )" + std::to_string(count) + "}";
}

// What `compare` lists as set differently.
std::string set_differently(const Workplace& place, const std::string& before, const std::string& after) {
  place.write("a.json", before);
  place.write("b.json", after);
  const Outcome outcome = place.run({"compare", "a.json", "b.json", "--ticks", "1"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const std::string title = "Set differently:\n";
  const std::size_t begin = outcome.out.find(title);
  if (begin == std::string::npos) return outcome.out;
  return outcome.out.substr(begin + title.size(), outcome.out.find("\n\n", begin) - begin - title.size());
}

TEST(Compare, RowsOfTablesAreToldByTheirNameAndColumn) {
  const Workplace place;
  const std::vector<std::string> brief{brief_row("housing", 4500, 3), brief_row("offices of the city", 3200),
                                       brief_row("hotel", 3000),      brief_row("garden", 300),
                                       brief_row("hall", 800),        brief_row("school", 2400)};
  const auto differs = [&](const std::vector<std::string>& after) {
    return set_differently(place, scene_of_brief(brief), scene_of_brief(after));
  };
  EXPECT_EQ(differs(brief), "  nothing");
  auto larger = brief;
  larger[3] = brief_row("garden", 350);
  EXPECT_EQ(differs(larger), "  nodes/brief/programme/rows: row 4 `garden`: floor_area 300 -> 350");
  larger[2] = brief_row("hotel", 4200, 2);
  EXPECT_EQ(differs(larger),
            "  nodes/brief/programme/rows: row 3 `hotel`: floor_area 3000 -> 4200, count 1 -> 2; row 4 `garden`: floor_area 300 "
            "-> 350");
  larger[0] = brief_row("housing", 4600, 3);
  larger[4] = brief_row("hall", 900);
  larger[5] = brief_row("school", 2500);
  EXPECT_EQ(differs(larger),
            "  nodes/brief/programme/rows: row 1 `housing`: floor_area 4500 -> 4600; row 3 `hotel`: floor_area 3000 -> 4200, "
            "count 1 -> 2; row 4 `garden`: floor_area 300 -> 350; and 2 more rows");
  auto other = brief;
  other.erase(other.begin() + 1);
  other.push_back(brief_row("pool", 700));
  EXPECT_EQ(differs(other),
            "  nodes/brief/programme/rows: row 2 `offices of the city` in the first only; row 6 `pool` in the second only");
  std::swap(other[0], other[1]);
  other[0] = brief_row("hotel", 10);
  EXPECT_EQ(differs(other),
            "  nodes/brief/programme/rows: row 2 `offices of the city` in the first only; row 3 `hotel`, now row 1: floor_area "
            "3000 -> 10; row 6 `pool` in the second only");
  auto turned = brief;
  std::swap(turned[1], turned[2]);
  EXPECT_EQ(differs(turned), "  nodes/brief/programme/rows: the same rows in another order");
}

// Rows without names of their own, and lists: corners of an exclusion, the points of a plan, long texts.
TEST(Compare, WhatIsLongIsComparedWhole) {
  const Workplace place;
  const auto scene = [](const std::string& plan, const std::string& exclusions, const std::string& about) {
    return R"({"format": "behaviourlinks", "version": 1, "settings": {"about": ")" + about +
           R"("}, "nodes": [{"id": "site", "types": {"boundary": {"form": "plan", "plan": [)" + plan + R"(], "exclusions": [)" +
           exclusions + R"(]}}}, {"id": "solver", "types": {"smart_volumes_solver": {}}}], "links": []})";
  };
  const auto corners = [](int x, int last) {
    std::string text;
    for (const auto& [dx, dy] : {std::pair{0, 0}, {5, 0}, {5, 5}, {0, last}})
      text += (text.empty() ? "" : ", ") + std::string(R"({"name": "street", "x": )") + std::to_string(x + dx) + R"(, "y": )" +
              std::to_string(dy) + R"(, "bottom": 0, "top": 20})";
    return text;
  };
  const std::string plan = "[-40.25,-40.25,0],[40.25,-40.25,0],[40.25,40.25,0],[0,41.5,0],[-40.25,40.25,0]";
  const std::string base = scene(plan, corners(0, 5), std::string(80, 'a') + " ends");
  EXPECT_EQ(set_differently(place, base, scene(plan, corners(0, 6), std::string(80, 'a') + " ends")),
            "  nodes/site/boundary/exclusions: row 4 `street`: y 5 -> 6");
  EXPECT_EQ(set_differently(place, base,
                            scene("[-40.25,-40.25,0],[40.25,-40.25,0],[40.25,40.25,0],[0,41.5,0],[-40.25,39,0]", corners(0, 5),
                                  std::string(80, 'a') + " ends")),
            "  nodes/site/boundary/plan: entry 5: [-40.25, 40.25, 0] -> [-40.25, 39, 0]");
  EXPECT_EQ(set_differently(place, base,
                            scene("[-40.25,-40.25,0],[40.25,-40.25,0],[40.25,40.25,0],[-40.25,40.25,0]", corners(0, 5),
                                  std::string(80, 'a') + " ends")),
            "  nodes/site/boundary/plan: entry 4: [0, 41.5, 0] in the first only");
  EXPECT_EQ(set_differently(place, base, scene(plan, corners(0, 5), std::string(80, 'a') + " goes on")),
            "  settings/about: \"... aaaaaaaaaaaaaaa ends\" -> \"... aaaaaaaaaaaaaaa goes on\"");
}

TEST(Compare, ASceneWithItselfDiffersInNothing) {
  const Workplace place;
  place.write("a.json", moving_scene());
  const Outcome outcome = place.run({"compare", "a.json", "a.json"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("Set differently:\n  nothing"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("No difference: all "), std::string::npos) << outcome.out;
}

// An FSI of 1.2 is no 120 per cent; the share of the ground that is built is one. What solvers still miss is no outcome.
TEST(Compare, RatiosThatAreNoSharesArePlainNumbers) {
  const Workplace place;
  const std::string plot =
      R"({"id": "plot", "types": {"plot": {"polygon": [[-20, -20, 0], [20, -20, 0], [20, 20, 0], [-20, 20, 0]]}}})";
  place.write("a.json", scene_text(volume_text("east", "[8, 0, 8]", "2000") + "," + plot));
  place.write("b.json", scene_text(volume_text("east", "[8, 0, 8]", "6000") + "," + plot));
  const Outcome outcome = place.run({"compare", "a.json", "b.json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto line_of = [&](const std::string& words) {
    const std::size_t at = outcome.out.find(words);
    return at == std::string::npos ? "" : outcome.out.substr(at, outcome.out.find('\n', at) - at);
  };
  for (const char* ratio : {"fsi", "layers"}) {
    const std::string line = line_of(std::string("Plot: ") + ratio);
    ASSERT_NE(line, "") << outcome.out;
    EXPECT_EQ(line.find('%'), line.rfind('%')) << "only the difference is in per cent: " << line;
  }
  const std::string gsi = line_of("Plot: gsi");
  EXPECT_NE(gsi.find('%'), gsi.rfind('%')) << gsi;
  for (const char* inner : {": error", ": weight", ": radius", ": spherical area"})
    EXPECT_EQ(outcome.out.find(inner), std::string::npos) << outcome.out;
}

// What was next to nothing has no percentage: a limit that winds a volume down to nothing is told in cubic metres.
TEST(Compare, PercentagesOfNothingAreNotPrinted) {
  const Workplace place;
  const auto scene = [](const std::string& more) {
    return scene_text(volume_text("west", "[-8, 0, 8]", "1500") +
                      R"(, {"id": "east", "position": [8, 0, 8], "types": {"smart_volume": {"demand": 2000)" + more + "}}}");
  };
  place.write("a.json", scene(R"(, "demand_limit": 1e-9)"));
  place.write("b.json", scene(""));
  const Outcome outcome = place.run({"compare", "a.json", "b.json", "--ticks", "60", "--report", "d.html"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (std::string line : {outcome.out, place.text("d.html")})
    for (std::size_t at = line.find('%'); at != std::string::npos; at = line.find('%', at + 1)) {
      std::size_t digits = 0, begin = at;
      while (begin > 0 && std::string("0123456789. +-\xE2\x80\xAF\xC2\xA0\x88\x92").find(line[begin - 1]) != std::string::npos)
        digits += std::isdigit(static_cast<unsigned char>(line[--begin])) != 0 ? 1 : 0;
      EXPECT_LE(digits, 7u) << line.substr(begin, at - begin + 1);
    }
  EXPECT_NE(outcome.out.find("missing of the volume asked for"), std::string::npos) << outcome.out;
}

// What matters comes first, in the text and on the page: floor area by use, densities, sun, rules; then volumes, then the rest.
TEST(Compare, BeginsWithWhatAProposalIsJudgedBy) {
  const Workplace place;
  const auto scene = [](const std::string& demand, const std::string& more) {
    std::string casters;
    for (int k = 0; k < 5; ++k)
      casters += R"(, {"id": "b)" + std::to_string(k) + R"(", "position": [900, )" + std::to_string(30 * k) +
                 R"(, 0], "types": {"existing_building": {"outline": [[0,0,0],[9,0,0],[9,9,0]], "height": 9})" + more + "}}";
    return R"({"format": "behaviourlinks", "version": 1, "nodes": [
      {"id": "flats", "name": "Flats", "types": {"footprint": {"storeys": 3}, "smart_volume": {"use": "housing", "demand": )" +
           demand + R"(}}},
      {"id": "site", "types": {"boundary": {"form": "plan", "plan": [[-40,-40,0],[40,-40,0],[40,40,0],[-40,40,0]], "height": 30}}},
      {"id": "solver", "types": {"standing_solver": {}}})" +
           casters + R"(], "links": []})";
  };
  place.write("a.json", scene("3000", ""));
  place.write("b.json", scene("4500", R"(, "shadow_caster": {})"));
  const Outcome outcome = place.run({"compare", "a.json", "b.json", "--report", "d.html"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::string page = place.text("d.html");
  const std::size_t begin = page.find("What it is judged by");
  ASSERT_NE(begin, std::string::npos);
  for (const std::string& text : {outcome.out, page.substr(begin)}) {
    std::size_t last = 0;
    for (const char* part : {"housing", "Floor area", "FSI", "GSI", "OSR", "SmartVolume: floor area",
                             "shadow_caster: a role of 5 nodes in the second only"}) {
      const std::size_t at = text.find(part);
      ASSERT_NE(at, std::string::npos) << part << "\n" << text;
      EXPECT_GE(at, last) << part;
      last = at;
    }
    EXPECT_EQ(text.find("nodes/b0/shadow_caster"), std::string::npos);
  }
  report::IndicatorRow missing{"", "", "", "", Unit::square_metre, 0, 12};
  missing.has_before = false;
  EXPECT_EQ(missing.first(), "\u2013") << "a proposal that has no such thing has no 0 of it";
  EXPECT_EQ(missing.difference(), "\u2013");
  EXPECT_TRUE(missing.is_seen(1e-6));
}

// Two runs to the same end differ by what solvers may miss: such differences are counted, and have no percentage.
TEST(Compare, DifferencesBelowTheToleranceAreCounted) {
  const Workplace place;
  const auto scene = [](const std::string& demand) {
    return R"({"format": "behaviourlinks", "version": 1, "nodes": [
      {"id": "flats", "name": "Flats", "types": {"footprint": {"storeys": 3}, "smart_volume": {"use": "housing", "demand": )" +
           demand + R"(}}},
      {"id": "site", "types": {"boundary": {"form": "plan", "plan": [[-40,-40,0],[40,-40,0],[40,40,0],[-40,40,0]], "height": 30}}},
      {"id": "solver", "types": {"standing_solver": {}}}], "links": []})";
  };
  place.write("a.json", scene("3000"));
  place.write("b.json", scene("3003"));
  const Outcome outcome = place.run({"compare", "a.json", "b.json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.find("Volumes:"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("by less than the tolerance of the solvers"), std::string::npos) << outcome.out;
  EXPECT_EQ((report::IndicatorRow{"", "", "", "", Unit::cubic_metre, 0.047, 33.6}.difference().find('%')), std::string::npos);
}

TEST(Compare, BadScenesAreToldWithTheirPlace) {
  const Workplace place;
  place.write("a.json", moving_scene());
  place.write("b.json", R"({"format": "behaviourlinks", "version": 1, "nodes": [{"id": 3}]})");
  const Outcome outcome = place.run({"compare", "a.json", "b.json"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("b.json: nodes/0"), std::string::npos) << outcome.err;
  EXPECT_EQ(place.run({"compare", "a.json", "nowhere.json"}).code, 2);
}

// A volume that had next to nothing: 5 000 m² more are no percentage of it.
TEST(Compare, NoPercentageOfNothingIsTold) {
  const auto difference = [](double before, double after) {
    return report::IndicatorRow{"", "", "", "", Unit::square_metre, before, after}.difference();
  };
  for (const double nothing : {0.0, 8.3e-13, 1e-300, -1e-9, 0.004}) {
    EXPECT_EQ(difference(nothing, 5000).find('%'), std::string::npos) << difference(nothing, 5000);
    EXPECT_NE(difference(nothing, 5000).find("5"), std::string::npos) << difference(nothing, 5000);
  }
  EXPECT_NE(difference(2500, 5000).find("100"), std::string::npos) << difference(2500, 5000);
  EXPECT_NE(difference(5000, 0).find('%'), std::string::npos) << "all of it has gone";
}

}  // namespace

}  // namespace bl::test
