// A grid in one flat array; the search goes outward shell by shell until nothing nearer can come.
#include "core/making/ball_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bl::making {

namespace {
constexpr double kLargeRadius = 2;        // [cubes] few sites can be as large in a prism that holds them all
constexpr std::size_t kCubesPerSite = 8;  // bounds the memory where the sites fill little of their bounding box
}  // namespace

BallGrid::BallGrid(std::span<const BallSite> sites, double cube) : sites_(sites), cube_(cube) {
  Point3 high = sites[0].at;
  low_ = high;
  for (const BallSite& site : sites) {
    low_ = {std::min(low_.x, site.at.x), std::min(low_.y, site.at.y), std::min(low_.z, site.at.z)};
    high = {std::max(high.x, site.at.x), std::max(high.y, site.at.y), std::max(high.z, site.at.z)};
  }
  const Vector3 extent = high - low_;
  const double most = static_cast<double>(kCubesPerSite * sites.size() + 64);
  while ((extent.x / cube_ + 1) * (extent.y / cube_ + 1) * (extent.z / cube_ + 1) > most) cube_ *= 1.25;
  counts_[0] = static_cast<long long>(extent.x / cube_) + 1;
  counts_[1] = static_cast<long long>(extent.y / cube_) + 1;
  counts_[2] = static_cast<long long>(extent.z / cube_) + 1;
  starts_.assign(static_cast<std::size_t>(counts_[0] * counts_[1] * counts_[2]) + 1, 0);
  std::vector<std::size_t> cube_of(sites.size());
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const Point3& p = sites[i].at;
    cube_of[i] =
        cube_index(coordinate(p.x, low_.x, counts_[0]), coordinate(p.y, low_.y, counts_[1]), coordinate(p.z, low_.z, counts_[2]));
    ++starts_[cube_of[i] + 1];
    if (sites[i].radius > kLargeRadius * cube_) large_.push_back(i);
    else reach_ = std::max(reach_, sites[i].radius * sites[i].radius);
  }
  for (std::size_t k = 1; k < starts_.size(); ++k) starts_[k] += starts_[k - 1];
  members_.resize(sites.size());
  std::vector<std::size_t> next(starts_.begin(), starts_.end() - 1);
  for (std::size_t i = 0; i < sites.size(); ++i) members_[next[cube_of[i]]++] = i;
}

std::size_t BallGrid::cube_index(long long x, long long y, long long z) const {
  return static_cast<std::size_t>((z * counts_[1] + y) * counts_[0] + x);
}

long long BallGrid::coordinate(double value, double low, long long count) const {
  return std::clamp(static_cast<long long>((value - low) / cube_), 0LL, count - 1);
}

void BallGrid::consider(const Point3& point, std::size_t site, Hit& hit) const {
  const double power = squared_norm(point - sites_[site].at) - sites_[site].radius * sites_[site].radius;
  if (power < hit.power || (power == hit.power && site < hit.site)) hit = {site, power};
}

// Looks at the cubes that are `shell` cubes away from the centre; false where the grid has none.
bool BallGrid::visit_shell(const Point3& point, const long long (&centre)[3], long long shell, Hit& hit) const {
  bool any = false;
  long long from[3], to[3];
  for (int k = 0; k < 3; ++k) {
    from[k] = std::max(0LL, centre[k] - shell);
    to[k] = std::min(counts_[k] - 1, centre[k] + shell);
    any = any || centre[k] - shell >= 0 || centre[k] + shell < counts_[k];
  }
  for (long long z = from[2]; z <= to[2]; ++z)
    for (long long y = from[1]; y <= to[1]; ++y) {
      const bool face = std::abs(z - centre[2]) == shell || std::abs(y - centre[1]) == shell;
      // Inside the shell only the two ends of a row belong to it.
      const long long step = face || shell == 0 ? 1 : 2 * shell;
      for (long long x = face ? from[0] : centre[0] - shell; x <= to[0]; x += step) {
        if (x < 0) continue;
        const std::size_t cube = cube_index(x, y, z);
        for (std::size_t m = starts_[cube]; m < starts_[cube + 1]; ++m) consider(point, members_[m], hit);
      }
    }
  return any;
}

BallGrid::Hit BallGrid::nearest(const Point3& point) const {
  Hit hit{sites_.size(), std::numeric_limits<double>::infinity()};
  for (const std::size_t site : large_) consider(point, site, hit);
  const long long centre[3] = {coordinate(point.x, low_.x, counts_[0]), coordinate(point.y, low_.y, counts_[1]),
                               coordinate(point.z, low_.z, counts_[2])};
  for (long long shell = 0;; ++shell) {
    // Sites of this shell are at least (shell - 1) cubes away; points outside the grid are farther still.
    const double gap = static_cast<double>(std::max(0LL, shell - 1)) * cube_;
    if (gap * gap - reach_ > hit.power) break;
    if (!visit_shell(point, centre, shell, hit)) break;
  }
  return hit;
}

bool BallGrid::crowded(std::size_t site, double limit) const {
  const Point3& p = sites_[site].at;
  const long long centre[3] = {coordinate(p.x, low_.x, counts_[0]), coordinate(p.y, low_.y, counts_[1]),
                               coordinate(p.z, low_.z, counts_[2])};
  for (long long z = std::max(0LL, centre[2] - 1); z <= std::min(counts_[2] - 1, centre[2] + 1); ++z)
    for (long long y = std::max(0LL, centre[1] - 1); y <= std::min(counts_[1] - 1, centre[1] + 1); ++y)
      for (long long x = std::max(0LL, centre[0] - 1); x <= std::min(counts_[0] - 1, centre[0] + 1); ++x) {
        const std::size_t cube = cube_index(x, y, z);
        for (std::size_t m = starts_[cube]; m < starts_[cube + 1]; ++m)
          if (members_[m] < site && distance(sites_[members_[m]].at, p) < limit) return true;
      }
  return false;
}

}  // namespace bl::making
