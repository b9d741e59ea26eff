// What each message holds, in the words of the schema.
#include "core/wire/messages.h"

#include <nlohmann/json.hpp>

#include "core/define/schema.h"
#include "core/wire/shapes_view.h"

namespace bl::wire {

namespace {

template <class M>
void declare_id(MessageBuilder<M>& m) {
  m.field(&M::id, "id").required().min(1).doc("Number of the operation in its run: 1, 2, 3, … without gaps.");
}

}  // namespace

void Hello::declare(MessageBuilder<Hello>& m) {
  m.from_page().id("hello").doc("The first message of a connection: who comes, and what they have already.");
  m.field(&Hello::room, "room").required().doc("Code of the room.");
  m.field(&Hello::run, "run").required().doc("Random name of the life of this page or window; it numbers operations.");
  m.field(&Hello::invite, "invite").doc("Key of an invitation, on the first visit.");
  m.field(&Hello::token, "token").doc("Token of the seat, on later visits.");
  m.field(&Hello::kind, "kind").doc("`page`, `beamer` or `desktop`. A beamer that comes by the code only watches.");
  m.field(&Hello::lang, "lang").doc("Language of the page, such as `en`.");
  m.field(&Hello::build, "build").doc("Build of a window.");
  m.field(&Hello::fingerprint, "fp").doc("What a window's build computes in its self-test.");
  m.field(&Hello::name, "name").doc("Name of the person, where they were asked for it.");
  m.field(&Hello::have, "have").min(0).doc("Number of the last entry that was received.");
  m.field(&Hello::tick, "tick")
      .min(0)
      .doc("The tick that a window has reached; it goes on from there where that is possible. Without one it gets a snapshot.");
  m.field(&Hello::epoch, "epoch").min(0).doc("Epoch of that number.");
  m.field(&Hello::unacked, "unacked").min(0).doc("Number of the last operation that has its answer.");
  m.field(&Hello::views, "views").doc("The views that are to be followed.");
}
void Op::declare(MessageBuilder<Op>& m) {
  m.from_page().id("op").doc("A command.");
  declare_id(m);
  m.field(&Op::base, "base").min(0).doc("Number of the last entry that the sender has seen.");
  m.field(&Op::gesture, "gesture").min(0).doc("Commands of one gesture are undone together; 0 for a new one.");
  m.field(&Op::c, "c").required().doc("{\"command\": id, \"arguments\": {…}}.");
  m.field(&Op::conditions, "if").doc("[{\"key\": place, \"was\": value}]: values that the sender has seen.");
  m.field(&Op::draft, "draft").doc("The draft that it is a step of; empty for none.");
}
void RoomOp::declare(MessageBuilder<RoomOp>& m) {
  m.from_page().id("room").doc("An event of the room.");
  declare_id(m);
  m.field(&RoomOp::e, "e").required().doc("{\"event\": id, \"arguments\": {…}}.");
}
void UndoOp::declare(MessageBuilder<UndoOp>& m) {
  m.from_page().id("undo").doc("Takes back the last gesture of one's own, or the named one.");
  declare_id(m);
  m.field(&UndoOp::gesture, "gesture").min(0).doc("A gesture of the log; 0 for the last one.");
  m.field(&UndoOp::of, "of").min(0).doc("The seat whose gesture it is, for facilitators; 0 for one's own.");
}
void RedoOp::declare(MessageBuilder<RedoOp>& m) {
  m.from_page().id("redo").doc("Does again what was taken back last.");
  declare_id(m);
  m.field(&RedoOp::gesture, "gesture").min(0).doc("A gesture of the log; 0 for the last one.");
}
void RewindOp::declare(MessageBuilder<RewindOp>& m) {
  m.from_page().id("rewind").doc("Takes back everything since an entry, whoever did it; for facilitators.");
  declare_id(m);
  m.field(&RewindOp::to, "to").required().min(0).doc("The last entry that stays.");
}
void DraftOp::declare(MessageBuilder<DraftOp>& m) {
  m.from_page().id("draft").doc(
      "Begins or drops a draft, takes its last step back, or brings the step back that was taken back last.");
  declare_id(m);
  m.field(&DraftOp::what, "do",
          {{What::begin, "begin", "Begins a draft."},
           {What::undo, "undo", "Takes its last step back."},
           {What::redo, "redo", "Brings the step back that was taken back last."},
           {What::drop, "drop", "Gives it up."}})
      .doc("What happens to the draft.");
  m.field(&DraftOp::draft, "draft").required().doc("Name of the draft.");
  m.field(&DraftOp::title, "title").doc("What a new draft is called.");
}
void Want::declare(MessageBuilder<Want>& m) {
  m.from_page().id("want").doc("The views that are to be followed from now on.");
  m.field(&Want::views, "views")
      .required()
      .doc(
          "`room`, `plan`, `figures`, `card`, `votes`, `comments`, `proposals`, `drafts`, `draft_steps`, "
          "`draft_plans`, `keys`, `shapes`, `decisions`, `past`.");
  m.field(&Want::drafts, "drafts").doc("The drafts that are on the screen, four at most: these are tried beside the room.");
}
void Seen::declare(MessageBuilder<Seen>& m) {
  m.from_page().id("seen").doc("How far a page has come.");
  m.field(&Seen::s, "s").min(0).doc("Number of the last entry that it has shown.");
  m.field(&Seen::lag, "lag").min(0).doc("How late it was, in milliseconds.");
}
void Ping::declare(MessageBuilder<Ping>& m) {
  m.from_page().id("ping").doc("Asks whether the connection lives.");
  m.field(&Ping::n, "n").min(0).doc("Comes back with the answer.");
}
void PresenceIn::declare(MessageBuilder<PresenceIn>& m) {
  m.from_page().id("presence").doc("Where somebody is and what they hold; the newest counts, and nothing of it is stored.");
  m.field(&PresenceIn::n, "n").min(0).doc("Ascending.");
  m.field(&PresenceIn::cursor, "cursor").doc("[x, y, z] in metres, or null.");
  m.field(&PresenceIn::camera, "camera").doc("How a window looks at the scene, for those who follow it; null where it does not.");
  m.field(&PresenceIn::holds, "holds").doc("Ids of nodes that the person has selected.");
  m.field(&PresenceIn::hidden, "hidden").doc("On where the page is not visible.");
}
void Resync::declare(MessageBuilder<Resync>& m) {
  m.from_page().id("resync").doc("A window asks for a snapshot, because it can no longer follow the ticks from where it is.");
  m.field(&Resync::k, "k").min(0).doc("The tick at which that was noticed.");
  m.field(&Resync::have, "have")
      .min(0)
      .doc("Number of the last entry that the window has; those behind it come before the snapshot.");
  m.field(&Resync::expected, "expected").doc("The server's hash of that tick, where hashes differ.");
  m.field(&Resync::found, "found").doc("The window's own hash of it.");
  m.field(&Resync::why, "why").doc("`hash`, `late`, `entry`, or `values` where the window does not compute ticks at all.");
}
void Welcome::declare(MessageBuilder<Welcome>& m) {
  m.id("welcome").doc("The answer to `hello`.");
  m.field(&Welcome::you, "you").required().doc("{seat, role, name, colour, areas, card}.");
  m.field(&Welcome::room, "room").required().doc("{code, title}.");
  m.field(&Welcome::limits, "limits").required().doc("{frame, text, queue}: sizes and numbers that are refused above.");
  m.field(&Welcome::epoch, "epoch").required().doc("Changes where numbers of entries begin anew.");
  m.field(&Welcome::seq, "seq").required().doc("Number of the last entry that is stored.");
  m.field(&Welcome::tick, "tick").required().doc("The tick.");
  m.field(&Welcome::rate, "rate").required().doc("Ticks in a second.");
  m.field(&Welcome::done, "done").required().doc("The last operation of this run that is answered.");
  m.field(&Welcome::resume, "resume").doc("`none` or `snapshot`: all views come anew.");
  m.field(&Welcome::mode, "mode")
      .doc("For windows that have sent their self-test: `ticks` where it equals the server's, else `values`.");
  m.field(&Welcome::addresses, "addresses")
      .doc("Where the room can be found: the addresses of this server, and of the laptops that follow it and have said theirs.");
  m.field(&Welcome::token, "token").doc("Opens the seat again; only on the first visit.");
}
void SceneOut::declare(MessageBuilder<SceneOut>& m) {
  m.id("scene").doc("The scene before the first entry, for windows; `ops` with all entries since follow.");
  m.field(&SceneOut::s, "s").required().doc("Number of the last entry that it holds already.");
  m.field(&SceneOut::scene, "scene").required().doc("The scene file.");
}
void SnapshotOut::declare(MessageBuilder<SnapshotOut>& m) {
  m.id("snapshot").doc("A scene with its running state, for windows that take the same ticks; what comes later goes on from it.");
  m.field(&SnapshotOut::s, "s").required().doc("Number of the last entry that it holds.");
  m.field(&SnapshotOut::k, "k").required().doc("Its tick.");
  m.field(&SnapshotOut::scene, "scene").required().doc("The scene file with its state: deflated by zlib, in base 64.");
  m.field(&SnapshotOut::size, "size").required().doc("Bytes of the text.");
  m.field(&SnapshotOut::digest, "digest").required().doc("A hash of the text.");
}
void TickOut::declare(MessageBuilder<TickOut>& m) {
  m.id("tick").doc("Every entry that a tick has read is sent: a window may take the ticks up to this one.");
  m.field(&TickOut::k, "k").required().doc("The tick.");
  m.field(&TickOut::s, "s").required().doc("Number of the last entry that it has read.");
  m.field(&TickOut::h, "h").doc("Its hash, at least once in twenty ticks that were taken.");
  m.field(&TickOut::scene, "scene").doc("A hash of the scene after the entry `s`, with `h` where nothing has been said since.");
  m.field(&TickOut::rest, "rest").doc("On where the ticks only count on from here, until somebody says something.");
}
void Ops::declare(MessageBuilder<Ops>& m) {
  m.id("ops").doc("Entries of the log, after they are stored.");
  m.field(&Ops::e, "e")
      .required()
      .doc(
          "[{s, k, a, g, c or v, by, d}]; a restart has `back`, the entry to whose running state it goes, and `state`, its "
          "hash.");
  m.field(&Ops::d, "d").required().doc("Number of the last stored entry.");
  m.field(&Ops::epoch, "epoch").min(0).doc("Grows with each return to a scenario: ticks go back.");
}
void Ack::declare(MessageBuilder<Ack>& m) {
  m.id("ack").doc("The operation is stored.");
  declare_id(m);
  m.field(&Ack::s, "s").required().doc("Its entry.");
  m.field(&Ack::k, "k").required().doc("The tick that reads it.");
}
void Nack::declare(MessageBuilder<Nack>& m) {
  m.id("nack").doc("The operation changed nothing.");
  declare_id(m);
  m.field(&Nack::why, "why").required().doc("One of a closed list of reasons.");
  m.field(&Nack::place, "place").doc("Where.");
  m.field(&Nack::text, "text").doc("More about it, in English.");
  m.field(&Nack::args, "args").doc("What its sentence needs in other languages.");
}
void StateOut::declare(MessageBuilder<StateOut>& m) {
  m.id("state").doc("What has changed in a view; the first one of a view has all of it.");
  m.field(&StateOut::view, "view").required().doc("Name of the view.");
  m.field(&StateOut::k, "k").required().doc("The tick.");
  m.field(&StateOut::s, "s").required().doc("Number of the last entry that it knows.");
  m.field(&StateOut::set, "set").required().doc("Keys with their new content.");
  m.field(&StateOut::drop, "drop").doc("Keys that are gone.");
  m.field(&StateOut::whole, "whole").doc("On where the message has all of the view.");
}
void PresenceOut::declare(MessageBuilder<PresenceOut>& m) {
  m.id("presence").doc("Who is where; only what has changed.");
  m.field(&PresenceOut::seats, "seats").required().doc("By seat; null for somebody who is gone.");
}
void Say::declare(MessageBuilder<Say>& m) {
  m.id("say").doc("A notice for people.");
  m.field(&Say::id, "id").required().doc("Which one; pages have the sentence.");
  m.field(&Say::args, "args").doc("What the sentence needs.");
}
void HealthOut::declare(MessageBuilder<HealthOut>& m) {
  m.id("health").doc("How the room and its computer are; for facilitators. What nobody knows is -1, or missing.");
  m.field(&HealthOut::tick_ms, "tick_ms").required().doc("Duration of a tick, smoothed, in milliseconds.");
  m.field(&HealthOut::rate, "rate").required().doc("Ticks that are taken in a second.");
  m.field(&HealthOut::wanted, "wanted").required().doc("Ticks in a second that the room wants.");
  m.field(&HealthOut::settled, "settled").required().doc("On where the model has settled.");
  m.field(&HealthOut::worst, "worst").required().doc("The largest error of a demand, as a share of it.");
  m.field(&HealthOut::worst_of, "worst_of").doc("The node that has it.");
  m.field(&HealthOut::failure, "failure").doc("Why the ticks have stopped.");
  m.field(&HealthOut::problem, "problem").doc("Why nothing can be stored.");
  m.field(&HealthOut::disk_ms, "disk_ms")
      .required()
      .doc("Duration of storing: half of the last hundred took no longer, in milliseconds.");
  m.field(&HealthOut::disk_slow_ms, "disk_slow_ms").required().doc("The same of 95 in a hundred.");
  m.field(&HealthOut::file, "file").doc("The session file, as its computer finds it: minutes are made of it.");
  m.field(&HealthOut::journal, "journal").required().doc("Bytes of the session file.");
  m.field(&HealthOut::snapshot_age, "snapshot_age")
      .required()
      .doc("Seconds since the last snapshot was stored, since the room was opened.");
  m.field(&HealthOut::followers, "followers").required().doc("Laptops that follow the room.");
  m.field(&HealthOut::battery, "battery").required().doc("How full the battery is, from 0 to 1; -1 where there is none.");
  m.field(&HealthOut::mains, "mains",
          {{Mains::unknown, "unknown", "The system does not say."},
           {Mains::yes, "yes", "The computer is plugged in."},
           {Mains::no, "no", "It runs on its battery."}})
      .doc("Whether the computer is plugged in.");
  m.field(&HealthOut::wireless, "wireless").required().doc("{INTERFACE: quality of its Wi-Fi link, from 0 to 1}.");
  m.field(&HealthOut::memory_free, "memory_free").required().doc("Bytes of memory that programs may still take.");
  m.field(&HealthOut::disk_free, "disk_free").required().doc("Bytes that are free on the disk of the session file.");
  m.field(&HealthOut::reached, "reached").required().doc("{ADDRESS: how many other devices have come by it}.");
  m.field(&HealthOut::verdicts, "verdicts")
      .required()
      .doc(
          "{FIGURE: `good`, `look` or `bad`}, of `ticks`, `disk`, `power`, `memory`, `space`, `wireless/INTERFACE` and "
          "`reached/ADDRESS`.");
}
void Pong::declare(MessageBuilder<Pong>& m) {
  m.id("pong").doc("The connection lives.");
  m.field(&Pong::n, "n").required().doc("Of the `ping`.");
  m.field(&Pong::k, "k").required().doc("The tick.");
}

std::string line_of(const MessageDefinition& kind, const std::map<std::string, Value>& values) {
  Json json = Json::object();
  json["t"] = kind.id;
  json.update(ports_to_json(kind, values));
  return write_json_line(json);
}

std::vector<const MessageDefinition*> message_kinds() {
  return {&message_kind<Hello>(),       &message_kind<Op>(),          &message_kind<RoomOp>(),     &message_kind<UndoOp>(),
          &message_kind<RedoOp>(),      &message_kind<RewindOp>(),    &message_kind<DraftOp>(),    &message_kind<Want>(),
          &message_kind<Seen>(),        &message_kind<Ping>(),        &message_kind<PresenceIn>(), &message_kind<Resync>(),
          &message_kind<Welcome>(),     &message_kind<SnapshotOut>(), &message_kind<TickOut>(),    &message_kind<SceneOut>(),
          &message_kind<Ops>(),         &message_kind<Ack>(),         &message_kind<Nack>(),       &message_kind<StateOut>(),
          &message_kind<PresenceOut>(), &message_kind<Say>(),         &message_kind<HealthOut>(),  &message_kind<Pong>()};
}

namespace {

Json schema_of(const MessageDefinition& kind) {
  Json one = {{"type", "object"}, {"description", kind.doc}, {"properties", {{"t", {{"const", kind.id}}}}}};
  Json required = Json::array({"t"});
  for (const PortDefinition& port : kind.ports) {
    one["properties"][port.id] = value_schema(port);
    if (port.is_required) required.push_back(port.id);
  }
  one["required"] = required;
  one["additionalProperties"] = false;
  return one;
}

}  // namespace

Json message_schema() {
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "Messages of a room"}};
  schema["$defs"] = {{"from_page", Json::object()}, {"from_server", Json::object()}, {"shapes", Json::object()}};
  Json any = Json::array();
  for (const MessageDefinition* kind : message_kinds()) {
    const char* side = kind->is_from_page ? "from_page" : "from_server";
    schema["$defs"][side][kind->id] = schema_of(*kind);
    any.push_back({{"$ref", std::string("#/$defs/") + side + "/" + kind->id}});
  }
  // No messages: what the keys of the view hold.
  for (const MessageDefinition* kind : shape_kinds()) schema["$defs"]["shapes"][kind->id] = schema_of(*kind);
  schema["oneOf"] = std::move(any);
  return schema;
}

}  // namespace bl::wire
