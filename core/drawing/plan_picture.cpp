// The plan: what stands above as tinted outlines, what is cut at eye height as solid shapes, and who is linked to whom.
#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/text.h"
#include "core/drawing/furniture.h"
#include "core/drawing/link_families.h"
#include "core/drawing/pictures.h"
#include "core/drawing/solid_drawing.h"
#include "core/drawing/surroundings_drawing.h"
#include "core/geometry/cell_mesh.h"
#include "core/geometry/tessellate.h"
#include "core/reading/figures.h"
#include "core/reading/views/node.h"

namespace bl::drawing {

namespace {

constexpr double kPlanWidth = 1000, kMostHeight = 900, kFrame = 44;
constexpr double kEyeHeight = 1.2;  // [m] above the ground
constexpr double kLegendRow = 17;

std::vector<Point3> content_of(const reading::ReportModel& model) {
  std::vector<Point3> content;
  for (const reading::SiteRow& site : model.sites)
    if (site.shape) content.insert(content.end(), site.shape->vertices.begin(), site.shape->vertices.end());
  for (const reading::VolumeRow& volume : model.volumes) {
    if (volume.mesh) content.insert(content.end(), volume.mesh->vertices.begin(), volume.mesh->vertices.end());
    else content.push_back(volume.figures.position);
  }
  return content;
}

double ground_of(const reading::ReportModel& model) {
  double ground = 0;
  bool is_first = true;
  const auto lower = [&](double z) {
    ground = is_first ? z : std::min(ground, z);
    is_first = false;
  };
  for (const reading::SiteRow& site : model.sites)
    if (site.shape) lower(site.bottom);
  if (is_first)
    for (const reading::VolumeRow& volume : model.volumes)
      if (volume.mesh) lower(volume.figures.bottom);
  return ground;
}

// Multiples of a round length, without the dust of floating point.
std::string figure_of(double metres) { return shortest(std::round(metres * 1e6) / 1e6 + 0.0); }

// Lines of round metres with their figures along the frame, so that positions can be read off.
double draw_grid(Markup& svg, const Sheet& sheet, double bottom) {
  const Pixel origin = sheet.at({0, 0, 0});
  const double step = round_length(sheet.width() / 6 / sheet.scale());
  const double left = kFrame, right = sheet.width() - kFrame, top = 30;
  PathText grid;
  const auto metre_x = [&](double x) { return (x - origin.x) / sheet.scale(); };
  const auto metre_y = [&](double y) { return (origin.y - y) / sheet.scale(); };
  Markup figures;
  for (double k = std::ceil(metre_x(left) / step); k * step <= metre_x(right); k += 1) {
    const double x = origin.x + k * step * sheet.scale();
    grid.polyline({{x, top}, {x, bottom}}, false);
    figures.element("text", figure_of(k * step), {{"x", pixels(x)}, {"y", pixels(top - 6)}, {"class", "figure"}});
  }
  for (double k = std::ceil(metre_y(bottom) / step); k * step <= metre_y(top); k += 1) {
    const double y = origin.y - k * step * sheet.scale();
    grid.polyline({{left, y}, {right, y}}, false);
    figures.element("text", figure_of(k * step), {{"x", pixels(left - 6)}, {"y", pixels(y + 3.5)}, {"class", "figure end"}});
  }
  svg.path(grid, {{"fill", "none"}, {"stroke", "#d9d5ca"}, {"stroke-width", ".7"}});
  svg.raw(figures.str());
  return step;
}

void draw_sites(Markup& svg, const Sheet& sheet, const reading::ReportModel& model) {
  PathText ground, plan;
  for (const reading::SiteRow& site : model.sites) {
    for (const geometry::Polyline& line : site.ground) ground.polyline(on_sheet(sheet, line), line.is_closed);
    for (const geometry::Polyline& line : site.plan) plan.polyline(on_sheet(sheet, line), line.is_closed);
  }
  svg.path(ground, {{"fill", hex(mix(kPaper, {0.78, 0.76, 0.70}, 0.3))}, {"fill-rule", "evenodd"}});
  svg.path(plan, {{"fill", "none"}, {"stroke", hex(kInk)}, {"stroke-width", "1.6"}, {"stroke-dasharray", "9 3 1.5 3"}});
}

// A volume with what is drawn of it: its exact form, or a mesh so fine that its corners do not show.
struct DrawnVolume {
  const reading::VolumeRow* row;
  MeshPointer fine;  // none where the exact form is known
};

constexpr double kPlateTolerance = 0.005;  // [m] that an arc may lie off its chords

void add_plate(const Sheet& sheet, const geometry::StandingBody& body, const geometry::PlateStack& stack, PathText& path) {
  for (const geometry::PlateFace& face : geometry::faces_of(stack, body.centre, kPlateTolerance)) {
    path.polyline(on_sheet(sheet, {face.outer, true}), true);
    for (const geometry::Ring& courtyard : face.holes) path.polyline(on_sheet(sheet, {courtyard, true}), true);
  }
}

PathText cut_of(const Sheet& sheet, const DrawnVolume& volume, double z) {
  PathText path;
  for (const geometry::PlateStack& stack : volume.row->body.stacks)
    if (stack.bottom <= z && z < stack.top()) add_plate(sheet, volume.row->body, stack, path);
  if (!volume.row->body.stacks.empty()) return path;
  if (!volume.fine) path.polyline(on_sheet(sheet, {section_of(volume.row->exact, z), true}), true);
  else
    for (const geometry::Polyline& line : geometry::section(*volume.fine, z, [](std::size_t) { return true; }))
      path.polyline(on_sheet(sheet, line), line.is_closed);
  return path;
}

// Pieces whose outlines have more in common than this share of the footprint lie over one another.
constexpr double kMostOverlap = 0.01;

double area_of(const std::vector<Pixel>& ring) {
  double twice = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Pixel &a = ring[i], &b = ring[(i + 1) % ring.size()];
    twice += a.x * b.y - b.x * a.y;
  }
  return std::abs(twice) / 2;
}

// The corners of each piece of the cell: the fine triangles come in the order of the coarse ones.
std::vector<std::vector<Point3>> pieces_of(const DrawnVolume& volume) {
  std::vector<std::vector<Point3>> pieces;
  const std::shared_ptr<const Mesh>& coarse = volume.row->mesh.coarse();
  if (!coarse || !coarse->wrap || volume.fine == volume.row->mesh) {
    for (const Mesh& body : geometry::bodies_of(*volume.fine)) pieces.push_back(body.vertices);
    return pieces;
  }
  const std::size_t share = volume.fine->triangles.size() / std::max<std::size_t>(1, coarse->triangles.size());
  std::size_t at = 0;
  for (const MeshWrap::Part& part : coarse->wrap->parts) {
    std::vector<Point3>& corners = pieces.emplace_back();
    for (const std::size_t end = at + part.triangles * share; at < end; ++at)
      for (const std::uint32_t v : volume.fine->triangles[at]) corners.push_back(volume.fine->vertices[v]);
  }
  return pieces;
}

PathText shadow_of(const Sheet& sheet, const DrawnVolume& volume) {
  PathText path;
  if (const geometry::StandingBody& body = volume.row->body; !body.stacks.empty()) {
    // Upper plates are set back, so that the lowest one is what all of them cover.
    add_plate(sheet, body, body.stacks.front(), path);
    return path;
  }
  if (!volume.fine) {
    path.polyline(simplified(convex_outline(sheet, *volume.row), true), true);
    return path;
  }
  // Each piece of a cell is convex, and mostly one stands beside the other: then what their outlines do not share is the outline
  // of all. Where one lies over another, what faces upward says it, though less smoothly.
  std::vector<std::vector<Pixel>> pieces;
  double area = 0;
  for (const std::vector<Point3>& corners : pieces_of(volume)) {
    std::vector<Pixel> places;
    for (const Point3& corner : corners) places.push_back(sheet.at(corner));
    pieces.push_back(convex_outline(std::move(places)));
    area += area_of(pieces.back());
  }
  const double footprint = volume.row->figures.footprint * sheet.scale() * sheet.scale();
  if (area <= (1 + kMostOverlap) * footprint) {
    for (const auto& line : common_outline(pieces)) path.polyline(simplified(line, true), true);
  } else {
    for (const geometry::Polyline& line : geometry::seen_from_above(*volume.fine))
      path.polyline(on_sheet(sheet, line), line.is_closed);
  }
  return path;
}

// Where upper storeys are set back, their edges are seen on the roof below.
void draw_roofs(Markup& svg, const Sheet& sheet, const reading::VolumeRow& volume, const std::string& ink) {
  PathText path;
  for (std::size_t k = 1; k < volume.body.stacks.size(); ++k) add_plate(sheet, volume.body, volume.body.stacks[k], path);
  if (volume.body.stacks.size() > 1) svg.path(path, {{"fill", "none"}, {"stroke", ink}, {"stroke-width", ".6"}});
}

void draw_volumes(Markup& svg, const Sheet& sheet, const reading::ReportModel& model, const Palette& palette, double cut) {
  std::vector<DrawnVolume> order;
  for (const reading::VolumeRow& volume : model.volumes)
    if (volume.mesh)
      order.push_back(
          {&volume, volume.exact.radius > 0 ? nullptr : geometry::mesh_of_depth(volume.mesh, geometry::kDeepestTessellation)});
  const auto top_of = [](const DrawnVolume& volume) { return volume.row->figures.bottom + volume.row->figures.height; };
  std::stable_sort(order.begin(), order.end(), [&](const DrawnVolume& a, const DrawnVolume& b) { return top_of(a) < top_of(b); });
  std::vector<PathText> cuts;
  for (const DrawnVolume& volume : order) {
    cuts.push_back(cut_of(sheet, volume, cut));
    svg.path(cuts.back(), {{"fill", hex(mix(palette.colour(volume.row->use), kShade, 0.12))}, {"fill-rule", "evenodd"}});
  }
  for (const DrawnVolume& volume : order) {
    const Colour colour = palette.colour(volume.row->use);
    svg.open("g").element("title", std::to_string(volume.row->number) + ". " + volume.row->name + ": " +
                                       reading::quantity(volume.row->figures.bottom, Unit::metre) + " to " +
                                       reading::quantity(top_of(volume), Unit::metre) + " above the origin");
    svg.path(shadow_of(sheet, volume), {{"fill", hex(colour)},
                                        {"fill-opacity", ".3"},
                                        {"fill-rule", "evenodd"},
                                        {"stroke", hex(mix(colour, kInk, 0.55))},
                                        {"stroke-width", ".9"}});
    draw_roofs(svg, sheet, *volume.row, hex(mix(colour, kInk, 0.55)));
    svg.close();
  }
  for (const PathText& path : cuts)
    svg.path(path, {{"fill", "none"}, {"stroke", hex(kInk)}, {"stroke-width", "1.7"}, {"stroke-linejoin", "round"}});
}

// Of a volume, where it is; of another node, its position.
Point3 place_in(const State& state, const reading::ReportModel& model, std::uint32_t node) {
  const auto row =
      std::find_if(model.volumes.begin(), model.volumes.end(), [&](const reading::VolumeRow& v) { return v.node == node; });
  return row != model.volumes.end() ? row->place : reading::read<&reading::NodePlace::position>(state, node);
}

void draw_links(Markup& svg, const State& state, const Sheet& sheet, const reading::ReportModel& model, const DrawnLinks& links) {
  for (const DrawnLink& link : links.lines) {
    const Pixel a = sheet.at(place_in(state, model, link.from)), b = sheet.at(place_in(state, model, link.to));
    // Bent to one side, so that links of two families between the same nodes stay apart.
    const double bend = 0.07 + 0.05 * static_cast<double>(link.ink->label.size() % 3);
    const Pixel middle{(a.x + b.x) / 2 - (b.y - a.y) * bend, (a.y + b.y) / 2 + (b.x - a.x) * bend};
    const std::string d = "M" + pixels(a.x) + " " + pixels(a.y) + "Q" + pixels(middle.x) + " " + pixels(middle.y) + " " +
                          pixels(b.x) + " " + pixels(b.y);
    svg.open("path", {{"d", d},
                      {"fill", "none"},
                      {"stroke", std::string(link.ink->colour)},
                      {"stroke-width", "1.5"},
                      {"stroke-dasharray", std::string(link.ink->dashes)},
                      {"stroke-linecap", "butt"}});
    svg.element("title", link.title).close();
  }
}

void draw_positions(Markup& svg, const State& state, const Sheet& sheet, const reading::ReportModel& model,
                    const DrawnLinks& links) {
  std::set<std::uint32_t> nodes;
  for (const DrawnLink& link : links.lines) nodes.insert({link.from, link.to});
  for (const reading::VolumeRow& volume : model.volumes) nodes.insert(volume.node);
  for (const std::uint32_t node : nodes) {
    const Pixel at = sheet.at(place_in(state, model, node));
    const auto row =
        std::find_if(model.volumes.begin(), model.volumes.end(), [&](const reading::VolumeRow& v) { return v.node == node; });
    const bool has_shape = row != model.volumes.end() && row->mesh != nullptr;
    // Hollow: nothing stands there.
    svg.leaf("circle", {{"cx", pixels(at.x)},
                        {"cy", pixels(at.y)},
                        {"r", has_shape ? "2.2" : "3.4"},
                        {"fill", hex(has_shape ? kInk : kPaper)},
                        {"stroke", hex(has_shape ? kPaper : kInk)},
                        {"stroke-width", has_shape ? ".8" : "1.4"}});
  }
}

void draw_legend(Markup& svg, const Sheet& sheet, const DrawnLinks& links, Pixel at) {
  double x = at.x;
  double y = at.y;
  for (const FamilyInk* family : links.families) {
    const std::string label(family->label);
    const double width = 40 + text_width(label, 10) + 18;
    if (x + width > sheet.width() - 20 && x > at.x) {
      x = at.x;
      y += kLegendRow;
    }
    PathText sample;
    sample.polyline({{x, y - 3.5}, {x + 32, y - 3.5}}, false);
    svg.path(sample, {{"fill", "none"},
                      {"stroke", std::string(family->colour)},
                      {"stroke-width", "1.8"},
                      {"stroke-dasharray", std::string(family->dashes)}});
    svg.element("text", label, {{"x", pixels(x + 38)}, {"y", pixels(y)}, {"class", "figure start"}});
    x += width;
  }
}

std::string label_plan(Markup& svg, const Sheet& sheet, const reading::ReportModel& model,
                       const reading::Surroundings& surroundings, const Palette& palette, double bottom) {
  if (model.volumes.size() > kMostNumbers) return " Too many volumes for labels: pointing at one shows its number and name.";
  std::vector<Label> labels;
  for (const reading::VolumeRow* volume : by_size(model)) {
    Label label{sheet.at(volume->place), volume->name, palette.letter(volume->use), std::to_string(volume->number)};
    label.second += volume->mesh ? " \xC2\xB7 " + reading::quantity(volume->figures.height, Unit::metre) + " high"
                                 : " \xC2\xB7 " + volume->figures.state;
    // Below the dot of the position, not on it.
    label.anchor.y += model.volumes.size() > kMostNames ? 8 : 17;
    labels.push_back(std::move(label));
  }
  LabelPlacer placer({kFrame, 30, sheet.width() - 4, bottom}, {{sheet.width() - 70, 30, sheet.width(), 116}});
  const std::size_t without = placer.write(svg, labels, labels.size() > kMostNames ? 0 : labels.size());
  // Where room is left: what stands around.
  const std::vector<Label> around = surroundings_labels(sheet, surroundings, {kFrame, 30, sheet.width() - kFrame, bottom});
  placer.write(svg, around, around.size());
  return without == 0 ? "" : " " + reading::counted(without, "volume") + " without a label for want of room.";
}

std::string caption_of(const reading::ReportModel& model, const DrawnLinks& links, double step, double cut) {
  std::string caption = "Plan: tinted, each volume seen from above, the highest on top; strong tint with heavy lines, the cut " +
                        reading::readable(kEyeHeight) + " m above the ground (height " + reading::readable(cut) +
                        " m). Dots are places of volumes and other nodes, grid " + figure_of(step) + " m.";
  if (std::any_of(model.volumes.begin(), model.volumes.end(), [](const reading::VolumeRow& v) { return !v.mesh; }))
    caption += " Hollow dots are volumes without a shape.";
  if (!links.families.empty()) caption += " Links of demand are not drawn.";
  if (!links.beside.empty()) {
    caption += " Nor are links to other things than volumes: ";
    for (std::size_t i = 0; i < links.beside.size(); ++i) caption += (i > 0 ? ", " : "") + links.beside[i];
    caption += ".";
  }
  if (!links.left_out.empty()) {
    caption += " Not drawn, because they join large sets: ";
    for (std::size_t i = 0; i < links.left_out.size() && i < 6; ++i) caption += (i > 0 ? ", " : "") + links.left_out[i];
    if (links.left_out.size() > 6) caption += " and " + std::to_string(links.left_out.size() - 6) + " more";
    caption += ".";
  }
  return caption;
}

}  // namespace

Picture draw_plan(const State& state, const reading::ReportModel& model, const Palette& palette) {
  const reading::Surroundings& surroundings = model.surroundings;
  const std::vector<Point3> content = framed(content_of(model), surroundings);
  if (content.empty()) return {empty_picture("plan", "Plan", "Nothing to draw: there is no boundary and no volume."), ""};
  const DrawnLinks links = links_to_draw(state);
  const Sheet sheet(plan_view(), content, kPlanWidth, kMostHeight, {kFrame + 20, 46, kFrame + 20, 30});
  const double bottom = sheet.height() - 8, cut = ground_of(model) + kEyeHeight;
  const double link_rows = links.families.empty() ? 0 : links.families.size() > 4 ? 2 : 1;
  const Pixel below{20, sheet.height() + 42 + kLegendRow * link_rows};
  const double height =
      sheet.height() + 34 + kLegendRow * link_rows + draw_surroundings_legend(nullptr, sheet, surroundings, below);
  Markup svg;
  open_picture(svg, sheet.width(), height, "plan", "Plan",
               "The site and its surroundings seen from above with all volumes, their positions, and the links between them.");
  const double step = draw_grid(svg, sheet, bottom);
  // Streets go on beyond the frame; they end at it.
  svg.open("clipPath", {{"id", "plan-frame"}});
  svg.leaf("rect",
           {{"x", pixels(kFrame)}, {"y", "30"}, {"width", pixels(sheet.width() - 2 * kFrame)}, {"height", pixels(bottom - 30)}});
  svg.close();
  svg.open("g", {{"clip-path", "url(#plan-frame)"}});
  draw_ground_layers(svg, sheet, surroundings);
  draw_sites(svg, sheet, model);
  draw_plots(svg, sheet, surroundings);
  draw_streets_and_buildings(svg, sheet, surroundings);
  svg.close();
  draw_volumes(svg, sheet, model, palette, cut);
  draw_links(svg, state, sheet, model, links);
  draw_positions(svg, state, sheet, model, links);
  const std::string missing = label_plan(svg, sheet, model, surroundings, palette, bottom);
  draw_scale_bar(svg, sheet.scale(), {kFrame, sheet.height() + 18}, 170);
  draw_legend(svg, sheet, links, {links.families.size() > 4 ? 20.0 : kFrame, sheet.height() + 42});
  draw_surroundings_legend(&svg, sheet, surroundings, below);
  draw_north(svg, plan_view(), model.true_north, {sheet.width() - 36, 82}, 24);
  svg.close();
  return {svg.str(), caption_of(model, links, step, cut) + surroundings_caption(surroundings) + missing};
}

}  // namespace bl::drawing
