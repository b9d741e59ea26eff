// Look-ups in the registry, and the base node that every node is.
#include "core/define/registry.h"

#include <cstdio>
#include <cstdlib>

#include "core/base/text.h"
#include "core/define/typification_builder.h"

namespace bl {

namespace {

template <class Definition>
void insert(std::map<std::string, Definition, std::less<>>& types, std::map<std::string, std::string, std::less<>>& aliases,
            Definition definition) {
  const std::string id = definition.id;
  bool is_new = !aliases.contains(id);
  for (const std::string& alias : definition.aliases)
    is_new = aliases.emplace(alias, id).second && !types.contains(alias) && is_new;
  is_new = types.emplace(id, std::move(definition)).second && is_new;
  if (is_new) return;
  std::fprintf(stderr, "behaviourlinks: two types declare the id or alias of `%s`\n", id.c_str());
  std::abort();
}

template <class Definition>
const Definition* find(const std::map<std::string, Definition, std::less<>>& types,
                       const std::map<std::string, std::string, std::less<>>& aliases, std::string_view id) {
  if (const auto it = types.find(id); it != types.end()) return &it->second;
  if (const auto alias = aliases.find(id); alias != aliases.end()) return &types.find(alias->second)->second;
  return nullptr;
}

template <class Definition>
std::string first_taken(const std::map<std::string, Definition, std::less<>>& types,
                        const std::map<std::string, std::string, std::less<>>& aliases, const Definition& definition) {
  if (find(types, aliases, definition.id) != nullptr) return definition.id;
  for (const std::string& alias : definition.aliases)
    if (find(types, aliases, alias) != nullptr) return alias;
  return "";
}

}  // namespace

std::string Registry::taken(const TypificationDefinition& definition) const {
  return first_taken(typifications_, typification_aliases_, definition);
}
std::string Registry::taken(const LinkDefinition& definition) const { return first_taken(links_, link_aliases_, definition); }

void Registry::add(TypificationDefinition definition) { insert(typifications_, typification_aliases_, std::move(definition)); }
void Registry::add(LinkDefinition definition) { insert(links_, link_aliases_, std::move(definition)); }
void Registry::add(CommandDefinition definition) { insert(commands_, command_aliases_, std::move(definition)); }

const TypificationDefinition* Registry::typification(std::string_view id) const {
  return find(typifications_, typification_aliases_, id);
}
const LinkDefinition* Registry::link(std::string_view id) const { return find(links_, link_aliases_, id); }
const CommandDefinition* Registry::command(std::string_view id) const { return find(commands_, command_aliases_, id); }

std::vector<std::string> port_ids(const TypeDefinition& type) {
  std::vector<std::string> ids;
  for (const PortDefinition& port : type.ports) ids.push_back(port.id);
  return ids;
}

Result<const PortDefinition*> Registry::port(const PortPath& path) const {
  const TypificationDefinition* type = typification(path.typification);
  if (type == nullptr)
    return Error{ErrorCode::unknown_type, "",
                 "unknown typification `" + path.typification + "`" + did_you_mean(path.typification, keys_of(typifications_))};
  if (const PortDefinition* port = type->find_port(path.port)) return port;
  return Error{ErrorCode::unknown_field, "",
               "`" + type->id + "` has no port `" + path.port + "`" + did_you_mean(path.port, port_ids(*type))};
}

namespace {

// The entity itself: where it stands and how it is grouped.
struct BaseNode {
  struct In {
    Point3 position;
    std::vector<std::string> tags;
  };
  struct Out {};

  static void declare(TypificationBuilder<BaseNode>& t) {
    t.id(std::string(kBaseNode)).label("Node").doc("Base of every node: an entity with a position and tags.");
    t.in(&In::position, "position")
        .unit(Unit::metre)
        .combine(CombineRule::sum)
        .step_limit(5)
        .doc("Position of the node. Links move it by at most 5 m in a tick.");
    t.in(&In::tags, "tags").doc("Words to group nodes by; links and statistics can address all nodes with a tag.");
  }
};

}  // namespace

void register_base_node(Registry& registry) { registry.add(TypificationBuilder<BaseNode>::build()); }

}  // namespace bl
