// Declares an event of a room: its arguments, who may cause it, and how it changes the state of the room.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/define/port_builder.h"
#include "core/define/rights.h"
#include "core/graph/scene.h"
#include "core/room/room_state.h"

namespace bl::room {

/// Where an event stands in the log, who has caused it, and the scene at that moment. The room itself is seat 0.
struct EventPlace {
  std::int64_t seq = 0, tick = 0, seat = 0;
  const Scene& scene;
};

/// A kind of event. `apply` leaves the state unchanged when it returns an error.
struct EventDefinition : TypeDefinition {
  Rights rights = {};
  std::vector<std::string> words = {};   ///< arguments that hold people's words: the log has the names of texts instead
  std::vector<std::string> titles = {};  ///< those of them that are short, and may be said again
  std::function<Result<void>(RoomState&, std::span<const Value>, const EventPlace&)> apply;
};

using EventKinds = std::map<std::string, EventDefinition, std::less<>>;

/// T has `struct In` (arguments), `static constexpr Rights kRights`, `declare(EventBuilder<T>&)` and
/// `static Result<void> apply(RoomState&, const In&, const EventPlace&)`.
template <class T>
class EventBuilder : public TypeBuilder<EventDefinition> {
 public:
  using TypeBuilder::TypeBuilder;
  using In = typename T::In;

  template <class M>
  PortBuilder<M> argument(M In::*member, std::string_view id) {
    return add_port(definition_->ports, member, id);
  }
  template <ChoiceMember E>
  PortBuilder<E> argument(E In::*member, std::string_view id, std::vector<Choice<E>> choices) {
    return add_choice(definition_->ports, member, id, std::span<const Choice<E>>(choices));
  }
  /// What somebody says in their own words. It can be erased later, because only its name stands in the log.
  PortBuilder<std::string> words(std::string In::*member, std::string id) {
    definition_->words.push_back(id);
    return add_port(definition_->ports, member, id);
  }
  /// The same for something short that may be said again, such as the name of a phase: the same words have the same name in the
  /// log.
  PortBuilder<std::string> title(std::string In::*member, std::string id) {
    definition_->titles.push_back(id);
    return words(member, std::move(id));
  }
  static EventDefinition build() {
    EventDefinition definition;
    definition.rights = T::kRights;
    EventBuilder builder(definition);
    T::declare(builder);
    const auto ports = std::make_shared<const std::vector<PortDefinition>>(definition.ports);
    definition.apply = [ports](RoomState& state, std::span<const Value> values, const EventPlace& place) {
      In in;
      set_members(*ports, values, &in);
      return T::apply(state, in, place);
    };
    return definition;
  }
};

/// All kinds of events, by id; made once, never changed.
const EventKinds& event_kinds();

}  // namespace bl::room

/// The last line of each file in events/: makes the event known under the file's stem.
#define BL_EVENT(stem, Type)                            \
  namespace bl::room {                                  \
  void register_event_##stem(EventKinds& kinds) {       \
    EventDefinition kind = EventBuilder<Type>::build(); \
    kinds.emplace(kind.id, std::move(kind));            \
  }                                                     \
  }
