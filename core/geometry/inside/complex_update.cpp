// The local change of the cell complex, from changed cells to changed elements.
#include "core/geometry/inside/complex_update.h"

#include <algorithm>
#include <tuple>

#include "core/geometry/inside/none.h"

namespace bl::geometry {

namespace {

// In a cell's list of nodes: the corner is loose, and the other bits say which loose corner it is.
constexpr std::uint32_t kLoose = 0x80000000u;
// Labels from here on are passages.
constexpr std::uint64_t kOver = std::uint64_t{1} << 40;

// Without edges that have shrunk to a point, and without spurs: what is left of a sliver is nothing.
void reduce(std::vector<std::uint32_t>& loop) {
  bool is_changed = true;
  while (is_changed && loop.size() >= 3) {
    is_changed = false;
    for (std::size_t i = 0; i < loop.size() && loop.size() >= 3; ++i) {
      const std::size_t next = (i + 1) % loop.size(), previous = (i + loop.size() - 1) % loop.size();
      const bool is_short = loop[i] == loop[next], is_spur = loop[previous] == loop[next];
      if (!is_short && !is_spur) continue;
      if (is_spur) loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(std::max(i, next)));
      loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(is_spur ? std::min(i, next) : i));
      is_changed = true;
    }
  }
  if (loop.size() < 3) loop.clear();
}

}  // namespace

// Takes a place apart: its corners are to be linked anew. Those of replaced cells are no more.
void ComplexUpdate::dissolve(std::uint32_t node) {
  if (node == kNone || (node & kLoose) != 0) return;
  if (!store_.nodes[node].is_used) return;
  const std::vector<Corner> members = std::move(store_.nodes[node].members);
  const std::vector<std::uint32_t> across = store_.nodes_across(node);
  store_.remove_node(node);
  for (const Corner& member : members) {
    if (store_.cells[member.cell].is_replaced) {
      store_.cells[member.cell].node[member.corner] = kNone;
    } else {
      loosen(member);
    }
  }
  // What ran over the place is to be made again, from all cells around it.
  for (const std::uint32_t other : across) dissolve(other);
}

void ComplexUpdate::loosen(const Corner& corner) {
  store_.cells[corner.cell].node[corner.corner] = kLoose | static_cast<std::uint32_t>(loose_.size());
  parent_.push_back(static_cast<std::uint32_t>(loose_.size()));
  loose_.push_back(corner);
}

std::uint32_t ComplexUpdate::root(std::uint32_t loose) {
  while (parent_[loose] != loose) loose = parent_[loose] = parent_[parent_[loose]];
  return loose;
}

void ComplexUpdate::join(std::uint32_t loose, const Corner& other) {
  dissolve(store_.cells[other.cell].node[other.corner]);
  const std::uint32_t a = root(loose), b = root(store_.cells[other.cell].node[other.corner] & ~kLoose);
  parent_[std::max(a, b)] = std::min(a, b);
}

void ComplexUpdate::join_near(std::uint32_t loose, std::uint32_t cell) {
  const Corner corner = loose_[loose];
  const Point3 at = store_.cells[corner.cell].view.corners[corner.corner];
  for (std::uint32_t c = 0; c < store_.cells[cell].view.corners.size(); ++c) {
    if (distance(store_.cells[cell].view.corners[c], at) <= store_.tolerance) join(loose, {cell, c});
  }
}

void ComplexUpdate::link_inside(std::uint32_t loose) {
  const Corner corner = loose_[loose];
  const CellView& view = store_.cells[corner.cell].view;
  for (const auto& [a, b] : view.short_edges) {
    if (a == corner.corner) join(loose, {corner.cell, b});
    if (b == corner.corner) join(loose, {corner.cell, a});
  }
  if (!CellView::is_lasting(view.keys[corner.corner])) join_near(loose, corner.cell);  // the parts in the other pieces
}

void ComplexUpdate::link_across(std::uint32_t loose) {
  const Corner corner = loose_[loose];
  ComplexStore::Cell& cell = store_.cells[corner.cell];
  const CellView::Key& key = cell.view.keys[corner.corner];
  bool is_odd = false;
  for (const std::uint64_t label : key) {
    const std::uint32_t other = label == cell.view.own.code ? kNone : cell.cell_named(label);
    if (other == kNone) continue;
    const auto same = CellView::is_lasting(key) ? store_.cells[other].view.find(key) : std::span<const std::uint32_t>{};
    for (const std::uint32_t c : same) join(loose, {other, c});
    if (!same.empty()) continue;
    is_odd = true;
    join_near(loose, other);
  }
  cell.is_odd[corner.corner] = is_odd;
}

void ComplexUpdate::make_node(std::vector<Corner> members) {
  const auto view = [&](const Corner& corner) -> const CellView& { return store_.cells[corner.cell].view; };
  std::sort(members.begin(), members.end(),
            [&](const Corner& a, const Corner& b) { return a.cell != b.cell ? view(a).own < view(b).own : a.corner < b.corner; });
  ComplexStore::Node node;
  node.position = view(members.front()).corners[members.front().corner];
  std::vector<ElementLabel> labels;
  for (const Corner& member : members) {
    if (labels.empty() || labels.back() != view(member).own) labels.push_back(view(member).own);
  }
  for (const Corner& member : members) {
    for (const std::uint64_t code : view(member).keys[member.corner]) {
      const ElementLabel label{code};
      if (code != CellView::kInner && label.is_side() && std::find(labels.begin(), labels.end(), label) == labels.end()) {
        labels.push_back(label);
      }
    }
  }
  node.name = ElementName(labels);
  node.members = std::move(members);
  made_nodes_.push_back(store_.add_node(std::move(node)));
}

void ComplexUpdate::make_nodes() {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> by_root;
  for (; placed_ < loose_.size(); ++placed_) {
    const auto i = static_cast<std::uint32_t>(placed_);
    by_root.emplace_back(root(i), i);
  }
  std::sort(by_root.begin(), by_root.end());
  for (std::size_t begin = 0, end = 0; begin < by_root.size(); begin = end) {
    std::vector<Corner> members;
    for (; end < by_root.size() && by_root[end].first == by_root[begin].first; ++end)
      members.push_back(loose_[by_root[end].second]);
    make_node(std::move(members));
  }
}

bool ComplexUpdate::is_any_new(std::span<const std::uint32_t> nodes) const {
  return std::any_of(nodes.begin(), nodes.end(), [&](std::uint32_t node) { return store_.nodes[node].is_new; });
}

// Do three edges of the cell, or more, meet at the node? Edges without extent do not count.
bool ComplexUpdate::is_corner_of(std::uint32_t index, std::uint32_t node) const {
  const ComplexStore::Cell& cell = store_.cells[index];
  std::array<std::uint32_t, 2> known{kNone, kNone};
  const auto is_third = [&](std::uint32_t other) {
    if (other == node || other == known[0] || other == known[1]) return false;
    if (known[0] != kNone && known[1] != kNone) return true;
    known[known[0] == kNone ? 0 : 1] = other;
    return false;
  };
  for (const CellView::Face& face : cell.view.faces) {
    const auto loop = cell.view.loop(face);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      if (cell.node[loop[i]] != node) continue;
      if (is_third(cell.node[loop[i + 1 == loop.size() ? 0 : i + 1]])) return true;
      if (is_third(cell.node[loop[i == 0 ? loop.size() - 1 : i - 1]])) return true;
    }
  }
  return false;
}

// Faces between pieces of the domain have edges that are none: nodes on them are left alone.
bool ComplexUpdate::is_passage(std::uint32_t node) const {
  const auto& members = store_.nodes[node].members;
  for (std::size_t i = 0; i < members.size(); ++i) {
    if (!CellView::is_lasting(store_.cells[members[i].cell].view.keys[members[i].corner])) return false;
    if (i > 0 && members[i].cell == members[i - 1].cell) continue;
    if (is_corner_of(members[i].cell, node)) return false;
  }
  return true;
}

// Dissolves what a new node beside or on this face concerns, although it has no part in it.
void ComplexUpdate::widen_face(std::uint32_t index, const CellView::Face& face) {
  const ComplexStore::Cell& cell = store_.cells[index];
  const auto corners = cell.view.loop(face);
  const std::size_t count = corners.size();
  std::vector<std::uint32_t> loop;
  bool is_new = false, has_more = false;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t node = cell.node[corners[i]];
    if ((node & kLoose) != 0) return;  // dissolved a moment ago: the next round comes here again
    is_new = is_new || store_.nodes[node].is_new;
    has_more = has_more || store_.nodes[node].is_passage;
    loop.push_back(node);
  }
  if (!is_new) return;
  // A node whose neighbours have changed may have become a passage, or have ceased to be one.
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t a = loop[i], b = loop[i + 1 == count ? 0 : i + 1];
    for (const auto& [one, other] : {std::pair(a, b), std::pair(b, a)}) {
      if (!store_.nodes[one].is_new || store_.nodes[other].is_new || !store_.nodes[other].is_used) continue;
      // A new passage concerns all cells around its edge, which meet in the ends.
      if (store_.nodes[one].is_passage || is_passage(other) != store_.nodes[other].is_passage) dissolve(other);
    }
  }
  const std::size_t before = loop.size();
  std::erase_if(loop, [&](std::uint32_t node) { return store_.nodes[node].is_passage; });
  reduce(loop);
  if (!loop.empty() && (has_more || loop.size() < before) && !is_any_new(loop)) dissolve(loop.front());
}

// Does more have to be made anew than the places that have changed?
bool ComplexUpdate::widen() {
  const std::size_t before = loose_.size();
  for (const std::uint32_t cell : visited_) {
    for (const CellView::Face& face : store_.cells[cell].view.faces) widen_face(cell, face);
  }
  return loose_.size() > before;
}

void ComplexUpdate::find_places() {
  do {
    for (; linked_ < loose_.size(); ++linked_) {  // grows under way
      link_inside(static_cast<std::uint32_t>(linked_));
      link_across(static_cast<std::uint32_t>(linked_));
    }
    for (std::size_t i = placed_; i < loose_.size(); ++i) visited_.push_back(loose_[i].cell);
    std::sort(visited_.begin(), visited_.end());
    visited_.erase(std::unique(visited_.begin(), visited_.end()), visited_.end());
    const std::size_t first = made_nodes_.size();
    make_nodes();
    for (std::size_t i = first; i < made_nodes_.size(); ++i) store_.nodes[made_nodes_[i]].is_passage = is_passage(made_nodes_[i]);
  } while (widen());
}

// The edges of a face: from one node that is no passage to the next.
void ComplexUpdate::read_edges(const ComplexStore::Cell& cell, const CellView::Face& face, std::span<const std::uint32_t> loop) {
  const std::size_t count = loop.size();
  const auto at = [&](std::size_t i) { return loop[i % count]; };
  std::size_t start = 0;
  while (start < count && store_.nodes[loop[start]].is_passage) ++start;
  if (start == count) return;
  for (std::size_t i = start; i < start + count;) {
    std::size_t next = i + 1;
    bool is_new = store_.nodes[at(i)].is_new;
    while (store_.nodes[at(next)].is_passage) is_new = store_.nodes[at(next++)].is_new || is_new;
    is_new = is_new || store_.nodes[at(next)].is_new;
    const std::uint32_t a = std::min(at(i), at(next)), b = std::max(at(i), at(next));
    if (a != b && is_new) {
      edge_labels_.push_back({a, b, cell.view.own.code});
      if (!face.is_inner() && !face.is_site()) edge_labels_.push_back({a, b, face.label});
      for (std::size_t k = i + 1; k < next; ++k) edge_labels_.push_back({a, b, kOver + at(k)});
    }
    i = next;
  }
}

// What a face says about elements at new nodes.
void ComplexUpdate::read_face(std::uint32_t index, const CellView::Face& face) {
  const ComplexStore::Cell& cell = store_.cells[index];
  std::vector<std::uint32_t> loop;
  for (const std::uint32_t corner : cell.view.loop(face)) loop.push_back(cell.node[corner]);
  if (!is_any_new(loop)) return;
  read_edges(cell, face, loop);
  if (face.is_inner()) return;
  std::vector<std::uint32_t> over = loop;
  std::erase_if(loop, [&](std::uint32_t node) { return store_.nodes[node].is_passage; });
  reduce(loop);
  if (loop.empty()) return;
  std::vector<std::uint32_t> nodes = loop;
  std::sort(nodes.begin(), nodes.end());
  std::erase_if(over, [&](std::uint32_t node) { return std::binary_search(nodes.begin(), nodes.end(), node); });
  const std::uint64_t own = cell.view.own.code;
  sides_.push_back(
      {std::min(own, face.label), std::max(own, face.label), index, std::move(loop), std::move(nodes), std::move(over)});
}

void ComplexUpdate::make_segments() {
  std::sort(edge_labels_.begin(), edge_labels_.end());
  edge_labels_.erase(std::unique(edge_labels_.begin(), edge_labels_.end()), edge_labels_.end());
  std::vector<ElementLabel> labels;
  for (std::size_t begin = 0, end = 0; begin < edge_labels_.size(); begin = end) {
    const EdgeLabel& first = edge_labels_[begin];
    ComplexStore::Segment segment;
    segment.ends = {first.a, first.b};
    labels.clear();
    for (; end < edge_labels_.size() && edge_labels_[end].a == first.a && edge_labels_[end].b == first.b; ++end) {
      const std::uint64_t label = edge_labels_[end].label;
      if (label < kOver) labels.push_back({label});
      else segment.over.push_back(static_cast<std::uint32_t>(label - kOver));
    }
    if (labels.size() < 3) continue;
    store_.add_segment(std::move(segment), ElementName(labels));
    ++elements_made_;
  }
}

void ComplexUpdate::make_polygon(const Side& side, const Side* other) {
  ComplexStore::Polygon polygon;
  const auto own = [&](const Side* s) { return store_.cells[s->cell].view.own; };
  const Side* low = other != nullptr && own(other) < own(&side) ? other : &side;
  const Side* high = other == nullptr ? nullptr : low == other ? &side : other;
  polygon.cells = {low->cell, high == nullptr ? kNone : high->cell};
  // Two sides of one facet bear its name; sides that meet in one place only are named by the cells that are there.
  ElementName name{ElementLabel{side.low}, ElementLabel{side.high}};
  if (high != nullptr) name = ElementName{own(low), own(high)};
  polygon.loop = low->loop;
  polygon.over = low->over;
  if (high != nullptr) polygon.over.insert(polygon.over.end(), high->over.begin(), high->over.end());
  std::sort(polygon.over.begin(), polygon.over.end());
  polygon.over.erase(std::unique(polygon.over.begin(), polygon.over.end()), polygon.over.end());
  const auto place = [&](std::uint32_t node) -> const Point3& { return store_.nodes[node].position; };
  const auto first = std::min_element(polygon.loop.begin(), polygon.loop.end(),
                                      [&](std::uint32_t a, std::uint32_t b) { return comes_before(place(a), place(b)); });
  std::rotate(polygon.loop.begin(), first, polygon.loop.end());
  Vector3 doubled;
  for (std::size_t i = 2; i < polygon.loop.size(); ++i) {
    const Point3& origin = place(polygon.loop[0]);
    doubled += cross(place(polygon.loop[i - 1]) - origin, place(polygon.loop[i]) - origin);
  }
  polygon.area = 0.5 * norm(doubled);
  store_.add_polygon(std::move(polygon), name);
  ++elements_made_;
}

// Faces whose neighbour does not answer, because it is too thin to be a cell: the cell beyond it has the same nodes.
void ComplexUpdate::pair_by_place(std::vector<const Side*>& alone) {
  std::stable_sort(alone.begin(), alone.end(), [](const Side* a, const Side* b) { return a->nodes < b->nodes; });
  for (std::size_t i = 0; i < alone.size(); ++i) {
    const Side* next = i + 1 < alone.size() ? alone[i + 1] : nullptr;
    const bool is_pair = next != nullptr && next->nodes == alone[i]->nodes && next->cell != alone[i]->cell;
    make_polygon(*alone[i], is_pair ? next : nullptr);
    i += is_pair;
  }
}

void ComplexUpdate::make_polygons() {
  const auto key = [](const Side& s) { return std::tie(s.low, s.high, s.nodes); };
  std::sort(sides_.begin(), sides_.end(),
            [&](const Side& a, const Side& b) { return key(a) != key(b) ? key(a) < key(b) : a.cell < b.cell; });
  std::vector<const Side*> alone;
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    const Side& side = sides_[i];
    if (ElementLabel{side.high}.is_side()) {
      make_polygon(side, nullptr);
    } else if (i + 1 < sides_.size() && key(side) == key(sides_[i + 1]) && side.cell != sides_[i + 1].cell) {
      make_polygon(side, &sides_[++i]);
    } else {
      alone.push_back(&side);
    }
  }
  pair_by_place(alone);
}

void ComplexUpdate::replace(std::vector<std::pair<std::uint32_t, CellView>> fresh, bool keeps_corners) {
  exchange_views(std::move(fresh), keeps_corners);
  find_places();
  for (const std::uint32_t cell : visited_) {
    for (const CellView::Face& face : store_.cells[cell].view.faces) read_face(cell, face);
  }
  make_segments();
  make_polygons();
  elements_made_ += made_nodes_.size();
  for (const std::uint32_t node : made_nodes_) store_.nodes[node].is_new = false;
  for (const std::uint32_t node : store_.unsettled) store_.settle_vertex(node);
  store_.unsettled.clear();
}

}  // namespace bl::geometry
