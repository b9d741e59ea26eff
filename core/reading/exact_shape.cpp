// A power cell depends on its neighbours only: a site that shares no face with a shape does not cut it.
#include "core/reading/exact_shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/mathematics.h"
#include "core/geometry/solid_part.h"
#include "core/reading/views/solver.h"

namespace bl::reading {

namespace {

constexpr int kArcPoints = 90;
constexpr double kAgreement = 0.02;  // share by which footprint and height may differ from what is reported

bool is_kept(const Cut& cut, const Point3& point, double slack) { return dot(cut.normal, point) <= cut.offset + slack; }

// Two unit vectors that make a right-handed frame with a unit normal.
std::pair<Vector3, Vector3> frame_of(const Vector3& normal) {
  const Vector3 aside = std::abs(normal.z) < 0.9 ? Vector3{0, 0, 1} : Vector3{1, 0, 0};
  const Vector3 first = cross(aside, normal) / norm(cross(aside, normal));
  return {first, cross(normal, first)};
}

Corners circle(const Point3& centre, const Vector3& normal, double radius) {
  const auto [first, second] = frame_of(normal);
  Corners out;
  for (int i = 0; i < kArcPoints; ++i) {
    const double angle = 2 * std::numbers::pi * i / kArcPoints;
    out.push_back(centre + first * (radius * mathematics::cosine(angle)) + second * (radius * mathematics::sine(angle)));
  }
  return out;
}

// The disc in which a plane meets the ball, cut by all planes but one.
Corners disc_inside(const ExactShape& shape, const Cut& plane, std::size_t except) {
  const double away = plane.offset - dot(plane.normal, shape.centre);
  if (!(std::abs(away) < shape.radius)) return {};
  Corners polygon =
      circle(shape.centre + plane.normal * away, plane.normal, std::sqrt(shape.radius * shape.radius - away * away));
  for (std::size_t k = 0; k < shape.cuts.size() && !polygon.empty(); ++k)
    if (k != except) polygon = clipped(polygon, shape.cuts[k]);
  return polygon.size() > 2 ? polygon : Corners{};
}

// The planes of the boundary that the node's solver divides.
std::vector<Cut> boundary_of(const State& state, std::uint32_t node) {
  const Plan& plan = *state.plan;
  std::vector<Cut> cuts;
  for (const SetPlan& solver : plan.sets) {
    if (solver.writes.empty() || !std::binary_search(solver.members.begin(), solver.members.end(), node)) continue;
    for (const SetPlan& set : plan.sets) {
      if (set.node != solver.node || set.type != solver.type || set.set == solver.set) continue;
      for (const std::uint32_t member : set.members) {
        const Shared<Table> planes = reading::read<&reading::BoundaryFigures::planes>(state, member);
        for (std::size_t r = 0; r < planes->rows.size(); ++r)
          cuts.push_back({{planes->number(r, "x"), planes->number(r, "y"), planes->number(r, "z")}, planes->number(r, "offset")});
      }
    }
    break;
  }
  return cuts;
}

double plan_area(Corners points) {
  std::sort(points.begin(), points.end(), [](const Point3& a, const Point3& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  // Lower and upper chain of the hull at once: the area between them.
  double area = 0;
  for (const double side : {1.0, -1.0}) {
    Corners chain;
    for (const Point3& p : points) {
      while (chain.size() > 1 && side * cross(chain.back() - chain[chain.size() - 2], p - chain.back()).z <= 0) chain.pop_back();
      chain.push_back(p);
    }
    for (std::size_t i = 1; i < chain.size(); ++i)
      area -= side * 0.5 * (chain[i].y + chain[i - 1].y) * (chain[i].x - chain[i - 1].x);
  }
  return area;
}

bool agrees(const reading::VolumeFigures& volume, const ExactShape& shape) {
  const Corners seen_from_above = outline_of(shape, {0, 0, 1});
  Corners aside = outline_of(shape, {1, 0, 0});
  if (seen_from_above.empty() || aside.empty() || !(volume.footprint > 0)) return false;
  // The highest and lowest points of the ball may be no corner of the sample.
  const auto [low, high] =
      std::minmax_element(aside.begin(), aside.end(), [](const Point3& a, const Point3& b) { return a.z < b.z; });
  Corners flat = seen_from_above;
  for (Point3& p : flat) p = {p.x - shape.centre.x, p.y - shape.centre.y, 0};
  return std::abs(plan_area(flat) - volume.footprint) < kAgreement * volume.footprint &&
         std::abs(high->z - low->z - volume.height) < kAgreement * volume.height;
}

}  // namespace

Corners face_of(const ExactShape& shape, std::size_t cut) { return disc_inside(shape, shape.cuts[cut], cut); }

Corners section_of(const ExactShape& shape, double z) { return disc_inside(shape, {{0, 0, 1}, z}, shape.cuts.size()); }

Vector3 normal_at(const ExactShape& shape, const Point3& point) {
  const Vector3 out = point - shape.centre;
  // The surface that the point lies nearest to; on a cut wins where it lies on both.
  for (const Cut& cut : shape.cuts)
    if (std::abs(dot(cut.normal, point) - cut.offset) < 1e-6 * shape.radius) return cut.normal;
  const double length = norm(out);
  return length > 0 ? out / length : Vector3{0, 0, 1};
}

Corners outline_of(const ExactShape& shape, const Vector3& toward) {
  Corners points;
  for (const Point3& p : circle(shape.centre, toward, shape.radius))
    if (std::all_of(shape.cuts.begin(), shape.cuts.end(), [&](const Cut& cut) { return is_kept(cut, p, 1e-9 * shape.radius); }))
      points.push_back(p);
  for (std::size_t k = 0; k < shape.cuts.size(); ++k) {
    const Corners face = face_of(shape, k);
    points.insert(points.end(), face.begin(), face.end());
  }
  return points;
}

ExactShape exact_shape(const State& state, std::uint32_t node, const reading::VolumeFigures& volume) {
  using reading::VolumeFigures;
  if (!(volume.weight > 0)) return {};
  ExactShape shape{volume.position, std::sqrt(volume.weight), {}};
  std::vector<Cut> cuts = boundary_of(state, node);
  for (std::size_t r = 0; r < volume.neighbours->rows.size(); ++r) {
    const std::uint32_t other = state.plan->node_index(volume.neighbours->text(r, "node"));
    if (other >= state.plan->nodes.size()) return {};
    const Vector3 between = reading::read<&VolumeFigures::position>(state, other) - shape.centre;
    const double length = norm(between);
    if (!(length > 0)) return {};
    // |x - p|² - w is smaller here than there: a plane across the line between the two.
    const double along = 0.5 * (length * length + volume.weight - reading::read<&VolumeFigures::weight>(state, other)) / length;
    const Vector3 normal = between / length;
    cuts.push_back({normal, dot(normal, shape.centre) + along});
  }
  for (const Cut& cut : cuts)
    if (cut.offset - dot(cut.normal, shape.centre) < shape.radius) shape.cuts.push_back(cut);
  return agrees(volume, shape) ? shape : ExactShape{};
}

}  // namespace bl::reading
