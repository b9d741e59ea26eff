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

/// No coordinate [m] and no number may be larger: beyond them a double has no millimetre, or no sense, left.
inline constexpr double kCoordinateLimit = 1e7, kNumberLimit = 1e15;

/// The JSON form of a value of this port; columns of tables only where they differ from their defaults. Meshes and made
/// objects have none.
Json value_to_json(const Value& value, const PortDefinition& port);
/// A value of the declared kind, inside the hard range, finite; otherwise an error at `place`.
Result<Value> value_from_json(const PortDefinition& port, const Json& json, const std::string& place);
/// The same without the ranges of settings, beyond which figures that a run has worked out may lie.
Result<Value> running_value_from_json(const PortDefinition& port, const Json& json, const std::string& place);
/// Is a value that people gave more than the default?
bool is_kept(const PortDefinition& port, const Value& value);
/// Why nobody can set the port at its node; empty where people can.
std::string why_unsettable(const PortDefinition& port);
/// The checks that a value from code must pass too: range, choices, columns, finite numbers.
Result<void> check_value(const PortDefinition& port, const Value& value, const std::string& place);

Json selection_to_json(const Selection& selection);
Result<Selection> selection_from_json(const Json& json, const std::string& place);

/// An object of port values. Unknown names, computed ports and wrong values are errors with their place.
/// `beside` are keys of the object that are none of its ports.
Result<std::map<std::string, Value>> ports_from_json(const TypeDefinition& type, const Json& json, const std::string& place,
                                                     std::span<const std::string_view> beside = {});
/// The values that differ from their defaults, in the order of the declaration.
Json ports_to_json(const TypeDefinition& type, const std::map<std::string, Value>& values);

/// A row of a table port as an object, and the other way round; columns are left out where they are at their defaults.
Json row_to_json(const PortDefinition& port, const TableRow& row);
Result<TableRow> row_from_json(const PortDefinition& port, const Json& json, const std::string& place);

/// {"command": id, "arguments": {...}}
Json command_to_json(const Registry& registry, const Command& command);
Result<Command> command_from_json(const Registry& registry, const Json& json, const std::string& place);

/// The JSON object `json` must hold no other keys than `known`.
Result<void> check_keys(const Json& json, const std::vector<std::string>& known, const std::string& place);
Result<void> check_keys(const Json& json, std::initializer_list<std::string_view> known, const std::string& place);

}  // namespace bl
