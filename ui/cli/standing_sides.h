// Reads what holds for each kind of side of standing volumes: party walls, the border of the plot, streets and courtyards.
#pragma once

#include <string>
#include <vector>

#include "core/geometry/footprint.h"
#include "ui/cli/json_fields.h"

namespace bl::cli {

struct StandingSides {
  geometry::StandingSite rules;    ///< its distances, walls and depth of wings; nothing else
  std::vector<double> courtyards;  ///< of the storeys from the ground up [m]; the last one holds on
  std::vector<geometry::StreetAxis> streets;
};

/// The object under `sides` of a form, all defaults where there is none.
Result<StandingSides> read_sides(const Json& form, const std::string& place);
/// Distances of the storeys from the ground up under a key; none where it is missing.
Result<std::vector<double>> distances_at(const Json& object, const char* key, const std::string& noun, const std::string& place);
/// Storeys from the ground up as runs of the same set-backs.
std::vector<geometry::StoreyRun> runs_of(int storeys, const std::vector<double>& setbacks, const std::vector<double>& courtyards);

}  // namespace bl::cli
