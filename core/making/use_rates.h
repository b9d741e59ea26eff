// Figures of common uses for a new scene: people, parking places, trips, sun and noise, each with its source.
#pragma once

#include <string>
#include <string_view>

#include "core/graph/scene.h"

namespace bl::making {

/// By 100 m² of gross floor area where nothing else is said; 0: no figure that we could name a source for.
struct UseRates {
  std::string_view use;
  double people = 0, parking = 0, trips = 0;  ///< trips: by day, both ways and all means together
  double out_share = 0.5;                     ///< of the trips in the morning's hour
  double least_sun = 0;                       ///< [s] a day
  double most_noise = 0;                      ///< [dB(A)] outside, by day
  std::string_view source;
  bool is_open = false;  ///< open space, which has neither volumes nor floor area
};

/// A sentence about the uses of volumes that no node of the scene is the use of; empty where there are none, and in scenes
/// without any use and programme, where nobody looks for figures.
std::string tell_uses_without_figures(const Scene& scene, const Registry& registry);

/// The figures of a use by its name, in one or several; nothing where there are none.
const UseRates* use_rates(std::string_view use);

}  // namespace bl::making
