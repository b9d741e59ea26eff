// What lies under the mouse, by lines of sight on the processor: exact on the balls and the flat faces, whatever is drawn.
#pragma once

#include <optional>
#include <vector>

#include "ui/desktop/view/camera.h"
#include "ui/desktop/view/scene_facts.h"
#include "ui/desktop/view/view_scene.h"

namespace bl::desktop {

struct Hit {
  std::uint32_t node = 0;
  double distance = 0;  ///< along the line of sight [m]
  Point3 place;
};

/// Where a line of sight first meets a volume: its cell inside its ball, on the shown side of the section.
std::optional<double> meet(const Ray& ray, const Mesh& cell, const ViewSection& section);
/// `with_bodies`: are the buildings around seen?
std::optional<Hit> pick(const Ray& ray, const SceneFacts& facts, const ViewSection& section, bool with_bodies);
/// Is the volume the first thing on the line of sight? What `pick` would find, and cheaper where the answer is all that is
/// wanted.
bool is_met_first(const Ray& ray, const VolumeFacts& volume, const SceneFacts& facts, const ViewSection& section,
                  bool with_bodies);

/// A rectangle in the picture [pixels].
struct Box {
  double left = 0, top = 0, right = 0, bottom = 0;
  bool holds(double x, double y) const { return x >= left && x <= right && y >= top && y <= bottom; }
};
/// What of a scene a picture shows.
struct Sight {
  const Camera& camera;
  double width = 0, height = 0;  ///< [pixels]
  ViewSection section;
  bool with_marks = true;
};
/// Nodes whose drawn shape the box holds wholly, or touches at least.
std::vector<std::uint32_t> pick_box(const Box& box, bool touches, const SceneFacts& facts, const Sight& sight);

/// The point of a line through `through` along `axis` that is nearest to the line of sight; nothing where they are parallel.
std::optional<Point3> nearest_on_axis(const Ray& ray, const Point3& through, const Vector3& axis);
/// Where the line of sight meets the plane; nothing where it runs along it or away from it.
std::optional<Point3> meet_plane(const Ray& ray, const Point3& through, const Vector3& normal);

}  // namespace bl::desktop
