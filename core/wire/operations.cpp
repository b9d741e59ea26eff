// Frames are bounded JSON; each kind of operation has its own form.
#include "core/wire/operations.h"

#include <nlohmann/json.hpp>

#include "core/room/refusals.h"

namespace bl::wire {

namespace {

std::size_t depth_of(const Json& json) {
  std::size_t deepest = 0;
  if (!json.is_structured()) return 0;
  for (const Json& part : json) deepest = std::max(deepest, depth_of(part));
  return deepest + 1;
}

Result<std::vector<room::Condition>> conditions_of(const JsonValue& value) {
  std::vector<room::Condition> conditions;
  if (value.is_null()) return conditions;
  const auto list = value.read();
  if (!list) return list.error();
  if (!(**list).is_array()) return Error{ErrorCode::wrong_kind, "if", "expects a list of {\"key\", \"was\"}"};
  for (const Json& one : **list) {
    if (!one.is_object() || !one.contains("key") || !one["key"].is_string() || !one.contains("was"))
      return Error{ErrorCode::wrong_kind, "if", "expects a list of {\"key\", \"was\"}"};
    conditions.push_back({one["key"].get<std::string>(), JsonValue::of(one["was"])});
  }
  return conditions;
}

Result<room::Operation> operation_of(const Json& frame, const std::string& t) {
  room::Operation operation;
  Json content = Json::object();
  if (t == "op") {
    const auto op = read_message<Op>(frame);
    if (!op) return op.error();
    auto conditions = conditions_of(op->conditions);
    if (!conditions) return conditions.error();
    operation.content = op->c;
    operation.gesture = op->gesture;
    operation.draft = op->draft;
    operation.conditions = std::move(*conditions);
    return operation;
  }
  if (t == "room") {
    const auto op = read_message<RoomOp>(frame);
    if (!op) return op.error();
    operation.kind = room::OperationKind::event;
    operation.content = op->e;
    return operation;
  }
  if (t == "undo") {
    const auto op = read_message<UndoOp>(frame);
    if (!op) return op.error();
    operation.kind = room::OperationKind::undo;
    if (op->gesture != 0) content["gesture"] = op->gesture;
    if (op->of != 0) content["of"] = op->of;
  } else if (t == "redo") {
    const auto op = read_message<RedoOp>(frame);
    if (!op) return op.error();
    operation.kind = room::OperationKind::redo;
    if (op->gesture != 0) content["gesture"] = op->gesture;
  } else if (t == "rewind") {
    const auto op = read_message<RewindOp>(frame);
    if (!op) return op.error();
    operation.kind = room::OperationKind::rewind;
    content["to"] = op->to;
  } else {
    const auto op = read_message<DraftOp>(frame);
    if (!op) return op.error();
    using What = DraftOp::What;
    operation.kind = op->what == What::begin  ? room::OperationKind::draft_begin
                     : op->what == What::undo ? room::OperationKind::draft_undo
                     : op->what == What::redo ? room::OperationKind::draft_redo
                                              : room::OperationKind::draft_drop;
    content = {{"draft", op->draft}, {"title", op->title}};
  }
  operation.content = JsonValue::of(std::move(content));
  return operation;
}

}  // namespace

Result<Json> read_frame(std::string_view text) {
  auto json = parse_json(text);
  if (!json) return json.error();
  if (!json->is_object() || !json->contains("t") || !(*json)["t"].is_string())
    return Error{ErrorCode::wrong_kind, "t", "a frame is an object with a text `t`"};
  if (depth_of(*json) > kFrameDepth) return Error{ErrorCode::out_of_range, "", "the frame is nested too deeply"};
  return json;
}

bool is_operation(const std::string& t) {
  return t == "op" || t == "room" || t == "undo" || t == "redo" || t == "rewind" || t == "draft";
}

room::Operation read_operation(const Json& frame, const std::string& run) {
  room::Operation read;
  if (auto operation = operation_of(frame, frame["t"].get<std::string>())) read = std::move(*operation);
  else read.unreadable = room::refusal_of(room::Reason::bad, operation.error());
  read.run = run;
  if (frame.contains("id") && frame["id"].is_number_integer()) read.id = frame["id"].get<std::int64_t>();
  return read;
}

std::string write_answer(std::int64_t operation, const room::Answer& answer) {
  if (const auto* done = std::get_if<room::Acknowledgement>(&answer)) return write_message(Ack{operation, done->seq, done->tick});
  const auto& refusal = std::get<room::Refusal>(answer);
  return write_message(Nack{operation, std::string(room::name_of(refusal.why)), refusal.place, refusal.text, refusal.args});
}

}  // namespace bl::wire
