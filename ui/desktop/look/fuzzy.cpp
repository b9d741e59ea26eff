// Each word of the pattern is looked for by itself, as a piece of the text or as letters with gaps.
#include "ui/desktop/look/fuzzy.h"

#include <algorithm>

namespace bl::desktop {

namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }
bool is_gap(char c) { return c == ' ' || c == '_' || c == '-' || c == '.' || c == '#'; }
bool is_start(std::string_view text, std::size_t at) {
  return at == 0 || is_gap(text[at - 1]) || (text[at] >= 'A' && text[at] <= 'Z' && !(text[at - 1] >= 'A' && text[at - 1] <= 'Z'));
}

int word_score(std::string_view word, std::string_view text) {
  const auto found =
      std::search(text.begin(), text.end(), word.begin(), word.end(), [](char a, char b) { return lower(a) == lower(b); });
  if (found != text.end()) {
    const auto at = static_cast<std::size_t>(found - text.begin());
    const int shortness = 20 - std::min(20, static_cast<int>(text.size() - word.size()) / 2);
    return 100 + (at == 0 ? 60 : is_start(text, at) ? 40 : 0) + shortness;
  }
  int score = 0;
  std::size_t at = 0, last = 0;
  for (const char c : word) {
    while (at < text.size() && lower(text[at]) != lower(c)) ++at;
    if (at == text.size()) return -1;
    score += is_start(text, at) ? 12 : at == last + 1 ? 6 : 1;
    last = at++;
  }
  // Letters scattered over a long text are chance.
  return score >= 4 * static_cast<int>(word.size()) ? score : -1;
}

}  // namespace

int fuzzy_score(std::string_view pattern, std::string_view text) {
  int score = 0;
  while (!pattern.empty()) {
    const std::size_t end = std::min(pattern.find(' '), pattern.size());
    if (end > 0) {
      const int word = word_score(pattern.substr(0, end), text);
      if (word < 0) return -1;
      score += word;
    }
    pattern.remove_prefix(std::min(end + 1, pattern.size()));
  }
  return score;
}

}  // namespace bl::desktop
