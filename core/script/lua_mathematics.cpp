// Functions of mathematics for Lua, and the reader of its texts and comments that finds `^` outside of them.
#include "core/script/lua_mathematics.h"

#include <algorithm>

#include <lua.hpp>

#include "core/base/mathematics.h"

namespace bl::script {

namespace {

template <double (*function)(double)>
int function_of_one(lua_State* lua) {
  lua_pushnumber(lua, function(luaL_checknumber(lua, 1)));
  return 1;
}

int arc_tangent_of(lua_State* lua) {
  lua_pushnumber(lua, mathematics::arc_tangent(luaL_checknumber(lua, 1), luaL_optnumber(lua, 2, 1)));
  return 1;
}

// As Lua does it: of base 2 and 10 by functions of their own, of others by a quotient.
int logarithm_of(lua_State* lua) {
  const double x = luaL_checknumber(lua, 1);
  const double base = lua_isnoneornil(lua, 2) ? 0 : luaL_checknumber(lua, 2);
  lua_pushnumber(lua, lua_isnoneornil(lua, 2) ? mathematics::logarithm(x)
                      : base == 2             ? mathematics::logarithm_of_two(x)
                      : base == 10            ? mathematics::logarithm_of_ten(x)
                                              : mathematics::logarithm(x) / mathematics::logarithm(base));
  return 1;
}

double side_of_power(lua_State* lua, int place) {
  const int type = lua_type(lua, place);
  if (type != LUA_TNUMBER)
    luaL_error(lua, "`^` needs numbers on both sides; one is %s%s", type == LUA_TNIL ? "nil, a name that holds nothing" : "a ",
               type == LUA_TNIL ? "" : lua_typename(lua, type));
  return lua_tonumber(lua, place);
}

// `a ^ object ^ b` is first `object ^ b`, which keeps b in the object and gives the object, then `a ^ object`. Nothing runs
// between the two, because a is known by then; so one object is enough, and takes no memory.
int half_of_power(lua_State* lua) {
  if (auto* exponent = static_cast<double*>(lua_touserdata(lua, 1)); exponent != nullptr) {
    *exponent = side_of_power(lua, 2);
    lua_settop(lua, 1);
    return 1;
  }
  const auto* exponent = static_cast<const double*>(lua_touserdata(lua, 2));
  lua_pushnumber(lua, mathematics::power(side_of_power(lua, 1), *exponent));
  return 1;
}

// The end of a long text or comment that begins at `at` with [[ or [==[; `at` where none does.
std::size_t end_of_long_piece(std::string_view source, std::size_t at) {
  if (at >= source.size() || source[at] != '[') return at;
  const std::size_t second = std::min(source.find_first_not_of('=', at + 1), source.size());
  if (second == source.size() || source[second] != '[') return at;
  const std::string closing = "]" + std::string(second - at - 1, '=') + "]";
  const std::size_t found = source.find(closing, second + 1);
  return found == std::string_view::npos ? source.size() : found + closing.size();
}

// The end of a text in quotes. A backslash takes the next character along, and `\z` all white space that follows.
std::size_t end_of_quoted_piece(std::string_view source, std::size_t at) {
  const char quote = source[at];
  for (++at; at < source.size() && source[at] != quote; ++at) {
    if (source[at] == '\n' || source[at] == '\r') return at;  // Lua will refuse it
    if (source[at] != '\\' || at + 1 == source.size()) continue;
    ++at;
    if (source[at] == 'z') at = std::min(source.find_first_not_of(" \t\n\v\f\r", at + 1), source.size()) - 1;
    else if (const std::string_view pair = source.substr(at, 2); pair == "\r\n" || pair == "\n\r") ++at;
  }
  return std::min(at + 1, source.size());
}

}  // namespace

std::string with_own_power(std::string_view source) {
  std::string text;
  text.reserve(source.size() + 256);
  for (std::size_t at = 0; at < source.size();) {
    std::size_t end = at + 1;
    const bool is_comment = source.substr(at, 2) == "--";
    if (const std::size_t begin = is_comment ? at + 2 : at; end_of_long_piece(source, begin) != begin) {
      end = end_of_long_piece(source, begin);
    } else if (is_comment) {
      end = std::min(source.find_first_of("\r\n", at), source.size());
    } else if (source[at] == '"' || source[at] == '\'') {
      end = end_of_quoted_piece(source, at);
    }
    text.append(source, at, end - at);
    if (end == at + 1 && source[at] == '^') text.append(kPowerName).append("^");
    at = end;
  }
  return text;
}

void put_mathematics(lua_State* lua, int math, int globals) {
  const luaL_Reg functions[] = {{"sin", function_of_one<mathematics::sine>},
                                {"cos", function_of_one<mathematics::cosine>},
                                {"tan", function_of_one<mathematics::tangent>},
                                {"asin", function_of_one<mathematics::arc_sine>},
                                {"acos", function_of_one<mathematics::arc_cosine>},
                                {"exp", function_of_one<mathematics::exponential>},
                                {"atan", arc_tangent_of},
                                {"log", logarithm_of},
                                {nullptr, nullptr}};
  lua_pushvalue(lua, math);
  luaL_setfuncs(lua, functions, 0);
  lua_pop(lua, 1);
  lua_newuserdatauv(lua, sizeof(double), 0);
  lua_createtable(lua, 0, 2);
  lua_pushcfunction(lua, half_of_power);
  lua_setfield(lua, -2, "__pow");
  lua_pushboolean(lua, 0);
  lua_setfield(lua, -2, "__metatable");
  lua_setmetatable(lua, -2);
  lua_setfield(lua, globals, std::string(kPowerName).c_str());
}

}  // namespace bl::script
