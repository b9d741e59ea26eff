// Figures of common uses for a new scene: people, parking places, trips, sun and noise, each with its source.
#pragma once

#include <string>
#include <string_view>
#include <vector>

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
  bool is_open = false;       ///< open space, which has neither volumes nor floor area
  double building_depth = 0;  ///< greatest one that daylight allows, from façade to façade [m]; 0: nothing is known
};

/// A sentence about the uses of volumes that no node of the scene is the use of; empty where there are none, and in scenes
/// without any use and programme, where nobody looks for figures.
std::string tell_uses_without_figures(const Scene& scene, const Registry& registry);

/// The figures of a use by its name: in one or several, by another word for it, or by its last word, as in `Student housing`
/// and `Flats above shops`, whose shops are others. Nothing where there are none. Open space is known by its whole name alone.
const UseRates* use_rates(std::string_view use);

/// A sentence that says which uses were taken for which by a word within their names; empty where none was.
std::string tell_taken_uses(const std::vector<std::string>& uses);

/// Is it a use of cellars, such as underground parking?
bool is_cellar_use(const std::string& use);

}  // namespace bl::making
