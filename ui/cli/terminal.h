// Output for people: colours, tables, sentences about problems, and one line of progress.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/graph/scene.h"

namespace bl::cli {

enum class Colour { plain, bold, dim, red, green, yellow };

/// All functions below write names and other foreign text as `printable` gives it (core/base/printable.h).

/// Columns that a text takes on a terminal: UTF-8 characters, not bytes.
std::size_t width_of(std::string_view text);

/// Rows under headers, columns as wide as their content. Numbers are aligned right, texts left.
class TextTable {
 public:
  struct Column {
    std::string header;
    bool is_number = false;
  };
  explicit TextTable(std::vector<Column> columns) : columns_(std::move(columns)) {}
  void add(std::vector<std::string> row, Colour colour = Colour::plain);
  /// A line between what stands above and below.
  void rule() { rows_.push_back({}); }
  void print() const;

 private:
  struct Row {
    std::vector<std::string> cells;
    Colour colour = Colour::plain;
  };
  std::vector<Column> columns_;
  std::vector<Row> rows_;
};

/// On standard output; in colour on a terminal that supports it.
void print_line(std::string_view text = {}, Colour colour = Colour::plain);
/// One line of parts in colours of their own.
void print_parts(const std::vector<std::pair<std::string, Colour>>& parts);
/// Several lines made by the program, such as a page of the catalogue; line feeds are kept.
void print_page(std::string_view text);
/// "behaviourlinks: sentence" on standard error.
void complain(std::string_view sentence);
/// "file: place: message" on standard error. A place that is the file itself is not repeated.
void print_error(const std::string& file, const Error& error);
/// Errors before warnings, which are marked as such. Of warnings with the same words, the first places are named and the others
/// are counted.
void print_problems(const std::string& file, const std::vector<Problem>& problems);

/// Seconds since some fixed moment.
double now();

/// Prints the progress of a long task on standard error: nothing in the first second; on a terminal one line that is rewritten;
/// elsewhere a plain line every ten seconds.
class Progress {
 public:
  Progress() : began_(now()), shown_(began_) {}
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  /// Is a new line due? To be checked before a costly text is made.
  bool is_due() const;
  void show(const std::string& text);
  void clear();

 private:
  double began_, shown_;
  bool is_dirty_ = false;
};

}  // namespace bl::cli
