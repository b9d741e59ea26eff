// Planes of depth around what is drawn, lists of volumes that pictures share, and how finely a picture may be divided.
#include "ui/desktop/view/view_scene.h"

#include <algorithm>

namespace bl::desktop {

namespace {

// Items that are one object are the same.
template <class IsSame>
bool are_all(const ViewVolumes& a, const ViewVolumes& b, const IsSame& is_same) {
  if (a.size() != b.size()) return false;
  for (std::size_t leaf = 0; leaf < a.leaf_count(); ++leaf) {
    if (a.shares_leaf(b, leaf)) continue;
    const std::size_t end = std::min(a.size(), (leaf + 1) * ViewVolumes::kLeaf);
    for (std::size_t k = leaf * ViewVolumes::kLeaf; k < end; ++k)
      if (a.item(k) != b.item(k) && !is_same(a[k], b[k])) return false;
  }
  return true;
}

}  // namespace

ViewVolumes published(ViewVolumes::Draft&& draft) {
  return std::move(draft).publish([](const ViewVolume&, std::size_t) {},
                                  [](const auto& items, std::size_t) {
                                    std::size_t count = 0;
                                    for (const auto& item : items) count += item ? item->cell->triangles.size() : 0;
                                    return count;
                                  });
}

bool operator==(const ViewVolumes& a, const ViewVolumes& b) {
  return are_all(a, b, [](const ViewVolume& x, const ViewVolume& y) { return x == y; });
}

bool have_same_cells(const ViewVolumes& a, const ViewVolumes& b) {
  return are_all(a, b, [](const ViewVolume& x, const ViewVolume& y) { return x.cell == y.cell; });
}

std::size_t coarse_triangles(const ViewVolumes& volumes) {
  std::size_t count = 0;
  for (std::size_t leaf = 0; leaf < volumes.leaf_count(); ++leaf) count += volumes.digest(leaf);
  return count;
}

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
