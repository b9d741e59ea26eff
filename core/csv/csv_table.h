// Writes a table as CSV text by RFC 4180: quotes where needed, decimal points, lines ended by CR LF, and no text that a
// spreadsheet obeys.
#pragma once

#include <concepts>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/text.h"

namespace bl::csv {

/// One field. Numbers become their shortest exact text, with a decimal point whatever the locale; all else is text that people or
/// files of others wrote, and is written so that no spreadsheet takes it for a formula.
struct CsvCell {
  std::string text;
  bool is_number = false;
  CsvCell() = default;
  CsvCell(std::string value) : text(std::move(value)) {}             // NOLINT: implicit on purpose
  CsvCell(std::string_view value) : text(value) {}                   // NOLINT: implicit on purpose
  CsvCell(const char* value) : text(value) {}                        // NOLINT: implicit on purpose
  CsvCell(double value) : text(shortest(value)), is_number(true) {}  // NOLINT: implicit on purpose
  template <std::integral Whole>
  CsvCell(Whole value) : text(std::to_string(value)), is_number(true) {}  // NOLINT: implicit on purpose
};

/// Units belong into the header: "floor_area [m2]". Short rows are filled up with empty fields to the width of the header.
std::string write_csv(std::span<const std::string> header, std::span<const std::vector<CsvCell>> rows);

/// A text as tables carry it: control characters but line ends are blanks, and an apostrophe stands before what spreadsheets
/// would take for the beginning of a formula, also behind a semicolon or a line end.
std::string harmless_text(std::string_view text);
/// The text that `harmless_text` was made of, but for its control characters.
std::string text_of_harmless(std::string_view text);

}  // namespace bl::csv
