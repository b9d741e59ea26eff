// Isochrones as people draw them: which part of each street is reached first within which of several times.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/traffic/district.h"
#include "core/traffic/shortest_paths.h"

namespace bl::traffic {

/// A street between two junctions, and what it takes to go along it [s]; kUnreached where nobody may.
struct ReachStreet {
  std::string id, start, end;  ///< ids; start and end of junctions
  double forth = kUnreached, back = kUnreached;
};

/// A junction where one enters the streets, and how long it takes to get there [s].
struct ReachEntry {
  std::string junction;
  double seconds = 0;
};

/// A part of a street as shares of its length, measured from its start.
struct ReachedPart {
  std::size_t street = 0, band = 0;  ///< as given; of the times, the first that it is reached within
  double begin = 0, end = 1;
  bool operator==(const ReachedPart&) const = default;
};

/// Ascending street and share; what is out of reach is left out. `times` ascending [s]. Entries at junctions that no street has
/// lead nowhere. Rules of turning hold as they do for the trips of a district. An error's place is the id of what is wrong.
Result<std::vector<ReachedPart>> reached_parts(std::span<const ReachStreet> streets, std::span<const ReachEntry> entries,
                                               std::span<const double> times, std::span<const DistrictRules> rules = {});

}  // namespace bl::traffic
