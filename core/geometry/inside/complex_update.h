// Puts changed cells into the complex: finds which corners are one place, and makes anew what lies at these places.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/geometry/inside/complex_store.h"

namespace bl::geometry {

/// Corners are one place when a chain of links joins them. A link joins two corners of neighbouring cells that carry the same
/// key; where the neighbour has no such key, and within a cell along its edges, two corners nearer than the tolerance. That is
/// a property of the cells as they are, so the places are the same whether they are found at once or by updates.
class ComplexUpdate {
 public:
  explicit ComplexUpdate(ComplexStore& store) : store_(store) {}
  /// `keeps_corners`: corners that are the same, bit for bit, keep their places; not where the tolerance is another.
  void replace(std::vector<std::pair<std::uint32_t, CellView>> fresh, bool keeps_corners);

  std::size_t cells_visited() const { return visited_.size(); }
  std::size_t elements_made() const { return elements_made_; }

 private:
  using Corner = ComplexStore::Corner;
  /// A face as its cell sees it.
  struct Side {
    std::uint64_t low, high;  ///< the labels on both sides, sorted
    std::uint32_t cell;
    std::vector<std::uint32_t> loop, nodes;  ///< around it; the same, sorted
    std::vector<std::uint32_t> over;         ///< nodes that the loop leaves out
  };
  struct EdgeLabel {
    std::uint32_t a, b;
    std::uint64_t label;  ///< or, beyond all labels, a passage between a and b
    auto operator<=>(const EdgeLabel&) const = default;
  };

  void exchange_views(std::vector<std::pair<std::uint32_t, CellView>> fresh, bool keeps_corners);
  void exchange_view(std::uint32_t cell, CellView view, std::span<const std::uint32_t> same);
  std::vector<std::vector<std::uint32_t>> detach_corners(const std::vector<std::pair<std::uint32_t, CellView>>& fresh,
                                                         bool keeps_corners);
  bool is_single(std::uint32_t cell, std::uint32_t corner) const;
  void dissolve(std::uint32_t node);
  void loosen(const Corner& corner);
  void join(std::uint32_t loose, const Corner& other);
  void link_inside(std::uint32_t loose);
  void link_across(std::uint32_t loose);
  void join_near(std::uint32_t loose, std::uint32_t cell);
  std::uint32_t root(std::uint32_t loose);
  void make_nodes();
  void make_node(std::vector<Corner> members);
  bool is_passage(std::uint32_t node) const;
  bool is_corner_of(std::uint32_t cell, std::uint32_t node) const;
  bool widen();
  void widen_face(std::uint32_t cell, const CellView::Face& face);
  void find_places();
  void read_face(std::uint32_t cell, const CellView::Face& face);
  void read_edges(const ComplexStore::Cell& cell, const CellView::Face& face, std::span<const std::uint32_t> loop);
  bool is_any_new(std::span<const std::uint32_t> nodes) const;
  void make_segments();
  void make_polygons();
  void pair_by_place(std::vector<const Side*>& alone);
  void make_polygon(const Side& side, const Side* other);

  ComplexStore& store_;
  std::vector<Corner> loose_;
  std::vector<std::uint32_t> parent_;    // of the union of loose corners
  std::size_t linked_ = 0, placed_ = 0;  // so many loose corners are linked, and are in nodes
  std::vector<std::uint32_t> visited_, made_nodes_;
  std::vector<EdgeLabel> edge_labels_;
  std::vector<Side> sides_;
  std::size_t elements_made_ = 0;
};

}  // namespace bl::geometry
