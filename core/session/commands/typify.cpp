// Gives a node a further role.
#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/define/codec.h"
#include "core/session/support.h"

namespace bl {

void Typify::declare(CommandBuilder<Typify>& c) {
  c.id("typify").label("Typify").doc("Gives a node a role, with the role's ports at their defaults or as given.");
  c.argument(&In::node, "node").required().doc("Id of the node.");
  c.argument(&In::typification, "typification").required().doc("Id of the role.");
  c.argument(&In::values, "values").doc("Values of its settings, as in a scene file.");
}

Inverse Typify::apply(SceneEdit& edit, const In& in) {
  auto node = edit.node(in.node);
  if (!node) return node.error();
  const std::string place = "nodes/" + in.node + "/" + in.typification;
  const TypificationDefinition* type = edit.registry().typification(in.typification);
  if (type == nullptr)
    return Error{ErrorCode::unknown_type, place,
                 "unknown typification `" + in.typification + "`" +
                     did_you_mean(in.typification, keys_of(edit.registry().typifications()))};
  if ((*node)->types.contains(type->id)) return Error{ErrorCode::duplicate, place, "the node is a `" + type->id + "` already"};
  const auto json = in.values.read();
  if (!json) return json.error().within(place);
  auto values = ports_from_json(*type, **json, place);
  if (!values) return values.error();
  if (auto known = check_references(edit, *type, *values, "", place); !known) return known.error();
  edit.add_type(in.node, type->id, std::move(*values));
  return std::vector{command<Untypify>({in.node, type->id})};
}

}  // namespace bl

BL_COMMAND(typify, Typify)
