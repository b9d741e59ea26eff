// Outlines and meshes of standing volumes, against their measures and the rules that make them.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/geometry/plates.h"
#include "tests/core/geometry/geometry_support.h"
#include "tests/core/geometry/standing_zoo.h"

namespace bl::test {
namespace {

using geometry::FootprintForm;
using geometry::PlateRing;
using geometry::StandingSite;

// Counter-clockwise from one end of an arc to the other; a whole turn where they are the same.
double turn_of(const Point3& from, const Point3& to, const Point3& centre) {
  const double angle = std::atan2(to.y - centre.y, to.x - centre.x) - std::atan2(from.y - centre.y, from.x - centre.x);
  return angle > 1e-15 ? angle : angle + 2 * kUnitDisc;
}

// The area inside a ring: its polygon, and the segments between its chords and arcs.
double area_of(const PlateRing& ring, const Point3& centre) {
  double twice = 0;
  for (std::size_t k = 0; k < ring.corners.size(); ++k) {
    const Point3 &a = ring.corners[k].at, &b = ring.corners[(k + 1) % ring.corners.size()].at;
    twice += (a.x - centre.x) * (b.y - centre.y) - (b.x - centre.x) * (a.y - centre.y);
    if (!ring.corners[k].is_arc) continue;
    const double angle = turn_of(a, b, centre);
    twice += ring.radius * ring.radius * (angle - std::sin(angle));
  }
  return 0.5 * twice;
}

double area_of(const std::vector<PlateRing>& rings, const Point3& centre) {
  double sum = 0;
  for (const PlateRing& ring : rings) sum += area_of(ring, centre);
  return sum;
}

// Corners, and places halfway along the sides.
std::vector<Point3> places_on(const PlateRing& ring, const Point3& centre) {
  std::vector<Point3> places;
  for (std::size_t k = 0; k < ring.corners.size(); ++k) {
    const Point3 &a = ring.corners[k].at, &b = ring.corners[(k + 1) % ring.corners.size()].at;
    places.push_back(a);
    places.push_back({0.5 * (a.x + b.x), 0.5 * (a.y + b.y), 0});
    if (!ring.corners[k].is_arc) continue;
    const double start = std::atan2(a.y - centre.y, a.x - centre.x), half = 0.5 * turn_of(a, b, centre);
    places.back() = {centre.x + ring.radius * std::cos(start + half), centre.y + ring.radius * std::sin(start + half), 0};
  }
  return places;
}

double volume_of(const Mesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) sum += dot(mesh.vertices[a], cross(mesh.vertices[b], mesh.vertices[c])) / 6;
  return sum;
}

struct Made {
  geometry::Domain plot;
  std::vector<StandingSite> sites;
  geometry::FootprintDiagram diagram;
};

template <class See>
void for_random_sets(See&& see) {
  for (const PlotShape shape : kPlotShapes)
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      Made made{plot_of(shape), random_standing(18, seed), {}};
      ASSERT_TRUE(made.diagram.set_domain(made.plot));
      ASSERT_TRUE(made.diagram.update(made.sites));
      SCOPED_TRACE("plot " + std::to_string(static_cast<int>(shape)) + ", seed " + std::to_string(seed));
      see(made);
    }
}

TEST(Plates, ADiscHasOneArcAndItsCourtyardAnother) {
  geometry::FootprintDiagram diagram;
  StandingSite site;
  site.site = {{40, 40, 2}, 100};
  site.runs = {{2, 0}, {1, 3}};
  site.depth = 5;
  ASSERT_TRUE(diagram.set_domain(plot_of(PlotShape::square)));
  ASSERT_TRUE(diagram.update(std::vector{site}));
  const geometry::StandingBody body = body_of(diagram, 0);
  ASSERT_EQ(body.stacks.size(), 2u);
  EXPECT_EQ(body.stacks[0].bottom, 2);
  EXPECT_EQ(body.stacks[1].bottom, 8);
  EXPECT_EQ(body.stacks[1].top(), 11);
  for (std::size_t r = 0; r < 2; ++r) {
    ASSERT_EQ(body.stacks[r].outlines.size(), 1u);
    EXPECT_EQ(body.stacks[r].outlines[0].corners.size(), 1u);
    ASSERT_EQ(body.stacks[r].courtyards.size(), 1u);
    const double radius = r == 0 ? 10 : 7;
    EXPECT_NEAR(length_of(body.stacks[r].outlines[0], body.centre, PlateRing::kFree), 2 * kUnitDisc * radius, 1e-12);
    EXPECT_NEAR(length_of(body.stacks[r].courtyards[0], body.centre, PlateRing::kFree), 2 * kUnitDisc * (radius - 5), 1e-12);
  }
}

// Wings of 5 m along the wall that touches, and a courtyard that is moved out by as much: it reaches the neighbour, so the plate
// is a U of 40 by 80 m less 35 by 70 m.
TEST(Plates, ACourtyardThatReachesAnOuterWallOpensThePlate) {
  geometry::FootprintDiagram diagram;
  std::vector<StandingSite> sites(2);
  sites[0].site = {{20, 40, 0}, 100};
  sites[1].site = {{60, 40, 0}, 100};
  for (StandingSite& site : sites) {
    site.form = FootprintForm::cell;
    site.runs = {{1, 0}, {2, 0, 5}};
    site.depth = 10;
    site.wing_depth = 5;
    site.has_party_walls = true;
  }
  ASSERT_TRUE(diagram.set_domain(plot_of(PlotShape::square)));
  ASSERT_TRUE(diagram.update(sites));
  const geometry::StandingBody body = body_of(diagram, 0);
  ASSERT_EQ(body.stacks.size(), 2u);
  EXPECT_EQ(body.stacks[0].courtyards.size(), 1u) << "on the ground there are wings";
  const geometry::PlateStack& open = body.stacks[1];
  EXPECT_NEAR(open.area, 40 * 80 - 35 * 70, 1e-9);
  EXPECT_TRUE(open.courtyards.empty());
  ASSERT_EQ(open.outlines.size(), 1u);
  EXPECT_EQ(open.outlines[0].corners.size(), 8u);
  EXPECT_NEAR(area_of(open.outlines, body.centre), open.area, 1e-5);
  EXPECT_NEAR(length_of(open.outlines[0], body.centre, 1), 2 * 5, 1e-6) << "two ends touch the neighbour";
  EXPECT_NEAR(length_of(open.outlines[0], body.centre, PlateRing::kPlot), 80 + 2 * 40, 1e-6);
  EXPECT_NEAR(length_of(open.outlines[0], body.centre, PlateRing::kFree), 70 + 2 * 35, 1e-6) << "the courtyard's walls";
  const auto faces = faces_of(open, body.centre, 1e-3);
  ASSERT_EQ(faces.size(), 1u);
  EXPECT_TRUE(geometry::extrude_plan(faces[0].outer, faces[0].holes, open.bottom, open.top())) << "others can stand on it";
  EXPECT_NEAR(volume_of(mesh_of(body, 1e-3)), 3 * (body.stacks[0].area + 2 * open.area), 1e-3);
}

TEST(Plates, SidesKnowWhatIsBeyondThem) {
  geometry::FootprintDiagram diagram;
  std::vector<StandingSite> sites(2);
  sites[0].site = {{10, 3, 0}, 25};
  sites[1].site = {{16, 3, 0}, 25};
  for (StandingSite& site : sites) site.runs = {{1, 0}};
  ASSERT_TRUE(diagram.set_domain(plot_of(PlotShape::square)));
  ASSERT_TRUE(diagram.update(sites));
  const geometry::StandingBody body = body_of(diagram, 0);
  const PlateRing& ring = body.stacks.at(0).outlines.at(0);
  EXPECT_NEAR(length_of(ring, body.centre, 1), 3 + 4, 1e-12) << "from the border up to where both circles meet";
  EXPECT_NEAR(length_of(ring, body.centre, PlateRing::kPlot), 3 + 4, 1e-12);
  const double arc = 2 * kUnitDisc - (kUnitDisc / 2 + 2 * std::acos(0.6));
  EXPECT_NEAR(length_of(ring, body.centre, PlateRing::kFree), 5 * arc, 1e-11);
}

TEST(PlatesLaws, OutlinesEncloseTheAreas) {
  for_random_sets([](const Made& made) {
    for (std::uint32_t i = 0; i < made.sites.size(); ++i) {
      const geometry::StandingBody body = body_of(made.diagram, i);
      std::size_t run = 0;
      for (const geometry::PlateStack& stack : body.stacks) {
        while (!(made.diagram.footprints()[i].plates[run] > 0)) ++run;
        const double plate = made.diagram.footprints()[i].plates[run++];
        EXPECT_EQ(stack.area, plate);
        const double found = area_of(stack.outlines, body.centre) - area_of(stack.courtyards, body.centre);
        // Of plots that are not convex, pieces meet on a grid of ten nanometres.
        EXPECT_NEAR(found, plate, 1e-9 * plate + (made.plot.is_convex() ? 1e-9 : 1e-4)) << "site " << i;
      }
    }
  });
}

TEST(PlatesLaws, PlatesStayInPlotCellAndForm) {
  std::size_t places = 0;
  for_random_sets([&](const Made& made) {
    for (std::uint32_t i = 0; i < made.sites.size(); ++i) {
      const StandingSite& own = made.sites[i];
      const geometry::StandingBody body = body_of(made.diagram, i);
      for (const geometry::PlateStack& stack : body.stacks)
        for (const PlateRing& ring : stack.outlines)
          for (Point3 at : places_on(ring, body.centre)) {
            ++places;
            const auto power = [&](const StandingSite& s) {
              const double x = at.x - s.site.position.x, y = at.y - s.site.position.y;
              return x * x + y * y - s.site.weight;
            };
            // In its own cell: two plates of one storey then have no place in common but walls.
            for (const StandingSite& other : made.sites) EXPECT_LE(power(own), power(other) + 1e-6);
            if (own.form == FootprintForm::round) { EXPECT_LE(power(own), 1e-8); }
            at.z = 1;
            EXPECT_TRUE(made.plot.contains(at, 1e-5)) << "site " << i << " at " << at.x << ", " << at.y;
          }
    }
  });
  EXPECT_GT(places, 2000u);
}

TEST(PlatesLaws, MeshesAreClosedAndEncloseTheVolume) {
  for_random_sets([](const Made& made) {
    for (std::uint32_t i = 0; i < made.sites.size(); ++i) {
      const geometry::StandingBody body = body_of(made.diagram, i);
      const Mesh mesh = mesh_of(body, 1e-3);
      EXPECT_TRUE(is_closed(mesh)) << "site " << i;
      double chords = 0;
      for (const geometry::PlateStack& stack : body.stacks)
        for (const geometry::PlateFace& face : faces_of(stack, body.centre, 1e-3)) {
          chords += geometry::signed_area(face.outer) * (stack.top() - stack.bottom);
          for (const geometry::Ring& hole : face.holes) {
            EXPECT_LT(geometry::signed_area(hole), 0);
            chords += geometry::signed_area(hole) * (stack.top() - stack.bottom);
          }
        }
      const double volume = made.diagram.footprints()[i].volume;
      EXPECT_NEAR(volume_of(mesh), chords, 1e-6 * (1 + volume));
      // A chord is at most a millimetre off its arc: that much of the sides of all storeys.
      EXPECT_NEAR(volume_of(mesh), volume, 5e-3 * volume + 1e-2) << "site " << i;
    }
  });
}

// A square of 10 m with a hole in it: inside, beyond a side, beyond a corner, in the hole.
TEST(Plates, TheNearestPlaceIsWhereItStands) {
  geometry::StandingBody body;
  body.stacks.push_back({2, 4, 3, 96, {}, {}});
  body.stacks.back().outlines = {{{{{0, 0, 0}}, {{10, 0, 0}}, {{10, 10, 0}}, {{0, 10, 0}}}, 0},
                                 {{{{4, 4, 0}}, {{4, 6, 0}}, {{6, 6, 0}}, {{6, 4, 0}}}, 0}};
  const auto near = [&](double x, double y) { return geometry::nearest_place(body, {x, y, 50}, 1e-3); };
  EXPECT_EQ(near(2, 3), (Point3{2, 3, 4}));
  EXPECT_LT(distance(near(-5, 3), {0.001, 3, 4}), 1e-9);
  EXPECT_LT(distance(near(12, 11), {10 - 0.001 / std::sqrt(2), 10 - 0.001 / std::sqrt(2), 4}), 1e-9);
  EXPECT_LT(distance(near(4.5, 5), {3.999, 5, 4}), 1e-9) << "a hole is none of it";
  EXPECT_EQ(geometry::nearest_place({}, {1, 2, 3}, 1e-3), (Point3{1, 2, 3}));
}

}  // namespace
}  // namespace bl::test
