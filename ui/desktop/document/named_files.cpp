// Rewrites paths, and nothing where both folders are the same.
#include "ui/desktop/document/named_files.h"

#include <filesystem>
#include <optional>

#include <nlohmann/json.hpp>

#include "core/address/live_address.h"
#include "core/define/codec.h"
#include "core/file/file_io.h"
#include "core/reading/views/stream.h"
#include "core/reading/views/surroundings.h"
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

Command set_text(const std::string& node, const std::string& port, const std::string& text) {
  return command<SetPort>({node, {port}, JsonValue::of(Json(text))});
}

// A recorded table: one that does not lie below the new folder is copied there.
void name_table(const std::string& node, const std::string& port, const std::string& address, const files::path& from,
                const files::path& to, NamedFiles& named) {
  if (!address.starts_with(kReplay)) return;
  const auto parsed = address::parse_live_address(address);
  if (!parsed || address.compare(kReplay.size(), parsed->path.size(), parsed->path) != 0) return;
  const auto path = found(parsed->path, parsed->path, from);
  if (!path) return;
  auto name = below(*path, to);
  if (!name) {
    const files::path place = place_for(*path, to);
    named.copies.emplace_back(path->string(), place.string());
    name = place.filename().string();
  }
  named.commands.push_back(
      set_text(node, port, std::string(kReplay) + *name + address.substr(kReplay.size() + parsed->path.size())));
}

}  // namespace

NamedFiles files_named_from(const Scene& scene, const std::string& folder, const std::string& target) {
  using namespace reading;
  const Registry& types = full_registry();
  NamedFiles named;
  const files::path from = absolute(folder), to = absolute(target);
  if (from == to) return named;
  for (const auto& [id, node] : scene.nodes) {
    if (const auto media = settings_of<reading::MediaFigures>(scene, types, node))
      if (const auto path = found(media->file, frame_file(media->file, 0, 1, 1), from))
        named.commands.push_back(
            set_text(id, path_of<&reading::MediaFigures::file>(), below(*path, to).value_or(path->generic_string())));
    if (const auto broker = settings_of<reading::BrokerSettings>(scene, types, node))
      for (const auto& [secret, prefix] : {std::pair{broker->ca_file, ""}, std::pair{broker->password_from, "file:"}})
        if (secret.starts_with(prefix)) {
          const std::string name = secret.substr(std::string_view(prefix).size());
          if (found(name, name, from)) named.secrets.push_back(name);
        }
    const auto sensor = settings_of<SensorFigures>(scene, types, node);
    const auto people = settings_of<PeopleFigures>(scene, types, node);
    if (sensor) name_table(id, path_of<&SensorFigures::address>(), sensor->address, from, to, named);
    if (people) name_table(id, path_of<&PeopleFigures::address>(), people->address, from, to, named);
  }
  return named;
}

}  // namespace bl::desktop
