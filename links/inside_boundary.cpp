// Keeps nodes inside a boundary, at least a margin away from its sides.
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/text.h"
#include "core/define/link_builder.h"
#include "core/define/registry.h"
#include "core/geometry/domain.h"

namespace bl {

namespace {

struct InsideBoundary {
  struct In {
    double margin = 0;
  };
  struct Ends {
    std::shared_ptr<const geometry::Domain> domain;
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
            "Moves nodes that are outside a boundary, or nearer to its sides than the margin, back inside in one tick by the "
            "shortest way. Nodes inside are left alone.");
    l.param(&In::margin, "margin")
        .unit(Unit::metre)
        .min(0)
        .soft(0, 10)
        .doc("The least distance of a node's position from the sides of the boundary. A margin that leaves no room is an error.");
    l.reads(&Ends::domain, End::from, "boundary.domain");
    l.reads(&Ends::position, End::to, "node.position", Unit::metre);
    l.proposes(&Out::move, End::to, "node.position", Unit::metre);
  }

  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick&) {
    if (!ends.domain) return Out{};
    std::optional<Vector3> best;
    for (const geometry::Domain::Piece& piece : ends.domain->pieces) {
      if (outside(piece, in.margin, ends.position) <= 1e-9) return Out{};
      const Point3 nearest = projected(piece, in.margin, ends.position);
      if (!(outside(piece, in.margin, nearest) <= 1e-3)) continue;
      if (!best || norm(nearest - ends.position) < norm(*best)) best = nearest - ends.position;
    }
    if (!best)
      return Error{ErrorCode::infeasible, "margin",
                   "a margin of " + shortest(in.margin) + " m leaves no room inside the boundary; make it smaller"};
    return Out{best};
  }

 private:
  // Inside is where dot(normal, p) is at most this. The margin is kept from the surface, not from the faces between two pieces.
  static double offset_of(const geometry::Domain::Piece& piece, std::size_t side, double margin) {
    return piece.shape.planes[side].offset - (piece.sides[side] == geometry::Domain::kInner ? 0 : margin);
  }

  // The largest distance by which the point lies outside a side.
  static double outside(const geometry::Domain::Piece& piece, double margin, const Point3& point) {
    double largest = 0;
    for (std::size_t s = 0; s < piece.sides.size(); ++s)
      largest = std::max(largest, dot(piece.shape.planes[s].normal, point) - offset_of(piece, s, margin));
    return largest;
  }

  // The nearest point inside all sides, by Dykstra's algorithm: projections on one side after the other, each of which first
  // undoes its correction of the round before. Where that converges slowly, plain projections still find some point inside.
  static Point3 projected(const geometry::Domain::Piece& piece, double margin, Point3 point) {
    constexpr int kNearest = 500, kRounds = 1000;
    std::vector<double> pushed(piece.sides.size(), 0);
    for (int round = 0; round < kRounds; ++round) {
      double change = 0;
      for (std::size_t s = 0; s < piece.sides.size(); ++s) {
        const Vector3& normal = piece.shape.planes[s].normal;
        const double before = round < kNearest ? pushed[s] : 0;
        pushed[s] = std::max(0.0, dot(normal, point) + before - offset_of(piece, s, margin));
        point += normal * (before - pushed[s]);
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
