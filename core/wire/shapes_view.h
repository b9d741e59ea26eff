// The scene in three dimensions for pages: one key for each thing that is seen, so that only changed shapes are sent again.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "core/define/value.h"
#include "core/graph/state.h"
#include "core/wire/message_builder.h"

namespace bl::wire {

// What the keys hold; `t` names the kind. All lengths but the origin are whole centimetres from the origin, z upwards, y to the
// north: a change below half a centimetre is not sent.

/// The key `space`: what all others stand in.
struct SpaceContent {
  Point3 origin;          ///< [m]
  double true_north = 0;  ///< [degrees]
  double ground = 0;      ///< height of the ground where no terrain is known [cm]
  bool is_coarse = false;
  std::int64_t left_out = 0;
  static void declare(MessageBuilder<SpaceContent>& m);
};
/// A volume as its cell and its ball: the page divides the faces and wraps them, as windows do (core/geometry/tessellate).
struct CellContent {
  Numbers ball, points, faces, parts, seams;
  double bottom = 0, storey = 0;
  static void declare(MessageBuilder<CellContent>& m);
};
/// A volume as an upright body over its outline, where there are many.
struct PrismContent {
  Numbers ring;
  double low = 0, high = 0;
  static void declare(MessageBuilder<PrismContent>& m);
};
/// Triangles as they are: buildings, and volumes that no ball shapes.
struct SurfaceContent {
  Numbers points, triangles;
  double bottom = 0, storey = 0;
  static void declare(MessageBuilder<SurfaceContent>& m);
};
/// A street, or the outlines of a plot or a boundary.
struct LinesContent {
  Numbers points, counts;
  bool is_closed = false;
  double width = 0;
  static void declare(MessageBuilder<LinesContent>& m);
};
/// The ground as heights on a grid.
struct TerrainContent {
  Numbers grid, heights;
  static void declare(MessageBuilder<TerrainContent>& m);
};

/// The kinds of contents, for the schema.
std::vector<const MessageDefinition*> shape_kinds();

/// Up to so many volumes are shown as what they are; more as upright bodies.
inline constexpr std::size_t kMostCells = 150;
/// All contents together stay below this: the smallest volumes are left out, and `left_out` counts them [bytes].
inline constexpr std::size_t kMostShapeBytes = 240 << 10;

/// `space`, `n/ID` with the keys of the view `plan`, and `terrain/N`.
std::map<std::string, std::string> shapes_view(const State& state, std::size_t most_bytes = kMostShapeBytes);

}  // namespace bl::wire
