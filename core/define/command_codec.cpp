// Commands to JSON and back; commands inside a command are read like those around them, each with its place.
#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/define/codec.h"

namespace bl {

namespace {

Result<CommandList> commands_from_json(const Registry& registry, const Json& json, const std::string& place) {
  if (!json.is_array()) return Error{ErrorCode::wrong_kind, place, "expects a list of commands"};
  std::vector<Command> commands;
  commands.reserve(json.size());
  for (std::size_t i = 0; i < json.size(); ++i) {
    auto command = command_from_json(registry, json[i], place + "/" + std::to_string(i));
    if (!command) return command.error();
    commands.push_back(std::move(*command));
  }
  return CommandList(std::move(commands));
}

// The arguments that hold commands: their types are in the registry, which the codec of values does not see.
std::vector<std::string_view> lists_of(const CommandDefinition& definition) {
  std::vector<std::string_view> lists;
  for (const PortDefinition& port : definition.ports)
    if (port.kind == ValueKind::commands) lists.push_back(port.id);
  return lists;
}

}  // namespace

Json command_to_json(const Registry& registry, const Command& command) {
  Json json = Json::object();
  json["command"] = command.id;
  const CommandDefinition* definition = registry.command(command.id);
  if (definition == nullptr) return json;
  Json arguments = ports_to_json(*definition, command.arguments);
  for (const auto& [name, value] : command.arguments) {
    const auto* commands = std::get_if<CommandList>(&value);
    if (commands == nullptr) continue;
    Json& list = arguments[name] = Json::array();
    for (const Command& part : **commands) list.push_back(command_to_json(registry, part));
  }
  if (!arguments.empty()) json["arguments"] = std::move(arguments);
  return json;
}

Result<Command> command_from_json(const Registry& registry, const Json& json, const std::string& place) {
  if (!json.is_object()) return Error{ErrorCode::wrong_kind, place, "expects {\"command\": ..., \"arguments\": {...}}"};
  if (auto keys = check_keys(json, {"command", "arguments"}, place); !keys) return keys.error();
  const auto name = json.find("command");
  if (name == json.end() || !name->is_string()) return Error{ErrorCode::missing, place, "`command` is missing"};
  const CommandDefinition* definition = registry.command(name->get_ref<const std::string&>());
  if (definition == nullptr)
    return Error{ErrorCode::unknown_type, place,
                 "unknown command `" + name->get<std::string>() + "`" +
                     did_you_mean(name->get<std::string>(), keys_of(registry.commands()))};
  static const Json kNoArguments = Json::object();
  const auto given = json.find("arguments");
  const Json& content = given == json.end() ? kNoArguments : *given;
  const std::string here = place.empty() ? "arguments" : place + "/arguments";
  const auto lists = lists_of(*definition);
  auto arguments = ports_from_json(*definition, content, here, lists);
  if (!arguments) return arguments.error();
  for (const std::string_view list : lists) {
    const std::string argument(list);
    const auto part = content.find(argument);
    if (part == content.end() && definition->find_port(list)->is_required)
      return Error{ErrorCode::missing, here, "`" + definition->id + "` needs `" + argument + "`"};
    if (part == content.end()) continue;
    auto commands = commands_from_json(registry, *part, here + "/" + argument);
    if (!commands) return commands.error();
    (*arguments)[argument] = std::move(*commands);
  }
  return Command{definition->id, std::move(*arguments)};
}

}  // namespace bl
