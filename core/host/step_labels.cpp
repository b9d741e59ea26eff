// Names steps for people: names for ids, the effect of a change of the view, and one label for many equal commands.
#include "core/host/step_labels.h"

#include <algorithm>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/file/scene_file.h"

namespace bl::host {

namespace {

constexpr std::size_t kMostLetters = 28;  // of a comment

// "3 nodes", which no line breaks apart.
std::string counted(std::size_t count, const std::string& noun) {
  return std::to_string(count) + "\xC2\xA0" + noun + (count == 1 ? "" : "s");
}

const std::string* text_argument(const Command& command, const char* argument) {
  const auto found = command.arguments.find(argument);
  return found == command.arguments.end() ? nullptr : std::get_if<std::string>(&found->second);
}

bool is_off(const Command& command, const char* argument) {
  const auto found = command.arguments.find(argument);
  const auto* value = found == command.arguments.end() ? nullptr : std::get_if<bool>(&found->second);
  return value != nullptr && !*value;
}

Json json_argument(const Command& command, const char* argument) {
  const auto found = command.arguments.find(argument);
  const auto* value = found == command.arguments.end() ? nullptr : std::get_if<JsonValue>(&found->second);
  const auto json = value == nullptr ? Result<const Json*>(nullptr) : value->read();
  return json && *json != nullptr ? **json : Json();
}

std::string name_of(const Scene& scene, const std::string& id) {
  const auto node = scene.nodes.find(id);
  return node != scene.nodes.end() && !node->second.name.empty() ? node->second.name : id;
}

// What a command is about: the name of its node, or the id of its link.
std::string subject_of(const Command& command, const Scene& scene) {
  for (const char* argument : {"node", "id", "setting"})
    if (const std::string* id = text_argument(command, argument)) return name_of(scene, *id);
  return "";
}

std::string name_of_added(const Command& command) {
  const Json node = json_argument(command, "node");
  if (node.is_object() && node.contains("name") && node["name"].is_string()) return node["name"].get<std::string>();
  const std::string* id = text_argument(command, "id");
  return id == nullptr ? "node" : *id;
}

// The members of a part of a patch, as far as it is one.
Json part_of(const Json& patch, const char* key) {
  const auto found = patch.find(key);
  return found != patch.end() && found->is_object() ? *found : Json::object();
}

bool takes_all_away(const Json& part) {
  return !part.empty() && std::all_of(part.begin(), part.end(), [](const Json& entry) { return entry.is_null(); });
}

// "Library" or "3 nodes".
std::string who(const Json& part, const Scene& scene, const std::string& noun) {
  return part.size() == 1 ? name_of(scene, part.begin().key()) : counted(part.size(), noun);
}

std::string label_of_frames(const Json& frames) {
  for (const auto& [id, frame] : frames.items()) {
    if (!frame.is_object() || !frame.contains("name") || !frame["name"].is_string()) continue;
    const std::string name = frame["name"].get<std::string>();
    if (!frame.contains("colour")) return name.empty() ? "Rename frame" : "Rename frame · " + name;
    const std::size_t count = part_of(frame, "nodes").size();
    if (name != "Frame") return "Frame · " + name;
    return count > 0 ? "Frame " + counted(count, "node") : "Frame";
  }
  if (takes_all_away(frames)) return "Remove " + counted(frames.size(), "frame");
  return "";
}

std::string label_of_comments(const Json& comments) {
  if (takes_all_away(comments)) return "Remove " + counted(comments.size(), "comment");
  for (const auto& [id, comment] : comments.items()) {
    if (!comment.is_object()) continue;
    if (comment.contains("text") && comment["text"].is_string()) {
      std::string text = comment["text"].get<std::string>();
      text = text.substr(0, text.find('\n'));
      if (text.size() > kMostLetters) {
        std::size_t end = kMostLetters;
        while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;
        text = text.substr(0, end) + "\xe2\x80\xa6";
      }
      return text.empty() ? "Comment" : "Comment · " + text;
    }
    if (comment.contains("size") && !comment.contains("at")) return "Resize comment";
  }
  return "";
}

std::string label_of_view(const Json& patch, const Scene& scene) {
  if (!patch.is_object()) return "";
  const Json boxes = part_of(patch, "boxes"), sets = part_of(patch, "sets"), comments = part_of(patch, "comments");
  if (const std::string label = label_of_frames(part_of(patch, "frames")); !label.empty()) return label;
  if (const std::string label = label_of_comments(comments); !label.empty()) return label;
  if (const Json part = part_of(patch, "collapsed"); !part.empty())
    return (takes_all_away(part) ? "Expand " : "Collapse ") + who(part, scene, "node");
  if (const Json part = part_of(patch, "hidden"); !part.empty())
    return (takes_all_away(part) ? "Show " : "Hide ") + who(part, scene, "node");
  if (takes_all_away(boxes) || takes_all_away(sets)) return "Lay out all";
  if (const std::size_t count = boxes.size() + sets.size() + comments.size(); count > 0)
    return "Move " + (boxes.size() == 1 && count == 1   ? who(boxes, scene, "")
                      : sets.size() == 1 && count == 1  ? std::string("set")
                      : comments.size() == count        ? counted(count, "comment")
                      : boxes.size() + sets.size() == 0 ? counted(count, "thing")
                                                        : std::to_string(count) + " boxes");
  if (const Json part = part_of(patch, "dots"); !part.empty())
    return (takes_all_away(part) ? "Remove dots of " : "Dot on ") + who(part, scene, "link");
  if (const Json part = part_of(patch, "cameras"); part.size() == 1) return "Keep view " + part.begin().key();
  return part_of(patch, "frames").empty() ? "" : "Change frames";
}

std::string label_of_many(const Registry& registry, std::vector<Command> commands, const Scene& scene) {
  const auto count = [&](const char* id) {
    return static_cast<std::size_t>(
        std::count_if(commands.begin(), commands.end(), [&](const Command& c) { return c.id == id; }));
  };
  // What is put where, is said by what is done.
  if (count("set_view") < commands.size()) std::erase_if(commands, [](const Command& c) { return c.id == "set_view"; });
  if (commands.empty()) return "Batch";
  // Nodes come and go with their links.
  for (const auto& [id, verb] : {std::pair{"add_node", "Add "}, std::pair{"remove_node", "Remove "}}) {
    const std::size_t nodes = count(id);
    if (nodes > 1) return verb + counted(nodes, "node");
    if (nodes == 1)
      return label_of_step(registry,
                           *std::find_if(commands.begin(), commands.end(), [&](const Command& c) { return c.id == id; }), scene);
  }
  const std::string& id = commands.front().id;
  if (commands.size() > 1 && count(id.c_str()) == commands.size()) {
    const std::string links = counted(commands.size(), "link");
    if (id == "mute_link") return (is_off(commands.front(), "muted") ? "Unmute " : "Mute ") + links;
    if (id == "enable_link") return (is_off(commands.front(), "enabled") ? "Disable " : "Enable ") + links;
    if (id == "remove_link") return "Remove " + links;
    if (id == "add_link") return "Add " + links;
    if (id == "set_link_ends") return "Reconnect " + links;
  }
  return label_of_step(registry, commands.front(), scene) +
         (commands.size() > 1 ? " and " + std::to_string(commands.size() - 1) + " more" : std::string());
}

}  // namespace

std::string label_of_step(const Registry& registry, const Command& command, const Scene& scene) {
  if (command.id == "batch") {
    const auto list = command.arguments.find("commands");
    const auto* commands = list == command.arguments.end() ? nullptr : std::get_if<CommandList>(&list->second);
    return label_of_many(registry, commands == nullptr ? std::vector<Command>() : **commands, scene);
  }
  const CommandDefinition* definition = registry.command(command.id);
  std::string label = definition != nullptr ? definition->label : command.id;
  if (command.id == "add_node") return "Add " + name_of_added(command);
  if (command.id == "set_view") {
    const std::string said = is_off(command, "whole") || !command.arguments.contains("whole")
                                 ? label_of_view(json_argument(command, "changes"), scene)
                                 : std::string();
    return said.empty() ? label : said;
  }
  if (command.id == "cast_vote" && json_argument(command, "ballot").is_null()) label = "Withdraw vote";
  if (command.id == "mute_link" && is_off(command, "muted")) label = "Unmute";
  if (command.id == "enable_link" && is_off(command, "enabled")) label = "Disable";
  const std::string subject = subject_of(command, scene);
  const std::string* path = text_argument(command, "port");
  const std::string what = path == nullptr ? "" : ", " + path->substr(path->find('.') + 1);
  return label + (subject.empty() ? "" : " · " + subject) + what;
}

std::string label_of_place(const Touch& place, const Scene& scene) {
  std::string what = place.path;
  for (const char* prefix : {"types/", "parameters/"})
    if (what.starts_with(prefix)) what = what.substr(std::string(prefix).size());
  // Of `smart_volume/demand` the port is enough.
  if (place.part == ScenePart::node && place.path.starts_with("types/") && what.find('/') != std::string::npos)
    what = what.substr(what.find('/') + 1);
  const std::string subject = place.part == ScenePart::node ? name_of(scene, place.id) : place.id;
  return subject + (subject.empty() || what.empty() ? "" : ", ") + what;
}

}  // namespace bl::host
