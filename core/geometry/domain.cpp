// Solids as unions of convex pieces: what they add up to.
#include "core/geometry/domain.h"

#include <algorithm>
#include <utility>

namespace bl::geometry {

namespace {

// Volume, centroid and box from the pieces.
void add_up(Domain& domain) {
  domain.volume = 0;
  Vector3 moment;
  domain.minimum = domain.pieces.front().shape.minimum;
  domain.maximum = domain.pieces.front().shape.maximum;
  for (const Domain::Piece& piece : domain.pieces) {
    const ConvexDomain& shape = piece.shape;
    domain.volume += shape.volume;
    moment += shape.volume * (shape.centroid - domain.pieces.front().shape.centroid);
    for (const std::uint32_t side : piece.sides) {
      if (side != Domain::kInner) domain.side_count = std::max(domain.side_count, side + 1);
    }
    domain.minimum = {std::min(domain.minimum.x, shape.minimum.x), std::min(domain.minimum.y, shape.minimum.y),
                      std::min(domain.minimum.z, shape.minimum.z)};
    domain.maximum = {std::max(domain.maximum.x, shape.maximum.x), std::max(domain.maximum.y, shape.maximum.y),
                      std::max(domain.maximum.z, shape.maximum.z)};
  }
  domain.centroid = domain.pieces.front().shape.centroid + moment / domain.volume;
}

}  // namespace

Domain::Domain(ConvexDomain convex) {
  if (convex.vertices.empty()) return;  // an empty domain has no piece
  Piece piece;
  for (std::uint32_t k = 0; k < convex.planes.size(); ++k) piece.sides.push_back(k);
  piece.shape = std::move(convex);
  pieces.push_back(std::move(piece));
  add_up(*this);
}

bool Domain::contains(const Point3& point, double tolerance) const {
  return std::any_of(pieces.begin(), pieces.end(), [&](const Piece& piece) { return piece.shape.contains(point, tolerance); });
}

const ConvexDomain& Domain::nearest_piece(const Point3& point) const {
  const auto excess = [&](const Piece& piece) {
    double most = -size();
    for (std::size_t k = 0; k < piece.shape.planes.size(); ++k) {
      const auto& face = piece.shape.faces[k];
      if (face.size() < 3) continue;
      most = std::max(most, dot(piece.shape.planes[k].normal, point - piece.shape.vertices[face.front()]));
    }
    return most;
  };
  const Piece* best = &pieces.front();
  for (const Piece& piece : pieces) {
    if (excess(piece) < excess(*best)) best = &piece;
  }
  return best->shape;
}

Point3 Domain::place_inside(const Point3& position) const {
  if (contains(position)) return position;
  const ConvexDomain& piece = nearest_piece(position);
  const Vector3 way = position - piece.centroid;
  return piece.centroid + (0.99 * piece.share_inside(way, 1)) * way;
}

const ConvexDomain& Domain::largest_piece() const {
  const auto is_smaller = [](const Piece& a, const Piece& b) { return a.shape.volume < b.shape.volume; };
  return std::max_element(pieces.begin(), pieces.end(), is_smaller)->shape;
}

Result<Domain> join_pieces(std::vector<Domain::Piece> pieces) {
  if (pieces.empty()) return Error{ErrorCode::geometry, "", "the boundary has no volume: nothing is left of it"};
  Domain domain;
  domain.pieces = std::move(pieces);
  add_up(domain);
  return domain;
}

}  // namespace bl::geometry
