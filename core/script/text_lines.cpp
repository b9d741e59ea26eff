// A reader of Lua's words (names, texts, marks) that knows comments and braces, and nothing else of the grammar.
#include "core/script/text_lines.h"

#include <algorithm>
#include <cstdlib>

namespace bl::script {

namespace {

bool begins_name(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_in_name(char c) { return begins_name(c) || (c >= '0' && c <= '9'); }

// Length of "[[" or "[==[" at a place, or 0.
std::size_t long_bracket(std::string_view text, std::size_t at) {
  if (at >= text.size() || text[at] != '[') return 0;
  std::size_t end = at + 1;
  while (end < text.size() && text[end] == '=') ++end;
  return end < text.size() && text[end] == '[' ? end + 1 - at : 0;
}

// The end of a long text or comment whose opening bracket of that length stands at `at`.
std::size_t end_of_long(std::string_view text, std::size_t at, std::size_t length) {
  const std::string close = "]" + std::string(length - 2, '=') + "]";
  const std::size_t found = text.find(close, at + length);
  return found == std::string_view::npos ? text.size() : found + close.size();
}

std::size_t end_of_quoted(std::string_view text, std::size_t at) {
  const char quote = text[at];
  for (++at; at < text.size() && text[at] != quote && text[at] != '\n'; ++at)
    if (text[at] == '\\') ++at;
  return std::min(at + 1, text.size());
}

}  // namespace

TextLines::TextLines(std::string_view text) { read(text); }

void TextLines::read(std::string_view text) {
  std::size_t line = 1;
  int depth = 0;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = at + 1;
    Word word{Kind::mark, text.substr(at, 1), line, depth};
    const bool is_comment = text.substr(at, 2) == "--";
    const std::size_t bracket = long_bracket(text, is_comment ? at + 2 : at);
    if (is_comment) {
      end = bracket > 0 ? end_of_long(text, at + 2, bracket) : std::min(text.find('\n', at), text.size());
    } else if (bracket > 0) {
      end = end_of_long(text, at, bracket);
      word.kind = Kind::text;
      word.text = text.substr(at + bracket, end - at >= 2 * bracket ? end - at - 2 * bracket : 0);
    } else if (text[at] == '"' || text[at] == '\'') {
      end = end_of_quoted(text, at);
      word.kind = Kind::text;
      word.text = text.substr(at + 1, end - at >= 2 ? end - at - 2 : 0);
    } else if (begins_name(text[at])) {
      while (end < text.size() && is_in_name(text[end])) ++end;
      word.kind = Kind::name;
      word.text = text.substr(at, end - at);
    } else if (text[at] == '{') {
      ++depth;
    } else if (text[at] == '}') {
      word.depth = --depth;
    }
    const bool is_blank = text[at] == ' ' || text[at] == '\t' || text[at] == '\r' || text[at] == '\n';
    if (!is_comment && !is_blank) words_.push_back(word);
    line +=
        static_cast<std::size_t>(std::count(text.begin() + static_cast<long>(at), text.begin() + static_cast<long>(end), '\n'));
    at = end;
  }
}

// The last `return` outside of braces is the script's own; those of functions before it come first.
std::size_t TextLines::returned() const {
  std::size_t found = words_.size();
  for (std::size_t i = 0; i < words_.size(); ++i)
    if (words_[i].depth == 0 && words_[i].kind == Kind::name && words_[i].text == "return") found = i;
  return found;
}

bool TextLines::is_key(std::size_t index, std::string_view key) const {
  const Word& word = words_[index];
  if (word.kind == Kind::mark || word.text != key) return false;
  const auto is_mark = [this](std::size_t i, std::string_view mark) {
    return i < words_.size() && words_[i].kind == Kind::mark && words_[i].text == mark;
  };
  if (word.kind == Kind::name) return is_mark(index + 1, "=");
  return is_mark(index + 1, "]") && is_mark(index + 2, "=");
}

// What stands between the braces that begin at `index`, or nothing where no brace does.
TextLines::Range TextLines::inside(std::size_t index) const {
  if (index >= words_.size() || words_[index].kind != Kind::mark || words_[index].text != "{") return {index, index, -1};
  const int depth = words_[index].depth;
  std::size_t end = index + 1;
  while (end < words_.size() && words_[end].depth > depth) ++end;
  return {index + 1, end, depth + 1};
}

std::size_t TextLines::find_key(const Range& range, std::string_view key) const {
  for (std::size_t i = range.begin; i < range.end; ++i)
    if ((range.depth < 0 || words_[i].depth == range.depth) && is_key(i, key)) return i;
  return words_.size();
}

std::size_t TextLines::find_item(const Range& range, std::size_t number) const {
  for (std::size_t i = range.begin; i < range.end; ++i)
    if (words_[i].kind == Kind::mark && words_[i].text == "{" && words_[i].depth == range.depth && --number == 0) return i;
  return words_.size();
}

// A key of the table itself before anything deeper; a text before a name.
std::size_t TextLines::find_word(const Range& range, std::string_view word) const {
  if (const std::size_t key = find_key(range, word); key < words_.size()) return key;
  for (const Kind kind : {Kind::text, Kind::name})
    for (std::size_t i = range.begin; i < range.end; ++i)
      if (words_[i].kind == kind && words_[i].text == word) return i;
  return words_.size();
}

std::size_t TextLines::line_of(const std::vector<std::string>& path, std::string_view word) const {
  const std::size_t start = returned();
  const Range whole{0, words_.size(), -1};
  Range range = inside(start + 1);
  std::size_t line = start < words_.size() ? words_[start].line : 1;
  bool is_followed = range.depth >= 0;
  for (std::size_t step = 0; is_followed && step < path.size(); ++step) {
    const bool is_item = path[step].starts_with('#');
    const std::size_t at =
        is_item ? find_item(range, static_cast<std::size_t>(std::atol(path[step].c_str() + 1))) : find_key(range, path[step]);
    is_followed = at < words_.size();
    if (!is_followed) break;
    line = words_[at].line;
    std::size_t value = at;
    while (!is_item && words_[value].text != "=") ++value;
    range = inside(is_item ? at : value + 1);
  }
  if (word.empty()) return line;
  if (is_followed) {
    const std::size_t at = find_word(range, word);
    return at < words_.size() ? words_[at].line : line;
  }
  const std::size_t guess = find_word(whole, word);
  return guess < words_.size() ? words_[guess].line : line;
}

}  // namespace bl::script
