// Devices sign with their address and are marked as devices, so that no undo reverses a reading.
#include "core/host/device_door.h"

#include <algorithm>
#include <optional>

#include "core/reading/views/stream.h"

namespace bl::host {

namespace {

constexpr double kUsualTick = 0.05;  // [s] where there is no sensor

}  // namespace

double tick_length(const Scene& scene, const Registry& registry) {
  std::optional<double> shortest;
  for (const auto& [id, node] : scene.nodes)
    for (const auto& seconds : {reading::setting<&reading::SensorFigures::tick_length>(scene, registry, node),
                                reading::setting<&reading::PeopleFigures::tick_length>(scene, registry, node)})
      if (seconds) shortest = std::min(shortest.value_or(*seconds), *seconds);
  return shortest && *shortest > 0 ? *shortest : kUsualTick;
}

bool has_recordings(const Scene& scene, const Registry& registry) {
  return std::any_of(scene.nodes.begin(), scene.nodes.end(), [&](const auto& entry) {
    const auto plays = [](const std::optional<std::string>& address) { return address && address->starts_with("replay:"); };
    return plays(reading::setting<&reading::SensorFigures::address>(scene, registry, entry.second)) ||
           plays(reading::setting<&reading::PeopleFigures::address>(scene, registry, entry.second));
  });
}

bool DeviceDoor::follow(const Scene& scene, std::int64_t last_seq) {
  if (followed_ == last_seq) return false;
  followed_ = last_seq;
  connections_.follow(scene);
  return true;
}

std::vector<Error> DeviceDoor::bring(std::int64_t tick, const std::function<Result<void>(Submission)>& submit) {
  std::vector<Error> refused;
  for (live::Report& report : connections_.collect(tick)) {
    const std::string address = report.author.id;
    auto done = submit({std::move(report.command), std::move(report.author), 0, {"connection"}, {}});
    if (!done) refused.push_back(done.error().within(address));
  }
  return refused;
}

}  // namespace bl::host
