// Takes the plot from a domain and erodes it: a convex one by its half-planes, another one by the Clipper library's offsets.
#include "core/geometry/inside/plan_plot.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include <clipper.hpp>

#include "core/geometry/inside/plan_pieces.h"

namespace bl::geometry {

namespace {

constexpr double kGrid = 1e6;           // steps of the Clipper library's integers in a metre
constexpr double kArcTolerance = 2e-5;  // largest distance of a chord from its arc [m]
// The section is taken at this share of the height: at the bottom itself planes of several pieces meet.
constexpr double kSectionShare = 1e-3;

// The section of a convex body, which all of its planes cut from a box around it.
PlanPolygon section_of(const Domain::Piece& piece, double z) {
  const ConvexDomain& shape = piece.shape;
  const double margin = 1 + shape.size();
  const double low_x = shape.minimum.x - margin, low_y = shape.minimum.y - margin;
  const double high_x = shape.maximum.x + margin, high_y = shape.maximum.y + margin;
  PlanPolygon polygon{{{{low_x, low_y}}, {{high_x, low_y}}, {{high_x, high_y}}, {{low_x, high_y}}}}, spare;
  for (std::size_t k = 0; k < shape.planes.size(); ++k) {
    const auto& [normal, offset] = shape.planes[k];
    const double flat = std::sqrt(normal.x * normal.x + normal.y * normal.y);
    const double rest = offset - normal.z * z;
    if (flat <= 1e-12 * norm(normal)) {
      if (rest < 0) return {};
      continue;
    }
    const std::int32_t beyond = piece.sides[k] == Domain::kInner ? PlanSide::kInner : PlanSide::kPlot;
    clip(polygon, {normal.x / flat, normal.y / flat, rest / flat}, beyond, spare);
  }
  return polygon;
}

double area_of(const PlanPolygon& polygon) {
  double twice = 0;
  const std::size_t count = polygon.corners.size();
  for (std::size_t k = 1; k + 1 < count; ++k) {
    const PlanPoint &a = polygon.corners[0].at, &b = polygon.corners[k].at, &c = polygon.corners[k + 1].at;
    twice += (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  }
  return 0.5 * twice;
}

PlanPlot::Piece piece_of(PlanPolygon polygon) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  PlanPlot::Piece piece{std::move(polygon), {kFar, kFar}, {-kFar, -kFar}};
  for (const PlanPolygon::Corner& c : piece.polygon.corners) {
    piece.low = {std::min(piece.low.x, c.at.x), std::min(piece.low.y, c.at.y)};
    piece.high = {std::max(piece.high.x, c.at.x), std::max(piece.high.y, c.at.y)};
  }
  return piece;
}

ClipperLib::cInt to_grid(double metres) { return static_cast<ClipperLib::cInt>(std::llround(metres * kGrid)); }

// The border of a union of polygons.
ClipperLib::Paths border_of(const PlanPlot::Pieces& pieces) {
  ClipperLib::Clipper clipper;
  for (const PlanPlot::Piece& piece : pieces) {
    ClipperLib::Path path;
    for (const PlanPolygon::Corner& c : piece.polygon.corners) path.emplace_back(to_grid(c.at.x), to_grid(c.at.y));
    clipper.AddPath(path, ClipperLib::ptSubject, true);
  }
  ClipperLib::Paths border;
  clipper.Execute(ClipperLib::ctUnion, border, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
  return border;
}

// An outer ring and its holes, as plan_pieces takes them.
void add_pieces(const ClipperLib::PolyNode& outer, PlanPlot::Pieces& pieces) {
  std::vector<std::vector<PlanCorner>> rings;
  const auto add = [&rings](const ClipperLib::Path& path) {
    std::vector<PlanCorner>& ring = rings.emplace_back();
    for (const ClipperLib::IntPoint& p : path)
      ring.push_back({static_cast<double>(p.X) / kGrid, static_cast<double>(p.Y) / kGrid, ring.size()});
  };
  add(outer.Contour);
  for (const ClipperLib::PolyNode* hole : outer.Childs) add(hole->Contour);
  if (const auto parts = plan_pieces(rings))
    for (const PlanPiece& part : *parts) {
      PlanPolygon polygon;
      for (std::size_t k = 0; k < part.corners.size(); ++k)
        polygon.corners.push_back(
            {{part.corners[k].x, part.corners[k].y}, part.walls[k] == PlanPiece::kNoWall ? PlanSide::kInner : PlanSide::kPlot});
      pieces.push_back(piece_of(std::move(polygon)));
    }
  for (const ClipperLib::PolyNode* hole : outer.Childs)
    for (const ClipperLib::PolyNode* island : hole->Childs) add_pieces(*island, pieces);
}

}  // namespace

Result<PlanPlot> PlanPlot::section(const Domain& domain) {
  PlanPlot plot;
  const double z = domain.minimum.z + kSectionShare * (domain.maximum.z - domain.minimum.z);
  for (const Domain::Piece& piece : domain.pieces) {
    PlanPolygon polygon = section_of(piece, z);
    const double area = polygon.is_empty() ? 0 : area_of(polygon);
    if (!(area > 0)) continue;
    plot.area_ += area;
    plot.pieces_.push_back(piece_of(std::move(polygon)));
  }
  if (plot.pieces_.empty())
    return Error{ErrorCode::infeasible, "boundary", "the boundary has no area on its ground, so nothing can stand there"};
  plot.low_ = plot.pieces_.front().low;
  plot.high_ = plot.pieces_.front().high;
  for (const Piece& piece : plot.pieces_) {
    plot.low_ = {std::min(plot.low_.x, piece.low.x), std::min(plot.low_.y, piece.low.y)};
    plot.high_ = {std::max(plot.high_.x, piece.high.x), std::max(plot.high_.y, piece.high.y)};
  }
  return plot;
}

const PlanPlot::Pieces& PlanPlot::eroded(double by) {
  if (!(by > 0)) return pieces_;
  const auto [entry, is_new] = eroded_.try_emplace(by);
  if (is_new) entry->second = pieces_.size() == 1 ? erode_convex(by) : erode_rings(by);
  return entry->second;
}

const PlanPlot::Pieces* PlanPlot::made(double by) const {
  if (!(by > 0)) return &pieces_;
  const auto entry = eroded_.find(by);
  return entry == eroded_.end() ? nullptr : &entry->second;
}

PlanPlot::Pieces PlanPlot::erode_convex(double by) const {
  const PlanPolygon& whole = pieces_.front().polygon;
  PlanPolygon rest = whole, spare;
  for (std::size_t k = 0; k < whole.corners.size(); ++k) {
    const PlanPoint &a = whole.corners[k].at, &b = whole.corners[(k + 1) % whole.corners.size()].at;
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    if (!(length > 0)) continue;
    const double x = (b.y - a.y) / length, y = (a.x - b.x) / length;
    clip(rest, {x, y, x * a.x + y * a.y - by}, PlanSide::kPlot, spare);
  }
  Pieces pieces;
  if (!rest.is_empty()) pieces.push_back(piece_of(std::move(rest)));
  return pieces;
}

PlanPlot::Pieces PlanPlot::erode_rings(double by) const {
  ClipperLib::ClipperOffset offset(2, kArcTolerance * kGrid);
  offset.AddPaths(border_of(pieces_), ClipperLib::jtRound, ClipperLib::etClosedPolygon);
  ClipperLib::PolyTree tree;
  offset.Execute(tree, -by * kGrid);
  Pieces pieces;
  for (const ClipperLib::PolyNode* outer : tree.Childs) add_pieces(*outer, pieces);
  return pieces;
}

}  // namespace bl::geometry
