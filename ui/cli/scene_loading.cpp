// Reads scenes and prints all of their problems.
#include "ui/cli/scene_loading.h"

#include <filesystem>

#include "core/base/foreign_bytes.h"
#include "core/base/packed_kind.h"
#include "core/file/file_io.h"
#include "ui/cli/terminal.h"

namespace bl::cli {

std::optional<SceneReading> load_scene(const std::string& file, bool gets_scripts) {
  const auto text = read_file(file);
  if (!text) {
    print_error(file, text.error());
    return std::nullopt;
  }
  // Of noise and of archives the reader itself says more.
  if (const std::string kind = foreign_kind(*text); !kind.empty() && !kind.starts_with("binary") && packed_kind(*text).empty()) {
    print_error(file, {ErrorCode::parse, "", "this is not a scene but " + kind + "; a scene is JSON text"});
    return std::nullopt;
  }
  SceneReading reading = read_scene(*text, full_registry());
  // Links that rest now may run once their script is there: what is still wrong then is told then.
  if (!gets_scripts || !reading.is_usable()) print_problems(file, reading.problems);
  if (!reading.is_usable()) return std::nullopt;
  return reading;
}

bool may_write(const std::string& out, const std::string& scene, bool is_forced) {
  std::error_code none;
  if (is_forced || !std::filesystem::exists(out, none) || std::filesystem::equivalent(out, scene, none)) return true;
  print_error(out, {ErrorCode::conflict, "", "exists already; choose another name, or replace it with --force"});
  return false;
}

std::string counted(std::size_t number, const std::string& noun) {
  return std::to_string(number) + " " + noun + (number == 1 ? "" : "s");
}

}  // namespace bl::cli
