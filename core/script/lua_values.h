// Values of ports to Lua and back.
#pragma once

#include <cstddef>
#include <optional>

#include "core/define/value.h"

struct lua_State;

namespace bl::script {

/// Places for a list of so many values: an odd number, which no table of names has, whose size makes instructions dearer
/// (machine).
inline int list_places(std::size_t values) { return static_cast<int>(values | 1); }

/// Can scripts read ports of this kind?
bool is_readable(ValueKind kind);
/// Pushes a value: points with arithmetic, lists and tables as Lua tables, rows by column name.
void push_value(lua_State* lua, const Value& value);
/// A proposal of that kind (number, point or texts) at a stack index: nothing for nil and false. Raises a Lua error that calls it
/// `name` where it is something else or not finite.
std::optional<Value> proposal_at(lua_State* lua, int index, ValueKind kind, const char* name);

}  // namespace bl::script
