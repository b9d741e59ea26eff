// Receivers measured one after the other, each on all threads that there are.
#include "core/sun/sun_study.h"

#include <algorithm>
#include <functional>

#include "core/base/mathematics.h"
#include "core/base/stop.h"
#include "core/base/text.h"

namespace bl::sun {

namespace {

constexpr double kRadianOfStudy = 0.017453292519943295;

SunGrid grid_of(const SunReceiver& receiver) {
  return sun_grid(receiver.centre, receiver.half_across, receiver.half_up, receiver.spacing, kMostSunPoints);
}

}  // namespace

void SunRecord::judge(const SunReceiver& receiver) {
  const std::vector<double>& sun = hours.seconds;
  const auto points = static_cast<double>(sun.size());
  std::vector<double> most_first = sun;
  std::sort(most_first.begin(), most_first.end(), std::greater());
  least = most_first.back();
  most = most_first.front();
  // Shares such as 0.3 of 10 points are whole numbers but for rounding.
  const auto counted = static_cast<std::size_t>(std::clamp(std::ceil(receiver.required_share * points - 1e-9), 1.0, points));
  of_share = most_first[counted - 1];
  // Of points that have exactly as much, only so many count.
  auto alike =
      counted - static_cast<std::size_t>(std::lower_bound(most_first.begin(), most_first.end(), of_share, std::greater()) -
                                         most_first.begin());
  // Sums of many stretches end in rounding: a microsecond is no shortage.
  constexpr double kNothing = 1e-6;
  const double share = 1 / points, counted_share = 1 / static_cast<double>(counted);
  mean = deficit = 0;
  std::size_t met = 0;
  for (const double seconds : sun) {
    mean += seconds * share;
    const bool counts = seconds > of_share || (seconds == of_share && alike > 0);
    if (seconds == of_share && alike > 0) --alike;
    if (seconds >= receiver.required - kNothing) ++met;
    else if (counts) deficit += (receiver.required - seconds) * counted_share;
  }
  share_met = static_cast<double>(met) / points;
}

void level_axes(double width, double depth, double rotation, SunReceiver& receiver) {
  const double turn = rotation * kRadianOfStudy;
  receiver.half_across = Vector3{mathematics::cosine(turn), mathematics::sine(turn), 0} * (0.5 * width);
  receiver.half_up = Vector3{-mathematics::sine(turn), mathematics::cosine(turn), 0} * (0.5 * depth);
}

void upright_axes(double width, double height, double azimuth, SunReceiver& receiver) {
  const double turn = azimuth * kRadianOfStudy;
  receiver.half_across = Vector3{-mathematics::cosine(turn), mathematics::sine(turn), 0} * (0.5 * width);
  receiver.half_up = {0, 0, 0.5 * height};
}

Result<void> check_sun_rays(std::span<const SunReceiver> receivers, std::size_t moments) {
  double rays = 0;
  for (const SunReceiver& receiver : receivers)
    rays += static_cast<double>(grid_of(receiver).points.size()) * static_cast<double>(moments);
  if (!(rays > kMostSunRays)) return {};
  return Error{ErrorCode::out_of_range, "receivers",
               "the study would follow " + fixed(rays / 1e6, 0) + " million rays, and at most " + fixed(kMostSunRays / 1e6, 0) +
                   " million are allowed: choose fewer receivers or a larger spacing of their points, or a longer step or fewer "
                   "days at the sun"};
}

Result<std::vector<SunRecord>> sun_study(std::span<const MeshPointer> casters, std::span<const SunMoment> moments,
                                         std::span<const SunReceiver> receivers, ThreadPool* pool) {
  if (auto allowed = check_sun_rays(receivers, moments.size()); !allowed) return allowed.error();
  const auto scene = ShadowScene::build(casters);
  if (!scene) return scene.error();
  const StopWish* wish = stop_wish();
  std::vector<SunRecord> records;
  for (const SunReceiver& receiver : receivers) {
    SunRecord& record = records.emplace_back();
    record.grid = grid_of(receiver);
    record.hours = sun_hours(*scene, record.grid.points, moments, receiver.mask, pool);
    if (wish != nullptr && (*wish)())
      return Error{ErrorCode::cancelled, "", "the study was stopped: nobody wants its result any more"};
    record.judge(receiver);
  }
  return records;
}

}  // namespace bl::sun
