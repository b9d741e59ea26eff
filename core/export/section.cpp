// Cuts plates by a line and meshes by an upright plane.
#include "core/export/section.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/text.h"
#include "core/export/drawn_levels.h"
#include "core/export/plan_places.h"
#include "core/export/read_proposal.h"
#include "core/geometry/mesh_lines.h"

namespace bl::exporting {

namespace {

using geometry::PlateFace;
using geometry::Ring;

constexpr double kOneHeight = 0.02;  // [m] heights nearer than this are one
constexpr double kNearby = 60;       // [m] existing buildings farther behind the cut are not drawn

// Along the line, and how far to the left of it [m].
class SectionFrame {
 public:
  explicit SectionFrame(const SectionLine& line) : from_(line.from) {
    const Vector3 way = line.to - line.from;
    along_ = way / norm(way);
  }
  double along(const Point3& p) const { return (p.x - from_.x) * along_.x + (p.y - from_.y) * along_.y; }
  double left(const Point3& p) const { return (p.y - from_.y) * along_.x - (p.x - from_.x) * along_.y; }

  // Where rings are crossed, in ascending order: between each two of them lies what they enclose.
  std::vector<double> crossings(const std::vector<PlateFace>& faces) const {
    std::vector<double> found;
    const auto take = [&](const Ring& ring) {
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const Point3 &a = ring[k], &b = ring[(k + 1) % ring.size()];
        const double left_a = left(a), left_b = left(b);
        if ((left_a > 0) != (left_b > 0)) found.push_back(along(a) + (along(b) - along(a)) * left_a / (left_a - left_b));
      }
    };
    for (const PlateFace& face : faces) {
      take(face.outer);
      for (const Ring& hole : face.holes) take(hole);
    }
    std::sort(found.begin(), found.end());
    return found;
  }

  // The part to the left of the line, as an interval along it; empty where there is none.
  std::vector<double> behind(const std::vector<PlateFace>& faces) const {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    const auto take = [&](double at) { low = std::min(low, at), high = std::max(high, at); };
    for (const double at : crossings(faces)) take(at);
    for (const PlateFace& face : faces)
      for (const Point3& p : face.outer)
        if (left(p) > 0) take(along(p));
    return low < high ? std::vector<double>{low, high} : std::vector<double>{};
  }

  // Lines in which the plane cuts a mesh: turned so that the plane lies flat.
  std::vector<geometry::Polyline> cut(const Mesh& mesh) const {
    Mesh turned = mesh;
    for (Point3& v : turned.vertices) v = {along(v), v.z, left(v)};
    return geometry::section(turned, 0, [](std::size_t) { return true; });
  }

 private:
  Point3 from_;
  Vector3 along_;
};

Ring rectangle(double left, double right, double bottom, double top) {
  return {{left, bottom, 0}, {right, bottom, 0}, {right, top, 0}, {left, top, 0}};
}

void add_rectangles(const std::vector<double>& ends, double bottom, double top, std::vector<Ring>& rings) {
  for (std::size_t k = 0; k + 1 < ends.size(); k += 2)
    if (ends[k] < ends[k + 1]) rings.push_back(rectangle(ends[k], ends[k + 1], bottom, top));
}

Ring flat(const Ring& ring) {
  Ring made = ring;
  for (Point3& p : made) p.z = 0;
  return made;
}

// Where rings in the plane of the section are crossed at a height.
std::vector<double> at_height(const std::vector<Ring>& rings, double height) {
  std::vector<double> found;
  for (const Ring& ring : rings)
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Point3 &a = ring[k], &b = ring[(k + 1) % ring.size()];
      if ((a.y > height) != (b.y > height)) found.push_back(a.x + (b.x - a.x) * (height - a.y) / (b.y - a.y));
    }
  std::sort(found.begin(), found.end());
  return found;
}

double distance_of(const SectionFrame& frame, const std::vector<PlateFace>& faces) {
  double least = std::numeric_limits<double>::infinity();
  for (const PlateFace& face : faces)
    for (const Point3& p : face.outer)
      if (frame.left(p) > 0) least = std::min(least, frame.left(p));
  return least;
}

// A whole storey: a rectangle, with a floor under it and a roof above.
void cut_storey(const SectionFrame& frame, const Storey& storey, std::vector<Ring>& cut, std::vector<Ring>& slabs) {
  const std::vector<double> ends = frame.crossings(storey.faces);
  add_rectangles(ends, storey.bottom, storey.top, cut);
  for (const double top : {storey.bottom, storey.top}) add_rectangles(ends, top - kSectionSlab, top, slabs);
}

void cut_standing(const SectionFrame& frame, const Building& building, SectionPart& part) {
  for (const Storey& storey : building.storeys) {
    cut_storey(frame, storey, part.cut, part.slabs);
    add_rectangles(frame.behind(storey.faces), storey.bottom, storey.top, part.beyond);
  }
}

// Any other shape: the cut through its mesh, floors in it, and the hull of what is behind.
void cut_rounded(const SectionFrame& frame, const Building& building, SectionPart& part) {
  for (const geometry::Polyline& line : frame.cut(*building.mesh))
    if (line.is_closed) part.cut.push_back(flat(line.points));
  for (const Storey& storey : building.storeys)
    if (storey.number > 0)
      add_rectangles(at_height(part.cut, storey.bottom), storey.bottom - kSectionSlab, storey.bottom, part.slabs);
  Ring behind;
  for (const Point3& v : building.mesh->vertices)
    if (frame.left(v) > 0) behind.push_back({frame.along(v), v.z, 0});
  if (behind.size() >= 3)
    if (Ring hull = geometry::hull_of_plan(behind); hull.size() >= 3) part.beyond.push_back(std::move(hull));
}

void add_buildings(const SectionFrame& frame, const Proposal& proposal, Section& made) {
  for (const Building& building : proposal.buildings) {
    SectionPart part;
    part.building = &building;
    if (building.is_standing) cut_standing(frame, building, part);
    else cut_rounded(frame, building, part);
    // Below the ground nothing is seen of what is not cut.
    for (const Storey& storey : building.cellars) cut_storey(frame, storey, part.cellars, part.slabs);
    for (const Storey* storey : drawn_storeys(building)) {
      const bool is_cut = storey->number < 0 ? !part.cellars.empty() : !part.cut.empty();
      if (is_cut) made.heights.insert(made.heights.end(), {storey->bottom, storey->top});
    }
    if (part.cut.empty() && part.cellars.empty()) part.distance = distance_of(frame, building.outline);
    if (!part.cut.empty() || !part.cellars.empty() || !part.beyond.empty()) made.parts.push_back(std::move(part));
  }
  std::sort(made.heights.begin(), made.heights.end());
  const auto is_one = [](double a, double b) { return b - a < kOneHeight; };
  made.heights.erase(std::unique(made.heights.begin(), made.heights.end(), is_one), made.heights.end());
}

// Only what lies before or behind the proposal itself.
void add_neighbours(const SectionFrame& frame, const Proposal& proposal, Section& made) {
  for (const Neighbour& neighbour : proposal.neighbours) {
    if (!(neighbour.top > neighbour.bottom)) continue;
    SectionPart part;
    add_rectangles(frame.crossings({neighbour.face}), neighbour.bottom, neighbour.top, part.cut);
    add_rectangles(frame.behind({neighbour.face}), neighbour.bottom, neighbour.top, part.beyond);
    part.distance = part.cut.empty() ? distance_of(frame, {neighbour.face}) : 0;
    if (part.distance > kNearby) continue;
    std::erase_if(part.cut, [&](const Ring& ring) { return ring[1].x < made.low.x || ring[0].x > made.high.x; });
    std::erase_if(part.beyond, [&](const Ring& ring) { return ring[1].x < made.low.x || ring[0].x > made.high.x; });
    if (!part.cut.empty() || !part.beyond.empty()) made.parts.push_back(std::move(part));
  }
}

void add_ground(const SectionFrame& frame, const Proposal& proposal, Section& made) {
  for (const auto& terrain : proposal.terrains)
    for (const geometry::Polyline& line : frame.cut(*terrain)) made.grounds.push_back(flat(line.points));
  if (made.grounds.empty()) made.grounds.push_back({{made.low.x, proposal.ground, 0}, {made.high.x, proposal.ground, 0}});
  for (const Land& land : proposal.lands)
    for (const double at : frame.crossings(land.faces)) made.borders.push_back(at);
  std::sort(made.borders.begin(), made.borders.end());
}

void measure(const SectionFrame& frame, const Proposal& proposal, Section& made) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  made.low = {kFar, proposal.ground, 0};
  made.high = {-kFar, proposal.ground, 0};
  const auto take = [&](const std::vector<PlateFace>& faces) {
    for (const PlateFace& face : faces)
      for (const Point3& p : face.outer) {
        made.low.x = std::min(made.low.x, frame.along(p));
        made.high.x = std::max(made.high.x, frame.along(p));
      }
  };
  for (const Land& land : proposal.lands) take(land.faces);
  for (const Building& building : proposal.buildings) {
    take(building.outline);
    made.low.y = std::min(made.low.y, building.cellars.empty() ? building.bottom : building.cellars.back().bottom);
    made.high.y = std::max(made.high.y, building.top);
  }
}

// What a line cuts: the highest volume or not, and the area of all cuts, as if storeys were all alike [m²].
std::pair<bool, double> cut_by(const Proposal& proposal, const SectionLine& line, double highest) {
  const SectionFrame frame(line);
  std::pair<bool, double> sum{false, 0};
  for (const Building& building : proposal.buildings) {
    const std::vector<double> ends = frame.crossings(building.outline);
    double length = 0;
    for (std::size_t k = 0; k + 1 < ends.size(); k += 2) length += ends[k + 1] - ends[k];
    sum.first |= length > 0 && building.top >= highest - kOneHeight;
    sum.second += length * (building.top - building.bottom);
  }
  return sum;
}

// Parallel to a line, through the middle of a volume: where the highest one is cut, and most of all others.
SectionLine most_telling(const Proposal& proposal, const SectionLine& line) {
  const Vector3 way = line.to - line.from, left{-way.y / norm(way), way.x / norm(way), 0};
  double highest = -std::numeric_limits<double>::infinity();
  for (const Building& building : proposal.buildings) highest = std::max(highest, building.top);
  SectionLine best = line;
  std::pair<bool, double> most = cut_by(proposal, line, highest);
  const SectionFrame frame(line);
  for (const Building& building : proposal.buildings) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const PlateFace& face : building.outline)
      for (const Point3& p : face.outer) low = std::min(low, frame.left(p)), high = std::max(high, frame.left(p));
    if (!(low <= high)) continue;
    const Vector3 aside = (0.5 * (low + high)) * left;
    const SectionLine moved{line.from + aside, line.to + aside};
    // Of lines that cut as much the first counts.
    if (const auto cut = cut_by(proposal, moved, highest);
        cut.first > most.first || (cut.first == most.first && cut.second > most.second * (1 + 1e-9)))
      most = cut, best = moved;
  }
  return best;
}

}  // namespace

std::optional<double> level_cut(const std::string& text) {
  const auto height = parse_number(text);
  return height && std::abs(*height) < 1e9 ? std::optional(*height) : std::nullopt;
}

Result<void> check_level_cut(const Proposal& proposal, double height) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Building& b : proposal.buildings) {
    low = std::min(low, b.cellars.empty() ? b.bottom : b.cellars.back().bottom);
    high = std::max(high, b.top);
  }
  if (low <= height && height < high) return {};
  const auto told = [](double at) { return (at >= 0 ? "+" : "") + fixed(at, 2); };
  return Error{
      ErrorCode::out_of_range, "section",
      "a level cut at " + told(height) + " m meets no volume: they lie between " + told(low) + " m and " + told(high) + " m"};
}

Result<void> check_section(const Section& section) {
  if (!section.parts.empty() || !section.borders.empty()) return {};
  const Point3 &a = section.line.from, &b = section.line.to;
  return Error{ErrorCode::out_of_range, "section",
               "the line from (" + fixed(a.x, 1) + ", " + fixed(a.y, 1) + ") to (" + fixed(b.x, 1) + ", " + fixed(b.y, 1) +
                   ") crosses neither a plot nor a volume, and none lies behind it"};
}

LevelPart level_part(const Building& building, double height) {
  LevelPart part;
  for (const Storey* storey : drawn_storeys(building))
    if (storey->bottom <= height && height < storey->top) part.storey = storey;
  // What a rounded volume has above its last storey belongs to that.
  if (part.storey == nullptr && !building.is_standing && building.bottom <= height && height < building.top)
    for (const Storey& storey : building.storeys)
      if (part.storey == nullptr || storey.bottom <= height) part.storey = &storey;
  if (part.storey == nullptr) return part;
  if (building.is_standing || part.storey->number < 0) {
    part.faces = part.storey->faces;
    return part;
  }
  std::vector<Ring> rings;
  for (geometry::Polyline& line : geometry::section(*building.mesh, height, [](std::size_t) { return true; }))
    if (line.is_closed) rings.push_back(std::move(line.points));
  part.faces = faces_of_rings(std::move(rings));
  return part;
}

Result<SectionLine> section_line(const Proposal& proposal, const std::string& text) {
  std::string plain = text;
  std::replace(plain.begin(), plain.end(), ',', ' ');
  std::vector<double> numbers;
  for (std::size_t at = plain.find_first_not_of(' '); at != std::string::npos;) {
    const std::size_t end = std::min(plain.find(' ', at), plain.size());
    const auto number = parse_number(plain.substr(at, end - at));
    if (!number || !(std::abs(*number) < 1e9))
      return Error{ErrorCode::parse, "section", "expects X1,Y1,X2,Y2 in metres, or one height, found `" + text + "`"};
    numbers.push_back(*number);
    at = plain.find_first_not_of(' ', end);
  }
  if (!numbers.empty()) {
    if (numbers.size() != 4 || distance(Point3{numbers[0], numbers[1], 0}, Point3{numbers[2], numbers[3], 0}) < 1e-3)
      return Error{ErrorCode::parse, "section", "expects X1,Y1,X2,Y2, the two ends of a line in metres, found `" + text + "`"};
    return SectionLine{{numbers[0], numbers[1], 0}, {numbers[2], numbers[3], 0}};
  }
  const PlanExtent extent = plan_extent(proposal);
  const Point3 middle = 0.5 * (extent.low + extent.high);
  Vector3 way{1, 0, 0};
  double longest = 0;
  for (const Land& land : proposal.lands)
    for (const PlateFace& face : land.faces)
      for (std::size_t k = 0; k < face.outer.size(); ++k) {
        const Vector3 side = face.outer[(k + 1) % face.outer.size()] - face.outer[k];
        // Of equal sides the first counts.
        if (norm(side) > longest * (1 + 1e-9)) longest = norm(side), way = side / longest;
      }
  if (way.x < 0 || (way.x == 0 && way.y < 0)) way = -1 * way;
  const double half = distance(extent.low, extent.high) / 2;
  return most_telling(proposal, {middle - half * way, middle + half * way});
}

Section section_of(const Proposal& proposal, const SectionLine& line, bool with_surroundings) {
  const SectionFrame frame(line);
  Section made;
  made.line = line;
  measure(frame, proposal, made);
  add_buildings(frame, proposal, made);
  if (with_surroundings) add_neighbours(frame, proposal, made);
  std::stable_sort(made.parts.begin(), made.parts.end(),
                   [](const SectionPart& a, const SectionPart& b) { return a.distance > b.distance; });
  add_ground(frame, proposal, made);
  return made;
}

}  // namespace bl::exporting
