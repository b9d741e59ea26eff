// Adds rules, sun and gardens to a scene, each by one command, for the command line and the window.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/define/command_builder.h"
#include "core/graph/scene.h"

namespace bl::making {

/// What can be added, as people name it.
inline constexpr const char* kAdditions[] = {"rules", "sun", "garden"};

/// Building rules of a plot; what is not given stays as it is.
struct RuleAddition {
  std::string plot;  ///< id of a plot, or of a boundary that becomes one; empty: the only one of the scene
  std::optional<double> fsi, gsi;
  std::optional<double> height, setback;  ///< [m]
};
/// A sun over the scene, and a study of the shadows of all volumes and buildings.
struct SunAddition {
  std::optional<double> latitude, longitude;  ///< [degree]; nothing: where the scene lies
  std::string date;                           ///< such as 2026-03-21; empty: stays as it is
  std::optional<double> utc_offset;           ///< [h]; nothing: by the longitude
  bool is_given() const { return latitude || longitude || !date.empty() || utc_offset; }
};
/// A garden whose sun is protected.
struct GardenAddition {
  std::string id;                    ///< of a node that is a garden or becomes one; empty: a new node
  std::vector<std::string> corners;  ///< each "X,Y" [m]; three or more
  std::optional<double> hours;       ///< of sun a day
  std::optional<double> share;       ///< of its area that has them; of a new garden a half (BRE report 209)
  bool is_open = false;              ///< boundaries leave its ground out: open space that nobody builds on
  std::string use;                   ///< of that open space; empty: of the only open row of the programme, else `garden`
  SunAddition sun;                   ///< used where something of it is given, or the scene has no sun study
};

struct Addition {
  Command command;
  std::vector<std::string> said;  ///< one sentence for each thing that was done or assumed
};

Result<Addition> add_rules(const Scene& scene, const Registry& registry, const RuleAddition& rules);
Result<Addition> add_sun(const Scene& scene, const Registry& registry, const SunAddition& sun);
Result<Addition> add_garden(const Scene& scene, const Registry& registry, const GardenAddition& garden);

}  // namespace bl::making
