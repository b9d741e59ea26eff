// Draws one volume: shaded faces, storey lines, creases and its outline.
#pragma once

#include <vector>

#include "core/base/mesh.h"
#include "ui/cli/report/markup.h"
#include "ui/cli/report/mesh_lines.h"
#include "ui/cli/report/palette.h"
#include "ui/cli/report/projection.h"

namespace bl::report {

/// Points of a mesh line on the sheet, without those that lie on the line between their neighbours.
std::vector<Pixel> on_sheet(const Sheet& sheet, const Polyline& line);

struct SolidStyle {
  Colour colour;
  Vector3 to_sun;             ///< unit vector
  double storey_height = 0;   ///< [m]; 0: no storey lines
};

/// Into a group that the caller has opened. Meant for bodies that are nearly convex; others are drawn face by face.
void draw_solid(Markup& svg, const Sheet& sheet, const Mesh& mesh, const SolidStyle& style);

/// Convex hull of places, without those that lie on its sides.
std::vector<Pixel> convex_outline(std::vector<Pixel> places);
/// Convex outline of a mesh on the sheet.
std::vector<Pixel> convex_outline(const Sheet& sheet, const Mesh& mesh);
/// Is the place inside a convex outline?
bool is_inside(const std::vector<Pixel>& outline, Pixel place);

}  // namespace bl::report
