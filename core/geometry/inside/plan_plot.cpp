// Takes the plot from a domain and erodes it: a convex one by its half-planes, another one by strips along its border.
#include "core/geometry/inside/plan_plot.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include <clipper.hpp>

#include "core/base/mathematics.h"
#include "core/geometry/inside/plan_pieces.h"
#include "core/geometry/inside/plot_border.h"
#include "core/geometry/polygon_triangles.h"

namespace bl::geometry {

namespace {

// The section is taken at this share of the height: at the bottom itself planes of several pieces meet.
constexpr double kSectionShare = 1e-3;
// Sides of the plot this near to the border of the land lie on it: both come from the same corners, but for rounding [m].
constexpr double kOnBorder = 1e-5;

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

PlanPlot::Piece piece_of(PlanPolygon polygon) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  PlanPlot::Piece piece{std::move(polygon), {kFar, kFar}, {-kFar, -kFar}};
  for (const PlanPolygon::Corner& c : piece.polygon.corners) {
    piece.low = {std::min(piece.low.x, c.at.x), std::min(piece.low.y, c.at.y)};
    piece.high = {std::max(piece.high.x, c.at.x), std::max(piece.high.y, c.at.y)};
  }
  return piece;
}

// The sections of a domain that have an area.
PlanPlot::Pieces pieces_at(const Domain& domain, double z) {
  PlanPlot::Pieces pieces;
  for (const Domain::Piece& piece : domain.pieces) {
    PlanPolygon polygon = section_of(piece, z);
    if (!polygon.is_empty() && area_of(polygon) > 0) pieces.push_back(piece_of(std::move(polygon)));
  }
  return pieces;
}

// The sides of the border, or those of ground that is left out.
std::vector<BorderSide> sides_of(const PlanPlot::Pieces& pieces, const PlotOffset& by, bool is_left_out) {
  std::vector<BorderSide> sides;
  for (const PlanPlot::Piece& piece : pieces)
    for (std::size_t k = 0; k < piece.polygon.corners.size(); ++k) {
      const PlanPolygon::Corner& a = piece.polygon.corners[k];
      const PlanPoint& b = piece.polygon.corners[(k + 1) % piece.polygon.corners.size()].at;
      const double x = b.x - a.at.x, y = b.y - a.at.y, length = std::sqrt(x * x + y * y);
      if (a.beyond == PlanSide::kInner || (a.beyond == PlanSide::kLeftOut) != is_left_out || !(length > 0)) continue;
      const double away = is_left_out ? by.left_out : a.beyond == PlanSide::kStreet ? by.street : by.border;
      sides.push_back({a.at, b, {-y / length, x / length}, away});
    }
  return sides;
}

// Does a side of the border run along one of the streets?
bool is_along(const PlanPoint& from, const PlanPoint& to, std::span<const StreetAxis> streets) {
  constexpr double kCosine = 0.86602540378443865;  // of 30 degrees
  const Point3 middle{0.5 * (from.x + to.x), 0.5 * (from.y + to.y), 0};
  const double x = to.x - from.x, y = to.y - from.y, length = std::sqrt(x * x + y * y);
  for (const StreetAxis& street : streets)
    for (std::size_t k = 0; k + 1 < street.points.size(); ++k) {
      const Point3 a{street.points[k].x, street.points[k].y, 0}, b{street.points[k + 1].x, street.points[k + 1].y, 0};
      const double way = distance(a, b);
      if (!(way > 0) || std::abs((b.x - a.x) * x + (b.y - a.y) * y) < kCosine * way * length) continue;
      const double t = std::clamp(((middle.x - a.x) * (b.x - a.x) + (middle.y - a.y) * (b.y - a.y)) / (way * way), 0.0, 1.0);
      if (distance(middle, {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), 0}) <= street.reach) return true;
    }
  return false;
}

// Convex pieces of rings; where these are not simple, triangles.
std::vector<PlanPiece> convex_pieces(const std::vector<std::vector<PlanCorner>>& rings) {
  if (auto pieces = plan_pieces(rings)) return std::move(*pieces);
  std::vector<Ring> plain;
  std::vector<PlanCorner> corners;
  std::vector<std::uint32_t> next;
  for (const std::vector<PlanCorner>& ring : rings) {
    const auto first = static_cast<std::uint32_t>(corners.size());
    plain.emplace_back();
    for (std::uint32_t k = 0; k < ring.size(); ++k) {
      plain.back().push_back({ring[k].x, ring[k].y, 0});
      corners.push_back(ring[k]);
      next.push_back(k + 1 < ring.size() ? first + k + 1 : first);
    }
  }
  std::vector<PlanPiece> pieces;
  for (const auto& triangle : polygon_triangles(plain)) {
    PlanPiece& piece = pieces.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = triangle[k], to = triangle[(k + 1) % 3];
      piece.corners.push_back(corners[from]);
      piece.walls.push_back(next[from] == to ? from : PlanPiece::kNoWall);
    }
    if (!(turn(piece.corners[0], piece.corners[1], piece.corners[2]) > 0)) pieces.pop_back();
  }
  return pieces;
}

// An outer ring and its holes, as plan_pieces takes them.
void add_pieces(const ClipperLib::PolyNode& outer, const PlotGrid& grid, PlanPlot::Pieces& pieces) {
  std::vector<std::vector<PlanCorner>> rings;
  const auto add = [&](const ClipperLib::Path& path) {
    std::vector<PlanCorner>& ring = rings.emplace_back();
    for (const ClipperLib::IntPoint& p : path) ring.push_back(grid.back(p, ring.size()));
  };
  add(outer.Contour);
  for (const ClipperLib::PolyNode* hole : outer.Childs) add(hole->Contour);
  for (const PlanPiece& part : convex_pieces(rings)) {
    PlanPolygon polygon;
    for (std::size_t k = 0; k < part.corners.size(); ++k)
      polygon.corners.push_back(
          {{part.corners[k].x, part.corners[k].y}, part.walls[k] == PlanPiece::kNoWall ? PlanSide::kInner : PlanSide::kPlot});
    pieces.push_back(piece_of(std::move(polygon)));
  }
  for (const ClipperLib::PolyNode* hole : outer.Childs)
    for (const ClipperLib::PolyNode* island : hole->Childs) add_pieces(*island, grid, pieces);
}

}  // namespace

double area_of(const PlanPolygon& polygon) {
  double twice = 0;
  const std::size_t count = polygon.corners.size();
  for (std::size_t k = 1; k + 1 < count; ++k) {
    const PlanPoint &a = polygon.corners[0].at, &b = polygon.corners[k].at, &c = polygon.corners[k + 1].at;
    twice += (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  }
  return 0.5 * twice;
}

std::vector<PlanPolygon> sections_at(const Domain& domain, double z, const PlanPoint& low, const PlanPoint& high) {
  std::vector<PlanPolygon> sections;
  for (const Domain::Piece& piece : domain.pieces) {
    const Vector3 &least = piece.shape.minimum, &most = piece.shape.maximum;
    if (least.z > z || most.z < z || least.x > high.x || most.x < low.x || least.y > high.y || most.y < low.y) continue;
    if (PlanPolygon polygon = section_of(piece, z); !polygon.is_empty()) sections.push_back(std::move(polygon));
  }
  return sections;
}

Result<PlanPlot> PlanPlot::section(const Domain& domain, std::span<const StreetAxis> streets, const Domain* land) {
  PlanPlot plot;
  const double z = domain.minimum.z + kSectionShare * (domain.maximum.z - domain.minimum.z);
  plot.pieces_ = pieces_at(domain, z);
  if (plot.pieces_.empty())
    return Error{ErrorCode::infeasible, "boundary", "the boundary has no area on its ground, so nothing can stand there"};
  for (const Piece& piece : plot.pieces_) plot.area_ += area_of(piece.polygon);
  if (land != nullptr)
    if (Pieces whole = pieces_at(*land, z); plot.mark_left_out(whole)) plot.land_ = std::move(whole);
  mark_streets(plot.pieces_, streets);
  mark_streets(plot.land_, streets);
  for (const Piece& piece : plot.bordered())
    for (const PlanPolygon::Corner& corner : piece.polygon.corners) {
      plot.has_streets_ = plot.has_streets_ || corner.beyond == PlanSide::kStreet;
      plot.has_borders_ = plot.has_borders_ || corner.beyond == PlanSide::kPlot;
    }
  plot.measure_box();
  return plot;
}

void PlanPlot::measure_box() {
  low_ = pieces_.front().low;
  high_ = pieces_.front().high;
  const auto widen = [](const Pieces& pieces, PlanPoint& low, PlanPoint& high) {
    for (const Piece& piece : pieces) {
      low = {std::min(low.x, piece.low.x), std::min(low.y, piece.low.y)};
      high = {std::max(high.x, piece.high.x), std::max(high.y, piece.high.y)};
    }
  };
  widen(pieces_, low_, high_);
  PlanPoint low = low_, high = high_;
  widen(land_, low, high);
  constexpr double kRounding = 1 + 1e-9;
  const double width = high.x - low.x, depth = high.y - low.y;
  widest_ = 0.5 * kRounding * std::min(width, depth);
  farthest_ = kRounding * mathematics::hypotenuse(width, depth);
}

bool PlanPlot::mark_left_out(const Pieces& land) {
  const std::vector<BorderSide> border = sides_of(land, {}, false);
  const auto is_on_border = [&border](const PlanPoint& p) {
    return std::ranges::any_of(border, [&p](const BorderSide& side) {
      const double x = side.to.x - side.from.x, y = side.to.y - side.from.y;
      const double t = std::clamp(((p.x - side.from.x) * x + (p.y - side.from.y) * y) / (x * x + y * y), 0.0, 1.0);
      return mathematics::hypotenuse(p.x - side.from.x - t * x, p.y - side.from.y - t * y) <= kOnBorder;
    });
  };
  bool has_any = false;
  for (Piece& piece : pieces_)
    for (std::size_t k = 0; k < piece.polygon.corners.size(); ++k) {
      PlanPolygon::Corner& corner = piece.polygon.corners[k];
      const PlanPoint& next = piece.polygon.corners[(k + 1) % piece.polygon.corners.size()].at;
      if (corner.beyond != PlanSide::kPlot) continue;
      if (is_on_border({0.5 * (corner.at.x + next.x), 0.5 * (corner.at.y + next.y)})) continue;
      corner.beyond = PlanSide::kLeftOut;
      has_any = true;
    }
  return has_any;
}

void PlanPlot::mark_streets(Pieces& pieces, std::span<const StreetAxis> streets) {
  for (Piece& piece : pieces)
    for (std::size_t k = 0; k < piece.polygon.corners.size(); ++k) {
      PlanPolygon::Corner& corner = piece.polygon.corners[k];
      const PlanPoint& next = piece.polygon.corners[(k + 1) % piece.polygon.corners.size()].at;
      if (corner.beyond == PlanSide::kPlot && is_along(corner.at, next, streets)) corner.beyond = PlanSide::kStreet;
    }
}

PlotOffset PlanPlot::effective(const PlotOffset& by) const {
  return {has_borders_ ? by.border : by.street, has_streets_ ? by.street : by.border, land_.empty() ? 0 : by.left_out};
}

const PlanPlot::Pieces& PlanPlot::eroded(const PlotOffset& asked) {
  const PlotOffset by = effective(asked);
  if (!(by.border > 0 || by.street > 0 || by.left_out > 0)) return pieces_;
  // A depth that is meant as none would cost discs of its radius about all corners.
  if (is_too_far(by)) return none_;
  const auto [entry, is_new] = eroded_.try_emplace(by);
  const bool is_plain = pieces_.size() == 1 && land_.empty() && by.border == by.street;
  if (is_new) entry->second = is_plain ? erode_convex(by.border) : erode_rings(by);
  return entry->second;
}

void PlanPlot::keep_only(std::vector<PlotOffset> used) {
  for (PlotOffset& by : used) by = effective(by);
  std::sort(used.begin(), used.end());
  std::erase_if(eroded_, [&used](const auto& entry) { return !std::binary_search(used.begin(), used.end(), entry.first); });
}

const PlanPlot::Pieces* PlanPlot::made(const PlotOffset& asked) const {
  const PlotOffset by = effective(asked);
  if (!(by.border > 0 || by.street > 0 || by.left_out > 0)) return &pieces_;
  if (is_too_far(by)) return &none_;
  const auto entry = eroded_.find(by);
  return entry == eroded_.end() ? nullptr : &entry->second;
}

PlanPlot::Pieces PlanPlot::erode_convex(double by) const {
  const PlanPolygon& whole = pieces_.front().polygon;
  PlanPolygon rest = whole, spare;
  for (std::size_t k = 0; k < whole.corners.size(); ++k) {
    const PlanPoint &a = whole.corners[k].at, &b = whole.corners[(k + 1) % whole.corners.size()].at;
    const double length = mathematics::hypotenuse(b.x - a.x, b.y - a.y);
    if (!(length > 0)) continue;
    const double x = (b.y - a.y) / length, y = (a.x - b.x) / length;
    clip(rest, {x, y, x * a.x + y * a.y - by}, PlanSide::kPlot, spare);
  }
  Pieces pieces;
  if (!rest.is_empty()) pieces.push_back(piece_of(std::move(rest)));
  return pieces;
}

PlanPlot::Pieces PlanPlot::erode_rings(const PlotOffset& by) const {
  PlotGrid grid(low_);
  ClipperLib::Clipper joiner;
  for (const Piece& piece : pieces_) {
    ClipperLib::Path path;
    for (const PlanPolygon::Corner& c : piece.polygon.corners) path.push_back(grid.of(c.at));
    joiner.AddPath(path, ClipperLib::ptSubject, true);
  }
  // Joined first: of pieces side by side, a difference can leave the side between them as a border.
  ClipperLib::Paths whole;
  joiner.Execute(ClipperLib::ctUnion, whole, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
  ClipperLib::Clipper clipper;
  clipper.StrictlySimple(true);
  clipper.AddPaths(whole, ClipperLib::ptSubject, true);
  take_away(sides_of(bordered(), by, false), by.border != by.street ? SideEnds::both : SideEnds::between, grid, clipper);
  take_away(sides_of(pieces_, by, true), SideEnds::of_lines, grid, clipper);
  ClipperLib::PolyTree tree;
  clipper.Execute(ClipperLib::ctDifference, tree, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
  Pieces pieces;
  for (const ClipperLib::PolyNode* outer : tree.Childs) add_pieces(*outer, grid, pieces);
  return pieces;
}

}  // namespace bl::geometry
