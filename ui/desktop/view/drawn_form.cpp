// Other shapes are made on the processor, for those volumes alone that have changed since the last picture.
#include "ui/desktop/view/drawn_form.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <numbers>
#include <utility>

#include "core/geometry/mesh_lines.h"
#include "core/geometry/plates_table.h"
#include "core/geometry/polygon_triangles.h"
#include "core/reading/exact_shape.h"
#include "core/reading/figures.h"
#include "ui/desktop/view/cell_cut.h"

namespace bl::desktop {

namespace {

constexpr std::array<FormChoice, kFormCount> kForms = {{
    {DrawnForm::as_is, "as_is", "As they are", "Standing volumes as buildings, rounded ones as cells wrapped onto their balls."},
    {DrawnForm::balls, "balls", "Balls", "A bubble diagram: each volume as a ball of the same volume, not cut by others."},
    {DrawnForm::cells, "cells", "Cells with flat facets",
     "What the neighbours leave to a rounded volume, between its own top and bottom. Standing volumes have flat facets as they "
     "are."},
    {DrawnForm::slabs, "slabs", "Slabs", "Each storey as a plate of its floor: what could be built of a rounded volume."},
}};

// Arcs lie within this of their chords [m].
constexpr double kChords = 0.02;
// The joint between two slabs, so that each is seen: a share of the storey, at most so much [m].
constexpr double kJointShare = 0.1, kMostJoint = 0.3;

geometry::StandingBody body_of(const SceneFacts& facts, const VolumeFacts& volume) {
  const auto figures = reading::row_of<reading::FootprintFigures>(*facts.state, volume.node);
  return figures ? geometry::read_body(figures->plates, volume.figures.position) : geometry::StandingBody{};
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

// The solver measures the floor area of a rounded volume at the middle of each storey.
Slabs slabs_of(const SceneFacts& facts, const VolumeFacts& volume, int storeys) {
  Slabs made;
  const reading::VolumeFigures& figures = volume.figures;
  const reading::ExactShape exact = reading::exact_shape(*facts.state, volume.node, figures);
  if (!(exact.radius > 0) && !figures.mesh) return made;
  const double storey = figures.storey_height, height = figures.height;
  const int all = storeys_of(volume), shown = storeys == 0 ? all : std::min(storeys, all);
  for (int k = 0; k < shown; ++k) {
    const double floor = figures.bottom + k * storey, z = height < storey ? figures.bottom + height / 2 : floor + storey / 2;
    std::vector<geometry::Ring> rings;
    if (exact.radius > 0) {
      rings.push_back(reading::section_of(exact, z));
    } else {
      for (geometry::Polyline& line : geometry::section(*figures.mesh, z, [](std::size_t) { return true; }))
        if (line.is_closed) rings.push_back(std::move(line.points));
    }
    for (const geometry::Ring& ring : rings) {
      if (ring.size() < 3) continue;
      const double area = std::abs(geometry::signed_area(ring));
      made.area += area;
      made.volume += area * storey;
      append(geometry::prism_mesh(ring, {}, floor, floor + thickness_of(storey)), made.mesh);
    }
  }
  return made;
}

// Without its wrap, so that its faces stay flat.
MeshPointer flat_cell(const VolumeFacts& volume, double& size) {
  const reading::VolumeFigures& figures = volume.figures;
  const Mesh& whole = volume.cell->whole ? *volume.cell->whole : *volume.cell;
  if (!whole.wrap) return nullptr;
  Mesh loose = whole;
  MeshWrap wrap = *whole.wrap;
  wrap.radius = 1e9;  // nothing lies beyond such a ball
  loose.wrap = std::make_shared<const MeshWrap>(std::move(wrap));
  MeshPointer cut = cut_cell(loose, figures.bottom + figures.height, Kept::below);
  if (cut) cut = cut_cell(*cut, figures.bottom, Kept::above);
  if (!cut) return nullptr;
  size = enclosed_volume(*cut);
  return cut;
}

}  // namespace

std::span<const FormChoice> form_choices() { return kForms; }

const FormChoice& form_of(const std::string& id) {
  const auto found = std::find_if(kForms.begin(), kForms.end(), [&](const FormChoice& choice) { return id == choice.id; });
  return found == kForms.end() ? kForms.front() : *found;
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

bool DrawnShapes::Shape::is_of_same(const Shape& o) const {
  return mesh == o.mesh && cell == o.cell && position == o.position && bottom == o.bottom && height == o.height &&
         storey_height == o.storey_height && volume == o.volume && weight == o.weight && storeys == o.storeys && form == o.form;
}

// A shape that cannot be made is left as it is; one of which the cut leaves nothing is none.
void DrawnShapes::fill(const SceneFacts& facts, const VolumeFacts& volume, Shape& shape) const {
  shape.made = volume.cell;
  shape.drawn_volume = volume.volume;
  shape.drawn_area = volume.floor_area;
  const reading::VolumeFigures& figures = volume.figures;
  const geometry::StandingBody body = lowest_of(body_of(facts, volume), shape.storeys);
  const double top = figures.bottom + shape.storeys * figures.storey_height;
  if (shape.form == DrawnForm::slabs) {
    const Slabs slabs = body.stacks.empty() ? slabs_of(facts, volume, shape.storeys) : slabs_of(body);
    MeshPointer made = shape_of(slabs.mesh);
    if (!made) return;
    shape.made = std::move(made);
    shape.is_edgeless = body.stacks.empty();
    shape.drawn_area = slabs.area;
    shape.drawn_volume = slabs.volume;
    return;
  }
  if (shape.form == DrawnForm::balls) {
    const double radius = std::cbrt(0.75 * volume.volume / std::numbers::pi);
    Point3 middle = figures.position;
    if (!body.stacks.empty()) middle.z = figures.bottom + figures.height / 2;
    if (radius > 0) shape.made = ball_cell(middle, radius);
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
    double size = 0;
    if (MeshPointer flat = flat_cell(volume, size)) {
      shape.made = std::move(flat);
      shape.drawn_volume = size;
    }
  }
  if (shape.storeys == 0 || !shape.made) return;
  if (shape.form == DrawnForm::as_is) {
    const Slabs measured = slabs_of(facts, volume, shape.storeys);
    shape.drawn_area = measured.area;
    shape.drawn_volume = measured.volume;
  }
  shape.made = cut_cell(*shape.made, top, Kept::below);
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
  std::map<std::uint32_t, Shape> shapes;
  std::vector<VolumeFacts> volumes;
  for (const VolumeFacts& volume : facts->volumes) {
    const int below = storeys_below(volume, facts->ground), all = storeys_of(volume);
    if (look.storeys > 0 && below >= look.storeys) continue;
    VolumeFacts& drawn = volumes.emplace_back(volume);
    if (!volume.cell) continue;
    const reading::VolumeFigures& f = volume.figures;
    const int storeys = look.storeys == 0 || all == 0 || below + all <= look.storeys ? 0 : look.storeys - below;
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
    else fill_or_leave(*facts, volume, shape);
    if (!shape.made) {
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
  made_ = facts_with(*facts, std::move(volumes));
  from_ = facts;
  look_ = look;
  tell(*facts, *made_, look);
  return made_;
}

void DrawnShapes::tell(const SceneFacts& all, const SceneFacts& drawn, const DrawnLook& look) {
  const auto square = [](double area) { return reading::quantity(area, Unit::square_metre); };
  const auto cubic = [](double volume) { return reading::quantity(volume, Unit::cubic_metre); };
  double volume = 0, area = 0, scene_volume = 0, scene_area = 0;
  for (const VolumeFacts& one : drawn.volumes) volume += one.drawn_volume, area += one.drawn_area;
  for (const VolumeFacts& one : all.volumes) scene_volume += one.volume, scene_area += one.floor_area;
  legend_ = {};
  const FormChoice& form = *std::find_if(kForms.begin(), kForms.end(), [&](const FormChoice& f) { return f.form == look.form; });
  legend_.title = std::string("Drawn: ") + form.label;
  if (look.storeys > 0)
    legend_.title += ", " + reading::counted(static_cast<std::size_t>(look.storeys), "storey") + " from the ground";
  // What these forms have no floors for is not measured.
  const bool has_floors = look.form == DrawnForm::slabs || look.form == DrawnForm::as_is;
  if (has_floors) legend_.rows.push_back({square(area) + " floor area drawn, " + square(scene_area) + " in the figures", 0});
  if (look.storeys == 0 || has_floors)
    legend_.rows.push_back({cubic(volume) + " drawn, " + cubic(scene_volume) + " in the figures", 0});
}

}  // namespace bl::desktop
