// The cells of one power diagram hide each other in the order of their sites along the view (Edelsbrunner 1990), so that
// painting them from the farthest site to the nearest is exact; diagrams among each other go by the middle of their volumes.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <string_view>
#include <utility>

#include "core/base/text.h"
#include "core/drawing/furniture.h"
#include "core/drawing/pictures.h"
#include "core/drawing/solid_drawing.h"
#include "core/drawing/surroundings_drawing.h"
#include "core/reading/figures.h"

namespace bl::drawing {

namespace {

constexpr double kAxonometryWidth = 1000, kMostAxonometryHeight = 760;
// So much of what stands around is shown, as a share of the site's larger side: more would make the proposal small.
constexpr double kAroundAside = 0.35;
constexpr double kAzimuth = 150, kElevation = 33;

// Light from the left, behind the eye's shoulder: the convention of architectural drawings, not the sun of a day.
Vector3 sun_of(const View& view) {
  const Vector3 forward = cross(view.right, {0, 0, 1}) * 0.32;
  const Vector3 sun = view.right * -0.62 + forward + Vector3{0, 0, 0.72};
  return sun / norm(sun);
}

struct Scenery {
  std::vector<Point3> content;
  double ground = 0;
  Vector3 to_sun;
};

Point3 shadow_of(const Point3& point, const Scenery& scenery) {
  return point - scenery.to_sun * (std::max(0.0, point.z - scenery.ground) / scenery.to_sun.z);
}

Scenery scenery_of(const reading::ReportModel& model, const View& view) {
  Scenery scenery{{}, 0, sun_of(view)};
  bool is_first = true;
  const auto lower = [&](double z) {
    scenery.ground = is_first ? z : std::min(scenery.ground, z);
    is_first = false;
  };
  for (const reading::SiteRow& site : model.sites)
    if (site.shape) lower(site.bottom);
  if (is_first)
    for (const reading::VolumeRow& volume : model.volumes)
      if (volume.mesh)
        for (const Point3& vertex : volume.mesh->vertices) lower(vertex.z);
  for (const reading::SiteRow& site : model.sites)
    if (site.shape) scenery.content.insert(scenery.content.end(), site.shape->vertices.begin(), site.shape->vertices.end());
  for (const reading::VolumeRow& volume : model.volumes)
    if (volume.mesh)
      for (const Point3& vertex : volume.mesh->vertices) {
        scenery.content.push_back(vertex);
        scenery.content.push_back(shadow_of(vertex, scenery));
      }
  return scenery;
}

// A volume, or the part of it between two heights, where others of its building lie beside, below and above.
struct VolumePiece {
  const reading::VolumeRow* volume = nullptr;
  std::shared_ptr<const Mesh> mesh;  // of a part; null: the whole volume
  double storey_height = 0;          // [m]
};

// Those that stand about one centre share a footprint.
std::vector<VolumePiece> pieces_of(const reading::VolumeRow& volume, const std::map<std::pair<double, double>, int>& centres) {
  constexpr double kChords = 0.05;  // [m]
  const geometry::StandingBody& body = volume.body;
  const auto sharing = body.stacks.empty() ? centres.end() : centres.find({body.centre.x, body.centre.y});
  std::vector<VolumePiece> pieces;
  if (sharing != centres.end() && sharing->second > 1 && body.stacks.size() > 1)
    for (const geometry::PlateStack& stack : body.stacks)
      pieces.push_back(
          {&volume, std::make_shared<const Mesh>(geometry::mesh_of({body.centre, {stack}}, kChords)), stack.storey_height});
  else pieces.push_back({&volume, nullptr, volume.figures.storey_height});
  return pieces;
}

std::vector<VolumePiece> back_to_front(const reading::ReportModel& model, const View& view) {
  std::map<std::size_t, std::pair<double, double>> groups;
  std::map<std::pair<double, double>, int> centres;  // of standing volumes, with how many stand about each
  std::map<std::string_view, const reading::VolumeRow*> by_id;
  for (const reading::VolumeRow& volume : model.volumes) {
    auto& [sum, count] = groups[volume.group];
    sum += dot(volume.figures.position, view.toward);
    count += 1;
    by_id.emplace(volume.id, &volume);
    if (!volume.body.stacks.empty()) ++centres[{volume.body.centre.x, volume.body.centre.y}];
  }
  // Whoever stands on a roof hides, and is hidden, where the building on the ground does; among themselves the lower comes first.
  const auto on_ground = [&](const reading::VolumeRow* volume) {
    for (std::size_t k = 0; k < by_id.size() && !volume->body.stacks.empty(); ++k) {
      const auto base = by_id.find(volume->figures.stands_on);
      if (base == by_id.end()) break;
      volume = base->second;
    }
    return volume;
  };
  const auto middle_of = [](const Mesh& mesh) {
    Point3 sum;
    for (const Point3& vertex : mesh.vertices) sum += vertex / static_cast<double>(mesh.vertices.size());
    sum.z = 0;
    return sum;
  };
  std::vector<std::pair<std::array<double, 5>, VolumePiece>> order;
  for (const reading::VolumeRow& volume : model.volumes) {
    if (!volume.mesh) continue;
    const auto& [sum, count] = groups[volume.group];
    const reading::VolumeRow& base = *on_ground(&volume);
    const bool stands = !volume.body.stacks.empty();
    const double place = dot(base.body.stacks.empty() ? base.figures.position : base.body.centre, view.toward);
    std::size_t stack = 0;
    for (VolumePiece& piece : pieces_of(volume, centres)) {
      const double level = stands ? volume.body.stacks[stack].bottom : 0;
      // Parts of one storey lie beside each other, cut straight across.
      const double beside = stands ? dot(middle_of(piece.mesh ? *piece.mesh : *volume.mesh), view.toward) : 0;
      order.push_back({{sum / count, static_cast<double>(volume.group), place, level, beside}, std::move(piece)});
      ++stack;
    }
  }
  std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<VolumePiece> out;
  for (auto& [key, piece] : order) out.push_back(std::move(piece));
  return out;
}

// Each volume where its last piece is.
std::vector<const reading::VolumeRow*> volumes_in(const std::vector<VolumePiece>& pieces, const reading::ReportModel& model) {
  std::vector<bool> is_there(model.volumes.size(), false);
  std::vector<const reading::VolumeRow*> volumes;
  for (auto piece = pieces.rbegin(); piece != pieces.rend(); ++piece) {
    const auto row = static_cast<std::size_t>(piece->volume - model.volumes.data());
    if (!is_there[row]) volumes.push_back(piece->volume);
    is_there[row] = true;
  }
  std::reverse(volumes.begin(), volumes.end());
  return volumes;
}

// The plot with a grid of round metres, so that the eye has a measure for depth too.
double draw_ground(Markup& svg, const Sheet& sheet, const reading::ReportModel& model, const std::string& id) {
  PathText ground;
  double low_x = 0, high_x = 0, low_y = 0, high_y = 0, z = 0;
  bool is_first = true;
  for (const reading::SiteRow& site : model.sites)
    for (const geometry::Polyline& line : site.ground) {
      ground.polyline(on_sheet(sheet, line), line.is_closed);
      for (const Point3& p : line.points) {
        low_x = is_first ? p.x : std::min(low_x, p.x);
        high_x = is_first ? p.x : std::max(high_x, p.x);
        low_y = is_first ? p.y : std::min(low_y, p.y);
        high_y = is_first ? p.y : std::max(high_y, p.y);
        z = is_first ? site.bottom : std::min(z, site.bottom);
        is_first = false;
      }
    }
  if (ground.empty()) return 0;
  const double step = round_length(std::max(high_x - low_x, high_y - low_y) / 5);
  svg.open("clipPath", {{"id", id + "-plot"}}).path(ground, {{"clip-rule", "evenodd"}}).close();
  svg.path(ground, {{"fill", hex(mix(kPaper, {0.78, 0.76, 0.70}, 0.42))}, {"fill-rule", "evenodd"}});
  PathText grid;
  for (double x = std::ceil(low_x / step) * step; x < high_x; x += step)
    grid.polyline({sheet.at({x, low_y, z}), sheet.at({x, high_y, z})}, false);
  for (double y = std::ceil(low_y / step) * step; y < high_y; y += step)
    grid.polyline({sheet.at({low_x, y, z}), sheet.at({high_x, y, z})}, false);
  svg.path(grid, {{"clip-path", "url(#" + id + "-plot)"}, {"fill", "none"}, {"stroke", hex(kPaper)}, {"stroke-width", ".9"}});
  svg.path(ground, {{"fill", "none"}, {"stroke", hex(kInk)}, {"stroke-width", "1.3"}, {"stroke-linejoin", "round"}});
  return step;
}

void draw_shadows(Markup& svg, const Sheet& sheet, const reading::ReportModel& model, const Scenery& scenery) {
  PathText shadows;
  for (const reading::VolumeRow& volume : model.volumes) {
    if (!volume.mesh) continue;
    const auto add_shadow = [&](const std::vector<Point3>& points) {
      std::vector<Pixel> cast;
      for (const Point3& point : points) cast.push_back(sheet.at(shadow_of(point, scenery)));
      shadows.polyline(simplified(convex_outline(std::move(cast)), true), true);
    };
    if (volume.exact.radius > 0) add_shadow(outline_of(volume.exact, scenery.to_sun));
    else
      for (const Mesh& body : geometry::bodies_of(*volume.mesh)) add_shadow(body.vertices);
  }
  svg.path(shadows, {{"fill", hex(kShade)}, {"fill-opacity", ".16"}, {"fill-rule", "nonzero"}});
}

// Edges of the boundary: hidden ones go behind the volumes, near ones in front of them.
void draw_envelope(Markup& svg, const Sheet& sheet, const reading::ReportModel& model, bool near) {
  PathText path;
  for (const reading::SiteRow& site : model.sites) {
    if (!site.shape) continue;
    const Mesh& mesh = *site.shape;
    const std::vector<Vector3> normals = geometry::unit_normals(mesh);
    const auto faces_eye = [&](std::uint32_t t) { return dot(normals[t], sheet.view().toward) > 1e-9; };
    for (const geometry::MeshEdge& edge : geometry::mesh_edges(mesh)) {
      const bool is_fold = dot(normals[edge.first], normals[edge.second]) < 0.985;
      if (is_fold && near == (faces_eye(edge.first) || faces_eye(edge.second)))
        path.polyline({sheet.at(mesh.vertices[edge.a]), sheet.at(mesh.vertices[edge.b])}, false);
    }
  }
  svg.path(path, {{"fill", "none"},
                  {"stroke", hex(kInk)},
                  {"stroke-width", near ? ".8" : ".6"},
                  {"stroke-opacity", near ? ".55" : ".4"},
                  {"stroke-dasharray", near ? "7 3 1.5 3" : "2 3"}});
}

void draw_piece(Markup& svg, const Sheet& sheet, const VolumePiece& piece, const Palette& palette, const Scenery& scenery,
                bool has_storeys, const std::string& id) {
  const reading::VolumeRow& volume = *piece.volume;
  svg.open("g");
  svg.element("title", std::to_string(volume.number) + ". " + volume.name + (volume.use.empty() ? "" : ", " + volume.use) + ": " +
                           reading::quantity(volume.floor_area, Unit::square_metre) + " floor area, " +
                           reading::quantity(volume.volume, Unit::cubic_metre));
  const SolidStyle style{palette.colour(volume.use), scenery.to_sun, has_storeys ? piece.storey_height : 0, volume.figures.bottom,
                         volume.figures.bottom + volume.figures.height};
  if (volume.exact.radius > 0)
    draw_ball(svg, sheet, volume.exact, style, id + "-shade-" + palette.letter(volume.use),
              id + "-ball-" + std::to_string(volume.number));
  else draw_solid(svg, sheet, piece.mesh ? *piece.mesh : *volume.mesh, style);
  svg.close();
}

// Where a label can stand on a volume: its roof, or else the middle of whatever of it is not hidden.
class Anchors {
 public:
  Anchors(const Sheet& sheet, const std::vector<const reading::VolumeRow*>& order) : sheet_(sheet), order_(order) {
    for (const reading::VolumeRow* volume : order) outlines_.push_back(convex_outline(sheet, *volume));
  }

  bool find(std::size_t rank, Pixel& anchor) const {
    const Mesh& mesh = *order_[rank]->mesh;
    const std::vector<Vector3> normals = geometry::unit_normals(mesh);
    Pixel roof{}, seen{};
    double roof_area = 0, seen_area = 0;
    std::vector<std::pair<Pixel, double>> visible;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const double facing = dot(normals[t], sheet_.view().toward);
      if (facing <= 0) continue;
      const auto& [a, b, c] = mesh.triangles[t];
      const Pixel at = sheet_.at((mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3);
      if (is_hidden(rank, at)) continue;
      const double area = facing * norm(cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]));
      visible.emplace_back(at, area);
      add(seen, seen_area, at, area);
      if (normals[t].z > 0.5) add(roof, roof_area, at, area);
    }
    if (seen_area <= 0) return false;
    const bool has_roof = roof_area > 0.25 * seen_area;
    anchor = has_roof ? Pixel{roof.x / roof_area, roof.y / roof_area} : Pixel{seen.x / seen_area, seen.y / seen_area};
    if (is_inside(outlines_[rank], anchor) && !is_hidden(rank, anchor)) return true;
    anchor =
        std::max_element(visible.begin(), visible.end(), [](const auto& a, const auto& b) { return a.second < b.second; })->first;
    return true;
  }

 private:
  static void add(Pixel& sum, double& total, Pixel at, double area) {
    sum = {sum.x + at.x * area, sum.y + at.y * area};
    total += area;
  }
  bool is_hidden(std::size_t rank, Pixel at) const {
    for (std::size_t nearer = rank + 1; nearer < outlines_.size(); ++nearer)
      if (is_inside(outlines_[nearer], at)) return true;
    return false;
  }

  const Sheet& sheet_;
  const std::vector<const reading::VolumeRow*>& order_;
  std::vector<std::vector<Pixel>> outlines_;
};

// Returns a sentence on what could not be labelled.
std::string write_labels(Markup& svg, const Sheet& sheet, const std::vector<const reading::VolumeRow*>& order,
                         const Palette& palette) {
  if (order.size() > kMostNumbers) return " Too many volumes for labels: pointing at one shows its number and name.";
  const Anchors anchors(sheet, order);
  std::vector<std::pair<const reading::VolumeRow*, Label>> found;
  std::size_t hidden = 0;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    const reading::VolumeRow& volume = *order[rank];
    Label label{{},
                volume.name,
                palette.letter(volume.use) + " \xC2\xB7 " + reading::quantity(volume.floor_area, Unit::square_metre),
                std::to_string(volume.number)};
    if (anchors.find(rank, label.anchor)) found.emplace_back(&volume, std::move(label));
    else ++hidden;
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first->volume > b.first->volume; });
  std::vector<Label> labels;
  for (auto& [volume, label] : found) labels.push_back(std::move(label));
  const Box frame{4, 4, sheet.width() - 4, sheet.height() - 44};
  LabelPlacer placer(frame, {{sheet.width() - 80, 0, sheet.width(), 80}});
  const std::size_t crowded = placer.write(svg, labels, order.size() > kMostNames ? 0 : labels.size());
  if (hidden + crowded == 0) return "";
  std::string text = " Without a label: ";
  if (hidden > 0) text += reading::counted(hidden, "volume") + " hidden behind others";
  if (crowded > 0) text += (hidden > 0 ? ", " : "") + reading::counted(crowded, "volume") + " for want of room";
  return text + ".";
}

// With the corners of the ground that is drawn around the site.
std::vector<Point3> with_corners(const Scenery& scenery, const std::vector<Point3>& frame) {
  std::vector<Point3> content = scenery.content;
  if (frame.size() == 2)
    for (const double x : {frame[0].x, frame[1].x})
      for (const double y : {frame[0].y, frame[1].y}) content.push_back({x, y, scenery.ground});
  return content;
}

}  // namespace

std::vector<Point3> points_of_axonometry(const reading::ReportModel& model) {
  const Scenery scenery = scenery_of(model, axonometric_view(kAzimuth, kElevation));
  if (scenery.content.empty()) return {};
  return with_corners(scenery, framed(scenery.content, model.surroundings, kAroundAside));
}

Picture draw_axonometry(const reading::ReportModel& model, const Palette& palette, const std::string& id,
                        const std::vector<Point3>& shown) {
  const View view = axonometric_view(kAzimuth, kElevation);
  const Scenery scenery = scenery_of(model, view);
  if (scenery.content.empty())
    return {empty_picture(id, "Axonometry", "Nothing to draw: there is no boundary, and no volume has a shape."), ""};
  const std::vector<Point3> frame = framed(scenery.content, model.surroundings, kAroundAside);
  Point3 middle;
  for (const Point3& corner : frame) middle += corner / static_cast<double>(frame.size());
  const Sheet sheet(view, shown.empty() ? with_corners(scenery, frame) : shown, kAxonometryWidth, kMostAxonometryHeight,
                    {40, 34, 40, 52});
  const std::vector<VolumePiece> pieces = back_to_front(model, view);
  const std::vector<const reading::VolumeRow*> order = volumes_in(pieces, model);
  Markup svg;
  open_picture(svg, sheet.width(), sheet.height(), id, "Axonometry",
               "The proposal seen from above and aside: " + reading::counted(order.size(), "volume") +
                   " on the site, coloured and lettered by use.");
  draw_ground_aside(svg, sheet, model.surroundings, frame, scenery.ground, id);
  const double grid = draw_ground(svg, sheet, model, id);
  draw_buildings_aside(svg, sheet, model.surroundings, frame, middle, scenery.to_sun, false);
  draw_shadows(svg, sheet, model, scenery);
  draw_envelope(svg, sheet, model, false);
  for (const reading::UseAccount& use : model.accounts.uses)
    define_ball(svg, view, {palette.colour(use.use), scenery.to_sun, 0, 0, 0}, id + "-shade-" + palette.letter(use.use));
  const bool has_storeys = order.size() <= kMostStoreys;
  for (const VolumePiece& piece : pieces) draw_piece(svg, sheet, piece, palette, scenery, has_storeys, id);
  draw_envelope(svg, sheet, model, true);
  draw_buildings_aside(svg, sheet, model.surroundings, frame, middle, scenery.to_sun, true);
  const std::string missing = write_labels(svg, sheet, order, palette);
  draw_scale_bar(svg, sheet.scale(), {24, sheet.height() - 18}, 170);
  draw_north(svg, view, model.true_north, {sheet.width() - 44, 40}, 26);
  svg.close();
  std::string caption =
      "Axonometry: parallel projection, so equal lengths in one direction are equal everywhere; the bar holds for lines across "
      "the sheet.";
  if (grid > 0) caption += " Ground grid " + shortest(grid) + " m; dash-dotted, the boundary.";
  if (has_storeys && !order.empty()) caption += " Fine lines on the volumes are storey levels.";
  if (!model.surroundings.is_empty())
    caption +=
        " Around the site: streets with their load, sun on flat receivers, and existing buildings, pale where they stand before "
        "it.";
  caption += " Light and shadow are a drawing convention, not a sun study.";
  return {svg.str(), caption + missing};
}

}  // namespace bl::drawing
