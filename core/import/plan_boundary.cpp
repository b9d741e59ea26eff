// Chooses the polygon, brings it into local metres, and checks and mends its rings.
#include "core/import/plan_boundary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/base/mathematics.h"
#include "core/base/plural.h"
#include "core/base/text.h"
#include "core/import/context_shape.h"
#include "core/import/geojson_polygons.h"

namespace bl::importing {

namespace {

constexpr double kConvexDepth = 1e-3;   // [m] a point so little inside the hull does not make a plan non-convex
constexpr double kSmallestArea = 1e-2;  // [m²] less is no site but a line or a wrong CRS
constexpr double kLargestExtent = 1e5;  // [m] more is a region or a wrong CRS
constexpr double kWideExtent = 2e4;     // [m] beyond this a flat frame stretches lengths by more than 1e-6

using RawRing = std::vector<std::array<double, 2>>;

std::string area_text(double area) { return fixed(area, area < 100 ? 2 : 0) + " m²"; }
std::string point_text(double x, double y) {
  return std::string("(").append(fixed(x, 3)).append(", ").append(fixed(y, 3)).append(")");
}

// Comparable size of a polygon in units of its CRS; degrees of longitude shrink towards the poles.
double raw_area(const GeoPolygon& polygon, bool degrees) {
  geometry::Ring ring;
  for (const auto& p : polygon.rings[0]) ring.push_back({p[0], p[1], 0});
  const double area = std::abs(geometry::signed_area(ring));
  return degrees && !ring.empty() ? area * std::abs(mathematics::cosine(ring[0].y * 0.017453292519943295)) : area;
}

double raw_area(const GeoFeature& feature) {
  double largest = 0;
  for (const GeoPolygon& polygon : feature.polygons)
    largest = std::max(largest, raw_area(polygon, is_longitude_latitude(feature.crs)));
  return largest;
}

std::string first_few(const std::vector<std::string>& texts) {
  std::string list;
  for (std::size_t i = 0; i < texts.size() && i < 8; ++i) list.append(i ? ", " : "").append(texts[i]);
  return texts.size() > 8 ? list + ", ..." : list;
}

Result<std::size_t> feature_by_property(const GeoDocument& document, const std::string& wanted, std::size_t equals) {
  const std::string name = wanted.substr(0, equals), value = wanted.substr(equals + 1);
  std::vector<std::string> names, values, hits;
  std::size_t hit = 0;
  for (std::size_t i = 0; i < document.features.size(); ++i)
    for (const auto& [key, text] : document.features[i].properties) {
      if (std::find(names.begin(), names.end(), key) == names.end()) names.push_back(key);
      if (key != name) continue;
      if (std::find(values.begin(), values.end(), text) == values.end()) values.push_back(text);
      if (text != value || (!hits.empty() && hit == i)) continue;
      hit = i;
      hits.push_back(std::to_string(i));
    }
  if (hits.size() == 1) return hit;
  if (hits.size() > 1)
    return Error{ErrorCode::conflict, "features",
                 std::to_string(hits.size()) + " features have " + name + "=" + value + ": choose one by its index (" +
                     first_few(hits) + ")."};
  if (values.empty())
    return Error{
        ErrorCode::not_found, "features",
        "No feature has a property `" + name + "`" +
            (names.empty() ? "; the features have none" : did_you_mean(name, names) + " There are: " + first_few(names)) + "."};
  return Error{ErrorCode::not_found, "features",
               "No feature has " + name + "=" + value + did_you_mean(value, values) + " There are: " + first_few(values) + "."};
}

Result<std::size_t> feature_by_size(const GeoDocument& document, std::vector<std::string>& notes) {
  std::size_t best = 0, with_polygons = 0;
  double best_area = -1;
  for (std::size_t i = 0; i < document.features.size(); ++i) {
    if (document.features[i].polygons.empty()) continue;
    ++with_polygons;
    if (const double area = raw_area(document.features[i]); area > best_area) {
      best_area = area;
      best = i;
    }
  }
  const auto broken = static_cast<std::size_t>(std::count_if(
      document.features.begin(), document.features.end(), [](const GeoFeature& feature) { return feature.fault.has_value(); }));
  if (broken > 0)
    notes.push_back("The geometry of " + how_many(broken, "feature") + " cannot be read: such features were left out.");
  const std::size_t others = document.features.size() - with_polygons - broken;
  if (with_polygons == 0)
    return Error{ErrorCode::missing, "",
                 "There is no polygon in the file (" + how_many(others, "other feature") +
                     "). A plan boundary must be a Polygon or a MultiPolygon."};
  if (others > 0)
    notes.push_back(how_many(others, "feature") + " without a polygon " + by_number(others, "was", "were") + " left out.");
  if (with_polygons > 1)
    notes.push_back("Of " + std::to_string(with_polygons) + " polygon features the largest was taken, number " +
                    std::to_string(best) + "; choose another one by the option `feature`: an index from 0 to " +
                    std::to_string(document.features.size() - 1) + ", or property=value.");
  return best;
}

Result<std::size_t> choose_feature(const GeoDocument& document, const std::string& wanted, std::vector<std::string>& notes) {
  if (wanted.empty()) return feature_by_size(document, notes);
  std::size_t index = 0;
  if (const std::size_t equals = wanted.find('='); equals != std::string::npos) {
    auto found = feature_by_property(document, wanted, equals);
    if (!found) return found;
    index = *found;
  } else {
    const bool digits = wanted.find_first_not_of("0123456789") == std::string::npos && wanted.size() < 10;
    if (!digits)
      return Error{ErrorCode::parse, "feature",
                   "The option `feature` is `" + wanted + "`. Write an index such as 3, or property=value."};
    index = std::stoul(wanted);
    if (index >= document.features.size())
      return Error{
          ErrorCode::out_of_range, "feature",
          "There is no feature " + wanted + ": the file has " + std::to_string(document.features.size()) + ", counted from 0."};
  }
  if (document.features[index].fault) return *document.features[index].fault;
  if (document.features[index].polygons.empty())
    return Error{ErrorCode::wrong_kind, "features/" + std::to_string(index),
                 "This feature has no polygon. A plan boundary must be a Polygon or a MultiPolygon: choose another feature."};
  return index;
}

const GeoPolygon& choose_part(const GeoFeature& feature, std::vector<std::string>& notes) {
  std::size_t best = 0;
  const bool degrees = is_longitude_latitude(feature.crs);
  for (std::size_t i = 1; i < feature.polygons.size(); ++i)
    if (raw_area(feature.polygons[i], degrees) > raw_area(feature.polygons[best], degrees)) best = i;
  if (feature.polygons.size() > 1)
    notes.push_back("The feature has " + std::to_string(feature.polygons.size()) +
                    " separate polygons; only the largest was taken, number " + std::to_string(best) +
                    ". Split the feature to use another one.");
  return feature.polygons[best];
}

// Longitudes and latitudes beyond the globe are the mark of projected coordinates without a `crs` member.
Result<void> check_degrees(const RawRing& ring, const std::string& place) {
  for (std::size_t i = 0; i < ring.size(); ++i)
    if (std::abs(ring[i][0]) > 180 || std::abs(ring[i][1]) > 90)
      return Error{ErrorCode::out_of_range, place + "/" + std::to_string(i),
                   point_text(ring[i][0], ring[i][1]) +
                       " is no longitude and latitude. The coordinates are probably projected, and the file does not say how: "
                       "give the CRS, such as EPSG:28992."};
  return {};
}

// A place by the coordinates that stand in the file, and by those of the scene.
std::string meeting_place(const LocalFrame& frame, const std::string& crs, const Point3& where) {
  const std::string local = point_text(where.x, where.y) + " in local metres";
  const Point3 written = frame.from_local(where.x, where.y);
  if (!is_finite(written)) return local;
  const int decimals = is_longitude_latitude(crs) ? 7 : 3;  // the seventh decimal of a degree is a centimetre
  return "(" + fixed(written.x, decimals) + ", " + fixed(written.y, decimals) + ") in the file, which is " + local;
}

// Local points without the closing point and without repeated ones, in the wanted direction.
Result<geometry::Ring> clean_ring(const RawRing& raw, const LocalFrame& frame, const std::string& crs, bool counter_clockwise,
                                  const std::string& place, std::vector<std::string>& notes) {
  geometry::Ring ring;
  const bool closed = raw.size() > 1 && raw.front() == raw.back();
  if (!closed) notes.push_back("The ring " + place + " does not end where it starts; it was closed.");
  for (std::size_t i = 0; i + (closed ? 1 : 0) < raw.size(); ++i) {
    const Point3 point = frame.to_local(raw[i][0], raw[i][1]);
    if (!is_finite(point))
      return Error{ErrorCode::not_finite, place + "/" + std::to_string(i),
                   point_text(raw[i][0], raw[i][1]) + " cannot be brought into metres. Check the CRS and this point."};
    ring.push_back(point);
  }
  const RingCleaning cleaning = clean_corners(ring);
  if (cleaning.repeated > 0)
    notes.push_back("In the ring " + place + ", " + how_many(cleaning.repeated, "repeated point") +
                    by_number(cleaning.repeated, " was", " were") + " dropped.");
  if (cleaning.spikes > 0)
    notes.push_back("In the ring " + place + ", " + how_many(cleaning.spikes, "spike") + " without width " +
                    by_number(cleaning.spikes, "was", "were") + " cut off.");
  if (ring.size() < 3)
    return Error{ErrorCode::geometry, place,
                 "A ring needs at least 3 different points; this one has " + std::to_string(ring.size()) + "."};
  if (const auto crossing = geometry::find_self_crossing(ring)) {
    const auto edge = [&](std::size_t i) {
      const Point3 &a = ring[i], &b = ring[(i + 1) % ring.size()];
      return "edge " + std::to_string(i) + " from " + point_text(a.x, a.y) + " to " + point_text(b.x, b.y);
    };
    return Error{ErrorCode::geometry, place,
                 "The ring meets itself at " + meeting_place(frame, crs, crossing->where) + ": " + edge(crossing->first_edge) +
                     " and " + edge(crossing->second_edge) + ". Redraw it without crossing or touching itself."};
  }
  const double area = geometry::signed_area(ring);
  if (std::abs(area) < kSmallestArea)
    return Error{
        ErrorCode::geometry, place,
        "The ring encloses no area (" + fixed(std::abs(area), 4) + " m²). Are its points on a line, or is the CRS wrong?"};
  if ((area > 0) != counter_clockwise) std::reverse(ring.begin() + 1, ring.end());
  return ring;
}

Result<void> check_hole(const PlanBoundary& plan, const LocalFrame& frame, const geometry::Ring& hole, const std::string& place) {
  auto crossing = geometry::find_crossing(plan.outer, hole);
  std::string other = "the outer ring";
  for (std::size_t i = 0; i < plan.holes.size() && !crossing; ++i) {
    crossing = geometry::find_crossing(plan.holes[i], hole);
    other = "hole " + std::to_string(i + 1);
    if (!crossing && (geometry::ring_contains(plan.holes[i], hole[0]) || geometry::ring_contains(hole, plan.holes[i][0])))
      return Error{ErrorCode::geometry, place,
                   "This hole and hole " + std::to_string(i + 1) + " lie inside one another. Keep the outer one of the two."};
  }
  if (crossing)
    return Error{ErrorCode::geometry, place,
                 "The hole meets " + other + " at " + meeting_place(frame, plan.source_crs, crossing->where) +
                     ". Cut it out of the outer ring, or draw it apart."};
  if (!geometry::ring_contains(plan.outer, hole[0]))
    return Error{ErrorCode::geometry, place, "The hole lies outside the outer ring. Remove it, or make it a polygon of its own."};
  return {};
}

Result<void> read_rings(const GeoPolygon& polygon, const LocalFrame& frame, PlanBoundary& plan) {
  for (std::size_t r = 0; r < polygon.rings.size(); ++r) {
    const std::string place = polygon.place + "/" + std::to_string(r);
    auto ring = clean_ring(polygon.rings[r], frame, plan.source_crs, r == 0, place, plan.notes);
    if (!ring) return ring.error();
    if (r == 0) {
      plan.outer = std::move(*ring);
      continue;
    }
    if (auto sound = check_hole(plan, frame, *ring, place); !sound) return sound;
    plan.holes.push_back(std::move(*ring));
  }
  plan.outer_area = plan.area = geometry::signed_area(plan.outer);
  for (const geometry::Ring& hole : plan.holes) plan.area += geometry::signed_area(hole);
  if (!plan.holes.empty())
    plan.notes.push_back(
        std::to_string(plan.holes.size()) + (plan.holes.size() == 1 ? " hole with " : " holes with ") +
        area_text(plan.outer_area - plan.area) +
        (plan.holes.size() == 1 ? " stays open: nothing is built there." : " stay open: nothing is built there."));
  plan.hull = geometry::hull_of_plan(plan.outer);
  plan.hull_area = geometry::signed_area(plan.hull);
  plan.is_convex = plan.holes.empty() && geometry::depth_below_hull(plan.outer, plan.hull) <= kConvexDepth;
  return {};
}

Result<void> check_extent(PlanBoundary& plan, const std::string& place) {
  double low_x = 0, high_x = 0, low_y = 0, high_y = 0;
  for (const Point3& p : plan.outer) {
    low_x = std::min(low_x, p.x), high_x = std::max(high_x, p.x);
    low_y = std::min(low_y, p.y), high_y = std::max(high_y, p.y);
  }
  const double extent = std::max(high_x - low_x, high_y - low_y);
  if (extent > kLargestExtent)
    return Error{ErrorCode::out_of_range, place,
                 "The polygon is " + fixed(extent / 1000, 0) +
                     " km wide. A plan boundary is a site of at most 100 km: check the CRS, or choose another feature."};
  if (extent > kWideExtent)
    plan.notes.push_back("The plan is " + fixed(extent / 1000, 0) + " km wide: over such lengths no flat frame is exact.");
  return {};
}

}  // namespace

Result<PlanBoundary> read_plan_boundary(std::string_view geojson_text, const PlanOptions& options) {
  auto document = read_geojson_polygons(geojson_text, !options.crs.empty());
  if (!document) return document.error();
  PlanBoundary plan;
  plan.notes = document->notes;
  if (!options.crs.empty())
    for (GeoFeature& feature : document->features) feature.crs = tidy_crs_name(options.crs);
  auto index = choose_feature(*document, options.feature, plan.notes);
  if (!index) return index.error();
  const GeoFeature& feature = document->features[*index];
  const GeoPolygon& polygon = choose_part(feature, plan.notes);
  plan.place = feature.place;
  plan.source_crs = feature.crs;

  double low_x = std::numeric_limits<double>::infinity(), low_y = low_x, high_x = -low_x, high_y = -low_x;
  for (std::size_t r = 0; r < polygon.rings.size(); ++r) {
    const std::string place = polygon.place + "/" + std::to_string(r);
    if (polygon.rings[r].empty())
      return Error{ErrorCode::geometry, place, "A ring needs at least 3 different points; this one has 0."};
    if (is_longitude_latitude(feature.crs))
      if (auto sane = check_degrees(polygon.rings[r], place); !sane) return sane.error();
  }
  for (const auto& p : polygon.rings[0]) {
    low_x = std::min(low_x, p[0]), high_x = std::max(high_x, p[0]);
    low_y = std::min(low_y, p[1]), high_y = std::max(high_y, p[1]);
  }
  auto frame = LocalFrame::make(feature.crs, low_x / 2 + high_x / 2, low_y / 2 + high_y / 2, options.proj_database);
  if (!frame) return frame.error();
  plan.reference = frame->reference();
  plan.notes.insert(plan.notes.end(), frame->notes().begin(), frame->notes().end());
  if (auto read = read_rings(polygon, *frame, plan); !read) return read.error();
  if (auto sane = check_extent(plan, polygon.place); !sane) return sane.error();
  return plan;
}

ConvexPlan convex_hull_plan(const PlanBoundary& plan) { return {plan.hull, plan.hull_area, plan.hull_area - plan.area}; }

}  // namespace bl::importing
