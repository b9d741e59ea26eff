// In which line of a script a field of the returned table stands.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace bl::script {

/// The words of a Lua text without its comments, for messages that name a line. A table that code puts together, instead of
/// writing it down, cannot be followed; then the first place where the word stands is the best guess.
class TextLines {
 public:
  explicit TextLines(std::string_view text);

  /// `path`: keys from the returned table inwards, such as {"reads", "here"}; "#2" is the second table of a list. `word`: a key
  /// or a text inside of it; empty, or not found there, for the line of the path itself. Lines count from 1.
  std::size_t line_of(const std::vector<std::string>& path, std::string_view word) const;

 private:
  enum class Kind { name, text, mark };
  struct Word {
    Kind kind = Kind::mark;
    std::string_view text;
    std::size_t line = 1;
    int depth = 0;  ///< in braces; an opening brace counts as outside of what it opens
  };
  struct Range {
    std::size_t begin = 0, end = 0;
    int depth = -1;  ///< of the keys of the table; -1: not known
  };

  void read(std::string_view text);
  std::size_t returned() const;
  bool is_key(std::size_t index, std::string_view key) const;
  Range inside(std::size_t index) const;
  std::size_t find_key(const Range& range, std::string_view key) const;
  std::size_t find_item(const Range& range, std::size_t number) const;
  std::size_t find_word(const Range& range, std::string_view word) const;

  std::vector<Word> words_;
};

}  // namespace bl::script
