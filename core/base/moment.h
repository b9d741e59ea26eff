// Moments of the calendar as text.
#pragma once

#include <cstdint>
#include <string>

namespace bl {

/// "2026-03-01 09:30 UTC" of milliseconds since 1970; empty where no calendar has that year.
std::string moment_text(std::int64_t milliseconds);

}  // namespace bl
