// Planes of depth around what is drawn, and how finely it may be divided.
#include "ui/desktop/view/view_scene.h"

#include <algorithm>

namespace bl::desktop {

double ViewScene::near_plane() const {
  const double towards = dot(centre - camera.eye(), camera.forward());
  if (camera.is_parallel) return towards - 20 * radius;
  return std::max(0.002 * camera.distance, towards - 4 * radius);
}

double ViewScene::far_plane() const {
  const double towards = dot(centre - camera.eye(), camera.forward());
  return std::max(towards + 20 * radius, near_plane() + 1);
}

int depth_within(std::size_t coarse_triangles, int most_triangles, int deepest) {
  int depth = 0;
  std::size_t count = std::max<std::size_t>(1, coarse_triangles);
  while (depth < deepest && 4 * count <= static_cast<std::size_t>(std::max(0, most_triangles))) {
    count *= 4;
    ++depth;
  }
  return depth;
}

}  // namespace bl::desktop
