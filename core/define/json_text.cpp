// JSON text in and out: events of nlohmann's parser to a value under stricter rules, and a writer of our own layout.
#include "core/define/json_text.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/define/bounded_json.h"

namespace bl {

namespace {

// The first key in a text that its object has already, and where it stands. The parser tells no places: this walk is for texts in
// which it has found such a key, and sound up to there.
std::pair<std::string, std::size_t> first_doubled_key(std::string_view text) {
  std::vector<std::set<std::string>> open;  // keys of the objects around, from the outermost in
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '{') open.emplace_back();
    if (text[i] == '}' && !open.empty()) open.pop_back();
    if (text[i] != '"') continue;
    const std::size_t begin = i;
    for (++i; i < text.size() && text[i] != '"'; ++i)
      if (text[i] == '\\') ++i;
    const std::size_t next = text.find_first_not_of(" \t\r\n", i + 1);
    if (open.empty() || next == std::string_view::npos || text[next] != ':') continue;
    const Json key = Json::parse(text.substr(begin, i + 1 - begin), nullptr, false);  // with its escapes resolved
    if (!open.back().insert(key.get<std::string>()).second) return {key.get<std::string>(), begin};
  }
  return {"", text.size()};
}

// Takes the parser's events and builds the value of them. The library's own builder looks through all siblings at each end of an
// object when it is watched, and through all keys at each field of an ordered object: both cost n².
class JsonBuilder {
 public:
  explicit JsonBuilder(std::string_view text) : text_(text) {}

  Json root;
  std::optional<Error> error;

  bool null() { return take(nullptr); }
  bool boolean(bool value) { return take(value); }
  bool number_integer(Json::number_integer_t value) { return take(value); }
  bool number_unsigned(Json::number_unsigned_t value) { return take(value); }
  bool number_float(Json::number_float_t value, const std::string& /*text*/) { return take(value); }
  bool string(std::string& value) { return take(std::move(value)); }
  bool binary(Json::binary_t& /*value*/) { return false; }  // no JSON text holds any
  bool start_object(std::size_t /*size*/) { return open(Json::object()); }
  bool start_array(std::size_t /*size*/) { return open(Json::array()); }
  bool end_array() { return close(); }
  bool key(std::string& name) {
    key_ = std::move(name);
    return true;
  }
  bool end_object() {
    if (!has_doubled_key(*open_.back())) return close();
    const auto [name, at] = first_doubled_key(text_);
    error = Error{ErrorCode::parse, place_in_text(text_, at),
                  "the key \"" + name + "\" stands twice in one object; keep one of them"};
    return false;
  }

  bool parse_error(std::size_t position, const std::string& last_token, const Json::exception& what) {
    if (dynamic_cast<const Json::out_of_range*>(&what) != nullptr) {
      error = Error{ErrorCode::not_finite, place_in_text(text_, position - std::min(position, last_token.size())),
                    "a number is too large for a double"};
    } else if (position > text_.size()) {
      error = Error{ErrorCode::parse, place_in_text(text_, text_.size()),
                    "the text ends in the middle of a JSON value; the file is cut off"};
    } else {
      error = Error{ErrorCode::parse, place_in_text(text_, position > 0 ? position - 1 : 0),
                    "this is not JSON (no comments, no trailing commas, no NaN)"};
    }
    return false;
  }

 private:
  Json& put(Json&& value) {
    if (open_.empty()) return root = std::move(value);
    if (open_.back()->is_object()) return append_field(*open_.back(), std::move(key_)) = std::move(value);
    open_.back()->push_back(std::move(value));
    return open_.back()->back();
  }
  bool take(Json&& value) {
    put(std::move(value));
    return true;
  }
  // What holds an open value does not grow before it is closed, so that its address stays.
  bool open(Json&& value) {
    open_.push_back(&put(std::move(value)));
    return true;
  }
  bool close() {
    open_.pop_back();
    return true;
  }

  static bool has_doubled_key(const Json& object) {
    const auto& fields = object.get_ref<const Json::object_t&>();
    if (fields.size() <= kFewKeys) {
      for (auto field = fields.begin(); field != fields.end(); ++field)
        if (std::any_of(fields.begin(), field, [&](const auto& other) { return other.first == field->first; })) return true;
      return false;
    }
    std::vector<std::string_view> keys;
    keys.reserve(fields.size());
    for (const auto& [key, value] : fields) keys.emplace_back(key);
    std::sort(keys.begin(), keys.end());
    return std::adjacent_find(keys.begin(), keys.end()) != keys.end();
  }

  // So many are compared with each other sooner than sorted.
  static constexpr std::size_t kFewKeys = 12;

  std::string_view text_;
  std::string key_;
  std::vector<Json*> open_;  // from the outermost in
};

}  // namespace

Json& append_field(Json& object, std::string key) {
  // The keys are constant, so that growing copies every one of them: small objects grow once.
  auto& fields = object.get_ref<Json::object_t&>();
  if (fields.size() == fields.capacity()) fields.reserve(fields.empty() ? 4 : 4 * fields.size());
  return fields.emplace_back(std::move(key), Json()).second;
}

void append_fields(Json& object, Json&& more) {
  for (auto& [key, value] : more.get_ref<Json::object_t&>()) append_field(object, key) = std::move(value);
}

Result<Json> parse_json(std::string_view text) {
  const std::string_view content = text.starts_with("\xEF\xBB\xBF") ? text.substr(3) : text;
  if (content.find_first_not_of(" \t\r\n") == std::string_view::npos)
    return Error{ErrorCode::parse, "", "the text is empty; JSON is expected"};
  // The library's parser recurses nowhere, but its destructor and ours would on a hostile depth: looked at first.
  if (auto bounded = check_json_bounds(text); !bounded) return bounded.error();
  JsonBuilder builder(text);
  if (!Json::sax_parse(text, &builder)) return *builder.error;
  return std::move(builder.root);
}

namespace {

// Texts that stand in a file as they are, which nearly all do, need none of the library's care.
bool is_plain(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c <= '~' && c != '"' && c != '\\'; });
}

void write_text(const std::string& text, std::string& out) {
  if (!is_plain(text)) {
    out += Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
    return;
  }
  out += '"';
  out += text;
  out += '"';
}

template <class Number>
void write_digits(Number number, std::string& out) {
  char digits[32];
  out.append(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
}

void write_scalar(const Json& value, std::string& out) {
  if (value.is_number_float()) out += shortest(value.get<double>());
  else if (value.is_string()) write_text(value.get_ref<const std::string&>(), out);
  else if (value.is_number_unsigned()) write_digits(value.get<std::uint64_t>(), out);
  else if (value.is_number_integer()) write_digits(value.get<std::int64_t>(), out);
  else out += value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

constexpr std::size_t kNoEnd = static_cast<std::size_t>(-1);

// False as soon as the text is longer than `end`: what is written then is of no use.
bool write_line(const Json& value, std::string& out, std::size_t end = kNoEnd) {
  if (value.is_object()) {
    out += '{';
    bool is_first = true;
    for (const auto& [key, child] : value.get_ref<const Json::object_t&>()) {
      if (!is_first) out += ", ";
      is_first = false;
      write_text(key, out);
      out += ": ";
      if (!write_line(child, out, end)) return false;
    }
    out += '}';
  } else if (value.is_array()) {
    out += '[';
    for (std::size_t i = 0; i < value.size(); ++i) {
      if (i > 0) out += ", ";
      if (!write_line(value[i], out, end)) return false;
    }
    out += ']';
  } else {
    write_scalar(value, out);
  }
  return out.size() <= end;
}

constexpr std::size_t kWidth = 120;

// `used`: the columns of the line that are taken already.
void write_block(const Json& value, std::size_t indent, int open_levels, std::size_t used, std::string& out) {
  const bool can_open = value.is_structured() && !value.empty();
  if (!can_open || open_levels <= 0) {
    const std::size_t begin = out.size();
    if (write_line(value, out, !can_open ? kNoEnd : begin + kWidth - std::min(kWidth, used))) return;
    out.resize(begin);
  }
  const std::string pad(indent + 2, ' ');
  out += value.is_object() ? '{' : '[';
  bool is_first = true;
  const auto begin_child = [&] {
    out += is_first ? "\n" : ",\n";
    is_first = false;
    out += pad;
  };
  if (value.is_object()) {
    for (const auto& [key, child] : value.get_ref<const Json::object_t&>()) {
      begin_child();
      const std::size_t begin = out.size();
      write_text(key, out);
      out += ": ";
      write_block(child, indent + 2, open_levels - 1, pad.size() + 1 + out.size() - begin, out);
    }
  } else {
    for (const Json& child : value) {
      begin_child();
      write_block(child, indent + 2, open_levels - 1, pad.size() + 1, out);
    }
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
  (void)write_line(value, out);
  return out;
}

}  // namespace bl
