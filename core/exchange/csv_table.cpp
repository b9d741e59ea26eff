// Quoting by RFC 4180.
#include "core/exchange/csv_table.h"

#include <algorithm>

namespace bl {

namespace {

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

}  // namespace

std::string write_csv(std::span<const std::string> header, std::span<const std::vector<CsvCell>> rows) {
  std::string out;
  for (std::size_t i = 0; i < header.size(); ++i) {
    if (i > 0) out += ',';
    append_field(out, header[i], header.size() == 1);
  }
  out += "\r\n";
  for (const std::vector<CsvCell>& row : rows) {
    const std::size_t width = std::max(row.size(), header.size());
    for (std::size_t i = 0; i < width; ++i) {
      if (i > 0) out += ',';
      append_field(out, i < row.size() ? std::string_view(row[i].text) : std::string_view(), width == 1);
    }
    out += "\r\n";
  }
  return out;
}

}  // namespace bl
