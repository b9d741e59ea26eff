// A face in plan, parted into what other faces lie on and what they leave free.
#pragma once

#include <span>
#include <vector>

#include "core/geometry/plates.h"

namespace bl::geometry {

/// All corners lie on a grid. Sides that two parts share, or a part and the face, have the same corners from end to end, so that
/// bodies made of them are closed.
struct SplitFace {
  std::vector<Ring> rings;                  ///< of the face on the grid: the outer one, then its holes
  std::vector<std::vector<Ring>> on_sides;  ///< by ring and side: the corners of parts that lie on it, in order
  std::vector<PlateFace> covered, free;     ///< together they are the face
  bool is_empty() const { return rings.empty(); }
};

/// `step` [m]: of the grid. A face of which less than a triangle is left there is empty; a hole of which less is left is none.
SplitFace split_face(const PlateFace& face, std::span<const PlateFace> others, double step);

}  // namespace bl::geometry
