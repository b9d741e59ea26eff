// The demand of one row of a brief, for all of its items. Only here are floor areas converted to volumes.
#pragma once

#include "core/define/value.h"

namespace bl::demand {

struct BriefSums {
  double area = 0, area_min = 0;                      ///< [m²]
  double volume = 0, volume_min = 0, volume_max = 0;  ///< [m³]
  bool is_open = true;                                ///< the row has no largest floor area
};

/// `rows` has the columns of a programme, where the floor areas are those of one item.
inline BriefSums brief_sums(const Table& rows, std::size_t row) {
  const double count = rows.number(row, "count"), height = rows.number(row, "storey_height");
  const double largest = rows.number(row, "floor_area_max");
  BriefSums sums;
  sums.area = rows.number(row, "floor_area") * count;
  sums.area_min = rows.number(row, "floor_area_min") * count;
  sums.volume = sums.area * height;
  sums.volume_min = sums.area_min * height;
  sums.volume_max = largest * count * height;
  sums.is_open = !(largest > 0);
  return sums;
}

}  // namespace bl::demand
