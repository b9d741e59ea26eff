// The table that a script returns, read as a declaration.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/define/registry.h"

struct lua_State;

namespace bl::script {

/// A declaration, and what the script calls its reads and proposals (as link.reads and link.proposes).
struct ScriptDeclaration {
  LinkDefinition link;
  std::vector<std::string> reads, proposes;
};

/// Reads the table on top of the stack, all but `evaluate`, which is only checked to be a function. `text` serves to name the
/// line that a message is about. Runs without limits and raises no Lua errors.
Result<ScriptDeclaration> read_declaration(lua_State* lua, const std::string& file, std::string_view text, const Registry& types);

}  // namespace bl::script
