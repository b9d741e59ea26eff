// Places boxes that nobody has placed: sources in columns, what is linked beside each other, the rest in a calm grid.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "ui/desktop/panels/canvas/plane.h"

namespace bl::desktop::canvas {

struct LayoutItem {
  ImVec2 size;
  int column = -1;  ///< a source's column from the left, or -1: in the field to their right
  std::string kin;  ///< items of one kin stand together in the grid
};

/// Upper left corners, one for each item; no two items overlap. The same input gives the same places.
std::vector<ImVec2> lay_out(const std::vector<LayoutItem>& items, const std::vector<std::pair<std::size_t, std::size_t>>& links);

}  // namespace bl::desktop::canvas
