// The eye of the 3D view: an orbit around a point, in perspective or parallel, with smooth changes from one view to another.
#pragma once

#include <array>
#include <string>

#include "core/base/vector.h"

namespace bl::desktop {

/// Column-major, as graphics processors want it.
using Matrix = std::array<float, 16>;

/// A line of sight: points origin + t · direction, t >= 0; `direction` is a unit vector.
struct Ray {
  Point3 origin;
  Vector3 direction;
};

/// A place in a picture [pixels from its upper left corner], with the distance along the line of sight [m].
struct Seen {
  double x = 0, y = 0, depth = 0;
  bool is_in_front = true;
};

struct Camera {
  Point3 target;                           ///< what it turns around [m]
  double azimuth = -0.6, elevation = 0.6;  ///< of the eye, seen from the target: from east anticlockwise, up [rad]
  double distance = 200;                   ///< of the eye from the target [m]
  bool is_parallel = false;
  bool operator==(const Camera&) const = default;

  static constexpr double kFieldOfView = 0.6;  ///< vertical [rad]: a long lens, as pictures of buildings are taken with

  Vector3 forward() const;
  Vector3 right() const;
  Vector3 up() const;
  Point3 eye() const { return target - distance * forward(); }
  /// Height of what is seen at the distance of the target [m].
  double height_seen() const;

  /// World, moved by -`origin`, to clip space, with depths from `near` to `far` [m].
  Matrix matrix(const Point3& origin, double aspect, double near, double far) const;
  Ray ray(double x, double y, double width, double height) const;
  Seen project(const Point3& point, double width, double height) const;
  /// Metres that one pixel covers at a point.
  double metres_per_pixel(const Point3& point, double height) const;

  void orbit(double dx, double dy);                              ///< [pixels]
  void pan(double dx, double dy, double height);                 ///< the world follows the hand [pixels]
  void zoom(double factor, const Point3& towards);               ///< nearer for factors below 1; `towards` keeps its place
  void look(double dx, double dy);                               ///< turns the head, the eye stays
  void walk(double ahead, double aside, double upwards);         ///< [m]
  void fit(const Point3& centre, double radius, double aspect);  ///< a ball fills the picture
  void limit();                                                  ///< keeps all numbers sane
};

/// One picture of a camera, for projecting many points.
class Lens {
 public:
  Lens(const Camera& camera, double width, double height);
  Seen project(const Point3& point) const;
  /// Metres that one pixel covers at a point.
  double metres_per_pixel(const Point3& point) const;

 private:
  Point3 eye_;
  Vector3 forward_, right_, up_;
  double width_, height_, distance_;
  bool is_parallel_;
};

/// In between, `t` from 0 to 1: the shorter way around, distances by ratio.
Camera between(const Camera& a, const Camera& b, double t);

/// As text for the scene's view, and back; what is missing or absurd stays as in `fallback`.
std::string to_json_text(const Camera& camera);
Camera camera_from_json_text(const std::string& text, const Camera& fallback);

}  // namespace bl::desktop
