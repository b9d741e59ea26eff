// A room in one process, with its disk: what it has stored, and a way to lose everything else.
#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/random.h"
#include "core/define/codec.h"
#include "core/room/room.h"
#include "tests/support/world.h"

namespace bl::room {

/// Two areas side by side, a role card, and a link between the areas.
inline constexpr const char* kTable = R"({"format": "behaviourlinks", "version": 1, "nodes": [
  {"id": "north", "position": [0, 50, 0], "types": {"smart_volume": {"demand": 900}}},
  {"id": "north_2", "position": [10, 60, 0], "types": {"smart_volume": {"demand": 400}}},
  {"id": "south", "position": [0, -50, 0], "types": {"smart_volume": {"demand": 700}}},
  {"id": "card", "types": {"stakeholder_group": {"controls": [
    {"node": "south", "port": "smart_volume.demand", "minimum": 500, "maximum": 900},
    {"node": "apart", "port": "strength", "minimum": 0, "maximum": 0.5}]}}},
  {"id": "poll", "types": {"vote": {"kind": "yes_no"}}},
  {"id": "secret_poll", "types": {"vote": {"kind": "yes_no", "is_secret": true}}},
  {"id": "meter", "types": {"sensor": {}}}],
  "links": [{"id": "apart", "kind": "keep_distance", "from": "north", "to": "south"},
            {"id": "inner", "kind": "keep_distance", "from": "north", "to": "north_2"}]})";

class RoomWorld {
 public:
  explicit RoomWorld(const char* scene = kTable, Allowances allowances = {}) : scene_(scene), allowances_(allowances) { start(); }

  /// A seat, by role; designers get the area of the same name as `area`.
  std::int64_t seat(Role role, std::set<std::string> areas = {}, const std::string& card = "") {
    const auto admitted = room().admit({.role = role, .areas = std::move(areas), .card = card}, now());
    store();
    const auto* admission = std::get_if<Admission>(&admitted);
    if (admission == nullptr) return 0;
    tokens[admission->seat] = admission->token;
    return admission->seat;
  }
  /// The next operation of a seat's only run.
  Answer say(std::int64_t seat, OperationKind kind, const std::string& content, const std::string& draft = "",
             std::int64_t gesture = 0) {
    const std::string run = "run " + std::to_string(seat);
    return send(seat,
                {.run = run, .id = ++operations_[run], .kind = kind, .content = content, .gesture = gesture, .draft = draft});
  }
  Answer send(std::int64_t seat, const Operation& operation) {
    const Answer answer = room().submit(seat, operation, now());
    store();
    return answer;
  }
  Answer event(std::int64_t seat, const std::string& event, const std::string& arguments = "{}") {
    return say(seat, OperationKind::event, R"({"event": ")" + event + R"(", "arguments": )" + arguments + "}");
  }
  Answer command(std::int64_t seat, const Command& command, const std::string& draft = "", std::int64_t gesture = 0) {
    return say(seat, OperationKind::command, write_json_line(command_to_json(full_registry(), command)), draft, gesture);
  }

  /// The program is gone; another one goes on from what was stored.
  void crash() {
    start();
    for (const EntryRecord& record : disk.entries) {
      const auto done = room_->replay(record);
      ASSERT_TRUE(done.ok()) << record.entry.seq << ": " << done.error().text();
    }
    room_->restore(disk);
    (void)room_->take_record();
  }

  Room& room() { return *room_; }
  Ledger& ledger() { return *ledger_; }
  Now now() const { return {tick, at}; }
  const Scene& scene() const { return room_->scene(); }
  double demand(const std::string& node) const {
    const PortValues& values = scene().nodes.at(node).types.at("smart_volume");
    return values.contains("demand") ? std::get<double>(values.at("demand")) : 0;
  }

  std::int64_t tick = 0, at = 1000;
  std::map<std::int64_t, std::string> tokens;
  Record disk;  // of all but entries only the last of each key counts

  /// Takes what the room has said and puts it on the disk.
  void store() {
    Record record = room_->take_record();
    const auto append = [](auto& all, auto& more) { all.insert(all.end(), more.begin(), more.end()); };
    append(disk.entries, record.entries);
    append(disk.runs, record.runs);
    append(disk.refusals, record.refusals);
    for (const TokenRecord& token : record.tokens) {
      std::erase_if(disk.tokens, [&](const TokenRecord& old) { return old.seat == token.seat; });
      disk.tokens.push_back(token);
    }
    append(disk.persons, record.persons);
    append(disk.texts, record.texts);
    append(disk.drafts, record.drafts);
    append(disk.draft_steps, record.draft_steps);
    for (const std::string& vote : record.ballots_in_log)
      std::erase_if(disk.secret_ballots, [&](const SecretBallotRecord& old) { return old.vote == vote; });
    append(disk.secret_ballots, record.secret_ballots);
    // A vote may be closed and opened again in one record.
    for (const BallotKeyRecord& key : record.ballot_keys) {
      std::erase_if(disk.ballot_keys, [&](const BallotKeyRecord& old) { return old.vote == key.vote; });
      if (!key.key.empty()) disk.ballot_keys.push_back(key);
    }
  }

 private:
  void start() {
    room_.reset();
    ledger_ = std::make_unique<Ledger>(full_registry(), read_scene(scene_, full_registry()).scene);
    room_ = std::make_unique<Room>(*ledger_, RoomOptions{allowances_, [this](std::size_t count) {
                                                           std::string bytes;
                                                           for (std::size_t k = 0; k < count; ++k)
                                                             bytes += static_cast<char>(random_.below(256));
                                                           return bytes;
                                                         }});
  }

  const char* scene_;
  Allowances allowances_;
  Random random_{7};
  std::unique_ptr<Ledger> ledger_;
  std::unique_ptr<Room> room_;
  std::map<std::string, std::int64_t> operations_;
};

/// "" where it was taken, else the reason.
inline std::string why(const Answer& answer) {
  const auto* refusal = std::get_if<Refusal>(&answer);
  return refusal == nullptr ? "" : std::string(name_of(refusal->why));
}
inline std::string sentence(const Answer& answer) {
  const auto* refusal = std::get_if<Refusal>(&answer);
  return refusal == nullptr ? "" : std::string(name_of(refusal->why)) + " " + refusal->place + ": " + refusal->text;
}

inline Command set_demand(const std::string& node, double demand) {
  return command<SetPort>({node, {"smart_volume.demand"}, JsonValue::of(demand)});
}

}  // namespace bl::room
