// Every address is read once, as the connections read it.
#include "core/live/unusable_sensors.h"

#include <string>

#include "core/address/live_address.h"
#include "core/reading/views/stream.h"

namespace bl::live {

std::vector<Error> unusable_sensors(const Scene& scene) {
  std::vector<Error> errors;
  for (const auto& [id, node] : scene.nodes) {
    const std::string address = reading::setting<&reading::SensorFigures::address>(scene, full_registry(), node).value_or("");
    if (address.empty()) continue;
    if (const auto parsed = address::parse_live_address(address); !parsed)
      errors.push_back({parsed.error().code, "nodes/" + id + "/sensor/address",
                        "the address cannot be used: " + parsed.error().message + ". No reading will ever come"});
  }
  return errors;
}

}  // namespace bl::live
