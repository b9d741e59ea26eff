// Blocks by halves: the rows of a block are those of a part of space, cut across its longest side again and again.
#include "ui/desktop/view/volume_columns.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>

namespace bl::desktop {

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
// Blocks are made anew once they have grown by this factor in all.
constexpr double kMostGrowth = 1.5;
// What rounding may take from a block, as a share of the squared distance.
constexpr double kSlack = 1e-9;

}  // namespace

void SightBalls::resize(std::size_t size) {
  for (auto* column : {&x, &y, &z, &squared_radius}) column->resize(size);
}

void SightBalls::set(std::size_t row, const MeshPointer& cell) {
  const bool has_shape = cell != nullptr && cell->wrap;
  const Point3 centre = has_shape ? cell->wrap->ball_centre : Point3{};
  x[row] = centre.x, y[row] = centre.y, z[row] = centre.z;
  squared_radius[row] = has_shape ? cell->wrap->radius * cell->wrap->radius : -1;
}

void SightBalls::fit(std::size_t block) {
  const auto first = order_.begin() + static_cast<std::ptrdiff_t>(block * kBlock);
  const auto last = order_.begin() + static_cast<std::ptrdiff_t>(std::min(order_.size(), (block + 1) * kBlock));
  Block& fitted = blocks_[block];
  fitted = {{}, -1};
  Vector3 low{kInfinite, kInfinite, kInfinite}, high = -low;
  for (auto row = first; row != last; ++row) {
    if (squared_radius[*row] < 0) continue;
    low = {std::min(low.x, x[*row]), std::min(low.y, y[*row]), std::min(low.z, z[*row])};
    high = {std::max(high.x, x[*row]), std::max(high.y, y[*row]), std::max(high.z, z[*row])};
  }
  if (!(low.x <= high.x)) return;
  fitted.centre = 0.5 * (low + high);
  for (auto row = first; row != last; ++row) {
    if (squared_radius[*row] < 0) continue;
    const double reach = distance({x[*row], y[*row], z[*row]}, fitted.centre) + std::sqrt(squared_radius[*row]);
    // Where a number is none, everything is near.
    fitted.radius = std::isfinite(reach) ? std::max(fitted.radius, reach) : kInfinite;
  }
}

double SightBalls::extent() const {
  double sum = 0;
  for (const Block& block : blocks_) sum += std::max(0.0, block.radius);
  return sum;
}

// Halves at multiples of a block, so that no block has rows of two parts.
void SightBalls::split(std::size_t begin, std::size_t end) {
  if (end - begin <= kBlock) return;
  Vector3 low{kInfinite, kInfinite, kInfinite}, high = -low;
  for (std::size_t k = begin; k < end; ++k) {
    const std::uint32_t row = order_[k];
    low = {std::min(low.x, x[row]), std::min(low.y, y[row]), std::min(low.z, z[row])};
    high = {std::max(high.x, x[row]), std::max(high.y, y[row]), std::max(high.z, z[row])};
  }
  const Vector3 size = high - low;
  const std::vector<double>& along = size.x >= size.y && size.x >= size.z ? x : size.y >= size.z ? y : z;
  const std::size_t middle = begin + ((end - begin) / kBlock + 1) / 2 * kBlock;
  const auto at = [&](std::size_t k) { return order_.begin() + static_cast<std::ptrdiff_t>(k); };
  std::nth_element(at(begin), at(middle), at(end), [&](std::uint32_t a, std::uint32_t b) { return along[a] < along[b]; });
  split(begin, middle);
  split(middle, end);
}

void SightBalls::group() {
  order_.resize(size());
  std::iota(order_.begin(), order_.end(), 0u);
  const auto is_number = [&](std::uint32_t row) {
    return std::isfinite(x[row]) && std::isfinite(y[row]) && std::isfinite(z[row]);
  };
  // What has no place could not be ordered by it.
  const auto ordered = std::stable_partition(order_.begin(), order_.end(), is_number);
  split(0, static_cast<std::size_t>(ordered - order_.begin()));
  places_.resize(size());
  for (std::size_t k = 0; k < order_.size(); ++k) places_[order_[k]] = static_cast<std::uint32_t>(k);
  blocks_.assign((size() + kBlock - 1) / kBlock, {});
  for (std::size_t block = 0; block < blocks_.size(); ++block) fit(block);
  extent_at_first_ = extent();
}

void SightBalls::refit(const std::vector<std::size_t>& rows) {
  std::vector<bool> is_touched(blocks_.size());
  for (const std::size_t row : rows) is_touched[places_[row] / kBlock] = true;
  for (std::size_t block = 0; block < blocks_.size(); ++block)
    if (is_touched[block]) fit(block);
  if (!(extent() <= kMostGrowth * extent_at_first_)) group();
}

std::vector<std::uint32_t> SightBalls::rows_along(const Ray& ray) const {
  std::vector<std::uint32_t> rows;
  for (std::size_t block = 0; block < blocks_.size(); ++block) {
    const Block& ball = blocks_[block];
    if (ball.radius < 0) continue;
    const Vector3 to = ray.origin - ball.centre;
    const double b = dot(to, ray.direction), far = squared_norm(to);
    if (b * b - far + ball.radius * ball.radius < -kSlack * far) continue;
    const std::size_t end = std::min(order_.size(), (block + 1) * kBlock);
    rows.insert(rows.end(), order_.begin() + static_cast<std::ptrdiff_t>(block * kBlock),
                order_.begin() + static_cast<std::ptrdiff_t>(end));
  }
  return rows;
}

void VolumeColumns::resize(std::size_t size) {
  node.resize(size);
  radius.resize(size);
  position.resize(size);
}

}  // namespace bl::desktop
