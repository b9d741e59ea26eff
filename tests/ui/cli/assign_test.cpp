// `assign`: Braess's figures, an edit on the running state, lost trips, and what is said of bad input.
#include <gtest/gtest.h>

#include "tests/ui/cli/program.h"

namespace bl::test {

namespace {

const std::string kNet =
    "<NUMBER OF ZONES> 2\n<NUMBER OF NODES> 4\n<FIRST THRU NODE> 1\n<END OF METADATA>\n"
    "1 3 1 100 0.00000001 1000000000 1 0 0 1;\n1 4 1 100 50 0.02 1 0 0 1;\n3 2 1 100 50 0.02 1 0 0 1;\n"
    "3 4 1 100 10 0.1 1 0 0 1;\n4 2 1 100 0.00000001 1000000000 1 0 0 1;\n";
const std::string kTrips = "<NUMBER OF ZONES> 2\n<END OF METADATA>\nOrigin 1\n2 : 6.0;\n";

TEST(Assign, EverybodyIsFasterWithoutTheBridge) {
  const Workplace place;
  place.write("n.tntp", kNet);
  place.write("t.tntp", kTrips);
  place.write("f.tntp", "From To Volume Cost\n1 3 4 40\n1 4 2 52\n3 2 2 52\n3 4 2 12\n4 2 4 40\n");
  const Outcome outcome = place.run({"assign", "n.tntp", "t.tntp", "--gap", "1e-10", "--flows", "f.tntp", "--close", "3-4",
                                     "--json", "o.json", "--repeat", "3"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const nlohmann::json json = place.json("o.json");
  EXPECT_NEAR(json["equilibrium"]["total_cost"].get<double>(), 6 * 92, 1e-6);
  EXPECT_NEAR(json["after_edit"]["total_cost"].get<double>(), 6 * 83, 1e-6);
  EXPECT_LE(json["equilibrium"]["gap"].get<double>(), 1e-10);
  EXPECT_LE(json["comparison"]["share_apart"].get<double>(), 1e-6);
  EXPECT_NE(outcome.out.find("after the edit, warm"), std::string::npos);
}

TEST(Assign, EditsTollsAndLostTrips) {
  const Workplace place;
  place.write("n.tntp", "1 2 100 5 10 0.15 4 0 50 1;\n2 1 100 5 10 0.15 4 0 50 1;\n");
  place.write("t.tntp", "Origin 1\n2 : 100; 1 : 7;\nOrigin 2\n1 : 3;\n");
  Outcome outcome = place.run({"assign", "n.tntp", "t.tntp", "--toll-factor", "0.02", "--distance-factor", "0.04",
                               "--edit-capacity", "1-2=50", "--close", "2-1", "--json", "o.json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const nlohmann::json json = place.json("o.json");
  EXPECT_NEAR(json["links"][0]["cost"].get<double>(), 10 * (1 + 0.15 * 16) + 1 + 0.2, 1e-9);
  EXPECT_EQ(json["equilibrium"]["within"], 7);
  EXPECT_EQ(json["after_edit"]["lost"][0]["trips"], 3);
  EXPECT_EQ(json["after_edit"]["lost"][0]["reason"], "no open way leads there");
  EXPECT_NE(outcome.out.find("lost        3.0 trips from 2 to 1: no open way leads there"), std::string::npos) << outcome.out;
  outcome = place.run({"assign", "n.tntp", "t.tntp", "--iterations", "0", "--gap", "0"});
  EXPECT_EQ(outcome.code, 0) << "one street: nobody has a choice";
}

TEST(Assign, TellsRoutesAndReach) {
  const Workplace place;
  place.write("n.tntp", kNet);
  place.write("t.tntp", kTrips);
  place.write("p.tntp", "Node\tX\tY\t;\n1\t-3.5\t2\t;\n");
  const Outcome outcome = place.run({"assign", "n.tntp", "t.tntp", "--gap", "1e-10", "--routes", "1-2", "--routes", "2-1",
                                     "--reach", "1=46", "--json", "o.json", "--nodes", "p.tntp"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const nlohmann::json json = place.json("o.json");
  EXPECT_EQ(json["nodes"]["1"]["x"], -3.5);
  ASSERT_EQ(json["routes"][0]["used"].size(), 3u);
  for (const auto& route : json["routes"][0]["used"]) EXPECT_NEAR(route["cost"].get<double>(), 92, 1e-4);
  EXPECT_EQ(json["routes"][1]["used"].size(), 0u);
  // 40 to node 3; 6 more are half of the bridge's 12; 46 of the 52 to node 4, and of those from 3 to 2.
  EXPECT_EQ(json["reach"][0]["nodes"].size(), 2u);
  ASSERT_EQ(json["reach"][0]["links"].size(), 4u);
  EXPECT_NEAR(json["reach"][0]["links"][1]["share"].get<double>(), 46.0 / 52, 1e-4);
  EXPECT_NEAR(json["reach"][0]["links"][3]["share"].get<double>(), 0.5, 1e-4);
  EXPECT_NE(outcome.out.find("from 1 within 46: 2 nodes, 1 link whole and 3 in part"), std::string::npos) << outcome.out;
  EXPECT_NE(place.run({"assign", "n.tntp", "t.tntp", "--routes", "1"}).err.find("there is no node ``"), std::string::npos);
  EXPECT_NE(place.run({"assign", "n.tntp", "t.tntp", "--reach", "1"}).err.find("expects NODE=LIMIT"), std::string::npos);
}

TEST(Assign, BadInputHasItsPlace) {
  const Workplace place;
  place.write("n.tntp", kNet);
  place.write("t.tntp", kTrips);
  place.write("bad.tntp", kNet + "1 9 x\n");
  place.write("far.tntp", "Origin 1\n77 : 5;\n");
  auto error = [&](const std::vector<std::string>& arguments) {
    const Outcome outcome = place.run(arguments);
    EXPECT_EQ(outcome.code, 2);
    return outcome.err;
  };
  EXPECT_NE(error({"assign", "bad.tntp", "t.tntp"}).find("bad.tntp: line 10: "), std::string::npos);
  EXPECT_NE(error({"assign", "nowhere", "t.tntp"}).find("nowhere: "), std::string::npos);
  EXPECT_NE(error({"assign", "n.tntp", "far.tntp"}).find("no node 77"), std::string::npos);
  EXPECT_NE(error({"assign", "n.tntp", "t.tntp", "--edit-capacity", "1-3"}).find("expects LINK=VALUE"), std::string::npos);
  EXPECT_NE(error({"assign", "n.tntp", "t.tntp", "--close", "1-2"}).find("no link `1-2`"), std::string::npos);
  EXPECT_NE(error({"assign", "t.tntp", "n.tntp"}).find("t.tntp: line 3: "), std::string::npos);
}

TEST(Assign, AGapThatIsNotReachedIsSaid) {
  const Workplace place;
  place.write("n.tntp", kNet);
  place.write("t.tntp", kTrips);
  const Outcome outcome = place.run({"assign", "n.tntp", "t.tntp", "--iterations", "1", "--gap", "1e-15"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_NE(outcome.out.find("the gap was not reached"), std::string::npos);
}

}  // namespace

}  // namespace bl::test
