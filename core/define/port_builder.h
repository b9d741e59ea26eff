// The fluent declaration of one port: the member's type decides which modifiers exist.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/define/binding.h"

namespace bl {

/// One choice of an enumeration port: the value in code, the text in files, and what it does. The texts outlive the declaration,
/// as literals do.
template <class E>
struct Choice {
  E value;
  std::string_view id, doc;
};

/// Declares a port bound to a member of type M. Defaults come from the struct's member initialisers.
template <class M>
class PortBuilder {
 public:
  explicit PortBuilder(PortDefinition& port) : port_(&port) {}

  PortBuilder& doc(std::string_view text) {
    assign_text(port_->doc, text);
    return *this;
  }
  /// The port gets the scene's setting of the same id, kind and unit. Where a set value replaces the setting, the check of a
  /// scene reports values that differ from it by more than `tolerance`.
  PortBuilder& of_scene(OfScene when, double tolerance = 0) {
    port_->of_scene = when;
    port_->setting_tolerance = tolerance;
    port_->keeps_default = when == OfScene::unless_set;
    return *this;
  }
  /// A set value that equals the default is kept, since it differs from an unset one.
  PortBuilder& keeps_default() {
    port_->keeps_default = true;
    return *this;
  }
  PortBuilder& required() {
    port_->is_required = true;
    return *this;
  }

  PortBuilder& unit(Unit unit) requires NumericMember<M> || std::same_as<M, Vector3> || std::same_as<M, std::vector<Point3>> {
    port_->unit = unit;
    return *this;
  }
  /// The unit is named by another port of the same declaration: a unit symbol in a text, or a port whose unit it is.
  PortBuilder& unit_from(std::string_view port) requires std::same_as<M, double> {
    assign_text(port_->unit_from, port);
    return *this;
  }
  PortBuilder& min(double hard) requires NumericMember<M> {
    port_->hard_minimum = hard;
    return *this;
  }
  PortBuilder& max(double hard) requires NumericMember<M> {
    port_->hard_maximum = hard;
    return *this;
  }
  PortBuilder& range(double low, double high) requires NumericMember<M> { return min(low).max(high); }
  /// The range of a slider; people may type values outside it, up to the hard range.
  PortBuilder& soft(double low, double high) requires NumericMember<M> {
    port_->soft_minimum = low;
    port_->soft_maximum = high;
    return *this;
  }
  /// Links may propose to this port; `rule` says how proposals combine.
  PortBuilder& combine(CombineRule rule) requires std::same_as<M, double> || std::same_as<M, Vector3> {
    port_->rule = rule;
    return *this;
  }
  /// Links may propose texts: the value is what people set and all that links propose, sorted, each once.
  PortBuilder& collect() requires std::same_as<M, std::vector<std::string>> {
    port_->rule = CombineRule::collect;
    return *this;
  }
  PortBuilder& step_limit(double limit) requires std::same_as<M, double> || std::same_as<M, Vector3> {
    port_->step_limit = limit;
    return *this;
  }
  PortBuilder& residual() requires std::same_as<M, double> {
    port_->is_residual = true;
    return *this;
  }
  /// How a solver gets to its result; runs are not compared by it.
  PortBuilder& means() {
    port_->is_means = true;
    return *this;
  }
  /// Its value makes the program that runs the scene open a file or a connection, so that it is not for everybody to set.
  PortBuilder& reaches_out() {
    port_->reaches_out = true;
    return *this;
  }
  /// Shown where there is room for few ports only, in the order of the declaration.
  PortBuilder& shown_first() {
    port_->is_shown_first = true;
    return *this;
  }
  /// The one port of its type that is plotted over time.
  PortBuilder& traced() requires NumericMember<M> {
    port_->is_traced = true;
    return *this;
  }
  PortBuilder& column(ColumnDefinition column) requires std::same_as<M, Table> || std::same_as<M, Shared<Table>> {
    port_->columns.push_back(std::move(column));
    return *this;
  }

 private:
  PortDefinition* port_;
};

template <class M>
PortBuilder<M> add_port(std::vector<PortDefinition>& ports, MemberPlace<M> member, const M& default_value, std::string_view id) {
  PortDefinition& port = new_port(ports, id);
  port.kind = Binding<M>::kKind;
  port.default_value = Binding<M>::to_value(default_value);
  port.get = [member](const void* owner) { return Binding<M>::to_value(member.in(owner)); };
  port.set = [member](void* owner, const Value& value) { member.in(owner) = Binding<M>::from_value(value); };
  return PortBuilder<M>(port);
}

/// Binds `member` of Owner as a new port; its default is the value in a new Owner.
template <class Owner, class M>
PortBuilder<M> add_port(std::vector<PortDefinition>& ports, M Owner::*member, std::string_view id) {
  return add_port<M>(ports, member, fresh<Owner>().*member, id);
}

/// Binds an enumeration: files and values hold the text of the choice, the struct holds the enumerator.
template <class Owner, ChoiceMember E>
PortBuilder<E> add_choice(std::vector<PortDefinition>& ports, E Owner::*member, std::string_view id,
                          std::span<const Choice<E>> choices) {
  PortDefinition& port = new_port(ports, id);
  port.kind = ValueKind::choice;
  std::vector<E> enumerators;
  std::vector<std::string> ids;
  for (const Choice<E>& choice : choices) {
    port.choices.push_back({std::string(choice.id), std::string(choice.doc)});
    enumerators.push_back(choice.value);
    ids.emplace_back(choice.id);
  }
  const MemberPlace<E> place = member;
  port.get = [place, enumerators, ids](const void* owner) -> Value {
    const auto found = std::find(enumerators.begin(), enumerators.end(), place.in(owner));
    return ids[found == enumerators.end() ? 0 : static_cast<std::size_t>(found - enumerators.begin())];
  };
  port.set = [place, enumerators, ids](void* owner, const Value& value) {
    const auto found = std::find(ids.begin(), ids.end(), Binding<std::string>::from_value(value));
    if (found != ids.end()) place.in(owner) = enumerators[static_cast<std::size_t>(found - ids.begin())];
  };
  port.default_value = port.get(&fresh<Owner>());
  return PortBuilder<E>(port);
}

/// Declarations that typifications, link kinds and commands share.
template <class Definition>
class TypeBuilder {
 public:
  explicit TypeBuilder(Definition& definition) : definition_(&definition) {}

  /// The id in files. Never changes once released: a renamed type keeps its old ids as aliases.
  TypeBuilder& id(std::string_view text) {
    assign_text(definition_->id, text);
    return *this;
  }
  TypeBuilder& label(std::string_view text) {
    assign_text(definition_->label, text);
    return *this;
  }
  TypeBuilder& doc(std::string_view text) {
    assign_text(definition_->doc, text);
    return *this;
  }
  TypeBuilder& alias(std::string_view old_id) {
    definition_->aliases.emplace_back(old_id);
    return *this;
  }
  /// Its result follows from the number of the tick as well. Only such a type is given that number, and is evaluated in every
  /// tick; others are evaluated when something that they read has changed.
  TypeBuilder& reads_time() {
    definition_->reads_time = true;
    return *this;
  }
  /// Raises the revision by one; `upgrade` turns the JSON object of the revision before into the new one.
  TypeBuilder& upgrade(std::string what, std::function<Result<std::string>(const std::string&)> change) {
    definition_->upgrades.push_back({definition_->revision++, std::move(what), std::move(change)});
    return *this;
  }

 protected:
  Definition* definition_;
};

}  // namespace bl
