// Declares a command: its arguments, and a function that changes a scene and returns the inverse commands.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/define/port_builder.h"
#include "core/define/rights.h"

namespace bl {

class SceneEdit;
struct Scene;
struct Touch;

/// One change of a scene: the id of the command, and the arguments that differ from their defaults.
struct Command {
  std::string id;
  std::map<std::string, Value> arguments;
  bool operator==(const Command&) const = default;
};

/// A kind of command. `apply` leaves the scene unchanged when it returns an error.
struct CommandDefinition : TypeDefinition {
  std::function<Result<std::vector<Command>>(SceneEdit&, std::span<const Value>)> apply;
  /// Reduces a command to some of its places, given the scene after the whole command; empty where a command applies as a whole
  /// or not at all.
  std::function<Command(const Scene& done, const std::set<Touch>& places)> narrow;
  Rights rights = {};  ///< who may submit it where several people work on a scene
};

/// T has `struct In` (arguments), `static constexpr Rights kRights`, `declare(CommandBuilder<T>&)` and
/// `static Result<std::vector<Command>> apply(SceneEdit&, const In&)`, which returns the inverse, in the order to apply. It may
/// have `static Command narrow(const Scene& done, const std::set<Touch>& places)` (CommandDefinition).
template <class T>
class CommandBuilder : public TypeBuilder<CommandDefinition> {
 public:
  using TypeBuilder::TypeBuilder;
  using In = typename T::In;

  template <class M>
  PortBuilder<M> argument(M In::*member, std::string_view id) {
    return add_port(definition_->ports, member, id);
  }

  static CommandDefinition build() {
    CommandDefinition definition;
    definition.rights = T::kRights;
    CommandBuilder builder(definition);
    T::declare(builder);
    const auto ports = std::make_shared<const std::vector<PortDefinition>>(definition.ports);
    definition.apply = [ports](SceneEdit& edit, std::span<const Value> values) {
      In in;
      set_members(*ports, values, &in);
      return T::apply(edit, in);
    };
    if constexpr (requires { &T::narrow; }) definition.narrow = &T::narrow;
    return definition;
  }

  /// A command of this kind with these arguments.
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
