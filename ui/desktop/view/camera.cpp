// Orbit, pan and zoom on two angles and a distance: there is no singular direction, also straight down.
#include "ui/desktop/view/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <nlohmann/json.hpp>

#include "core/define/json_text.h"

namespace bl::desktop {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRadiansPerPixel = 0.006;
constexpr double kNearest = 0.5, kFarthest = 1e6;

double wrapped(double angle) { return std::remainder(angle, 2 * kPi); }

}  // namespace

Vector3 Camera::forward() const {
  return {-std::cos(elevation) * std::cos(azimuth), -std::cos(elevation) * std::sin(azimuth), -std::sin(elevation)};
}

Vector3 Camera::right() const { return {-std::sin(azimuth), std::cos(azimuth), 0}; }

Vector3 Camera::up() const { return cross(right(), forward()); }

double Camera::height_seen() const { return 2 * distance * std::tan(kFieldOfView / 2); }

Matrix Camera::matrix(const Point3& origin, double aspect, double near, double far) const {
  const Vector3 r = right(), u = up(), f = forward(), e = eye() - origin;
  const double view[4][4] = {
      {r.x, r.y, r.z, -dot(r, e)}, {u.x, u.y, u.z, -dot(u, e)}, {-f.x, -f.y, -f.z, dot(f, e)}, {0, 0, 0, 1}};
  double lens[4][4] = {};
  if (is_parallel) {
    const double half = height_seen() / 2;
    lens[0][0] = 1 / (half * aspect);
    lens[1][1] = 1 / half;
    lens[2][2] = -2 / (far - near);
    lens[2][3] = -(far + near) / (far - near);
    lens[3][3] = 1;
  } else {
    const double cot = 1 / std::tan(kFieldOfView / 2);
    lens[0][0] = cot / aspect;
    lens[1][1] = cot;
    lens[2][2] = -(far + near) / (far - near);
    lens[2][3] = -2 * far * near / (far - near);
    lens[3][2] = -1;
  }
  Matrix out{};
  for (std::size_t row = 0; row < 4; ++row)
    for (std::size_t column = 0; column < 4; ++column) {
      double sum = 0;
      for (std::size_t k = 0; k < 4; ++k) sum += lens[row][k] * view[k][column];
      out[4 * column + row] = static_cast<float>(sum);
    }
  return out;
}

Ray Camera::ray(double x, double y, double width, double height) const {
  const double unit = std::tan(kFieldOfView / 2) * 2 / std::max(1.0, height);
  const Vector3 aside = (x - width / 2) * unit * right() - (y - height / 2) * unit * up();
  if (is_parallel) {
    // From far behind the eye, so that nothing is passed over.
    return {eye() + distance * aside - 10 * distance * forward(), forward()};
  }
  const Vector3 way = forward() + aside;
  return {eye(), way / norm(way)};
}

Seen Camera::project(const Point3& point, double width, double height) const { return Lens(*this, width, height).project(point); }

double Camera::metres_per_pixel(const Point3& point, double height) const {
  return Lens(*this, height, height).metres_per_pixel(point);
}

Lens::Lens(const Camera& camera, double width, double height)
    : eye_(camera.eye()),
      forward_(camera.forward()),
      right_(camera.right()),
      up_(camera.up()),
      width_(width),
      height_(height),
      distance_(camera.distance),
      is_parallel_(camera.is_parallel) {}

Seen Lens::project(const Point3& point) const {
  static const double unit = 2 * std::tan(Camera::kFieldOfView / 2);
  const Vector3 from_eye = point - eye_;
  const double depth = dot(from_eye, forward_);
  const double scale = height_ / unit / (is_parallel_ ? distance_ : std::max(1e-6, depth));
  return {width_ / 2 + scale * dot(from_eye, right_), height_ / 2 - scale * dot(from_eye, up_), depth,
          is_parallel_ || depth > 1e-3 * distance_};
}

double Lens::metres_per_pixel(const Point3& point) const {
  static const double unit = std::tan(Camera::kFieldOfView / 2);
  const double depth = is_parallel_ ? distance_ : std::max(1e-3, dot(point - eye_, forward_));
  return 2 * depth * unit / std::max(1.0, height_);
}

void Camera::orbit(double dx, double dy) {
  azimuth -= kRadiansPerPixel * dx;
  elevation += kRadiansPerPixel * dy;
  limit();
}

void Camera::pan(double dx, double dy, double height) {
  const double unit = height_seen() / std::max(1.0, height);
  target += -dx * unit * right() + dy * unit * up();
  limit();
}

void Camera::zoom(double factor, const Point3& towards) {
  const double before = distance;
  distance = std::clamp(distance * factor, kNearest, kFarthest);
  const double reached = distance / before;
  target = towards + reached * (target - towards);
  limit();
}

void Camera::look(double dx, double dy) {
  const Point3 held = eye();
  orbit(dx, dy);
  target = held + distance * forward();
}

void Camera::walk(double ahead, double aside, double upwards) {
  const Vector3 level{-std::cos(azimuth), -std::sin(azimuth), 0};
  target += ahead * level + aside * right() + Vector3{0, 0, upwards};
  limit();
}

void Camera::fit(const Point3& centre, double radius, double aspect) {
  target = centre;
  const double half = kFieldOfView / 2, narrow = std::min(1.0, aspect);
  distance = std::max(1.0, radius) / (std::sin(half) * narrow);
  limit();
}

void Camera::limit() {
  if (!is_finite(target)) target = {};
  if (!std::isfinite(azimuth)) azimuth = 0;
  if (!std::isfinite(elevation)) elevation = 0.6;
  if (!std::isfinite(distance)) distance = 200;
  azimuth = wrapped(azimuth);
  elevation = std::clamp(elevation, -kPi / 2, kPi / 2);
  distance = std::clamp(distance, kNearest, kFarthest);
  const double farthest = 1e7;
  target = {std::clamp(target.x, -farthest, farthest), std::clamp(target.y, -farthest, farthest),
            std::clamp(target.z, -farthest, farthest)};
}

Camera between(const Camera& a, const Camera& b, double t) {
  if (t >= 1) return b;
  const double s = t * t * (3 - 2 * t);
  Camera out = b;
  out.target = a.target + s * (b.target - a.target);
  out.azimuth = wrapped(a.azimuth + s * wrapped(b.azimuth - a.azimuth));
  out.elevation = a.elevation + s * (b.elevation - a.elevation);
  out.distance = a.distance * std::pow(b.distance / a.distance, s);
  return out;
}

std::string to_json_text(const Camera& camera) {
  Json json = Json::object();
  json["target"] = {camera.target.x, camera.target.y, camera.target.z};
  json["azimuth"] = camera.azimuth * 180 / kPi;
  json["elevation"] = camera.elevation * 180 / kPi;
  json["distance"] = camera.distance;
  if (camera.is_parallel) json["parallel"] = true;
  return json.dump();
}

Camera camera_from_json_text(const std::string& text, const Camera& fallback) {
  const Json json = Json::parse(text, nullptr, false);
  Camera camera = fallback;
  if (!json.is_object()) return camera;
  const auto number = [](const Json& value, double otherwise) { return value.is_number() ? value.get<double>() : otherwise; };
  const auto member = [&](const char* key, double otherwise) {
    const auto found = json.find(key);
    return found == json.end() ? otherwise : number(*found, otherwise);
  };
  if (const auto target = json.find("target"); target != json.end() && target->is_array() && target->size() == 3)
    camera.target = {number((*target)[0], 0), number((*target)[1], 0), number((*target)[2], 0)};
  camera.azimuth = member("azimuth", camera.azimuth * 180 / kPi) * kPi / 180;
  camera.elevation = member("elevation", camera.elevation * 180 / kPi) * kPi / 180;
  camera.distance = member("distance", camera.distance);
  const auto parallel = json.find("parallel");
  camera.is_parallel = parallel != json.end() && parallel->is_boolean() && parallel->get<bool>();
  camera.limit();
  return camera;
}

}  // namespace bl::desktop
