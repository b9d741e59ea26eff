// What can be asked of the cell complex: who borders on whom, and how large.
#include <algorithm>
#include <charconv>
#include <iterator>

#include "core/geometry/inside/none.h"

#include "core/geometry/inside/complex_body.h"

namespace bl::geometry {

namespace {

using Names = std::vector<ElementName>;

void put_in_order(Names& names) {
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
}

bool has_neighbours(const ComplexStore::Polygon& polygon, std::uint32_t a, std::uint32_t b) {
  for (std::size_t i = 0; i < polygon.loop.size(); ++i) {
    const std::uint32_t from = polygon.loop[i], to = polygon.loop[i + 1 == polygon.loop.size() ? 0 : i + 1];
    if ((from == a && to == b) || (from == b && to == a)) return true;
  }
  return false;
}

// The elements in the boundaries of polygons.
void below_polygons(const ComplexStore& store, std::span<const std::uint32_t> polygons, ElementKind wanted, Names& out) {
  for (const std::uint32_t index : polygons) {
    const auto& loop = store.polygons[index].loop;
    if (wanted == ElementKind::facet) out.push_back(store.polygons[index].entry->first);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const auto& node = store.nodes[loop[i]];
      if (wanted == ElementKind::vertex && node.is_vertex) out.push_back(node.name);
      if (wanted != ElementKind::edge) continue;
      const std::uint32_t segment = store.segment_between(loop[i], loop[i + 1 == loop.size() ? 0 : i + 1]);
      if (segment != kNone) out.push_back(store.segments[segment].entry->first);
    }
  }
}

void cells_of(const ElementName& name, Names& out) {
  for (const std::uint32_t site : name.sites()) out.push_back({ElementLabel::site(site)});
}

void around_edge(const ComplexStore& store, const ElementName& name, ElementKind wanted, Names& out) {
  for (const std::uint32_t index : store.pieces(ElementKind::edge, name)) {
    const auto [a, b] = store.segments[index].ends;
    for (const std::uint32_t end : {a, b}) {
      if (wanted == ElementKind::vertex && store.nodes[end].is_vertex) out.push_back(store.nodes[end].name);
    }
    if (wanted != ElementKind::facet) continue;
    for (const std::uint32_t polygon : store.nodes[a].polygons) {
      if (has_neighbours(store.polygons[polygon], a, b)) out.push_back(store.polygons[polygon].entry->first);
    }
  }
}

void around_vertex(const ComplexStore& store, const ElementName& name, ElementKind wanted, Names& out) {
  for (const std::uint32_t index : store.pieces(ElementKind::vertex, name)) {
    const auto& node = store.nodes[index];
    if (wanted == ElementKind::edge) {
      for (const std::uint32_t segment : node.segments) out.push_back(store.segments[segment].entry->first);
    }
    if (wanted == ElementKind::facet) {
      for (const std::uint32_t index_of_polygon : node.polygons) {
        const auto& polygon = store.polygons[index_of_polygon];
        if (std::count(polygon.loop.begin(), polygon.loop.end(), index) > 0) out.push_back(polygon.entry->first);
      }
    }
  }
}

const ComplexStore::Cell* find_cell(const ComplexStore& store, const ElementName& name) {
  if (name.size() != 1 || name[0].is_side()) return nullptr;
  const auto at = store.cell_of_label.find(name[0].number());
  return at == store.cell_of_label.end() || store.cells[at->second].view.is_empty() ? nullptr : &store.cells[at->second];
}

void write_number(double value, std::string& out) {
  char digits[32];
  const auto end = std::to_chars(std::begin(digits), std::end(digits), value).ptr;
  out.append(digits, end).push_back(' ');
}

}  // namespace

std::size_t CellComplex::count(ElementKind kind) const {
  switch (kind) {
    case ElementKind::cell: return body_->store.cell_count;
    case ElementKind::facet: return body_->store.facet_count;
    case ElementKind::edge: return body_->store.edge_count;
    case ElementKind::vertex: break;
  }
  return body_->store.vertex_count;
}

bool CellComplex::has(const ElementKey& element) const {
  if (element.kind == ElementKind::cell) return find_cell(body_->store, element.name) != nullptr;
  return body_->store.names(element.kind).contains(element.name);
}

std::vector<ElementName> CellComplex::names(ElementKind kind) const {
  Names found;
  if (kind == ElementKind::cell) {
    for (const auto& [label, cell] : body_->store.cell_of_label) {
      if (!body_->store.cells[cell].view.is_empty()) found.push_back({ElementLabel::site(label)});
    }
    return found;
  }
  for (const auto& [name, piece] : body_->store.names(kind)) {
    if (found.empty() || found.back() != name) found.push_back(name);
  }
  return found;
}

std::vector<ElementName> CellComplex::incident(const ElementKey& element, ElementKind wanted) const {
  const ComplexStore& store = body_->store;
  Names found;
  if (element.kind == wanted || !has(element)) return found;
  if (element.kind == ElementKind::cell) {
    below_polygons(store, find_cell(store, element.name)->polygons, wanted, found);
  } else if (wanted == ElementKind::cell) {
    cells_of(element.name, found);
  } else if (element.kind == ElementKind::facet) {
    below_polygons(store, store.pieces(ElementKind::facet, element.name), wanted, found);
  } else if (element.kind == ElementKind::edge) {
    around_edge(store, element.name, wanted, found);
  } else {
    around_vertex(store, element.name, wanted, found);
  }
  put_in_order(found);
  return found;
}

std::optional<Point3> CellComplex::position(const ElementName& vertex) const {
  const auto at = body_->store.vertex_names.find(vertex);
  if (at == body_->store.vertex_names.end()) return std::nullopt;
  return body_->store.nodes[at->second].position;
}

double CellComplex::length(const ElementName& edge) const {
  const std::vector<Point3> ends = body_->store.geometry({ElementKind::edge, edge});
  double sum = 0;
  for (std::size_t i = 1; i < ends.size(); i += 2) sum += distance(ends[i - 1], ends[i]);
  return sum;
}

double CellComplex::area(const ElementName& facet) const {
  std::vector<double> areas;
  for (const std::uint32_t polygon : body_->store.pieces(ElementKind::facet, facet)) {
    areas.push_back(body_->store.polygons[polygon].area);
  }
  std::sort(areas.begin(), areas.end());  // the sum must not show in which order they came
  double sum = 0;
  for (const double area : areas) sum += area;
  return sum;
}

std::vector<std::vector<Point3>> CellComplex::polygons(const ElementName& facet) const {
  std::vector<std::vector<Point3>> found;
  for (const std::uint32_t polygon : body_->store.pieces(ElementKind::facet, facet)) {
    found.emplace_back();
    for (const std::uint32_t node : body_->store.polygons[polygon].loop)
      found.back().push_back(body_->store.nodes[node].position);
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), comes_before);
  });
  return found;
}

int CellComplex::euler(std::uint32_t cell) const {
  const ElementKey key{ElementKind::cell, {ElementLabel::site(cell)}};
  const auto number = [&](ElementKind kind) { return static_cast<int>(incident(key, kind).size()); };
  return number(ElementKind::vertex) - number(ElementKind::edge) + number(ElementKind::facet);
}

std::string CellComplex::listing() const {
  std::string text;
  for (const ElementKind kind : {ElementKind::cell, ElementKind::facet, ElementKind::edge, ElementKind::vertex}) {
    for (const ElementName& name : names(kind)) {
      text += name_of(kind);
      text += " " + name.text() + " ";
      if (kind == ElementKind::facet) write_number(area(name), text);
      if (kind != ElementKind::cell) {
        for (const Point3& p : body_->store.geometry({kind, name})) {
          for (const double value : {p.x, p.y, p.z}) write_number(value, text);
        }
      }
      text.back() = '\n';
    }
  }
  return text;
}

}  // namespace bl::geometry
