// Functions for several commands: JSON arguments, selections without a removed node, and checks before a change.
#pragma once

#include <string>

#include "core/define/json_text.h"
#include "core/session/commands.h"

namespace bl {

/// A value as a command argument.
JsonValue json_of(const Value& value, const PortDefinition& port);
/// A setting of a type from a JSON argument; `null` stands for the default.
Result<Value> argument_value(const TypeDefinition& type, const std::string& port, const JsonValue& json,
                             const std::string& place);
/// Checks that the nodes and ports named in values exist. `self` is the node that is being added, if any.
Result<void> check_references(const SceneEdit& edit, const TypeDefinition& type, const PortValues& values,
                              const std::string& self, const std::string& place);
/// Sets a value, or removes it where it is the default.
void assign(PortValues& values, const PortDefinition& port, const Value& value);
/// The current value of a port as a command argument.
JsonValue current_value(const PortValues& values, const PortDefinition& port);
/// A node's setting: its node, type and port, or an error.
struct PortSite {
  const NodeRecord* node;
  const TypificationDefinition* type;
  const PortDefinition* port;
};
Result<PortSite> find_setting(const SceneEdit& edit, const std::string& node, const PortChoice& port);
/// Does the selection name only nodes of the scene?
Result<void> check_selection(const Scene& scene, const Selection& selection, const std::string& place);
/// The selection without `id`; whether it changed.
bool drop(Selection& selection, const std::string& id);
/// Replaces the scripts. Links of their kinds are read again: they become ghosts where the kind is gone, and ordinary links where
/// it exists again. `back` are the commands that restore the scripts; commands for links that those would not restore exactly are
/// added.
Inverse exchange_scripts(SceneEdit& edit, const Scripts& after, std::vector<Command> back);
/// The id of a new element, or why it cannot be used.
Result<void> check_new_id(const std::string& id, bool is_taken, const std::string& place);

}  // namespace bl
