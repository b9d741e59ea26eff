// Makes a script's declaration a link kind, and its evaluate the kind's: machines are lent to whoever evaluates.
#include "core/script/link_script.h"

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include <lua.hpp>

#include "core/script/declaration.h"
#include "core/script/library.h"
#include "core/script/lua_values.h"
#include "core/script/machine.h"
#include "core/script/utf8.h"

namespace bl::script {

namespace {

// One script, and the machines that have compiled it. A machine keeps nothing from one evaluation to the next, so that it does
// not matter which one somebody gets.
struct Script {
  std::string name, text;
  std::vector<std::string> parameters, reads, proposes;
  std::vector<bool> read_whole, write_whole;
  std::vector<ValueKind> write_kinds;
  std::mutex mutex;
  std::vector<std::unique_ptr<Machine>> idle;

  Result<std::unique_ptr<Machine>> acquire_machine() {
    {
      const std::lock_guard lock(mutex);
      if (!idle.empty()) {
        auto machine = std::move(idle.back());
        idle.pop_back();
        return machine;
      }
    }
    return Machine::compile(name, text);
  }
  void take_back(std::unique_ptr<Machine> machine) {
    const std::lock_guard lock(mutex);
    idle.push_back(std::move(machine));
  }
};

// What all evaluations of one link in one tick share: the machine, and what they may still use.
struct TickRun {
  std::shared_ptr<Script> script;
  std::unique_ptr<Machine> machine;
  ScriptBudget budget{ScriptLimits::kInstructionsPerTick, ScriptLimits::kMemoryPerTick};

  ~TickRun() {
    if (machine) script->take_back(std::move(machine));
  }
};

struct Call {
  const Script& script;
  const std::vector<Value>& parameters;
  const LinkReads& reads;
  LinkWrites& writes;
  std::int64_t tick;
};

void push_parameters(lua_State* lua, const Call& call) {
  lua_createtable(lua, 0, static_cast<int>(call.parameters.size()));
  for (std::size_t p = 0; p < call.parameters.size(); ++p) {
    push_value(lua, call.parameters[p]);
    lua_setfield(lua, -2, call.script.parameters[p].c_str());
  }
  make_strict(lua, Declared::parameters);
}

void push_ends(lua_State* lua, const Call& call) {
  lua_createtable(lua, 0, static_cast<int>(call.reads.values.size()));
  for (std::size_t r = 0; r < call.reads.values.size(); ++r) {
    const auto& values = call.reads.values[r];
    if (call.script.read_whole[r]) {
      lua_createtable(lua, list_places(values.size()), 0);
      for (std::size_t i = 0; i < values.size(); ++i) {
        push_value(lua, *values[i]);
        lua_rawseti(lua, -2, static_cast<lua_Integer>(i + 1));
      }
    } else {
      push_value(lua, *values.front());
    }
    lua_setfield(lua, -2, call.script.reads[r].c_str());
  }
  make_strict(lua, Declared::ends);
}

// Every field of the answer has to be a declared one; nothing that a script says is passed over.
void check_answer(lua_State* lua, const Call& call) {
  lua_pushnil(lua);
  while (lua_next(lua, -2) != 0) {
    lua_pop(lua, 1);
    bool is_known = false;
    if (lua_type(lua, -1) == LUA_TSTRING)
      for (const std::string& name : call.script.proposes)
        is_known = is_known || name == std::string_view(lua_tostring(lua, -1), lua_rawlen(lua, -1));
    if (is_known) continue;
    if (lua_type(lua, -1) == LUA_TSTRING)
      luaL_error(lua, "evaluate answers `%s`, which `proposes` does not declare", lua_tostring(lua, -1));
    luaL_error(lua, "evaluate answers a value without a name; write return {name = value}");
  }
}

// Whatever is in a list for a whole end has to be of a node.
void check_list(lua_State* lua, const char* name, ValueKind kind, std::size_t count) {
  lua_pushnil(lua);
  while (lua_next(lua, -2) != 0) {
    lua_pop(lua, 1);
    if (lua_isinteger(lua, -1) != 0) {
      const lua_Integer at = lua_tointeger(lua, -1);
      if (at < 1 || at > static_cast<lua_Integer>(count))
        luaL_error(lua, "`%s` answers a value for node %d of an end of %d nodes", name, static_cast<int>(at),
                   static_cast<int>(count));
      continue;
    }
    if (kind == ValueKind::point) luaL_error(lua, "`%s` needs a list of points, one for each node, not a point", name);
    luaL_error(lua, "`%s` needs a list with a value for each node; it has an entry with a name", name);
  }
}

void take_answer(lua_State* lua, const Call& call, std::size_t w) {
  const char* name = call.script.proposes[w].c_str();
  auto& values = call.writes.values[w];
  lua_getfield(lua, -1, name);
  if (!call.script.write_whole[w]) {
    values.front() = proposal_at(lua, -1, call.script.write_kinds[w], name);
  } else if (lua_istable(lua, -1)) {
    const std::size_t count = values.size();
    if (lua_rawlen(lua, -1) > count)
      luaL_error(lua, "`%s` answers %d values for an end of %d nodes", name, static_cast<int>(lua_rawlen(lua, -1)),
                 static_cast<int>(count));
    check_list(lua, name, call.script.write_kinds[w], count);
    for (std::size_t i = 0; i < count; ++i) {
      lua_rawgeti(lua, -1, static_cast<lua_Integer>(i + 1));
      values[i] = proposal_at(lua, -1, call.script.write_kinds[w], name);
      lua_pop(lua, 1);
    }
  } else if (!lua_isnil(lua, -1)) {
    luaL_error(lua, "`%s` belongs to a whole end: answer a list with a value for each node", name);
  }
  lua_pop(lua, 1);
}

// The function is on top. Raises Lua errors: nothing here has a destructor.
int evaluate_in_lua(lua_State* lua, void* context) {
  const Call& call = *static_cast<Call*>(context);
  luaL_checkstack(lua, 16, nullptr);
  lua_pushvalue(lua, -1);
  lua_Debug function;
  lua_getinfo(lua, ">S", &function);
  blame_line(lua, function.linedefined);  // what is wrong with the answer is said of the line where evaluate begins
  push_parameters(lua, call);
  push_ends(lua, call);
  lua_createtable(lua, 0, 1);
  lua_pushinteger(lua, call.tick);
  lua_setfield(lua, -2, "index");
  lua_call(lua, 3, 1);
  if (!lua_istable(lua, -1))
    return luaL_error(lua, "evaluate must return a table of proposals, not a %s; {} proposes nothing", luaL_typename(lua, -1));
  check_answer(lua, call);
  for (std::size_t w = 0; w < call.writes.values.size(); ++w) take_answer(lua, call, w);
  return 0;
}

Result<void> evaluate(const std::shared_ptr<Script>& script, const void* parameters, const LinkReads& reads, LinkWrites& writes,
                      const Tick& tick) {
  TickRun alone;
  TickRun& run = tick.memo != nullptr ? tick.memo->of<TickRun>() : alone;
  run.script = script;
  if (!run.machine) {
    auto machine = script->acquire_machine();
    if (!machine) return machine.error();
    run.machine = std::move(*machine);
  }
  Call call{*script, *static_cast<const std::vector<Value>*>(parameters), reads, writes, tick.index};
  if (auto done = run.machine->run(evaluate_in_lua, &call, run.budget); !done) {
    run.machine.reset();  // what an error left behind in it must not reach the next evaluation
    return done;
  }
  return {};
}

struct Look {
  const std::string& file;
  std::string_view text;
  const Registry& types;
  Result<ScriptDeclaration> result;
};

int look_at_declaration(lua_State* lua, void* context) {
  Look& look = *static_cast<Look*>(context);
  look.result = read_declaration(lua, look.file, look.text, look.types);
  return 0;
}

}  // namespace

Result<LinkDefinition> read_link_script(const std::string& name, std::string_view text, const Registry& types) {
  if (!is_utf8(text)) return Error{ErrorCode::parse, "", name + ".lua: the script is no UTF-8 text"};
  auto machine = Machine::compile(name, text);
  if (!machine) return machine.error();
  Look look{(*machine)->file(), text, types, Error{}};
  if (auto done = (*machine)->look(look_at_declaration, &look); !done) return done.error();
  if (!look.result) return look.result.error();
  auto script = std::make_shared<Script>();
  script->name = name;
  script->text = text;
  script->reads = std::move(look.result->reads);
  script->proposes = std::move(look.result->proposes);
  LinkDefinition link = std::move(look.result->link);
  for (const PortDefinition& port : link.ports) script->parameters.push_back(port.id);
  for (const LinkRead& read : link.reads) script->read_whole.push_back(read.is_whole);
  for (const LinkWrite& write : link.proposes) {
    script->write_whole.push_back(write.is_whole);
    script->write_kinds.push_back(write.kind);
  }
  script->take_back(std::move(*machine));
  link.has_common_budget = true;
  link.instantiate = [](std::span<const Value> values) -> std::shared_ptr<const void> {
    return std::make_shared<const std::vector<Value>>(values.begin(), values.end());
  };
  link.evaluate = [script](const void* parameters, const LinkReads& reads, LinkWrites& writes, const Tick& tick) {
    return evaluate(script, parameters, reads, writes, tick);
  };
  return link;
}

}  // namespace bl::script
