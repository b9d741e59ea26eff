// Strips in x between all corners and crossings of the outlines: in each the parts are stretches of y, united in order.
#include "core/geometry/inside/plan_cover.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/geometry/inside/shape_outline.h"

namespace bl::geometry {

namespace {

// Of the shape's extent: what is narrower in plan is rounding.
constexpr double kNarrowShare = 1e-12;
// A wall that leans less than this is upright.
constexpr double kUprightLean = 1e-12;
// Planes this nearly parallel meet the ball in one circle or in two that do not cross.
constexpr double kOneCircle = 1e-20;

struct PlanBox {
  double low_x = std::numeric_limits<double>::infinity(), low_y = low_x, high_x = -low_x, high_y = -low_x;
};

PlanBox box_in_plan(const Polyhedron& part) {
  PlanBox box;
  for (const Point3& v : part.vertices) {
    box.low_x = std::min(box.low_x, v.x);
    box.low_y = std::min(box.low_y, v.y);
    box.high_x = std::max(box.high_x, v.x);
    box.high_y = std::max(box.high_y, v.y);
  }
  return box;
}

// Does one of the upright faces of `a` have all of `b` behind it?
bool has_wall_between(const Polyhedron& a, const Polyhedron& b, double tolerance) {
  return std::any_of(a.faces.begin(), a.faces.end(), [&](const PolyhedronFace& face) {
    if (std::abs(face.normal.z) > kUprightLean) return false;
    return std::all_of(b.vertices.begin(), b.vertices.end(),
                       [&](const Point3& v) { return dot(face.normal, v) >= face.offset - tolerance; });
  });
}

class PlanUnion {
 public:
  PlanUnion(std::span<const Polyhedron> parts, std::span<const ShapeMeasure> shapes, double squared_radius)
      : parts_(parts), shapes_(shapes), squared_radius_(squared_radius) {
    double reach = 0;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      if (shapes[k].is_empty) continue;
      which_.push_back(k);
      reach = std::max(reach, parts[k].reach_squared);
    }
    tolerance_ = kNarrowShare * std::sqrt(std::min(reach, squared_radius));
  }

  double area() {
    find_groups();
    double sum = 0;
    for (std::size_t a = 0; a < which_.size(); ++a) {
      if (group_[a] != a) continue;
      members_.clear();
      for (std::size_t b = a; b < which_.size(); ++b)
        if (group_[b] == a) members_.push_back(b);
      sum += members_.size() == 1 ? footprint_area(parts_[which_[a]], squared_radius_, shapes_[which_[a]]) : united();
    }
    return sum;
  }

 private:
  struct Outline {
    std::size_t first = 0, last = 0;  // in arcs_
  };
  struct Stretch {
    double low = 0, high = 0;
    const PlanArc *lower = nullptr, *upper = nullptr;
    std::size_t owner = 0;
  };

  // A group's first member names it.
  void find_groups() {
    std::vector<PlanBox> boxes;
    for (const std::size_t k : which_) boxes.push_back(box_in_plan(parts_[k]));
    group_.resize(which_.size());
    near_.assign(which_.size(), {});
    for (std::size_t b = 0; b < which_.size(); ++b) {
      group_[b] = b;
      for (std::size_t a = 0; a < b; ++a) {
        const PlanBox &one = boxes[a], &other = boxes[b];
        if (one.high_x <= other.low_x + tolerance_ || other.high_x <= one.low_x + tolerance_ ||
            one.high_y <= other.low_y + tolerance_ || other.high_y <= one.low_y + tolerance_)
          continue;
        const Polyhedron &part = parts_[which_[a]], &next = parts_[which_[b]];
        if (has_wall_between(part, next, tolerance_) || has_wall_between(next, part, tolerance_)) continue;
        near_[a].push_back(b);
        join(a, b);
      }
    }
  }

  void join(std::size_t a, std::size_t b) {
    const std::size_t keep = std::min(group_[a], group_[b]), drop = std::max(group_[a], group_[b]);
    for (std::size_t k = 0; k <= b; ++k)
      if (group_[k] == drop) group_[k] = keep;
  }

  double united() {
    arcs_.clear();
    owner_.clear();
    outlines_.assign(which_.size(), {});
    for (const std::size_t member : members_) {
      outlines_[member].first = arcs_.size();
      outline_in_plan(parts_[which_[member]], squared_radius_, tolerance_, arcs_);
      outlines_[member].last = arcs_.size();
      owner_.resize(arcs_.size(), member);
    }
    places_.clear();
    for (const PlanArc& arc : arcs_) {
      places_.push_back(arc.from);
      places_.push_back(arc.to);
    }
    for (const std::size_t member : members_)
      for (const std::size_t other : near_[member]) cross_outlines(outlines_[member], outlines_[other]);
    std::sort(places_.begin(), places_.end());
    return sum_strips();
  }

  void cross_outlines(const Outline& one, const Outline& other) {
    for (std::size_t i = one.first; i < one.last; ++i)
      for (std::size_t j = other.first; j < other.last; ++j) {
        const PlanArc &a = arcs_[i], &b = arcs_[j];
        const double from = std::max(a.from, b.from), to = std::min(a.to, b.to);
        if (to - from > tolerance_) cross_arcs(a, b, from, to);
      }
  }

  void add_place(double x, double from, double to) {
    if (x > from && x < to) places_.push_back(x);
  }

  // Places too many are no fault: where a line meets the other half of an ellipse, say.
  void cross_arcs(const PlanArc& a, const PlanArc& b, double from, double to) {
    if (a.bulge != 0 && b.bulge != 0) {
      // Two points of the ball above one place in plan are one point, or each other's image in the plane z = 0.
      cross_circles(a.normal, a.offset, b.normal, b.offset, from, to);
      cross_circles(a.normal, a.offset, {b.normal.x, b.normal.y, -b.normal.z}, b.offset, from, to);
    } else if (a.bulge != 0) {
      cross_line(a, b, from, to);
    } else if (b.bulge != 0) {
      cross_line(b, a, from, to);
    } else {
      const double at_from = a.at(from) - b.at(from), at_to = a.at(to) - b.at(to);
      if ((at_from > 0) != (at_to > 0)) add_place(from + at_from / (at_from - at_to) * (to - from), from, to);
    }
  }

  // The points that two planes and the ball's surface have in common.
  void cross_circles(const Vector3& n, double d, const Vector3& m, double e, double from, double to) {
    const Vector3 along = cross(n, m);
    const double size = squared_norm(along);
    if (!(size > kOneCircle)) return;
    const Vector3 nearest = (d * cross(m, along) + e * cross(along, n)) / size;
    const double rest = squared_radius_ - squared_norm(nearest);
    if (!(rest > 0)) return;
    const double reach = std::sqrt(rest / size);
    add_place(nearest.x - reach * along.x, from, to);
    add_place(nearest.x + reach * along.x, from, to);
  }

  // bulge² (w² - t²) = (rise + tilt t)², with t from the ellipse's middle.
  void cross_line(const PlanArc& round, const PlanArc& line, double from, double to) {
    const double tilt = line.slope - round.slope, rise = line.at(round.middle) - round.level;
    const double bulge = round.bulge * round.bulge, a = tilt * tilt + bulge, b = rise * tilt;
    const double c = rise * rise - bulge * round.squared_width, rest = b * b - a * c;
    if (!(a > 0) || !(rest > 0)) return;
    const double root = std::sqrt(rest), far = -(b + (b > 0 ? root : -root));
    add_place(round.middle + far / a, from, to);
    if (far != 0) add_place(round.middle + c / far, from, to);
  }

  double sum_strips() {
    std::vector<std::size_t>& order = order_;
    order.resize(arcs_.size());
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return arcs_[a].from != arcs_[b].from ? arcs_[a].from < arcs_[b].from : a < b;
    });
    live_.clear();
    std::size_t next = 0;
    double sum = 0, before = places_.empty() ? 0 : places_.front();
    for (const double x : places_) {
      if (!(x - before > tolerance_)) continue;
      const double middle = 0.5 * (before + x);
      while (next < order.size() && arcs_[order[next]].from < middle) live_.push_back(order[next++]);
      std::erase_if(live_, [&](std::size_t arc) { return arcs_[arc].to < middle; });
      sum += strip(before, middle, x);
      before = x;
    }
    return sum;
  }

  // No two outlines cross within a strip, so what is above in its middle is above everywhere.
  double strip(double from, double middle, double to) {
    stretches_.assign(which_.size(), {});
    for (const std::size_t k : live_) {
      const PlanArc& arc = arcs_[k];
      const double y = arc.at(middle);
      Stretch& stretch = stretches_[owner_[k]];
      stretch.owner = owner_[k];
      if (stretch.upper == nullptr || y > stretch.high) {
        stretch.high = y;
        stretch.upper = &arc;
      }
      if (stretch.lower == nullptr || y < stretch.low) {
        stretch.low = y;
        stretch.lower = &arc;
      }
    }
    std::erase_if(stretches_, [](const Stretch& stretch) { return stretch.upper == nullptr; });
    std::sort(stretches_.begin(), stretches_.end(),
              [](const Stretch& a, const Stretch& b) { return a.low != b.low ? a.low < b.low : a.owner < b.owner; });
    double sum = 0;
    for (std::size_t k = 0; k < stretches_.size();) {
      Stretch whole = stretches_[k++];
      for (; k < stretches_.size() && stretches_[k].low <= whole.high; ++k) {
        if (stretches_[k].high <= whole.high) continue;
        whole.high = stretches_[k].high;
        whole.upper = stretches_[k].upper;
      }
      sum += whole.upper->area_below(from, to) - whole.lower->area_below(from, to);
    }
    return sum;
  }

  std::span<const Polyhedron> parts_;
  std::span<const ShapeMeasure> shapes_;
  double squared_radius_, tolerance_ = 0;
  std::vector<std::size_t> which_;              // the parts that are not empty
  std::vector<std::size_t> group_, members_;    // places in which_
  std::vector<std::vector<std::size_t>> near_;  // later ones that may lie above or below
  std::vector<PlanArc> arcs_;
  std::vector<std::size_t> owner_, order_, live_;
  std::vector<Outline> outlines_;
  std::vector<Stretch> stretches_;
  std::vector<double> places_;
};

}  // namespace

double plan_cover(std::span<const Polyhedron> parts, std::span<const ShapeMeasure> shapes, double squared_radius) {
  if (parts.size() == 1 && !shapes.front().is_empty) return footprint_area(parts.front(), squared_radius, shapes.front());
  return PlanUnion(parts, shapes, squared_radius).area();
}

}  // namespace bl::geometry
