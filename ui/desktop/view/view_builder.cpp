// Volumes, surfaces and lines of one picture.
#include "ui/desktop/view/view_builder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "ui/desktop/view/section_plane.h"
#include "ui/desktop/view/urban_picture.h"

namespace bl::desktop {

namespace {

constexpr std::array<Layer, kLayerCount> kLayers = {{{"boundary", "Boundary", true},
                                                     {"storeys", "Storey lines", true},
                                                     {"facades", "Façades", true},
                                                     {"edges", "Edges", true},
                                                     {"shadows", "Shadows", true},
                                                     {"media", "Pictures", true},
                                                     {"grid", "Ground and grid", true},
                                                     {"labels", "Labels", true},
                                                     {"marks", "Nodes without a volume", true},
                                                     {"card", "Card of the nearest node", true},
                                                     {"links", "Links", false},
                                                     {"weights", "Weights as circles", false},
                                                     {"neighbours", "Neighbours (Delaunay edges)", false},
                                                     {"cells", "Cells before the shrink-wrap", false},
                                                     {"pulls", "Proposals for positions", false},
                                                     {"streets", "Streets and their load", true},
                                                     {"isochrones", "Isochrones of the chosen zone or junction", true},
                                                     {"isochrones_by_car", "Isochrones by car, not on foot", false},
                                                     {"buildings", "Existing buildings", true},
                                                     {"terrain", "Terrain", true},
                                                     {"plots", "Plots", true},
                                                     {"sun_maps", "Sun maps", true},
                                                     {"shadow_outlines", "Shadows on the ground, as outlines", false},
                                                     {"shade_bodies", "Bodies of shade", false},
                                                     {"sun_time", "Time of the sun, along the bottom", true},
                                                     {"data", "Data layers", true}}};

constexpr int kCircleParts = 64;
// A pull of one metre in a tick is drawn so long [m]: pulls are small against what they move.
constexpr double kPullScale = 12;

struct Builder {
  const SceneFacts& facts;
  const Colouring& colouring;
  const ViewChoices& choices;
  const Picks& picks;
  const PersonSettings& person;
  const Theme& theme;
  ViewScene scene;

  bool shows(const char* layer) const { return is_on(person, layer); }
  const std::string& id_of(std::uint32_t node) const { return facts.state->plan->nodes[node].id; }
  Point3 place_of(std::uint32_t node) const {
    const auto held = choices.held.find(node);
    return held == choices.held.end() ? facts.places[node] : held->second;
  }
  void line(const Point3& a, const Point3& b, Colour colour, float width, float hidden = 0) {
    if (is_finite(a) && is_finite(b)) scene.lines.push_back({a, b, colour, width, hidden});
  }

  void add_frame();
  void add_boundary();
  void add_media();
  void add_section();
  void cut_lines();
  void add_links();
  void add_weights();
  void add_neighbours();
  void add_cells();
  void add_pulls();
  void add_arrow(const Point3& from, const Point3& to, Colour colour, float width);
};

void Builder::add_frame() {
  const Colours& c = theme.colours();
  const bool is_dark = theme.is_dark();
  scene.camera = choices.camera;
  scene.section = choices.section;
  scene.centre = facts.centre;
  scene.radius = facts.reach;
  scene.ground = facts.pit.value_or(facts.ground);
  // Where one looks at what is above a level plane, the ground stays.
  const bool is_from_below = is_level(scene.section) && scene.section.normal.z < 0;
  scene.is_ground_cut =
      scene.section.is_on && !is_from_below &&
      std::any_of(facts.cellars.begin(), facts.cellars.end(), [](const auto& cellar) { return cellar.cell != nullptr; });
  // Whole kilometres, so that nothing is sent again when the scene's middle moves a little.
  scene.origin = {1000 * std::round(facts.centre.x / 1000), 1000 * std::round(facts.centre.y / 1000), 0};
  scene.grid = round_distance(facts.radius / 8);
  scene.scale = theme.scale();
  scene.sun = Vector3{-0.42, -0.62, 0.66} / norm({-0.42, -0.62, 0.66});
  const Colour ink = is_dark ? 0xff1a1512u : 0xff3a322cu;
  scene.colours = {.sky = c.sky,
                   .ground = is_dark ? mixed(c.ground, 0xffffffffu, 0.06f) : mixed(c.sky, 0xffffffffu, 0.45f),
                   .grid = is_dark ? mixed(c.ground, 0xffffffffu, 0.17f) : mixed(c.sky, c.ground, 0.85f),
                   .edge = ink,
                   .chosen = c.accent,
                   .hovered = is_dark ? 0xffffffffu : mixed(c.accent, 0xffffffffu, 0.35f),
                   .cut = is_dark ? 0xff4a403au : 0xff5a504au,
                   .is_dark = is_dark};
  scene.layers = {.shadows = shows("shadows"), .edges = shows("edges"), .storeys = shows("storeys"), .ground = shows("grid")};
}

void Builder::add_boundary() {
  if (!shows("boundary")) return;
  const Colours& c = theme.colours();
  for (const BoundaryFacts& boundary : facts.boundaries) {
    const bool is_chosen = picks.nodes.contains(boundary.id), is_hovered = picks.hovered_node == boundary.id;
    const Colour ink = is_chosen ? c.accent : theme.is_dark() ? 0xffe8e4e0u : 0xff4a423cu;
    scene.surfaces.push_back({boundary.shape, faded(ink, is_chosen || is_hovered ? 0.05f : theme.is_dark() ? 0.018f : 0.028f)});
    for (const auto& [a, b] : boundary.edges)
      line(a, b, faded(ink, is_chosen ? 0.95f : 0.5f), is_chosen || is_hovered ? 2.0f : 1.1f, 0.22f);
  }
}

// The plane that people drag, where it stands out of the model.
void Builder::add_section() {
  if (!choices.section.is_on) return;
  const auto corners = section_corners(choices.section, model_box(facts));
  for (std::size_t k = 0; k < corners.size(); ++k)
    line(corners[k], corners[(k + 1) % corners.size()], faded(theme.colours().accent, 0.85f), 1.4f, 0.35f);
}

// What is drawn of lines before the plane is hidden with the bodies that they belong to.
void Builder::cut_lines() {
  const ViewSection& section = choices.section;
  if (!section.is_on) return;
  constexpr double kOnPlane = 1e-3;  // [m]: lines in the plane, such as its frame, stay
  const auto before = [&](const Point3& p) { return dot(section.normal, p) - section.offset; };
  std::erase_if(scene.lines, [&](ViewLine& line) {
    const double a = before(line.from), b = before(line.to);
    if (a > kOnPlane && b > kOnPlane) return true;
    const Point3 cut = line.from + std::clamp(a / (a - b), 0.0, 1.0) * (line.to - line.from);
    if (a > kOnPlane) line.from = cut, line.came = {};
    else if (b > kOnPlane) line.to = cut, line.goes = {};
    return false;
  });
}

void Builder::add_media() {
  if (!shows("media")) return;
  for (const MediaFacts& media : facts.media) {
    ViewPicture& picture = scene.pictures.emplace_back(media.picture);
    const bool is_whole = media.file.front() == '/' || choices.folder.empty();
    picture.path = is_whole ? media.file : choices.folder + "/" + media.file;
    const bool is_picked = picks.nodes.contains(media.id) || picks.hovered_node == media.id;
    if (!is_picked) continue;
    const Point3 a = picture.corner, b = a + picture.across, c = b + picture.up, d = a + picture.up;
    for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, d}, std::pair{d, a}})
      line(from, to, theme.colours().accent, 2.0f, 0.4f);
  }
}

void Builder::add_links() {
  const bool shows_all = shows("links");
  for (const LinkFacts& link : facts.links) {
    const bool is_chosen = picks.links.contains(link.id), is_hovered = picks.hovered_link == link.id;
    if (!shows_all && !is_chosen && !is_hovered) continue;
    const LinkPlan& plan = facts.state->plan->links[link.link];
    const bool is_quiet = plan.is_muted || !plan.is_enabled;
    const Colour colour = is_chosen ? theme.colours().accent : theme.family_of(plan.definition).colour;
    const float width = is_chosen || is_hovered ? 3.0f : static_cast<float>(1.0 + 1.4 * std::clamp(plan.strength, 0.0, 1.0));
    line(place_of(link.from), place_of(link.to), faded(colour, is_quiet ? 0.3f : 0.9f), width, 0.5f);
  }
}

// The paper's second figure: each weight as a circle of radius sqrt(weight) around its node.
void Builder::add_weights() {
  if (!shows("weights")) return;
  for (std::size_t k = 0; k < facts.volumes.size(); ++k) {
    const VolumeFacts& volume = facts.volumes[k];
    if (!(volume.figures.radius > 0)) continue;
    const Colour colour =
        theme.is_dark() ? mixed(colouring.colours[k], 0xffffffffu, 0.25f) : mixed(colouring.colours[k], 0xff000000u, 0.35f);
    const Point3 centre = place_of(volume.node);
    Point3 before = centre + Vector3{volume.figures.radius, 0, 0};
    for (int i = 1; i <= kCircleParts; ++i) {
      const double angle = 2 * std::numbers::pi * i / kCircleParts;
      const Point3 next = centre + Vector3{volume.figures.radius * std::cos(angle), volume.figures.radius * std::sin(angle), 0};
      line(before, next, colour, 1.6f, 0.6f);
      before = next;
    }
    const double arm = 0.05 * volume.figures.radius;
    line(centre - Vector3{arm, 0, 0}, centre + Vector3{arm, 0, 0}, colour, 1.6f, 0.9f);
    line(centre - Vector3{0, arm, 0}, centre + Vector3{0, arm, 0}, colour, 1.6f, 0.9f);
  }
}

void Builder::add_neighbours() {
  if (!shows("neighbours")) return;
  const Colour colour = theme.is_dark() ? 0xffffffffu : 0xff202020u;
  for (const auto& [a, b] : neighbours_of(facts)) line(place_of(a), place_of(b), faded(colour, 0.75f), 1.2f, 0.75f);
}

void Builder::add_cells() {
  if (!shows("cells")) return;
  for (std::size_t k = 0; k < facts.volumes.size(); ++k) {
    const VolumeFacts& volume = facts.volumes[k];
    if (!volume.cell || volume.is_ball) continue;
    const Colour colour =
        theme.is_dark() ? mixed(colouring.colours[k], 0xffffffffu, 0.3f) : mixed(colouring.colours[k], 0xff000000u, 0.4f);
    const auto& vertices = volume.cell->vertices;
    // Each edge belongs to two faces, once in each direction; the first corner of a triangle is its face's centre.
    for (const auto& t : volume.cell->triangles)
      if (t[1] < t[2]) line(vertices[t[1]], vertices[t[2]], faded(colour, 0.8f), 1.0f, 0.35f);
  }
}

void Builder::add_arrow(const Point3& from, const Point3& to, Colour colour, float width) {
  line(from, to, colour, width, 1);
  const Vector3 along = to - from, aside = cross(along, choices.camera.forward());
  if (!(norm(aside) > 0)) return;
  const Vector3 back = 0.22 * along, out = (0.11 * norm(along) / norm(aside)) * aside;
  line(to, to - back + out, colour, width, 1);
  line(to, to - back - out, colour, width, 1);
}

void Builder::add_pulls() {
  if (!shows("pulls")) return;
  const double least = 0.004 * facts.radius, most = 0.3 * facts.radius;
  for (const PullFacts& pull : facts.pulls) {
    const double size = norm(pull.change), shown = std::min(most, kPullScale * size);
    if (!(size > 0) || shown < least) continue;
    const Point3 from = place_of(pull.node);
    const LinkDefinition* kind = facts.state->plan->links[pull.link].definition;
    add_arrow(from, from + (shown / size) * pull.change, theme.family_of(kind).colour, 2.2f);
  }
}

}  // namespace

std::span<const Layer> layers() { return kLayers; }

bool is_on(const PersonSettings& person, const std::string& layer) {
  const auto found = person.layers.find(layer);
  if (found != person.layers.end()) return found->second;
  return std::any_of(kLayers.begin(), kLayers.end(), [&](const Layer& l) { return l.id == layer && l.is_on_at_first; });
}

void set_layer(PersonSettings& person, const std::string& layer, bool is_on) {
  const bool at_first =
      std::any_of(kLayers.begin(), kLayers.end(), [&](const Layer& l) { return l.id == layer && l.is_on_at_first; });
  if (is_on == at_first) person.layers.erase(layer);
  else person.layers[layer] = is_on;
}

ViewScene build_view(const SceneFacts& facts, const Colouring& colouring, const ViewChoices& choices, const Picks& picks,
                     const PersonSettings& person, const Theme& theme, VolumePictures* last) {
  Builder builder{facts, colouring, choices, picks, person, theme, {}};
  builder.add_frame();
  VolumePictures fresh;
  builder.scene.volumes =
      (last != nullptr ? *last : fresh)
          .of({facts, colouring.colours, picks, builder.shows("facades"), builder.shows("buildings"), theme.is_dark()});
  builder.add_boundary();
  builder.add_section();
  builder.add_media();
  builder.add_links();
  builder.add_weights();
  builder.add_neighbours();
  builder.add_cells();
  builder.add_pulls();
  add_urban(
      facts, choices, picks, theme, [&](const char* layer) { return is_on(person, layer); }, builder.scene);
  builder.cut_lines();
  return std::move(builder.scene);
}

double round_distance(double wanted) {
  if (!(wanted > 0) || !std::isfinite(wanted)) return 1;
  const double power = std::pow(10, std::floor(std::log10(wanted))), lead = wanted / power;
  return power * (lead < 1.5 ? 1 : lead < 3.5 ? 2 : lead < 7.5 ? 5 : 10);
}

}  // namespace bl::desktop
