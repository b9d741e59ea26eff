// Receivers measured one after the other, each on all threads that there are.
#include "core/sun/sun_study.h"

#include <algorithm>

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

void SunRecord::judge(double required) {
  const std::vector<double>& sun = hours.seconds;
  least = *std::min_element(sun.begin(), sun.end());
  most = *std::max_element(sun.begin(), sun.end());
  mean = deficit = 0;
  const double share = 1 / static_cast<double>(sun.size());
  // Sums of many stretches end in rounding: a microsecond is no shortage.
  constexpr double kNothing = 1e-6;
  std::size_t met = 0;
  for (const double seconds : sun) {
    mean += seconds * share;
    if (seconds >= required - kNothing) ++met;
    else deficit += (required - seconds) * share;
  }
  share_met = static_cast<double>(met) / static_cast<double>(sun.size());
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
    record.judge(receiver.required);
  }
  return records;
}

}  // namespace bl::sun
