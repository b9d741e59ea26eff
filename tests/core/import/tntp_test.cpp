// TNTP files: the format as described, as others write it, and broken; every error has its line.
#include "core/import/tntp.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "tests/core/traffic/traffic_case.h"

namespace bl::importing {
namespace {

constexpr const char* kNet =
    "<NUMBER OF ZONES> 2\t\t\n<NUMBER OF NODES> 4\n<FIRST THRU NODE> 3\n<NUMBER OF LINKS> 3\n"
    "<ORIGINAL HEADER>~ \tInit node \tTerm node \tCapacity \tLength \tFree Flow Time \tB\tPower\tSpeed limit \tToll \tType\t;\n"
    "<END OF METADATA>\n\n\n~ \tinit_node\tterm_node\tcapacity\tlength\tfree_flow_time\tb\tpower\tspeed\ttoll\tlink_type\t;\n"
    "\t1\t3\t900\t2.5\t6\t0.15\t4\t0\t20\t1\t;\n\t3\t2\t1e3\t1\t4\t0.2\t2\t0\t0\t1;\n\t3\t2\t500\t1\t4\t0.2\t2\t0\t0\t1\t;\n";
constexpr const char* kTrips =
    "<NUMBER OF ZONES> 2\n<TOTAL OD FLOW>   12.5\n<END OF METADATA>\n\nOrigin \t1 \n    1 :      0.0;     2 :     "
    "12.0;\n\nOrigin 2\n1:0.5;\n";

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

TEST(Tntp, NetworkAsDescribed) {
  const auto net = read_tntp_network(kNet);
  ASSERT_TRUE(net.ok()) << net.error().text();
  EXPECT_TRUE(net->notes.empty());
  EXPECT_EQ(net->zones, 2);
  ASSERT_EQ(net->nodes.size(), 4u);
  EXPECT_FALSE(net->nodes[1].is_through);
  EXPECT_TRUE(net->nodes[2].is_through);
  ASSERT_EQ(net->links.size(), 3u);
  const traffic::TrafficLink& link = net->links[0];
  EXPECT_EQ(link.id, "1-3");
  EXPECT_EQ(link.capacity, 900);
  EXPECT_EQ(link.length, 2.5);
  EXPECT_EQ(link.free_time, 6);
  EXPECT_EQ(link.alpha, 0.15);
  EXPECT_EQ(link.power, 4);
  EXPECT_EQ(link.toll, 20);
  EXPECT_EQ(net->links[2].id, "3-2#2");
}

TEST(Tntp, TripsAsDescribed) {
  const auto trips = read_tntp_trips(kTrips);
  ASSERT_TRUE(trips.ok()) << trips.error().text();
  EXPECT_TRUE(trips->notes.empty());
  ASSERT_EQ(trips->entries.size(), 2u);
  EXPECT_EQ(trips->entries[1].origin, "2");
  EXPECT_EQ(trips->entries[1].trips, 0.5);
  EXPECT_EQ(trips->total, 12.5);
}

TEST(Tntp, VariantsOfTheFormatAreRead) {
  const std::string net = kNet, trips = kTrips;
  // Windows line ends, no blanks, no semicolons, comments in between, metadata in another order and letters, a BOM.
  std::string windows;
  for (const char c : net) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(read_tntp_network(windows)->links.size(), 3u);
  EXPECT_EQ(read_tntp_network("\xEF\xBB\xBF" + net)->links.size(), 3u);
  EXPECT_EQ(read_tntp_network(replaced(net, "\t1\t3\t900", "~ a remark\n 1 3 900"))->links[0].capacity, 900);
  EXPECT_EQ(
      read_tntp_network("<first thru node> 3\n<Number of Zones> 2\n1 3 900 2.5 6 0.15 4\n3 2 1000 1 4 0.2 2")->links[1].power, 2);
  EXPECT_EQ(read_tntp_network("1,3,900,2.5,6,0.15,4,0,20,1;")->links[0].toll, 20);
  EXPECT_EQ(read_tntp_network("1 3 900 2.5 6 ;")->links[0].alpha, 0.15) << "missing columns at the end";
  EXPECT_EQ(read_tntp_network("~ from to free_flow_time capacity length b power\n1 3 6 900 2.5 0.15 4")->links[0].capacity, 900);
  EXPECT_EQ(read_tntp_trips(replaced(trips, ";\n\nOrigin 2", "\n\nORIGIN   2 "))->entries.size(), 2u);
  EXPECT_EQ(read_tntp_trips("Origin 1 2 : 3.5; 3 : 4;")->entries.size(), 2u) << "all on one line";
  EXPECT_EQ(read_tntp_trips("Origin 1\nOrigin 2\n1 : 1;")->entries.size(), 1u) << "a zone without trips";
  EXPECT_EQ(read_tntp_flows("From \tTo \tVolume \tCost \n1 \t2 \t10.5 \t6\n")->entries[0].volume, 10.5);
  EXPECT_EQ(read_tntp_flows("~ Tail Head : Volume Cost ;\n1 2 : 10.5 6 ;\n")->entries[0].cost, 6);
  EXPECT_EQ(read_tntp_places("Node\tX\tY\t;\n1\t-96.5\t43.5\t;\n")->entries[0].x, -96.5);
}

TEST(Tntp, WrongCountsAreNotedAndNothingIsLost) {
  const std::string net = kNet;
  EXPECT_EQ(read_tntp_network(replaced(net, "LINKS> 3", "LINKS> 2"))->notes.size(), 1u);
  const auto cut = read_tntp_network(replaced(net, "LINKS> 3", "LINKS> 7"));
  ASSERT_FALSE(cut.ok());
  EXPECT_EQ(cut.error().text(),
            "<NUMBER OF LINKS>: the file promises 7 links and holds 3: it is cut off. Fetch it again, or correct this line if it "
            "is wrong");
  const auto more = read_tntp_network(replaced(net, "NODES> 4", "NODES> 2"));
  EXPECT_EQ(more->nodes.size(), 3u);
  EXPECT_EQ(more->notes.size(), 1u);
  const auto loop = read_tntp_network(net + "\t3\t3\t1\t1\t1\t0\t0\t0\t0\t1\t;\n");
  EXPECT_EQ(loop->links.size(), 3u);
  EXPECT_EQ(loop->notes.size(), 2u) << "another number of links, and one that was left out";
  EXPECT_EQ(read_tntp_trips(replaced(kTrips, "12.5", "12.55"))->notes.size(), 1u);
  EXPECT_EQ(read_tntp_trips(replaced(kTrips, "12.5", "12"))->notes.size(), 1u) << "more than promised is not cut off";
  EXPECT_EQ(read_tntp_trips(replaced(kTrips, "12.5", "25")).error().place, "<TOTAL OD FLOW>") << "half of them are missing";
  const auto open = read_tntp_trips("<TOTAL OD FLOW> 12\nOrigin 1\n2 : 3;\n3 : 4;\n4 : 5");
  ASSERT_FALSE(open.ok());
  EXPECT_EQ(open.error().place, "line 5") << "it was 50 perhaps";
}

TEST(Tntp, ErrorsSayWhere) {
  const std::string net = kNet, trips = kTrips;
  auto place = [](const auto& result) { return result ? std::string("good") : result.error().place; };
  EXPECT_EQ(place(read_tntp_network(replaced(net, "900", "9o0"))), "line 10");
  EXPECT_EQ(place(read_tntp_network(replaced(net, "\t3\t2\t1e3\t1\t4", "\t3\t2\t1e3"))), "good") << "B and power in their place";
  EXPECT_EQ(place(read_tntp_network(net + "3 2 5\n")), "line 13");
  EXPECT_EQ(place(read_tntp_network(replaced(net, "1e3", "0"))), "line 11");
  EXPECT_EQ(place(read_tntp_network(replaced(net, "1e3", "-5"))), "line 11");
  EXPECT_EQ(place(read_tntp_network(replaced(net, "\t1\t3", "\t1.5\t3"))), "line 10");
  EXPECT_EQ(place(read_tntp_network(replaced(net, "<NUMBER OF ZONES> 2", "<NUMBER OF ZONES> two"))), "<NUMBER OF ZONES>");
  EXPECT_EQ(place(read_tntp_network(replaced(net, "<FIRST THRU NODE> 3", "<FIRST THRU NODE 3"))), "line 3");
  EXPECT_EQ(place(read_tntp_network(std::string(net) + "\x01\x02")), "line 13");
  EXPECT_EQ(place(read_tntp_trips(replaced(trips, "Origin \t1 \n", ""))), "line 5");
  EXPECT_EQ(place(read_tntp_trips(replaced(trips, "12.0;", ";"))), "line 6");
  EXPECT_EQ(place(read_tntp_trips(replaced(trips, "0.5", "-0.5"))), "line 9");
  EXPECT_FALSE(read_tntp_network("").ok());
  EXPECT_FALSE(read_tntp_trips("").ok());
  EXPECT_FALSE(read_tntp_flows("From To Volume Cost").ok());
  EXPECT_FALSE(read_tntp_places("Node X Y").ok());
}

TEST(Tntp, RandomBytesNeverBreakTheReader) {
  for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
    Random random(seed);
    std::string text = seed % 2 ? kNet : kTrips;
    for (int edits = 0; edits < 8; ++edits) {
      const auto at = random.below(text.size());
      if (random.below(3) == 0) text.erase(at, random.below(30));
      else
        text[at] = static_cast<char>(
            random.below(2) == 0 ? random.below(256) : static_cast<std::uint64_t>("0123456789.;:<>~-eE\n\t "[random.below(21)]));
      if (text.empty()) text = "~";
    }
    for (const bool good :
         {read_tntp_network(text).ok(), read_tntp_trips(text).ok(), read_tntp_flows(text).ok(), read_tntp_places(text).ok()})
      (void)good;
    if (const auto net = read_tntp_network(text)) (void)traffic::TrafficNetwork::make(net->nodes, net->links, net->factors).ok();
  }
}

TEST(Tntp, PublishedFilesAreReadWhole) {
  struct File {
    const char* name;
    std::size_t nodes, links;
    double trips;
  };
  for (const File& file : {File{"SiouxFalls", 24, 76, 360600}, File{"Anaheim", 416, 914, 104694.4},
                           File{"EMA", 74, 258, 65576.37543}, File{"Braess", 4, 5, 6}}) {
    const auto net_path = test::shared_file(std::string("data/tntp/") + file.name + "_net.tntp");
    if (net_path.empty()) {
      std::cout << "The network " << file.name << " is not beside this checkout; its counts are not compared.\n";
      continue;
    }
    const auto net = read_tntp_network(traffic_test::text_of(net_path));
    const auto trips =
        read_tntp_trips(traffic_test::text_of(test::shared_file(std::string("data/tntp/") + file.name + "_trips.tntp")));
    ASSERT_TRUE(net.ok() && trips.ok());
    EXPECT_EQ(net->nodes.size(), file.nodes);
    EXPECT_EQ(net->links.size(), file.links);
    EXPECT_NEAR(trips->total, file.trips, 1e-4);
    EXPECT_TRUE(net->notes.empty() && trips->notes.empty()) << file.name;
  }
}

}  // namespace
}  // namespace bl::importing
