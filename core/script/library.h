// What a script finds in its globals: a small library without files, clock, addresses or functions that run long in one call.
#pragma once

struct lua_State;

namespace bl::script {

/// What the library's own code is called in messages.
inline constexpr char kLibraryName[] = "(library)";

/// Lua function: opens the library in a fresh machine.
int open_library(lua_State* lua);
/// Pushes a new table of globals, through which the library is seen and cannot be changed.
void push_globals(lua_State* lua);
/// Pushes a point with its arithmetic.
void push_point(lua_State* lua, double x, double y, double z);
/// Makes the table on top say which names it has where a script asks it for another one.
enum class Declared { ends, parameters };
void make_strict(lua_State* lua, Declared what);

}  // namespace bl::script
