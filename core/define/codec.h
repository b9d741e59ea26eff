// Values to JSON and back, checked against their declaration; every error carries its place.
#pragma once

#include <initializer_list>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/define/command_builder.h"
#include "core/define/json_text.h"
#include "core/define/registry.h"

namespace bl {

/// The largest coordinate [m] and the largest number. Beyond them a double cannot resolve a millimetre, or the number makes no
/// sense.
inline constexpr double kCoordinateLimit = 1e7, kNumberLimit = 1e15;

/// The JSON form of a value of this port; columns of tables only where they differ from their defaults. Meshes and made
/// objects have none.
Json value_to_json(const Value& value, const PortDefinition& port);
/// Reads a value of the declared kind: finite and inside the hard range; otherwise an error at `place`.
Result<Value> value_from_json(const PortDefinition& port, const Json& json, const std::string& place);
/// The same without the ranges of settings, since computed values may lie beyond them.
Result<Value> running_value_from_json(const PortDefinition& port, const Json& json, const std::string& place);
/// Is a value that people set kept although it may equal the default?
bool is_kept(const PortDefinition& port, const Value& value);
/// Why the port cannot be set at its node; empty where it can.
std::string why_unsettable(const PortDefinition& port);
/// The checks for values from code: range, choices, columns, finite numbers.
Result<void> check_value(const PortDefinition& port, const Value& value, const std::string& place);

Json selection_to_json(const Selection& selection);
Result<Selection> selection_from_json(const Json& json, const std::string& place);

/// Reads an object of port values. Unknown names, computed ports and wrong values are errors with their place. `beside` are
/// allowed keys of the object that are no ports.
Result<std::map<std::string, Value>> ports_from_json(const TypeDefinition& type, const Json& json, const std::string& place,
                                                     std::span<const std::string_view> beside = {});
/// The values that differ from their defaults, in the order of the declaration.
Json ports_to_json(const TypeDefinition& type, const std::map<std::string, Value>& values);

/// A row of a table port as an object, and back; columns with their default values are left out.
Json row_to_json(const PortDefinition& port, const TableRow& row);
Result<TableRow> row_from_json(const PortDefinition& port, const Json& json, const std::string& place);

/// {"command": id, "arguments": {...}}
Json command_to_json(const Registry& registry, const Command& command);
Result<Command> command_from_json(const Registry& registry, const Json& json, const std::string& place);

/// Checks that the JSON object `json` has no other keys than `known`.
Result<void> check_keys(const Json& json, const std::vector<std::string>& known, const std::string& place);
Result<void> check_keys(const Json& json, std::initializer_list<std::string_view> known, const std::string& place);

}  // namespace bl
