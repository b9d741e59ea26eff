// JSON text in and out: nlohmann's SAX parser with stricter rules, and a writer of our own layout.
#include "core/define/json_text.h"

#include <set>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/define/bounded_json.h"

namespace bl {

namespace {

// Follows the parser's events to find what the DOM would hide: doubled keys.
class Watcher {
 public:
  bool operator()(int /*depth*/, Json::parse_event_t event, Json& parsed) {
    if (event == Json::parse_event_t::object_start || event == Json::parse_event_t::array_start) {
      open_.emplace_back();
    } else if (event == Json::parse_event_t::object_end || event == Json::parse_event_t::array_end) {
      open_.pop_back();
    } else if (event == Json::parse_event_t::key) {
      const std::string& key = parsed.get_ref<const std::string&>();
      if (!open_.back().insert(key).second && problem.empty()) problem = "the key \"" + key + "\" stands twice in one object";
    }
    return problem.empty();
  }
  std::string problem;

 private:
  std::vector<std::set<std::string>> open_;
};

}  // namespace

Result<Json> parse_json(std::string_view text) {
  // The library's parser recurses nowhere, but its destructor and ours would on a hostile depth: looked at first.
  if (auto bounded = check_json_bounds(text); !bounded) return bounded.error();
  Watcher watcher;
  try {
    Json value = Json::parse(text, std::ref(watcher));
    if (!watcher.problem.empty()) return Error{ErrorCode::parse, "", watcher.problem + "; keep one of them"};
    return value;
  } catch (const Json::parse_error& e) {
    const std::size_t byte = static_cast<std::size_t>(e.byte);
    if (byte > text.size())
      return Error{ErrorCode::parse, place_in_text(text, text.size()),
                   "the text ends in the middle of a JSON value; the file is cut off"};
    return Error{ErrorCode::parse, place_in_text(text, byte > 0 ? byte - 1 : 0),
                 "this is not JSON (no comments, no trailing commas, no NaN)"};
  } catch (const Json::out_of_range& e) {
    // The library's message quotes the number; the first place where it stands is where it was met.
    const std::string_view what = e.what();
    const std::size_t open = what.find('\''), close = what.rfind('\'');
    const std::string_view number = close > open ? what.substr(open + 1, close - open - 1) : std::string_view();
    const std::size_t at = number.empty() ? std::string_view::npos : text.find(number);
    return Error{ErrorCode::not_finite, at == std::string_view::npos ? "" : place_in_text(text, at),
                 "a number is too large for a double"};
  } catch (const std::exception&) { return Error{ErrorCode::parse, "", "this is not JSON text in UTF-8"}; }
}

namespace {

void write_scalar(const Json& value, std::string& out) {
  if (value.is_number_float()) out += shortest(value.get<double>());
  else out += value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void write_line(const Json& value, std::string& out) {
  if (value.is_object()) {
    out += '{';
    bool is_first = true;
    for (const auto& [key, child] : value.items()) {
      if (!is_first) out += ", ";
      is_first = false;
      write_scalar(Json(key), out);
      out += ": ";
      write_line(child, out);
    }
    out += '}';
  } else if (value.is_array()) {
    out += '[';
    for (std::size_t i = 0; i < value.size(); ++i) {
      if (i > 0) out += ", ";
      write_line(value[i], out);
    }
    out += ']';
  } else {
    write_scalar(value, out);
  }
}

constexpr std::size_t kWidth = 120;

void write_block(const Json& value, std::size_t indent, int open_levels, std::size_t used, std::string& out) {
  std::string line;
  write_line(value, line);
  if (!value.is_structured() || value.empty() || (open_levels <= 0 && used + line.size() <= kWidth)) {
    out += line;
    return;
  }
  const std::string pad(indent + 2, ' ');
  out += value.is_object() ? '{' : '[';
  bool is_first = true;
  for (const auto& [key, child] : value.items()) {
    out += is_first ? "\n" : ",\n";
    is_first = false;
    out += pad;
    std::size_t start = pad.size() + 1;
    if (value.is_object()) {
      std::string name;
      write_scalar(Json(key), name);
      out += name + ": ";
      start += name.size() + 2;
    }
    write_block(child, indent + 2, open_levels - 1, start, out);
  }
  out += '\n' + std::string(indent, ' ') + (value.is_object() ? '}' : ']');
}

}  // namespace

std::string write_json(const Json& value, int open_levels) {
  std::string out;
  write_block(value, 0, open_levels, 0, out);
  return out;
}

std::string write_json_line(const Json& value) {
  std::string out;
  write_line(value, out);
  return out;
}

}  // namespace bl
