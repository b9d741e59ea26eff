// Mathematics of scripts: Lua's functions, and its `^`, by those of core/base/mathematics.h, whose bits no processor changes.
#pragma once

#include <string>
#include <string_view>

struct lua_State;

namespace bl::script {

/// A global that the text read by Lua holds beside each `^`; scripts may not use the name.
inline constexpr std::string_view kPowerName = "power__of__numbers";

/// The text with each `a ^ b` as `a ^power__of__numbers^ b`, in the same lines. Lua hands `^` of two numbers straight to the C
/// library, constants already while it reads; with an object between them both halves are calls of ours. `^` binds to the right
/// and takes what stands beside it, so that the tokens alone decide, and no expression has to be understood.
std::string with_own_power(std::string_view source);

/// Replaces the functions of Lua's mathematics in the table at `math`, and puts the object beside `^` into that at `globals`.
void put_mathematics(lua_State* lua, int math, int globals);

}  // namespace bl::script
