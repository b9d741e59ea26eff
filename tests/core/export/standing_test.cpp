// Standing volumes in exports: plates, courtyards and arcs keep their exact areas.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "core/export/facade_walls.h"
#include "core/export/format.h"
#include "core/export/option_text.h"
#include "core/export/read_proposal.h"
#include "core/export/section.h"
#include "core/export/solids.h"
#include "core/geometry/domain_makers.h"
#include "core/geometry/footprint.h"
#include "tests/core/export/two_houses.h"

namespace bl::exporting {
namespace {

struct Standing {
  Proposal proposal;
  double floor_area = 0;  // of all plates, as measured [m²]
};

// Discs with a courtyard and a set-back, one of them alone, and a block beside them.
Standing standing_proposal() {
  const std::vector<Point3> plot = {{-40, -30, 0}, {60, -30, 0}, {60, 30, 0}, {-40, 30, 0}};
  const auto domain = geometry::extrude_plan(plot, {}, 0, 40);
  geometry::FootprintDiagram diagram;
  EXPECT_TRUE(diagram.set_domain(*domain));
  std::vector<geometry::StandingSite> sites(3);
  sites[0].site = {{-12, 0, 0}, 300};
  sites[0].runs = {{3, 0}, {2, 2}};
  sites[0].depth = 6;
  sites[1].site = {{8, 3, 0}, 250};
  sites[1].form = geometry::FootprintForm::block;
  sites[1].runs = {{4, 0}};
  sites[2].site = {{45, 0, 0}, 100};
  sites[2].runs = {{2, 0}};
  const auto measured = diagram.update(sites);
  EXPECT_TRUE(measured);
  Standing made;
  for (std::uint32_t k = 0; k < sites.size(); ++k) {
    Building building;
    building.id = building.label = "house_" + std::to_string(k);
    building.use = "housing";
    stand(geometry::body_of(diagram, k), building);
    building.floor_area = (*measured)[k].floor_area;
    building.bottom = building.storeys.front().bottom;
    building.top = building.storeys.back().top;
    made.floor_area += building.floor_area;
    made.proposal.buildings.push_back(std::move(building));
  }
  made.proposal.levels = 5;
  made.proposal.hash = "0123456789abcdef";
  return made;
}

// Of closed lines with bulges, as other programs measure them: polygon and segments of circles.
double measured_in_dxf(const std::string& text) {
  std::istringstream lines(text);
  std::string code, value, entity, layer;
  std::vector<std::array<double, 3>> corners;
  double sum = 0;
  const auto close = [&] {
    if (entity == "LWPOLYLINE" && layer.starts_with("L0"))
      for (std::size_t k = 0; k < corners.size(); ++k) {
        const auto &a = corners[k], &b = corners[(k + 1) % corners.size()];
        sum += (a[0] * b[1] - b[0] * a[1]) / 2;
        if (a[2] == 0) continue;
        const double angle = 4 * std::atan(a[2]), chord = std::hypot(b[0] - a[0], b[1] - a[1]);
        const double radius = chord / (2 * std::sin(angle / 2));
        sum += radius * radius * (angle - std::sin(angle)) / 2;
      }
    corners.clear();
  };
  while (std::getline(lines, code) && std::getline(lines, value)) {
    const int number = std::stoi(code);
    if (number == 0) close(), entity = value;
    else if (number == 8) layer = value;
    else if (entity == "LWPOLYLINE" && number == 10) corners.push_back({std::stod(value), 0, 0});
    else if (entity == "LWPOLYLINE" && number == 20) corners.back()[1] = std::stod(value);
    else if (entity == "LWPOLYLINE" && number == 42) corners.back()[2] = std::stod(value);
  }
  return sum;
}

TEST(StandingExport, StoreysAreThePlates) {
  const Standing made = standing_proposal();
  for (const Building& building : made.proposal.buildings) {
    EXPECT_TRUE(building.is_standing);
    double sum = 0;
    for (const Storey& storey : building.storeys) sum += storey.floor_area;
    EXPECT_NEAR(sum, building.floor_area, 1e-9 * sum);
    EXPECT_TRUE(is_closed(*building.mesh));
  }
  EXPECT_EQ(made.proposal.buildings[0].storeys.size(), 5u);
  EXPECT_FALSE(made.proposal.buildings[0].storeys[0].courtyards.empty());
  EXPECT_EQ(made.proposal.buildings[2].storeys[0].rings.front().corners.size(), 1u);
}

TEST(StandingExport, ADrawingHasTheirExactAreas) {
  const Standing made = standing_proposal();
  const FormatDefinition* format = find_format("dxf");
  ASSERT_NE(format, nullptr);
  const auto files = format->write(made.proposal, *option_values(*format, {}), false);
  ASSERT_TRUE(files);
  EXPECT_NEAR(measured_in_dxf(files->files.front().content), made.floor_area, 1e-9 * made.floor_area);
}

double area_of_ring(const geometry::Ring& ring) { return std::abs(geometry::signed_area(ring)); }

// By hand: along y = 0 the block has the whole of one side, in four storeys, and there is air above the disc's set-back.
TEST(Section, StandingVolumesAreCutAsRectangles) {
  const Standing made = standing_proposal();
  const auto line = section_line(made.proposal, "-40,0,60,0");
  ASSERT_TRUE(line);
  const Section section = section_of(made.proposal, *line, true);
  ASSERT_EQ(section.parts.size(), 3u);
  for (const SectionPart& part : section.parts) {
    ASSERT_NE(part.building, nullptr);
    EXPECT_EQ(part.slabs.size(), 2 * part.cut.size());
    // A cut through the middle is as long as the plate is wide there; with a courtyard it is in two parts.
    const bool has_courtyard = part.building->id == "house_0";
    EXPECT_EQ(part.cut.size(), part.building->storeys.size() * (has_courtyard ? 2 : 1)) << part.building->id;
    if (part.building->id != "house_2") continue;
    ASSERT_EQ(part.cut.size(), 2u);
    EXPECT_NEAR(area_of_ring(part.cut.front()), 20 * 3, 1e-2);  // a disc of 10 m, and a storey of 3 m
    EXPECT_EQ(part.distance, 0);
  }
  ASSERT_GE(section.heights.size(), 6u);
  EXPECT_EQ(section.heights.front(), 0);
  EXPECT_EQ(section.heights[1], 3);
  // A line that passes all of them by sees them behind it, the nearest last.
  const Section outside = section_of(made.proposal, *section_line(made.proposal, "-40 -29 60 -29"), true);
  ASSERT_EQ(outside.parts.size(), 3u);
  for (const SectionPart& part : outside.parts) {
    EXPECT_TRUE(part.cut.empty());
    EXPECT_FALSE(part.beyond.empty());
  }
  EXPECT_GE(outside.parts.front().distance, outside.parts.back().distance);
}

// By itself a section goes through the highest volume, wherever that stands.
TEST(Section, ByItselfItCutsTheHighestVolume) {
  Standing made = standing_proposal();
  for (Building& building : made.proposal.buildings) {
    const double top = building.top;
    building.top = 200;
    const auto line = section_line(made.proposal, "");
    ASSERT_TRUE(line);
    const Section section = section_of(made.proposal, *line, true);
    EXPECT_TRUE(std::any_of(section.parts.begin(), section.parts.end(), [&](const SectionPart& part) {
      return part.building == &building && !part.cut.empty();
    })) << building.id;
    building.top = top;
  }
}

TEST(Section, LinesThatAreNoneAreRefused) {
  const Standing made = standing_proposal();
  for (const char* text : {"1,2,3", "1,2,3,4,5", "a,b,c,d", "1,1,1,1", "nan 0 1 1", "1,2,3,1e300"}) {
    const auto line = section_line(made.proposal, text);
    ASSERT_FALSE(line) << text;
    EXPECT_NE(line.error().message.find("X1,Y1,X2,Y2"), std::string::npos) << line.error().message;
  }
  EXPECT_TRUE(section_line(made.proposal, ""));
}

// By hand: the disc of 10 m has two storeys of 3 m, so a plane at 4.5 m cuts the upper one, and one at 7 m passes over it.
TEST(Section, ALevelCutHasThePlatesAtItsHeight) {
  const Standing made = standing_proposal();
  EXPECT_FALSE(level_cut("1,2,3,4"));
  EXPECT_FALSE(level_cut("auto"));
  EXPECT_FALSE(level_cut("1e300"));
  ASSERT_EQ(level_cut("-4.5"), -4.5);
  const auto disc = std::find_if(made.proposal.buildings.begin(), made.proposal.buildings.end(),
                                 [](const Building& building) { return building.id == "house_2"; });
  ASSERT_NE(disc, made.proposal.buildings.end());
  const LevelPart upper = level_part(*disc, 4.5), above = level_part(*disc, 7);
  ASSERT_NE(upper.storey, nullptr);
  EXPECT_EQ(upper.storey->number, 1);
  EXPECT_NEAR(area_of(upper.faces), upper.storey->floor_area, 0.1);  // chords
  EXPECT_EQ(above.storey, nullptr);
  EXPECT_TRUE(above.faces.empty());
  for (const char* id : {"svg", "pdf", "dxf"}) {
    const FormatDefinition* format = find_format(id);
    ASSERT_NE(format, nullptr) << id;
    const auto options = option_values(*format, {"section=4.5", "level=-1"});
    ASSERT_TRUE(options) << options.error().text();
    const auto files = format->write(made.proposal, *options, false);
    ASSERT_TRUE(files) << id << ": " << files.error().text();
    if (std::string(id) == "pdf") continue;  // its text is packed
    EXPECT_NE(files->files.front().content.find("Level cut at +4.50 m"), std::string::npos) << id;
  }
}

// By hand: a ball of 11 m under storeys of 3.2 m has three, and a cap of 1.4 m that belongs to the third.
TEST(Section, ALevelCutGoesThroughTheCapOfARoundedVolume) {
  World world = World::from_text(R"({"format": "behaviourlinks", "version": 1, "settings": {}, "nodes": [
      {"id": "site", "types": {"boundary": {"form": "plan", "plan": [[-30, -20, 0], [30, -20, 0], [30, 20, 0], [-30, 20, 0]], "height": 30}}},
      {"id": "solver", "types": {"smart_volumes_solver": {}}},
      {"id": "ball", "position": [0, 0, 10], "types": {"smart_volume": {"demand": 696.9, "storey_height": 3.2}}}]})");
  ASSERT_TRUE(world.settle());
  const Proposal proposal = proposal_of(world);
  const Building& ball = proposal.buildings.front();
  ASSERT_EQ(ball.storeys.size(), 3u);
  ASSERT_NEAR(ball.top - ball.storeys.back().top, 1.4, 0.05);
  const double height = ball.top - 0.7;
  const LevelPart cap = level_part(ball, height);
  EXPECT_EQ(cap.storey, &ball.storeys.back());
  // The mesh lies within the ball, whose circle has 22.7 m² there.
  EXPECT_GT(area_of(cap.faces), 15);
  EXPECT_LT(area_of(cap.faces), 23);
  EXPECT_TRUE(level_part(ball, ball.top + 0.01).faces.empty());
  EXPECT_TRUE(level_part(ball, ball.bottom - 0.01).faces.empty());
  const std::string sheet = file_of(proposal, "svg", {"section=" + std::to_string(height), "level=-1"});
  EXPECT_NE(sheet.find("use_"), std::string::npos);
}

// Walls lie within the plate, side by side: together they are what is lost when the plate is moved in by their thickness.
TEST(FacadeWalls, GoRoundTheStoreyAndItsCourtyard) {
  const Standing made = standing_proposal();
  constexpr double kThick = 0.25;
  for (const Building& building : made.proposal.buildings) {
    const Storey& storey = building.storeys.front();
    double around = 0, along = 0, covered = 0;
    for (const auto* rings : {&storey.rings, &storey.courtyards})
      for (const geometry::PlateRing& ring : *rings)
        for (const std::int32_t beyond : {geometry::PlateRing::kFree, geometry::PlateRing::kPlot, 0, 1, 2})
          around += geometry::length_of(ring, building.arc_centre, beyond);
    for (const FacadeWall& wall : facade_walls(storey, building.arc_centre, kThick)) {
      EXPECT_GT(geometry::signed_area(wall.outline), 0);
      EXPECT_FALSE(geometry::find_self_crossing(wall.outline)) << building.id;
      along += wall.length;
      covered += geometry::signed_area(wall.outline);
    }
    EXPECT_NEAR(along, around, 1e-6) << building.id;
    EXPECT_NEAR(covered, around * kThick, 0.03 * around * kThick) << building.id;
  }
  const auto round = facade_walls(made.proposal.buildings[2].storeys.front(), made.proposal.buildings[2].arc_centre, kThick);
  double covered = 0;
  for (const FacadeWall& wall : round) covered += geometry::signed_area(wall.outline);
  EXPECT_NEAR(covered, 3.14159265358979 * (100 - (10 - kThick) * (10 - kThick)), 0.02);
}

// What lies within 3 m of a square of 4 m, as distances from corners are cut: arcs in chords between the sides.
geometry::PlateRing ring_with_chords(int chords) {
  geometry::PlateRing ring;
  const double quarter = std::acos(0.0);
  for (int corner = 0; corner < 4; ++corner)
    for (int k = 0; k <= chords; ++k) {
      const double angle = quarter * (corner + static_cast<double>(k) / chords);
      const double x = corner == 0 || corner == 3 ? 2 : -2, y = corner < 2 ? 2 : -2;
      ring.corners.push_back({{x + 3 * std::cos(angle), y + 3 * std::sin(angle), 0}, geometry::PlateRing::kPlot, false});
    }
  return ring;
}

TEST(FacadeWalls, ChordsOfACurveHaveOneWallTogether) {
  constexpr double kThick = 0.3;
  for (const bool is_courtyard : {false, true}) {
    Storey storey;
    const geometry::PlateRing ring = ring_with_chords(96);
    (is_courtyard ? storey.courtyards : storey.rings).push_back(ring);
    const std::vector<FacadeWall> walls = facade_walls(storey, {}, kThick);
    EXPECT_EQ(walls.size(), 8u) << "four sides and four curves: there were 388";
    // In mitres, walls together are the perimeter times the thickness, less the square of it and the tangent of half of each
    // turn.
    double around = 0, mitres = 0, along = 0, covered = 0;
    const std::size_t count = ring.corners.size();
    for (std::size_t k = 0; k < count; ++k) {
      const Point3 &a = ring.corners[k].at, &b = ring.corners[(k + 1) % count].at, &c = ring.corners[(k + 2) % count].at;
      around += distance(a, b);
      const Vector3 u = (b - a) / distance(a, b), v = (c - b) / distance(b, c);
      mitres += std::tan(std::atan2(u.x * v.y - u.y * v.x, dot(u, v)) / 2);
    }
    for (const FacadeWall& wall : walls) {
      EXPECT_GT(geometry::signed_area(wall.outline), 0);
      EXPECT_FALSE(geometry::find_self_crossing(wall.outline));
      along += wall.length;
      covered += geometry::signed_area(wall.outline);
    }
    EXPECT_NEAR(along, around, 1e-9);
    EXPECT_NEAR(covered, around * kThick - (is_courtyard ? -1 : 1) * kThick * kThick * mitres, 1e-9);
  }
}

// A tree in the middle of a house: its wall is a circle of chords, and does not touch itself.
TEST(FacadeWalls, AWholeCircleOfChordsHasSeveralWalls) {
  Storey storey;
  geometry::PlateRing& hole = storey.rings.emplace_back();
  double around = 0;
  for (int k = 0; k < 64; ++k) {
    const double angle = -k * std::acos(0.0) / 16;
    hole.corners.push_back({{2 * std::cos(angle), 2 * std::sin(angle), 0}, geometry::PlateRing::kPlot, false});
  }
  for (std::size_t k = 0; k < 64; ++k) around += distance(hole.corners[k].at, hole.corners[(k + 1) % 64].at);
  const std::vector<FacadeWall> walls = facade_walls(storey, {}, 0.3);
  EXPECT_EQ(walls.size(), 3u);
  double along = 0;
  for (const FacadeWall& wall : walls) {
    EXPECT_FALSE(geometry::find_self_crossing(wall.outline));
    along += wall.length;
  }
  EXPECT_NEAR(along, around, 1e-9);
}

}  // namespace
}  // namespace bl::exporting
