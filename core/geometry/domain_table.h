// Domains and rings of plans as rows of a table: how files and settings hold them. Works with any table that hands out numbers
// and texts by row and column, so that geometry need not know the declarative layer.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/geometry/domain.h"

namespace bl::geometry {

/// In the column `side`: the face lies between two pieces.
inline constexpr double kInnerSide = -1;

/// One row per plane: x, y, z, offset, and the piece and the side that it belongs to. The rows of a convex domain are its planes
/// in order.
template <class Table>
void write_domain(const Domain& domain, Table& table) {
  table.columns = {"x", "y", "z", "offset", "piece", "side"};
  table.rows.clear();
  for (std::size_t p = 0; p < domain.pieces.size(); ++p) {
    const Domain::Piece& piece = domain.pieces[p];
    for (std::size_t k = 0; k < piece.sides.size(); ++k) {
      const Plane& plane = piece.shape.planes[k];
      const double side = piece.sides[k] == Domain::kInner ? kInnerSide : static_cast<double>(piece.sides[k]);
      table.rows.push_back({plane.normal.x, plane.normal.y, plane.normal.z, plane.offset, static_cast<double>(p), side});
    }
  }
}

/// The domain of such rows; a table without the columns `piece` and `side` is one convex piece, row k its side k.
template <class Table>
Result<Domain> read_domain(const Table& table) {
  const bool is_convex = table.column("piece") >= table.columns.size();
  std::vector<Domain::Piece> pieces;
  for (std::size_t row = 0; row < table.rows.size();) {
    const double number = table.number(row, "piece");
    std::vector<Plane> planes;
    Domain::Piece piece;
    for (; row < table.rows.size() && (is_convex || table.number(row, "piece") == number); ++row) {
      planes.push_back({{table.number(row, "x"), table.number(row, "y"), table.number(row, "z")}, table.number(row, "offset")});
      const double side = is_convex ? static_cast<double>(row) : table.number(row, "side");
      piece.sides.push_back(side >= 0 && side < Domain::kInner ? static_cast<std::uint32_t>(side) : Domain::kInner);
    }
    auto shape = from_planes(planes);
    if (!shape) return shape.error();
    piece.shape = std::move(*shape);
    pieces.push_back(std::move(piece));
  }
  return join_pieces(std::move(pieces));
}

/// The domain of rows that are shared; nullptr where they are none.
template <class SharedTable>
std::shared_ptr<const Domain> shared_domain(const SharedTable& planes) {
  auto domain = read_domain(*planes);
  return domain ? std::make_shared<const Domain>(std::move(*domain)) : nullptr;
}

/// Rows that follow each other under one name are one ring; its heights are those of its first row.
struct NamedRing {
  std::string name;
  std::vector<Point3> corners;
  double bottom = 0, top = 0;
  std::size_t first_row = 0;
};

template <class Table>
std::vector<NamedRing> read_rings(const Table& table) {
  std::vector<NamedRing> rings;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const std::string& name = table.text(row, "name");
    if (rings.empty() || rings.back().name != name)
      rings.push_back({name, {}, table.number(row, "bottom"), table.number(row, "top"), row});
    rings.back().corners.push_back({table.number(row, "x"), table.number(row, "y"), 0});
  }
  return rings;
}

}  // namespace bl::geometry
