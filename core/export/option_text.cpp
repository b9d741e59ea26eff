// Reads values of options by their declarations, as those of ports are read.
#include "core/export/option_text.h"

#include <cmath>

#include <algorithm>

#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/define/codec.h"

namespace bl::exporting {

namespace {

std::string default_text(const PortDefinition& option) {
  const Json json = value_to_json(option.default_value, option);
  if (json.is_boolean()) return json.get<bool>() ? "yes" : "no";
  return json.is_string() ? json.get<std::string>() : write_json_line(json);
}

std::string range_text(const PortDefinition& option) {
  std::string text;
  for (const ChoiceDefinition& choice : option.choices) text += (text.empty() ? "" : ", ") + choice.id;
  if (!text.empty()) return "one of " + text;
  if (!std::isfinite(option.hard_minimum) || !std::isfinite(option.hard_maximum)) return "";
  const std::string unit(info(option.unit).pretty);
  const auto plain = [](double limit) { return std::floor(limit) == limit ? fixed(limit, 0) : shortest(limit); };
  return "from " + plain(option.hard_minimum) + " to " + plain(option.hard_maximum) + (unit.empty() ? "" : " " + unit);
}

Result<Value> value_of(const PortDefinition& option, const std::string& text, const std::string& place) {
  if (option.kind == ValueKind::number || option.kind == ValueKind::integer) {
    const auto quantity = parse_quantity(text, option.unit);
    const bool is_fit = quantity && (option.kind == ValueKind::number || std::floor(*quantity) == *quantity);
    if (!is_fit)
      return Error{ErrorCode::wrong_kind, place,
                   "expects " + std::string(option.kind == ValueKind::integer ? "a whole number" : "a number") +
                       (range_text(option).empty() ? "" : " " + range_text(option)) + ", found `" + text + "`"};
    if (option.kind == ValueKind::integer && std::abs(*quantity) < 9e15)
      return value_from_json(option, Json(static_cast<std::int64_t>(*quantity)), place);
    return value_from_json(option, Json(*quantity), place);
  }
  if (option.kind == ValueKind::boolean) {
    if (text == "true" || text == "yes" || text == "on") return Value(true);
    if (text == "false" || text == "no" || text == "off") return Value(false);
    return Error{ErrorCode::wrong_kind, place, "expects yes or no, found `" + text + "`"};
  }
  return value_from_json(option, Json(text), place);
}

}  // namespace

Result<std::vector<Value>> option_values(const FormatDefinition& format, const std::vector<std::string>& texts) {
  std::vector<Value> values;
  for (const PortDefinition& option : format.ports) values.push_back(option.default_value);
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('='), place = format.port_index(text.substr(0, equals));
    if (place == values.size()) continue;
    auto value = value_of(format.ports[place], text.substr(equals + 1), "--option " + text.substr(0, equals));
    if (!value) return value.error();
    values[place] = *value;
  }
  return values;
}

Result<void> check_option_names(const std::vector<const FormatDefinition*>& formats, const std::vector<std::string>& texts) {
  std::vector<std::string> names;
  for (const FormatDefinition* format : formats)
    for (const PortDefinition& option : format->ports) names.push_back(option.id);
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
      return Error{ErrorCode::parse, "--option", "expects NAME=VALUE, found `" + text + "`"};
    const std::string name = text.substr(0, equals);
    if (std::find(names.begin(), names.end(), name) == names.end())
      return Error{ErrorCode::unknown_field, "--option",
                   "none of these formats has an option `" + name + "`" + did_you_mean(name, names)};
  }
  return {};
}

std::string formats_text() {
  std::string text;
  for (const FormatDefinition& format : all_formats()) {
    std::string id = format.id;
    id.resize(std::max<std::size_t>(id.size(), 8), ' ');
    text += "  " + id + " " + format.label + " (" + format.ending + (format.may_fill_folder ? ", or a folder" : "") + ")\n";
    for (const PortDefinition& option : format.ports) {
      const std::string range = range_text(option);
      text += "             " + option.id + "=" + default_text(option) + "  " + option.doc +
              (range.empty() ? "" : " (" + range + ")") + "\n";
    }
  }
  return text;
}

namespace {

// How a page asks for it: what is none of these is typed as a text.
const char* kind_word(const PortDefinition& option) {
  if (!option.choices.empty()) return "choice";
  switch (option.kind) {
    case ValueKind::boolean: return "boolean";
    case ValueKind::integer: return "integer";
    case ValueKind::number: return "number";
    default: return "text";
  }
}

}  // namespace

std::string formats_json() {
  Json formats = Json::array();
  for (const FormatDefinition& format : all_formats()) {
    Json options = Json::array();
    for (const PortDefinition& option : format.ports) {
      Json one = {{"id", option.id},
                  {"doc", option.doc},
                  {"kind", kind_word(option)},
                  {"default", value_to_json(option.default_value, option)}};
      if (const std::string unit(info(option.unit).pretty); !unit.empty()) one["unit"] = unit;
      if (std::isfinite(option.hard_minimum)) one["minimum"] = option.hard_minimum;
      if (std::isfinite(option.hard_maximum)) one["maximum"] = option.hard_maximum;
      for (const ChoiceDefinition& choice : option.choices) one["choices"].push_back({{"id", choice.id}, {"doc", choice.doc}});
      options.push_back(std::move(one));
    }
    formats.push_back(
        {{"id", format.id}, {"label", format.label}, {"doc", format.doc}, {"ending", format.ending}, {"options", options}});
  }
  return write_json_line(formats) + "\n";
}

std::string format_page(const FormatDefinition& format) {
  std::string page = "# " + format.label + "\n\n`" + format.id + "` · export format · `" + format.ending + "`" +
                     (format.may_fill_folder ? ", or a folder" : "") + "\n\n" + format.doc + "\n";
  if (format.ports.empty()) return page;
  page += "\n| option | unit | default | range | meaning |\n|---|---|---|---|---|\n";
  for (const PortDefinition& option : format.ports)
    page += "| `" + option.id + "` | " + std::string(info(option.unit).pretty) + " | `" + default_text(option) + "` | " +
            range_text(option) + " | " + option.doc + " |\n";
  for (const PortDefinition& option : format.ports)
    for (const ChoiceDefinition& choice : option.choices) page += "\n- `" + option.id + "` = `" + choice.id + "`: " + choice.doc;
  return page + "\n";
}

}  // namespace bl::exporting
