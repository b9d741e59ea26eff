// The account of open space: ground that briefs ask for, and ground that boundaries keep open for the same use.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "core/graph/state.h"

namespace bl::reading {

/// A use that is open space, such as a garden: it has ground that nobody builds on, and neither volumes nor floor area.
struct OpenAccount {
  std::string use;
  bool is_in_programme = false;
  double asked = 0;  ///< by all rows and items of programmes [m²]
  double area = 0;   ///< that boundaries keep open [m²]
  double drawn = 0;  ///< of its polygons, parts outside of boundaries or on other exclusions included [m²]

  double roofed = 0;  ///< of its polygons that end below the top of their boundary [m²]

  double missing() const;
  /// As a share of what is asked for, from 0 to 1.
  double missing_share() const;
  bool is_short(double tolerance) const { return missing_share() > tolerance; }
  bool operator==(const OpenAccount&) const = default;
};

/// The uses that their nodes declare to be open space, in small letters: rows, uses and ground are the same in large ones.
std::set<std::string> open_uses(const State& state);
/// Those that programmes ask for in the order of their rows, then others that boundaries keep open, by name.
std::vector<OpenAccount> open_accounts(const State& state);
/// All together, as the use "all".
OpenAccount sum_of(const std::vector<OpenAccount>& accounts);
/// Why there is less than asked for, and what to do; empty where it is enough.
std::string why_short(const OpenAccount& account, double tolerance);

/// The same as a sentence of its own: "600 m² of open space are asked for, and 400 m² are there: ...".
std::string shortage_of(const OpenAccount& account, double tolerance);

}  // namespace bl::reading
