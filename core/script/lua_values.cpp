// Pushing by alternative of the variant, reading by declared kind.
#include "core/script/lua_values.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <lua.hpp>

#include "core/script/library.h"
#include "core/script/link_script.h"
#include "core/script/utf8.h"

namespace bl::script {

namespace {

// Lua compares two texts piece by piece between their zero bytes: thousands of pieces in one instruction. So scripts know no
// texts with zero bytes: neither from ports, nor from their own source (machine), nor made by the library.
void push_text(lua_State* lua, const std::string& text) {
  if (text.find('\0') != std::string::npos) luaL_error(lua, "a text that the link reads holds a zero byte");
  lua_pushlstring(lua, text.data(), text.size());
}

template <class T>
void push_numbers(lua_State* lua, const std::vector<T>& numbers) {
  lua_createtable(lua, list_places(numbers.size()), 0);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    lua_pushnumber(lua, static_cast<double>(numbers[i]));
    lua_rawseti(lua, -2, static_cast<lua_Integer>(i + 1));
  }
}

void push_scalar(lua_State* lua, const Scalar& scalar) {
  if (const double* number = std::get_if<double>(&scalar)) return lua_pushnumber(lua, *number);
  if (const std::string* text = std::get_if<std::string>(&scalar)) return push_text(lua, *text);
  if (const Numbers* numbers = std::get_if<Numbers>(&scalar)) return push_numbers(lua, **numbers);
  push_numbers(lua, **std::get_if<Indices>(&scalar));
}

void push_table(lua_State* lua, const Table& table) {
  lua_createtable(lua, list_places(table.rows.size()), 0);
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    lua_createtable(lua, 0, static_cast<int>(table.columns.size()));
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      push_text(lua, table.columns[c]);
      push_scalar(lua, table.rows[r][c]);
      lua_rawset(lua, -3);
    }
    lua_rawseti(lua, -2, static_cast<lua_Integer>(r + 1));
  }
}

double coordinate(lua_State* lua, int index, const char* axis, const char* name) {
  lua_getfield(lua, index, axis);
  if (lua_type(lua, -1) != LUA_TNUMBER) luaL_error(lua, "`%s` needs a point {x = , y = , z = }; %s is no number", name, axis);
  const double number = lua_tonumber(lua, -1);
  if (!std::isfinite(number)) luaL_error(lua, "%s of `%s` is not a finite number", axis, name);
  lua_pop(lua, 1);
  return number;
}

}  // namespace

bool is_readable(ValueKind kind) {
  return !is_derived(kind) && kind != ValueKind::json && kind != ValueKind::selection && kind != ValueKind::commands;
}

// Nothing in here may hold something with a destructor while Lua is called: an error leaves by a jump.
void push_value(lua_State* lua, const Value& value) {
  if (const bool* flag = std::get_if<bool>(&value)) return lua_pushboolean(lua, *flag ? 1 : 0);
  if (const std::int64_t* whole = std::get_if<std::int64_t>(&value)) return lua_pushinteger(lua, *whole);
  if (const double* number = std::get_if<double>(&value)) return lua_pushnumber(lua, *number);
  if (const std::string* text = std::get_if<std::string>(&value)) return push_text(lua, *text);
  if (const Vector3* point = std::get_if<Vector3>(&value)) return push_point(lua, point->x, point->y, point->z);
  if (const auto* table = std::get_if<Shared<Table>>(&value)) return push_table(lua, **table);
  if (const auto* numbers = std::get_if<Numbers>(&value)) return push_numbers(lua, **numbers);
  if (const auto* points = std::get_if<Shared<std::vector<Point3>>>(&value)) {
    lua_createtable(lua, list_places((*points)->size()), 0);
    for (std::size_t i = 0; i < (*points)->size(); ++i) {
      push_point(lua, (**points)[i].x, (**points)[i].y, (**points)[i].z);
      lua_rawseti(lua, -2, static_cast<lua_Integer>(i + 1));
    }
    return;
  }
  if (const auto* texts = std::get_if<Shared<std::vector<std::string>>>(&value)) {
    lua_createtable(lua, list_places((*texts)->size()), 0);
    for (std::size_t i = 0; i < (*texts)->size(); ++i) {
      push_text(lua, (**texts)[i]);
      lua_rawseti(lua, -2, static_cast<lua_Integer>(i + 1));
    }
    return;
  }
  lua_pushnil(lua);
}

namespace {

// A list of texts. Checked as a whole before a C++ list is made of it, which an error's jump would leave behind.
Value texts_at(lua_State* lua, int index, const char* name) {
  if (lua_type(lua, index) != LUA_TTABLE)
    luaL_error(lua, "`%s` needs a list of texts, not a %s", name, luaL_typename(lua, index));
  const auto count = static_cast<lua_Integer>(lua_rawlen(lua, index));
  std::size_t whole = 0;
  for (lua_Integer i = 1; i <= count; ++i) {
    if (lua_rawgeti(lua, index, i) != LUA_TSTRING)
      luaL_error(lua, "`%s` needs a list of texts; one is a %s", name, luaL_typename(lua, -1));
    std::size_t length = 0;
    const char* text = lua_tolstring(lua, -1, &length);
    // One long text may stand in a list many times.
    whole += length;
    if (whole > ScriptLimits::kPiece)
      luaL_error(lua, "the texts of `%s` have more than %d KiB", name, static_cast<int>(ScriptLimits::kPiece >> 10));
    if (!is_utf8({text, length})) luaL_error(lua, "a text of `%s` is no UTF-8", name);
    lua_pop(lua, 1);
  }
  std::vector<std::string> texts;
  for (lua_Integer i = 1; i <= count; ++i) {
    lua_rawgeti(lua, index, i);
    std::size_t length = 0;
    const char* text = lua_tolstring(lua, -1, &length);
    texts.emplace_back(text, length);
    lua_pop(lua, 1);
  }
  return Shared<std::vector<std::string>>(std::move(texts));
}

}  // namespace

std::optional<Value> proposal_at(lua_State* lua, int index, ValueKind kind, const char* name) {
  index = lua_absindex(lua, index);
  if (lua_isnil(lua, index) || (lua_isboolean(lua, index) && lua_toboolean(lua, index) == 0)) return std::nullopt;
  if (kind == ValueKind::texts) return texts_at(lua, index, name);
  if (kind == ValueKind::point) {
    if (lua_type(lua, index) != LUA_TTABLE)
      luaL_error(lua, "`%s` needs a point {x = , y = , z = }, not a %s", name, luaL_typename(lua, index));
    const double x = coordinate(lua, index, "x", name), y = coordinate(lua, index, "y", name),
                 z = coordinate(lua, index, "z", name);
    return Value(Vector3{x, y, z});
  }
  if (lua_type(lua, index) != LUA_TNUMBER) luaL_error(lua, "`%s` needs a number, not a %s", name, luaL_typename(lua, index));
  const double number = lua_tonumber(lua, index);
  if (!std::isfinite(number)) luaL_error(lua, "`%s` is not a finite number", name);
  return Value(number);
}

}  // namespace bl::script
