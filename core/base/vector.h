// Points and vectors in space: three doubles, metres unless a declaration says otherwise.
#pragma once

#include <cmath>

namespace bl {

struct Vector3 {
  double x = 0, y = 0, z = 0;
  bool operator==(const Vector3&) const = default;

  constexpr Vector3& operator+=(const Vector3& b) {
    x += b.x;
    y += b.y;
    z += b.z;
    return *this;
  }
  constexpr Vector3& operator-=(const Vector3& b) {
    x -= b.x;
    y -= b.y;
    z -= b.z;
    return *this;
  }
  constexpr Vector3& operator*=(double s) {
    x *= s;
    y *= s;
    z *= s;
    return *this;
  }
};

/// A position; the same three numbers as a Vector3, named apart where reading is helped by it.
using Point3 = Vector3;

constexpr Vector3 operator+(Vector3 a, const Vector3& b) { return a += b; }
constexpr Vector3 operator-(Vector3 a, const Vector3& b) { return a -= b; }
constexpr Vector3 operator-(const Vector3& a) { return {-a.x, -a.y, -a.z}; }
constexpr Vector3 operator*(Vector3 a, double s) { return a *= s; }
constexpr Vector3 operator*(double s, Vector3 a) { return a *= s; }
constexpr Vector3 operator/(const Vector3& a, double s) { return {a.x / s, a.y / s, a.z / s}; }

constexpr double dot(const Vector3& a, const Vector3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
constexpr double squared_norm(const Vector3& a) { return dot(a, a); }
inline double norm(const Vector3& a) { return std::sqrt(squared_norm(a)); }
inline double distance(const Point3& a, const Point3& b) { return norm(b - a); }
inline bool is_finite(const Vector3& a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }

}  // namespace bl
