// Bookkeeping of the cell complex: every entry knows its neighbours, and they know it.
#include "core/geometry/inside/complex_store.h"

#include <algorithm>
#include <iterator>

namespace bl::geometry {

namespace {

using Index = ComplexStore::Index;

void forget(std::vector<std::uint32_t>& list, std::uint32_t entry) {
  const auto at = std::find(list.begin(), list.end(), entry);
  if (at == list.end()) return;
  *at = list.back();
  list.pop_back();
}

template <class Entry>
std::uint32_t free_place(std::vector<Entry>& table, std::vector<std::uint32_t>& free) {
  if (free.empty()) {
    table.emplace_back();
    return static_cast<std::uint32_t>(table.size() - 1);
  }
  const std::uint32_t place = free.back();
  free.pop_back();
  return place;
}

}  // namespace

bool comes_before(const Point3& a, const Point3& b) { return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z; }

std::uint32_t ComplexStore::Cell::cell_named(std::uint64_t label) const {
  const auto at = std::lower_bound(named.begin(), named.end(), std::pair(label, std::uint32_t{0}));
  return at != named.end() && at->first == label ? at->second : kNone;
}

void ComplexStore::note(ElementKind kind, const ElementName& name) {
  if (!keeps_notes) return;
  ElementKey key{kind, name};
  const auto at = notes.lower_bound(key);
  if (at != notes.end() && at->first == key) return;
  std::vector<Point3> before = geometry(key);
  notes.emplace_hint(at, std::move(key), std::move(before));
}

Index::iterator ComplexStore::enter(Index& index, std::size_t& count, const ElementName& name, std::uint32_t piece) {
  const auto entry = index.emplace(name, piece);  // behind those of the same name
  count += entry == index.begin() || std::prev(entry)->first != name;
  return entry;
}

void ComplexStore::leave(Index& index, std::size_t& count, Index::iterator entry) {
  const bool has_before = entry != index.begin() && std::prev(entry)->first == entry->first;
  const bool has_after = std::next(entry) != index.end() && std::next(entry)->first == entry->first;
  count -= !has_before && !has_after;
  index.erase(entry);
}

std::uint32_t ComplexStore::add_cell(std::uint32_t label) {
  const std::uint32_t cell = free_place(cells, free_cells_);
  cells[cell] = Cell{};
  cells[cell].is_used = true;
  cells[cell].view.own = ElementLabel::site(label);
  cell_of_label[label] = cell;
  return cell;
}

void ComplexStore::set_view(std::uint32_t index, CellView view) {
  Cell& cell = cells[index];
  for (const auto& [label, other] : cell.named) forget(cells[other].named_by, index);
  cell.named.clear();
  cell_count += !view.is_empty();
  cell_count -= !cell.view.is_empty();
  cell.view = std::move(view);
  cell.node.assign(cell.view.corners.size(), kNone);
  cell.is_odd.assign(cell.view.corners.size(), 0);
  for (const CellView::Face& face : cell.view.faces) {
    if (face.is_site()) cell.named.emplace_back(face.label, kNone);
  }
  std::sort(cell.named.begin(), cell.named.end());
  cell.named.erase(std::unique(cell.named.begin(), cell.named.end()), cell.named.end());
  for (auto& [label, other] : cell.named) {
    other = cell_of_label.at(ElementLabel{label}.number());
    cells[other].named_by.push_back(index);
  }
}

void ComplexStore::remove_cell(std::uint32_t cell) {
  CellView nothing;
  nothing.own = cells[cell].view.own;
  set_view(cell, std::move(nothing));
  cell_of_label.erase(cells[cell].view.own.number());
  cells[cell] = Cell{};
  free_cells_.push_back(cell);
}

std::uint32_t ComplexStore::add_node(Node node) {
  const std::uint32_t index = free_place(nodes, free_nodes_);
  for (const Corner& member : node.members) cells[member.cell].node[member.corner] = index;
  nodes[index] = std::move(node);
  nodes[index].is_used = true;
  nodes[index].is_vertex = false;
  nodes[index].is_new = true;
  unsettled.push_back(index);
  return index;
}

void ComplexStore::remove_node(std::uint32_t index) {
  Node& node = nodes[index];
  if (!node.is_used) return;
  while (!node.segments.empty()) remove_segment(node.segments.back());
  while (!node.polygons.empty()) remove_polygon(node.polygons.back());
  if (node.is_vertex) {
    note(ElementKind::vertex, node.name);
    leave(vertex_names, vertex_count, node.entry);
  }
  node = Node{};
  free_nodes_.push_back(index);
}

void ComplexStore::add_segment(Segment segment, const ElementName& name) {
  note(ElementKind::edge, name);
  const std::uint32_t index = free_place(segments, free_segments_);
  segment.entry = enter(edge_names, edge_count, name, index);
  segment.is_used = true;
  for (const std::uint32_t end : segment.ends) {
    nodes[end].segments.push_back(index);
    unsettled.push_back(end);
  }
  for (const std::uint32_t node : segment.over) nodes[node].segments.push_back(index);
  segments[index] = std::move(segment);
}

void ComplexStore::remove_segment(std::uint32_t index) {
  Segment& segment = segments[index];
  note(ElementKind::edge, segment.entry->first);
  for (const std::uint32_t end : segment.ends) {
    forget(nodes[end].segments, index);
    unsettled.push_back(end);
  }
  for (const std::uint32_t node : segment.over) forget(nodes[node].segments, index);
  leave(edge_names, edge_count, segment.entry);
  segment = Segment{};
  free_segments_.push_back(index);
}

void ComplexStore::add_polygon(Polygon polygon, const ElementName& name) {
  note(ElementKind::facet, name);
  const std::uint32_t index = free_place(polygons, free_polygons_);
  polygon.entry = enter(facet_names, facet_count, name, index);
  polygon.is_used = true;
  for (const std::uint32_t node : polygon.loop) nodes[node].polygons.push_back(index);
  for (const std::uint32_t node : polygon.over) nodes[node].polygons.push_back(index);
  for (const std::uint32_t cell : polygon.cells) {
    if (cell != kNone) cells[cell].polygons.push_back(index);
  }
  polygons[index] = std::move(polygon);
}

void ComplexStore::remove_polygon(std::uint32_t index) {
  Polygon& polygon = polygons[index];
  note(ElementKind::facet, polygon.entry->first);
  for (const std::uint32_t node : polygon.loop) forget(nodes[node].polygons, index);
  for (const std::uint32_t node : polygon.over) forget(nodes[node].polygons, index);
  for (const std::uint32_t cell : polygon.cells) {
    if (cell != kNone) forget(cells[cell].polygons, index);
  }
  leave(facet_names, facet_count, polygon.entry);
  polygon = Polygon{};
  free_polygons_.push_back(index);
}

std::vector<std::uint32_t> ComplexStore::nodes_across(std::uint32_t index) const {
  std::vector<std::uint32_t> across;
  const auto has = [&](const std::vector<std::uint32_t>& list) {
    return std::find(list.begin(), list.end(), index) != list.end();
  };
  for (const std::uint32_t segment : nodes[index].segments) {
    const auto& ends = segments[segment].ends;
    if (has(segments[segment].over)) across.insert(across.end(), ends.begin(), ends.end());
  }
  for (const std::uint32_t polygon : nodes[index].polygons) {
    const auto& loop = polygons[polygon].loop;
    if (has(polygons[polygon].over)) across.insert(across.end(), loop.begin(), loop.end());
  }
  return across;
}

// Where fewer than three edges meet, an edge only passes, into the next piece of the domain.
void ComplexStore::settle_vertex(std::uint32_t index) {
  Node& node = nodes[index];
  if (!node.is_used) return;
  std::vector<const ElementName*> edges;
  for (const std::uint32_t segment : node.segments) {
    if (node.is_passage) break;
    const ElementName& name = segments[segment].entry->first;
    if (std::none_of(edges.begin(), edges.end(), [&](const ElementName* known) { return *known == name; }))
      edges.push_back(&name);
  }
  const bool is_vertex = edges.size() >= 3;
  if (is_vertex == node.is_vertex) return;
  note(ElementKind::vertex, node.name);
  node.is_vertex = is_vertex;
  if (is_vertex) {
    node.entry = enter(vertex_names, vertex_count, node.name, index);
  } else {
    leave(vertex_names, vertex_count, node.entry);
  }
}

std::uint32_t ComplexStore::segment_between(std::uint32_t a, std::uint32_t b) const {
  for (const std::uint32_t segment : nodes[a].segments) {
    const auto& ends = segments[segment].ends;
    if ((ends[0] == a && ends[1] == b) || (ends[0] == b && ends[1] == a)) return segment;
  }
  return kNone;
}

const Index& ComplexStore::names(ElementKind kind) const {
  return kind == ElementKind::vertex ? vertex_names : kind == ElementKind::edge ? edge_names : facet_names;
}

std::vector<std::uint32_t> ComplexStore::pieces(ElementKind kind, const ElementName& name) const {
  std::vector<std::uint32_t> found;
  const auto [begin, end] = names(kind).equal_range(name);
  for (auto at = begin; at != end; ++at) found.push_back(at->second);
  return found;
}

// The numbers of one node, segment or polygon.
std::vector<Point3> ComplexStore::geometry_of_piece(ElementKind kind, std::uint32_t piece) const {
  if (kind == ElementKind::vertex) return {nodes[piece].position};
  std::vector<Point3> part;
  if (kind == ElementKind::edge) {
    part = {nodes[segments[piece].ends[0]].position, nodes[segments[piece].ends[1]].position};
    if (comes_before(part[1], part[0])) std::swap(part[0], part[1]);
  } else {
    part.reserve(polygons[piece].loop.size());
    for (const std::uint32_t node : polygons[piece].loop) part.push_back(nodes[node].position);
  }
  return part;
}

std::vector<Point3> ComplexStore::geometry(const ElementKey& element) const {
  if (element.kind == ElementKind::cell) return {};
  const auto [begin, end] = names(element.kind).equal_range(element.name);
  if (begin == end) return {};
  if (std::next(begin) == end) return geometry_of_piece(element.kind, begin->second);
  std::vector<std::vector<Point3>> parts;
  for (auto at = begin; at != end; ++at) parts.push_back(geometry_of_piece(element.kind, at->second));
  std::sort(parts.begin(), parts.end(), [](const auto& a, const auto& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), comes_before);
  });
  std::vector<Point3> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace bl::geometry
