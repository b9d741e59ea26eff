// Radical cells in a box by Voro++; compiled only where that is installed.
#include "tests/bench/bench_voropp.h"

#include <voro++/voro++.hh>

#include <algorithm>
#include <cmath>

namespace bl::cli::bench {

namespace {

// The container with the sites in it. About 5.6 of them in a block were the fastest of the numbers that were tried.
struct FilledBox {
  FilledBox(const Vector3& minimum, const Vector3& maximum, std::span<const geometry::PowerSite> sites)
      : block(std::cbrt(5.6 * (maximum.x - minimum.x) * (maximum.y - minimum.y) * (maximum.z - minimum.z) /
                        static_cast<double>(std::max<std::size_t>(1, sites.size())))),
        container(minimum.x, maximum.x, minimum.y, maximum.y, minimum.z, maximum.z, blocks(maximum.x - minimum.x),
                  blocks(maximum.y - minimum.y), blocks(maximum.z - minimum.z), false, false, false, 8) {
    for (std::size_t i = 0; i < sites.size(); ++i)
      container.put(static_cast<int>(i), sites[i].position.x, sites[i].position.y, sites[i].position.z,
                    std::sqrt(std::max(0.0, sites[i].weight)));
  }
  int blocks(double length) const { return std::max(1, static_cast<int>(std::lround(length / block))); }

  double block;
  voro::container_poly container;
};

}  // namespace

double voropp_total_volume(const Vector3& minimum, const Vector3& maximum, std::span<const geometry::PowerSite> sites) {
  return FilledBox(minimum, maximum, sites).container.sum_cell_volumes();
}

VoroppCells voropp_cells(const Vector3& minimum, const Vector3& maximum, std::span<const geometry::PowerSite> sites) {
  FilledBox box(minimum, maximum, sites);
  VoroppCells cells;
  cells.volumes.resize(sites.size());
  cells.first.resize(sites.size());
  std::vector<int> neighbours;
  std::vector<double> areas;
  voro::voronoicell_neighbor cell;
  voro::c_loop_all loop(box.container);
  if (loop.start()) do {
      if (!box.container.compute_cell(cell, loop)) continue;
      const auto i = static_cast<std::size_t>(loop.pid());
      cells.volumes[i] = cell.volume();
      cells.first[i] = cells.neighbours.size();
      cell.neighbors(neighbours);
      cell.face_areas(areas);
      cells.neighbours.insert(cells.neighbours.end(), neighbours.begin(), neighbours.end());
      cells.face_areas.insert(cells.face_areas.end(), areas.begin(), areas.end());
    } while (loop.inc());
  return cells;
}

}  // namespace bl::cli::bench
