// Rays from points to the sun, and the accounts of what they find.
#include "core/sun/sun_hours.h"

#include <algorithm>
#include <cmath>

#include "core/base/stop.h"

namespace bl::sun {

namespace {

struct Account {
  double possible = 0;
  std::vector<SunLoss> casters;
};

// One point at all moments. A search for all who stand in the way costs a free ray no more than one for the first.
double measure_point(const ShadowScene& scene, const SunPoint& point, std::span<const SunMoment> moments, ShadowScene::Mask mask,
                     Account& account, std::vector<std::uint32_t>& found) {
  double sun = 0;
  for (const SunMoment& moment : moments) {
    if (!(dot(point.normal, moment.toward) > 0)) continue;
    account.possible += moment.seconds;
    scene.blockers(point.place, moment.toward, found, mask);
    if (found.empty()) sun += moment.seconds;
    if (found.size() == 1) account.casters[found[0]].lost += moment.seconds;
    for (const std::uint32_t caster : found) account.casters[caster].shared += moment.seconds / static_cast<double>(found.size());
  }
  return sun;
}

}  // namespace

SunHours sun_hours(const ShadowScene& scene, std::span<const SunPoint> points, std::span<const SunMoment> moments,
                   ShadowScene::Mask mask, ThreadPool* pool) {
  constexpr std::size_t kGrain = 8;
  SunHours hours;
  hours.seconds.resize(points.size());
  hours.casters.resize(scene.casters());
  if (points.empty()) return hours;
  std::vector<Account> accounts((points.size() + kGrain - 1) / kGrain);
  const StopWish* wish = stop_wish();
  const auto measure = [&](std::size_t begin, std::size_t end) {
    if (wish != nullptr && (*wish)()) return;
    std::vector<std::uint32_t> found;
    Account& account = accounts[begin / kGrain];
    account.casters.resize(scene.casters());
    for (std::size_t i = begin; i < end; ++i) hours.seconds[i] = measure_point(scene, points[i], moments, mask, account, found);
  };
  ThreadPool one(1);
  (pool != nullptr ? *pool : one).for_each_chunk(points.size(), kGrain, measure);
  const double share = 1 / static_cast<double>(points.size());
  for (const Account& account : accounts) {
    hours.possible += account.possible * share;
    for (std::size_t k = 0; k < account.casters.size(); ++k) {
      hours.casters[k].lost += account.casters[k].lost * share;
      hours.casters[k].shared += account.casters[k].shared * share;
    }
  }
  return hours;
}

SunGrid sun_grid(const Point3& centre, const Vector3& half_across, const Vector3& half_up, double spacing, std::size_t most) {
  const auto fields = [](double length, double size) { return std::max(1.0, std::ceil(length / size - 1e-9)); };
  const double width = 2 * norm(half_across), height = 2 * norm(half_up);
  double columns = fields(width, spacing), rows = fields(height, spacing);
  while (columns * rows > static_cast<double>(most)) {
    spacing *= 1.01 * std::sqrt(columns * rows / static_cast<double>(most));
    columns = fields(width, spacing);
    rows = fields(height, spacing);
  }
  Vector3 normal = cross(half_across, half_up);
  if (const double length = norm(normal); length > 0) normal = normal / length;
  SunGrid grid{static_cast<std::size_t>(columns), static_cast<std::size_t>(rows), {}};
  for (std::size_t r = 0; r < grid.rows; ++r)
    for (std::size_t c = 0; c < grid.columns; ++c) {
      const double across = (2 * static_cast<double>(c) + 1) / columns - 1, up = (2 * static_cast<double>(r) + 1) / rows - 1;
      grid.points.push_back({centre + half_across * across + half_up * up, normal});
    }
  return grid;
}

}  // namespace bl::sun
