// OpenStreetMap: cases made by hand, hostile input, and extracts of real places against the counts of an independent reader.
#include <gtest/gtest.h>

#include <cmath>

#include "core/import/osm_context.h"
#include "core/import/osm_tags.h"
#include "tests/core/import/context_data.h"

namespace bl::importing {
namespace {

using test::area_of, test::reason_of, test::rows_of, test::shared_bytes;

// Nodes on a grid of 0.001 degrees: 1 to 9 in rows of three from the south-west; at 60 degrees north 55.8 by 111.4 m.
std::string osm(const std::string& elements) {
  std::string text = R"(<?xml version="1.0"?><osm version="0.6">)";
  for (int i = 0; i < 9; ++i)
    text += "<node id=\"" + std::to_string(i + 1) + "\" lat=\"" + std::to_string(60 + 0.001 * (i / 3)) + "\" lon=\"" +
            std::to_string(25 + 0.001 * (i % 3)) + "\"/>";
  return text + elements + "</osm>";
}
std::string way(int id, std::initializer_list<int> nodes, const std::string& tags) {
  std::string text = "<way id=\"" + std::to_string(id) + "\">";
  for (const int node : nodes) text += "<nd ref=\"" + std::to_string(node) + "\"/>";
  for (std::size_t at = 0; at < tags.size();) {
    const std::size_t equals = tags.find('=', at), end = std::min(tags.find(';', at), tags.size());
    text += "<tag k=\"" + tags.substr(at, equals - at) + "\" v=\"" + tags.substr(equals + 1, end - equals - 1) + "\"/>";
    at = end + 1;
  }
  return text + "</way>";
}

TEST(OsmTags, LengthsHaveUnits) {
  EXPECT_EQ(osm_length("12"), 12);
  EXPECT_EQ(osm_length(" 12 m"), 12);
  EXPECT_EQ(osm_length("12,5"), 12.5);
  EXPECT_EQ(osm_length(".5"), 0.5);
  EXPECT_DOUBLE_EQ(osm_length("40'").value(), 12.192);
  EXPECT_DOUBLE_EQ(osm_length("5'10\"").value(), 1.778);
  EXPECT_DOUBLE_EQ(osm_length("10 ft").value(), 3.048);
  for (const char* text : {"", "high", "12 parrots", "1.2.3", "-"}) EXPECT_FALSE(osm_length(text).has_value()) << text;
}

TEST(OsmTags, SpeedsHaveUnits) {
  EXPECT_DOUBLE_EQ(osm_speed("50").value(), 50 / 3.6);
  EXPECT_DOUBLE_EQ(osm_speed("30 mph").value(), 13.4112);
  EXPECT_TRUE(osm_speed("walk").has_value());
  for (const char* text : {"none", "signals", "RU:urban", "0"}) EXPECT_FALSE(osm_speed(text).has_value()) << text;
}

TEST(OsmTags, HeightsComeFromTagsThenFromLevels) {
  const OsmHeight tag = osm_height({{"height", "12 m"}, {"min_height", "3"}, {"building:levels", "9"}}, 3);
  EXPECT_EQ(tag.base, 3);
  EXPECT_EQ(tag.height, 9);
  EXPECT_FALSE(tag.is_from_levels);
  const OsmHeight levels =
      osm_height({{"building:levels", "4"}, {"roof:levels", "1"}, {"building:min_level", "2"}, {"height", "tall"}}, 3);
  EXPECT_EQ(levels.base, 6);
  EXPECT_EQ(levels.height, 9);
  EXPECT_TRUE(levels.is_from_levels);
  EXPECT_EQ(levels.fault, "height=tall");
  EXPECT_EQ(osm_height({{"height", "3"}, {"min_height", "5"}}, 3).height, 0);
}

TEST(OsmTags, DirectionsAndLanes) {
  EXPECT_EQ(osm_road({{"highway", "primary"}, {"oneway", "-1"}}).direction, -1);
  EXPECT_EQ(osm_road({{"highway", "motorway"}}).direction, 1);
  EXPECT_EQ(osm_road({{"highway", "motorway"}, {"oneway", "no"}}).direction, 0);
  EXPECT_EQ(osm_road({{"highway", "tertiary"}, {"junction", "roundabout"}}).direction, 1);
  EXPECT_EQ(osm_road({{"highway", "residential"}, {"lanes", "3"}}).lanes, 3);
  EXPECT_EQ(osm_road({{"highway", "residential"}, {"lanes", "2;3"}}).fault, "lanes=2;3");
  EXPECT_FALSE(osm_road({{"highway", "footway"}}).for_cars);
  EXPECT_FALSE(osm_road({{"highway", "proposed"}}).is_road);
}

TEST(OsmContext, ABuildingInMetres) {
  const auto context = read_osm_context(osm(way(10, {1, 2, 5, 4, 1}, "building=house;height=12,5;name=Hut")));
  ASSERT_TRUE(context.ok()) << context.error().text();
  ASSERT_EQ(context->buildings.size(), 1u);
  const ContextBuilding& hut = context->buildings[0];
  EXPECT_EQ(hut.id, "w10");
  EXPECT_EQ(hut.name, "Hut");
  EXPECT_EQ(hut.use, "house");
  EXPECT_EQ(hut.height, 12.5);
  EXPECT_EQ(hut.height_source, HeightSource::tag);
  // A thousandth of a degree on the ellipsoid at 60 degrees north: 55.80 m by 111.41 m.
  EXPECT_NEAR(area_of(hut), 55.80 * 111.41, 5);
  EXPECT_EQ(context->report.total("way"), 1u);
  EXPECT_EQ(context->report.total("node"), 9u);
  EXPECT_EQ(context->report.count(ImportOutcome::skipped, "node"), 5u);
}

TEST(OsmContext, HeightsOfNeighboursThenTheDefault) {
  std::string ways;
  for (int i = 0; i < 3; ++i) ways += way(10 + i, {1, 2, 5, 4, 1}, "building=yes;height=" + std::to_string(10 + 10 * i));
  ways += way(20, {2, 3, 6, 5, 2}, "building=yes");
  ContextOptions options;
  const auto near = read_osm_context(osm(ways), options);
  EXPECT_EQ(near->buildings.back().height, 20) << "the median of 10, 20 and 30";
  EXPECT_EQ(near->buildings.back().height_source, HeightSource::neighbour);
  options.neighbour_distance = 10;
  const auto far = read_osm_context(osm(ways), options);
  EXPECT_EQ(far->buildings.back().height, 9.6);
  EXPECT_EQ(far->buildings.back().height_source, HeightSource::assumed);
}

TEST(OsmContext, MultipolygonsHaveCourtsAndMayBePutTogether) {
  const std::string ring =
      "<node id=\"21\" lat=\"60.0005\" lon=\"25.0005\"/><node id=\"22\" lat=\"60.0005\" lon=\"25.0015\"/>"
      "<node id=\"23\" lat=\"60.0015\" lon=\"25.0010\"/>";
  const std::string relation =
      R"(<relation id="5"><member type="way" ref="10" role="outer"/><member type="way" ref="11" role="outer"/>
    <member type="way" ref="12" role="inner"/><tag k="type" v="multipolygon"/><tag k="building" v="yes"/></relation>)";
  const std::string halves = way(10, {1, 2, 3, 6, 9}, "") + way(11, {1, 4, 7, 8, 9}, "");
  const auto context = read_osm_context(osm(ring + halves + way(12, {21, 22, 23, 21}, "") + relation));
  ASSERT_TRUE(context.ok());
  ASSERT_EQ(context->buildings.size(), 1u);
  EXPECT_EQ(context->buildings[0].id, "r5");
  EXPECT_EQ(context->buildings[0].holes.size(), 1u);
  EXPECT_NEAR(area_of(context->buildings[0]), 111.6 * 222.8 - 55.8 * 111.4 / 2, 20);
  EXPECT_EQ(reason_of(context->report, "w10"), "taken: outline of a multipolygon");
  const auto open = read_osm_context(osm(way(10, {1, 2, 3, 6, 9}, "") + relation));
  EXPECT_EQ(reason_of(open->report, "r5"), "skipped: building: its outer ring is open");
}

TEST(OsmContext, PartsTakeThePlaceOfTheirBuilding) {
  const std::string whole = way(10, {1, 2, 3, 6, 5, 4, 1}, "building=yes;height=30");
  const auto both = read_osm_context(
      osm(whole + way(11, {1, 2, 5, 4, 1}, "building:part=yes;height=10") + way(12, {2, 3, 6, 5, 2}, "building:part=yes")));
  ASSERT_EQ(both->buildings.size(), 2u);
  EXPECT_EQ(both->buildings[0].height, 10);
  EXPECT_EQ(both->buildings[1].height, 30) << "a part without a height has that of its building";
  EXPECT_EQ(both->buildings[0].whole, "w10");
  EXPECT_EQ(reason_of(both->report, "w10"), "taken: building, drawn by its parts");
  const auto one = read_osm_context(osm(whole + way(11, {1, 2, 5, 4, 1}, "building:part=yes;height=40")));
  ASSERT_EQ(one->buildings.size(), 2u) << "a part that rises from a building that it does not cover";
  EXPECT_EQ(one->buildings[1].base, 30);
  EXPECT_EQ(one->buildings[1].height, 10);
  const auto within = read_osm_context(osm(whole + way(11, {1, 2, 5, 4, 1}, "building:part=yes;height=20")));
  EXPECT_EQ(within->buildings.size(), 1u);
  EXPECT_EQ(reason_of(within->report, "w11"), "skipped: building part: within its building, whose parts do not cover it");
}

TEST(OsmContext, StreetsEndAtJunctions) {
  const auto context = read_osm_context(osm(way(10, {4, 5, 6}, "highway=residential;oneway=-1;maxspeed=30 mph;lanes=1") +
                                            way(11, {2, 5, 8}, "highway=footway") + way(12, {7, 8, 9}, "highway=proposed")));
  ASSERT_TRUE(context.ok());
  ASSERT_EQ(context->streets.size(), 4u);
  EXPECT_EQ(context->junctions.size(), 5u);
  const ContextStreet& first = context->streets[0];
  EXPECT_TRUE(first.is_one_way);
  EXPECT_GT(first.line.front().x, first.line.back().x) << "against the order of its nodes";
  EXPECT_NEAR(first.speed, 13.4112, 1e-12);
  EXPECT_FALSE(first.is_speed_assumed);
  EXPECT_EQ(context->junctions[first.end].id, "n5");
  EXPECT_EQ(reason_of(context->report, "w12"), "skipped: street: no way to travel on");
}

TEST(OsmContext, TurnRestrictionsNamePieces) {
  const std::string ways =
      way(10, {4, 5}, "highway=primary") + way(11, {5, 6}, "highway=primary") + way(12, {5, 8}, "highway=primary");
  const auto rule = [](const std::string& via) {
    return R"(<relation id="7"><member type="way" ref="10" role="from"/>)" + via +
           R"(<member type="way" ref="12" role="to"/><tag k="type" v="restriction"/><tag k="restriction" v="no_left_turn"/></relation>)";
  };
  const auto good = read_osm_context(osm(ways + rule(R"(<member type="node" ref="5" role="via"/>)")));
  ASSERT_EQ(good->restrictions.size(), 1u);
  EXPECT_EQ(good->streets[good->restrictions[0].from].id, "w10/0");
  EXPECT_EQ(good->junctions[good->restrictions[0].via].id, "n5");
  const auto over = read_osm_context(osm(ways + rule(R"(<member type="way" ref="11" role="via"/>)")));
  EXPECT_EQ(reason_of(over->report, "r7"), "skipped: turn restriction: it runs via a way");
}

// A crossing of four one-piece streets at node 5; way 13 runs through it from north to south.
std::string crossing_with(const std::string& members, const std::string& tags, const std::string& rest = "") {
  std::string relation = R"(<relation id="7"><tag k="type" v="restriction"/>)" + tags;
  for (std::size_t at = 0; at + 2 < members.size(); at += 4)
    relation += R"(<member type="way" ref="1)" + members.substr(at, 1) + R"(" role=")" +
                (members[at + 1] == 'f' ? "from" : "to") + R"("/>)";
  relation += R"(<member type="node" ref="5" role="via"/></relation>)";
  return osm(way(10, {4, 5}, "highway=primary") + way(11, {5, 6}, "highway=primary;oneway=yes") +
             way(12, {5, 8}, "highway=primary") + rest + relation);
}

TEST(OsmContext, TurnRestrictionsAreReadOrSayWhyNot) {
  const auto tag = [](const std::string& key, const std::string& value) {
    return R"(<tag k=")" + key + R"(" v=")" + value + R"("/>)";
  };
  const auto reason = [](const std::string& text) {
    const auto context = read_osm_context(text);
    EXPECT_TRUE(context.ok());
    return reason_of(context->report, "r7") + (context->restrictions.empty() ? "" : ", " + context->restrictions[0].rule);
  };
  const std::string skipped = "skipped: turn restriction: ", left = tag("restriction", "no_left_turn");
  EXPECT_EQ(reason(crossing_with("0f  2t  ", left)), "taken: turn restriction, no_left_turn");
  EXPECT_EQ(reason(crossing_with("0f  2t  ", tag("restriction:motorcar", "only_right_turn"))),
            "taken: turn restriction, only_right_turn");
  EXPECT_EQ(reason(crossing_with("0f  0t  ", tag("restriction", "no_u_turn"))), "taken: turn restriction, no_u_turn");
  EXPECT_EQ(reason(crossing_with("0f  2t  ", tag("restriction:hgv", "no_left_turn"))),
            skipped + "it is not for all cars at all times");
  EXPECT_EQ(reason(crossing_with("0f  2t  ", left + tag("except", "psv; motorcar"))),
            skipped + "it is not for all cars at all times");
  EXPECT_EQ(reason(crossing_with("0f  2t  ", left + tag("except", "bicycle;psv"))), "taken: turn restriction, no_left_turn");
  EXPECT_EQ(reason(crossing_with("0f  2t  ", tag("restriction", "give_way"))), skipped + "its rule is not understood");
  EXPECT_EQ(reason(crossing_with("1f  2t  ", left)), skipped + "it runs against a one-way street");
  EXPECT_EQ(reason(crossing_with("0f  9t  ", left)), skipped + "its streets are not in the file, or none for driving");
  EXPECT_EQ(reason(crossing_with("0f  2t  1t  ", left)), skipped + "it does not have one from, one via and one to");
  EXPECT_EQ(reason(crossing_with("0f  3t  ", left, way(13, {2, 5, 8}, "highway=primary"))),
            skipped + "one of its streets passes its junction, so that its side is not known");
  EXPECT_EQ(reason(crossing_with("0f  3t  ", left, way(13, {2, 5, 8}, "highway=primary;oneway=yes"))),
            "taken: turn restriction, no_left_turn")
      << "one leaves a one-way street on one side only";
  const auto several = read_osm_context(crossing_with("0f  2f  1t  ", tag("restriction", "no_entry")));
  ASSERT_EQ(several->restrictions.size(), 2u);
  EXPECT_EQ(several->streets[several->restrictions[1].from].id, "w12/0");
}

TEST(OsmContext, FaultsOfElementsAreRowsNotErrors) {
  const auto context =
      read_osm_context(osm(way(10, {1, 5, 2, 4, 1}, "building=yes") + way(11, {1, 2, 5}, "building=yes") +
                           way(12, {1, 2, 99, 1}, "building=yes") + way(13, {1, 99, 5, 6}, "highway=road") +
                           way(14, {1, 2, 1, 2, 1}, "building=yes") + way(15, {1, 2, 5, 4, 1}, "building=yes;height=high")));
  ASSERT_TRUE(context.ok());
  EXPECT_EQ(reason_of(context->report, "w10"), "skipped: building: its outline crosses or touches itself");
  EXPECT_EQ(reason_of(context->report, "w11"), "skipped: building: its line is open");
  EXPECT_EQ(reason_of(context->report, "w12"), "skipped: building: corners are not in the file");
  EXPECT_EQ(reason_of(context->report, "w13"), "repaired: street");
  EXPECT_TRUE(reason_of(context->report, "w14").starts_with("skipped: building: its outline"));
  EXPECT_EQ(reason_of(context->report, "w15"), "repaired: building");
  EXPECT_EQ(context->report.total("way"), 6u);
}

TEST(OsmContext, TheRadiusAndTheFrameOfTheScene) {
  const std::string text = osm(way(10, {1, 2, 5, 4, 1}, "building=yes") + way(11, {5, 6, 9, 8, 5}, "building=yes"));
  ContextOptions options;
  options.origin = {{25.0, 60.0}};
  options.radius = 60;
  const auto near = read_osm_context(text, options);
  EXPECT_EQ(near->buildings.size(), 1u);
  EXPECT_EQ(reason_of(near->report, "w11"), "skipped: building: it lies beyond the radius");
  ContextOptions into;
  into.target = near->reference;
  const auto again = read_osm_context(text, into);
  EXPECT_EQ(again->buildings[0].outer, near->buildings[0].outer) << "the same place in the same frame";
  into.target = GeoReference{"EPSG:3067", 385000, 6650000, 0, 0, 0};  // the national grid of Finland
  const auto national = read_osm_context(text, into);
  ASSERT_TRUE(national.ok()) << national.error().text();
  EXPECT_NEAR(std::abs(area_of(national->buildings[0]) / area_of(near->buildings[0])), 1, 1e-3);
}

TEST(OsmContext, HostileInputIsAnErrorWithAPlace) {
  const std::string good = osm(way(10, {1, 2, 5, 4, 1}, "building=yes"));
  const std::string rows[] = {"",
                              "\n\n",
                              "noise \x01\x02\x03",
                              good.substr(0, good.size() / 2),
                              "<osm><way>",
                              "<html></html>",
                              "\x1f\x8b\x08 truncated",
                              "BZh91AY",
                              std::string("\0\0\0\x0d\x0a\x09OSMHeader\x18\x7f", 16),
                              R"(<osm version="0.6"></osm>)",
                              R"(<?xml version="1.0"?><!DOCTYPE a [<!ENTITY b "c">]><osm version="0.6"></osm>)",
                              R"(<osm version="0.6"><node id="1" lat="sixty" lon="25"/></osm>)"};
  for (const std::string& row : rows) {
    const auto context = read_osm_context(row);
    ASSERT_FALSE(context.ok()) << row;
    EXPECT_GT(context.error().message.size(), 20u) << row;
  }
  ContextOptions wrong;
  wrong.crs = "EPSG:28992";
  EXPECT_EQ(read_osm_context(good, wrong).error().place, "crs");
}

// Ten multiplied by itself two thousand times fits into no number; whatever it wrapped to was taken for a place.
TEST(OsmContext, CoordinatesWithLargeExponentsAreRefusedWithTheirLine) {
  for (const char* place : {"25E2001", "25e+10", "9999999999e9", "2&#53;", "1e19"}) {
    const auto context =
        read_osm_context("<osm version=\"0.6\">\n<node id=\"1\" lat='60' lon = '" + std::string(place) + "'/></osm>");
    ASSERT_FALSE(context.ok()) << place;
    EXPECT_EQ(context.error().text(),
              "line 2, column 30: `" + std::string(place) + "` is no coordinate in degrees: the file is damaged.");
  }
}

struct Extract {
  const char* file;
  std::size_t nodes, ways, relations;
  std::size_t streets, buildings, outlines,
      parts;  // ways with highway; with building, of which outlines of multipolygons; parts alone
  std::size_t restrictions;
  std::size_t made;  // buildings that came out
};

// By osmium 1.15: `osmium fileinfo -e FILE` for the first three, `osmium tags-filter -R -f opl FILE w/highway | grep -c ^w` (and
// w/building, w/building:part without building, r/type=restriction) for the others.
constexpr Extract kExtracts[] = {
    {"osm/helsinki_centre.osm.pbf", 24260, 5130, 620, 2650, 433, 2, 121, 45, 523},
    {"osm/lemans_centre.osm.gz", 6260, 892, 68, 204, 487, 0, 5, 9, 492},
    {"osm/lemans_centre.osm.pbf", 6260, 892, 68, 204, 487, 0, 5, 9, 492},
    {"osm/monaco.osm.gz", 13739, 1944, 77, 866, 962, 11, 0, 0, 966},
    {"osm/small_village.osm", 281, 56, 3, 19, 33, 0, 0, 0, 30},
};

TEST(OsmContext, RealExtractsAgreeWithAnIndependentReader) {
  for (const Extract& extract : kExtracts) {
    const std::string bytes = shared_bytes(extract.file);
    if (bytes.empty()) continue;
    const auto context = read_osm_context(bytes);
    ASSERT_TRUE(context.ok()) << extract.file << ": " << context.error().text();
    const ImportReport& report = context->report;
    EXPECT_EQ(report.total("node"), extract.nodes) << extract.file;
    EXPECT_EQ(report.total("way"), extract.ways) << extract.file;
    EXPECT_EQ(report.total("relation"), extract.relations) << extract.file;
    EXPECT_EQ(rows_of(report, "way", "street"), extract.streets) << extract.file;
    const std::size_t parts = rows_of(report, "way", "building part");
    EXPECT_EQ(rows_of(report, "way", "building") - parts, extract.buildings - extract.outlines) << extract.file;
    EXPECT_EQ(parts, extract.parts) << extract.file;
    EXPECT_EQ(rows_of(report, "relation", "turn restriction"), extract.restrictions) << extract.file;
    EXPECT_EQ(context->buildings.size(), extract.made) << extract.file;
    for (const ContextBuilding& building : context->buildings) {
      EXPECT_GT(building.height, 0) << building.id;
      EXPECT_GT(area_of(building), 0) << building.id;
    }
    for (const ContextStreet& street : context->streets) {
      EXPECT_GE(street.line.size(), 2u) << street.id;
      EXPECT_EQ(street.line.front(), context->junctions[street.start].position) << street.id;
      EXPECT_EQ(street.line.back(), context->junctions[street.end].position) << street.id;
    }
  }
}

TEST(OsmContext, TheSameExtractInTwoFormatsIsTheSame) {
  const std::string xml = shared_bytes("osm/lemans_centre.osm.gz"), pbf = shared_bytes("osm/lemans_centre.osm.pbf");
  if (xml.empty() || pbf.empty()) return;
  const auto a = read_osm_context(xml), b = read_osm_context(pbf);
  ASSERT_TRUE(a.ok() && b.ok());
  EXPECT_EQ(import_csv({{"f", a->report}}), import_csv({{"f", b->report}}));
  ASSERT_EQ(a->buildings.size(), b->buildings.size());
  for (std::size_t i = 0; i < a->buildings.size(); ++i) EXPECT_EQ(a->buildings[i].outer, b->buildings[i].outer);
}

// The corners of a house of 55.8 by 111.4 m and of parts of it, in the grid of nodes: 1 2 3 / 4 5 6 / 7 8 9.
TEST(OsmContext, PartsOverEachOtherCoverTheirGroundOnce) {
  const std::string whole = way(1, {1, 3, 6, 4, 1}, "building=yes;height=12");
  const std::string podium = way(2, {1, 2, 5, 4, 1}, "building:part=yes;height=6"),
                    tower = way(3, {1, 2, 5, 4, 1}, "building:part=yes;height=30"),
                    other = way(4, {2, 3, 6, 5, 2}, "building:part=yes;height=9");
  const auto half = read_osm_context(osm(whole + podium + tower));
  ASSERT_TRUE(half.ok());
  EXPECT_EQ(reason_of(half->report, "w1"), "taken: building") << "the parts leave half of it uncovered";
  ASSERT_EQ(half->buildings.size(), 2u) << "the building, and the tower above its roof";
  EXPECT_EQ(half->buildings[1].base, 12);
  EXPECT_EQ(half->buildings[1].height, 18);
  const auto all = read_osm_context(osm(whole + podium + tower + other));
  EXPECT_EQ(reason_of(all->report, "w1"), "taken: building, drawn by its parts");
  EXPECT_EQ(all->buildings.size(), 3u);
}

TEST(OsmContext, DeletedElementsAreRowsAndNothingElse) {
  const std::string text =
      R"(<?xml version="1.0"?><osm version="0.6">
    <node id="1" lat="52" lon="4.35"/><node id="2" lat="52" lon="4.3503"/><node id="3" lat="52.0002" lon="4.3503"/>
    <node id="4" lat="52.0002" lon="4.35"/><node id='5' action='delete' lat="52.1" lon="4.35"/>
    <way id="5" visible="false" version="3"><nd ref="1"/><nd ref="2"/><nd ref="3"/><nd ref="1"/><tag k="building" v="yes"/></way>
    <way id="6" action="delete"><nd ref="1"/><nd ref="2"/><nd ref="3"/><nd ref="1"/><tag k="building" v="yes"/></way>
    <way id="7" action="modify"><nd ref="1"/><nd ref="2"/><nd ref="3"/><nd ref="1"/><tag k="building" v="yes"/>
      <tag k="note" v="way id=9 action=&quot;delete&quot; action='delete'"/></way>
    <way id="8" version="1"><nd ref="1"/><nd ref="2"/><nd ref="3"/><nd ref="1"/><tag k="building" v="yes"/></way>
    <way id="8" version="2" visible="false"/>
    <relation id="3" action="delete"><member type="way" ref="7" role="outer"/><tag k="type" v="multipolygon"/></relation></osm>)";
  const auto context = read_osm_context(text);
  ASSERT_TRUE(context.ok()) << context.error().text();
  ASSERT_EQ(context->buildings.size(), 1u);
  EXPECT_EQ(context->buildings[0].id, "w7");
  for (const char* id : {"n5", "w5", "w6", "w8", "r3"})
    EXPECT_EQ(reason_of(context->report, id), "skipped: it is deleted in the file") << id;
  EXPECT_EQ(context->report.total("way"), 5u) << "both versions of way 8 have their row";
  EXPECT_EQ(context->report.total("node"), 5u);
}

TEST(OsmContext, ErrorsWithoutAPlaceNameNoLine) {
  const auto context =
      read_osm_context("<?xml version=\"1.0\"?><!DOCTYPE osm [<!ENTITY a \"b\">]><osm version=\"0.6\"><node id=\"1\"/></osm>");
  ASSERT_FALSE(context.ok());
  EXPECT_EQ(context.error().text(), "XML: This is not what OpenStreetMap files hold: XML entities are not supported.");
}

TEST(OsmContext, AWayThatIsListedTwiceIsOneOutline) {
  const auto context =
      read_osm_context(osm(way(1, {1, 2, 5, 4, 1}, "") +
                           R"(<relation id="3"><member type="way" ref="1" role="outer"/><member type="way" ref="1" role="outer"/>
          <tag k="type" v="multipolygon"/><tag k="building" v="yes"/></relation>)"));
  ASSERT_TRUE(context.ok());
  EXPECT_EQ(context->buildings.size(), 1u);
  EXPECT_EQ(reason_of(context->report, "r3"), "repaired: building");
}

TEST(OsmTags, TracksTakeGroundWhereTheyAreInUseAndNotBelowIt) {
  EXPECT_EQ(osm_rail({{"railway", "rail"}}), "rail");
  EXPECT_EQ(osm_rail({{"railway", "tram"}, {"tunnel", "no"}}), "tram");
  EXPECT_EQ(osm_rail({{"railway", "subway"}, {"tunnel", "yes"}}), "");
  EXPECT_EQ(osm_rail({{"railway", "abandoned"}}), "");
  EXPECT_EQ(osm_rail({{"railway", "platform"}}), "");
  EXPECT_EQ(osm_rail({}), "");
}

TEST(OsmTags, RoadsForFewAreNotDrivenThrough) {
  for (const char* value : {"agricultural", "forestry", "delivery", "customers"}) {
    const OsmRoad road = osm_road({{"highway", "track"}, {"motor_vehicle", value}});
    EXPECT_FALSE(road.for_cars) << value;
    EXPECT_TRUE(road.for_feet && road.for_cycles) << value;
  }
  EXPECT_FALSE(osm_road({{"highway", "service"}, {"access", "customers"}}).for_cars);
  EXPECT_TRUE(osm_road({{"highway", "service"}, {"access", "customers"}, {"motor_vehicle", "yes"}}).for_cars);
  EXPECT_TRUE(osm_road({{"highway", "residential"}, {"motor_vehicle", "destination"}}).for_cars);
}

}  // namespace
}  // namespace bl::importing
