// Numbers in tables by people: decimal point or comma, thousands marks, units; the format is found per column, and never guessed.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/base/unit.h"

namespace bl::importing {

/// A field of a column of numbers, and where it stands.
struct NumberField {
  std::size_t line = 0;
  std::string text;
};

/// The evidence of one number about the decimal mark of its column.
enum class DecimalEvidence {
  none,       ///< "1200", "1 200"
  point,      ///< "12.5", "1,200.5", "1,200,000"
  comma,      ///< "12,5", "1.200,5", "1.200.000"
  ambiguous,  ///< "1.200", "1,200": a fraction, or a thousand two hundred
};
DecimalEvidence decimal_evidence(std::string_view text);

/// The decimal mark of a column ('.' or ','), 0 where no field tells, or an error where two fields contradict each other.
/// `column` is how the column is called in messages.
Result<char> column_decimal(std::span<const NumberField> fields, const std::string& column);

/// The number in SI units. `decimal` is '.' or ',', or 0 where it does not matter; `unit_symbol` is the unit of numbers that
/// come without one.
/// An empty answer means "no number of that kind".
std::optional<double> parse_table_number(std::string_view text, char decimal, Unit expected, std::string_view unit_symbol);

}  // namespace bl::importing
