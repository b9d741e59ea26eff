// The messages between a room's server and its pages and windows.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/define/payload.h"
#include "core/wire/message_builder.h"

namespace bl::wire {

// From a page or a window. Operations have an `id`: 1, 2, 3, … without gaps in each run.

struct Hello {
  std::string room, run, invite, token, kind = "page", lang, build, fingerprint, name;
  std::int64_t have = 0, tick = 0, epoch = 0, unacked = 0;
  std::vector<std::string> views;
  static void declare(MessageBuilder<Hello>& m);
};
struct Op {
  std::int64_t id = 0, base = 0, gesture = 0;
  JsonValue c = JsonValue::null(), conditions = JsonValue::null();
  std::string draft;
  static void declare(MessageBuilder<Op>& m);
};
struct RoomOp {
  std::int64_t id = 0;
  JsonValue e = JsonValue::null();
  static void declare(MessageBuilder<RoomOp>& m);
};
struct UndoOp {
  std::int64_t id = 0, gesture = 0, of = 0;
  static void declare(MessageBuilder<UndoOp>& m);
};
struct RedoOp {
  std::int64_t id = 0, gesture = 0;
  static void declare(MessageBuilder<RedoOp>& m);
};
struct RewindOp {
  std::int64_t id = 0, to = 0;
  static void declare(MessageBuilder<RewindOp>& m);
};
struct DraftOp {
  enum class What : std::uint8_t { begin, undo, redo, drop };
  std::int64_t id = 0;
  What what = What::begin;
  std::string draft, title;
  static void declare(MessageBuilder<DraftOp>& m);
};
struct Want {
  static constexpr std::size_t kMostDrafts = 4;
  std::vector<std::string> views, drafts;
  static void declare(MessageBuilder<Want>& m);
};
struct Seen {
  std::int64_t s = 0, lag = 0;
  static void declare(MessageBuilder<Seen>& m);
};
struct Ping {
  std::int64_t n = 0;
  static void declare(MessageBuilder<Ping>& m);
};
struct PresenceIn {
  std::int64_t n = 0;
  JsonValue cursor = JsonValue::null(), camera = JsonValue::null();
  std::vector<std::string> holds;
  bool hidden = false;
  static void declare(MessageBuilder<PresenceIn>& m);
};
struct Resync {
  std::int64_t k = 0, have = 0;
  std::string expected, found, why;
  static void declare(MessageBuilder<Resync>& m);
};

// From the server.

struct Welcome {
  JsonValue you = {}, room = {}, limits = {};
  std::int64_t epoch = 0, seq = 0, tick = 0, done = 0;
  double rate = 0;
  std::string resume = "snapshot", token, mode;
  std::vector<std::string> addresses;
  static void declare(MessageBuilder<Welcome>& m);
};
struct SceneOut {
  std::int64_t s = 0;
  JsonValue scene = {};
  static void declare(MessageBuilder<SceneOut>& m);
};
struct SnapshotOut {
  std::int64_t s = 0, k = 0, size = 0;
  std::string scene, digest;
  static void declare(MessageBuilder<SnapshotOut>& m);
};
struct TickOut {
  std::int64_t k = 0, s = 0;
  std::string h, scene;
  bool rest = false;
  static void declare(MessageBuilder<TickOut>& m);
};
struct Ops {
  JsonValue e = JsonValue::null();
  std::int64_t d = 0, epoch = 0;
  static void declare(MessageBuilder<Ops>& m);
};
struct Ack {
  std::int64_t id = 0, s = 0, k = 0;
  static void declare(MessageBuilder<Ack>& m);
};
struct Nack {
  std::int64_t id = 0;
  std::string why, place, text;
  JsonValue args = {};
  static void declare(MessageBuilder<Nack>& m);
};
struct StateOut {
  std::string view;
  std::int64_t k = 0, s = 0;
  JsonValue set = {};
  std::vector<std::string> drop;
  bool whole = false;
  static void declare(MessageBuilder<StateOut>& m);
};
struct PresenceOut {
  JsonValue seats = {};
  static void declare(MessageBuilder<PresenceOut>& m);
};
struct Say {
  std::string id;
  JsonValue args = {};
  static void declare(MessageBuilder<Say>& m);
};
/// How the room and its computer are; for facilitators, every two seconds. A number below 0: nobody knows.
struct HealthOut {
  enum class Mains : std::uint8_t { unknown, yes, no };
  double tick_ms = 0, rate = 0, wanted = 0;
  bool settled = false;
  double worst = 0;
  std::string worst_of, failure, problem, file;
  double disk_ms = 0, disk_slow_ms = 0;
  std::int64_t journal = -1, snapshot_age = -1, followers = 0;
  double battery = -1;
  Mains mains = Mains::unknown;
  JsonValue wireless = {}, reached = {}, verdicts = {};
  std::int64_t memory_free = -1, disk_free = -1;
  static void declare(MessageBuilder<HealthOut>& m);
};
struct Pong {
  std::int64_t n = 0, k = 0;
  static void declare(MessageBuilder<Pong>& m);
};

/// All kinds of messages, by `t` and direction: those with the same name in both directions are two.
std::vector<const MessageDefinition*> message_kinds();
/// JSON Schema (2020-12) of all messages: `#/$defs/from_page/NAME` and `#/$defs/from_server/NAME`; and of what the keys of the
/// view `shapes` hold: `#/$defs/shapes/NAME`.
Json message_schema();
/// The same as TypeScript: the interfaces `FromPage` and `FromServer`, with a type for each kind of message.
std::string message_types();

}  // namespace bl::wire
