// Reading, sharing and comparing of structured arguments.
#include "core/define/payload.h"

#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/define/command_builder.h"
#include "core/define/json_text.h"

namespace bl {

struct JsonValue::Content {
  Json json;
  std::optional<Error> error;
};

namespace {

// A text knows no whole number from another one: what is written without a point or an exponent is read as an integer.
void make_whole(Json& json) {
  if (json.is_number_float()) {
    const double number = json.get<double>();
    const std::string text = shortest(number);
    if (text.find_first_not_of("-0123456789") != std::string::npos) return;
    // Beyond these bounds (2^63 and 2^64) a text is read as a number with a point as well.
    if (number >= -0x1p63 && number < 0x1p63) json = static_cast<std::int64_t>(number);
    else if (number > 0 && number < 0x1p64) json = static_cast<std::uint64_t>(number);
  } else if (json.is_structured()) {
    for (Json& part : json) make_whole(part);
  }
}

}  // namespace

JsonValue::JsonValue() {
  static const auto kNothing = std::make_shared<const Content>(Content{Json::object(), {}});
  content_ = kNothing;
}

JsonValue::JsonValue(const std::string& text) {
  auto json = parse_json(text);
  content_ = std::make_shared<const Content>(json ? Content{std::move(*json), {}} : Content{Json(), json.error()});
}

JsonValue JsonValue::of(Json json) {
  make_whole(json);
  return JsonValue(std::make_shared<const Content>(Content{std::move(json), {}}));
}

const JsonValue& JsonValue::null() {
  static const JsonValue kNull = of(Json());
  return kNull;
}

Result<const Json*> JsonValue::read() const {
  if (content_->error) return *content_->error;
  return &content_->json;
}

bool JsonValue::is_null() const { return !content_->error && content_->json.is_null(); }

std::string JsonValue::text() const { return write_json_line(content_->json); }

bool JsonValue::operator==(const JsonValue& other) const {
  return content_ == other.content_ || (content_->error == other.content_->error && content_->json == other.content_->json);
}

CommandList::CommandList() : CommandList(std::vector<Command>()) {}

CommandList::CommandList(std::vector<Command> commands)
    : commands_(std::make_shared<const std::vector<Command>>(std::move(commands))) {}

bool CommandList::operator==(const CommandList& other) const {
  return commands_ == other.commands_ || *commands_ == *other.commands_;
}

}  // namespace bl
