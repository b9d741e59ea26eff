// JSON lines of the log, out and in.
#include "core/session/log.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "core/define/codec.h"
#include "core/graph/state.h"
#include "core/session/gestures.h"

namespace bl {

namespace {

// Version 1 has no base, and all its authors are persons; version 2 has neither sources, nor labels, nor rewinds.
// Versions before 4 do not name the scheme of their hashes, which is 1; versions before 5 have no events, and those before 6 no
// restarts.
constexpr int kLogVersion = 6;
constexpr std::int64_t kLargestNumber = std::int64_t{1} << 53;
constexpr const char* kAuthorKinds[] = {"person", "device", "program"};

Result<std::int64_t> number_in(const Json& line, const char* key, bool is_required) {
  const auto it = line.find(key);
  if (it == line.end() && !is_required) return std::int64_t{0};
  if (it == line.end() || !it->is_number_integer() || *it < 0 || *it > kLargestNumber)
    return Error{ErrorCode::missing, key, "expects a whole number from 0 to 2^53"};
  return it->get<std::int64_t>();
}

Result<LogEntry> rewind_from_json(const Json& line, LogEntry entry) {
  for (const char* key : {"command", "arguments", "undoes", "redoes"})
    if (line.contains(key))
      return Error{ErrorCode::conflict, key, "a rewind has no command and undoes none: remove the other fields"};
  const auto to = number_in(line, "rewind", true);
  if (!to) return to.error();
  if (*to >= entry.tick)
    return Error{ErrorCode::out_of_range, "rewind", "goes back to tick " + std::to_string(*to) + ", which is not before its own"};
  entry.rewinds_to = *to;
  return entry;
}

bool is_hash(const std::string& text) {
  return text.size() == 16 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

Result<LogEntry> restart_from_json(const Json& line, LogEntry entry) {
  for (const char* key : {"command", "arguments", "undoes", "redoes", "rewind", "event"})
    if (line.contains(key))
      return Error{ErrorCode::conflict, key, "a restart has no command and undoes none: remove the other fields"};
  const auto from = number_in(line, "restart", true);
  if (!from) return from.error();
  if (*from >= entry.seq)
    return Error{ErrorCode::out_of_range, "restart",
                 "goes back to entry " + std::to_string(*from) + ", which is not before its own"};
  const auto hash = line.find("state");
  if (hash == line.end() || !hash->is_string() || !is_hash(hash->get<std::string>()))
    return Error{ErrorCode::missing, "state", "expects 16 hexadecimal digits"};
  entry.restarts_from = *from;
  entry.state_hash = hash->get<std::string>();
  return entry;
}

Result<LogEntry> event_from_json(const Json& line, LogEntry entry) {
  for (const char* key : {"command", "undoes", "redoes", "rewind"})
    if (line.contains(key))
      return Error{ErrorCode::conflict, key, "an event of a room has no command and undoes none: remove the other fields"};
  Json event = Json::object();
  event["event"] = line["event"];
  event["arguments"] = line.contains("arguments") ? line["arguments"] : Json::object();
  if (!event["event"].is_string()) return Error{ErrorCode::wrong_kind, "event", "expects a text"};
  if (!event["arguments"].is_object()) return Error{ErrorCode::wrong_kind, "arguments", "expects an object"};
  entry.event = JsonValue::of(std::move(event));
  return entry;
}

Result<LogEntry> entry_from_json(const Json& line, const Registry& registry) {
  if (auto keys = check_keys(line,
                             {"seq", "tick", "author", "kind", "gesture", "undoes", "redoes", "origin", "operation", "label",
                              "abandoned", "rewind", "restart", "state", "event", "command", "arguments"},
                             "");
      !keys)
    return keys.error();
  LogEntry entry;
  for (const auto& [key, target, is_required] : {std::tuple<const char*, std::int64_t*, bool>{"seq", &entry.seq, true},
                                                 {"tick", &entry.tick, true},
                                                 {"gesture", &entry.gesture, true},
                                                 {"undoes", &entry.undoes, false},
                                                 {"redoes", &entry.redoes, false},
                                                 {"operation", &entry.source.operation, false}}) {
    auto number = number_in(line, key, is_required);
    if (!number) return number.error();
    *target = *number;
  }
  if (!line.contains("author") || !line["author"].is_string()) return Error{ErrorCode::missing, "author", "expects a text"};
  entry.author = line["author"].get<std::string>();
  if (const auto kind = line.find("kind"); kind != line.end()) {
    const auto found = std::find(std::begin(kAuthorKinds), std::end(kAuthorKinds), *kind);
    if (found == std::end(kAuthorKinds)) return Error{ErrorCode::wrong_kind, "kind", "expects `person`, `device` or `program`"};
    entry.author.kind = static_cast<AuthorKind>(found - std::begin(kAuthorKinds));
  }
  for (const auto& [key, target] : {std::pair{"origin", &entry.source.origin}, {"label", &entry.label}}) {
    const auto text = line.find(key);
    if (text == line.end()) continue;
    if (!text->is_string()) return Error{ErrorCode::wrong_kind, key, "expects a text"};
    *target = text->get<std::string>();
  }
  if (const auto abandoned = line.find("abandoned"); abandoned != line.end()) {
    if (*abandoned != true || entry.undoes == 0)
      return Error{ErrorCode::wrong_kind, "abandoned", "expects true, at an entry that undoes a gesture"};
    entry.is_abandoned = true;
  }
  if (line.contains("restart")) return restart_from_json(line, std::move(entry));
  if (line.contains("rewind")) return rewind_from_json(line, std::move(entry));
  if (line.contains("event")) return event_from_json(line, std::move(entry));
  Json command = Json::object();
  for (const char* key : {"command", "arguments"})
    if (line.contains(key)) command[key] = line[key];
  auto parsed = command_from_json(registry, command, "");
  if (!parsed) return parsed.error();
  entry.command = std::move(*parsed);
  return entry;
}

Result<LogCheck> check_from_json(const Json& json, bool is_end) {
  auto tick = json.is_object() ? number_in(json, "tick", true)
                               : Result<std::int64_t>(Error{ErrorCode::parse, "", "expects {\"tick\", \"hash\"}"});
  if (!tick) return tick.error();
  const std::string hash = json.contains("hash") && json["hash"].is_string() ? json["hash"].get<std::string>() : "";
  if (!is_hash(hash)) return Error{ErrorCode::missing, "hash", "expects 16 hexadecimal digits"};
  return LogCheck{*tick, hash, is_end};
}

// Line by line, so that whatever is wrong has its number.
class LogReader {
 public:
  LogReader(const Registry& registry, LogUse use) : registry_(registry), use_(use) {}

  Result<void> read_header(const Json& line) {
    const Json format = line.is_object() ? line.value("format", Json()) : Json();
    if (format != "behaviourlinks-log" || !line.contains("scene")) return no_log();
    const Json version = line.value("version", Json());
    if (!version.is_number_integer() || version < 1 || version > kLogVersion)
      return Error{ErrorCode::version, "", "this program reads logs of versions 1 to " + std::to_string(kLogVersion)};
    const auto base = number_in(line, "base", false);
    if (!base) return base.error();
    log.base = *base;
    if (line.contains("hashes")) {
      const auto scheme = number_in(line, "hashes", false);
      if (!scheme) return scheme.error();
      log.hash_scheme = static_cast<int>(std::min<std::int64_t>(*scheme, std::numeric_limits<int>::max()));
    }
    const Json& scene = line["scene"];
    log.scene = write_json(scene) + "\n";
    // What the scene itself gets wrong is told when it is read.
    if (const auto state = scene.find("state"); scene.is_object() && state != scene.end() && state->is_object())
      if (const auto tick = number_in(*state, "tick", false); tick) log.last_tick = first_tick_ = *tick;
    return {};
  }

  Result<void> read_line(const Json& line) {
    if (!line.is_object()) return Error{ErrorCode::parse, "", "expects an object"};
    if (log.has_end)
      return Error{ErrorCode::conflict, "",
                   line.contains("end") ? "is a second end of the log; were two logs put together?"
                                        : "stands after the end of the log; were two logs put together?"};
    for (const bool is_end : {false, true})
      if (const auto it = line.find(is_end ? "end" : "check"); it != line.end()) {
        auto check = check_from_json(*it, is_end);
        return check ? take(std::move(*check)) : check.error();
      }
    auto entry = entry_from_json(line, registry_);
    return entry ? take(std::move(*entry)) : entry.error();
  }

  static Error no_log() {
    return {ErrorCode::parse, "",
            "this is not a log: it starts with {\"format\": \"behaviourlinks-log\", \"version\": 6, \"scene\": {...}}"};
  }

  LogFile log;

 private:
  Result<void> take(LogCheck check) {
    if (check.tick < check_tick_)
      return Error{
          ErrorCode::conflict, "tick",
          "the checks are not in order: tick " + std::to_string(check.tick) + " comes after tick " + std::to_string(check_tick_)};
    // The tick for which the last entries came may have failed, and then the end is the tick before.
    const std::int64_t reached = check.tick + (check.is_end ? 1 : 0);
    if (reached < entry_tick_ && use_ == LogUse::replay) return out_of_order("a check", check.tick, "an entry", entry_tick_);
    if (auto near = reach(check.tick); !near) return near;
    log.has_end = check.is_end;
    check_tick_ = check.tick;
    check.entries = log.entries.size();
    log.checks.push_back(std::move(check));
    return {};
  }

  Result<void> take(LogEntry entry) {
    if (entry.seq <= log.base)
      return Error{ErrorCode::conflict, "seq",
                   "the scene of the log holds all entries up to number " + std::to_string(log.base) + " already"};
    if (entry.tick < entry_tick_ || (!log.entries.empty() && entry.seq <= log.entries.back().seq))
      return Error{ErrorCode::conflict, "seq", "the entries are not in order"};
    if (entry.tick < check_tick_ && use_ == LogUse::replay) return out_of_order("an entry", entry.tick, "a check", check_tick_);
    if (auto near = reach(entry.tick); !near) return near;
    entry_tick_ = entry.tick;
    if (entry.rewinds_to) {
      if (auto back = go_back(*entry.rewinds_to); !back) return back;
    }
    if (entry.restarts_from) {
      if (auto back = restart(*entry.restarts_from); !back) return back;
    }
    if (use_ == LogUse::recovery) entry = gestures_.fitted(entry);
    else if (auto fits = gestures_.check(entry); !fits) return fits;
    gestures_.take(entry);
    log.entries.push_back(std::move(entry));
    return {};
  }

  static Error out_of_order(const char* one, std::int64_t tick, const char* other, std::int64_t last) {
    return {ErrorCode::conflict, "tick",
            std::string("the lines are not in order: ") + one + " of tick " + std::to_string(tick) + " comes after " + other +
                " of tick " + std::to_string(last)};
  }

  // From here on the lines count from the tick that was returned to.
  Result<void> go_back(std::int64_t tick) {
    if (use_ == LogUse::replay && tick < first_tick_)
      return Error{
          ErrorCode::out_of_range, "rewind",
          "tick " + std::to_string(tick) + " lies before the scene of the log, which is at tick " + std::to_string(first_tick_)};
    log.last_tick = entry_tick_ = check_tick_ = tick;
    return {};
  }

  Result<void> restart(std::int64_t from) {
    const auto entry = std::lower_bound(log.entries.begin(), log.entries.end(), from,
                                        [](const LogEntry& one, std::int64_t seq) { return one.seq < seq; });
    if (entry != log.entries.end() && entry->seq == from) return go_back(entry->tick);
    if (use_ == LogUse::recovery) return {};
    return Error{ErrorCode::not_found, "restart", "goes back to entry " + std::to_string(from) + ", which is not in the log"};
  }

  // A replay runs up to the tick of each line.
  Result<void> reach(std::int64_t tick) {
    if (use_ == LogUse::replay && log.entries.empty() && log.checks.empty() && tick < log.last_tick)
      return Error{ErrorCode::out_of_range, "tick",
                   "tick " + std::to_string(tick) + " lies before the scene of the log, which is at tick " +
                       std::to_string(log.last_tick)};
    if (use_ == LogUse::replay && tick - log.last_tick > kMostTicksBetweenLines)
      return Error{ErrorCode::out_of_range, "tick",
                   "tick " + std::to_string(tick) + " is more than " + std::to_string(kMostTicksBetweenLines) +
                       " ticks after the line before, longer than any session"};
    log.last_tick = std::max(log.last_tick, tick);
    return {};
  }

  const Registry& registry_;
  LogUse use_;
  Gestures gestures_;
  std::int64_t first_tick_ = 0;                   // of the scene
  std::int64_t entry_tick_ = 0, check_tick_ = 0;  // of the last lines since the last rewind
};

}  // namespace

std::string log_header(std::string_view scene_text, std::int64_t base, int hash_scheme) {
  Json header = Json::object();
  header["format"] = "behaviourlinks-log";
  header["version"] = kLogVersion;
  header["hashes"] = hash_scheme;
  if (base != 0) header["base"] = base;
  // Ours, because the library's own builder takes n² for a view or a state of n keys; but it reads no more once a stop is wished.
  auto scene = parse_json(scene_text);
  header["scene"] = scene ? std::move(*scene) : Json::parse(scene_text, nullptr, false);
  return write_json_line(header) + "\n";
}

std::string log_line(const LogEntry& entry, const Registry& registry) {
  Json line = Json::object();
  line["seq"] = entry.seq;
  line["tick"] = entry.tick;
  line["author"] = entry.author.id;
  if (entry.author.kind != AuthorKind::person) line["kind"] = kAuthorKinds[static_cast<std::size_t>(entry.author.kind)];
  line["gesture"] = entry.gesture;
  if (entry.undoes != 0) line["undoes"] = entry.undoes;
  if (entry.redoes != 0) line["redoes"] = entry.redoes;
  if (entry.is_abandoned) line["abandoned"] = true;
  if (!entry.source.origin.empty()) line["origin"] = entry.source.origin;
  if (entry.source.operation != 0) line["operation"] = entry.source.operation;
  if (!entry.label.empty()) line["label"] = entry.label;
  if (entry.rewinds_to) line["rewind"] = *entry.rewinds_to;
  else if (entry.restarts_from) line["restart"] = *entry.restarts_from, line["state"] = entry.state_hash;
  else if (entry.event) line.update(**entry.event->read());
  else line.update(command_to_json(registry, entry.command));
  return write_json_line(line) + "\n";
}

Result<LogEntry> log_entry_of(std::string_view line, const Registry& registry) {
  const auto json = parse_json(line);
  if (!json) return json.error();
  if (!json->is_object()) return Error{ErrorCode::parse, "", "expects an object"};
  return entry_from_json(*json, registry);
}

std::string log_line(const LogCheck& check) {
  Json line = Json::object();
  line[check.is_end ? "end" : "check"] = {{"tick", check.tick}, {"hash", check.hash}};
  return write_json_line(line) + "\n";
}

Result<LogFile> read_log(std::string_view text, const Registry& registry, LogUse use) {
  LogReader reader(registry, use);
  int number = 0;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view content = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    const std::string place = "line " + std::to_string(++number);
    if (number == 1 && content.find("behaviourlinks-log") == std::string_view::npos) return LogReader::no_log().within(place);
    if (content.empty()) continue;
    const auto line = parse_json(content);
    if (!line && end == std::string_view::npos && number > 1) {
      reader.log.is_cut_off = true;
      break;
    }
    if (!line) return Error{line.error().code, place, line.error().message};
    const auto done = number == 1 ? reader.read_header(*line) : reader.read_line(*line);
    if (!done) return done.error().within(place);
  }
  if (number == 0) return Error{ErrorCode::parse, "", "the log is empty"};
  return std::move(reader.log);
}

}  // namespace bl
