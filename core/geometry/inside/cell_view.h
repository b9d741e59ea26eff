// What one cell says about the complex: its corners with the labels that meet there, and its faces.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/element_name.h"
#include "core/geometry/power_cells.h"

namespace bl::geometry {

/// The unshrunk cell of one site in labels that last, so that two views of one cell can be compared whatever the order of the
/// sites was. A function of the cell alone: it knows nothing of what its neighbours see.
struct CellView {
  /// The cell's own label and those of the three faces, sorted. A face between two pieces of the domain counts as kInner.
  using Key = std::array<std::uint64_t, 4>;
  static constexpr std::uint64_t kInner = ~std::uint64_t{0};

  struct Face {
    std::uint64_t label = kInner;
    std::uint32_t first = 0, count = 0;  ///< of `loops`
    bool operator==(const Face&) const = default;
    bool is_inner() const { return label == kInner; }
    bool is_site() const { return !is_inner() && !ElementLabel{label}.is_side(); }
  };

  ElementLabel own;
  std::vector<Point3> corners;  ///< [m], in the world
  std::vector<Key> keys;        ///< per corner
  std::vector<Face> faces;
  std::vector<std::uint32_t> loops;                       ///< corners of the faces, counter-clockwise from outside
  std::vector<std::uint32_t> by_key;                      ///< corners in the order of their keys
  std::vector<std::array<std::uint32_t, 2>> short_edges;  ///< pairs of corners that an edge without extent joins

  /// No cell, or one as thin as the tolerance: it has no element.
  bool is_empty() const { return corners.empty(); }
  bool is_same(const CellView& other) const;
  std::span<const std::uint32_t> loop(const Face& face) const { return std::span(loops).subspan(face.first, face.count); }
  /// The corners with this key.
  std::span<const std::uint32_t> find(const Key& key) const;
  /// Does the key name a place wherever it is seen? Not on a face between pieces, of which there are many without a number.
  static bool is_lasting(const Key& key) { return key[3] != kInner; }
};

/// Parts no thicker than `tolerance` [m] are left out. `labels` per site; empty: the index is the label.
CellView read_cell(const Point3& site, ElementLabel own, std::span<const Polyhedron> parts, std::span<const std::uint32_t> labels,
                   double tolerance);

}  // namespace bl::geometry
