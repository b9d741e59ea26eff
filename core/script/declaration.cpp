// Fields of the declaration one by one; whatever is unknown, missing or of the wrong kind is refused with its line.
#include "core/script/declaration.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <lua.hpp>

#include "core/base/text.h"
#include "core/define/codec.h"
#include "core/script/lua_values.h"
#include "core/script/text_lines.h"
#include "core/script/utf8.h"

namespace bl::script {

namespace {

// The first error wins; everything after it is read for nothing.
class Declaration {
 public:
  Declaration(lua_State* lua, const std::string& file, std::string_view text, const Registry& types)
      : lua_(lua), file_(file), lines_(text), types_(types) {}

  Result<ScriptDeclaration> run() {
    if (!lua_istable(lua_, -1))
      fail("", "the script must return a table: return {id = ..., evaluate = function(params, ends, tick) ... end}");
    else read();
    if (error_) return *error_;
    return ScriptDeclaration{std::move(link_), std::move(reads_), std::move(proposes_)};
  }

 private:
  // `token` is the word that the message is about; its line within the part that is read is named, or that of the part.
  void fail(std::string_view token, std::string message, ErrorCode code = ErrorCode::parse) {
    if (error_) return;
    error_ = Error{code, "", file_ + ":" + std::to_string(lines_.line_of(part_, token)) + ": " + message};
  }

  // --- Tables. The table that is read stands on top of the stack.
  std::vector<std::string> keys(const std::string& where) {
    std::vector<std::string> found;
    lua_pushnil(lua_);
    while (lua_next(lua_, -2) != 0) {
      lua_pop(lua_, 1);
      if (lua_type(lua_, -1) == LUA_TSTRING) found.emplace_back(lua_tostring(lua_, -1));
      else fail(where, "`" + where + "` has an entry without a name; write {name = {...}, ...}");
    }
    std::sort(found.begin(), found.end());  // Lua's own order differs from run to run
    return found;
  }
  void check_keys(const std::string& where, const std::vector<std::string>& known) {
    const bool is_phrase = where.find(' ') != std::string::npos;
    for (const std::string& key : keys(where)) {
      if (std::find(known.begin(), known.end(), key) != known.end()) continue;
      const bool is_end = key == "end" && std::find(known.begin(), known.end(), "at") != known.end();
      fail(key,
           (is_phrase ? where : "`" + where + "`") + " knows no `" + key + "`" +
               (is_end ? "; the field is called `at`, because `end` is a word of Lua's own" : did_you_mean(key, known)),
           ErrorCode::unknown_field);
    }
  }
  std::optional<std::string> text(const std::string& where, const char* key, bool is_required = false) {
    lua_getfield(lua_, -1, key);
    std::optional<std::string> found;
    if (lua_type(lua_, -1) == LUA_TSTRING) found = lua_tostring(lua_, -1);
    else if (!lua_isnil(lua_, -1)) fail(key, "`" + std::string(key) + "` of " + where + " must be a text", ErrorCode::wrong_kind);
    else if (is_required) fail(where, "`" + std::string(key) + "` of " + where + " is missing", ErrorCode::missing);
    lua_pop(lua_, 1);
    if (found && !is_utf8(*found)) fail(key, "`" + std::string(key) + "` of " + where + " is no UTF-8 text");
    return found;
  }
  std::optional<double> number(const std::string& where, const char* key) {
    lua_getfield(lua_, -1, key);
    std::optional<double> found;
    if (lua_type(lua_, -1) == LUA_TNUMBER) found = lua_tonumber(lua_, -1);
    else if (!lua_isnil(lua_, -1))
      fail(key, "`" + std::string(key) + "` of " + where + " must be a number", ErrorCode::wrong_kind);
    if (found && !std::isfinite(*found))
      fail(key, "`" + std::string(key) + "` of " + where + " must be finite", ErrorCode::not_finite);
    lua_pop(lua_, 1);
    return found;
  }
  bool flag(const std::string& where, const char* key) {
    lua_getfield(lua_, -1, key);
    if (!lua_isnil(lua_, -1) && !lua_isboolean(lua_, -1))
      fail(key, "`" + std::string(key) + "` of " + where + " must be true or false", ErrorCode::wrong_kind);
    const bool is_on = lua_toboolean(lua_, -1) != 0;
    lua_pop(lua_, 1);
    return is_on;
  }
  std::optional<Unit> unit(const std::string& where) {
    const auto symbol = text(where, "unit");
    if (!symbol) return std::nullopt;
    const UnitInfo* row = find_unit(*symbol);
    if (row != nullptr && row->scale == 1) return row->unit;
    std::vector<std::string> symbols;
    std::string list;
    for (const UnitInfo& known : unit_table())
      if (known.scale == 1 && !known.symbol.empty()) symbols.emplace_back(known.symbol), list += " " + symbols.back();
    fail(*symbol,
         row != nullptr ? "values come in `" + std::string(info(row->unit).symbol) + "`, not in `" + *symbol + "`"
                        : "unknown unit `" + *symbol + "`; known are" + list,
         ErrorCode::wrong_unit);
    return std::nullopt;
  }

  // --- The parts.
  void read() {
    check_keys("the script", {"id", "label", "doc", "params", "reads", "proposes", "evaluate"});
    link_.id = text("the script", "id", true).value_or("");
    link_.label = text("the script", "label").value_or(link_.id);
    link_.doc = text("the script", "doc", true).value_or("");
    if (!error_ && !is_identifier(link_.id)) fail("id", "`" + link_.id + "` is no id: use a-z 0-9 _");
    if (const LinkDefinition* taken = types_.link(link_.id); taken != nullptr && !error_)
      fail("id", "there is a link kind `" + taken->id + "` already; choose another id", ErrorCode::duplicate);
    for_list("params", [this](const std::string& where) { param(where); });
    for_names("reads", [this](const std::string& name) { read_of(name); });
    for_names("proposes", [this](const std::string& name) { proposal_of(name); });
    if (link_.proposes.empty()) fail("proposes", "`proposes` is missing: a link changes something", ErrorCode::missing);
    lua_getfield(lua_, -1, "evaluate");
    if (lua_isfunction(lua_, -1)) {
      // Whoever takes the tick may propose something else in the next one.
      lua_Debug function;
      lua_pushvalue(lua_, -1);
      lua_getinfo(lua_, ">u", &function);
      link_.reads_time = function.nparams > 2 || function.isvararg != 0;
    } else {
      fail("evaluate", "`evaluate` must be a function(params, ends, tick)", ErrorCode::missing);
    }
    lua_pop(lua_, 1);
  }

  template <class Read>
  void for_list(const char* key, Read read_one) {
    lua_getfield(lua_, -1, key);
    part_.emplace_back(key);
    if (lua_istable(lua_, -1)) {
      const auto count = static_cast<lua_Integer>(lua_rawlen(lua_, -1));
      lua_pushnil(lua_);
      while (lua_next(lua_, -2) != 0) {
        lua_pop(lua_, 1);
        if (lua_isinteger(lua_, -1) == 0) fail(key, "`" + std::string(key) + "` is a list: {{id = ...}, {id = ...}}");
      }
      for (lua_Integer i = 1; i <= count; ++i) {
        lua_rawgeti(lua_, -1, i);
        part_.push_back("#" + std::to_string(i));
        if (lua_istable(lua_, -1)) read_one(std::string(key) + " " + std::to_string(i));
        else fail(key, "`" + std::string(key) + "` is a list of tables: {{id = ...}, {id = ...}}", ErrorCode::wrong_kind);
        part_.pop_back();
        lua_pop(lua_, 1);
      }
    } else if (!lua_isnil(lua_, -1)) {
      fail(key, "`" + std::string(key) + "` must be a list", ErrorCode::wrong_kind);
    }
    part_.pop_back();
    lua_pop(lua_, 1);
  }
  template <class Read>
  void for_names(const char* key, Read read_one) {
    lua_getfield(lua_, -1, key);
    part_.emplace_back(key);
    if (lua_istable(lua_, -1)) {
      for (const std::string& name : keys(key)) {
        lua_getfield(lua_, -1, name.c_str());
        part_.push_back(name);
        if (lua_istable(lua_, -1)) read_one(name);
        else
          fail(name, "`" + name + "` must be a table such as {at = \"from\", port = \"smart_volume.volume\", unit = \"m3\"}",
               ErrorCode::wrong_kind);
        part_.pop_back();
        lua_pop(lua_, 1);
      }
    } else if (!lua_isnil(lua_, -1)) {
      fail(key, "`" + std::string(key) + "` must be a table {name = {...}, ...}", ErrorCode::wrong_kind);
    }
    part_.pop_back();
    lua_pop(lua_, 1);
  }

  void param(const std::string& place) {
    PortDefinition port;
    port.id = text(place, "id", true).value_or("");
    const std::string where = port.id.empty() ? place : port.id;
    check_keys(where, {"id", "default", "kind", "unit", "min", "max", "soft_min", "soft_max", "doc", "choices"});
    if (!port.id.empty() && !is_identifier(port.id)) fail(port.id, "`" + port.id + "` is no id: use a-z 0-9 _");
    if (link_.find_port(port.id) != nullptr) fail(port.id, "there are two parameters `" + port.id + "`", ErrorCode::duplicate);
    port.doc = text(where, "doc", true).value_or("");
    port.unit = unit(where).value_or(Unit::none);
    if (const auto low = number(where, "min")) port.hard_minimum = *low;
    if (const auto high = number(where, "max")) port.hard_maximum = *high;
    port.soft_minimum = number(where, "soft_min");
    port.soft_maximum = number(where, "soft_max");
    choices(port, where);
    default_value(port, where);
    if (!error_)
      if (auto fits = check_value(port, port.default_value, ""); !fits)
        fail(where, "the default of `" + where + "`: " + fits.error().message, fits.error().code);
    const std::size_t index = link_.ports.size();
    port.get = [index](const void* values) { return (*static_cast<const std::vector<Value>*>(values))[index]; };
    port.set = [index](void* values, const Value& value) { (*static_cast<std::vector<Value>*>(values))[index] = value; };
    link_.ports.push_back(std::move(port));
  }

  void choices(PortDefinition& port, const std::string& where) {
    for_list("choices", [&](const std::string& place) {
      port.choices.push_back({text(place, "id", true).value_or(""), text(place, "doc", true).value_or("")});
    });
    if (!port.choices.empty()) port.kind = ValueKind::choice;
    if (const auto kind = text(where, "kind")) {
      if (*kind == "integer") port.kind = ValueKind::integer;
      else if (*kind == "port") port.kind = ValueKind::port;
      else fail(where, "`kind` of `" + where + "` is \"integer\" or \"port\"; others follow from the default");
    }
  }

  void default_value(PortDefinition& port, const std::string& where) {
    lua_getfield(lua_, -1, "default");
    const int type = lua_type(lua_, -1);
    const bool is_text_kind = port.kind == ValueKind::choice || port.kind == ValueKind::port;
    if (is_text_kind && type == LUA_TSTRING) port.default_value = std::string(lua_tostring(lua_, -1));
    else if (port.kind == ValueKind::port && type == LUA_TNIL) port.default_value = std::string();
    else if (port.kind == ValueKind::integer && lua_isinteger(lua_, -1) != 0)
      port.default_value = static_cast<std::int64_t>(lua_tointeger(lua_, -1));
    else if (port.kind == ValueKind::number && type == LUA_TNUMBER) port.default_value = lua_tonumber(lua_, -1);
    else if (port.kind == ValueKind::number && type == LUA_TBOOLEAN) {
      port.kind = ValueKind::boolean;
      port.default_value = lua_toboolean(lua_, -1) != 0;
    } else if (port.kind == ValueKind::number && type == LUA_TSTRING) {
      port.kind = ValueKind::text;
      port.default_value = std::string(lua_tostring(lua_, -1));
    } else if (port.kind == ValueKind::number && type == LUA_TTABLE) {
      Vector3 point;
      for (const auto& [axis, target] : {std::pair{"x", &point.x}, {"y", &point.y}, {"z", &point.z}})
        *target = number(where, axis).value_or(0);
      port.kind = ValueKind::point;
      port.default_value = point;
    } else {
      fail(where, "`" + where + "` needs a default of its kind", ErrorCode::missing);
    }
    lua_pop(lua_, 1);
  }

  // What reads and proposals have alike.
  End path_of(const std::string& name, PortPath& path, ValueKind& kind, std::optional<Unit>& expected, bool& is_whole) {
    check_keys(name, {"at", "port", "chosen_by", "kind", "unit", "whole"});
    const auto at = text(name, "at", true).value_or("");
    if (!error_ && at != "from" && at != "to") fail(name, "`at` of `" + name + "` is \"from\" or \"to\"");
    expected = unit(name);
    is_whole = flag(name, "whole");
    const auto port = text(name, "port"), chosen = text(name, "chosen_by"), wanted = text(name, "kind");
    if (port.has_value() == chosen.has_value())
      fail(name, "`" + name + "` needs a `port`, or `chosen_by` with the parameter that names it", ErrorCode::missing);
    else if (chosen) chosen_path(name, *chosen, wanted, path, kind);
    else declared_path(*port, path, kind, expected);
    if (!error_ && !is_readable(kind))
      fail(name, "`" + name + "`: scripts cannot read " + std::string(bl::name_of(kind)), ErrorCode::wrong_kind);
    return at == "from" ? End::from : End::to;
  }
  void chosen_path(const std::string& name, const std::string& chosen, const std::optional<std::string>& wanted, PortPath& path,
                   ValueKind& kind) {
    const PortDefinition* parameter = link_.find_port(chosen);
    if (parameter == nullptr || parameter->kind != ValueKind::port)
      fail(name, "`" + name + "` is chosen by `" + chosen + "`, which is no parameter of kind = \"port\"", ErrorCode::not_found);
    path.chosen_by = chosen;
    kind = wanted.value_or("number") == "point" ? ValueKind::point : ValueKind::number;
    if (wanted && *wanted != "point" && *wanted != "number") fail(name, "`kind` of `" + name + "` is \"number\" or \"point\"");
  }
  void declared_path(const std::string& text, PortPath& path, ValueKind& kind, const std::optional<Unit>& expected) {
    const auto parsed = parse_port_path(text);
    if (!parsed) return fail(text, "`" + text + "` is no port; write \"typification.port\"");
    path = *parsed;
    if (path.typification == kBaseNode && path.port == "id") {
      kind = ValueKind::text;
      return;
    }
    const auto port = types_.port(path);
    if (!port) return fail(text, port.error().message, port.error().code);
    kind = (*port)->kind;
    is_open_ = (*port)->rule != CombineRule::none;
    if (expected && (*port)->unit_from.empty() && !same_dimension(*expected, (*port)->unit))
      fail(text,
           "`" + text + "` is in " + std::string(info((*port)->unit).name) + "s, the script works in " +
               std::string(info(*expected).name) + "s",
           ErrorCode::wrong_unit);
  }

  void read_of(const std::string& name) {
    LinkRead read;
    read.end = path_of(name, read.path, read.kind, read.unit, read.is_whole);
    reads_.push_back(name);
    link_.reads.push_back(std::move(read));
  }
  void proposal_of(const std::string& name) {
    LinkWrite write;
    is_open_ = true;
    write.end = path_of(name, write.path, write.kind, write.unit, write.is_whole);
    if (!is_open_ || write.path.port == "id" || !is_proposable(write.kind))
      fail(write.path.typification + "." + write.path.port,
           "`" + write.path.typification + "." + write.path.port + "` cannot be changed by links", ErrorCode::conflict);
    proposes_.push_back(name);
    link_.proposes.push_back(std::move(write));
  }

  lua_State* lua_;
  const std::string& file_;
  TextLines lines_;
  std::vector<std::string> part_;  // the keys that lead to what is read now
  const Registry& types_;
  LinkDefinition link_;
  std::vector<std::string> reads_, proposes_;
  bool is_open_ = true;
  std::optional<Error> error_;
};

}  // namespace

Result<ScriptDeclaration> read_declaration(lua_State* lua, const std::string& file, std::string_view text,
                                           const Registry& types) {
  return Declaration(lua, file, text, types).run();
}

}  // namespace bl::script
