// Rewrites paths, and nothing where both folders are the same.
#include "ui/desktop/document/named_files.h"

#include <filesystem>
#include <optional>

#include <nlohmann/json.hpp>

#include "core/address/live_address.h"
#include "core/define/codec.h"
#include "core/file/file_io.h"
#include "core/session/commands.h"
#include "ui/desktop/document/media_place.h"

namespace bl::desktop {

namespace {

namespace files = std::filesystem;

constexpr std::string_view kReplay = "replay:";

files::path absolute(const std::string& folder) {
  std::error_code error;
  const files::path path = files::absolute(folder.empty() ? "." : folder, error).lexically_normal();
  return path.has_filename() ? path : path.parent_path();
}

// Where a relative name leads from the old folder; nothing where it leads nowhere, or needs no folder.
std::optional<files::path> found(const std::string& name, const std::string& first, const files::path& from) {
  std::error_code error;
  if (name.empty() || files::path(name).is_absolute() || !files::exists(from / first, error)) return std::nullopt;
  return (from / name).lexically_normal();
}

// Its name below a folder; nothing where it does not lie there.
std::optional<std::string> below(const files::path& path, const files::path& folder) {
  const files::path inside = path.lexically_relative(folder);
  if (inside.empty() || *inside.begin() == "..") return std::nullopt;
  return inside.generic_string();
}

// A name beside the scene that is free, or that the same table has already.
files::path place_for(const files::path& table, const files::path& folder) {
  const auto text = read_file(table.string());
  for (int number = 1;; ++number) {
    const std::string suffix = number == 1 ? "" : "_" + std::to_string(number);
    const files::path place = folder / (table.stem().string() + suffix + table.extension().string());
    std::error_code error;
    if (!files::exists(place, error)) return place;
    if (const auto other = read_file(place.string()); text && other && *text == *other) return place;
  }
}

const std::string* text_of(const NodeRecord& node, const std::string& type, const std::string& port) {
  const auto values = node.types.find(type);
  if (values == node.types.end()) return nullptr;
  const auto value = values->second.find(port);
  return value == values->second.end() ? nullptr : std::get_if<std::string>(&value->second);
}

Command set_text(const std::string& node, const std::string& port, const std::string& text) {
  return command<SetPort>({node, {port}, JsonValue::of(Json(text))});
}

}  // namespace

NamedFiles files_named_from(const Scene& scene, const std::string& folder, const std::string& target) {
  NamedFiles named;
  const files::path from = absolute(folder), to = absolute(target);
  if (from == to) return named;
  for (const auto& [id, node] : scene.nodes) {
    if (const std::string* file = text_of(node, "media", "file"))
      if (const auto path = found(*file, frame_file(*file, 0, 1, 1), from))
        named.commands.push_back(set_text(id, "media.file", below(*path, to).value_or(path->generic_string())));
    for (const auto& [port, prefix] : {std::pair{"ca_file", ""}, std::pair{"password_from", "file:"}})
      if (const std::string* secret = text_of(node, "mqtt_broker", port); secret != nullptr && secret->starts_with(prefix)) {
        const std::string name = secret->substr(std::string_view(prefix).size());
        if (found(name, name, from)) named.secrets.push_back(name);
      }
    const std::string* address = text_of(node, "sensor", "address");
    if (address == nullptr || !address->starts_with(kReplay)) continue;
    const auto parsed = parse_live_address(*address);
    if (!parsed || address->compare(kReplay.size(), parsed->path.size(), parsed->path) != 0) continue;
    const auto path = found(parsed->path, parsed->path, from);
    if (!path) continue;
    auto name = below(*path, to);
    if (!name) {
      const files::path place = place_for(*path, to);
      named.copies.emplace_back(path->string(), place.string());
      name = place.filename().string();
    }
    named.commands.push_back(
        set_text(id, "sensor.address", std::string(kReplay) + *name + address->substr(kReplay.size() + parsed->path.size())));
  }
  return named;
}

}  // namespace bl::desktop
