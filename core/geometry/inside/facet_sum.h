// What the edges of one facet add up to inside a ball: its area, its solid angle and its moment, in closed form.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/mathematics.h"
#include "core/base/vector.h"

namespace bl::geometry {

// A sum of angles as a product of complex numbers with the full turns counted: one arctangent for the whole sum.
class AngleSum {
 public:
  /// Adds the angle of (re, im), taken in (-π, π).
  void add(double re, double im) {
    if (im == 0) return;  // an edge through the centre spans no angle, whichever side it is seen from
    const double next_re = re_ * re - im_ * im, next_im = re_ * im + im_ * re;
    // Without a branch on the sign, which nobody could foretell.
    turns_ += static_cast<int>(im > 0) & static_cast<int>(im_ >= 0) & static_cast<int>(next_im < 0);
    turns_ -= static_cast<int>(im < 0) & static_cast<int>(im_ < 0) & static_cast<int>(next_im >= 0);
    re_ = next_re;
    im_ = next_im;
    const double size = std::abs(re_) + std::abs(im_);
    if (size < 1e-60 || size > 1e60) {
      re_ /= size;
      im_ /= size;
    }
  }
  double value() const {
    // Nothing was added, or nothing but angles that cancel: the arctangent would be an exact zero.
    const double rest = im_ == 0 && re_ > 0 ? 0 : mathematics::arc_tangent(im_, re_);
    return rest + 2 * std::numbers::pi * turns_;
  }
  int turns() const { return turns_; }

 private:
  double re_ = 1, im_ = 0;
  int turns_ = 0;
};

// A corner of a facet: relative to the ball's centre.
struct Place {
  Point3 at;
  double norm = 0;         // |at|, which only sums of solid angles ask for
  bool is_inside = false;  // of the ball

  static Place of(const Point3& at, double squared_radius) {
    const double squared = squared_norm(at);
    return {at, std::sqrt(squared), squared <= squared_radius};
  }
  static Place flat(const Point3& at, double squared_radius) { return {at, 0, squared_norm(at) <= squared_radius}; }
};

// A direction in a facet's plane: from the foot of the centre to a place. No direction where the place is the foot.
struct Spoke {
  Vector3 unit;
  bool is_there = false;
};

// One facet with unit normal n on the plane n·x = h: what its edges add up to. With q = h n the foot of the centre and ρ the
// radius of the facet's disc, an edge piece a→b inside the ball contributes twice the area n·(a×b) of the triangle q a b. A
// piece outside contributes a sector of the disc: with θ the angle of (a-q)·(b-q) + i n·(a×b), the area ρ²θ/2; and to the solid
// angle of what lies outside the ball that of the triangle q a b, seen from the centre, less that of the sector:
// Ω - (1 - |h|/r) θ with tan(Ω/2) = h n·(a×b) / (|h| (|a||b| + |h|(|a|+|b|) + a·b)) (van Oosterom and Strackee 1983).
// Edges inside the ball leave this solid angle alone, so a centre on a facet, an edge or a corner is no special case. The other
// way round, the solid angle of what lies inside the ball is that of the triangles of edges inside, plus the sectors; it spares
// whatever lies beyond the ball, but is no good where the centre lies almost on a facet.
class FacetSum {
 public:
  /// `solid` (or null) sums half the solid angle of the triangles: of edges inside the ball, or of edges outside it.
  FacetSum(const Vector3& normal, double offset, double squared_radius, AngleSum* solid, bool counts_inside = false)
      : normal_(normal),
        offset_(offset),
        squared_radius_(squared_radius),
        radius_(std::sqrt(squared_radius)),
        squared_disc_(squared_radius - offset * offset),
        rim_moment_(squared_disc_ > 0 ? squared_disc_ * std::sqrt(squared_disc_) / 3 : 0),
        inner_solid_(counts_inside ? solid : nullptr),
        outer_solid_(counts_inside ? nullptr : solid) {}

  /// Does the plane cut the ball at all?
  bool has_disc() const { return squared_disc_ > 0; }

  Spoke spoke_to(const Place& place) const {
    const Vector3 way = place.at - offset_ * normal_;
    const double length = norm(way);
    return length > 0 ? Spoke{way / length, true} : Spoke{};
  }

  /// The edge is worked out from `low` to `high` whichever way the facet's loop goes along it (`turn` is 1, or -1 against it):
  /// both of its facets get the same bits. The spokes count only for a moment, and only to places outside the ball.
  void add_edge(const Place& low, const Place& high, double turn, const Spoke& to_low = {}, const Spoke& to_high = {}) {
    if (low.is_inside && high.is_inside) return inside(low, high, turn);
    if (!has_disc()) return outside(low, high, turn, to_low, to_high);
    const auto spoke_on_rim = [&](const Place& place) { return with_moment ? spoke_to(place) : Spoke{}; };
    const Vector3 along = high.at - low.at;
    const double squared_length = squared_norm(along), t = dot(low.at, along);
    const double rest = t * t + squared_length * (squared_radius_ - squared_norm(low.at));
    const bool is_chord = !low.is_inside && !high.is_inside;
    if (!(rest > 0) || (is_chord && !(t < 0 && -t < squared_length))) {
      // A place on the sphere may come here as one inside.
      return outside(low, high, turn, low.is_inside ? spoke_on_rim(low) : to_low, high.is_inside ? spoke_on_rim(high) : to_high);
    }
    const double root = std::sqrt(rest);
    const auto pierced = [&](double numerator) {
      return Place{low.at + std::clamp(numerator / squared_length, 0.0, 1.0) * along, radius_, true};
    };
    if (is_chord) {
      const Place entry = pierced(-t - root), exit = pierced(-t + root);
      outside(low, entry, turn, to_low, spoke_on_rim(entry));
      inside(entry, exit, turn);
      outside(exit, high, turn, spoke_on_rim(exit), to_high);
    } else {
      const Place pierce = pierced(low.is_inside ? -t + root : -t - root);
      const Spoke to_pierce = spoke_on_rim(pierce);
      low.is_inside ? inside(low, pierce, turn) : outside(low, pierce, turn, to_low, to_pierce);
      low.is_inside ? outside(pierce, high, turn, to_pierce, to_high) : inside(pierce, high, turn);
    }
  }

  /// After the last edge.
  void close() {
    // Where the rim meets no edge the facet holds the whole disc or nothing of it, and the turns say which.
    const double angle = meets_edge_ ? outer_.value() : outer_.turns() > 0 ? 2 * std::numbers::pi : 0;
    area = std::max(0.0, 0.5 * (doubled_ + squared_disc_ * angle));
    if (!meets_edge_) moment = {};
    sectors = squared_disc_ / (radius_ * (radius_ + std::abs(offset_))) * angle;
  }

  double area = 0;     // inside the ball
  double sectors = 0;  // solid angle of the sectors of the disc
  Vector3 moment;      // first moment in the plane, about the foot; where asked for
  bool with_moment = false;

 private:
  void add_triangle(AngleSum* solid, double area_twice, double a_norm, double b_norm, double cosine) const {
    const double height = std::abs(offset_);
    solid->add((a_norm * b_norm + height * (a_norm + b_norm) + cosine) / squared_radius_,
               (offset_ < 0 ? -area_twice : area_twice) / squared_radius_);
  }

  void inside(const Place& a, const Place& b, double turn) {
    const double area_twice = turn * dot(normal_, cross(a.at, b.at));
    meets_edge_ = true;
    doubled_ += area_twice;
    if (inner_solid_ != nullptr) add_triangle(inner_solid_, area_twice, a.norm, b.norm, dot(a.at, b.at));
    if (with_moment) moment += (area_twice / 6) * (a.at + b.at - (2 * offset_) * normal_);
  }

  void outside(const Place& a, const Place& b, double turn, const Spoke& to_a, const Spoke& to_b) {
    const double area_twice = turn * dot(normal_, cross(a.at, b.at)), cosine = dot(a.at, b.at);
    if (outer_solid_ != nullptr) add_triangle(outer_solid_, area_twice, a.norm, b.norm, cosine);
    if (!has_disc()) return;
    outer_.add((cosine - offset_ * offset_) / squared_radius_, area_twice / squared_radius_);
    if (!with_moment || !to_a.is_there || !to_b.is_there) return;
    moment += (turn * rim_moment_) * cross(to_b.unit - to_a.unit, normal_);
  }

  Vector3 normal_;
  double offset_, squared_radius_, radius_, squared_disc_, rim_moment_;
  AngleSum *inner_solid_, *outer_solid_;
  AngleSum outer_;
  double doubled_ = 0;
  bool meets_edge_ = false;
};

}  // namespace bl::geometry
