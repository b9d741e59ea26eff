// Names of the error codes, the composition of places, and the bounds of what errors say.
#include "core/base/result.h"

#include <algorithm>

namespace bl {

namespace {

constexpr std::size_t kLongestPlace = 400;

// What is left of a long text: its beginning and its end, cut between characters of UTF-8, and how long it was.
std::string without_middle(std::string_view text, std::size_t head, std::size_t tail) {
  const auto is_inside = [&](std::size_t at) { return (static_cast<unsigned char>(text[at]) & 0xc0) == 0x80; };
  std::size_t end = head, begin = text.size() - tail;
  while (end > 0 && is_inside(end)) --end;
  while (begin < text.size() && is_inside(begin)) ++begin;
  return std::string(text.substr(0, end)) + " ... (" + std::to_string(text.size()) + " bytes) ... " +
         std::string(text.substr(begin));
}

// Sentences quote data between `` or "". A mark without its partner quotes nothing: an inch, or a text that data have cut.
std::string with_short_quotes(std::string_view message) {
  std::string out;
  for (std::size_t at = 0; at < message.size();) {
    const std::size_t open = std::min(message.find_first_of("`\"", at), message.size());
    out += message.substr(at, open - at);
    if (open == message.size()) break;
    out += message[open];
    at = open + 1;
    const std::size_t close = message.find(message[open], at);
    if (close == std::string_view::npos) continue;
    const std::string_view quote = message.substr(at, close - at);
    out += quote.size() > kLongestQuote ? without_middle(quote, kLongestQuote / 2, kLongestQuote / 6) : std::string(quote);
    out += message[close];
    at = close + 1;
  }
  return out;
}

}  // namespace

Error bounded(Error error) {
  if (error.message.size() > kLongestQuote) error.message = with_short_quotes(error.message);
  if (error.message.size() > kLongestMessage) error.message = without_middle(error.message, kLongestMessage - 600, 500);
  if (error.place.size() > kLongestPlace) error.place = without_middle(error.place, kLongestPlace / 2, kLongestPlace / 4);
  return error;
}

std::string Error::text() const {
  if (message.size() <= kLongestQuote && place.size() <= kLongestPlace) return place.empty() ? message : place + ": " + message;
  const Error shorter = bounded(*this);
  return shorter.place.empty() ? shorter.message : shorter.place + ": " + shorter.message;
}

std::string_view name_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::parse: return "parse";
    case ErrorCode::unknown_field: return "unknown_field";
    case ErrorCode::unknown_type: return "unknown_type";
    case ErrorCode::wrong_kind: return "wrong_kind";
    case ErrorCode::wrong_unit: return "wrong_unit";
    case ErrorCode::out_of_range: return "out_of_range";
    case ErrorCode::not_finite: return "not_finite";
    case ErrorCode::missing: return "missing";
    case ErrorCode::duplicate: return "duplicate";
    case ErrorCode::not_found: return "not_found";
    case ErrorCode::conflict: return "conflict";
    case ErrorCode::geometry: return "geometry";
    case ErrorCode::infeasible: return "infeasible";
    case ErrorCode::version: return "version";
    case ErrorCode::io: return "io";
    case ErrorCode::cancelled: return "cancelled";
    case ErrorCode::internal: return "internal";
  }
  return "internal";
}

Error Error::within(std::string_view prefix) const {
  Error outer = *this;
  if (prefix.empty()) return outer;
  outer.place = place.empty() ? std::string(prefix) : std::string(prefix) + "/" + place;
  return outer;
}

}  // namespace bl
