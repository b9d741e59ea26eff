// Declares a command: arguments, and one function that changes a scene and returns what undoes it.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/define/port_builder.h"

namespace bl {

class SceneEdit;

/// One change that a person makes to a scene: the command's id and the arguments that differ from their defaults.
struct Command {
  std::string id;
  std::map<std::string, Value> arguments;
  bool operator==(const Command&) const = default;
};

/// A command kind. `apply` leaves the scene as it was when it returns an error.
struct CommandDefinition : TypeDefinition {
  bool keeps_logic = false;   ///< changes by itself nothing that the tick reads
  bool keeps_namers = false;  ///< nobody is named by it who was not before, or it notes that itself
  std::function<Result<std::vector<Command>>(SceneEdit&, std::span<const Value>)> apply;
};

/// T has `struct In` (arguments), `declare(CommandBuilder<T>&)` and
/// `static Result<std::vector<Command>> apply(SceneEdit&, const In&)`, which returns the inverse, in the order to apply.
template <class T>
class CommandBuilder : public TypeBuilder<CommandDefinition> {
 public:
  using TypeBuilder::TypeBuilder;
  using In = typename T::In;

  /// The command changes nothing that the tick reads.
  CommandBuilder& keeps_logic() {
    definition_->keeps_logic = true;
    return *this;
  }
  /// By the command nobody is named who was not named before, or it notes that in the edit.
  CommandBuilder& keeps_namers() {
    definition_->keeps_namers = true;
    return *this;
  }
  template <class M>
  PortBuilder<M> argument(M In::*member, std::string id) {
    return add_port(definition_->ports, member, std::move(id));
  }

  static CommandDefinition build() {
    CommandDefinition definition;
    CommandBuilder builder(definition);
    T::declare(builder);
    const auto ports = std::make_shared<const std::vector<PortDefinition>>(definition.ports);
    definition.apply = [ports](SceneEdit& edit, std::span<const Value> values) {
      In in;
      for (std::size_t p = 0; p < ports->size(); ++p) (*ports)[p].set(&in, values[p]);
      return T::apply(edit, in);
    };
    return definition;
  }

  /// The arguments as a command of this kind.
  static Command command(const In& in) {
    static const CommandDefinition kDefinition = build();
    Command command{kDefinition.id, {}};
    for (const PortDefinition& port : kDefinition.ports)
      if (Value value = port.get(&in); port.is_required || value != port.default_value)
        command.arguments[port.id] = std::move(value);
    return command;
  }
};

}  // namespace bl
