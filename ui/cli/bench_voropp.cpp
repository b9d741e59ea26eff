// Radical cells in a box by Voro++; compiled only where that is installed.
#include "ui/cli/bench_voropp.h"

#include <voro++/voro++.hh>

#include <algorithm>
#include <cmath>

namespace bl::cli {

double voropp_total_volume(const Vector3& minimum, const Vector3& maximum, std::span<const PowerSite> sites) {
  // Blocks with about five particles each are what its authors advise.
  const Vector3 size = maximum - minimum;
  const double block = std::cbrt(5 * size.x * size.y * size.z / static_cast<double>(std::max<std::size_t>(1, sites.size())));
  const auto blocks = [&](double length) { return std::max(1, static_cast<int>(std::lround(length / block))); };
  voro::container_poly box(minimum.x, maximum.x, minimum.y, maximum.y, minimum.z, maximum.z, blocks(size.x), blocks(size.y),
                           blocks(size.z), false, false, false, 8);
  for (std::size_t i = 0; i < sites.size(); ++i)
    box.put(static_cast<int>(i), sites[i].position.x, sites[i].position.y, sites[i].position.z,
            std::sqrt(std::max(0.0, sites[i].weight)));
  return box.sum_cell_volumes();
}

}  // namespace bl::cli
