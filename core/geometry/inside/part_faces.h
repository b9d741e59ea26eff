// Which faces of convex parts are surface and which lie between two of them: the last step of the makers of domains.
#pragma once

#include <vector>

#include "core/geometry/solid_part.h"

namespace bl::geometry {

/// A part on its way into a domain. `whole` is the piece that it was, as long as nothing was cut off it: such a piece comes out
/// with the same bits.
struct LoosePart {
  SolidPart part;
  const Domain::Piece* whole = nullptr;
};

/// A polygon of the surface with its side: faces of cuts that turn out to be surface are named after the wall they lie in.
struct Wall {
  Polygon polygon;
  Vector3 normal;  ///< out of the solid
  std::uint32_t side = 0;
};

double volume_of(const std::vector<LoosePart>& parts);

/// A domain of the parts. They are cut where a face is covered by other parts only in places; then every face is named: kInner
/// where another part covers it, else by its own side, or, where that is kInner, by its wall. Parts that are still whole pieces
/// come first, with their bits; behind them the others, put together wherever two of them make one convex piece.
Result<Domain> settled_domain(const std::vector<LoosePart>& parts, const std::vector<Wall>& walls, double tolerance,
                              std::uint32_t side_count);

/// Fails where the pieces that were too thin to keep had more than 1e-9 of the volume.
Result<void> check_volume(double kept, double wanted);

}  // namespace bl::geometry
