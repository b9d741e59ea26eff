// Receivers measured one after the other, each on all threads; records that still hold are taken from the time before.
#include "core/sun/sun_study.h"

#include <algorithm>
#include <cmath>

namespace bl {

namespace {

constexpr double kRadian = 0.017453292519943295;

bool same_mesh(const MeshPointer& a, const MeshPointer& b) {
  if (a == b) return true;
  return a && b && a->vertices == b->vertices && a->triangles == b->triangles;
}

bool same_casters(std::span<const MeshPointer> a, std::span<const MeshPointer> b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), same_mesh);
}

bool same_moments(std::span<const SunMoment> a, std::span<const SunMoment> b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const SunMoment& x, const SunMoment& y) { return x.toward == y.toward && x.seconds == y.seconds; });
}

// The same points among the same casters, so the same sun; what is required of it may be another.
bool same_place(const SunReceiver& a, const SunReceiver& b) {
  return a.centre == b.centre && a.half_across == b.half_across && a.half_up == b.half_up && a.spacing == b.spacing &&
         a.mask == b.mask;
}

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

Result<std::vector<SunRecord>> SunStudy::run(Kept& kept) const {
  const bool is_scene_kept = kept.scene != nullptr && same_casters(casters, kept.casters);
  const bool is_sun_kept = is_scene_kept && same_moments(moments, kept.moments);
  Kept next;
  next.casters.assign(casters.begin(), casters.end());
  next.moments.assign(moments.begin(), moments.end());
  next.receivers.assign(receivers.begin(), receivers.end());
  if (is_scene_kept) {
    next.scene = kept.scene;
  } else {
    auto built = ShadowScene::build(casters);
    if (!built) return built.error();
    next.scene = std::make_shared<const ShadowScene>(std::move(*built));
  }
  for (const SunReceiver& receiver : receivers) {
    SunRecord& record = next.records.emplace_back();
    const auto same = std::find_if(kept.receivers.begin(), kept.receivers.end(),
                                   [&](const SunReceiver& other) { return same_place(receiver, other); });
    if (is_sun_kept && same != kept.receivers.end()) {
      record = kept.records[static_cast<std::size_t>(same - kept.receivers.begin())];
    } else {
      record.grid = sun_grid(receiver.centre, receiver.half_across, receiver.half_up, receiver.spacing, kMostSunPoints);
      record.hours = sun_hours(*next.scene, record.grid.points, moments, receiver.mask, pool);
    }
    judge(receiver.required, record);
  }
  kept = std::move(next);
  return kept.records;
}

}  // namespace bl
