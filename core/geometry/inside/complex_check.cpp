// Recounting the cell complex: nothing that it keeps is taken on trust.
#include <algorithm>
#include <cmath>

#include "core/geometry/inside/complex_body.h"
#include "core/geometry/inside/complex_update.h"
#include "core/geometry/inside/none.h"

namespace bl::geometry {

namespace {

// More sentences than this help nobody.
constexpr std::size_t kMostComplaints = 20;

class Recount {
 public:
  explicit Recount(const ComplexStore& store) : store_(store) {}
  std::vector<std::string> complaints;

  void say(const std::string& sentence) {
    if (complaints.size() < kMostComplaints) complaints.push_back(sentence);
  }
  void check_corners();
  void check_nodes();
  void check_segments();
  void check_polygons();
  void check_areas();
  void check_edges();

 private:
  static bool has(const std::vector<std::uint32_t>& list, std::uint32_t entry) {
    return std::count(list.begin(), list.end(), entry) == 1;
  }
  bool meets(const ElementName& name, std::uint32_t node) const;
  double area_seen_by(std::uint32_t cell, std::uint64_t label) const;
  const ComplexStore& store_;
};

// Has every cell in the name a corner at the node, and every side a face?
bool Recount::meets(const ElementName& name, std::uint32_t node) const {
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (!store_.nodes[node].name.contains(name[i])) return false;
  }
  return true;
}

void Recount::check_corners() {
  for (std::uint32_t cell = 0; cell < store_.cells.size(); ++cell) {
    const auto& corners = store_.cells[cell].node;
    for (std::uint32_t c = 0; c < corners.size(); ++c) {
      const bool is_known =
          corners[c] < store_.nodes.size() && store_.nodes[corners[c]].is_used &&
          std::any_of(store_.nodes[corners[c]].members.begin(), store_.nodes[corners[c]].members.end(),
                      [&](const ComplexStore::Corner& member) { return member.cell == cell && member.corner == c; });
      if (!is_known) say("a corner of cell " + ElementName{store_.cells[cell].view.own}.text() + " belongs to no place");
    }
  }
}

void Recount::check_nodes() {
  for (std::uint32_t index = 0; index < store_.nodes.size(); ++index) {
    const auto& node = store_.nodes[index];
    if (!node.is_used) continue;
    std::vector<ElementLabel> labels;
    for (const auto& member : node.members) {
      if (store_.cells[member.cell].node[member.corner] != index) say("vertex " + node.name.text() + " has a corner of another");
      labels.push_back(store_.cells[member.cell].view.own);
      for (const std::uint64_t code : store_.cells[member.cell].view.keys[member.corner]) {
        if (code != CellView::kInner && ElementLabel{code}.is_side()) labels.push_back({code});
      }
    }
    if (ElementName(labels) != node.name) say("vertex " + node.name.text() + " should be " + ElementName(labels).text());
    if (store_.is_convex && !node.is_vertex && !node.is_passage) say("fewer than three edges meet at " + node.name.text());
    if (node.is_vertex && store_.vertex_names.count(node.name) != 1) say("two vertices are named " + node.name.text());
  }
}

void Recount::check_segments() {
  for (std::uint32_t index = 0; index < store_.segments.size(); ++index) {
    const auto& segment = store_.segments[index];
    if (!segment.is_used) continue;
    const ElementName& name = segment.entry->first;
    for (const std::uint32_t end : segment.ends) {
      if (!has(store_.nodes[end].segments, index)) say("an end of edge " + name.text() + " does not know it");
      if (!meets(name, end))
        say("edge " + name.text() + " ends at " + store_.nodes[end].name.text() + ", which lacks a label of it");
    }
    // Around an edge inside the domain lie as many facets as cells; at its surface one more.
    std::size_t around = 0, sides = name.size() - name.sites().size();
    const auto& [a, b] = segment.ends;
    for (const std::uint32_t polygon : store_.nodes[a].polygons) {
      const auto& loop = store_.polygons[polygon].loop;
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const std::uint32_t from = loop[i], to = loop[(i + 1) % loop.size()];
        around += (from == a && to == b) || (from == b && to == a);
      }
    }
    if (store_.is_convex && around != name.sites().size() + (sides > 0)) {
      say("edge " + name.text() + " has " + std::to_string(around) + " facets around it");
    }
  }
}

// However many segments an edge has, it runs from one vertex to another.
void Recount::check_edges() {
  for (auto at = store_.edge_names.begin(); at != store_.edge_names.end(); at = store_.edge_names.upper_bound(at->first)) {
    std::size_t ends = 0;
    for (const std::uint32_t segment : store_.pieces(ElementKind::edge, at->first)) {
      for (const std::uint32_t end : store_.segments[segment].ends) ends += store_.nodes[end].is_vertex;
    }
    if (store_.is_convex && (ends != 2 || store_.edge_names.count(at->first) != 1))
      say("edge " + at->first.text() + " has " + std::to_string(ends) + " ends");
  }
}

void Recount::check_polygons() {
  for (std::uint32_t index = 0; index < store_.polygons.size(); ++index) {
    const auto& polygon = store_.polygons[index];
    if (!polygon.is_used) continue;
    const ElementName& name = polygon.entry->first;
    for (std::size_t i = 0; i < polygon.loop.size(); ++i) {
      const std::uint32_t node = polygon.loop[i], next = polygon.loop[(i + 1) % polygon.loop.size()];
      if (!has(store_.nodes[node].polygons, index)) say("a corner of facet " + name.text() + " does not know it");
      if (!meets(name, node)) say("facet " + name.text() + " has the corner " + store_.nodes[node].name.text());
      if (store_.is_convex && store_.segment_between(node, next) == kNone) say("facet " + name.text() + " lacks an edge");
    }
    for (const std::uint32_t cell : polygon.cells) {
      if (cell == kNone) continue;
      if (!has(store_.cells[cell].polygons, index)) say("a cell of facet " + name.text() + " does not know it");
      if (!name.contains(store_.cells[cell].view.own)) say("facet " + name.text() + " belongs to a cell that it does not name");
    }
    if (!name[1].is_side() && polygon.cells[1] == kNone) say("facet " + name.text() + " is seen from one side only");
    if (store_.is_convex && store_.facet_names.count(name) != 1) say("two facets are named " + name.text());
  }
}

// What the cell's own corners, before they were put together, say about the area of its face.
double Recount::area_seen_by(std::uint32_t cell, std::uint64_t label) const {
  const CellView& view = store_.cells[cell].view;
  double area = 0;
  for (const CellView::Face& face : view.faces) {
    if (face.label != label) continue;
    const auto loop = view.loop(face);
    Vector3 doubled;
    for (std::size_t i = 2; i < loop.size(); ++i) {
      const Point3& origin = view.corners[loop[0]];
      doubled += cross(view.corners[loop[i - 1]] - origin, view.corners[loop[i]] - origin);
    }
    area += 0.5 * norm(doubled);
  }
  return area;
}

void Recount::check_areas() {
  for (auto at = store_.facet_names.begin(); at != store_.facet_names.end(); at = store_.facet_names.upper_bound(at->first)) {
    const ElementName& name = at->first;
    double kept = 0, girth = 0;
    for (const std::uint32_t index : store_.pieces(ElementKind::facet, name)) {
      const auto& loop = store_.polygons[index].loop;
      kept += store_.polygons[index].area;
      for (std::size_t i = 0; i < loop.size(); ++i) {
        girth += distance(store_.nodes[loop[i]].position, store_.nodes[loop[(i + 1) % loop.size()]].position);
      }
    }
    const auto& cells = store_.polygons[at->second].cells;
    for (std::size_t side = 0; side < 2 && cells[side] != kNone; ++side) {
      const CellView& view = store_.cells[cells[side]].view;
      const std::uint64_t other = (name[0] == view.own ? name[1] : name[0]).code;
      const double seen = area_seen_by(cells[side], other);
      // Nothing seen: a cell too thin to count lies between the two.
      if (seen > 0 && !(std::abs(seen - kept) <= 10 * store_.tolerance * girth)) {
        say("the area of facet " + name.text() + " is not what " + ElementName{view.own}.text() + " sees");
      }
    }
  }
}

}  // namespace

std::vector<std::string> CellComplex::verify() const {
  const ComplexStore& store = body_->store;
  Recount recount(store);
  recount.check_corners();
  recount.check_nodes();
  recount.check_segments();
  recount.check_edges();
  recount.check_polygons();
  recount.check_areas();
  CellComplex again;
  std::vector<std::pair<std::uint32_t, CellView>> fresh;
  again.body_->store.tolerance = store.tolerance;
  again.body_->store.is_convex = store.is_convex;
  for (const auto& [label, cell] : store.cell_of_label) {
    fresh.emplace_back(again.body_->store.add_cell(label), store.cells[cell].view);
  }
  ComplexUpdate(again.body_->store).replace(std::move(fresh), false);
  if (again.listing() != listing()) recount.say("built anew, the complex is another");
  if (!store.is_convex) return recount.complaints;
  for (const auto& [label, cell] : store.cell_of_label) {
    if (!store.cells[cell].view.is_empty() && euler(label) != 2) {
      recount.say("cell {" + std::to_string(label) + "} has an Euler characteristic of " + std::to_string(euler(label)));
    }
  }
  const auto number = [&](ElementKind kind) { return static_cast<long>(count(kind)); };
  const long sum =
      number(ElementKind::vertex) - number(ElementKind::edge) + number(ElementKind::facet) - number(ElementKind::cell);
  if (store.cell_count > 0 && sum != 1) recount.say("vertices - edges + facets - cells are " + std::to_string(sum) + ", not 1");
  return recount.complaints;
}

}  // namespace bl::geometry
