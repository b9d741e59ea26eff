// Writes a table as CSV text by RFC 4180: quotes where needed, decimal points, lines ended by CR LF.
#pragma once

#include <concepts>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/text.h"

namespace bl {

/// One field; numbers become their shortest exact text, with a decimal point whatever the locale.
struct CsvCell {
  std::string text;
  CsvCell() = default;
  CsvCell(std::string value) : text(std::move(value)) {}  // NOLINT: implicit on purpose
  CsvCell(std::string_view value) : text(value) {}        // NOLINT: implicit on purpose
  CsvCell(const char* value) : text(value) {}             // NOLINT: implicit on purpose
  CsvCell(double value) : text(shortest(value)) {}        // NOLINT: implicit on purpose
  template <std::integral Whole>
  CsvCell(Whole value) : text(std::to_string(value)) {}  // NOLINT: implicit on purpose
};

/// Units belong into the header: "floor_area [m2]". Short rows are filled up with empty fields to the width of the header.
std::string write_csv(std::span<const std::string> header, std::span<const std::vector<CsvCell>> rows);

}  // namespace bl
