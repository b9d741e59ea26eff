// Draws one volume: shaded faces, storey lines, creases and its outline.
#pragma once

#include <string>
#include <vector>

#include "core/base/mesh.h"
#include "core/drawing/markup.h"
#include "core/drawing/palette.h"
#include "core/drawing/projection.h"
#include "core/geometry/mesh_lines.h"
#include "core/reading/exact_shape.h"
#include "core/reading/report_model.h"

namespace bl::drawing {

/// Points of a line on the sheet, simplified.
std::vector<Pixel> on_sheet(const Sheet& sheet, const geometry::Polyline& line);

struct SolidStyle {
  Colour colour;
  Vector3 to_sun;              ///< unit vector
  double storey_height = 0;    ///< [m]; 0: no storey lines
  double bottom = 0, top = 0;  ///< [m], what the storeys are counted between
};

/// Daylight on a surface, 0 to 1: a soft part from the sky and a hard one from the sun.
double light_on(const Vector3& normal, const Vector3& to_sun);
/// The normal that gets most of it.
Vector3 brightest_normal(const Vector3& to_sun);
/// The colour under that light, as "#rrggbb".
std::string shaded(const Colour& colour, double light);

/// The shades of a ball of one colour, to be referred to by `draw_ball`.
std::string define_ball(Markup& svg, const View& view, const SolidStyle& style, const std::string& id);
/// A ball cut by planes, smooth at any size. `stops`: id of the shades; `id`: a name of its own.
void draw_ball(Markup& svg, const Sheet& sheet, const reading::ExactShape& shape, const SolidStyle& style,
               const std::string& stops, const std::string& id);

/// Into a group that the caller has opened. Meant for bodies that are nearly convex; others are drawn face by face.
void draw_solid(Markup& svg, const Sheet& sheet, const Mesh& mesh, const SolidStyle& style);

/// The same line with fewer points: none that lies on the line between its neighbours.
std::vector<Pixel> simplified(const std::vector<Pixel>& line, bool is_closed);
/// Convex hull of places, without those that lie on its sides.
std::vector<Pixel> convex_outline(std::vector<Pixel> places);
/// The outline of convex polygons that stand side by side, without what two of them have in common.
std::vector<std::vector<Pixel>> common_outline(const std::vector<std::vector<Pixel>>& pieces);
/// Convex outline of a mesh on the sheet.
std::vector<Pixel> convex_outline(const Sheet& sheet, const Mesh& mesh);
/// The same of a volume, from its exact shape where that is known.
std::vector<Pixel> convex_outline(const Sheet& sheet, const reading::VolumeRow& volume);
/// Is the place inside a convex outline?
bool is_inside(const std::vector<Pixel>& outline, Pixel place);

}  // namespace bl::drawing
