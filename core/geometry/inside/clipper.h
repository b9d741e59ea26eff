// A convex polyhedron that is cut by one plane after the other: the working shape behind cells and domains.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/base/vector.h"
#include "core/geometry/inside/plane_side.h"
#include "core/geometry/inside/polyhedron.h"

namespace bl::geometry {

/// Kept so that a cut touches little memory and allocates nothing once warm: exactly three faces meet at each vertex (a corner
/// of the shape where more meet is several vertices at one place), vertices know their three neighbours, coordinates lie in
/// arrays of their own. A cut judges each vertex once: beyond the plane by more than a tolerance, or not. What goes is the
/// connected part around the farthest vertex beyond; so the polyhedron stays a closed surface whatever the rounding says.
class Clipper {
 public:
  /// A polyhedron to start from, made once and copied often.
  class Start {
   public:
    /// `sides` (one per plane, or empty): the number that the face of plane k carries; kInnerSide makes it an inner face.
    explicit Start(const ConvexDomain& domain, const std::vector<std::uint32_t>& sides = {});

   private:
    friend class Clipper;
    struct Side {
      Vector3 normal;
      Point3 anchor;  ///< a corner on the plane [m]
      FaceKind kind;
      std::uint32_t index;
    };
    std::vector<Point3> vertices_;  // [m], not relative to any site
    std::vector<std::array<std::uint32_t, 6>> corners_;
    std::vector<Side> sides_;
  };
  static constexpr std::uint32_t kInnerSide = 0xffffffffu;

  void start(const Start& from, const Point3& origin);
  /// An axis-parallel box; its faces are (frame, 0..5).
  void start_box(const Vector3& minimum, const Vector3& maximum);
  /// Goes on from another clipper's shape.
  void copy(const Clipper& other);
  /// Keeps normal·x <= offset, `normal` a unit vector. False when nothing is left.
  bool cut(const Vector3& normal, double offset, FaceKind kind, std::uint32_t index);
  /// Cuts by all planes of a piece that come nearer to `origin`, its new origin, than `limit` [m]. False: nothing is left.
  bool cut(const Start& piece, const Point3& origin, double limit);

  bool is_empty() const { return size_ == 0; }
  /// Measures how far the shape reaches along some directions, for is_clear_of(); cuts that follow only make it smaller.
  void measure_reaches();
  /// Is it sure that a cut by along·x <= most takes nothing away, nor comes near? A cheap look that often says no although it is.
  bool is_clear_of(const Vector3& along, double most) const;
  /// Planes so far: one more after a cut that took something away.
  std::size_t side_count() const { return sides_.size(); }
  /// Largest squared distance of a vertex from the origin [m²].
  double reach_squared() const { return reach_squared_; }
  double reach() const { return reach_; }
  /// Has some vertex come so near to a plane that the order of the cuts may show in the result?
  bool is_touchy() const { return is_touchy_; }
  /// Is all that is left a plate no thicker than what counts as touching? Planes that meet face to face leave such plates.
  bool is_flat() const;

  /// Faces that lie on a side of the boundary, which has to be one of this piece, are that side's.
  void name_by(const Start& piece, const Point3& origin);

  /// The shape in a form that does not depend on the order of the cuts (unless it is touchy): faces by kind and index, loops
  /// from a fixed corner on, every vertex computed anew from its three planes. False where three planes meet so flatly that a
  /// vertex had to stay where the cuts have put it.
  /// Faces whose planes lie at `limit` [m] or farther may be left out, for who does not look beyond: the polyhedron is open then,
  /// and its reach infinite.
  bool finish(Polyhedron& out, double limit = std::numeric_limits<double>::infinity());
  /// The same with every vertex where the cuts have put it: good for shapes where many planes meet in one corner.
  void finish_as_cut(Polyhedron& out);

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  /// The three faces that meet at a vertex, counter-clockwise seen from outside, and the edges: the one in slot k does not lie on
  /// face plane[k]. An edge is kept as 4 * vertex + slot: the vertex at its other end, and the slot there of the edge that
  /// follows around the face on the left, so that a walk around a face reads one number per corner.
  struct alignas(32) Corner {
    std::array<std::uint32_t, 3> plane, next;
    std::uint32_t given;  ///< kNone, or: the vertex was there from the start and keeps its place
  };
  struct Side {
    Vector3 normal;
    double offset;
    FaceKind kind;
    std::uint32_t index;
  };
  /// A vertex that a cut makes on the edge from a vertex that stays to one that goes.
  struct Fresh {
    Point3 at;
    std::uint32_t kept;
    std::uint32_t back;         ///< slot of `kept` whose edge leads to the new one
    std::uint32_t left, right;  ///< faces of the edge: the next fresh vertex around the cut lies on `right` too
  };

  void reserve(std::size_t vertices);
  void set_place(std::uint32_t vertex, const Point3& at);
  void measure_reach();
  double tolerance() const;  ///< touching, not cut [m]
  bool judge(const Vector3& normal, double offset, double tolerance);
  static std::uint32_t end_of(std::uint32_t edge) { return edge / 4; }
  static std::uint32_t edge_to(std::uint32_t vertex, std::uint32_t slot_back);
  static std::uint32_t slot_back(std::uint32_t edge);
  bool is_taken(std::uint32_t vertex) const { return (taken_[vertex / 64] >> (vertex % 64) & 1u) != 0; }
  std::uint32_t find_rim();
  void place_fresh(std::uint32_t count);
  bool is_ring(std::uint32_t count) const;
  void untangle(double tolerance);
  void close_rim(std::uint32_t plane, std::uint32_t count);
  void remove_taken(std::uint32_t fresh);
  void move_vertex(std::uint32_t from, std::uint32_t to);
  bool meeting_point(const Corner& corner, Point3& at) const;
  void rank_sides();
  bool write(Polyhedron& out, bool is_exact, double limit);
  void write_face(Polyhedron& out, std::uint32_t first_edge);
  void write_split_faces(Polyhedron& out);
  bool write_vertices(Polyhedron& out, bool is_exact) const;

  std::uint32_t size_ = 0;
  double reach_squared_ = 0, reach_ = 0, start_reach_ = 0;
  bool is_touchy_ = false;
  std::vector<double> x_, y_, z_;
  std::vector<double> squared_;  // distances from the origin [m²]
  std::vector<double> beyond_;   // signed distances from the plane that is being cut with [m]
  std::vector<Corner> corners_;
  std::vector<Side> sides_;
  Reaches reaches_;
  bool has_reaches_ = false;
  std::vector<std::uint64_t> taken_;    // a bit per vertex: goes with the cut under way
  std::vector<std::uint32_t> leaving_;  // the vertices that go: the first leaving_count_ of them
  std::uint32_t leaving_count_ = 0;
  std::vector<std::uint32_t> rim_;  // edges from vertices that go to vertices that stay: 4 * vertex that goes + slot there
  std::vector<Fresh> fresh_;
  std::vector<std::uint32_t> left_of_;  // per face: the fresh vertex that has it on its left
  // What is worked out when the shape is written: ranks of the sides, numbers of the vertices in the order in which they are
  // seen.
  struct Key {
    std::int32_t name;
    std::uint32_t side;
  };
  std::vector<Key> keys_;
  std::vector<std::uint32_t> rank_, order_, first_edge_, number_, loop_, seen_;
  std::uint32_t seen_count_ = 0;
};

}  // namespace bl::geometry
