// What every frame reads of all volumes, in columns: who looks at thousands of them reads little memory.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/mesh.h"
#include "ui/desktop/view/camera.h"

namespace bl::desktop {

/// The balls that shapes lie in: lines of sight find what they may meet without a look at the shapes. Balls that are near to each
/// other stand in one block, and what misses the block's ball misses them all.
class SightBalls {
 public:
  std::vector<double> x, y, z, squared_radius;  ///< by row; a radius below 0: no shape

  void resize(std::size_t size);
  void set(std::size_t row, const MeshPointer& cell);
  std::size_t size() const { return x.size(); }
  /// After all rows have been set for the first time.
  void group();
  /// After some have been set again. Where blocks have grown too much by that, they are made anew.
  void refit(const std::vector<std::size_t>& rows);
  /// All rows whose balls the line may go through, and some others, in no order that means something.
  std::vector<std::uint32_t> rows_along(const Ray& ray) const;

 private:
  static constexpr std::size_t kBlock = 32;

  void fit(std::size_t block);
  double extent() const;
  void split(std::size_t begin, std::size_t end);

  std::vector<std::uint32_t> order_;   ///< rows, block after block
  std::vector<std::uint32_t> places_;  ///< of rows, in `order_`
  struct Block {
    Point3 centre;
    double radius = 0;  ///< below 0: nothing has a shape in it
  };
  std::vector<Block> blocks_;
  double extent_at_first_ = 0;  ///< sum of the blocks' radii when they were made [m]
};

/// What labels are chosen by.
struct VolumeColumns {
  std::vector<std::uint32_t> node;
  std::vector<double> radius;    ///< [m]
  std::vector<Point3> position;  ///< [m]

  void resize(std::size_t size);
};

}  // namespace bl::desktop
