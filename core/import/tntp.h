// Reads the TNTP text format for road networks, trip tables, link flows and node places (Transportation Network Test Problems).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/traffic/network.h"

namespace bl::importing {

/// Nodes are named by their numbers; a link is named "1-2", and others between the same nodes "1-2#2" and so on.
struct TntpNetwork {
  std::vector<traffic::TrafficNode> nodes;
  std::vector<traffic::TrafficLink> links;
  std::int64_t zones = 0;          ///< nodes 1 to `zones` are zones
  traffic::CostFactors factors;    ///< 0 where the file says nothing
  std::vector<std::string> notes;  ///< what was assumed, mended or left out, one sentence each
};

struct TntpTrips {
  struct Entry {
    std::string origin, destination;
    double trips = 0;
  };
  std::vector<Entry> entries;  ///< in the order of the file; without those of 0 trips
  std::int64_t zones = 0;
  double total = 0;
  std::vector<std::string> notes;
};

struct TntpFlows {
  struct Entry {
    std::string from, to;
    double volume = 0, cost = 0;
  };
  std::vector<Entry> entries;
  std::vector<std::string> notes;
};

struct TntpPlaces {
  struct Entry {
    std::string node;
    double x = 0, y = 0;
  };
  std::vector<Entry> entries;
  std::vector<std::string> notes;
};

/// Errors have the place `line 12` and say what was expected there. What other programs write too loosely (missing `;`, other
/// orders, missing columns at the end, wrong counts) is read and noted.
Result<TntpNetwork> read_tntp_network(std::string_view text);
Result<TntpTrips> read_tntp_trips(std::string_view text);
Result<TntpFlows> read_tntp_flows(std::string_view text);
Result<TntpPlaces> read_tntp_places(std::string_view text);

}  // namespace bl::importing
