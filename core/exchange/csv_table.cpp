// Quoting by RFC 4180; texts are defused, because a table is opened by programs that run what begins with a sign of a formula.
#include "core/exchange/csv_table.h"

#include <algorithm>
#include <array>

namespace bl {

namespace {

// The signs by which spreadsheets know formulas, and the same in full width, which East Asian ones take for them.
constexpr std::array<std::string_view, 8> kFormulaSigns{
    "=", "+", "-", "@", "\xEF\xBC\x9D", "\xEF\xBC\x8B", "\xEF\xBC\x8D", "\xEF\xBC\xA0"};

// Would a spreadsheet read it as a formula? Blanks before the sign are dropped by some of them. `marks`: apostrophes that stand
// before the sign do not count, as they are what was put there.
bool is_like_a_formula(std::string_view text, bool marks) {
  const std::size_t first = text.find_first_not_of(marks ? " \t\r\n'" : " \t\r\n");
  if (first == std::string_view::npos) return false;
  text.remove_prefix(first);
  return std::any_of(kFormulaSigns.begin(), kFormulaSigns.end(), [&](std::string_view sign) { return text.starts_with(sign); });
}

// Fields with blanks at an end are quoted too: many readers strip them otherwise.
void append_field(std::string& out, std::string_view text, bool alone) {
  const bool blank_ends =
      !text.empty() && (text.front() == ' ' || text.back() == ' ' || text.front() == '\t' || text.back() == '\t');
  // An empty line is no record for many readers: a lone empty field is written as quotes.
  if (text.find_first_of(",\"\r\n") == std::string_view::npos && !blank_ends && !(alone && text.empty())) {
    out += text;
    return;
  }
  out += '"';
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  out += '"';
}

void append_cell(std::string& out, const CsvCell& cell, bool alone) {
  if (cell.is_number) append_field(out, cell.text, alone);
  else append_field(out, harmless_text(cell.text), alone);
}

}  // namespace

std::string harmless_text(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    // The second half of the control characters takes two bytes: U+0080 to U+009F.
    const bool is_second_half = byte == 0xC2 && i + 1 < text.size() && (static_cast<unsigned char>(text[i + 1]) & 0xE0u) == 0x80u;
    if (is_second_half) ++i;
    if (byte == '\r' && i + 1 < text.size() && text[i + 1] == '\n') continue;
    out += is_second_half || (byte < 0x20 && byte != '\n') || byte == 0x7F ? ' ' : text[i];
  }
  // What looks as if a mark had been put before it gets one more, so that the mark can be taken away again.
  return is_like_a_formula(out, true) && (out.starts_with('\'') || is_like_a_formula(out, false)) ? "'" + out : out;
}

std::string text_of_harmless(std::string_view text) {
  if (text.starts_with('\'') && is_like_a_formula(text, true)) text.remove_prefix(1);
  return std::string(text);
}

std::string write_csv(std::span<const std::string> header, std::span<const std::vector<CsvCell>> rows) {
  std::string out;
  for (std::size_t i = 0; i < header.size(); ++i) {
    if (i > 0) out += ',';
    append_cell(out, header[i], header.size() == 1);
  }
  out += "\r\n";
  for (const std::vector<CsvCell>& row : rows) {
    const std::size_t width = std::max(row.size(), header.size());
    for (std::size_t i = 0; i < width; ++i) {
      if (i > 0) out += ',';
      append_cell(out, i < row.size() ? row[i] : CsvCell(), width == 1);
    }
    out += "\r\n";
  }
  return out;
}

}  // namespace bl
