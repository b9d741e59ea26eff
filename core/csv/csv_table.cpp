// Quoting by RFC 4180; texts are defused, because a table is opened by programs that run what begins with a sign of a formula.
#include "core/csv/csv_table.h"

#include <algorithm>
#include <array>

namespace bl::csv {

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
  // An empty line is no record for many readers: a lone empty field is written as quotes. Semicolons part cells where commas
  // stand in numbers.
  if (text.find_first_of(",;\"\r\n") == std::string_view::npos && !blank_ends && !(alone && text.empty())) {
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

// Where a spreadsheet may begin a cell in the middle of a text: behind a semicolon where these part cells, and behind a line end,
// because a quote that does not begin a cell quotes nothing for it.
bool may_begin_a_cell(std::string_view text, std::size_t at) { return at == 0 || text[at - 1] == ';' || text[at - 1] == '\n'; }

// What looks as if a mark had been put before it gets one more, so that the mark can be taken away again.
bool needs_a_mark(std::string_view text) {
  return is_like_a_formula(text, true) && (text.starts_with('\'') || is_like_a_formula(text, false));
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
  std::string marked;
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (may_begin_a_cell(out, i) && needs_a_mark(std::string_view(out).substr(i))) marked += '\'';
    marked += out[i];
  }
  return marked;
}

std::string text_of_harmless(std::string_view text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i)
    if (!(text[i] == '\'' && may_begin_a_cell(text, i) && is_like_a_formula(text.substr(i), true))) plain += text[i];
  return plain;
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

}  // namespace bl::csv
