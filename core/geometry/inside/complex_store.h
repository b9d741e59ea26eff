// Where the cell complex is kept: tables with free places, and the names in order.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "core/geometry/cell_complex.h"
#include "core/geometry/inside/cell_view.h"

namespace bl::geometry {

/// Nodes are the places where corners of cells meet; between two nodes runs a segment, around a polygon lie nodes. In general
/// position they are the vertices, edges and facets. Where cells are nearly lined up, slivers end somewhere along an edge: such
/// a node, a passage, is no corner of any cell, and segments and polygons run over it. Where the domain has several pieces, an
/// edge may have several segments and a facet several polygons, and a node between two segments is no vertex either.
class ComplexStore {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  using Index = std::multimap<ElementName, std::uint32_t>;

  struct Corner {
    std::uint32_t cell, corner;
  };
  struct Cell {
    bool is_used = false;
    bool is_replaced = false;  ///< while an update runs: the view is, or is about to be, another
    CellView view;
    std::vector<std::uint32_t> node;                             ///< per corner
    std::vector<std::uint8_t> is_odd;                            ///< per corner: some cell of its key lacks the key
    std::vector<std::pair<std::uint64_t, std::uint32_t>> named;  ///< sites of its faces: label and cell, sorted
    std::vector<std::uint32_t> named_by;                         ///< the cells that have this one in `named`
    std::vector<std::uint32_t> polygons;
    std::uint32_t cell_named(std::uint64_t label) const;
  };
  struct Node {
    Point3 position;
    ElementName name;
    bool is_used = false, is_vertex = false;
    bool is_passage = false;
    bool is_new = false;  ///< while an update runs: made by it
    std::vector<Corner> members;
    std::vector<std::uint32_t> segments, polygons;  ///< that end or turn here, or have this node in `over`
    Index::iterator entry{};                        ///< where it is a vertex
  };
  struct Segment {
    std::array<std::uint32_t, 2> ends{kNone, kNone};
    std::vector<std::uint32_t> over;  ///< passages between the ends
    Index::iterator entry{};
    bool is_used = false;
  };
  struct Polygon {
    std::vector<std::uint32_t> loop;  ///< nodes, from the first in space, counter-clockwise from cells[0] outward
    std::vector<std::uint32_t> over;  ///< nodes of the cells' faces that are not in the loop
    std::array<std::uint32_t, 2> cells{kNone, kNone};  ///< the one of the lower label first; a side has one
    double area = 0;
    Index::iterator entry{};
    bool is_used = false;
  };

  std::vector<Cell> cells;
  std::vector<Node> nodes;
  std::vector<Segment> segments;
  std::vector<Polygon> polygons;
  Index vertex_names, edge_names, facet_names;
  std::map<std::uint32_t, std::uint32_t> cell_of_label;
  std::size_t cell_count = 0;                                     ///< those that are not empty
  std::size_t vertex_count = 0, edge_count = 0, facet_count = 0;  ///< names, not entries
  bool is_convex = true;
  double tolerance = 0;  ///< [m]

  std::uint32_t add_cell(std::uint32_t label);
  /// Puts a view in the place of the cell's last one. Its corners have no nodes yet.
  void set_view(std::uint32_t cell, CellView view);
  void remove_cell(std::uint32_t cell);

  std::uint32_t add_node(Node node);
  void remove_node(std::uint32_t node);  ///< with the segments and polygons at it
  void add_segment(Segment segment, const ElementName& name);
  void add_polygon(Polygon polygon, const ElementName& name);
  /// Makes the node a vertex, or no vertex, by the edges at it.
  void settle_vertex(std::uint32_t node);

  /// The nodes of those segments and polygons that have this node in `over`.
  std::vector<std::uint32_t> nodes_across(std::uint32_t node) const;
  std::uint32_t segment_between(std::uint32_t a, std::uint32_t b) const;
  const Index& names(ElementKind kind) const;
  /// All numbers of an element, in an order that its history does not show in; empty where there is no such element.
  std::vector<Point3> geometry(const ElementKey& element) const;
  std::vector<std::uint32_t> pieces(ElementKind kind, const ElementName& name) const;

  /// While `keeps_notes`: what elements were before they were touched for the first time.
  bool keeps_notes = false;
  std::map<ElementKey, std::vector<Point3>> notes;
  /// Nodes of segments that have come or gone.
  std::vector<std::uint32_t> unsettled;

 private:
  void note(ElementKind kind, const ElementName& name);
  std::vector<Point3> geometry_of_piece(ElementKind kind, std::uint32_t piece) const;
  static Index::iterator enter(Index& index, std::size_t& count, const ElementName& name, std::uint32_t piece);
  static void leave(Index& index, std::size_t& count, Index::iterator entry);
  void remove_segment(std::uint32_t segment);
  void remove_polygon(std::uint32_t polygon);
  std::vector<std::uint32_t> free_cells_, free_nodes_, free_segments_, free_polygons_;
};

/// Points by x, then y, then z.
bool comes_before(const Point3& a, const Point3& b);

}  // namespace bl::geometry
