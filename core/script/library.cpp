// The library: chosen functions of Lua's own, and replacements for those that are slow, unstable or show addresses.
#include "core/script/library.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <string_view>

#include <lua.hpp>

#include "core/base/hash.h"
#include "core/base/random.h"
#include "core/script/lua_mathematics.h"
#include "core/script/machine.h"

namespace bl::script {

namespace {

// Places in Lua's registry, by address.
char globals_key, point_key, ends_key, parameters_key;

// Written in Lua, so that the instructions of all of it are counted. Why each stands here:
//   pairs      walks in sorted order: Lua's own follows hashes that differ from run to run;
//   sort       is stable: Lua's own takes its pivots from the clock;
//   insert, remove, concat, unpack: Lua's own run through a whole table within one instruction;
//   tostring: never shows an address.
// Patterns (find, match, gmatch, gsub) can run for ever within one instruction, and are left out, as is rep.
constexpr char kLibrary[] = R"lua(
local raw = ...
local type, tostring, error, select, unpack = raw.type, raw.tostring, raw.error, raw.select, raw.unpack

local function plain_less(a, b) return a < b end

local function merge(list, low, middle, high, less, spare)
  for i = low, high do spare[i] = list[i] end
  local left, right = low, middle + 1
  for i = low, high do
    if right > high or (left <= middle and not less(spare[right], spare[left])) then
      list[i] = spare[left]
      left = left + 1
    else
      list[i] = spare[right]
      right = right + 1
    end
  end
end

local function sort_part(list, low, high, less, spare)
  if low >= high then return end
  local middle = (low + high) // 2
  sort_part(list, low, middle, less, spare)
  sort_part(list, middle + 1, high, less, spare)
  merge(list, low, middle, high, less, spare)
end

local function sort(list, less) sort_part(list, 1, #list, less or plain_less, {}) end

local function key_less(a, b)
  local first, second = type(a), type(b)
  if first ~= second then return first < second end
  if first == "boolean" then return not a and b end
  return a < b
end

local function pairs(list)
  local keys = {}
  for key in raw.next, list do
    local kind = type(key)
    if kind ~= "number" and kind ~= "string" and kind ~= "boolean" then
      error("pairs needs keys that are numbers, texts or truth values", 2)
    end
    keys[#keys + 1] = key
  end
  sort(keys, key_less)
  local at = 0
  return function()
    at = at + 1
    local key = keys[at]
    if key ~= nil then return key, list[key] end
  end
end

local function safe_tostring(value)
  local kind = type(value)
  if kind == "number" or kind == "string" or kind == "boolean" or kind == "nil" then return tostring(value) end
  return kind
end

local lists = {sort = sort}
function lists.insert(list, ...)
  local count, given, at, value = #list, select("#", ...), ...
  if given == 1 then
    at, value = count + 1, at
  elseif given ~= 2 then
    error("insert takes a list, a place where it is not the end, and a value", 2)
  end
  if type(at) ~= "number" or at < 1 or at > count + 1 then error("insert: there is no place " .. safe_tostring(at), 2) end
  for i = count, at, -1 do list[i + 1] = list[i] end
  list[at] = value
end
function lists.remove(list, at)
  local count = #list
  at = at or count
  local value = list[at]
  if at < 1 or at > count then return nil end
  for i = at, count do list[i] = list[i + 1] end
  return value
end
function lists.concat(list, between, from, to)
  from, to = from or 1, to or #list
  local text = ""
  for i = from, to do text = text .. (i > from and between or "") .. list[i] end
  return text
end
function lists.unpack(list, from, to)
  from, to = from or 1, to or #list
  if to - from >= 100 then error("unpack gives at most 100 values", 2) end
  return unpack(list, from, to)
end

-- `ends` and `params` hold what was declared; another name is a slip.
local function strict(name)
  return {__metatable = false, __index = function(list, key)
    local names = ""
    for known in pairs(list) do names = names .. (names == "" and "; it has `" or "`, `") .. known end
    error("`" .. name .. "` has no `" .. safe_tostring(key) .. "`" .. (names == "" and "" or names .. "`"), 2)
  end}
end

-- Points for both sides; the error is that of the line that calculates.
local function check_point(value, what)
  if type(value) == "table" and type(value.x) == "number" and type(value.y) == "number" and type(value.z) == "number" then return end
  local found = value == nil and "nil, a name that holds nothing" or "a " .. type(value)
  error(what .. " needs a point on both sides; one is " .. found, 3)
end
local function check_number(value, what)
  if type(value) ~= "number" then
    error("a point is " .. what .. " by a number, not by a " .. (type(value) == "table" and "point" or type(value)) .. "; a:dot(b) multiplies two points", 3)
  end
end

local methods, meta = {}, {__metatable = false}
meta.__index = methods
local function point(x, y, z) return raw.setmetatable({x = x or 0, y = y or 0, z = z or 0}, meta) end
function meta.__add(a, b)
  check_point(a, "a sum")
  check_point(b, "a sum")
  return point(a.x + b.x, a.y + b.y, a.z + b.z)
end
function meta.__sub(a, b)
  check_point(a, "a difference")
  check_point(b, "a difference")
  return point(a.x - b.x, a.y - b.y, a.z - b.z)
end
function meta.__unm(a) return point(-a.x, -a.y, -a.z) end
function meta.__mul(a, b)
  if type(a) == "number" then return point(a * b.x, a * b.y, a * b.z) end
  check_number(b, "multiplied")
  return point(a.x * b, a.y * b, a.z * b)
end
function meta.__div(a, b)
  if type(a) == "number" then error("a number cannot be divided by a point", 2) end
  check_number(b, "divided")
  return point(a.x / b, a.y / b, a.z / b)
end
function meta.__eq(a, b) return a.x == b.x and a.y == b.y and a.z == b.z end
function methods.dot(a, b)
  check_point(a, "dot")
  check_point(b, "dot")
  return a.x * b.x + a.y * b.y + a.z * b.z
end
function methods.length(a) return raw.sqrt(a.x * a.x + a.y * a.y + a.z * a.z) end

return strict("ends"), strict("params"), meta, {pairs = pairs, tostring = safe_tostring, point = point}, lists
)lua";

// random(...): a number from 0 to below 1 that follows from the arguments alone: ids, tick.index, counters.
int random_of(lua_State* lua) {
  Hash hash;
  const int count = lua_gettop(lua);
  for (int i = 1; i <= count; ++i) switch (lua_type(lua, i)) {
      case LUA_TNUMBER: hash.add(lua_tonumber(lua, i)); break;
      case LUA_TBOOLEAN: hash.add(std::uint64_t{lua_toboolean(lua, i) != 0 ? 2u : 1u}); break;
      case LUA_TSTRING: {
        std::size_t length = 0;
        const char* text = lua_tolstring(lua, i, &length);
        hash.add(std::string_view(text, length));
        break;
      }
      default: return luaL_error(lua, "random takes numbers, texts and truth values: what the number shall follow from");
    }
  if (count == 0)
    return luaL_error(lua, "random needs to know what the number shall follow from, such as random(ends.id, tick.index)");
  lua_pushnumber(lua, Random(hash.value()).uniform());
  return 1;
}

// What the values from `first` to the top cost beyond the one instruction that hands them on: texts by their bytes.
std::int64_t cost_of(lua_State* lua, int first, std::size_t bytes_per_instruction) {
  std::int64_t cost = 0;
  for (int i = first; i <= lua_gettop(lua); ++i)
    cost += 1 + (lua_type(lua, i) == LUA_TSTRING ? static_cast<std::int64_t>(lua_rawlen(lua, i) / bytes_per_instruction) : 0);
  return cost;
}

// Lua's own function, the first upvalue, with its work counted: it would run through a whole text or a long list of arguments
// for the price of one call. What it makes must not hold a zero byte (see push_text in lua_values).
int counted(lua_State* lua) {
  charge(lua, cost_of(lua, 1, 8));
  const int results = lua_tocfunction(lua, lua_upvalueindex(1))(lua);
  const int first = lua_gettop(lua) - results + 1;
  for (int i = first; i <= lua_gettop(lua); ++i)
    if (lua_type(lua, i) == LUA_TSTRING && std::memchr(lua_tostring(lua, i), 0, lua_rawlen(lua, i)) != nullptr)
      return luaL_error(lua, "a text cannot hold a zero byte");
  charge(lua, cost_of(lua, first, 4));
  return results;
}

// format(pattern, ...): refuses what shows an address (%p) or how this system writes a number (%a, also within %q), as Lua itself
// reads the pattern: after % come flags, width and precision, then the letter.
int format_of(lua_State* lua) {
  std::size_t length = 0;
  const char* text = luaL_checklstring(lua, 1, &length);
  const std::string_view pattern(text, length);
  for (std::size_t i = pattern.find('%'); i < pattern.size(); i = pattern.find('%', i + 1)) {
    i = pattern.find_first_not_of("-+ #0123456789.", i + 1);
    if (i >= pattern.size()) break;
    if (std::string_view("paAq").find(pattern[i]) != std::string_view::npos)
      return luaL_error(lua, "format knows no %%%c", pattern[i]);
  }
  for (int i = 2; i <= lua_gettop(lua); ++i) {
    const int type = lua_type(lua, i);
    if (type != LUA_TNUMBER && type != LUA_TSTRING && type != LUA_TBOOLEAN)
      return luaL_error(lua, "format takes numbers and texts");
  }
  return counted(lua);
}

// byte(text, from, to): at most a hundred values, as unpack gives.
int byte_of(lua_State* lua) {
  constexpr lua_Integer kMost = 100;
  std::size_t length = 0;
  luaL_checklstring(lua, 1, &length);
  const auto count = static_cast<lua_Integer>(length);
  const auto place = [count](lua_Integer at) { return at >= 0 ? at : at < -count ? 0 : count + at + 1; };
  const lua_Integer from = place(luaL_optinteger(lua, 2, 1)), to = place(luaL_optinteger(lua, 3, from));
  if (std::min(to, count) - std::max<lua_Integer>(from, 1) >= kMost) return luaL_error(lua, "byte gives at most 100 values");
  return counted(lua);
}

int refuse_change(lua_State* lua) { return luaL_error(lua, "the library cannot be changed"); }

// The functions of `names` out of the table at `from` into that at `to`; positive indices.
void take(lua_State* lua, int from, int to, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    lua_getfield(lua, from, name);
    lua_setfield(lua, to, name);
  }
}

// Puts `function`, which calls what stands there now, in the place of an entry of the table at `to`.
void wrap(lua_State* lua, int to, const char* name, lua_CFunction function) {
  lua_getfield(lua, to, name);
  lua_pushcclosure(lua, function, 1);
  lua_setfield(lua, to, name);
}

// The same for each C function among `names`.
void count_all(lua_State* lua, int to, std::initializer_list<const char*> names) {
  for (const char* name : names) wrap(lua, to, name, counted);
}

// All entries of the table on top go into the one at `to`; pops it.
void pour(lua_State* lua, int to) {
  lua_pushnil(lua);
  while (lua_next(lua, -2) != 0) {
    lua_pushvalue(lua, -2);
    lua_insert(lua, -2);
    lua_settable(lua, to);
  }
  lua_pop(lua, 1);
}

// Replaces the table on top by an empty one that shows it and refuses changes.
void shield(lua_State* lua) {
  lua_newtable(lua);
  lua_createtable(lua, 0, 3);
  lua_pushvalue(lua, -3);
  lua_setfield(lua, -2, "__index");
  lua_pushcfunction(lua, refuse_change);
  lua_setfield(lua, -2, "__newindex");
  lua_pushboolean(lua, 0);
  lua_setfield(lua, -2, "__metatable");
  lua_setmetatable(lua, -2);
  lua_remove(lua, -2);
}

// Pushes what the Lua part of the library is made from.
void push_raw(lua_State* lua, int base, int list, int math) {
  lua_newtable(lua);
  const int raw = lua_gettop(lua);
  take(lua, base, raw, {"type", "tostring", "error", "select", "next", "setmetatable"});
  take(lua, list, raw, {"unpack"});
  take(lua, math, raw, {"sqrt"});
}

}  // namespace

int open_library(lua_State* lua) {
  luaL_requiref(lua, "_G", luaopen_base, 0);        // 1
  luaL_requiref(lua, "string", luaopen_string, 0);  // 2
  luaL_requiref(lua, "table", luaopen_table, 0);    // 3
  luaL_requiref(lua, "math", luaopen_math, 0);      // 4
  lua_createtable(lua, 0, 24);                      // 5: globals
  lua_newtable(lua);                                // 6: string
  lua_newtable(lua);                                // 7: table
  lua_newtable(lua);                                // 8: math
  take(lua, 1, 5, {"assert", "error", "ipairs", "select", "tonumber", "type"});
  take(lua, 2, 6, {"byte", "char", "format", "len", "lower", "reverse", "sub", "upper"});
  take(lua, 4, 8,
       {"abs", "acos", "asin",       "atan",       "ceil", "cos", "deg", "exp",  "floor",     "fmod", "huge", "log", "max",
        "min", "modf", "maxinteger", "mininteger", "pi",   "rad", "sin", "sqrt", "tointeger", "tan",  "type", "ult"});
  put_mathematics(lua, 8, 5);
  count_all(lua, 5, {"select", "tonumber"});
  count_all(lua, 6, {"char", "len", "lower", "reverse", "sub", "upper"});
  wrap(lua, 6, "byte", byte_of);
  wrap(lua, 6, "format", format_of);
  count_all(lua, 8, {"abs", "acos", "asin", "atan", "ceil", "cos", "deg",  "exp", "floor",     "fmod",
                     "log", "max",  "min",  "modf", "rad",  "sin", "sqrt", "tan", "tointeger", "ult"});
  if (luaL_loadbufferx(lua, kLibrary, sizeof kLibrary - 1, "=(library)", "t") != LUA_OK) return lua_error(lua);
  push_raw(lua, 1, 3, 4);
  lua_call(lua, 1, 5);
  pour(lua, 7);
  pour(lua, 5);
  lua_rawsetp(lua, LUA_REGISTRYINDEX, &point_key);
  lua_rawsetp(lua, LUA_REGISTRYINDEX, &parameters_key);
  lua_rawsetp(lua, LUA_REGISTRYINDEX, &ends_key);
  lua_pushcfunction(lua, random_of);
  lua_setfield(lua, 5, "random");
  count_all(lua, 5, {"random"});
  // ("text"):upper() looks into the chosen functions, too.
  lua_pushliteral(lua, "");
  lua_createtable(lua, 0, 2);
  lua_pushvalue(lua, 6);
  lua_setfield(lua, -2, "__index");
  lua_setmetatable(lua, -2);
  lua_settop(lua, 8);
  for (const char* name : {"math", "table", "string"}) {
    shield(lua);
    lua_setfield(lua, 5, name);
  }
  lua_createtable(lua, 0, 2);
  lua_pushvalue(lua, 5);
  lua_setfield(lua, -2, "__index");
  lua_pushboolean(lua, 0);
  lua_setfield(lua, -2, "__metatable");
  lua_rawsetp(lua, LUA_REGISTRYINDEX, &globals_key);
  // What was opened and not chosen is not kept within reach.
  lua_pushnil(lua);
  lua_setfield(lua, LUA_REGISTRYINDEX, LUA_LOADED_TABLE);
  return 0;
}

void push_globals(lua_State* lua) {
  lua_newtable(lua);
  lua_rawgetp(lua, LUA_REGISTRYINDEX, &globals_key);
  lua_setmetatable(lua, -2);
}

void push_point(lua_State* lua, double x, double y, double z) {
  lua_createtable(lua, 0, 3);
  lua_pushnumber(lua, x);
  lua_setfield(lua, -2, "x");
  lua_pushnumber(lua, y);
  lua_setfield(lua, -2, "y");
  lua_pushnumber(lua, z);
  lua_setfield(lua, -2, "z");
  lua_rawgetp(lua, LUA_REGISTRYINDEX, &point_key);
  lua_setmetatable(lua, -2);
}

void make_strict(lua_State* lua, Declared what) {
  lua_rawgetp(lua, LUA_REGISTRYINDEX, what == Declared::ends ? &ends_key : &parameters_key);
  lua_setmetatable(lua, -2);
}

}  // namespace bl::script
