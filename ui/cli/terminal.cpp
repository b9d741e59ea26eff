// Standard output and standard error of the program.
#include "ui/cli/terminal.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>

namespace bl::cli {

namespace {

bool wants_colours() {
  static const bool kWanted = [] {
    const char* no_colour = std::getenv("NO_COLOR");
    const char* terminal = std::getenv("TERM");
    return ::isatty(STDOUT_FILENO) == 1 && (no_colour == nullptr || *no_colour == '\0') &&
           !(terminal != nullptr && std::string_view(terminal) == "dumb");
  }();
  return kWanted;
}

bool errors_go_to_a_terminal() {
  static const bool kTerminal = ::isatty(STDERR_FILENO) == 1;
  return kTerminal;
}

std::string_view code_of(Colour colour) {
  switch (colour) {
    case Colour::plain: return "";
    case Colour::bold: return "\033[1m";
    case Colour::dim: return "\033[2m";
    case Colour::red: return "\033[31m";
    case Colour::green: return "\033[32m";
    case Colour::yellow: return "\033[33m";
  }
  return "";
}

struct Character {
  unsigned code = 0;
  std::size_t length = 1;  // in bytes
  bool is_sound = false;   // as UTF-8 (RFC 3629)
};

Character character_at(std::string_view text, std::size_t at) {
  const unsigned lead = static_cast<unsigned char>(text[at]);
  if (lead < 0x80) return {lead, 1, true};
  const std::size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4 || at + length > text.size()) return {lead, 1, false};
  unsigned code = lead & (0xffu >> (length + 1));
  for (std::size_t k = 1; k < length; ++k) {
    const unsigned next = static_cast<unsigned char>(text[at + k]);
    if ((next & 0xc0u) != 0x80u) return {lead, 1, false};
    code = code << 6 | (next & 0x3fu);
  }
  const unsigned least = length == 2 ? 0x80u : length == 3 ? 0x800u : 0x10000u;
  if (code < least || code > 0x10ffff || (code >= 0xd800 && code <= 0xdfff)) return {lead, 1, false};
  return {code, length, true};
}

// Control characters (C0, DEL, C1), and the marks that turn or break lines without being seen (Unicode 15, 5.8 and 23.2).
bool is_obeyed(const Character& character) {
  const unsigned code = character.code;
  return !character.is_sound || code < 0x20 || (code >= 0x7f && code < 0xa0) || (code >= 0x200e && code <= 0x200f) ||
         (code >= 0x2028 && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069) || code == 0x061c || code == 0xfeff;
}

void append_code(std::string& out, const Character& character, unsigned char byte) {
  char buffer[16];
  if (character.code == '\n') std::snprintf(buffer, sizeof buffer, "\\n");
  else if (character.code == '\t') std::snprintf(buffer, sizeof buffer, "\\t");
  else if (character.is_sound && character.code >= 0x80) std::snprintf(buffer, sizeof buffer, "\\u%04x", character.code);
  else std::snprintf(buffer, sizeof buffer, "\\x%02x", byte);
  out += buffer;
}

void to_errors(const std::string& text) {
  std::fflush(stdout);
  const std::string line = shown(text) + "\n";
  std::fwrite(line.data(), 1, line.size(), stderr);
}

}  // namespace

std::string shown(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const Character character = character_at(text, i);
    if (is_obeyed(character)) append_code(out, character, static_cast<unsigned char>(text[i]));
    else out += text.substr(i, character.length);
    i += character.length;
  }
  return out;
}

std::size_t width_of(std::string_view text) {
  // Continuation bytes of UTF-8 take no column of their own.
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

void print_parts(const std::vector<std::pair<std::string, Colour>>& parts) {
  std::string line;
  for (const auto& [text, colour] : parts) {
    const bool has_colour = colour != Colour::plain && wants_colours();
    if (has_colour) line += code_of(colour);
    line += shown(text);
    if (has_colour) line += "\033[0m";
  }
  line += '\n';
  std::fwrite(line.data(), 1, line.size(), stdout);
}

void print_line(std::string_view text, Colour colour) { print_parts({{std::string(text), colour}}); }

void print_page(std::string_view text) {
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    print_line(text.substr(begin, end - begin));
    begin = end + 1;
  }
}

void TextTable::add(std::vector<std::string> row, Colour colour) {
  for (std::string& cell : row) cell = shown(cell);  // before the widths are measured
  rows_.push_back({std::move(row), colour});
}

void TextTable::print() const {
  std::vector<std::size_t> widths;
  for (const Column& column : columns_) widths.push_back(width_of(column.header));
  for (const Row& row : rows_)
    for (std::size_t c = 0; c < row.cells.size(); ++c) widths[c] = std::max(widths[c], width_of(row.cells[c]));
  const auto line_of = [&](const std::vector<std::string>& cells) {
    std::string line;
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      const std::string cell = c < cells.size() ? cells[c] : "";
      const std::string fill(widths[c] - width_of(cell), ' ');
      line += (c > 0 ? "  " : "") + (columns_[c].is_number ? fill + cell : cell + fill);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    return line;
  };
  std::vector<std::string> headers;
  std::size_t total = 2 * (columns_.size() - 1);
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    headers.push_back(columns_[c].header);
    total += widths[c];
  }
  print_line(line_of(headers), Colour::bold);
  for (const Row& row : rows_)
    if (row.cells.empty()) print_line(std::string(std::min<std::size_t>(total, 100), '-'), Colour::dim);
    else print_line(line_of(row.cells), row.colour);
}

void complain(std::string_view sentence) {
  to_errors("behaviourlinks: " + bounded({ErrorCode::parse, "", std::string(sentence)}).message);
}

namespace {

std::string located(const std::string& file, const Error& error) {
  const bool is_named = file.empty() || error.place == file || error.place.starts_with(file + "/");
  return is_named ? error.text() : file + ": " + error.text();
}

}  // namespace

void print_error(const std::string& file, const Error& error) {
  to_errors(located(file, error));
}

void print_problems(const std::string& file, const std::vector<Problem>& problems) {
  std::fflush(stdout);
  for (const bool is_error : {true, false})
    for (const Problem& problem : problems) {
      if (problem.is_error != is_error) continue;
      const Error marked{problem.error.code, problem.error.place, (is_error ? "" : "warning: ") + problem.error.message};
      print_error(file, marked);
    }
}

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

bool Progress::is_due() const {
  const double time = now(), since = time - shown_;
  return time - began_ > 1 && since > (errors_go_to_a_terminal() ? 0.1 : 10);
}

void Progress::show(const std::string& text) {
  if (!is_due()) return;
  shown_ = now();
  if (errors_go_to_a_terminal()) {
    std::fprintf(stderr, "\r\033[K%s", shown(text).c_str());
    is_dirty_ = true;
  } else {
    std::fprintf(stderr, "%s\n", shown(text).c_str());
  }
  std::fflush(stderr);
}

void Progress::clear() {
  if (is_dirty_) std::fputs("\r\033[K", stderr);
  is_dirty_ = false;
}

}  // namespace bl::cli
