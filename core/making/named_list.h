// Ids within a sentence.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace bl::making {

/// "`a`, `b`"; of many the first eight and how many more there are.
inline std::string named_list(const std::vector<std::string>& ids) {
  constexpr std::size_t kMostNamed = 8;
  std::string list;
  for (std::size_t i = 0; i < ids.size() && i < kMostNamed; ++i) list += (i == 0 ? "`" : ", `") + ids[i] + "`";
  return ids.size() > kMostNamed ? list + " and " + std::to_string(ids.size() - kMostNamed) + " more" : list;
}

}  // namespace bl::making
