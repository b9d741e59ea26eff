// Declares a typification: a plain struct with In and Out, one declare(), and one pure evaluate().
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/define/port_builder.h"

namespace bl {

/// Declares the reads from, and the replies to, each node of a set.
template <class Sets, class Out, class Member, class Reply>
class SetBuilder {
 public:
  explicit SetBuilder(SetDefinition& set) : set_(&set) {}

  template <class M>
  SetBuilder& reads(M Member::*member, std::string_view path, std::optional<Unit> unit = std::nullopt) {
    ReadDefinition& read = set_->reads.emplace_back();
    read.path = port_path(path);
    read.unit = unit;
    bind_read(read, member);
    return *this;
  }
  /// Reads the port that people chose in the parameter `parameter`.
  template <class M>
  SetBuilder& reads_chosen(M Member::*member, std::string parameter) {
    ReadDefinition& read = set_->reads.emplace_back();
    read.path.chosen_by = std::move(parameter);
    bind_read(read, member);
    return *this;
  }
  template <class M>
  SetBuilder& writes(M Reply::*member, std::string_view path) {
    WriteDefinition& write = set_->writes.emplace_back();
    write.path = port_path(path);
    bind_write(write, member);
    return *this;
  }

 private:
  SetDefinition* set_;
};

/// The members of a set for an evaluation that answers some of them only. It has to answer those that are `changed`, and all
/// others whose replies come out differently than in the last evaluation. With an empty memo it answers all.
template <class Member>
struct Watched {
  std::span<const Member> all;             ///< in ascending node id
  std::span<const std::uint32_t> changed;  ///< ascending; see SetValues
  bool is_anew = true;                     ///< nothing is known of the last evaluation
};
/// What such an evaluation replies: one reply for each of `members`, which ascend.
template <class Reply>
struct SomeReplies {
  std::vector<std::uint32_t> members;
  std::vector<Reply> replies;
};

struct NoReply {};
struct NoSets {};

/// T has `struct In`, `struct Out`, `declare(TypificationBuilder<T>&)` and one of
/// `static Result<Out> evaluate(const In&, const Tick&)`,
/// `static Result<Out> evaluate(const In&, const Sets&, const Tick&)`, or none.
template <class T>
class TypificationBuilder : public TypeBuilder<TypificationDefinition> {
 public:
  using TypeBuilder::TypeBuilder;
  using In = typename T::In;
  using Out = typename T::Out;

  /// Hints for views, with no other effect.
  TypificationBuilder& column(CanvasColumn column) {
    definition_->column = column;
    return *this;
  }
  TypificationBuilder& icon(Icon icon) {
    definition_->icon = icon;
    return *this;
  }

  template <class M>
  PortBuilder<M> in(M In::*member, std::string_view id) {
    return add_port(definition_->ports, member, id);
  }
  template <ChoiceMember E>
  PortBuilder<E> in(E In::*member, std::string_view id, std::vector<Choice<E>> choices) {
    return add_choice(definition_->ports, member, id, std::span<const Choice<E>>(choices));
  }
  /// The evaluation runs beside the ticks: it starts with the data of one tick, and its result counts a given number of ticks
  /// later, whatever time it takes. Its outputs hold no meshes. Only for typifications with sets; `Tick::pool` and `Tick::memo`
  /// are null.
  PortBuilder<int> latency(int In::*member, std::string_view id) {
    definition_->latency = id;
    return in(member, id).unit(Unit::count).range(0, 1000).soft(1, 30);
  }
  /// Declare all settings before the first output.
  template <class M>
  PortBuilder<M> out(M Out::*member, std::string_view id) {
    auto builder = add_port(definition_->ports, member, id);
    definition_->ports.back().is_computed = true;
    return builder;
  }
  template <ChoiceMember E>
  PortBuilder<E> out(E Out::*member, std::string_view id, std::vector<Choice<E>> choices) {
    auto builder = add_choice(definition_->ports, member, id, std::span<const Choice<E>>(choices));
    definition_->ports.back().is_computed = true;
    return builder;
  }

  /// An output for code: an object that depends on the computed ports `from` only. It is neither saved nor hashed, since these
  /// ports are; after loading it is made again. `make` is called with their values when the object is first read. Not for
  /// analyses, and not from replies to members of sets, since changes of these are not tracked.
  template <class Object, class... Sources>
  PortBuilder<Made> made(std::string id, std::vector<std::string> from,
                         std::shared_ptr<const Object> (*make)(const Sources&...)) {
    PortDefinition& port = definition_->ports.emplace_back();
    port.id = std::move(id);
    port.kind = ValueKind::made;
    port.is_computed = true;
    port.made = made_type<Object>();
    for (const std::string& source : from) port.made_from.push_back(definition_->port_index(source));
    port.make = [make, sources = port.made_from](std::span<const Value> values) {
      return made_of(make, sources, values, std::index_sequence_for<Sources...>());
    };
    std::vector<Value> defaults;
    for (const PortDefinition& other : definition_->ports) defaults.push_back(other.default_value);
    port.default_value = port.make(defaults);
    return PortBuilder<Made>(port);
  }

  /// An output that the next evaluation sees again: the own, saved state of a typification. Out and In hold the same struct of
  /// such members, `kept` and `last`. A typification with memory is evaluated again until neither its settings nor these change.
  template <class Memory, class M>
  PortBuilder<M> memory(Memory Out::*kept, Memory In::*last, M Memory::*member, std::string_view id) {
    PortBuilder<M> builder = add_port(definition_->ports, member, id);
    PortDefinition& port = definition_->ports.back();
    port.is_computed = true;
    port.get = [place = MemberPlace<M>(member).within(MemberPlace<Memory>(kept))](const void* out) {
      return Binding<M>::to_value(place.in(out));
    };
    port.recall = [place = MemberPlace<M>(member).within(MemberPlace<Memory>(last))](void* in, const Value& value) {
      place.in(in) = Binding<M>::from_value(value);
    };
    return builder;
  }

  /// Reads the nodes of the selection port `selection` into `members`, in ascending node id.
  template <class Sets, class Member>
  SetBuilder<Sets, Out, Member, NoReply> set(std::string selection, std::vector<Member> Sets::*members) {
    SetDefinition& set = add_set<Sets>(std::move(selection), members);
    replies_.emplace_back([](const Out&, const SetDefinition&, SetValues&) {});
    return SetBuilder<Sets, Out, Member, NoReply>(set);
  }
  /// The same; `replies` (one for each member, in the same order) is written back to them.
  template <class Sets, class Member, class Reply>
  SetBuilder<Sets, Out, Member, Reply> set(std::string selection, std::vector<Member> Sets::*members,
                                           std::vector<Reply> Out::*replies) {
    SetDefinition& set = add_set<Sets>(std::move(selection), members);
    replies_.emplace_back([replies](const Out& out, const SetDefinition& definition, SetValues& values) {
      write_rows(std::span(out.*replies).first(std::min((out.*replies).size(), values.members)), definition, values);
      values.writes.resize(values.members * definition.writes.size());
    });
    return SetBuilder<Sets, Out, Member, Reply>(set);
  }
  /// The same for an evaluation that is told which members have changed, and that replies to some of them.
  template <class Sets, class Member, class Reply>
  SetBuilder<Sets, Out, Member, Reply> set(std::string selection, Watched<Member> Sets::*members,
                                           SomeReplies<Reply> Out::*replies) {
    SetDefinition& set = add_set<Sets>(std::move(selection), members);
    replies_.emplace_back([replies](const Out& out, const SetDefinition& definition, SetValues& values) {
      values.answered = (out.*replies).members;
      write_rows(std::span((out.*replies).replies), definition, values);
    });
    return SetBuilder<Sets, Out, Member, Reply>(set);
  }
  /// The same for an evaluation that replies nothing: of its members, those that have changed are read again.
  template <class Sets, class Member>
  SetBuilder<Sets, Out, Member, NoReply> set(std::string selection, Watched<Member> Sets::*members) {
    SetDefinition& set = add_set<Sets>(std::move(selection), members);
    replies_.emplace_back([](const Out&, const SetDefinition&, SetValues&) {});
    return SetBuilder<Sets, Out, Member, NoReply>(set);
  }

  static TypificationDefinition build() {
    TypificationDefinition definition;
    TypificationBuilder builder(definition);
    T::declare(builder);
    builder.bind_evaluation();
    return definition;
  }

 private:
  template <class Object, class... Sources, std::size_t... kIndices>
  static Made made_of(std::shared_ptr<const Object> (*make)(const Sources&...), const std::vector<std::size_t>& sources,
                      std::span<const Value> values, std::index_sequence<kIndices...>) {
    return Made::of<Object>(
        [make, ... source = Binding<Sources>::from_value(values[sources[kIndices]])] { return make(source...); });
  }

  template <class Sets, class Member>
  SetDefinition& add_set(std::string selection, std::vector<Member> Sets::*members) {
    definition_->sets.push_back({std::move(selection), {}, {}});
    loaders_.emplace_back([members](void* sets, const SetDefinition& definition, SetValues& values) {
      auto& list = static_cast<Sets*>(sets)->*members;
      list.resize(values.members);
      for (std::size_t m = 0; m < values.members; ++m) load_row(definition, values, m, list[m]);
    });
    return definition_->sets.back();
  }
  template <class Sets, class Member>
  SetDefinition& add_set(std::string selection, Watched<Member> Sets::*members) {
    definition_->sets.push_back({std::move(selection), {}, {}});
    loaders_.emplace_back([members](void* sets, const SetDefinition& definition, SetValues& values) {
      auto& kept = values.loaded.of<std::vector<Member>>();
      const bool is_anew = values.is_anew || kept.size() != values.members;
      kept.resize(values.members);
      if (is_anew) {
        values.changed.resize(values.members);
        std::iota(values.changed.begin(), values.changed.end(), 0u);
      }
      for (const std::uint32_t m : values.changed) load_row(definition, values, m, kept[m]);
      static_cast<Sets*>(sets)->*members = {kept, values.changed, is_anew};
    });
    return definition_->sets.back();
  }

  template <class Member>
  static void load_row(const SetDefinition& definition, const SetValues& values, std::size_t m, Member& member) {
    const std::size_t count = definition.reads.size();
    for (std::size_t r = 0; r < count; ++r) {
      const Value* value = &values.reads[m * count + r];
      definition.reads[r].assign(&member, std::span(&value, 1));
    }
  }

  template <class Reply>
  static void write_rows(std::span<const Reply> replies, const SetDefinition& definition, SetValues& values) {
    const std::size_t count = definition.writes.size();
    values.writes.assign(replies.size() * count, std::nullopt);
    for (std::size_t row = 0; row < replies.size(); ++row)
      for (std::size_t w = 0; w < count; ++w)
        definition.writes[w].extract(&replies[row], std::span(&values.writes[row * count + w], 1));
  }

  void bind_evaluation() {
    using Loader = std::function<void(void*, const SetDefinition&, SetValues&)>;
    using Replier = std::function<void(const Out&, const SetDefinition&, SetValues&)>;
    constexpr bool kIsPlain = requires(const In& in, const Tick& tick) { T::evaluate(in, tick); };
    constexpr bool kHasSets = requires { typename T::Sets; };
    if constexpr (!kIsPlain && !kHasSets) return;
    else {
      const auto ports = std::make_shared<const std::vector<PortDefinition>>(definition_->ports);
      const auto sets = std::make_shared<const std::vector<SetDefinition>>(definition_->sets);
      const std::vector<Loader> loaders = loaders_;
      const std::vector<Replier> repliers = replies_;
      definition_->evaluate = [ports, sets, loaders, repliers](std::span<Value> values, std::span<SetValues> set_values,
                                                               const Tick& tick) -> Result<void> {
        In in;
        set_members(*ports, values, &in);
        Result<Out> out = [&]() -> Result<Out> {
          if constexpr (kIsPlain) {
            return T::evaluate(in, tick);
          } else {
            typename T::Sets members;
            for (std::size_t s = 0; s < loaders.size(); ++s) loaders[s](&members, (*sets)[s], set_values[s]);
            return T::evaluate(in, members, tick);
          }
        }();
        if (!out) return out.error();
        get_members(*ports, &out.value(), values);
        for (std::size_t s = 0; s < repliers.size(); ++s) repliers[s](out.value(), (*sets)[s], set_values[s]);
        return {};
      };
    }
  }

  std::vector<std::function<void(void*, const SetDefinition&, SetValues&)>> loaders_;
  std::vector<std::function<void(const Out&, const SetDefinition&, SetValues&)>> replies_;
};

}  // namespace bl
