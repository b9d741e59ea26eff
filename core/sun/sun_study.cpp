// Receivers measured one after the other, each on all threads that there are.
#include "core/sun/sun_study.h"

#include <algorithm>
#include <cmath>

namespace bl {

namespace {

constexpr double kRadian = 0.017453292519943295;

void judge(double required, SunRecord& record) {
  const std::vector<double>& sun = record.hours.seconds;
  record.least = *std::min_element(sun.begin(), sun.end());
  record.most = *std::max_element(sun.begin(), sun.end());
  record.mean = record.deficit = 0;
  const double share = 1 / static_cast<double>(sun.size());
  // Sums of many stretches end in rounding: a microsecond is no shortage.
  constexpr double kNothing = 1e-6;
  std::size_t met = 0;
  for (const double seconds : sun) {
    record.mean += seconds * share;
    if (seconds >= required - kNothing) ++met;
    else record.deficit += (required - seconds) * share;
  }
  record.share_met = static_cast<double>(met) / static_cast<double>(sun.size());
}

}  // namespace

void level_axes(double width, double depth, double rotation, SunReceiver& receiver) {
  const double turn = rotation * kRadian;
  receiver.half_across = Vector3{std::cos(turn), std::sin(turn), 0} * (0.5 * width);
  receiver.half_up = Vector3{-std::sin(turn), std::cos(turn), 0} * (0.5 * depth);
}

void upright_axes(double width, double height, double azimuth, SunReceiver& receiver) {
  const double turn = azimuth * kRadian;
  receiver.half_across = Vector3{-std::cos(turn), std::sin(turn), 0} * (0.5 * width);
  receiver.half_up = {0, 0, 0.5 * height};
}

Result<std::vector<SunRecord>> sun_study(std::span<const MeshPointer> casters, std::span<const SunMoment> moments,
                                         std::span<const SunReceiver> receivers, ThreadPool* pool) {
  const auto scene = ShadowScene::build(casters);
  if (!scene) return scene.error();
  std::vector<SunRecord> records;
  for (const SunReceiver& receiver : receivers) {
    SunRecord& record = records.emplace_back();
    record.grid = sun_grid(receiver.centre, receiver.half_across, receiver.half_up, receiver.spacing, kMostSunPoints);
    record.hours = sun_hours(*scene, record.grid.points, moments, receiver.mask, pool);
    judge(receiver.required, record);
  }
  return records;
}

}  // namespace bl
