// Numbers in sentences: one building, two buildings, 1000000 m².
#pragma once

#include <cmath>
#include <cstddef>
#include <string>

#include "core/base/text.h"

namespace bl {

/// "1 building", "2 buildings"; `plural` where it is not made by an s.
inline std::string how_many(std::size_t count, const std::string& singular, const std::string& plural = "") {
  return std::to_string(count) + " " + (count == 1 ? singular : plural.empty() ? singular + "s" : plural);
}

/// A number that people wrote, as they would write it: whole ones without an exponent.
inline std::string written_out(double number) {
  return std::abs(number) < 1e15 && number == std::floor(number) ? fixed(number, 0) : shortest(number);
}

/// The word that belongs to a count: "is" or "are", "was" or "were".
inline const char* by_number(std::size_t count, const char* one, const char* several) { return count == 1 ? one : several; }

}  // namespace bl
