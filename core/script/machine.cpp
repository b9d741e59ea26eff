// The sandbox: allocator, instruction hook, library and protected runs of one Lua machine.
#include "core/script/machine.h"

#include <locale.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>

#include <lua.hpp>

#include "core/base/stop_check.h"
#include "core/script/library.h"
#include "core/script/link_script.h"
#include "core/script/lua_mathematics.h"
#include "core/script/utf8.h"

namespace bl::script {

namespace {

constexpr int kHookStep = 1000;  // instructions between two looks at the budget
constexpr std::size_t kUnlimited = std::numeric_limits<std::size_t>::max();
// Garbage that waits until it is collected between two evaluations [byte].
constexpr std::size_t kGarbage = std::size_t{512} << 10;

// A place for a name in a table of Lua: value, key, and the next place with the same remainder [byte].
constexpr std::size_t kNameBytes = 24;

enum class Stop { none, instructions, memory, piece, text, wish };

// The order of texts, the decimal point and the letters of upper() are those of C, whatever the rest of the program has set.
class PlainLocale {
 public:
  PlainLocale() : earlier_(uselocale(plain())) {}
  ~PlainLocale() { uselocale(earlier_); }
  PlainLocale(const PlainLocale&) = delete;
  PlainLocale& operator=(const PlainLocale&) = delete;

 private:
  static locale_t plain() {
    static const locale_t kPlain = newlocale(LC_ALL_MASK, "C", locale_t{});
    return kPlain;
  }
  const locale_t earlier_;
};

// Where a text of the script may get a zero byte: such a byte itself, or \0, \x00 or \u{0} behind an odd number of backslashes.
// Comments and long texts are not told apart: what reads the source another way than Lua does could be deceived.
std::size_t zero_byte_in(std::string_view source) {
  std::size_t slashes = 0;
  for (std::size_t i = 0; i < source.size(); ++i) {
    if (source[i] == 0) return i;
    const std::string_view rest = source.substr(i);
    if (slashes % 2 == 1) {
      const std::size_t number = std::min<std::size_t>(3, std::min(rest.find_first_not_of("0123456789"), rest.size()));
      if (number > 0 && rest.substr(0, number).find_first_not_of('0') == std::string_view::npos) return i;
      if (rest.starts_with("x00")) return i;
      if (rest.starts_with("u{0")) {
        const std::size_t end = rest.find_first_not_of('0', 2);
        if (end != std::string_view::npos && rest[end] == '}') return i;
      }
    }
    slashes = source[i] == '\\' ? slashes + 1 : 0;
  }
  return std::string_view::npos;
}

}  // namespace

struct Machine::Box {
  lua_State* lua = nullptr;
  std::string file;
  std::size_t held = 0;           // now [byte]
  std::size_t base = 0;           // held after the last collection
  std::size_t left = kUnlimited;  // memory that may still be taken
  std::int64_t instructions = 0;  // that may still run
  std::int64_t price = 1;         // of an instruction; see watch_names
  bool is_limited = false;
  Stop stop = Stop::none;
  int blamed_line = 0;   // of errors that no code of the script is running at
  char place[128] = "";  // where the limit was met

  ~Box() {
    if (lua != nullptr) lua_close(lua);
  }
  void note(Stop why) {
    if (stop != Stop::none) return;
    stop = why;
    if (lua == nullptr) return;
    lua_Debug at;
    for (int level = 0; lua_getstack(lua, level, &at) != 0; ++level)
      if (lua_getinfo(lua, "Sl", &at) != 0 && at.source[0] == '@' && at.currentline > 0) {
        std::snprintf(place, sizeof place, "%s:%d: ", at.short_src, at.currentline);
        return;
      }
  }
  // After a refusal nothing more is given: else a script could live at the edge, with a collection for every allocation.
  bool may_take(std::size_t more, std::size_t whole, bool is_text) {
    if (!is_limited) return true;
    if (stop != Stop::none) return false;
    if (is_text && whole > ScriptLimits::kText) note(Stop::text);
    else if (whole > ScriptLimits::kPiece) note(Stop::piece);
    else if (more > left) note(Stop::memory);
    if (stop != Stop::none) return false;
    left -= more;
    return true;
  }
  static void* allocate(void* box, void* piece, std::size_t old_size, std::size_t new_size) {
    Box& self = *static_cast<Box*>(box);
    const bool is_text = piece == nullptr && old_size == LUA_TSTRING;  // for a new piece Lua tells its type instead
    if (piece == nullptr && old_size == 0) self.watch_names(new_size);
    if (piece == nullptr) old_size = 0;
    if (new_size == 0) {
      self.held -= old_size;
      std::free(piece);
      return nullptr;
    }
    if (new_size > old_size && !self.may_take(new_size - old_size, new_size, is_text)) return nullptr;
    void* moved = std::realloc(piece, new_size);
    if (moved != nullptr) self.held += new_size - old_size;
    return moved;
  }
  // The stack gets its size here: grown by and by, its last size, and so the depth at which a script is stopped, would follow
  // from the runs before. It doubles when it grows, which is beyond kPiece.
  void fix_stack() { lua_checkstack(lua, ScriptLimits::kStack); }
  // Numbers can be chosen such that all names of a table lie in one chain, which an instruction then walks from end to end. So
  // large tables of names make instructions dearer. Their pieces are powers of two of places; lists are moved when they grow.
  void watch_names(std::size_t size) {
    if (size % kNameBytes != 0) return;
    const std::size_t names = size / kNameBytes;
    if ((names & (names - 1)) == 0) price = std::max(price, static_cast<std::int64_t>(names / ScriptLimits::kNames));
  }
  void pay(lua_State* on, std::int64_t count) {
    instructions -= count * price;
    if (instructions > 0 && !is_stop_wished()) return;
    note(instructions > 0 ? Stop::wish : Stop::instructions);
    lua_pushliteral(on, "stopped");
    lua_error(on);
  }
  static Box& of(lua_State* lua) {
    void* box = nullptr;
    lua_getallocf(lua, &box);
    return *static_cast<Box*>(box);
  }
  static void count(lua_State* lua, lua_Debug*) { of(lua).pay(lua, kHookStep); }
  // Puts file and line before errors that were raised outside the script's own code (in the library).
  static int handle(lua_State* lua) {
    Box& self = of(lua);
    self.is_limited = false;
    const char* text = lua_type(lua, 1) == LUA_TSTRING ? lua_tostring(lua, 1) : "the script raised an error that is no text";
    const std::size_t length = self.file.size();
    if (std::strncmp(text, self.file.c_str(), length) == 0 && text[length] == ':') {
      lua_pushfstring(lua, "%s%s", text, instead_of(text));
      return 1;
    }
    lua_Debug at;
    for (int level = 0; lua_getstack(lua, level, &at) != 0; ++level)
      if (lua_getinfo(lua, "Sl", &at) != 0 && at.source[0] == '@' && at.currentline > 0) {
        lua_pushfstring(lua, "%s:%d: %s", at.short_src, at.currentline, without_place(text));
        return 1;
      }
    if (self.blamed_line > 0) lua_pushfstring(lua, "%s:%d: %s", self.file.c_str(), self.blamed_line, without_place(text));
    else lua_pushfstring(lua, "%s: %s", self.file.c_str(), without_place(text));
    return 1;
  }
  // What people look for first that scripts have not, and what is there instead.
  static const char* instead_of(const char* text) {
    static constexpr const char* kNotThere[][2] = {
        {"'print'", "; there is no `print`: error(text) shows a text in the problems list"},
        {"'pcall'", "; an error ends the evaluation and cannot be caught"},
        {"'xpcall'", "; an error ends the evaluation and cannot be caught"},
        {"'io'", "; scripts reach no files"},
        {"'os'", "; scripts reach no clock and no files"},
        {"'require'", "; a script stands alone: no other is reached"},
        {"'find'", "; patterns are left out: `sub`, `byte` and `len` are there"},
        {"'match'", "; patterns are left out: `sub`, `byte` and `len` are there"},
        {"'gmatch'", "; patterns are left out: `sub`, `byte` and `len` are there"},
        {"'gsub'", "; patterns are left out: `sub`, `byte` and `len` are there"},
        {"'rep'", "; texts are joined by .."},
    };
    if (std::strstr(text, "nil value (") == nullptr) return "";
    for (const auto& [name, hint] : kNotThere)
      if (std::strstr(text, name) != nullptr) return hint;
    return "";
  }
  // "[string...]:12: what" without the place in the library, which says nothing to people.
  static const char* without_place(const char* text) {
    if (std::strncmp(text, kLibraryName, std::strlen(kLibraryName)) != 0) return text;
    const char* end = std::strstr(text, ": ");
    return end != nullptr ? end + 2 : text;
  }
};

namespace {

struct Use {
  int (*use)(lua_State*, void*);
  void* context;
  bool lifts_limits;
  bool* is_limited;
};

// Place in Lua's registry, by address: the `evaluate` that can be called without running its text again.
char plain_key;

// Is the function on top such that nothing can last in it? It knows no variables of the text around it, only globals.
bool is_plain(lua_State* lua) {
  bool is = true;
  for (int i = 1; const char* name = lua_getupvalue(lua, -1, i); ++i) {
    lua_pop(lua, 1);
    is = is && i == 1 && std::strcmp(name, "_ENV") == 0;
  }
  return is;
}

// Runs the text at 1 with new globals, which go to 3, and leaves what it returned on top.
void run_anew(lua_State* lua) {
  push_globals(lua);
  lua_pushvalue(lua, 1);
  lua_pushvalue(lua, 3);
  lua_setupvalue(lua, -2, 1);
  lua_call(lua, 0, 1);
}

// Leaves `evaluate` on top. Where it is plain and the text has made no globals, it is kept and given new globals each time;
// else the whole text runs again, so that nothing is kept from run to run.
void push_evaluate(lua_State* lua) {
  if (lua_rawgetp(lua, LUA_REGISTRYINDEX, &plain_key) == LUA_TFUNCTION) {
    push_globals(lua);
    if (lua_setupvalue(lua, -2, 1) == nullptr) lua_pop(lua, 1);
    return;
  }
  lua_pop(lua, 1);
  run_anew(lua);
  if (!lua_istable(lua, -1)) luaL_error(lua, "the script must return a table");
  lua_getfield(lua, -1, "evaluate");
  if (!lua_isfunction(lua, -1)) luaL_error(lua, "`evaluate` must be a function");
  lua_pushnil(lua);
  if (lua_next(lua, 3) != 0) {
    lua_pop(lua, 2);
  } else if (is_plain(lua)) {
    lua_pushvalue(lua, -1);
    lua_rawsetp(lua, LUA_REGISTRYINDEX, &plain_key);
  }
}

// Stack: the compiled text at 1, Use at 2.
int run_text(lua_State* lua) {
  const Use& use = *static_cast<Use*>(lua_touserdata(lua, 2));
  if (use.lifts_limits) {
    run_anew(lua);
    *use.is_limited = false;
  } else {
    push_evaluate(lua);
  }
  return use.use(lua, use.context);
}

}  // namespace

void blame_line(lua_State* lua, int line) { Machine::Box::of(lua).blamed_line = line; }
void charge(lua_State* lua, std::int64_t instructions) {
  Machine::Box& self = Machine::Box::of(lua);
  if (self.is_limited) self.pay(lua, instructions);
}

Machine::Machine(std::unique_ptr<Box> box) : box_(std::move(box)) {}
Machine::~Machine() = default;
const std::string& Machine::file() const { return box_->file; }

Result<std::unique_ptr<Machine>> Machine::compile(const std::string& name, std::string_view text) {
  auto box = std::make_unique<Box>();
  box->file = name + ".lua";
  box->lua = lua_newstate(Box::allocate, box.get());
  if (box->lua == nullptr) return Error{ErrorCode::io, "", "no memory for a Lua machine"};
  std::unique_ptr<Machine> machine(new Machine(std::move(box)));
  Box& self = *machine->box_;
  // Some editors put a byte order mark before everything; Lua would take it for a name.
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  if (text.size() > ScriptLimits::kSource)
    return Error{ErrorCode::out_of_range, "",
                 self.file + ": the script is longer than " + std::to_string(ScriptLimits::kSource >> 10) + " KiB"};
  if (const std::size_t zero = zero_byte_in(text); zero != std::string_view::npos)
    return Error{ErrorCode::parse, "",
                 self.file + ":" + std::to_string(1 + std::count(text.begin(), text.begin() + static_cast<long>(zero), '\n')) +
                     ": a text of a script cannot hold a zero byte; write no `\\0`"};
  if (const std::size_t taken = text.find(kPowerName); taken != std::string_view::npos)
    return Error{ErrorCode::parse, "",
                 self.file + ":" + std::to_string(1 + std::count(text.begin(), text.begin() + static_cast<long>(taken), '\n')) +
                     ": the name `" + std::string(kPowerName) + "` is taken by the library; take another"};
  const PlainLocale locale;
  lua_gc(self.lua, LUA_GCSTOP);
  lua_pushcfunction(self.lua, open_library);
  if (const int status = lua_pcall(self.lua, 0, 0, 0); status != LUA_OK) return machine->failure(status);
  self.is_limited = true;
  self.left = ScriptLimits::kMemory;
  // "t": text only; a precompiled chunk can break the machine.
  const std::string own = with_own_power(text);
  const int status = luaL_loadbufferx(self.lua, own.data(), own.size(), ("@" + self.file).c_str(), "t");
  self.is_limited = false;
  if (status != LUA_OK) {
    Error error = machine->failure(status);
    error.code = ErrorCode::parse;
    if (!error.message.starts_with(self.file)) error.message = self.file + ": " + error.message;
    return error;
  }
  self.base = self.held;
  return machine;
}

Error Machine::failure(int status) {
  Box& self = *box_;
  self.is_limited = false;
  const std::string place = self.place[0] != 0 ? self.place : self.file + ": ";
  switch (self.stop) {
    case Stop::instructions:
      return {ErrorCode::cancelled, "",
              place + "stopped after " + std::to_string(ScriptLimits::kInstructions) + " instructions in one evaluation, or " +
                  std::to_string(ScriptLimits::kInstructionsPerTick) +
                  " of one link in one tick; look for a loop that does not end, or read the end `whole`" +
                  (self.price > 1 ? " (a table has more than " + std::to_string(ScriptLimits::kNames) +
                                        " names, which makes each instruction count for " + std::to_string(self.price) + ")"
                                  : "")};
    case Stop::memory:
      return {ErrorCode::cancelled, "",
              place + "stopped when it had taken " + std::to_string(ScriptLimits::kMemory >> 20) +
                  " MiB of memory in one evaluation, or " + std::to_string(ScriptLimits::kMemoryPerTick >> 20) +
                  " MiB for one link in one tick"};
    case Stop::piece:
      return {ErrorCode::cancelled, "",
              place + "stopped when a table or the depth of its calls grew beyond " + std::to_string(ScriptLimits::kPiece >> 10) +
                  " KiB"};
    case Stop::text:
      return {ErrorCode::cancelled, "",
              place + "stopped when a text grew beyond " + std::to_string(ScriptLimits::kText >> 10) + " KiB"};
    case Stop::wish: return {ErrorCode::cancelled, "", place + "stopped, because the work was"};
    case Stop::none: break;
  }
  const char* text = lua_type(self.lua, -1) == LUA_TSTRING ? lua_tostring(self.lua, -1) : nullptr;
  const ErrorCode code = status == LUA_ERRMEM ? ErrorCode::cancelled : ErrorCode::conflict;
  return {code, "", text != nullptr ? shown_as_utf8(text) : self.file + ": the script failed without a text"};
}

// Stack: the compiled text at 1; the handler of errors goes to 2.
int Machine::call(int (*use)(lua_State*, void*), void* context, bool lifts_limits) {
  const PlainLocale locale;
  Box& self = *box_;
  self.price = 1;
  self.fix_stack();
  Use what{use, context, lifts_limits, &self.is_limited};
  lua_sethook(self.lua, Box::count, LUA_MASKCOUNT, kHookStep);
  lua_pushcfunction(self.lua, Box::handle);
  lua_pushcfunction(self.lua, run_text);
  lua_pushvalue(self.lua, 1);
  lua_pushlightuserdata(self.lua, &what);
  self.blamed_line = 0;
  self.is_limited = true;
  const int status = lua_pcall(self.lua, 2, 0, 2);
  self.is_limited = false;
  lua_sethook(self.lua, nullptr, 0, 0);
  return status;
}

Result<void> Machine::run(int (*use)(lua_State*, void*), void* context, ScriptBudget& budget) {
  Box& self = *box_;
  if (budget.instructions <= 0) {  // short runs never come to the hook
    self.stop = Stop::instructions;
    return failure(LUA_ERRRUN);
  }
  const std::int64_t instructions = std::min(budget.instructions, ScriptLimits::kInstructions);
  const std::size_t memory = std::min(budget.memory, ScriptLimits::kMemory);
  self.instructions = instructions;
  self.left = memory;
  const int status = call(use, context, false);
  // The hook looks in steps; a run that ends before the first one counts for a little all the same.
  budget.instructions -= std::min(budget.instructions, instructions - self.instructions + kHookStep / 20);
  budget.memory -= std::min(budget.memory, memory - self.left);
  if (status != LUA_OK) return failure(status);
  lua_settop(self.lua, 1);
  if (self.held > self.base + kGarbage) {
    lua_gc(self.lua, LUA_GCCOLLECT);
    self.base = self.held;
  }
  return {};
}

Result<void> Machine::look(int (*use)(lua_State*, void*), void* context) {
  Box& self = *box_;
  self.instructions = ScriptLimits::kInstructions;
  self.left = ScriptLimits::kMemory;
  if (const int status = call(use, context, true); status != LUA_OK) return failure(status);
  lua_settop(self.lua, 1);
  return {};
}

}  // namespace bl::script
