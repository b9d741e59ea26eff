// The cell complex: cells, facets, edges and vertices of the power diagram with lasting names, updated locally.
#pragma once

#include <compare>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/geometry/element_name.h"
#include "core/geometry/power_cells.h"

namespace bl::geometry {

enum class ElementKind : std::uint8_t { cell, facet, edge, vertex };
std::string_view name_of(ElementKind kind);

/// Finds an element again after every solve, so that data of people can refer to it.
struct ElementKey {
  ElementKind kind = ElementKind::cell;
  ElementName name;
  bool operator==(const ElementKey&) const = default;
  std::strong_ordering operator<=>(const ElementKey&) const = default;
};

/// The changes of an update, each list in the order of kinds and names. Elements in none of the lists are unchanged, bit for bit.
struct ComplexChange {
  std::vector<ElementKey> added, removed;
  std::vector<ElementKey> changed;  ///< exists before and after, with another place, extent or outline
};

/// The work of an update: proportional to the change, not to the complex.
struct ComplexWork {
  std::size_t cells_read = 0;      ///< cells that the diagram had made anew
  std::size_t cells_replaced = 0;  ///< those of them that differ
  std::size_t cells_visited = 0;   ///< the replaced ones and those that meet them
  std::size_t elements_made = 0;   ///< facets, edges and vertices that were removed and made again
};

/// The unshrunk power cells inside the domain as a complex. Names: a cell {a}; a facet {a,b} or {a,#k}; an edge {a,b,c},
/// {a,b,#k} or {a,#k,#l}; a vertex {a,b,c,d}, {a,b,c,#k}, {a,b,#k,#l} or {a,#k,#l,#m}; more labels where more cells or sides
/// meet. A name holds exactly the cells and sides that have the element in their boundary (README.md tells how lattices and
/// domains of several pieces are read).
class CellComplex {
 public:
  CellComplex();
  ~CellComplex();
  CellComplex(CellComplex&&) noexcept;
  CellComplex& operator=(CellComplex&&) noexcept;

  /// Sets the label of each site from the next update on; all must differ. Keep the labels when sites are added and removed, so
  /// that the names of all other elements stay. Without labels, a site's index is its label.
  Result<void> set_labels(std::span<const std::uint32_t> labels);

  /// Updates the complex after the diagram's last update, which was made from `sites` and with outlines. The first call builds
  /// the complex. Later calls read only the cells in diagram.made(), so call it after every update of the diagram. With `all` it
  /// reads every cell (and still replaces only what differs), for callers that have missed an update. An error leaves the complex
  /// unchanged.
  Result<void> update(const PowerDiagram& diagram, std::span<const PowerSite> sites, bool all = false);

  const ComplexChange& change() const;  ///< of the last update
  const ComplexWork& work() const;      ///< of the last update

  std::size_t count(ElementKind kind) const;
  bool has(const ElementKey& element) const;
  /// All names of a kind, in order.
  std::vector<ElementName> names(ElementKind kind) const;
  /// The elements of the other kind in its boundary, or in whose boundary it is; in order. Empty for unknown names.
  std::vector<ElementName> incident(const ElementKey& element, ElementKind wanted) const;

  std::optional<Point3> position(const ElementName& vertex) const;  ///< [m]
  double length(const ElementName& edge) const;                     ///< [m]; 0 for unknown names
  double area(const ElementName& facet) const;                      ///< [m²], not shrunk; 0 for unknown names
  /// The polygons of a facet (one, where the domain is convex), counter-clockwise seen from its first cell outward.
  std::vector<std::vector<Point3>> polygons(const ElementName& facet) const;
  /// V - E + F of a cell: 2 wherever the domain is convex.
  int euler(std::uint32_t cell) const;

  /// Checks everything: that a new complex is the same, incidence both ways, the two sides of every facet, Euler's formula.
  /// Returns the errors as sentences; empty where there are none. As slow as building the complex.
  std::vector<std::string> verify() const;
  /// One line per element with its numbers in full digits: equal texts are equal complexes.
  std::string listing() const;

 private:
  struct Body;
  std::unique_ptr<Body> body_;
};

}  // namespace bl::geometry
