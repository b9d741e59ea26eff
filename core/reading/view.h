// Typed views of a state: a plain struct declares the ports of its members, and is read for every node that has them.
#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/define/binding.h"
#include "core/graph/state.h"

namespace bl::reading {

/// One port of a view, or the tension on that port.
struct ViewRead : ReadDefinition {
  std::ptrdiff_t member = 0;  ///< which member of the struct it fills; compared only
  bool is_tension = false;
};

/// The declaration of a view as data. All paths are of its typification, or of `node`, which every node has.
struct ViewDefinition {
  std::string name;  ///< of the struct
  std::string type;  ///< id of a typification, or of a kind of links
  bool is_of_links = false;
  std::vector<ViewRead> reads;
};

/// Of one member pointer, comparable with those of the same struct.
template <class V, class M>
std::ptrdiff_t key_of_member(M V::*member) {
  return std::bit_cast<std::ptrdiff_t>(member);
}

/// Declares a view: V has `static void declare(ViewBuilder<V>&)` and `static const ViewDefinition& view()`; BL_VIEWS makes the
/// latter and the list of all views.
template <class V>
class ViewBuilder {
 public:
  explicit ViewBuilder(ViewDefinition& view) : view_(&view) {}

  /// The typification whose nodes are the rows.
  ViewBuilder& of(std::string_view typification) {
    view_->type = typification;
    return *this;
  }
  /// The kind of links whose parameters are shown; their paths are "kind.parameter".
  ViewBuilder& of_links(std::string_view kind) {
    view_->is_of_links = true;
    return of(kind);
  }
  /// Shows `path` ("typification.port") in `member`; `unit` is what readers expect there.
  template <class M>
  ViewBuilder& reads(M V::*member, std::string_view path, std::optional<Unit> unit = std::nullopt) {
    ViewRead& read = view_->reads.emplace_back();
    read.path = port_path(path);
    read.unit = unit;
    read.member = key_of_member(member);
    bind_read(read, member);
    return *this;
  }
  /// Shows the tension on `path`, in the unit of that port.
  ViewBuilder& reads_tension(double V::*member, std::string_view path, std::optional<Unit> unit = std::nullopt) {
    reads(member, path, unit);
    view_->reads.back().is_tension = true;
    return *this;
  }

  static ViewDefinition build(std::string name) {
    ViewDefinition view;
    view.name = std::move(name);
    ViewBuilder builder(view);
    V::declare(builder);
    return view;
  }

 private:
  ViewDefinition* view_;
};

/// A view's ports in one plan: its nodes, ascending, and for each of them one port per read.
struct ViewPorts {
  std::vector<std::uint32_t> nodes;
  std::vector<PortRef> ports;

  /// The row of a node; nodes.size() where it has no such typification.
  std::size_t row_of(std::uint32_t node) const;
};
/// Found once in each plan. A view of a port that its typification does not have is a defect, and ends the program.
std::shared_ptr<const ViewPorts> ports_of(const ViewDefinition& view, const Plan& plan);
/// Fills the members of a V from one row.
void fill_row(const ViewDefinition& view, const State& state, const ViewPorts& ports, std::size_t row, void* figures);
/// The value that people have set for one read, or its default; nullptr where the node does not have the typification, or it is
/// unknown.
const Value* setting_of(const ViewDefinition& view, std::size_t read, const Scene& scene, const NodeRecord& node,
                        const Registry& registry);
/// Fills all members in this way; false where there are none.
bool fill_settings(const ViewDefinition& view, const Scene& scene, const NodeRecord& node, const Registry& registry,
                   void* figures);
/// Fills them from a link's parameters; false where the link is of another kind.
bool fill_parameters(const ViewDefinition& view, const LinkPlan& link, void* figures);
bool fill_parameters(const ViewDefinition& view, const LinkRecord& link, const Registry& registry, void* figures);

template <class V>
struct Row {
  std::uint32_t node = 0;
  V figures;
};

/// One row for each node that carries the view's typification, in ascending node.
template <class V>
std::vector<Row<V>> rows(const State& state) {
  const auto ports = ports_of(V::view(), *state.plan);
  std::vector<Row<V>> all(ports->nodes.size());
  for (std::size_t row = 0; row < all.size(); ++row) {
    all[row].node = ports->nodes[row];
    fill_row(V::view(), state, *ports, row, &all[row].figures);
  }
  return all;
}

/// The same of one node; nothing where it does not carry the typification.
template <class V>
std::optional<V> row_of(const State& state, std::uint32_t node) {
  const auto ports = ports_of(V::view(), *state.plan);
  const std::size_t row = ports->row_of(node);
  if (row == ports->nodes.size()) return std::nullopt;
  std::optional<V> figures(std::in_place);
  fill_row(V::view(), state, *ports, row, &*figures);
  return figures;
}

/// The values of a node in a scene that has not run: set values, and the defaults of all others.
template <class V>
std::optional<V> settings_of(const Scene& scene, const Registry& registry, const NodeRecord& node) {
  std::optional<V> figures(std::in_place);
  if (!fill_settings(V::view(), scene, node, registry, &*figures)) return std::nullopt;
  return figures;
}

/// The parameters of a link, defaults filled in; nothing where it is of another kind.
template <class V>
std::optional<V> parameters_of(const LinkPlan& link) {
  std::optional<V> parameters(std::in_place);
  if (!fill_parameters(V::view(), link, &*parameters)) return std::nullopt;
  return parameters;
}

template <class V>
std::optional<V> parameters_of(const LinkRecord& link, const Registry& registry) {
  std::optional<V> parameters(std::in_place);
  if (!fill_parameters(V::view(), link, registry, &*parameters)) return std::nullopt;
  return parameters;
}

/// The id of a view's typification or kind, for commands and selections.
template <class V>
const std::string& type_of() {
  return V::view().type;
}
template <class V>
bool is_a(const State& state, std::uint32_t node) {
  const auto ports = ports_of(V::view(), *state.plan);
  return ports->row_of(node) < ports->nodes.size();
}
template <class V>
bool is_a(const NodeRecord& node) {
  return node.types.contains(type_of<V>());
}
template <class V>
bool is_a(const TypeDefinition& type) {
  return type.id == type_of<V>();
}

template <class M>
struct MemberOf;
template <class V, class M>
struct MemberOf<M V::*> {
  using View = V;
  using Type = M;
};
/// Which read of its view fills a member; the member must be declared.
std::size_t read_index(const ViewDefinition& view, std::ptrdiff_t member);

/// The port behind a member of a view, such as port_of<&VolumeFigures::demand_limit>(plan, node).
template <auto kMember>
std::optional<PortRef> port_of(const Plan& plan, std::uint32_t node) {
  const ViewDefinition& view = MemberOf<decltype(kMember)>::View::view();
  const auto ports = ports_of(view, plan);
  const std::size_t row = ports->row_of(node);
  if (row == ports->nodes.size()) return std::nullopt;
  return ports->ports[row * view.reads.size() + read_index(view, key_of_member(kMember))];
}

/// One member alone, for readers of a single figure of many nodes. Its default where there is no such row.
template <auto kMember>
auto read(const State& state, std::uint32_t node) {
  using View = typename MemberOf<decltype(kMember)>::View;
  using Type = typename MemberOf<decltype(kMember)>::Type;
  const auto port = port_of<kMember>(*state.plan, node);
  return port ? Binding<Type>::from_value(state.value(*port)) : Type(View{}.*kMember);
}

/// The same for set values; nothing where the node does not have the typification.
template <auto kMember>
auto setting(const Scene& scene, const Registry& registry, const NodeRecord& node) {
  using Type = typename MemberOf<decltype(kMember)>::Type;
  const ViewDefinition& view = MemberOf<decltype(kMember)>::View::view();
  const Value* value = setting_of(view, read_index(view, key_of_member(kMember)), scene, node, registry);
  return value == nullptr ? std::optional<Type>() : std::optional<Type>(Binding<Type>::from_value(*value));
}

/// "port" of a member, and "typification.port", for commands.
template <auto kMember>
const std::string& port_name_of() {
  const ViewDefinition& view = MemberOf<decltype(kMember)>::View::view();
  return view.reads[read_index(view, key_of_member(kMember))].path.port;
}
template <auto kMember>
std::string path_of() {
  const ViewDefinition& view = MemberOf<decltype(kMember)>::View::view();
  return view.reads[read_index(view, key_of_member(kMember))].path.typification + "." + port_name_of<kMember>();
}

using ViewList = std::vector<const ViewDefinition*>;
/// All views of the program, in the order of their files.
const ViewList& all_views();
/// Written by the build from the files of core/reading/views.
void register_views(ViewList& list);

template <class... V>
void add_views(ViewList& list) {
  (list.push_back(&V::view()), ...);
}

}  // namespace bl::reading

/// Gives a view its definition.
#define BL_VIEW(Type)                                                   \
  const ViewDefinition& Type::view() {                                  \
    static const ViewDefinition view = ViewBuilder<Type>::build(#Type); \
    return view;                                                        \
  }
/// Closes a file of core/reading/views: makes its views known under the file's stem.
#define BL_VIEWS(stem, ...) \
  void register_view_##stem(ViewList& list) { add_views<__VA_ARGS__>(list); }
