// The plates of a standing volume as rows of a table; works with any table of numbers and lists of numbers.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "core/geometry/plates.h"

namespace bl::geometry {

/// In the column `corners`: what is beyond a side.
enum class PlateSide : int { free = 0, plot = 1, neighbour = 2 };

/// In the column `courtyard`: which line of its stack a ring is.
enum class PlateLine : int { outline = 0, courtyard = 1, enclosed = 2 };

/// One row for each ring: the stack that it belongs to, the centre of its arcs, and of each corner x, y, the radius of the arc
/// that begins there (0: a straight side) and what is beyond that side (PlateSide), one after the other.
template <class Table>
void write_body(const StandingBody& body, Table& table) {
  table.columns = {"stack", "storeys", "bottom", "storey_height", "area", "courtyard", "centre_x", "centre_y", "corners"};
  table.rows.clear();
  for (std::size_t s = 0; s < body.stacks.size(); ++s) {
    const PlateStack& stack = body.stacks[s];
    const auto add = [&](const PlateRing& ring, PlateLine line) {
      std::vector<double> corners;
      for (const PlateRing::Corner& c : ring.corners) {
        const PlateSide side = c.beyond >= 0                  ? PlateSide::neighbour
                               : c.beyond == PlateRing::kPlot ? PlateSide::plot
                                                              : PlateSide::free;
        corners.insert(corners.end(), {c.at.x, c.at.y, c.is_arc ? ring.radius : 0, static_cast<double>(side)});
      }
      auto& row = table.rows.emplace_back();
      for (const double number : {static_cast<double>(s), static_cast<double>(stack.storeys), stack.bottom, stack.storey_height,
                                  stack.area, static_cast<double>(line), body.centre.x, body.centre.y})
        row.emplace_back(number);
      row.emplace_back(std::move(corners));
    };
    for (const PlateRing& ring : stack.outlines) add(ring, PlateLine::outline);
    for (const PlateRing& ring : stack.courtyards) add(ring, PlateLine::courtyard);
    for (const PlateRing& ring : stack.enclosed) add(ring, PlateLine::enclosed);
  }
}

/// The body of such rows; sites beyond a side have the number 0.
template <class Table>
StandingBody read_body(const Table& table) {
  StandingBody body;
  // All rings of a body have one centre: of who shares a footprint, that of its host.
  if (!table.rows.empty()) body.centre = {table.number(0, "centre_x"), table.number(0, "centre_y"), 0};
  double last = -1;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    if (const double number = table.number(row, "stack"); body.stacks.empty() || number != last) {
      body.stacks.push_back({static_cast<int>(table.number(row, "storeys")),
                             table.number(row, "bottom"),
                             table.number(row, "storey_height"),
                             table.number(row, "area"),
                             {},
                             {}});
      last = number;
    }
    PlateRing ring;
    const auto& numbers = *table.numbers(row, "corners");
    for (std::size_t k = 0; k + 3 < numbers.size(); k += 4) {
      const int side = static_cast<int>(numbers[k + 3]);
      if (numbers[k + 2] > 0) ring.radius = numbers[k + 2];
      ring.corners.push_back({{numbers[k], numbers[k + 1], 0},
                              side == static_cast<int>(PlateSide::neighbour) ? 0
                              : side == static_cast<int>(PlateSide::plot)    ? PlateRing::kPlot
                                                                             : PlateRing::kFree,
                              numbers[k + 2] > 0});
    }
    PlateStack& stack = body.stacks.back();
    const int line = static_cast<int>(table.number(row, "courtyard"));
    (line == static_cast<int>(PlateLine::courtyard)  ? stack.courtyards
     : line == static_cast<int>(PlateLine::enclosed) ? stack.enclosed
                                                     : stack.outlines)
        .push_back(std::move(ring));
  }
  return body;
}

}  // namespace bl::geometry
