// Every kind of command with arguments drawn from the scene.
#include "tests/support/random_commands.h"

#include <iterator>
#include <string>

namespace bl {

Command random_command(const Scene& scene, Random& random, int number) {
  auto pick = [&](const auto& map) {
    auto it = map.begin();
    std::advance(it, static_cast<std::ptrdiff_t>(random.below(map.size())));
    return it->first;
  };
  const std::string fresh = "fresh" + std::to_string(number);
  const std::uint64_t kind = random.below(scene.nodes.empty() || scene.links.empty() ? 1 : 17);
  const std::string number_text = std::to_string(random.below(40));
  switch (kind) {
    case 1: return command<SetPort>({pick(scene.nodes), {"node.position"}, {"[" + number_text + ", 12, 5]"}});
    case 2: return command<RemoveNode>({pick(scene.nodes)});
    case 3: return command<RenameNode>({pick(scene.nodes), "Name " + number_text});
    case 4: return command<RemoveLink>({pick(scene.links)});
    case 5: return command<EnableLink>({pick(scene.links), random.below(2) == 0});
    case 6: return command<MuteLink>({pick(scene.links), random.below(2) == 0});
    case 7: return command<SetLinkStrength>({pick(scene.links), random.uniform()});
    case 8: return command<LockPort>({pick(scene.nodes), {"node.position"}});
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
    default:
      return command<AddNode>(
          {fresh, {R"({"position": [)" + number_text + R"(, 8, 6], "types": {"smart_volume": {"demand": 900}}})"}});
  }
}

}  // namespace bl
