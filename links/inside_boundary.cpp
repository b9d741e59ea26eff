// Keeps nodes inside a boundary, at least a margin away from its sides.
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/base/text.h"
#include "core/define/link_builder.h"
#include "core/define/registry.h"

namespace bl {

namespace {

struct InsideBoundary {
  struct In {
    double margin = 0;
  };
  struct Ends {
    Shared<Table> planes;
    Point3 position;
  };
  struct Out {
    std::optional<Vector3> move;
  };

  static void declare(LinkBuilder<InsideBoundary>& l) {
    l.family(LinkFamily::brief);
    l.id("inside_boundary")
        .label("Inside boundary")
        .doc(
            "Brings nodes that are outside a boundary, or nearer to its sides than the margin, back inside by the shortest way "
            "and in one "
            "tick. Nodes inside are left alone.");
    l.param(&In::margin, "margin")
        .unit(Unit::metre)
        .min(0)
        .soft(0, 10)
        .doc("How far inside the sides of the boundary a node's position must be; it must leave some room.");
    l.reads(&Ends::planes, End::from, "boundary.planes");
    l.reads(&Ends::position, End::to, "node.position", Unit::metre);
    l.proposes(&Out::move, End::to, "node.position", Unit::metre);
  }

  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick&) {
    const std::vector<Piece> pieces = pieces_of(*ends.planes, in.margin);
    if (pieces.empty()) return Out{};
    std::optional<Vector3> best;
    for (const Piece& sides : pieces) {
      if (outside(sides, ends.position) <= 1e-9) return Out{};
      const Point3 nearest = projected(sides, ends.position);
      if (!(outside(sides, nearest) <= 1e-3)) continue;
      if (!best || norm(nearest - ends.position) < norm(*best)) best = nearest - ends.position;
    }
    if (!best)
      return Error{ErrorCode::infeasible, "margin",
                   "a margin of " + shortest(in.margin) + " m leaves no room inside the boundary; make it smaller"};
    return Out{best};
  }

 private:
  // Inside is where dot(normal, p) <= offset; the normal has length 1.
  struct Side {
    Vector3 normal;
    double offset;
  };
  using Piece = std::vector<Side>;

  // The margin is kept from the surface, not from the faces between two pieces.
  static std::vector<Piece> pieces_of(const Table& planes, double margin) {
    std::vector<Piece> pieces;
    for (std::size_t row = 0; row < planes.rows.size(); ++row) {
      const Vector3 normal{planes.number(row, "x"), planes.number(row, "y"), planes.number(row, "z")};
      const double length = norm(normal);
      if (row == 0 || planes.number(row, "piece") != planes.number(row - 1, "piece")) pieces.emplace_back();
      const double room = planes.number(row, "side") < 0 ? 0 : margin;
      if (length > 0) pieces.back().push_back({normal / length, planes.number(row, "offset") / length - room});
    }
    return pieces;
  }

  // How far the point is outside the side that it is furthest outside of.
  static double outside(const Piece& sides, const Point3& point) {
    double largest = 0;
    for (const Side& side : sides) largest = std::max(largest, dot(side.normal, point) - side.offset);
    return largest;
  }

  // The nearest point inside all sides: projections on one side after the other, each of which first takes back what it did
  // the round before (the algorithm of Dykstra). Where that is slow, plain projections still find some point inside.
  static Point3 projected(const Piece& sides, Point3 point) {
    constexpr int kNearest = 500, kRounds = 1000;
    std::vector<double> pushed(sides.size(), 0);
    for (int round = 0; round < kRounds; ++round) {
      double change = 0;
      for (std::size_t s = 0; s < sides.size(); ++s) {
        const double before = round < kNearest ? pushed[s] : 0;
        pushed[s] = std::max(0.0, dot(sides[s].normal, point) + before - sides[s].offset);
        point += sides[s].normal * (before - pushed[s]);
        change = std::max(change, std::abs(pushed[s] - before));
      }
      if (change < 1e-9) break;
    }
    return point;
  }
};

}  // namespace

}  // namespace bl

BL_LINK(inside_boundary, InsideBoundary)
