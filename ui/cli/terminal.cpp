// Standard output and standard error of the program.
#include "ui/cli/terminal.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "core/base/printable.h"
#include "ui/cli/scene_loading.h"

namespace bl::cli {

namespace {

// Places of warnings with the same words that are named.
constexpr std::size_t kMostPlaces = 20;

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

void to_errors(const std::string& text) {
  std::fflush(stdout);
  const std::string line = printable(text) + "\n";
  std::fwrite(line.data(), 1, line.size(), stderr);
}

}  // namespace

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
    line += printable(text);
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
  for (std::string& cell : row) cell = printable(cell);  // before the widths are measured
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

void print_error(const std::string& file, const Error& error) { to_errors(located(file, error)); }

void print_problems(const std::string& file, const std::vector<Problem>& problems) {
  std::fflush(stdout);
  for (const Problem& problem : problems)
    if (problem.is_error) print_error(file, problem.error);
  // Each error has to be repaired; a warning that holds in thousands of places says nothing more in each of them.
  std::map<std::string, std::size_t> places;
  for (const Problem& problem : problems) {
    if (problem.is_error || ++places[problem.error.message] > kMostPlaces) continue;
    print_error(file, {problem.error.code, problem.error.place, "warning: " + problem.error.message});
  }
  for (const auto& [message, count] : places)
    if (count > kMostPlaces)
      print_error(file,
                  {ErrorCode::infeasible, "", "warning: in " + counted(count - kMostPlaces, "more place") + ": " + message});
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
    std::fprintf(stderr, "\r\033[K%s", printable(text).c_str());
    is_dirty_ = true;
  } else {
    std::fprintf(stderr, "%s\n", printable(text).c_str());
  }
  std::fflush(stderr);
}

void Progress::clear() {
  if (is_dirty_) std::fputs("\r\033[K", stderr);
  is_dirty_ = false;
}

}  // namespace bl::cli
