// The best of all ways to find the query's letters in order, by dynamic programming over short texts.
#include "ui/desktop/app/fuzzy.h"

#include <algorithm>
#include <cctype>
#include <limits>
#include <string>
#include <vector>

namespace bl::desktop {

namespace {

constexpr int kNone = std::numeric_limits<int>::min() / 2;
constexpr int kHit = 1, kInRow = 6, kStartOfWord = 8, kStartOfText = 4;
constexpr std::size_t kLongest = 200;

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

bool starts_word(std::string_view text, std::size_t i) {
  if (i == 0) return true;
  const auto before = static_cast<unsigned char>(text[i - 1]), here = static_cast<unsigned char>(text[i]);
  return std::isalnum(before) == 0 || (std::islower(before) != 0 && std::isupper(here) != 0);
}

}  // namespace

std::optional<int> fuzzy_match(std::string_view query, std::string_view text) {
  std::string letters;
  for (const char c : query)
    if (c != ' ') letters += lower(c);
  if (letters.empty()) return 0;
  text = text.substr(0, kLongest);
  // best[i]: the score of the letters so far with the last of them at i.
  std::vector<int> best(text.size(), kNone), next(text.size());
  for (std::size_t k = 0; k < letters.size(); ++k) {
    int reached = kNone;  // the best of all places before i - 1
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (i >= 2) reached = std::max(reached, best[i - 2]);
      next[i] = kNone;
      if (lower(text[i]) != letters[k]) continue;
      const int worth = kHit + (starts_word(text, i) ? kStartOfWord : 0) + (i == 0 ? kStartOfText : 0);
      if (k == 0) {
        next[i] = worth;
        continue;
      }
      const int in_row = i >= 1 && best[i - 1] > kNone ? best[i - 1] + kInRow : kNone;
      const int before = std::max(in_row, reached);
      if (before > kNone) next[i] = before + worth;
    }
    best.swap(next);
  }
  if (text.empty()) return std::nullopt;
  const int score = *std::max_element(best.begin(), best.end());
  if (score <= kNone) return std::nullopt;
  // Of equal hits the shorter name is meant.
  return 4 * score - static_cast<int>(text.size()) / 8;
}

}  // namespace bl::desktop
