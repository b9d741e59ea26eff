// The grammar: sign, digits with grouping marks, one decimal mark, exponent, unit.
#include "core/import/number_column.h"

#include <algorithm>
#include <cmath>

#include "core/base/text.h"
#include "core/csv/csv_reader.h"

namespace bl::importing {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Spaces (plain, no-break, thin, narrow) and apostrophes between digits can only group thousands; they become one
// mark, '_'. The result ends where the number ends; `rest` gets what follows it (exponent, unit).
std::string number_part(std::string_view text, std::string_view& rest) {
  std::string part;
  std::size_t at = 0;
  if (text.starts_with('-') || text.starts_with('+')) part += text[at++];
  while (at < text.size()) {
    const std::string_view tail = text.substr(at);
    std::size_t mark = 0;
    for (const std::string_view space : {" ", "'", "\xC2\xA0", "\xE2\x80\x89", "\xE2\x80\xAF", "\xE2\x80\x99"})
      if (tail.starts_with(space)) mark = space.size();
    if (is_digit(tail[0]) || tail[0] == '.' || tail[0] == ',') {
      part += tail[0];
      ++at;
    } else if (mark > 0 && tail.size() > mark && is_digit(tail[mark]) && !part.empty() && is_digit(part.back())) {
      part += '_';
      at += mark;
    } else {
      break;
    }
  }
  rest = text.substr(at);
  return part;
}

std::size_t count_of(std::string_view text, char c) { return static_cast<std::size_t>(std::count(text.begin(), text.end(), c)); }

// Removes the grouping `mark` from a whole part: one to three digits, then groups of exactly three.
std::optional<std::string> ungrouped(std::string_view whole, char mark) {
  std::string digits;
  std::size_t group = 0, groups = 0;
  for (const char c : whole) {
    if (c == mark) {
      if (group == 0 || group > 3 || (groups > 0 && group != 3)) return std::nullopt;
      ++groups;
      group = 0;
    } else if (c == '-' || c == '+') {
      digits += c;
    } else if (is_digit(c)) {
      digits += c;
      ++group;
    } else {
      return std::nullopt;
    }
  }
  if (groups > 0 && group != 3) return std::nullopt;
  return digits;
}

// The number part with a decimal point and nothing else.
std::optional<std::string> plain_number(const std::string& part, char decimal) {
  const std::size_t split = std::min(part.find(decimal), part.size());
  const std::string_view whole = std::string_view(part).substr(0, split);
  const std::string_view fraction = split < part.size() ? std::string_view(part).substr(split + 1) : std::string_view();
  if (!std::all_of(fraction.begin(), fraction.end(), is_digit)) return std::nullopt;
  const char other = decimal == '.' ? ',' : '.';
  const bool spaced = whole.find('_') != std::string_view::npos;
  auto digits = ungrouped(whole, spaced ? '_' : other);
  if (!digits) return std::nullopt;
  return digits->append(fraction.empty() ? "" : ".").append(fraction);
}

}  // namespace

DecimalEvidence decimal_evidence(std::string_view text) {
  std::string_view rest;
  const std::string part = number_part(csv::trimmed(text), rest);
  const std::size_t points = count_of(part, '.'), commas = count_of(part, ',');
  if (points + commas == 0) return DecimalEvidence::none;
  if (points > 0 && commas > 0) return part.rfind('.') > part.rfind(',') ? DecimalEvidence::point : DecimalEvidence::comma;
  const bool point = points > 0;
  const DecimalEvidence as_decimal = point ? DecimalEvidence::point : DecimalEvidence::comma;
  if (points + commas > 1) return point ? DecimalEvidence::comma : DecimalEvidence::point;
  if (count_of(part, '_') > 0) return as_decimal;  // thousands are marked by spaces already
  const std::size_t mark = part.find(point ? '.' : ','), sign = part[0] == '-' || part[0] == '+' ? 1 : 0;
  const bool like_thousands = part.size() - mark == 4 && mark - sign >= 1 && mark - sign <= 3 && part[sign] != '0';
  return like_thousands ? DecimalEvidence::ambiguous : as_decimal;
}

Result<char> column_decimal(std::span<const NumberField> fields, const std::string& column) {
  const NumberField *point = nullptr, *comma = nullptr;
  for (const NumberField& field : fields) {
    const DecimalEvidence evidence = decimal_evidence(field.text);
    if (evidence == DecimalEvidence::point && !point) point = &field;
    if (evidence == DecimalEvidence::comma && !comma) comma = &field;
  }
  if (point && comma)
    return Error{ErrorCode::conflict, column,
                 "The decimal mark changes: `" + point->text + "` in line " + std::to_string(point->line) + " has a point, `" +
                     comma->text + "` in line " + std::to_string(comma->line) +
                     " a comma. Write all numbers of the column alike."};
  return point ? '.' : comma ? ',' : '\0';
}

std::optional<double> parse_table_number(std::string_view text, char decimal, Unit expected, std::string_view unit_symbol) {
  std::string_view rest;
  const std::string part = number_part(csv::trimmed(text), rest);
  const auto plain = plain_number(part, decimal == ',' ? ',' : '.');
  if (!plain || plain->empty()) return std::nullopt;
  std::string quantity = *plain + std::string(rest);
  if (parse_number(quantity) && !unit_symbol.empty()) quantity.append(" ").append(unit_symbol);
  const auto value = parse_quantity(quantity, expected);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

}  // namespace bl::importing
