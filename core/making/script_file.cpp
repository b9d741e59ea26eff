// From a path to a name and a set_script command.
#include "core/making/script_file.h"

#include <filesystem>

#include "core/base/text.h"
#include "core/file/file_io.h"
#include "core/script/link_script.h"

namespace bl::making {

std::string script_name(const std::string& file) { return to_identifier(std::filesystem::path(file).stem().string()); }

Result<Command> script_command(const std::string& file) {
  auto text = read_file(file);
  if (!text) return text.error();
  // What is wrong with a script is told by its name with the ending .lua, which is not the name of this file.
  if (!file.ends_with(".lua") && !script::read_link_script(script_name(file), *text, full_registry()))
    return Error{ErrorCode::wrong_kind, file, "is no link script; these are texts in Lua, and their names end in .lua"};
  return command<SetScript>({script_name(file), std::move(*text), false});
}

}  // namespace bl::making
