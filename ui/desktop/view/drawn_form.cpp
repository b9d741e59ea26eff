// Other shapes are made on the processor, for those volumes alone that have changed since the last picture.
#include "ui/desktop/view/drawn_form.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <new>
#include <numbers>
#include <utility>

#include "core/geometry/cellar.h"
#include "core/geometry/mesh_lines.h"
#include "core/geometry/plates_table.h"
#include "core/geometry/polygon_triangles.h"
#include "core/reading/cell_cut.h"
#include "core/reading/exact_shape.h"
#include "core/reading/figures.h"

namespace bl::desktop {

namespace {

// Arcs lie within this of their chords [m].
constexpr double kChords = 0.02;
// The joint between two slabs, so that each is seen: a share of the storey, at most so much [m].
constexpr double kJointShare = 0.1, kMostJoint = 0.3;

geometry::StandingBody body_of(const SceneFacts& facts, const VolumeFacts& volume) {
  const auto figures = reading::row_of<reading::FootprintFigures>(*facts.state, volume.node);
  return figures ? geometry::read_body(figures->plates) : geometry::StandingBody{};
}

// The lowest `storeys` of it; 0: all.
geometry::StandingBody lowest_of(geometry::StandingBody body, int storeys) {
  if (storeys == 0) return body;
  for (geometry::PlateStack& stack : body.stacks) {
    stack.storeys = std::min(stack.storeys, storeys);
    storeys -= stack.storeys;
  }
  std::erase_if(body.stacks, [](const geometry::PlateStack& stack) { return stack.storeys <= 0; });
  return body;
}

void append(const Mesh& part, Mesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), part.vertices.begin(), part.vertices.end());
  for (const auto& [a, b, c] : part.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
}

double thickness_of(double storey) { return storey - std::min(kMostJoint, kJointShare * storey); }

// None where there is nothing of it, or more than the renderer can number.
MeshPointer shape_of(const Mesh& mesh) {
  constexpr std::size_t kMostVertices = 60000;
  return mesh.triangles.empty() || mesh.vertices.size() >= kMostVertices ? nullptr : as_cell(mesh);
}

struct Slabs {
  Mesh mesh;
  double area = 0, volume = 0;
  std::vector<reading::FormedStorey> floors;  // of the storeys of a rounded volume
};

Slabs slabs_of(const geometry::StandingBody& body) {
  Slabs made;
  for (const geometry::PlateStack& stack : body.stacks) {
    const std::vector<geometry::PlateFace> faces = geometry::faces_of(stack, body.centre, kChords);
    made.area += stack.storeys * stack.area;
    made.volume += stack.storeys * stack.area * stack.storey_height;
    for (int k = 0; k < stack.storeys; ++k)
      for (const geometry::PlateFace& face : faces) {
        const double floor = stack.bottom + k * stack.storey_height;
        append(geometry::prism_mesh(face.outer, face.holes, floor, floor + thickness_of(stack.storey_height)), made.mesh);
      }
  }
  return made;
}

// Its floors as the solver measures them.
Slabs slabs_of(const SceneFacts& facts, const VolumeFacts& volume, int storeys) {
  Slabs made;
  const reading::VolumeFigures& figures = volume.figures;
  const reading::ExactShape exact = reading::exact_shape(*facts.state, volume.node, figures);
  if (!(exact.radius > 0) && !figures.mesh) return made;
  const int all = storeys_of(volume), shown = storeys == 0 ? all : std::min(storeys, all);
  for (const reading::FloorCut& cut : reading::floor_cuts(figures.bottom, figures.height, figures.storey_height)) {
    const auto drawn = static_cast<int>(made.floors.size());
    if (cut.is_drawn ? drawn == shown : drawn < all) break;
    std::vector<geometry::Ring> rings;
    if (exact.radius > 0) {
      rings.push_back(reading::section_of(exact, cut.at));
    } else {
      for (geometry::Polyline& line : geometry::section(*figures.mesh, cut.at, [](std::size_t) { return true; }))
        if (line.is_closed) rings.push_back(std::move(line.points));
    }
    if (cut.is_drawn) made.floors.push_back({cut.bottom, cut.top, 0, {}});
    for (geometry::Ring& ring : rings) {
      if (ring.size() < 3) continue;
      if (geometry::signed_area(ring) < 0) std::reverse(ring.begin(), ring.end());
      const double plate = geometry::signed_area(ring), height = cut.top - cut.bottom;
      made.area += cut.share * plate;
      made.floors.back().area += cut.share * plate;
      if (!cut.is_drawn) continue;
      made.volume += plate * height;
      append(geometry::prism_mesh(ring, {}, cut.bottom, cut.bottom + thickness_of(height)), made.mesh);
      for (Point3& corner : ring) corner.z = 0;
      made.floors.back().faces.push_back({std::move(ring), {}});
    }
  }
  return made;
}

reading::FormSource source_of(const VolumeFacts& volume, bool is_standing) {
  const reading::VolumeFigures& f = volume.figures;
  return {is_standing, f.position, volume.volume, volume.floor_area, f.bottom, f.height, f.storey_height, f.mesh, {}};
}

// Its floors where the solver measures them, with their shares of the floor area of the scene.
std::vector<reading::FormedStorey> floors_of(const SceneFacts& facts, const VolumeFacts& volume) {
  Slabs whole = slabs_of(facts, volume, 0);
  std::erase_if(whole.floors, [](const reading::FormedStorey& floor) { return !(floor.area > 0); });
  for (reading::FormedStorey& floor : whole.floors) floor.area *= volume.floor_area / whole.area;
  return std::move(whole.floors);
}

}  // namespace

std::span<const FormChoice> form_choices() { return reading::volume_forms(); }

const FormChoice& form_of(const std::string& id) {
  const std::span<const FormChoice> forms = form_choices();
  const auto found = std::find_if(forms.begin(), forms.end(), [&](const FormChoice& choice) { return id == choice.id; });
  return found == forms.end() ? forms.front() : *found;
}

int storeys_below(const VolumeFacts& volume, double ground) {
  const double storey = volume.figures.storey_height;
  return storey > 0 ? static_cast<int>(std::clamp(std::round((volume.figures.bottom - ground) / storey), -500.0, 5000.0)) : 0;
}

int storeys_of(const VolumeFacts& volume) {
  const double storey = volume.figures.storey_height, height = volume.figures.height;
  if (!(storey > 0) || !(height > 0)) return 0;
  return static_cast<int>(std::clamp(std::ceil(height / storey - 0.5 - 1e-9), 1.0, 5000.0));
}

int storeys_in(const SceneFacts& facts) {
  int most = 0;
  for (const VolumeFacts& volume : facts.volumes) most = std::max(most, storeys_below(volume, facts.ground) + storeys_of(volume));
  return most;
}

int cellars_in(const SceneFacts& facts) {
  int most = 0;
  for (const CellarFacts& cellar : facts.cellars) most = std::max(most, cellar.storeys);
  return most;
}

bool DrawnShapes::Shape::is_of_same(const Shape& o) const {
  return mesh == o.mesh && cell == o.cell && position == o.position && bottom == o.bottom && height == o.height &&
         storey_height == o.storey_height && volume == o.volume && weight == o.weight && storeys == o.storeys && form == o.form;
}

// A rounded volume as whole storeys on its largest floor.
void DrawnShapes::fill_standing(const SceneFacts& facts, const VolumeFacts& volume, Shape& shape) {
  reading::FormSource source = source_of(volume, false);
  source.storeys = floors_of(facts, volume);
  const reading::FormedVolume formed = reading::in_form(source, DrawnForm::standing);
  if (formed.mesh == nullptr) return;
  shape.form_area = formed.floor_area;
  shape.form_volume = formed.volume;
  const std::size_t all = formed.storeys.size();
  const std::size_t shown = shape.storeys == 0 ? all : std::min(all, static_cast<std::size_t>(shape.storeys));
  const reading::FormedStorey& last = formed.storeys[shown - 1];
  // One body, so that storeys have no walls between them.
  Mesh mesh;
  for (const geometry::PlateFace& face : last.faces)
    append(geometry::prism_mesh(face.outer, face.holes, formed.bottom, last.top), mesh);
  MeshPointer made = shape_of(mesh);
  if (!made) return;
  shape.made = std::move(made);
  shape.drawn_area = static_cast<double>(shown) * last.area;
  shape.drawn_volume = last.area * (last.top - formed.bottom);
}

// A shape that cannot be made is left as it is; one of which the cut leaves nothing is none.
void DrawnShapes::fill(const SceneFacts& facts, const VolumeFacts& volume, Shape& shape) const {
  shape.made = volume.cell;
  shape.drawn_volume = shape.form_volume = volume.volume;
  shape.drawn_area = shape.form_area = volume.floor_area;
  const reading::VolumeFigures& figures = volume.figures;
  const geometry::StandingBody whole = body_of(facts, volume);
  const bool is_standing = !whole.stacks.empty();
  const geometry::StandingBody body = lowest_of(whole, shape.storeys);
  const double top = figures.bottom + shape.storeys * figures.storey_height;
  if (shape.form == DrawnForm::standing && !is_standing) return fill_standing(facts, volume, shape);
  if (shape.form == DrawnForm::slabs) {
    const Slabs slabs = body.stacks.empty() ? slabs_of(facts, volume, shape.storeys) : slabs_of(body);
    // Floors are those of the scene; of a rounded volume a slab has its storey's whole height, the last one what is left.
    if (!is_standing) shape.form_volume = shape.storeys == 0 ? slabs.volume : slabs_of(facts, volume, 0).volume;
    MeshPointer made = shape_of(slabs.mesh);
    if (!made) return;
    shape.made = std::move(made);
    shape.is_edgeless = body.stacks.empty();
    shape.drawn_area = slabs.area;
    shape.drawn_volume = slabs.volume;
    return;
  }
  if (shape.form == DrawnForm::balls) {
    const reading::FormSource source = source_of(volume, is_standing);
    const double radius = reading::ball_radius(volume.volume);
    shape.drawn_area = shape.form_area = reading::in_form(source, DrawnForm::balls, false).floor_area;
    if (radius > 0) shape.made = ball_cell(reading::ball_middle(source), radius);
  } else if (!body.stacks.empty()) {
    if (shape.storeys == 0) return;
    const Slabs slabs = slabs_of(body);
    MeshPointer made = shape_of(geometry::mesh_of(body, kChords));
    if (!made) return;
    shape.made = std::move(made);
    shape.drawn_area = slabs.area;
    shape.drawn_volume = slabs.volume;
    return;
  } else if (shape.form == DrawnForm::cells && !volume.is_ball) {
    const reading::FormSource source = source_of(volume, false);
    if (MeshPointer flat = reading::flat_cell(source)) {
      const reading::FormedVolume formed = reading::in_form(source, DrawnForm::cells);
      shape.made = std::move(flat);
      shape.drawn_volume = shape.form_volume = formed.volume;
      shape.drawn_area = shape.form_area = formed.floor_area;
    }
  }
  if (shape.storeys == 0 || !shape.made) return;
  if (shape.form == DrawnForm::as_is) {
    const Slabs measured = slabs_of(facts, volume, shape.storeys);
    shape.drawn_area = measured.area;
    shape.drawn_volume = measured.volume;
  }
  shape.made = reading::cut_cell(*shape.made, top, reading::Kept::below);
}

// Where memory does not suffice for another shape, the volume keeps its own.
void DrawnShapes::fill_or_leave(const SceneFacts& facts, const VolumeFacts& volume, Shape& shape) const try {
  fill(facts, volume, shape);
} catch (const std::exception&) { shape.made = volume.cell; }

std::shared_ptr<const SceneFacts> DrawnShapes::of(const std::shared_ptr<const SceneFacts>& facts, const DrawnLook& look) {
  if (look.is_plain()) {
    *this = {};
    return facts;
  }
  if (from_ == facts && look_ == look && made_) return made_;
  std::shared_ptr<SceneFacts> drawn;
  if (look.form == DrawnForm::as_is && look.storeys == 0) shapes_.clear(), drawn = std::make_shared<SceneFacts>(*facts);
  else drawn = formed(*facts, look);
  if (look.storeys < 0) drawn = below_ground(*facts, -look.storeys);
  else if (look.opens_ground) open_ground(*facts, *drawn);
  made_ = std::move(drawn);
  from_ = facts;
  look_ = look;
  tell(*facts, *made_, look);
  return made_;
}

// The figures of a form are those of all volumes, also of those that the cut leaves out.
std::shared_ptr<SceneFacts> DrawnShapes::formed(const SceneFacts& facts, const DrawnLook& look) {
  std::map<std::uint32_t, Shape> shapes;
  std::vector<VolumeFacts> volumes;
  for (const VolumeFacts& volume : facts.volumes) {
    const int below = storeys_below(volume, facts.ground), all = storeys_of(volume);
    const bool is_above = look.storeys < 0 || (look.storeys > 0 && below >= look.storeys);
    if (is_above && look.form == DrawnForm::as_is) continue;
    VolumeFacts& drawn = volumes.emplace_back(volume);
    if (!volume.cell) {
      if (is_above) volumes.pop_back();
      continue;
    }
    const reading::VolumeFigures& f = volume.figures;
    const int storeys = look.storeys == 0 || all == 0 || is_above || below + all <= look.storeys ? 0 : look.storeys - below;
    Shape shape;
    shape.mesh = f.mesh;
    shape.cell = volume.cell;
    shape.position = f.position;
    shape.bottom = f.bottom;
    shape.height = f.height;
    shape.storey_height = f.storey_height;
    shape.volume = volume.volume;
    shape.weight = f.weight;
    shape.storeys = storeys;
    shape.form = look.form;
    const auto before = shapes_.find(volume.node);
    if (before != shapes_.end() && before->second.is_of_same(shape)) shape = before->second;
    else fill_or_leave(facts, volume, shape);
    // What lies above the cut is not drawn, but its figures count.
    if (!shape.made || is_above) {
      volumes.pop_back();
    } else {
      drawn.cell = shape.made;
      drawn.drawn_volume = shape.drawn_volume;
      drawn.drawn_area = shape.drawn_area;
      drawn.is_edgeless = shape.is_edgeless;
      drawn.is_drawn_otherwise = shape.made != volume.cell;
      // Windows are those of the whole building, and storeys of a ball are no floors.
      if (drawn.is_drawn_otherwise && look.form != DrawnForm::as_is) drawn.is_dressed = false;
    }
    shapes.emplace(volume.node, std::move(shape));
  }
  shapes_ = std::move(shapes);
  return facts_with(facts, std::move(volumes));
}

// Its storeys from the `from`-th down, as one body: its plates are equal.
MeshPointer DrawnShapes::cellar_cell(const SceneFacts& facts, const VolumeFacts& volume, const CellarFacts& cellar, int from) {
  CellarShape& shape = cellars_[volume.node];
  if (shape.cell && shape.mesh == volume.figures.mesh && shape.storeys == cellar.storeys && shape.from == from &&
      shape.height == cellar.storey_height)
    return shape.cell;
  shape = {volume.figures.mesh, cellar.storeys, from, cellar.storey_height, nullptr};
  const geometry::StandingBody body = body_of(facts, volume);
  if (body.stacks.empty() || from > cellar.storeys) return nullptr;
  geometry::PlateStack below = geometry::cellar_of(body, cellar.storeys, cellar.storey_height);
  below.storeys -= from - 1;
  return shape.cell = shape_of(geometry::mesh_of({body.centre, {below}}, kChords));
}

// Where memory does not suffice, what lies below the ground is left out of the picture.
void DrawnShapes::open_ground(const SceneFacts& facts, SceneFacts& drawn) try {
  for (CellarFacts& cellar : drawn.cellars)
    if (const VolumeFacts* volume = facts.volume_of(cellar.node)) cellar.cell = cellar_cell(facts, *volume, cellar, 1);
} catch (const std::bad_alloc&) {}

// Cellars in place of the volumes that have them, in the open: what stands around would float above them.
std::shared_ptr<SceneFacts> DrawnShapes::below_ground(const SceneFacts& facts, int from) {
  std::vector<VolumeFacts> volumes;
  double pit = facts.ground;
  for (const CellarFacts& cellar : facts.cellars) {
    const VolumeFacts* volume = facts.volume_of(cellar.node);
    MeshPointer cell = volume == nullptr ? nullptr : cellar_cell(facts, *volume, cellar, from);
    if (!cell) continue;
    VolumeFacts& drawn = volumes.emplace_back(*volume);
    const int shown = cellar.storeys - (from - 1);
    drawn.cell = std::move(cell);
    drawn.is_drawn_otherwise = true;
    drawn.is_ball = drawn.is_dressed = drawn.is_edgeless = false;
    drawn.drawn_area = shown * cellar.area;
    drawn.drawn_volume = drawn.drawn_area * cellar.storey_height;
    drawn.drawn_storeys = {cellar.bottom, cellar.storey_height};
    pit = std::min(pit, cellar.bottom);
  }
  const std::shared_ptr<SceneFacts> made = facts_with(facts, std::move(volumes));
  made->urban.bodies.clear();
  made->pit = pit;
  return made;
}

std::optional<DrawnShapes::FormFigures> DrawnShapes::figures_of(std::uint32_t node) const {
  const auto found = shapes_.find(node);
  if (look_.form == DrawnForm::as_is || found == shapes_.end()) return {};
  return FormFigures{found->second.form_volume, found->second.form_area};
}

void DrawnShapes::tell(const SceneFacts& all, const SceneFacts& drawn, const DrawnLook& look) {
  const auto square = [](double area) { return reading::quantity(area, Unit::square_metre); };
  const auto cubic = [](double volume) { return reading::quantity(volume, Unit::cubic_metre); };
  double volume = 0, area = 0, scene_volume = 0, scene_area = 0, form_volume = 0, form_area = 0;
  for (const VolumeFacts& one : drawn.volumes) volume += one.drawn_volume, area += one.drawn_area;
  for (const auto& [node, shape] : shapes_) form_volume += shape.form_volume, form_area += shape.form_area;
  for (const VolumeFacts& one : all.volumes) scene_volume += one.volume, scene_area += one.floor_area;
  legend_ = {};
  if (look.form == DrawnForm::as_is && look.storeys == 0) return;
  const FormChoice& form = reading::choice_of(look.form);
  legend_.title = std::string("Drawn: ") + form.label;
  if (look.storeys < 0) {
    // What lies below the ground is the same in every form.
    legend_.title =
        "Drawn: cellars" + (look.storeys == -1 ? std::string() : " from number " + std::to_string(-look.storeys) + " down");
    legend_.rows.push_back({square(area) + " and " + cubic(volume) + " drawn, no part of the floor area", 0});
  }
  if (look.storeys > 0)
    legend_.title += ", " + reading::counted(static_cast<std::size_t>(look.storeys), "storey") + " from the ground";
  // The floors of a ball or a cell that is cut are not measured.
  const bool has_floors = look.form != DrawnForm::balls && look.form != DrawnForm::cells;
  if (look.storeys > 0 && has_floors) legend_.rows.push_back({square(area) + " floor area and " + cubic(volume) + " drawn", 0});
  if (look.form != DrawnForm::as_is && look.storeys >= 0)
    legend_.rows.push_back({std::string("Figures ") + form.measured + ": " + square(form_area) + ", " + cubic(form_volume), 0});
  legend_.rows.push_back({"As they are: " + square(scene_area) + ", " + cubic(scene_volume), 0});
}

}  // namespace bl::desktop
