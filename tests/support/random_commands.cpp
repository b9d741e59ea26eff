// Every kind of command with arguments drawn from the scene.
#include "tests/support/random_commands.h"

#include <iterator>
#include <string>

#include <nlohmann/json.hpp>

#include "core/define/codec.h"
#include "core/live/commands.h"
#include "tests/support/random_values.h"

namespace bl {

namespace {

// The first node that plays the role, or `other`.
std::string playing_or(const Scene& scene, const std::string& type, const std::string& other) {
  for (const auto& [id, node] : scene.nodes)
    if (node.types.contains(type)) return id;
  return other;
}

// A port of the node that people set, and what it is set to.
struct SetPlace {
  std::string path = "node.position";
  JsonValue value = {"[3, 4, 5]"};
};

SetPlace some_place(const NodeRecord& node, Random& random) {
  std::vector<SetPlace> places;
  for (const auto& [type, values] : node.types) {
    const TypificationDefinition* definition = full_registry().typification(type);
    for (std::size_t p = 0; definition != nullptr && p < definition->ports.size(); ++p) {
      const PortDefinition& port = definition->ports[p];
      if (port.is_computed) continue;
      const auto set = values.find(port.id);
      const Value& value = set == values.end() ? port.default_value : set->second;
      places.push_back({type + "." + port.id, JsonValue::of(value_to_json(value, port))});
    }
  }
  return places.empty() ? SetPlace() : places[random.below(places.size())];
}

Command unlock_something(const Scene& scene, const std::string& other) {
  for (const auto& [id, node] : scene.nodes)
    if (!node.locked.empty()) return command<UnlockPort>({id, {*node.locked.begin()}});
  return command<UnlockPort>({other, {"node.position"}});
}

std::string random_use(Random& random) {
  static constexpr const char* kUses[] = {"housing", "office", "shop", "school"};
  return kUses[random.below(4)];
}

}  // namespace

Command random_command(const Scene& scene, Random& random, int number) {
  auto pick = [&](const auto& map) {
    auto it = map.begin();
    std::advance(it, static_cast<std::ptrdiff_t>(random.below(map.size())));
    return it->first;
  };
  const std::string fresh = "fresh" + std::to_string(number);
  const std::uint64_t kind = random.below(scene.nodes.empty() || scene.links.empty() ? 1 : 28);
  const std::string number_text = std::to_string(random.below(40));
  switch (kind) {
    case 1: return command<SetPort>({pick(scene.nodes), {"node.position"}, {"[" + number_text + ", 12, 5]"}});
    case 2: return command<RemoveNode>({pick(scene.nodes)});
    case 3: return command<RenameNode>({pick(scene.nodes), "Name " + number_text});
    case 4: return command<RemoveLink>({pick(scene.links)});
    case 5: return command<EnableLink>({pick(scene.links), random.below(2) == 0});
    case 6: return command<MuteLink>({pick(scene.links), random.below(2) == 0});
    case 7: return command<SetLinkStrength>({pick(scene.links), random.uniform()});
    case 8: {
      const std::string id = pick(scene.nodes);
      return command<LockPort>({id, {some_place(scene.nodes.at(id), random).path}});
    }
    case 9: return command<Typify>({pick(scene.nodes), "control", {R"({"value": 3})"}});
    case 10: return command<SetSetting>({"title", {"\"" + number_text + "\""}});
    case 11: return command<Untypify>({pick(scene.nodes), "smart_volume"});
    case 12: return command<SetView>({{R"({"boxes": {")" + pick(scene.nodes) + R"(": [)" + number_text + R"(, 4]}})"}, false});
    case 13:
      return command<SetView>({{R"({"boxes": {")" + pick(scene.nodes) + R"(": null}, "zoom": )" + number_text + "}"}, false});
    case 14:
      return command<AddLink>(
          {fresh, {R"({"kind": "attract", "from": ")" + pick(scene.nodes) + R"(", "to": ")" + pick(scene.nodes) + R"("})"}});
    case 15:
      return command<SetScript>(
          {"walker",
           "return {id = 'walker', doc = 'Walks.', proposes = {move = {at = 'to', port = 'node.position'}},\n"
           "evaluate = function() return {move = point(" +
               number_text + " / 100, 0, 0)} end}",
           false});
    case 16:
      if (scene.scripts.texts().contains("walker") && random.below(3) == 0) return command<RemoveScript>({"walker"});
      return command<AddLink>(
          {fresh, {R"({"kind": "walker", "from": ")" + pick(scene.nodes) + R"(", "to": ")" + pick(scene.nodes) + R"("})"}});
    case 17: return unlock_something(scene, pick(scene.nodes));
    case 18: return command<SetLinkEnds>({pick(scene.links), {{pick(scene.nodes)}, "", ""}, {{pick(scene.nodes)}, "", ""}});
    case 19: {
      const std::string id = pick(scene.links);
      const LinkDefinition* type = full_registry().link(scene.links.at(id).kind);
      if (type == nullptr || type->ports.empty()) return command<SetLinkParameter>({id, "distance", {number_text}});
      const PortDefinition& port = type->ports[random.below(type->ports.size())];
      return command<SetLinkParameter>({id, port.id, JsonValue::of(value_to_json(random_value(port, random), port))});
    }
    case 20:
      return command<live::Receive>({.node = playing_or(scene, "sensor", pick(scene.nodes)),
                                     .value = random.uniform(-50, 50),
                                     .time = "noon",
                                     .problem = random.below(4) == 0 ? "`x` is no number" : "",
                                     .tick = static_cast<std::int64_t>(random.below(20))});
    case 21:
      return command<live::NoteConnection>(
          {playing_or(scene, "sensor", pick(scene.nodes)), random.below(2) == 0 ? "nobody is there, " + number_text : ""});
    case 22:
      return command<Batch>({std::vector{command<RenameNode>({pick(scene.nodes), "B" + number_text}),
                                         command<AddNode>({fresh, {R"({"types": {"sensor": {}}})"}})}});
    case 23:
      return command<SetCell>({playing_or(scene, "programme", pick(scene.nodes)),
                               {"programme.rows"},
                               random_use(random),
                               "floor_area",
                               {number_text + "5"}});
    case 24:
      return command<AddRow>({playing_or(scene, "programme", pick(scene.nodes)),
                              {"programme.rows"},
                              {R"({"use": ")" + random_use(random) + R"(", "floor_area": )" + number_text + "}"},
                              static_cast<std::int64_t>(random.below(4)) - 1});
    case 25:
      return command<RemoveRow>({playing_or(scene, "programme", pick(scene.nodes)), {"programme.rows"}, random_use(random)});
    case 27: {
      // The value that it has: what links have made of it is let go.
      const std::string id = pick(scene.nodes);
      const SetPlace place = some_place(scene.nodes.at(id), random);
      return command<SetPort>({id, {place.path}, place.value});
    }
    case 26:
      return command<CastVote>(
          {playing_or(scene, "vote", pick(scene.nodes)), random_use(random),
           random.below(4) == 0 ? JsonValue::null() : JsonValue(random.below(2) == 0 ? "\"yes\"" : "\"no\"")});
    default:
      return command<AddNode>(
          {fresh, {R"({"position": [)" + number_text + R"(, 8, 6], "types": {"smart_volume": {"demand": 900}}})"}});
  }
}

}  // namespace bl
