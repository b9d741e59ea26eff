// One sandboxed Lua machine that holds one script: counted instructions and memory, errors with file and line.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "core/base/result.h"

struct lua_State;

namespace bl::script {

/// What is left of what a link may use in one tick.
struct ScriptBudget {
  std::int64_t instructions = 0;
  std::size_t memory = 0;
};

class Machine {
 public:
  friend void blame_line(lua_State* lua, int line);
  friend void charge(lua_State* lua, std::int64_t instructions);

  /// Compiles the text; nothing of it has run yet.
  static Result<std::unique_ptr<Machine>> compile(const std::string& name, std::string_view text);
  ~Machine();
  Machine(const Machine&) = delete;
  Machine& operator=(const Machine&) = delete;

  /// Leaves the script's `evaluate` on the stack, with globals of its own and as if the text had just run for the first time, and
  /// calls `use` with `context`.
  /// Everything runs under the limits of one evaluation and of `budget`, which is lowered by what was used. `use` may raise
  /// Lua errors, and so must hold nothing that has a destructor. After an error the machine must not be used again.
  Result<void> run(int (*use)(lua_State*, void*), void* context, ScriptBudget& budget);
  /// Runs the whole text and leaves what it returned on the stack; in `use` there are no limits.
  Result<void> look(int (*use)(lua_State*, void*), void* context);

  /// "name.lua"
  const std::string& file() const;

 private:
  struct Box;
  explicit Machine(std::unique_ptr<Box> box);
  int call(int (*use)(lua_State*, void*), void* context, bool lifts_limits);
  Error failure(int status);
  std::unique_ptr<Box> box_;
};

/// For a `use`: errors that it raises from now on are said to be at this line of the script.
void blame_line(lua_State* lua, int line);

/// For C functions that scripts can call: their work counts as so many instructions.
void charge(lua_State* lua, std::int64_t instructions);

}  // namespace bl::script
