// CSV by libcsv in its strict mode, fed line by line so that every record knows where it starts.
#include "core/csv/csv_reader.h"

#include <csv.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "core/base/foreign_bytes.h"
#include "core/base/plural.h"
#include "core/base/stop_check.h"
#include "core/base/text.h"

namespace bl::csv {

namespace {

// Windows-1252 from 0x80 to 0x9F; zero where it has no character. Above that it equals Latin-1.
constexpr std::array<std::uint16_t, 32> kWindows = {
    0x20AC, 0,      0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021, 0x02C6, 0x2030, 0x0160, 0x2039, 0x0152, 0, 0x017D, 0,
    0,      0x2018, 0x2019, 0x201C, 0x201D, 0x2022, 0x2013, 0x2014, 0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0, 0x017E, 0x0178};

// Length of the UTF-8 sequence at `at`, or 0 where there is none (overlong forms and surrogates are none).
std::size_t sequence_length(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const unsigned lead = byte(at), next = byte(at + 1);
  if (lead < 0x80) return 1;
  const std::size_t length = lead >= 0xC2 && lead <= 0xDF ? 2 : (lead & 0xF0) == 0xE0 ? 3 : lead >= 0xF0 && lead <= 0xF4 ? 4 : 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(at + i) & 0xC0) != 0x80) return 0;
  if ((lead == 0xE0 && next < 0xA0) || (lead == 0xED && next > 0x9F) || (lead == 0xF0 && next < 0x90) ||
      (lead == 0xF4 && next > 0x8F))
    return 0;
  return length;
}

bool is_utf8(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = sequence_length(text, at);
    if (length == 0) return false;
    at += length;
  }
  return true;
}

std::size_t line_at(std::string_view text, std::size_t at) {
  return 1 + static_cast<std::size_t>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

Result<std::string> from_windows(std::string_view text) {
  std::string out;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const auto byte = static_cast<unsigned char>(text[at]);
    const unsigned code = byte >= 0x80 && byte < 0xA0 ? kWindows[byte - 0x80] : byte;
    if (code == 0)
      return Error{ErrorCode::parse, "line " + std::to_string(line_at(text, at)),
                   "The text is neither UTF-8 nor Windows-1252 (Latin-1). Save the file as CSV in UTF-8."};
    if (code < 0x80) {
      out += static_cast<char>(code);
    } else if (code < 0x800) {
      out += static_cast<char>(0xC0 | (code >> 6));
      out += static_cast<char>(0x80 | (code & 0x3F));
    } else {
      out += static_cast<char>(0xE0 | (code >> 12));
      out += static_cast<char>(0x80 | ((code >> 6) & 0x3F));
      out += static_cast<char>(0x80 | (code & 0x3F));
    }
  }
  return out;
}

// UTF-8 with \n at the line ends and without byte order mark.
Result<std::string> tidy_text(std::string_view text, std::vector<std::string>& notes) {
  if (auto foreign = foreign_bytes(text, "CSV table", "save it as CSV in UTF-8")) return *foreign;
  if (text.find('\0') != std::string_view::npos)
    return Error{ErrorCode::parse, "line " + std::to_string(line_at(text, text.find('\0'))),
                 "From here on this is no text: the table is damaged. Save it as CSV in UTF-8."};
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  std::string tidy;
  tidy.reserve(text.size() + 1);
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\r') tidy += text[i];
    else if (i + 1 == text.size() || text[i + 1] != '\n') tidy += '\n';
  }
  if (is_utf8(tidy)) return tidy;
  auto converted = from_windows(tidy);
  if (converted) notes.push_back("The text is not UTF-8; it was read as Windows-1252 (Latin-1). Check letters with accents.");
  return converted;
}

char detect_separator(std::string_view text) {
  constexpr std::array<char, 3> kCandidates = {'\t', ';', ','};  // in this order where they tie: commas also stand in words
  std::array<std::size_t, 3> counts{};
  bool quoted = false, content = false;
  for (const char c : text) {
    if (c == '"') quoted = !quoted;
    if (quoted) continue;
    if (c == '\n' && content) break;
    content = content || (c != '\n' && c != ' ');
    for (std::size_t k = 0; k < 3; ++k) counts[k] += c == kCandidates[k] ? 1 : 0;
  }
  std::size_t best = 2;
  for (const std::size_t k : {1u, 0u})
    if (counts[k] >= counts[best] && counts[k] > 0) best = k;
  return kCandidates[best];
}

// What libcsv calls back into.
struct Collector {
  CsvRecord record;
  bool ended = false;
  static void field(void* bytes, std::size_t size, void* self) {
    const char* text = static_cast<const char*>(bytes);
    static_cast<Collector*>(self)->record.fields.emplace_back(trimmed(std::string_view(text ? text : "", text ? size : 0)));
  }
  static void row(int, void* self) { static_cast<Collector*>(self)->ended = true; }
};

// Owns the buffers of one libcsv parser.
struct Parser {
  csv_parser state{};
  explicit Parser(char separator) {
    csv_init(&state, CSV_STRICT | CSV_STRICT_FINI);
    csv_set_delim(&state, static_cast<unsigned char>(separator));
  }
  ~Parser() { csv_free(&state); }
  Parser(const Parser&) = delete;
  Parser& operator=(const Parser&) = delete;
};

// Takes the finished record over; records whose fields are all empty are counted only.
void keep_record(Collector& collector, CsvText& csv, std::size_t& empty) {
  const auto& fields = collector.record.fields;
  const bool has_text = std::any_of(fields.begin(), fields.end(), [](const std::string& field) { return !field.empty(); });
  if (has_text) csv.records.push_back(std::move(collector.record));
  else ++empty;
  collector = Collector{};
}

Result<void> parse_lines(std::string_view text, std::size_t first_line, CsvText& csv) {
  Parser parser(csv.separator);
  Collector collector;
  std::size_t empty = 0;
  bool in_record = false;
  for (std::size_t line = first_line; !text.empty(); ++line) {
    if (line % 4096 == 0 && is_stop_wished()) return Error{ErrorCode::cancelled, "", "Reading the table was stopped."};
    const std::size_t length = std::min(text.find('\n'), text.size() - 1) + 1;
    const std::string_view piece = text.substr(0, length);
    text.remove_prefix(length);
    if (!in_record) {
      if (trimmed(piece.substr(0, piece.find('\n'))).empty()) continue;
      collector.record.line = line;
      in_record = true;
    }
    if (csv_parse(&parser.state, piece.data(), piece.size(), Collector::field, Collector::row, &collector) != piece.size())
      return Error{
          ErrorCode::parse, "line " + std::to_string(line),
          "A double quote stands in the wrong place. Quote the whole field and double the quotes inside it: \"a \"\"b\"\" c\"."};
    if (!collector.ended) continue;
    keep_record(collector, csv, empty);
    in_record = false;
  }
  const std::size_t line = collector.record.line;
  if (csv_fini(&parser.state, Collector::field, Collector::row, &collector) != 0)
    return Error{ErrorCode::parse, "line " + std::to_string(line),
                 "A double quote opens a field in this record and is never closed. Close or remove it."};
  if (collector.ended) keep_record(collector, csv, empty);
  if (empty > 0)
    csv.notes.push_back(how_many(empty, "row") + " without any text " + by_number(empty, "was", "were") + " skipped.");
  return {};
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  const auto blank_front = [&] {
    return text.starts_with("\xC2\xA0") ? 2u : text.starts_with(' ') || text.starts_with('\t') ? 1u : 0u;
  };
  const auto blank_back = [&] { return text.ends_with("\xC2\xA0") ? 2u : text.ends_with(' ') || text.ends_with('\t') ? 1u : 0u; };
  while (const std::size_t length = blank_front()) text.remove_prefix(length);
  while (const std::size_t length = blank_back()) text.remove_suffix(length);
  return text;
}

Result<CsvText> read_csv(std::string_view text, std::optional<char> separator) {
  CsvText csv;
  auto tidy = tidy_text(text, csv.notes);
  if (!tidy) return tidy.error();
  std::string_view body = *tidy;
  std::size_t first_line = 1;
  // Some spreadsheets announce the separator in a first line "sep=;".
  if (lower_case(body.substr(0, 4)) == "sep=" && body.size() > 5 && body[5] == '\n') {
    if (!separator) separator = body[4];
    body.remove_prefix(6);
    first_line = 2;
  }
  csv.separator = separator ? *separator : detect_separator(body);
  if (csv.separator != ',' && csv.separator != ';' && csv.separator != '\t')
    return Error{ErrorCode::parse, "separator",
                 std::string("The separator `") + csv.separator + "` is not read. Use a comma, a semicolon or a tab."};
  if (auto done = parse_lines(body, first_line, csv); !done) return done.error();
  return csv;
}

}  // namespace bl::csv
