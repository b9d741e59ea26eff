// Dressed areas as rows of tables: how they travel to panels, exports and the 3D view. Works with any table that holds numbers
// and texts by row and column.
#pragma once

#include <string>

#include "core/facade/dressing.h"

namespace bl::facade {

/// One row for each orientation, clockwise from north, with the windows that stand there.
template <class Table>
void write_sides(const Dressing& dressing, const FacadeRules& rules, double factor, double storey_height, Table& table) {
  table.columns = {"orientation", "area", "glazed", "opaque", "cost", "module", "sill", "head", "width"};
  table.rows.clear();
  table.rows.reserve(kOrientations);
  for (std::size_t k = 0; k < kOrientations; ++k) {
    const DressedArea& part = dressing.by_orientation[k];
    const WindowBand band = band_of(rules[k], storey_height);
    table.rows.push_back({std::string(name_of(static_cast<Orientation>(k))), part.area(), part.glazed, part.opaque, part.cost,
                          rules[k].module, band.sill, band.head, window_width(rules[k], factor, storey_height)});
  }
}

/// One row for each storey that has a façade.
template <class Table>
void write_storeys(const Dressing& dressing, Table& table) {
  table.columns = {"storey", "area", "glazed", "opaque", "cost"};
  table.rows.clear();
  table.rows.reserve(dressing.by_storey.size());
  for (std::size_t k = 0; k < dressing.by_storey.size(); ++k)
    if (const DressedArea& part = dressing.by_storey[k]; part.area() > 0)
      table.rows.push_back({static_cast<double>(k), part.area(), part.glazed, part.opaque, part.cost});
}

}  // namespace bl::facade
