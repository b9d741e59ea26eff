// Rewrites paths, and nothing where both folders are the same.
#include "ui/desktop/app/named_files.h"

#include <filesystem>
#include <optional>

#include <nlohmann/json.hpp>

#include "core/base/live_address.h"
#include "core/define/codec.h"
#include "core/session/commands.h"
#include "ui/desktop/view/media_place.h"

namespace bl::desktop {

namespace {

namespace files = std::filesystem;

constexpr std::string_view kReplay = "replay:";

files::path absolute(const std::string& folder) {
  std::error_code error;
  const files::path path = files::absolute(folder.empty() ? "." : folder, error).lexically_normal();
  return path.has_filename() ? path : path.parent_path();
}

// The name from the new folder; nothing where the old one serves as well.
std::optional<std::string> moved(const std::string& name, const std::string& first, const files::path& from,
                                 const files::path& to) {
  std::error_code error;
  if (name.empty() || files::path(name).is_absolute() || !files::exists(from / first, error)) return std::nullopt;
  const files::path path = (from / name).lexically_normal(), inside = path.lexically_relative(to);
  return inside.empty() || *inside.begin() == ".." ? path.generic_string() : inside.generic_string();
}

const std::string* text_of(const NodeRecord& node, const std::string& type, const std::string& port) {
  const auto values = node.types.find(type);
  if (values == node.types.end()) return nullptr;
  const auto value = values->second.find(port);
  return value == values->second.end() ? nullptr : std::get_if<std::string>(&value->second);
}

Command set_text(const std::string& node, const std::string& port, const std::string& text) {
  return command<SetPort>({node, {port}, {write_json_line(Json(text))}});
}

}  // namespace

std::vector<Command> commands_naming_files_from(const Scene& scene, const std::string& folder, const std::string& target) {
  std::vector<Command> commands;
  const files::path from = absolute(folder), to = absolute(target);
  if (from == to) return commands;
  for (const auto& [id, node] : scene.nodes) {
    if (const std::string* file = text_of(node, "media", "file"))
      if (const auto name = moved(*file, frame_file(*file, 0, 1, 1), from, to))
        commands.push_back(set_text(id, "media.file", *name));
    const std::string* address = text_of(node, "sensor", "address");
    if (address == nullptr || !address->starts_with(kReplay)) continue;
    const auto parsed = parse_live_address(*address);
    if (!parsed || address->compare(kReplay.size(), parsed->path.size(), parsed->path) != 0) continue;
    if (const auto name = moved(parsed->path, parsed->path, from, to))
      commands.push_back(
          set_text(id, "sensor.address", std::string(kReplay) + *name + address->substr(kReplay.size() + parsed->path.size())));
  }
  return commands;
}

}  // namespace bl::desktop
