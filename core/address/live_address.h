// Addresses of live data: where readings come from, and where messages go.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace bl::address {

/// An address taken apart. What a scheme does not use stays empty.
struct LiveAddress {
  enum class Scheme { mqtt, osc, http, replay };
  Scheme scheme = Scheme::mqtt;
  std::string host;                            ///< mqtt and osc
  int port = 0;                                ///< mqtt and osc
  std::string path;                            ///< topic; OSC path with its slash; the whole URL; the file of a recording
  std::string column;                          ///< replay: the column of the readings
  std::string time;                            ///< replay: the columns of the time, with `+` between; empty: found
  std::map<std::string, std::string> filters;  ///< replay: what a row has to hold to count, by column
};

/// `mqtt://host:1883/topic`, `osc://9000/path`, `osc://host:9000/path`, `http://...`, `https://...`,
/// `replay:FILE?COLUMN=TEXT&time=COLUMN#COLUMN`; else an error that says what is wrong.
Result<LiveAddress> parse_live_address(std::string_view text);

}  // namespace bl::address
