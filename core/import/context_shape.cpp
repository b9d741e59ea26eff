// Frames, rings and assumed heights; all deterministic: medians over sorted values, no order but that of the file.
#include "core/import/context_shape.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/plural.h"
#include "core/base/text.h"
#include "core/import/assumed_height.h"
#include "core/import/box_grid.h"

namespace bl::importing {

namespace {

constexpr double kSamePoint = 1e-3;      // [m]
constexpr double kSpikeWidth = 1e-3;     // [m]
constexpr double kSmallestShape = 1e-2;  // [m²]
constexpr std::size_t kMostCorners = 100000, kFewestNeighbours = 3;

std::string point_text(const Point3& p) { return "(" + fixed(p.x, 3) + ", " + fixed(p.y, 3) + ")"; }

Point3 centre_of(const geometry::Ring& ring) {
  Point3 sum;
  for (const Point3& p : ring) sum += p;
  return sum / static_cast<double>(std::max<std::size_t>(1, ring.size()));
}

}  // namespace

std::string_view name_of(HeightSource source) {
  switch (source) {
    case HeightSource::geometry: return "geometry";
    case HeightSource::tag: return "tag";
    case HeightSource::levels: return "levels";
    case HeightSource::neighbour: return "neighbour";
    case HeightSource::assumed: return "default";
  }
  return "";
}

std::string context_crs(const ContextOptions& options, const std::string& file_crs) {
  return tidy_crs_name(options.crs.empty() ? file_crs : options.crs);
}

Result<LocalFrame> context_frame(const ContextOptions& options, const std::string& file_crs,
                                 const std::array<double, 2>& middle) {
  const std::string crs = context_crs(options, file_crs);
  if (crs.empty())
    return Error{ErrorCode::missing, "crs",
                 "The file does not say in which CRS its coordinates are. Give it by --crs, such as EPSG:28992, or `--crs local` "
                 "where they are metres of a model that has no place on Earth."};
  const std::array<double, 2> about = options.origin.value_or(middle);
  if (is_longitude_latitude(crs) && !(std::abs(about[0]) <= 180 && std::abs(about[1]) <= 90))
    return Error{
        ErrorCode::out_of_range, "crs",
        "(" + fixed(about[0], 3) + ", " + fixed(about[1], 3) +
            ") is not a longitude and latitude: the coordinates are probably projected. Give their CRS, such as EPSG:28992."};
  if (crs == kLocalCrs && options.origin && !options.target) return LocalFrame::local(about[0], about[1]);
  if (options.target && !options.origin) return LocalFrame::into(crs, *options.target, options.proj_database);
  return LocalFrame::make(crs, about[0], about[1], options.proj_database);
}

double context_height_unit(const ContextOptions& options, double file_unit, const std::string& file_crs,
                           std::vector<std::string>& notes) {
  if (options.height_unit > 0) return options.height_unit;
  const std::string crs = context_crs(options, file_crs);
  const double unit = file_unit > 0 ? file_unit : height_unit(crs, options.proj_database);
  if (unit != 1)
    notes.push_back("One unit of height was taken as " + shortest(unit) + " m, as " +
                    (file_unit > 0 ? std::string("the file says") : "in " + crs) +
                    ": if it is another one, give it by the option for the unit of heights.");
  return unit;
}

RingCleaning clean_corners(geometry::Ring& ring) {
  RingCleaning done;
  const std::size_t given = ring.size();
  geometry::Ring kept;
  for (const Point3& point : ring)
    if (kept.empty() || !(distance(kept.back(), point) < kSamePoint)) kept.push_back(point);
  while (kept.size() > 1 && distance(kept.front(), kept.back()) < kSamePoint) kept.pop_back();
  done.repeated = given - kept.size();
  std::size_t steady = 0;  // corners in a row that are sound
  for (std::size_t i = 0; kept.size() > 3 && steady < kept.size();) {
    const std::size_t count = kept.size(), before = (i + count - 1) % count, after = (i + 1) % count;
    const Vector3 in = kept[i] - kept[before], out = kept[after] - kept[i];
    const double shorter = std::min(norm(in), norm(out)), longer = std::max(norm(in), norm(out));
    const bool spike = shorter < kSamePoint || (dot(in, out) < 0 && std::abs(in.x * out.y - in.y * out.x) < kSpikeWidth * longer);
    if (!spike) {
      i = after;
      ++steady;
      continue;
    }
    kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(i));
    ++done.spikes;
    steady = 0;
    i = (i + kept.size() - 1) % kept.size();  // the corner before it has changed
  }
  ring = std::move(kept);
  return done;
}

SoundRing sound_ring(std::vector<Point3> points, bool counter_clockwise) {
  SoundRing result;
  for (Point3& point : points) {
    if (!is_finite(point)) {
      result.fault = "a corner has no place in local metres";
      return result;
    }
    point.z = 0;
  }
  if (points.size() > kMostCorners) {
    result.fault = "it has more than " + std::to_string(kMostCorners) + " corners";
    return result;
  }
  if (points.size() > 1 && points.front() == points.back()) points.pop_back();
  const RingCleaning cleaning = clean_corners(points);
  if (cleaning.repeated > 0) result.mended = "repeated points dropped (" + std::to_string(cleaning.repeated) + ")";
  if (cleaning.spikes > 0)
    result.mended +=
        std::string(result.mended.empty() ? "" : ", ") + "spikes without width cut off (" + std::to_string(cleaning.spikes) + ")";
  if (points.size() < 3) {
    result.fault = "its outline has fewer than 3 different corners";
    return result;
  }
  if (const auto crossing = geometry::find_self_crossing(points)) {
    result.fault = "its outline crosses or touches itself";
    result.mended = "at " + point_text(crossing->where) + " in local metres";
    return result;
  }
  const double area = geometry::signed_area(points);
  if (std::abs(area) < kSmallestShape) {
    result.fault = "its outline encloses no area";
    return result;
  }
  if ((area > 0) != counter_clockwise) std::reverse(points.begin() + 1, points.end());
  result.ring = std::move(points);
  return result;
}

std::string out_of_reach(const ContextOptions& options, const std::vector<Point3>& points) {
  double nearest = INFINITY, farthest = 0;
  for (const Point3& p : points) {
    const double away = std::sqrt(p.x * p.x + p.y * p.y);
    nearest = std::min(nearest, away);
    farthest = std::max(farthest, std::isfinite(away) ? away : INFINITY);
  }
  if (!(farthest <= kContextExtent)) return "it reaches more than 100 km from the origin";
  if (options.radius > 0 && !(nearest <= options.radius)) return "it lies beyond the radius";
  return {};
}

void sort_holes(const geometry::Ring& outer, std::vector<geometry::Ring>& holes, std::string& dropped) {
  std::vector<geometry::Ring> kept;
  std::size_t bad = 0;
  BoxGrid grid(plan_box(outer), holes.size());
  for (geometry::Ring& hole : holes) {
    bool is_sound = !geometry::find_crossing(outer, hole) && geometry::ring_contains(outer, hole[0]);
    const PlanBox box = plan_box(hole);
    if (is_sound)
      for (const std::size_t other : grid.meeting(box))
        is_sound = is_sound && !geometry::find_crossing(kept[other], hole) && !geometry::ring_contains(kept[other], hole[0]) &&
                   !geometry::ring_contains(hole, kept[other][0]);
    if (is_sound) grid.add(box), kept.push_back(std::move(hole));
    else ++bad;
  }
  holes = std::move(kept);
  if (bad == 0) return;
  dropped += std::string(dropped.empty() ? "" : ", ") + "holes dropped that meet another ring or lie outside (" +
             std::to_string(bad) + ")";
}

std::string limit_corners(const geometry::Ring& outer, std::vector<geometry::Ring>& holes, std::string& dropped) {
  const std::string most = "more than " + std::to_string(kMostBodyCorners) + " corners";
  if (outer.size() > kMostBodyCorners) return "it has " + most;
  std::size_t corners = outer.size();
  for (const geometry::Ring& hole : holes) corners += hole.size();
  if (corners <= kMostBodyCorners) return {};
  dropped += (dropped.empty() ? "its " : ", its ") + how_many(holes.size(), "hole") + " left out: with them it has " + most;
  holes.clear();
  return {};
}

std::string out_of_heights(double base, double height) {
  if (base >= kLowestBase && base + height <= kHighestTop) return {};
  return "its heights lie beyond -10 km or 100 km";
}

void assume_heights(const ContextOptions& options, Context& context) {
  struct Known {
    Point3 centre;
    double height = 0;
  };
  std::vector<Known> known;
  for (const ContextBuilding& building : context.buildings)
    if (building.height > 0 && !building.is_part) known.push_back({centre_of(building.outer), building.height});
  std::sort(known.begin(), known.end(), [](const Known& a, const Known& b) {
    if (a.centre.x != b.centre.x) return a.centre.x < b.centre.x;
    return a.centre.y != b.centre.y ? a.centre.y < b.centre.y : a.height < b.height;
  });
  std::size_t by_neighbours = 0, by_default = 0;
  std::map<std::size_t, std::string> told;  // by row; of several buildings of one element the last
  for (ContextBuilding& building : context.buildings) {
    if (building.height > 0) continue;
    const Point3 centre = centre_of(building.outer);
    const double reach = options.neighbour_distance;
    std::vector<double> heights;
    auto it =
        std::lower_bound(known.begin(), known.end(), centre.x - reach, [](const Known& a, double x) { return a.centre.x < x; });
    for (; it != known.end() && it->centre.x <= centre.x + reach; ++it)
      if (distance(it->centre, centre) <= reach) heights.push_back(it->height);
    const bool has_neighbours = heights.size() >= kFewestNeighbours;
    building.height_source = has_neighbours ? HeightSource::neighbour : HeightSource::assumed;
    building.height = options.default_height;
    if (has_neighbours) {
      const auto middle = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2);
      std::nth_element(heights.begin(), middle, heights.end());
      building.height = *middle;
    }
    ++(has_neighbours ? by_neighbours : by_default);
    told[building.row] =
        std::string(has_neighbours ? kHeightOfNeighbours : kHeightAssumed) + ": " + shortest(building.height) + " m";
  }
  for (const auto& [row, detail] : told)
    if (row != kNoRow) context.report.remark(row, detail);
  if (by_neighbours > 0)
    context.notes.push_back("The heights of " + how_many(by_neighbours, "building") +
                            " were taken from their neighbours within " + shortest(options.neighbour_distance) + " m (median).");
  if (by_default > 0)
    context.notes.push_back("The heights of " + how_many(by_default, "building") +
                            " are not known: " + shortest(options.default_height) + " m were assumed.");
}

std::optional<std::array<double, 2>> place_of(const std::vector<Point3>& points) {
  double west = INFINITY, east = -INFINITY, south = INFINITY, north = -INFINITY;
  for (const Point3& p : points) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) continue;
    west = std::min(west, p.x), east = std::max(east, p.x);
    south = std::min(south, p.y), north = std::max(north, p.y);
  }
  if (west > east) return std::nullopt;
  return std::array{west / 2 + east / 2, south / 2 + north / 2};
}

Error stopped_error() { return {ErrorCode::cancelled, "", "The import was stopped; nothing was added."}; }

std::optional<std::array<double, 2>> middle_of(std::vector<std::array<double, 2>> points) {
  if (points.empty()) return std::nullopt;
  std::array<double, 2> middle{};
  const auto half = points.begin() + static_cast<std::ptrdiff_t>(points.size() / 2);
  for (const std::size_t i : {0u, 1u}) {
    std::nth_element(points.begin(), half, points.end(), [i](const auto& a, const auto& b) { return a[i] < b[i]; });
    middle[i] = (*half)[i];
  }
  return middle;
}

}  // namespace bl::importing
