// Checks the brackets before the parser builds anything: a packed file of some kilobytes can unpack to gigabytes of brackets.
#include "core/define/bounded_json.h"

#include <algorithm>
#include <iterator>
#include <string>

#include <nlohmann/json.hpp>

#include "core/base/packed_kind.h"
#include "core/base/stop_check.h"

namespace bl {

namespace {

using SortedJson = nlohmann::json;

// Asked so often whether to go on [bytes]: the parser needs some milliseconds for them.
constexpr std::size_t kPiece = std::size_t{1} << 18;

// The bytes of a text as the parser takes them; once nobody wants it any more, they end early.
class Bytes {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  Bytes(const char* at, const char* end) : at_(at), piece_(at), end_(end) {}
  reference operator*() const { return *at_; }
  Bytes& operator++() {
    ++at_;
    return *this;
  }
  friend bool operator==(const Bytes& a, const Bytes&) { return a.at_ == a.piece_ && !a.has_more(); }

 private:
  bool has_more() const {
    if (piece_ == end_ || is_stop_wished()) return false;
    piece_ += std::min(kPiece, static_cast<std::size_t>(end_ - piece_));
    return true;
  }

  const char* at_;
  mutable const char* piece_;  // looked at, up to here
  const char* end_;
};

// Brackets and commas outside of strings, told to `see` with their places until it has seen enough.
template <class See>
void scan(std::string_view text, const See& see) {
  bool is_in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (i % kPiece == 0 && is_stop_wished()) return;
    const char c = text[i];
    if (is_in_string) {
      if (c == '\\') ++i;
      else if (c == '"') is_in_string = false;
    } else if (c == '"') {
      is_in_string = true;
    } else if ((c == '[' || c == '{' || c == ']' || c == '}' || c == ',') && !see(c, i)) {
      return;
    }
  }
}

}  // namespace

std::string place_in_text(std::string_view text, std::size_t at) {
  const std::string_view before = text.substr(0, at);
  const std::size_t last = before.rfind('\n');
  return "line " + std::to_string(1 + std::count(before.begin(), before.end(), '\n')) + ", column " +
         std::to_string(before.size() - (last == std::string_view::npos ? 0 : last + 1) + 1);
}

Result<void> check_json_bounds(std::string_view text) {
  if (auto packed = packed_refusal(text)) return *packed;
  // The library's parser takes it for the end of the text, and what follows would be lost in silence.
  if (const std::size_t zero = text.find('\0'); zero != std::string_view::npos)
    return Error{ErrorCode::parse, place_in_text(text, zero),
                 "A zero byte stands here, which no text contains: the file is damaged. Get an intact copy of it."};
  std::size_t depth = 0, values = 1, deep = std::string_view::npos, many = std::string_view::npos;
  scan(text, [&](char c, std::size_t at) {
    if (c == '[' || c == '{') {
      if (++depth > kMostJsonDepth) deep = at;
    } else if (c != ',' && depth > 0) {
      --depth;
    }
    // Each bracket that opens and each comma begins a value, or less than one.
    if (c != ']' && c != '}' && ++values > kMostJsonValues) many = at;
    return deep == std::string_view::npos && many == std::string_view::npos;
  });
  if (is_stop_wished()) return Error{ErrorCode::cancelled, "", "The reading was stopped."};
  if (deep != std::string_view::npos)
    return Error{ErrorCode::out_of_range, place_in_text(text, deep),
                 "The text is nested deeper than " + std::to_string(kMostJsonDepth) +
                     " levels from here on. No file of this kind needs that many: it is not read."};
  if (many != std::string_view::npos)
    return Error{ErrorCode::out_of_range, place_in_text(text, many),
                 "The text holds more than " + std::to_string(kMostJsonValues) + " values: cut out the part that you need."};
  return {};
}

Result<SortedJson> read_bounded_json(std::string_view text, std::string_view format) {
  if (auto bounded = check_json_bounds(text); !bounded) return bounded.error();
  try {
    const char *begin = text.data(), *end = begin + text.size();
    return SortedJson::parse(Bytes(begin, end), Bytes(end, end));
  } catch (const SortedJson::parse_error& error) {
    if (is_stop_wished()) return Error{ErrorCode::cancelled, "", "The reading was stopped."};
    // The parser has read past the end only where it wanted more: what is there is sound as far as it goes.
    if (error.byte > text.size())
      return Error{ErrorCode::parse, place_in_text(text, text.size()),
                   "The text ends in the middle of its JSON: the file is cut off. Fetch or export it again."};
    return Error{ErrorCode::parse, place_in_text(text, error.byte > 0 ? error.byte - 1 : 0),
                 "The text is not valid JSON from here on: it is damaged, or no " + std::string(format) + " at all."};
  } catch (const SortedJson::exception&) {
    return Error{ErrorCode::parse, "", "The text cannot be read as JSON: a number or a character in it is out of range."};
  }
}

std::size_t end_of_first_value(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string_view::npos || (text[begin] != '[' && text[begin] != '{')) return std::string_view::npos;
  std::size_t depth = 0, end = std::string_view::npos;
  scan(text, [&](char c, std::size_t at) {
    if (c == '[' || c == '{') ++depth;
    else if (c != ',' && --depth == 0) end = at + 1;
    return end == std::string_view::npos;
  });
  return end;
}

}  // namespace bl
