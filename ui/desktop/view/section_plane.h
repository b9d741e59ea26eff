// The plane that cuts the model open: level or upright, in the numbers that people say, as a frame in the picture and as text.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "ui/desktop/view/scene_facts.h"
#include "ui/desktop/view/view_scene.h"

namespace bl::desktop {

/// Everything above the height is hidden [m].
ViewSection level_section(double height);
/// One looks along `bearing`, clockwise from the y axis [degree], and what lies before `distance` along that way from the origin
/// is hidden [m].
ViewSection upright_section(double bearing, double distance);
inline bool is_level(const ViewSection& section) { return section.normal.z != 0; }
/// From 0 up to 360 [degree]; 0 of a level one.
double bearing_of(const ViewSection& section);
/// The height of a level one; of an upright one the distance from the origin along the way one looks [m].
double position_of(const ViewSection& section);
/// The same plane, with the other half shown.
ViewSection flipped(const ViewSection& section);
/// Is the point on the side that is hidden?
inline bool hides(const ViewSection& section, const Point3& point) {
  return section.is_on && dot(section.normal, point - Point3{}) > section.offset;
}

/// An upright box [m].
struct ModelBox {
  Point3 low, high;
  bool operator==(const ModelBox&) const = default;
};
/// Around volumes and boundaries, with the ground and the cellars that are laid open.
ModelBox model_box(const SceneFacts& facts);
/// A rectangle in the plane that stands a little out of the box: corners in order, for an upright plane the first two at the
/// bottom. Where the plane misses the box the rectangle lies beside it.
std::array<Point3, 4> section_corners(const ViewSection& section, const ModelBox& box);

/// What exporters of drawings take as their option `section`: the two ends of the cut, from left to right as one sees it, or the
/// height of a level one.
std::string section_option(const ViewSection& section, const ModelBox& box);
/// "upright 35 12.5": bearing and distance; "level 12.5", and "below" behind it where the lower half is hidden.
std::string section_text(const ViewSection& section);
/// Nothing where the text is none.
std::optional<ViewSection> section_from_text(const std::string& text);

}  // namespace bl::desktop
