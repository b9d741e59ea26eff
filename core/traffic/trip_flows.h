// The flows of the trips of each zone of a network, for views and exporters.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/number_list.h"

namespace bl::traffic {

struct TripFlows {
  static constexpr std::string_view kMadeName = "flows of trips";  ///< as nodes hand it on
  struct Zone {
    std::string id;
    Indices links;  ///< those that its trips are on, each once
    Numbers flows;  ///< trips per hour on these
  };
  std::vector<std::string> places;  ///< per link: the id of the street, zone or junction that it belongs to
  std::vector<Zone> zones;
};

/// The flows in what a network remembers: rows of `links`, each named by its place and what of it ("street:forth"), and rows of
/// `ways`. Works with any shared table that hands out texts and lists by row and column.
template <class SharedTable>
std::shared_ptr<const TripFlows> read_flows(const SharedTable& links, const SharedTable& ways) {
  auto flows = std::make_shared<TripFlows>();
  for (std::size_t l = 0; l < links->rows.size(); ++l) {
    const std::string& link = links->text(l, "link");
    flows->places.push_back(link.substr(0, link.rfind(':')));
  }
  for (std::size_t r = 0; r < ways->rows.size(); ++r)
    flows->zones.push_back({ways->text(r, "zone"), ways->indices(r, "links"), ways->numbers(r, "flows")});
  return flows;
}

}  // namespace bl::traffic
