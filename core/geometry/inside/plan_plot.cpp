// Takes the plot from a domain and erodes it: a convex one by its half-planes, another one by strips along its border.
#include "core/geometry/inside/plan_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include <clipper.hpp>

#include "core/base/mathematics.h"
#include "core/geometry/inside/plan_pieces.h"
#include "core/geometry/polygon_triangles.h"

namespace bl::geometry {

namespace {

constexpr double kGrid = 1e8;  // steps of the Clipper library's integers in a metre
// About the largest distance of a chord from its arc [m]: of arcs that are seen whole, so that the area is right all the same,
// and of others.
constexpr double kArcTolerance = 1e-4, kPartTolerance = 4e-6;
constexpr ClipperLib::cInt kSameStep = 4;
constexpr double kStripMargin = 1e-6;  // [m]
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

PlanPlot::Piece piece_of(PlanPolygon polygon) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  PlanPlot::Piece piece{std::move(polygon), {kFar, kFar}, {-kFar, -kFar}};
  for (const PlanPolygon::Corner& c : piece.polygon.corners) {
    piece.low = {std::min(piece.low.x, c.at.x), std::min(piece.low.y, c.at.y)};
    piece.high = {std::max(piece.high.x, c.at.x), std::max(piece.high.y, c.at.y)};
  }
  return piece;
}

// Places on the grid. Corners of several pieces at one place get the same numbers, whichever way each was rounded: those of the
// first one that is near enough.
class PlotGrid {
 public:
  explicit PlotGrid(const PlanPoint& origin) : origin_(origin) {}

  std::size_t number_of(const PlanPoint& p) {
    const ClipperLib::IntPoint at = exactly(p);
    const Square square = square_of(at);
    std::size_t first = known_.size();
    for (ClipperLib::cInt x = square.first - 1; x <= square.first + 1; ++x)
      for (ClipperLib::cInt y = square.second - 1; y <= square.second + 1; ++y)
        if (const auto found = squares_.find({x, y}); found != squares_.end())
          for (const std::size_t k : found->second)
            if (std::abs(known_[k].X - at.X) <= kSameStep && std::abs(known_[k].Y - at.Y) <= kSameStep)
              first = std::min(first, k);
    if (first < known_.size()) return first;
    squares_[square].push_back(first);
    known_.push_back(at);
    return first;
  }
  std::size_t count() const { return known_.size(); }
  ClipperLib::IntPoint of(const PlanPoint& p) { return known_[number_of(p)]; }
  ClipperLib::IntPoint exactly(const PlanPoint& p) const { return {step(p.x - origin_.x), step(p.y - origin_.y)}; }
  PlanCorner back(const ClipperLib::IntPoint& p, std::size_t number) const {
    return {origin_.x + static_cast<double>(p.X) / kGrid, origin_.y + static_cast<double>(p.Y) / kGrid, number};
  }

 private:
  using Square = std::pair<ClipperLib::cInt, ClipperLib::cInt>;

  static ClipperLib::cInt step(double metres) { return static_cast<ClipperLib::cInt>(std::llround(metres * kGrid)); }
  // Places that are the same lie in one square or in squares side by side.
  static Square square_of(const ClipperLib::IntPoint& p) {
    const auto of = [](ClipperLib::cInt at) { return at / kSameStep - (at % kSameStep < 0 ? 1 : 0); };
    return {of(p.X), of(p.Y)};
  }

  PlanPoint origin_;
  std::vector<ClipperLib::IntPoint> known_;
  std::map<Square, std::vector<std::size_t>> squares_;
};

// A side of the border, with the inside on its left; `normal` points inwards. Nothing is built nearer than `by` to it [m].
struct BorderSide {
  PlanPoint from, to, normal;
  double by = 0;
};

std::vector<BorderSide> border_of(const PlanPlot::Pieces& pieces, const PlotOffset& by) {
  std::vector<BorderSide> sides;
  for (const PlanPlot::Piece& piece : pieces)
    for (std::size_t k = 0; k < piece.polygon.corners.size(); ++k) {
      const PlanPolygon::Corner& a = piece.polygon.corners[k];
      const PlanPoint& b = piece.polygon.corners[(k + 1) % piece.polygon.corners.size()].at;
      const double x = b.x - a.at.x, y = b.y - a.at.y, length = std::sqrt(x * x + y * y);
      if (a.beyond != PlanSide::kInner && length > 0)
        sides.push_back({a.at, b, {-y / length, x / length}, a.beyond == PlanSide::kStreet ? by.street : by.border});
    }
  return sides;
}

// The sector of a disc about a corner, from one direction clockwise to another one.
struct Fan {
  PlanPoint at, from, to;
  double by = 0;                     // [m]
  double tolerance = kArcTolerance;  // [m]
};

// Where all sides have one distance: what is too near to an inner corner lies between the feet of its two sides, or in front of
// one of them.
std::optional<Fan> fan_between(const BorderSide& before, const BorderSide& after) {
  const PlanPoint &n = before.normal, &m = after.normal;
  // To the right of the way, by more than rounding does.
  const bool is_inner = n.x * m.y - n.y * m.x < -1e-9;
  return is_inner ? std::optional<Fan>({after.from, n, m, before.by, kArcTolerance}) : std::nullopt;
}

// Both ends of a side. Where distances differ, what is too near to one may lie behind another side.
std::array<Fan, 2> ends_of(const BorderSide& side) {
  const PlanPoint &n = side.normal, opposite{-n.x, -n.y};
  return {Fan{side.from, opposite, n, side.by, kPartTolerance}, Fan{side.to, n, opposite, side.by, kPartTolerance}};
}

// With chords in place of its arc that cut as much away as they add, so that the area is that of the sector.
ClipperLib::Path path_of(const Fan& fan, PlotGrid& grid) {
  const PlanPoint &n = fan.from, &m = fan.to, &at = fan.at;
  const double by = fan.by;
  double angle = mathematics::arc_tangent(n.y * m.x - n.x * m.y, n.x * m.x + n.y * m.y);
  if (angle < 0) angle += 2 * std::numbers::pi;
  const double widest = 2 * std::sqrt(2 * fan.tolerance / by);
  const int count = std::clamp(static_cast<int>(std::ceil(angle / widest)), 3, 4096);
  const double step = angle / count, inner = count - 2.0;
  const double radius = by * (std::sqrt(1 + inner * angle / mathematics::sine(step)) - 1) / inner;
  ClipperLib::Path path{grid.of(at), grid.exactly({at.x + by * n.x, at.y + by * n.y})};
  for (int k = 1; k < count; ++k) {
    const double x = mathematics::cosine(k * step), y = -mathematics::sine(k * step);
    path.push_back(grid.exactly({at.x + radius * (n.x * x - n.y * y), at.y + radius * (n.x * y + n.y * x)}));
  }
  path.push_back(grid.exactly({at.x + by * m.x, at.y + by * m.y}));
  return path;
}

// What is in front of a side, and where distances differ as far behind it. Longer and wider by next to nothing, so that strips,
// sectors and the border have no sides in common.
ClipperLib::Path strip_of(const BorderSide& side, bool is_behind, const PlotGrid& grid) {
  const PlanPoint& n = side.normal;
  const double by = side.by, behind = is_behind ? by : kStripMargin;
  const PlanPoint a{side.from.x - kStripMargin * n.y, side.from.y + kStripMargin * n.x},
      b{side.to.x + kStripMargin * n.y, side.to.y - kStripMargin * n.x};
  return {grid.exactly({a.x - behind * n.x, a.y - behind * n.y}), grid.exactly({b.x - behind * n.x, b.y - behind * n.y}),
          grid.exactly({b.x + by * n.x, b.y + by * n.y}), grid.exactly({a.x + by * n.x, a.y + by * n.y})};
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

Result<PlanPlot> PlanPlot::section(const Domain& domain, std::span<const StreetAxis> streets) {
  PlanPlot plot;
  const double z = domain.minimum.z + kSectionShare * (domain.maximum.z - domain.minimum.z);
  for (const Domain::Piece& piece : domain.pieces) {
    PlanPolygon polygon = section_of(piece, z);
    const double area = polygon.is_empty() ? 0 : area_of(polygon);
    if (!(area > 0)) continue;
    plot.area_ += area;
    plot.mark_sides(polygon, streets);
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
  constexpr double kRounding = 1 + 1e-9;
  const double width = plot.high_.x - plot.low_.x, depth = plot.high_.y - plot.low_.y;
  plot.widest_ = 0.5 * kRounding * std::min(width, depth);
  plot.farthest_ = kRounding * mathematics::hypotenuse(width, depth);
  return plot;
}

void PlanPlot::mark_sides(PlanPolygon& polygon, std::span<const StreetAxis> streets) {
  for (std::size_t k = 0; k < polygon.corners.size(); ++k) {
    PlanPolygon::Corner& corner = polygon.corners[k];
    if (corner.beyond != PlanSide::kPlot) continue;
    const bool is_street = is_along(corner.at, polygon.corners[(k + 1) % polygon.corners.size()].at, streets);
    if (is_street) corner.beyond = PlanSide::kStreet;
    (is_street ? has_streets_ : has_borders_) = true;
  }
}

PlotOffset PlanPlot::effective(const PlotOffset& by) const {
  return {has_borders_ ? by.border : by.street, has_streets_ ? by.street : by.border};
}

const PlanPlot::Pieces& PlanPlot::eroded(const PlotOffset& asked) {
  const PlotOffset by = effective(asked);
  if (!(by.border > 0 || by.street > 0)) return pieces_;
  // A depth that is meant as none would cost discs of its radius about all corners.
  if (is_too_far(by)) return none_;
  const auto [entry, is_new] = eroded_.try_emplace(by);
  if (is_new) entry->second = pieces_.size() == 1 && by.border == by.street ? erode_convex(by.border) : erode_rings(by);
  return entry->second;
}

void PlanPlot::keep_only(std::vector<PlotOffset> used) {
  for (PlotOffset& by : used) by = effective(by);
  std::sort(used.begin(), used.end());
  std::erase_if(eroded_, [&used](const auto& entry) { return !std::binary_search(used.begin(), used.end(), entry.first); });
}

const PlanPlot::Pieces* PlanPlot::made(const PlotOffset& asked) const {
  const PlotOffset by = effective(asked);
  if (!(by.border > 0 || by.street > 0)) return &pieces_;
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
  const std::vector<BorderSide> border = border_of(pieces_, by);
  const bool is_mixed = by.border != by.street;
  const auto take_away = [&clipper, &grid](const Fan& fan) {
    ClipperLib::Path path = path_of(fan, grid);
    if (!ClipperLib::Orientation(path)) ClipperLib::ReversePath(path);
    clipper.AddPath(path, ClipperLib::ptClip, true);
  };
  std::vector<std::vector<std::size_t>> leaving;  // per corner: the sides that begin there
  for (std::size_t k = 0; !is_mixed && k < border.size(); ++k) {
    const std::size_t corner = grid.number_of(border[k].from);
    leaving.resize(grid.count());
    leaving[corner].push_back(k);
  }
  // A strip along each side, and about corners what the strips of both sides leave out.
  for (const BorderSide& side : border) {
    if (!(side.by > 0)) continue;
    clipper.AddPath(strip_of(side, is_mixed, grid), ClipperLib::ptClip, true);
    if (is_mixed)
      for (const Fan& end : ends_of(side)) take_away(end);
    const std::size_t corner = is_mixed ? leaving.size() : grid.number_of(side.to);
    for (std::size_t k = 0; corner < leaving.size() && k < leaving[corner].size(); ++k)
      if (const std::optional<Fan> fan = fan_between(side, border[leaving[corner][k]])) take_away(*fan);
  }
  ClipperLib::PolyTree tree;
  clipper.Execute(ClipperLib::ctDifference, tree, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
  Pieces pieces;
  for (const ClipperLib::PolyNode* outer : tree.Childs) add_pieces(*outer, grid, pieces);
  return pieces;
}

}  // namespace bl::geometry
