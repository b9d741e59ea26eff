// Declares a message between a room's server and its pages and windows: its fields, as JSON and as a schema.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/define/codec.h"
#include "core/define/json_text.h"
#include "core/define/port_builder.h"

namespace bl::wire {

/// A kind of message; its id is the field `t`.
struct MessageDefinition : TypeDefinition {
  bool is_from_page = false;
};

/// M has `static void declare(MessageBuilder<M>&)`; its members are the fields.
template <class M>
class MessageBuilder : public TypeBuilder<MessageDefinition> {
 public:
  using TypeBuilder::TypeBuilder;

  MessageBuilder& from_page() {
    definition_->is_from_page = true;
    return *this;
  }
  template <class T>
  PortBuilder<T> field(T M::*member, std::string_view id) {
    return add_port(definition_->ports, member, id);
  }
  template <ChoiceMember E>
  PortBuilder<E> field(E M::*member, std::string_view id, std::vector<Choice<E>> choices) {
    return add_choice(definition_->ports, member, id, std::span<const Choice<E>>(choices));
  }
};

/// Made once.
template <class M>
const MessageDefinition& message_kind() {
  static const MessageDefinition kKind = [] {
    MessageDefinition kind;
    MessageBuilder<M> builder(kind);
    M::declare(builder);
    return kind;
  }();
  return kKind;
}

/// The message in a JSON object, whose `t` has been looked at already. Unknown fields and wrong values are errors with their
/// place.
template <class M>
Result<M> read_message(const Json& json) {
  static constexpr std::string_view kBeside[] = {"t"};
  const MessageDefinition& kind = message_kind<M>();
  auto values = ports_from_json(kind, json, "", kBeside);
  if (!values) return values.error();
  M message;
  for (const PortDefinition& port : kind.ports)
    if (const auto value = values->find(port.id); value != values->end()) port.set(&message, value->second);
  return message;
}

/// The values of a message of that kind, with its `t`, on one line.
std::string line_of(const MessageDefinition& kind, const std::map<std::string, Value>& values);

/// One line; fields with their default values are left out, but for those that are required.
template <class M>
std::string write_message(const M& message) {
  const MessageDefinition& kind = message_kind<M>();
  std::map<std::string, Value> values;
  for (const PortDefinition& port : kind.ports) values[port.id] = port.get(&message);
  return line_of(kind, values);
}

}  // namespace bl::wire
