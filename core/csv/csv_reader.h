// Splits a CSV text into records, whatever its separator, line ends and encoding, and keeps the line of each record.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace bl::csv {

/// One record; `line` is the line of the text where it starts, counted from 1.
struct CsvRecord {
  std::size_t line = 0;
  std::vector<std::string> fields;  ///< UTF-8, without surrounding spaces
};

struct CsvText {
  char separator = ',';
  std::vector<CsvRecord> records;  ///< without empty ones; the header is the first
  std::vector<std::string> notes;
};

/// `separator`: comma, semicolon or tab; nothing: the one that stands most often in the first line.
Result<CsvText> read_csv(std::string_view text, std::optional<char> separator = std::nullopt);

/// Without the spaces, tabs and no-break spaces at both ends.
std::string_view trimmed(std::string_view text);

}  // namespace bl::csv
