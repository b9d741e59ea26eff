// What rules of height know of a building that several volumes share: they limit its storeys, not the part of one volume.
#pragma once

#include <optional>
#include <string>

#include "core/define/value.h"
#include "core/demand/storey_limit.h"

namespace bl::demand {

/// A building, as its solver hands it to each volume that shares it. A limit of height on one of them is one on the building,
/// above its lowest floor.
struct Building {
  std::string host;                     ///< whose footprint, storeys and least storeys are those of the building
  int wished = 0, least = 1, held = 0;  ///< storeys
  double storey_height = 3;             ///< by which a limit counts storeys [m]
  double bottom = 0, top = 0;           ///< of all [m]
  double limit = 0;                     ///< the least one of those who share it [m above the bottom]
  double part = 1;                      ///< of this one in the floor area that all ask for
  std::string limited_by = {};          ///< whose limit is the least; of equal ones that of the host
  bool operator==(const Building&) const = default;
};

/// One row, or none.
Table table_of(const std::optional<Building>& building);
/// Nothing of a volume that has a building of its own: its table has no rows.
std::optional<Building> building_in(const std::optional<Shared<Table>>& table);

/// What a rule knows of `own` volume, or of the building that it shares. Whether its limit is locked is its own.
StandingVolume standing_in(StandingVolume own, const std::optional<Building>& building);
/// Where the storeys begin that a limit counts; `own`: the lowest floor of the volume [m].
double ground_below(const std::optional<Building>& building, double own);
/// Who has the storeys: the host, or itself.
const std::string& holder_of(const std::optional<Building>& building, const std::string& own);
/// The same for a sentence: "the building of `shops`", or "`tower`".
std::string named_holder(const std::optional<Building>& building, const std::string& own);
/// Why it does not move by itself; empty where it does: "`flats` stands where `shops` does, whose footprint it shares".
std::string why_it_stays(const std::optional<Building>& building, const std::string& own);

}  // namespace bl::demand
