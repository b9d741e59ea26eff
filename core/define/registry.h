// All types that the program knows, found by id or alias, listed in ascending id.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/define/command_builder.h"
#include "core/define/definition.h"

namespace bl {

class Registry {
 public:
  /// Ids and aliases must be unique; a clash is a defect of the program and ends it with a message.
  void add(TypificationDefinition definition);
  void add(LinkDefinition definition);
  void add(CommandDefinition definition);

  /// The id or alias of an external type that exists already; empty where the type can be added.
  std::string taken(const TypificationDefinition& definition) const;
  std::string taken(const LinkDefinition& definition) const;

  const TypificationDefinition* typification(std::string_view id) const;
  const LinkDefinition* link(std::string_view id) const;
  const CommandDefinition* command(std::string_view id) const;
  const std::map<std::string, TypificationDefinition, std::less<>>& typifications() const { return typifications_; }
  const std::map<std::string, LinkDefinition, std::less<>>& links() const { return links_; }
  const std::map<std::string, CommandDefinition, std::less<>>& commands() const { return commands_; }

  /// The definition of a port, or the reason why there is none, with the nearest known name.
  Result<const PortDefinition*> port(const PortPath& path) const;

 private:
  std::map<std::string, TypificationDefinition, std::less<>> typifications_;
  std::map<std::string, LinkDefinition, std::less<>> links_;
  std::map<std::string, CommandDefinition, std::less<>> commands_;
  std::map<std::string, std::string, std::less<>> typification_aliases_, link_aliases_, command_aliases_;
};

/// The ids of a map of definitions, for "did you mean".
template <class Map>
std::vector<std::string> keys_of(const Map& map) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : map) keys.push_back(key);
  return keys;
}

/// The ids of the ports of a type.
std::vector<std::string> port_ids(const TypeDefinition& type);

/// The base node's own ports (position, tags): every node carries this typification.
inline constexpr std::string_view kBaseNode = "node";
void register_base_node(Registry& registry);

// Written by the build from the files of the folders nodes/, links/, core/session/commands/ and core/live/commands/.
void register_typifications(Registry& registry);
void register_links(Registry& registry);
void register_commands(Registry& registry);
void register_live_commands(Registry& registry);

/// All types of the program; made once, never changed.
const Registry& full_registry();

}  // namespace bl

/// The last line of each file in the folder: registers the type under the file's stem.
#define BL_TYPIFICATION(stem, Type)                                                                           \
  namespace bl {                                                                                              \
  void register_typification_##stem(Registry& registry) { registry.add(TypificationBuilder<Type>::build()); } \
  }
#define BL_LINK(stem, Type)                                                                   \
  namespace bl {                                                                              \
  void register_link_##stem(Registry& registry) { registry.add(LinkBuilder<Type>::build()); } \
  }
#define BL_COMMAND(stem, Type)                                                                      \
  namespace bl {                                                                                    \
  void register_command_##stem(Registry& registry) { registry.add(CommandBuilder<Type>::build()); } \
  }
