// Converts struct members of C++ types to port values and back: the only place that maps types to kinds.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "core/define/definition.h"

namespace bl {

/// A new Owner: its members have the values of their initialisers. Hidden, so that a plugin's struct is not taken for one of the
/// same name in the program or in another plugin.
template <class Owner>
[[gnu::visibility("hidden")]] const Owner& fresh() {
  static const Owner kFresh{};
  return kFresh;
}

/// Where a member of type M stands in its struct. What binds a member holds this instead of a pointer to the member: it is then
/// compiled once for each type of member, not again for each struct.
template <class M>
class MemberPlace {
 public:
  template <class Owner>
  MemberPlace(M Owner::*member)
      : offset_(reinterpret_cast<const std::byte*>(&(fresh<Owner>().*member)) -
                reinterpret_cast<const std::byte*>(&fresh<Owner>())) {}

  /// The place in a struct that holds this one's at `outer`.
  template <class Outer>
  MemberPlace within(const MemberPlace<Outer>& outer) const {
    MemberPlace place = *this;
    place.offset_ += outer.offset();
    return place;
  }
  std::ptrdiff_t offset() const { return offset_; }

  M& in(void* owner) const { return *reinterpret_cast<M*>(static_cast<std::byte*>(owner) + offset_); }
  const M& in(const void* owner) const { return *reinterpret_cast<const M*>(static_cast<const std::byte*>(owner) + offset_); }

 private:
  std::ptrdiff_t offset_;
};

/// The id of a port that people choose, as a separate member type.
struct PortChoice {
  std::string path;
  bool operator==(const PortChoice&) const = default;
};

/// The values of all nodes of an end (or of all replies) in ascending node id; a plain T is the value of one node.
template <class T>
struct All {
  std::vector<T> values;
};

template <class T>
struct Binding;

/// For members whose type is an alternative of Value.
template <class T, ValueKind kKindOfT>
struct DirectBinding {
  static constexpr ValueKind kKind = kKindOfT;
  static Value to_value(const T& member) { return member; }
  static T from_value(const Value& value) {
    const T* content = std::get_if<T>(&value);
    return content ? *content : T{};
  }
};

/// For members that values hold behind a Shared.
template <class T, ValueKind kKindOfT>
struct SharedBinding {
  static constexpr ValueKind kKind = kKindOfT;
  static Value to_value(const T& member) { return Shared<T>(member); }
  static T from_value(const Value& value) {
    const Shared<T>* content = std::get_if<Shared<T>>(&value);
    return content ? **content : T{};
  }
};

template <>
struct Binding<bool> : DirectBinding<bool, ValueKind::boolean> {};
template <>
struct Binding<std::string> : DirectBinding<std::string, ValueKind::text> {};
template <>
struct Binding<Vector3> : DirectBinding<Vector3, ValueKind::point> {};
template <>
struct Binding<JsonValue> : DirectBinding<JsonValue, ValueKind::json> {};
template <>
struct Binding<CommandList> : DirectBinding<CommandList, ValueKind::commands> {};
template <>
struct Binding<MeshPointer> : DirectBinding<MeshPointer, ValueKind::mesh> {};
template <>
struct Binding<std::vector<Point3>> : SharedBinding<std::vector<Point3>, ValueKind::points> {};
template <>
struct Binding<std::vector<std::string>> : SharedBinding<std::vector<std::string>, ValueKind::texts> {};
template <>
struct Binding<Selection> : SharedBinding<Selection, ValueKind::selection> {};
template <>
struct Binding<Table> : SharedBinding<Table, ValueKind::table> {};
template <>
struct Binding<Shared<Table>> : DirectBinding<Shared<Table>, ValueKind::table> {};

template <>
struct Binding<Numbers> : DirectBinding<Numbers, ValueKind::numbers> {};

/// Made objects; nullptr where there is none. Meshes are a separate kind.
template <class T>
struct Binding<std::shared_ptr<const T>> {
  static constexpr ValueKind kKind = ValueKind::made;
  static std::shared_ptr<const T> from_value(const Value& value) {
    const Made* made = std::get_if<Made>(&value);
    return made ? made->get<T>() : nullptr;
  }
};

/// Whole numbers and truth values read as numbers, so that links may read any numeric port into a double.
template <>
struct Binding<double> {
  static constexpr ValueKind kKind = ValueKind::number;
  static Value to_value(double member) { return member; }
  static double from_value(const Value& value) { return as_number(value); }
};

template <std::signed_integral T>
struct Binding<T> {
  static constexpr ValueKind kKind = ValueKind::integer;
  static Value to_value(T member) { return static_cast<std::int64_t>(member); }
  static T from_value(const Value& value) { return static_cast<T>(as_number(value)); }
};

template <>
struct Binding<PortChoice> {
  static constexpr ValueKind kKind = ValueKind::port;
  static Value to_value(const PortChoice& member) { return member.path; }
  static PortChoice from_value(const Value& value) { return {Binding<std::string>::from_value(value)}; }
};

/// Enumerations are stored as the text of the choice; the builder supplies the texts.
template <class T>
concept ChoiceMember = std::is_enum_v<T>;

template <class T>
concept NumericMember = std::same_as<T, double> ||(std::signed_integral<T> && !std::same_as<T, bool>);

template <class T>
struct is_optional_type : std::false_type {};
template <class T>
struct is_optional_type<std::optional<T>> : std::true_type {};

/// Members that a value holds as they are.
template <class T>
concept HeldAsItIs = std::same_as<T, double> || std::derived_from<Binding<T>, DirectBinding<T, Binding<T>::kKind>>;

/// Of a member that may stay without a value: the evaluation then proposes or replies nothing.
template <class T>
void offer(const T& member, std::optional<Value>& value) {
  if constexpr (is_optional_type<T>::value) {
    if (member) offer(*member, value);
    else value.reset();
  } else if constexpr (HeldAsItIs<T>) {
    value.emplace(std::in_place_type<T>, member);
  } else {
    value = Binding<T>::to_value(member);
  }
}

/// The required type of a member's made object; none for members of other kinds.
template <class M>
struct made_type_of {
  static MadeType get() { return {}; }
};
template <class T>
struct made_type_of<std::shared_ptr<const T>> {
  static MadeType get() { return made_type<T>(); }
};
template <>
struct made_type_of<MeshPointer> {
  static MadeType get() { return {}; }
};

template <class T>
struct offered_type {
  using type = T;
};
template <class T>
struct offered_type<std::optional<T>> {
  using type = T;
};

/// A read of one node's value into a member.
template <class M>
void bind_place(ReadDefinition& read, MemberPlace<M> member) {
  read.kind = Binding<M>::kKind;
  read.made = made_type_of<M>::get();
  read.assign = [member](void* owner, std::span<const Value* const> values) {
    member.in(owner) = Binding<M>::from_value(*values.front());
  };
}
/// A read of a port that nodes may lack: nothing where there is none.
template <class M>
std::optional<M> read_if_there(const Value* value) {
  return value == nullptr ? std::nullopt : std::optional<M>(Binding<M>::from_value(*value));
}
template <class M>
void bind_place(ReadDefinition& read, MemberPlace<std::optional<M>> member) {
  read.kind = Binding<M>::kKind;
  read.made = made_type_of<M>::get();
  read.assign = [member](void* owner, std::span<const Value* const> values) {
    member.in(owner) = read_if_there<M>(values.front());
  };
}
/// A read of a whole end's values.
template <class M>
void bind_place(ReadDefinition& read, MemberPlace<All<std::optional<M>>> member) {
  read.kind = Binding<M>::kKind;
  read.made = made_type_of<M>::get();
  read.is_whole = true;
  read.assign = [member](void* owner, std::span<const Value* const> values) {
    auto& all = member.in(owner).values;
    all.clear();
    for (const Value* value : values) all.push_back(read_if_there<M>(value));
  };
  read.assign_some = [member](void* owner, std::span<const Value* const> values, std::span<const std::uint32_t> places) {
    auto& all = member.in(owner).values;
    for (const std::uint32_t place : places) all[place] = read_if_there<M>(values[place]);
  };
}
template <class M>
void bind_place(ReadDefinition& read, MemberPlace<All<M>> member) {
  read.kind = Binding<M>::kKind;
  read.made = made_type_of<M>::get();
  read.is_whole = true;
  read.assign = [member](void* owner, std::span<const Value* const> values) {
    auto& all = member.in(owner).values;
    all.clear();
    for (const Value* value : values) all.push_back(Binding<M>::from_value(*value));
  };
  read.assign_some = [member](void* owner, std::span<const Value* const> values, std::span<const std::uint32_t> places) {
    auto& all = member.in(owner).values;
    for (const std::uint32_t place : places) all[place] = Binding<M>::from_value(*values[place]);
  };
}
/// Members that may stay without a value, or an All of such.
template <class M>
inline constexpr bool kIsOptional = is_optional_type<M>::value;
template <class M>
inline constexpr bool kIsOptional<All<M>> = is_optional_type<M>::value;
template <class M>
concept OptionalMember = kIsOptional<M>;

/// A read of what each node must have.
template <class Owner, class M>
requires(!OptionalMember<M>) void bind_read(ReadDefinition& read, M Owner::*member) { bind_place(read, MemberPlace<M>(member)); }

/// A write of one node's value from a member, or of a whole end's from an All (missing entries propose nothing).
template <class M>
void bind_place(WriteDefinition& write, MemberPlace<M> member) {
  write.kind = Binding<typename offered_type<M>::type>::kKind;
  write.extract = [member](const void* owner, std::span<std::optional<Value>> values) {
    offer(member.in(owner), values.front());
  };
}
template <class M>
void bind_place(WriteDefinition& write, MemberPlace<All<M>> member) {
  write.kind = Binding<typename offered_type<M>::type>::kKind;
  write.is_whole = true;
  write.extract = [member](const void* owner, std::span<std::optional<Value>> values) {
    const auto& all = member.in(owner).values;
    for (std::size_t i = 0; i < values.size() && i < all.size(); ++i) offer(all[i], values[i]);
  };
}
template <class Owner, class M>
void bind_write(WriteDefinition& write, M Owner::*member) {
  bind_place(write, MemberPlace<M>(member));
}

}  // namespace bl
