// From a path to a name and a set_script command.
#include "ui/cli/script_file.h"

#include <filesystem>

#include "core/base/text.h"
#include "core/file/file_io.h"

namespace bl::cli {

std::string script_name(const std::string& file) { return to_identifier(std::filesystem::path(file).stem().string()); }

Result<Command> script_command(const std::string& file) {
  auto text = read_file(file);
  if (!text) return text.error();
  return command<SetScript>({script_name(file), std::move(*text), false});
}

}  // namespace bl::cli
