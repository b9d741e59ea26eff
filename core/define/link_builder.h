// Declares a link kind: parameters, what it reads at its ends, what it proposes, and one pure evaluate().
#pragma once

#include <algorithm>
#include <cassert>
#include <string>
#include <string_view>
#include <utility>

#include "core/define/port_builder.h"

namespace bl {

/// T has `struct In` (parameters), `struct Ends` (read from the frozen state), `struct Out` (proposals),
/// `declare(LinkBuilder<T>&)` and `static Result<Out> evaluate(const In&, const Ends&, const Tick&)`.
/// A member of type All<X> makes its end whole: one evaluation for all of its nodes. Optional members propose only when set.
template <class T>
class LinkBuilder : public TypeBuilder<LinkDefinition> {
 public:
  using TypeBuilder::TypeBuilder;
  using In = typename T::In;
  using Ends = typename T::Ends;
  using Out = typename T::Out;

  /// A hint for drawings, with no other effect.
  LinkBuilder& family(LinkFamily family) {
    definition_->family = family;
    return *this;
  }

  template <class M>
  PortBuilder<M> param(M In::*member, std::string_view id) {
    return add_port(definition_->ports, member, id);
  }
  template <ChoiceMember E>
  PortBuilder<E> param(E In::*member, std::string_view id, std::vector<Choice<E>> choices) {
    return add_choice(definition_->ports, member, id, std::span<const Choice<E>>(choices));
  }

  /// Reads `path` ("typification.port", or "node.id") of the end into `member`; `unit` is what the code expects there.
  template <class M>
  LinkBuilder& reads(M Ends::*member, End end, std::string_view path, std::optional<Unit> unit = std::nullopt) {
    LinkRead& read = definition_->reads.emplace_back();
    read.end = end;
    read.path = port_path(path);
    read.unit = unit;
    bind_read(read, member);
    return *this;
  }
  /// Reads `path` where a node has it: `member` is a std::optional<X>, or an All of them. A node without it fits the end too.
  template <OptionalMember M>
  LinkBuilder& reads_if_there(M Ends::*member, End end, std::string_view path, std::optional<Unit> unit = std::nullopt) {
    LinkRead& read = definition_->reads.emplace_back();
    read.end = end;
    read.path = port_path(path);
    read.unit = unit;
    read.is_optional = true;
    bind_place(read, MemberPlace<M>(member));
    return *this;
  }
  /// Reads the port that is chosen in `parameter`.
  template <class M>
  LinkBuilder& reads_chosen(M Ends::*member, End end, std::string parameter) {
    LinkRead& read = definition_->reads.emplace_back();
    read.end = end;
    read.path.chosen_by = std::move(parameter);
    bind_read(read, member);
    return *this;
  }
  /// Reads whether people have locked a setting, so that no link can move it.
  template <class M>
  LinkBuilder& reads_lock(M Ends::*member, End end, std::string_view path) {
    reads(member, end, path);
    definition_->reads.back().is_lock = true;
    return *this;
  }
  template <OptionalMember M>
  LinkBuilder& reads_lock_if_there(M Ends::*member, End end, std::string_view path) {
    reads_if_there(member, end, path);
    definition_->reads.back().is_lock = true;
    return *this;
  }
  template <class M>
  LinkBuilder& proposes(M Out::*member, End end, std::string_view path, std::optional<Unit> unit = std::nullopt) {
    LinkWrite& write = definition_->proposes.emplace_back();
    write.end = end;
    write.path = port_path(path);
    write.unit = unit;
    bind_write(write, member);
    return *this;
  }
  /// Proposes to `path` where a node has it. A node without it fits the end too, and what is proposed there is left out.
  template <class M>
  LinkBuilder& proposes_if_there(M Out::*member, End end, std::string_view path, std::optional<Unit> unit = std::nullopt) {
    proposes(member, end, path, unit);
    definition_->proposes.back().is_optional = true;
    return *this;
  }
  template <class M>
  LinkBuilder& proposes_chosen(M Out::*member, End end, std::string parameter) {
    LinkWrite& write = definition_->proposes.emplace_back();
    write.end = end;
    write.path.chosen_by = std::move(parameter);
    bind_write(write, member);
    return *this;
  }
  /// The ports chosen in two parameters must have units of one dimension, unless the boolean parameter `unless` is on.
  LinkBuilder& same_units(std::string parameter, std::string other, std::string unless = "") {
    definition_->same_units.emplace_back(std::move(parameter), std::move(other));
    definition_->same_units_unless = std::move(unless);
    return *this;
  }

  /// Two nodes whose positions are so far from each other have nothing to say: evaluate() returns proposals without a value, and
  /// neither fails nor remarks anything. The kind reads `node.position` at both ends, before it declares this, and no computed
  /// port, no whole end.
  LinkBuilder& silent_at(SilentBand (*band)(const In&)) {
    for (const End end : {End::from, End::to}) {
      const auto is_place = [end](const LinkRead& read) {
        return read.end == end && read.path.typification == "node" && read.path.port == "position";
      };
      const auto read = std::find_if(definition_->reads.begin(), definition_->reads.end(), is_place);
      assert(read != definition_->reads.end());
      if (read == definition_->reads.end()) return *this;
      definition_->silent_reads[static_cast<std::size_t>(end)] = static_cast<std::size_t>(read - definition_->reads.begin());
    }
    definition_->silent_band = [band](const void* parameters) { return band(*static_cast<const In*>(parameters)); };
    return *this;
  }

  static LinkDefinition build() {
    LinkDefinition definition;
    LinkBuilder builder(definition);
    T::declare(builder);
    builder.bind_evaluation();
    return definition;
  }

 private:
  static void load(const std::vector<LinkRead>& reads, const LinkReads& in, Ends& ends) {
    // Until all is loaded: what throws on the way leaves a gap.
    const bool is_kept = in.loaded != nullptr && std::exchange(in.loaded->is_complete, false);
    for (std::size_t r = 0; r < reads.size(); ++r) {
      if (is_kept && reads[r].is_whole)
        reads[r].assign_some(&ends, in.values[r], in.loaded->changed[static_cast<std::size_t>(reads[r].end)]);
      else reads[r].assign(&ends, in.values[r]);
    }
    if (in.loaded == nullptr) return;
    for (auto& places : in.loaded->changed) places.clear();
    in.loaded->is_complete = true;
  }

  void bind_evaluation() {
    const auto ports = std::make_shared<const std::vector<PortDefinition>>(definition_->ports);
    const auto reads = std::make_shared<const std::vector<LinkRead>>(definition_->reads);
    const auto proposes = std::make_shared<const std::vector<LinkWrite>>(definition_->proposes);
    definition_->instantiate = [ports](std::span<const Value> values) -> std::shared_ptr<const void> {
      auto in = std::make_shared<In>();
      set_members(*ports, values, in.get());
      return in;
    };
    definition_->evaluate = [reads, proposes](const void* parameters, const LinkReads& in, LinkWrites& out,
                                              const Tick& tick) -> Result<void> {
      Ends own;
      Ends& ends = in.loaded != nullptr ? in.loaded->memo.template of<Ends>() : own;
      load(*reads, in, ends);
      Result<Out> result = T::evaluate(*static_cast<const In*>(parameters), ends, tick);
      if (!result) return result.error();
      for (std::size_t w = 0; w < proposes->size(); ++w) (*proposes)[w].extract(&result.value(), out.values[w]);
      return {};
    };
  }
};

}  // namespace bl
