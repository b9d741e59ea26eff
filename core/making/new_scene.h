// Builds a first scene from a plan and a programme, by commands only.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/import/plan_boundary.h"
#include "core/import/programme_csv.h"
#include "core/making/open_places.h"
#include "core/session/commands.h"

namespace bl::making {

/// The link that keeps positions inside the site.
inline constexpr const char* kInsideLink = "inside";

/// The input of a new scene.
struct SceneParts {
  std::string title;
  importing::GeoReference reference;
  geometry::Ring plan;                ///< counter-clockwise
  std::vector<geometry::Ring> holes;  ///< clockwise
  double height = 0, margin = 0;      ///< [m]
  bool is_standing = false;           ///< volumes stand in whole storeys; else they are cells cut to balls
  importing::ProgrammeImport programme;
  std::vector<OpenPlace> open_places;  ///< of its rows that are open space
  std::uint64_t seed = 1;

  double open_area() const {
    double area = 0;
    for (const OpenPlace& place : open_places) area += place.area;
    return area;
  }
};

/// One SmartVolume to be: an item of a row of the programme.
struct NewVolume {
  std::string id, name;
  std::size_t row = 0;
  double demand = 0;  ///< [m³]
  Point3 position;
};

/// Items of one use that should touch one item of another use: both are indices of volumes.
struct WantedContact {
  std::size_t hub = 0;
  std::vector<std::size_t> partners;  ///< ascending
};

/// The items of all rows with ids of their own, positions not yet given.
std::vector<NewVolume> volumes_of(const importing::ProgrammeImport& programme);
/// The wanted adjacencies from the column adjacent_to: the items of the more numerous use are divided evenly among those of the
/// other.
std::vector<WantedContact> contacts_of(const importing::ProgrammeImport& programme, const std::vector<NewVolume>& volumes);
/// The scene as one command, positions spread by the seed.
struct NewSceneCommand {
  Command command;
  std::vector<std::string> notes;  ///< what became of rows that have no volumes
  double footprints = 0;           ///< [m²] of all buildings on the ground, by their storeys; 0 where they do not stand
};
Result<NewSceneCommand> new_scene_command(const SceneParts& parts);

}  // namespace bl::making
