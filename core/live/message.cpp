// Reads messages that anybody may have sent: every length, byte and nesting is possible.
#include "core/live/message.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/csv/csv_reader.h"
#include "core/define/json_text.h"

namespace bl::live {

namespace {

constexpr std::size_t kLongestShown = 40;

Error refused(std::string message) { return {ErrorCode::parse, "", std::move(message)}; }

bool is_binary(std::string_view text) {
  return std::any_of(text.begin(), text.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte == 0x7f || (byte < 0x20 && c != '\n' && c != '\r' && c != '\t');
  });
}

Result<double> number_of_text(std::string_view text) {
  text = csv::trimmed(text);
  while (text.ends_with('\n') || text.ends_with('\r')) text = csv::trimmed(text.substr(0, text.size() - 1));
  if (text == "true") return 1.0;
  if (text == "false") return 0.0;
  if (const auto number = parse_number(text)) return *number;
  if (text.empty()) return refused("the message is empty");
  if (text.starts_with('{') || text.starts_with('['))
    return refused("the message is JSON: name the field of it that holds the number");
  return refused(in_quotes(text) + " is no number");
}

Result<double> number_of_json(const Json& value, std::string_view field) {
  if (value.is_number()) {
    const double number = value.get<double>();
    if (std::isfinite(number)) return number;
    return refused("the number at " + in_quotes(field) + " is too large");
  }
  if (value.is_boolean()) return value.get<bool>() ? 1.0 : 0.0;
  if (value.is_string()) {
    if (const auto number = parse_number(value.get_ref<const std::string&>())) return *number;
    return refused(in_quotes(field) + " holds " + in_quotes(value.get_ref<const std::string&>()) + ", which is no number");
  }
  if (value.is_null()) return refused(in_quotes(field) + " holds nothing (null)");
  return refused(in_quotes(field) + " holds no number but a whole " + (value.is_array() ? "list" : "object"));
}

// Walks a JSON pointer (RFC 6901) step by step, so that the sentence can name the step that fails.
Result<double> number_at(const Json& whole, std::string_view field) {
  const Json* at = &whole;
  if (!field.starts_with('/')) {
    const auto found = whole.is_object() ? whole.find(std::string(field)) : whole.end();
    if (found == whole.end()) return refused("the message has no field " + in_quotes(field));
    return number_of_json(*found, field);
  }
  for (std::string_view rest = field; !rest.empty();) {
    rest.remove_prefix(1);
    std::string key(rest.substr(0, rest.find('/')));
    rest.remove_prefix(key.size());
    for (const auto& [code, letter] : {std::pair{"~1", "/"}, {"~0", "~"}})
      for (std::size_t p = key.find(code); p != std::string::npos; p = key.find(code, p + 1)) key.replace(p, 2, letter);
    const Json* next = nullptr;
    if (at->is_object()) {
      if (const auto found = at->find(key); found != at->end()) next = &*found;
    } else if (at->is_array()) {
      const auto index = parse_number(key);
      if (index && *index >= 0 && *index < static_cast<double>(at->size()) && *index == std::floor(*index))
        next = &(*at)[static_cast<std::size_t>(*index)];
    }
    if (next == nullptr) return refused("the message has no field " + in_quotes(field) + ": " + in_quotes(key) + " is not there");
    at = next;
  }
  return number_of_json(*at, field);
}

}  // namespace

std::string in_quotes(std::string_view text) {
  std::string shown;
  for (const char c : text.substr(0, kLongestShown)) {
    const auto byte = static_cast<unsigned char>(c);
    shown += byte >= 0x20 && byte < 0x7f && c != '`' ? c : '?';
  }
  return "`" + shown + (text.size() > kLongestShown ? "..." : "") + "`";
}

Result<double> number_in(std::string_view payload, std::string_view field) {
  if (payload.size() > kLongestPayload)
    return refused("the message has " + std::to_string(payload.size()) + " bytes, and at most " +
                   std::to_string(kLongestPayload) + " are read");
  if (is_binary(payload)) return refused("the message is binary, no text");
  if (field.empty()) return number_of_text(payload);
  const auto whole = parse_json(payload);
  if (!whole) return refused("the message is no JSON, in which the field " + in_quotes(field) + " could stand");
  return number_at(*whole, field);
}

}  // namespace bl::live
