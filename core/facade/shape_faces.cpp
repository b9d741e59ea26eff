// Groups triangles into faces and compares faces by plane and middle.
#include "core/facade/shape_faces.h"

namespace bl::facade {

namespace {

// Of the shape's size: coordinates of one face in two cells differ by rounding only.
constexpr double kSamePlace = 1e-6, kOpposite = -1 + 1e-9;

}  // namespace

std::vector<ShapeFace> faces_of(const Mesh& mesh) {
  std::vector<ShapeFace> faces;
  const auto& triangles = mesh.triangles;
  for (std::size_t begin = 0, end = 0; begin < triangles.size(); begin = end) {
    end = begin + 1;
    while (mesh.wrap && end < triangles.size() && triangles[end][0] == triangles[begin][0]) ++end;
    ShapeFace face{begin, end - begin, {}, {}, 0, false};
    Vector3 doubled;
    for (std::size_t t = begin; t < end; ++t) {
      const Point3 &a = mesh.vertices[triangles[t][0]], &b = mesh.vertices[triangles[t][1]], &c = mesh.vertices[triangles[t][2]];
      const Vector3 across = cross(b - a, c - a);
      const double area = 0.5 * norm(across);
      doubled += across;
      face.area += area;
      face.middle += (area / 3) * ((b - a) + (c - a));
    }
    if (!(face.area > 0) || !(norm(doubled) > 0)) continue;
    face.normal = doubled / norm(doubled);
    face.middle = mesh.vertices[triangles[begin][0]] + face.middle / face.area;
    faces.push_back(face);
  }
  return faces;
}

void mark_shared(std::span<ShapeFace> own, std::span<const ShapeFace> other, double size) {
  const double near = kSamePlace * size;
  for (ShapeFace& face : own)
    for (std::size_t k = 0; k < other.size() && !face.is_shared; ++k)
      face.is_shared = dot(face.normal, other[k].normal) < kOpposite && distance(face.middle, other[k].middle) < near;
}

}  // namespace bl::facade
