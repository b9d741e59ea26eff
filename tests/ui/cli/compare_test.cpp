// `compare`: what people set differently, what became of it, and scenes that cannot be compared.
#include <gtest/gtest.h>

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

TEST(Compare, ASceneWithItselfDiffersInNothing) {
  const Workplace place;
  place.write("a.json", moving_scene());
  const Outcome outcome = place.run({"compare", "a.json", "a.json"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("Set differently:\n  nothing"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("0 numbers of nodes differ"), std::string::npos) << outcome.out;
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

}  // namespace

}  // namespace bl::test
