// Whole centimetres from one origin; cells go as polygons with their ball, which is far less than the triangles that they become.
#include "core/wire/shapes_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "core/geometry/plan_ring.h"
#include "core/reading/report_model.h"
#include "core/wire/plan_keys.h"

namespace bl::wire {

namespace {

constexpr double kCentimetres = 100;
// The origin lies on a grid, so that it stays where it is while volumes move [m].
constexpr double kOriginStep = 100;
constexpr std::size_t kMostCorners = 12;     // of the outline of an upright body
constexpr std::size_t kTerrainColumns = 40;  // along the longer side
constexpr double kLaneWidth = 3.25;          // [m]

double whole(double centimetres) { return std::round(centimetres); }

// Numbers of one content.
class List {
 public:
  explicit List(const Point3& origin) : origin_(origin) {}
  void point(const Point3& p) {
    for (const double c : {p.x - origin_.x, p.y - origin_.y, p.z - origin_.z}) add(c * kCentimetres);
  }
  void add(double number) { numbers_.push_back(whole(number)); }
  Numbers take() { return Numbers(std::move(numbers_)); }

 private:
  Point3 origin_;
  std::vector<double> numbers_;
};

// The triangles of a face share their first corner, which is the mean of the others; the second ones go round it
// (core/geometry/cell_mesh).
std::vector<std::vector<std::uint32_t>> faces_of(const Mesh& cell, std::size_t begin, std::size_t end) {
  std::vector<std::vector<std::uint32_t>> faces;
  for (std::size_t t = begin; t < end; ++t) {
    if (t == begin || cell.triangles[t][0] != cell.triangles[t - 1][0]) faces.emplace_back();
    faces.back().push_back(cell.triangles[t][1]);
  }
  return faces;
}

// Corners get their numbers when they are first used: the middles of faces get none.
class CornerNumbers {
 public:
  CornerNumbers(const Mesh& mesh, List& points, List& seams) : mesh_(mesh), points_(points), seams_(seams) {}
  double number(std::uint32_t vertex) {
    const auto [found, is_new] = numbers_.try_emplace(vertex, numbers_.size());
    if (is_new) {
      points_.point(mesh_.vertices[vertex]);
      const auto& marks = mesh_.wrap->seams;
      seams_.add(vertex < marks.size() ? marks[vertex] : 0);
    }
    return static_cast<double>(found->second);
  }

 private:
  const Mesh& mesh_;
  List &points_, &seams_;
  std::map<std::uint32_t, std::size_t> numbers_;
};

CellContent cell_of(const Mesh& cell, const Point3& origin) {
  const MeshWrap& wrap = *cell.wrap;
  CellContent content;
  List ball(origin), points(wrap.ball_centre), faces(origin), parts(wrap.ball_centre), seams(origin);
  ball.point(wrap.ball_centre);
  ball.add(wrap.radius * kCentimetres);
  CornerNumbers corners(cell, points, seams);
  std::size_t begin = 0;
  bool has_seams = false;
  for (const MeshWrap::Part& part : wrap.parts) {
    const auto polygons = faces_of(cell, begin, begin + part.triangles);
    begin += part.triangles;
    parts.add(static_cast<double>(polygons.size()));
    parts.add(static_cast<double>(part.seams.size()));
    parts.point(part.centre);
    for (const Point3& seam : part.seams) parts.point(seam);
    has_seams = has_seams || !part.seams.empty();
    for (const std::vector<std::uint32_t>& polygon : polygons) {
      faces.add(static_cast<double>(polygon.size()));
      for (const std::uint32_t corner : polygon) faces.add(corners.number(corner));
    }
  }
  content.ball = ball.take();
  content.points = points.take();
  content.faces = faces.take();
  content.parts = parts.take();
  if (has_seams) content.seams = seams.take();
  return content;
}

SurfaceContent surface_of(const Mesh& mesh, const Point3& origin) {
  List points(origin), triangles(origin);
  for (const Point3& vertex : mesh.vertices) points.point(vertex);
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t corner : triangle) triangles.add(corner);
  return {points.take(), triangles.take()};
}

// The convex outline without its least corners.
geometry::Ring few_corners(geometry::Ring ring) {
  while (ring.size() > kMostCorners) {
    std::size_t least = 0;
    double area = 0;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const double here = geometry::turn(ring[(k + ring.size() - 1) % ring.size()], ring[k], ring[(k + 1) % ring.size()]);
      if (k == 0 || here < area) least = k, area = here;
    }
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(least));
  }
  return ring;
}

PrismContent prism_of(const Mesh& mesh, const Point3& origin) {
  const geometry::Ring ring = few_corners(geometry::hull_of_plan(mesh.vertices));
  const auto [low, high] =
      std::minmax_element(mesh.vertices.begin(), mesh.vertices.end(), [](const Point3& a, const Point3& b) { return a.z < b.z; });
  PrismContent content;
  List places(origin);
  // To a decimetre: what is coarse need not be exact.
  const auto coarse = [](double metres) { return std::round(metres * 10) * 10 / kCentimetres; };
  for (const Point3& point : ring) {
    places.add(coarse(point.x - origin.x) * kCentimetres);
    places.add(coarse(point.y - origin.y) * kCentimetres);
  }
  content.ring = places.take();
  content.low = whole(coarse(low->z - origin.z) * kCentimetres);
  content.high = whole(coarse(high->z - origin.z) * kCentimetres);
  return content;
}

struct Extent {
  double low_x = 1e300, low_y = 1e300, high_x = -1e300, high_y = -1e300;
  void take(const Point3& p) {
    low_x = std::min(low_x, p.x), high_x = std::max(high_x, p.x);
    low_y = std::min(low_y, p.y), high_y = std::max(high_y, p.y);
  }
};

// The mean of the corners in each square. A square without a corner has the height kNoHeight.
constexpr double kNoHeight = -1000000;

std::optional<TerrainContent> terrain_of(const Mesh& mesh, const Point3& origin) {
  Extent extent;
  for (const Point3& vertex : mesh.vertices) extent.take(vertex);
  const double width = extent.high_x - extent.low_x, depth = extent.high_y - extent.low_y;
  if (!(std::max(width, depth) > 0)) return std::nullopt;
  // Fewer corners than squares would leave holes where there are none.
  const double corners = std::sqrt(static_cast<double>(mesh.vertices.size()));
  const double cell = std::max(width, depth) / std::max(1.0, std::min(static_cast<double>(kTerrainColumns), corners / 2));
  const auto count = [&](double length) { return static_cast<std::size_t>(std::floor(length / cell)) + 1; };
  const std::size_t columns = count(width), rows = count(depth);
  struct Mean {
    double sum = 0, count = 0;
  };
  std::vector<Mean> means(columns * rows);
  for (const Point3& vertex : mesh.vertices) {
    const auto place = [&](double at, std::size_t most) { return std::min(most - 1, static_cast<std::size_t>(at / cell)); };
    Mean& mean = means[place(vertex.y - extent.low_y, rows) * columns + place(vertex.x - extent.low_x, columns)];
    mean.sum += vertex.z;
    mean.count += 1;
  }
  List grid(origin), heights(origin);
  grid.add((extent.low_x + cell / 2 - origin.x) * kCentimetres);
  grid.add((extent.low_y + cell / 2 - origin.y) * kCentimetres);
  grid.add(cell * kCentimetres);
  grid.add(static_cast<double>(columns));
  for (const Mean& mean : means) heights.add(mean.count > 0 ? (mean.sum / mean.count - origin.z) * kCentimetres : kNoHeight);
  return TerrainContent{grid.take(), heights.take()};
}

LinesContent lines_of(const std::vector<std::vector<Point3>>& lines, bool is_closed, const Point3& origin) {
  List points(origin), counts(origin);
  for (const auto& line : lines) {
    counts.add(static_cast<double>(line.size()));
    for (const Point3& point : line) points.point(point);
  }
  return {points.take(), counts.take(), is_closed};
}

// Near the site, and else near the volumes; on a grid, so that it does not move with them.
Point3 origin_of(const reading::ReportModel& model) {
  Extent extent;
  for (const reading::SiteRow& site : model.sites)
    for (const geometry::Polyline& line : site.plan)
      for (const Point3& point : line.points) extent.take(point);
  if (extent.low_x > extent.high_x)
    for (const reading::VolumeRow& volume : model.volumes) extent.take(volume.figures.position);
  if (extent.low_x > extent.high_x) return {};
  const auto snap = [](double low, double high) { return std::round((low + high) / 2 / kOriginStep) * kOriginStep; };
  return {snap(extent.low_x, extent.high_x), snap(extent.low_y, extent.high_y), 0};
}

class ShapesView {
 public:
  ShapesView(const State& state, std::size_t most_bytes) : most_bytes_(most_bytes) {
    reading::read_model(state, model_);
    space_.origin = origin_of(model_);
    space_.true_north = model_.true_north;
  }

  std::map<std::string, std::string> made() {
    for (std::size_t k = 0; k < model_.surroundings.grounds.size(); ++k)
      if (const auto terrain = terrain_of(*model_.surroundings.grounds[k], space_.origin))
        put("terrain/" + std::to_string(k + 1), write_message(*terrain));
    add_outlines();
    add_volumes();
    add_surroundings();
    space_.ground = ground();
    view_["space"] = write_message(space_);
    return std::move(view_);
  }

 private:
  void put(const std::string& key, std::string content) {
    if (bytes_ + content.size() > most_bytes_) {
      ++space_.left_out;
      return;
    }
    bytes_ += content.size();
    view_[key] = std::move(content);
  }

  void add_outlines() {
    for (const reading::SiteRow& site : model_.sites) {
      std::vector<std::vector<Point3>> lines;
      for (const geometry::Polyline& line : site.ground.empty() ? site.plan : site.ground) lines.push_back(line.points);
      put("n/" + keys_.key("site", site.name), write_message(lines_of(lines, true, space_.origin)));
    }
    for (const auto& [name, ring] : model_.surroundings.plots)
      put("n/" + keys_.key("plot", name), write_message(lines_of({ring}, true, space_.origin)));
  }

  // The largest first: where there are too many, the smallest are left out.
  void add_volumes() {
    std::vector<const reading::VolumeRow*> rows;
    for (const reading::VolumeRow& volume : model_.volumes)
      if (volume.mesh) rows.push_back(&volume);
    space_.is_coarse = rows.size() > kMostCells;
    std::stable_sort(rows.begin(), rows.end(), [](const auto* a, const auto* b) { return a->volume > b->volume; });
    for (const reading::VolumeRow* row : rows) put("n/" + row->id, volume_text(*row));
  }

  std::string volume_text(const reading::VolumeRow& row) const {
    if (space_.is_coarse) return write_message(prism_of(*row.mesh, space_.origin));
    const std::shared_ptr<const Mesh>& cell = row.mesh.coarse();
    const double bottom = whole((row.figures.bottom - space_.origin.z) * kCentimetres),
                 storey = whole(row.figures.storey_height * kCentimetres);
    if (cell && cell->wrap) {
      CellContent content = cell_of(*cell, space_.origin);
      content.bottom = bottom, content.storey = storey;
      return write_message(content);
    }
    SurfaceContent content = surface_of(*row.mesh, space_.origin);
    content.bottom = bottom, content.storey = storey;
    return write_message(content);
  }

  void add_surroundings() {
    for (const reading::BuildingShape& building : model_.surroundings.buildings) {
      const std::string key = "n/" + keys_.key("building", building.name);
      if (building.mesh && !building.mesh->triangles.empty()) put(key, write_message(surface_of(*building.mesh, space_.origin)));
    }
    for (const reading::StreetLine& street : model_.surroundings.streets) {
      LinesContent content = lines_of({street.line}, false, space_.origin);
      content.width = whole(std::max(1.0, street.lanes) * kLaneWidth * kCentimetres);
      put("n/" + keys_.key("street", street.name), write_message(content));
    }
  }

  // What the site stands on; without one, what the lowest volume stands on.
  double ground() const {
    std::optional<double> lowest;
    const auto take = [&](double height) { lowest = lowest ? std::min(*lowest, height) : height; };
    for (const reading::SiteRow& site : model_.sites)
      if (site.shape) take(site.bottom);
    if (!lowest)
      for (const reading::VolumeRow& volume : model_.volumes)
        if (volume.mesh) take(volume.figures.bottom);
    return whole((lowest.value_or(0) - space_.origin.z) * kCentimetres);
  }

  reading::ReportModel model_;
  SpaceContent space_;
  PlanKeys keys_;
  std::map<std::string, std::string> view_;
  std::size_t bytes_ = 0, most_bytes_;
};

}  // namespace

void SpaceContent::declare(MessageBuilder<SpaceContent>& m) {
  m.id("space").doc("The key `space`: what all shapes stand in. Lengths of shapes are whole centimetres from the origin.");
  m.field(&SpaceContent::origin, "origin").required().doc("The origin, in metres of the scene.");
  m.field(&SpaceContent::true_north, "true_north").doc("Direction of true north, in degrees clockwise from the y axis.");
  m.field(&SpaceContent::ground, "ground").doc("Height of the ground where no terrain is known.");
  m.field(&SpaceContent::is_coarse, "is_coarse").doc("On where there are so many volumes that they are shown as upright bodies.");
  m.field(&SpaceContent::left_out, "left_out").min(0).doc("How many things are left out because there are too many.");
}
void CellContent::declare(MessageBuilder<CellContent>& m) {
  m.id("cell").doc("A volume: its cell as polygons, and the ball that they are wrapped onto.");
  m.field(&CellContent::ball, "ball").required().doc("Centre and radius of the ball: x, y, z, r.");
  m.field(&CellContent::points, "points").required().doc("Corners, from the ball's centre: x, y, z, and so on.");
  m.field(&CellContent::faces, "faces")
      .required()
      .doc("For each face the number of its corners, and its corners, counter-clockwise from outside.");
  m.field(&CellContent::parts, "parts")
      .required()
      .doc(
          "For each part the number of its faces and of its seams, and the points, from the ball's centre, that its corners move "
          "towards: one for all, and one for each seam.");
  m.field(&CellContent::seams, "seams").doc("For each corner the seams it lies on, as bits; missing where there are none.");
  m.field(&CellContent::bottom, "bottom").doc("Height of its lowest point.");
  m.field(&CellContent::storey, "storey").doc("Height of a storey; 0 where there are none.");
}
void PrismContent::declare(MessageBuilder<PrismContent>& m) {
  m.id("prism").doc("A volume as an upright body over its outline.");
  m.field(&PrismContent::ring, "ring").required().doc("The outline, counter-clockwise: x, y, and so on.");
  m.field(&PrismContent::low, "low").doc("Height of its underside.");
  m.field(&PrismContent::high, "high").doc("Height of its top.");
}
void SurfaceContent::declare(MessageBuilder<SurfaceContent>& m) {
  m.id("surface").doc("A body as triangles: a building, or a volume without a ball.");
  m.field(&SurfaceContent::points, "points").required().doc("Corners: x, y, z, and so on.");
  m.field(&SurfaceContent::triangles, "triangles").required().doc("Three corners each, counter-clockwise from outside.");
  m.field(&SurfaceContent::bottom, "bottom").doc("Height of its lowest point.");
  m.field(&SurfaceContent::storey, "storey").doc("Height of a storey; 0 where there are none.");
}
void LinesContent::declare(MessageBuilder<LinesContent>& m) {
  m.id("lines").doc("A street, or the outlines of a plot or a boundary.");
  m.field(&LinesContent::points, "points").required().doc("Points of all lines: x, y, z, and so on.");
  m.field(&LinesContent::counts, "counts").required().doc("How many points each line has.");
  m.field(&LinesContent::is_closed, "is_closed").doc("On where each line ends where it begins.");
  m.field(&LinesContent::width, "width").doc("Width of a street.");
}
void TerrainContent::declare(MessageBuilder<TerrainContent>& m) {
  m.id("terrain").doc("The ground as heights on a grid.");
  m.field(&TerrainContent::grid, "grid")
      .required()
      .doc("x and y of the first point, the distance of neighbouring points, and how many stand in a row from west to east.");
  m.field(&TerrainContent::heights, "heights")
      .required()
      .doc("Heights, row by row from south to north; -1000000 where none is known.");
}

std::vector<const MessageDefinition*> shape_kinds() {
  return {&message_kind<SpaceContent>(),   &message_kind<CellContent>(),  &message_kind<PrismContent>(),
          &message_kind<SurfaceContent>(), &message_kind<LinesContent>(), &message_kind<TerrainContent>()};
}

std::map<std::string, std::string> shapes_view(const State& state, std::size_t most_bytes) {
  return ShapesView(state, most_bytes).made();
}

}  // namespace bl::wire
