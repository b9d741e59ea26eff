// How the volumes of a brief that stand are joined to buildings: roofs, shared footprints, storeys and cellars.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/making/new_scene.h"
#include "core/making/use_rates.h"

namespace bl::making {

/// What one volume has. Base and host are indices of volumes; without both it has ground of its own.
struct BuildingPart {
  std::optional<std::size_t> base, host;
  bool is_alone_on_roof = true;  ///< no other volume stands on its base
  int storeys = 1;               ///< of the whole building, at its host
  int order = 0;                 ///< among those that share a footprint
  int cellar_storeys = 0;
  double footprint = 0;  ///< estimate of the building's [m²]
  double depth = 0;      ///< of a building, at its host: by its row, else the least that daylight allows its uses [m]; 0: any
  Vector3 offset;        ///< from the position of its base [m]
};

/// Parts of all volumes. `ground` is the area that can be built on [m²], `along` the main direction of the plan. Notes say what
/// became of rows that lie below the ground.
std::vector<BuildingPart> plan_buildings(const SceneParts& parts, const std::vector<NewVolume>& volumes, double ground,
                                         const Vector3& along, std::vector<std::string>& notes);

/// Figures of built uses are not those of open space of the same name, and the other way round; nullptr where none are known.
const UseRates* rates_of(const importing::ProgrammeRow& row);

/// The volume with ground of its own under a volume: itself, or what carries or holds it.
std::size_t root_of(const std::vector<BuildingPart>& plan, std::size_t volume);

}  // namespace bl::making
