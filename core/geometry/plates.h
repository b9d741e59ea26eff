// The plates of standing volumes as outlines, and the building that they make as a mesh.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "core/base/mesh.h"
#include "core/geometry/footprint.h"
#include "core/geometry/plan_ring.h"

namespace bl::geometry {

/// A closed line in plan of straight sides and arcs about the site of the volume.
struct PlateRing {
  static constexpr std::int32_t kPlot = -1, kFree = -2;
  struct Corner {
    Point3 at;                    ///< [m]; z is 0
    std::int32_t beyond = kFree;  ///< what the side that begins here borders on: a site, the border of the plot, or nothing
    bool is_arc = false;          ///< that side is an arc, counter-clockwise about the site
    bool operator==(const Corner&) const = default;
  };
  std::vector<Corner> corners;  ///< counter-clockwise; clockwise where it goes round a hole of the plot
  double radius = 0;            ///< of its arcs [m]
  bool operator==(const PlateRing&) const = default;
};

/// Equal storeys one upon another.
struct PlateStack {
  int storeys = 1;
  double bottom = 0, storey_height = 3;  ///< [m]
  double area = 0;                       ///< of one plate [m²]
  std::vector<PlateRing> outlines;       ///< of the footprint; several where the plot is not convex
  std::vector<PlateRing> courtyards;     ///< what is not built of it, where that does not reach an outer wall
  std::vector<PlateRing> enclosed = {};  ///< of a part of a plate with courtyards: its outlines with what it has of these
  double top() const { return bottom + storeys * storey_height; }
  bool operator==(const PlateStack&) const = default;
};

/// What a standing volume has become, from the ground up.
struct StandingBody {
  static constexpr std::string_view kMadeName = "a standing body";  ///< as nodes hand it on
  Point3 centre;                                                    ///< of all arcs [m]
  std::vector<PlateStack> stacks;
  bool operator==(const StandingBody&) const = default;
};

/// Its plates, exact; without those of runs that have no area. To be asked after an update.
StandingBody body_of(const FootprintDiagram& diagram, std::uint32_t site);
/// A connected part of a plate.
struct PlateFace {
  Ring outer;               ///< counter-clockwise
  std::vector<Ring> holes;  ///< clockwise
};
/// The area of parts without their holes, whichever way their rings turn [m²].
double area_of(std::span<const PlateFace> faces);
/// The parts of a plate, with arcs as chords that stay within `tolerance` of them [m].
std::vector<PlateFace> faces_of(const PlateStack& stack, const Point3& centre, double tolerance);
/// The centroid of the largest part; its first corner where it has no area.
Point3 middle_of(std::span<const PlateFace> faces);
/// The ring with its arcs as chords that stay within `tolerance` of them [m].
Ring chords_of(const PlateRing& ring, const Point3& centre, double tolerance);
/// One closed prism for each part of a plate of each stack.
Mesh mesh_of(const StandingBody& body, double tolerance);
/// How far its footprint stays inside a border [m], with arcs as chords within `tolerance`; negative where it reaches out of it,
/// by so much. Infinity without plates.
double clearance_of(const StandingBody& body, std::span<const Point3> border, double tolerance);
/// The place of its lowest plate, courtyards included, that is nearest to `position`: where it stands. Of places on its edge one
/// a millimetre inside, because the border of the plot may run there. At the height of its lowest floor; `position` itself
/// without plates. Arcs are chords within `tolerance`.
Point3 nearest_place(const StandingBody& body, const Point3& position, double tolerance);
/// Length of a ring's sides that border on a site (`beyond` from 0 on), on the plot or on nothing [m].
double length_of(const PlateRing& ring, const Point3& centre, std::int32_t beyond);

}  // namespace bl::geometry
