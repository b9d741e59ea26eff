// Numbers of things in sentences: one building, two buildings.
#pragma once

#include <cstddef>
#include <string>

namespace bl {

/// "1 building", "2 buildings"; `plural` where it is not made by an s.
inline std::string how_many(std::size_t count, const std::string& singular, const std::string& plural = "") {
  return std::to_string(count) + " " + (count == 1 ? singular : plural.empty() ? singular + "s" : plural);
}

/// The word that belongs to a count: "is" or "are", "was" or "were".
inline const char* by_number(std::size_t count, const char* one, const char* several) { return count == 1 ? one : several; }

}  // namespace bl
