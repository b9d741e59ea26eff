// Structured arguments: JSON that was read once, and commands inside a command.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "core/base/result.h"

namespace bl {

struct Command;

/// One JSON value as an argument: read once, immutable, and shared by all copies of it.
class JsonValue {
 public:
  /// An object without content.
  JsonValue();
  /// Reads a text. Where it is no JSON, read() gives the error.
  JsonValue(const std::string& text);                            // NOLINT: implicit on purpose
  JsonValue(const char* text) : JsonValue(std::string(text)) {}  // NOLINT: implicit on purpose
  /// JSON made by the program, as if it had been written and read.
  static JsonValue of(nlohmann::ordered_json json);
  static const JsonValue& null();

  /// The value, or why the text is no JSON. Valid as long as a copy of this exists.
  Result<const nlohmann::ordered_json*> read() const;
  bool is_null() const;
  /// On one line; `null` where there is no value.
  std::string text() const;
  bool operator==(const JsonValue& other) const;

 private:
  struct Content;
  explicit JsonValue(std::shared_ptr<const Content> content) : content_(std::move(content)) {}
  std::shared_ptr<const Content> content_;
};

/// Commands as an argument of another one: immutable, and shared by all copies.
class CommandList {
 public:
  CommandList();
  CommandList(std::vector<Command> commands);  // NOLINT: implicit on purpose
  const std::vector<Command>& operator*() const { return *commands_; }
  const std::vector<Command>* operator->() const { return commands_.get(); }
  bool operator==(const CommandList& other) const;

 private:
  std::shared_ptr<const std::vector<Command>> commands_;
};

}  // namespace bl
