// Other views in the places of cells: which of their corners stay as they are, so that nothing at these is made again.
#include <algorithm>
#include <iterator>

#include "core/geometry/inside/none.h"

#include "core/geometry/inside/complex_update.h"

namespace bl::geometry {

namespace {

using Fresh = std::vector<std::pair<std::uint32_t, CellView>>;
/// A face, or one edge of it: its label and the nodes in order, those of a face from the least one on.
using NumberedOutline = std::pair<std::uint64_t, std::vector<std::uint32_t>>;

bool is_at_short_edge(const CellView& view, std::uint32_t corner) {
  return std::any_of(view.short_edges.begin(), view.short_edges.end(),
                     [&](const auto& ends) { return ends[0] == corner || ends[1] == corner; });
}

// Per corner of the new view the corner of the old one that it is, bit for bit, or kNone. Only corners in general position,
// whose links are their keys alone.
std::vector<std::uint32_t> same_corners(const ComplexStore::Cell& old, const CellView& view) {
  std::vector<std::uint32_t> same(view.corners.size(), kNone);
  for (std::uint32_t c = 0; c < view.corners.size(); ++c) {
    if (!CellView::is_lasting(view.keys[c]) || view.find(view.keys[c]).size() != 1) continue;
    const auto found = old.view.find(view.keys[c]);
    if (found.size() != 1 || old.is_odd[found[0]] || !(old.view.corners[found[0]] == view.corners[c])) continue;
    if (!is_at_short_edge(view, c) && !is_at_short_edge(old.view, found[0])) same[c] = found[0];
  }
  return same;
}

// The edges of a cell of which both nodes are there, and the faces of which all are.
std::vector<NumberedOutline> outlines_between(const ComplexStore::Cell& cell, std::uint32_t node_count) {
  std::vector<NumberedOutline> outlines;
  for (const CellView::Face& face : cell.view.faces) {
    std::vector<std::uint32_t> nodes;
    for (const std::uint32_t corner : cell.view.loop(face)) nodes.push_back(cell.node[corner]);
    const auto is_there = [&](std::uint32_t node) { return node < node_count; };
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const std::uint32_t next = nodes[i + 1 == nodes.size() ? 0 : i + 1];
      if (is_there(nodes[i]) && is_there(next)) outlines.push_back({face.label, {nodes[i], next}});
    }
    if (!std::all_of(nodes.begin(), nodes.end(), is_there)) continue;
    std::rotate(nodes.begin(), std::min_element(nodes.begin(), nodes.end()), nodes.end());
    outlines.emplace_back(face.label, std::move(nodes));
  }
  std::sort(outlines.begin(), outlines.end());
  return outlines;
}

}  // namespace

// Has the node one corner of the cell, and no more?
bool ComplexUpdate::is_single(std::uint32_t cell, std::uint32_t corner) const {
  const std::uint32_t node = store_.cells[cell].node[corner];
  if (node == kNone) return false;
  const auto& members = store_.nodes[node].members;
  return std::count_if(members.begin(), members.end(), [&](const Corner& member) { return member.cell == cell; }) == 1;
}

// Dissolves the places of all corners that go, and returns for each cell what its corners were before.
std::vector<std::vector<std::uint32_t>> ComplexUpdate::detach_corners(const Fresh& fresh, bool keeps_corners) {
  std::vector<std::vector<std::uint32_t>> same;
  for (const auto& [cell, view] : fresh) {
    same.emplace_back(view.corners.size(), kNone);
    if (keeps_corners) same.back() = same_corners(store_.cells[cell], view);
    std::vector<std::uint8_t> stays(store_.cells[cell].node.size(), 0);
    for (const std::uint32_t old : same.back()) {
      if (old != kNone) stays[old] = is_single(cell, old);
    }
    for (std::uint32_t c = 0; c < stays.size(); ++c) {
      if (!stays[c]) dissolve(store_.cells[cell].node[c]);
    }
  }
  return same;
}

void ComplexUpdate::exchange_view(std::uint32_t index, CellView view, std::span<const std::uint32_t> same) {
  ComplexStore::Cell& cell = store_.cells[index];
  const std::vector<std::uint32_t> before = std::move(cell.node);
  store_.set_view(index, std::move(view));
  for (std::uint32_t c = 0; c < same.size(); ++c) {
    const std::uint32_t node = same[c] == kNone ? kNone : before[same[c]];
    cell.node[c] = node;
    if (node == kNone) continue;
    for (Corner& member : store_.nodes[node].members) {
      if (member.cell == index) member.corner = c;
    }
  }
}

void ComplexUpdate::exchange_views(Fresh fresh, bool keeps_corners) {
  for (const auto& [cell, view] : fresh) store_.cells[cell].is_replaced = true;
  const auto same = detach_corners(fresh, keeps_corners);
  const std::uint32_t node_count = static_cast<std::uint32_t>(store_.nodes.size());
  std::vector<std::vector<NumberedOutline>> before;
  for (const auto& [cell, view] : fresh) before.push_back(outlines_between(store_.cells[cell], node_count));
  for (std::size_t i = 0; i < fresh.size(); ++i) exchange_view(fresh[i].first, std::move(fresh[i].second), same[i]);
  std::vector<std::uint32_t> concerned;
  for (std::size_t i = 0; i < fresh.size(); ++i) {
    ComplexStore::Cell& cell = store_.cells[fresh[i].first];
    cell.is_replaced = false;
    // Faces and edges that have come or gone between corners that stay: there is more to do than new places tell.
    std::vector<NumberedOutline> changed;
    const std::vector<NumberedOutline> now = outlines_between(cell, node_count);
    std::set_symmetric_difference(before[i].begin(), before[i].end(), now.begin(), now.end(), std::back_inserter(changed));
    for (const NumberedOutline& outline : changed)
      concerned.insert(concerned.end(), outline.second.begin(), outline.second.end());
  }
  for (const auto& [index, view] : fresh) {
    for (std::uint32_t c = 0; c < store_.cells[index].node.size(); ++c) {
      if (store_.cells[index].node[c] == kNone) loosen({index, c});
    }
  }
  for (const std::uint32_t node : concerned) dissolve(node);
  // Corners that have missed their key in a replaced cell may find it now, or something near.
  for (const auto& [cell, view] : fresh) {
    for (const std::uint32_t other : store_.cells[cell].named_by) {
      for (std::uint32_t c = 0; c < store_.cells[other].is_odd.size(); ++c) {
        if (store_.cells[other].is_odd[c]) dissolve(store_.cells[other].node[c]);
      }
    }
  }
  for (const auto& [cell, view] : fresh) visited_.push_back(cell);
}

}  // namespace bl::geometry
