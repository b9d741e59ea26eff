// The curves of links between bodies: where they leave a box, how they bend, and how many beside each other are told apart.
#pragma once

#include <vector>

#include "ui/desktop/panels/canvas/plane.h"

namespace bl::desktop::canvas {

struct Route {
  std::size_t from = 0, to = 0;  ///< bodies
  std::vector<ImVec2> dots;      ///< what the curve goes through, in order
};

/// Points along each route's curve, close enough to be drawn as stretches. Routes between the same two bodies fan out.
std::vector<std::vector<ImVec2>> trace(const std::vector<Box>& bodies, const std::vector<Route>& routes);

/// A curve that leaves `from` and ends at a point, as while a link is being laid.
std::vector<ImVec2> trace_to_point(const Box& from, ImVec2 to);

}  // namespace bl::desktop::canvas
