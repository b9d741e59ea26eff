// What a CellComplex has inside; shared by its files.
#pragma once

#include <utility>
#include <vector>

#include "core/geometry/inside/complex_store.h"

namespace bl::geometry {

struct CellComplex::Body {
  ComplexStore store;
  std::vector<std::uint32_t> labels;  ///< per site; empty: the index
  std::vector<std::uint32_t> cell_of_site;
  bool is_whole = false;  ///< do the cells belong to these labels?
  ComplexChange change;
  ComplexWork work;

  Result<void> check(const PowerDiagram& diagram, std::span<const PowerSite> sites, std::span<const std::uint32_t> which) const;
  void update(const PowerDiagram& diagram, std::span<const PowerSite> sites, std::span<const std::uint32_t> which);
  std::vector<std::uint32_t> assign_labels(std::size_t count);
  void list_change(const std::vector<std::pair<ElementKey, bool>>& cells);
  void list_all();
};

}  // namespace bl::geometry
