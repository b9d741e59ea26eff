// How far one gets from a chosen zone or junction along the streets, on foot or by car: for the eye of whoever has chosen it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/graph/state.h"

namespace bl::desktop {

struct Isochrones {
  /// A part of a street, as shares of the way from its start to its end.
  struct Part {
    std::uint32_t street = 0;  ///< index in the state
    double begin = 0, end = 1;
    std::size_t band = 0;  ///< of `times`, the first that it is reached within
  };
  std::uint32_t node = 0;
  bool is_by_car = false;
  std::vector<double> times;  ///< ascending, as the traffic network says [s]
  double walking_speed = 0;   ///< the same [m/s]
  std::vector<Part> parts;
  std::string reason;     ///< why there are none; empty where there are
  std::string tentative;  ///< why they may not be the last word; empty where they are
};

/// By car the times are those of the state's flows. Nothing where the node is neither a zone nor a junction of a traffic network.
std::shared_ptr<const Isochrones> isochrones_of(const State& state, std::uint32_t node, bool by_car);

}  // namespace bl::desktop
