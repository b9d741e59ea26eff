// Bodies and floors of volumes in other forms.
#include "core/reading/volume_form.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/base/mathematics.h"
#include "core/geometry/mesh_lines.h"
#include "core/geometry/polygon_triangles.h"
#include "core/reading/cell_cut.h"

namespace bl::reading {

namespace {

constexpr std::array<VolumeFormChoice, kVolumeForms> kForms = {{
    {VolumeForm::as_is, "as_is", "As they are", "Standing volumes as buildings, rounded ones as cells wrapped onto their balls.",
     "as they are"},
    {VolumeForm::balls, "balls", "Balls",
     "A bubble diagram: each volume as a ball of the same volume, not cut by others; floors in the middle of each storey.",
     "as balls"},
    {VolumeForm::cells, "cells", "Cells with flat facets",
     "What the neighbours leave to a rounded volume, between its own top and bottom. Standing volumes have flat facets as they "
     "are.",
     "as cells"},
    {VolumeForm::slabs, "slabs", "Slabs", "Each storey as a plate of its floor: what could be built of a rounded volume.",
     "as slabs"},
    {VolumeForm::standing, "standing", "Standing",
     "Rounded volumes as whole storeys on their largest floor, as many as the volume fills; they may meet each other.",
     "as standing bodies"},
}};

constexpr int kRound = 32, kUpward = 16;  // parts of a ball's mesh

void append(const Mesh& part, Mesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), part.vertices.begin(), part.vertices.end());
  for (const auto& [a, b, c] : part.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
}

// Of radius 1 around the origin, by circles of latitude.
Mesh unit_ball() {
  Mesh ball;
  ball.vertices.push_back({0, 0, -1});
  for (int k = 1; k < kUpward; ++k) {
    const double up = std::numbers::pi * k / kUpward - std::numbers::pi / 2;
    for (int i = 0; i < kRound; ++i) {
      const double around = 2 * std::numbers::pi * i / kRound, reach = mathematics::cosine(up);
      ball.vertices.push_back({reach * mathematics::cosine(around), reach * mathematics::sine(around), mathematics::sine(up)});
    }
  }
  ball.vertices.push_back({0, 0, 1});
  const auto at = [](int k, int i) { return static_cast<std::uint32_t>(1 + (k - 1) * kRound + i % kRound); };
  const auto last = static_cast<std::uint32_t>(ball.vertices.size() - 1);
  for (int i = 0; i < kRound; ++i) {
    ball.triangles.push_back({0, at(1, i + 1), at(1, i)});
    for (int k = 1; k + 1 < kUpward; ++k) {
      ball.triangles.push_back({at(k, i), at(k, i + 1), at(k + 1, i + 1)});
      ball.triangles.push_back({at(k, i), at(k + 1, i + 1), at(k + 1, i)});
    }
    ball.triangles.push_back({at(kUpward - 1, i), at(kUpward - 1, i + 1), last});
  }
  return ball;
}

geometry::Ring circle(const Point3& middle, double radius) {
  geometry::Ring ring;
  for (int i = 0; i < kRound; ++i) {
    const double around = 2 * std::numbers::pi * i / kRound;
    ring.push_back({middle.x + radius * mathematics::cosine(around), middle.y + radius * mathematics::sine(around), 0});
  }
  return ring;
}

// What is too low for a storey of its own belongs to the one below.
void add_floor(FormedStorey storey, const FloorCut& cut, FormedVolume& made) {
  made.floor_area += storey.area;
  if (cut.is_drawn || made.storeys.empty()) made.storeys.push_back(std::move(storey));
  else made.storeys.back().area += storey.area;
}

FormedVolume as_ball(const FormSource& source, bool with_body) {
  // So large that the mesh has the volume that the figure says.
  static const std::pair<Mesh, double> unit = [] {
    Mesh ball = unit_ball();
    const double volume = enclosed_volume(ball);
    return std::pair{std::move(ball), volume};
  }();
  FormedVolume made;
  const double radius = ball_radius(source.volume), reach = mathematics::cube_root(source.volume / unit.second);
  if (!(radius > 0)) return made;
  const Point3 middle = ball_middle(source);
  if (with_body) {
    Mesh mesh = unit.first;
    for (Point3& v : mesh.vertices) v = middle + reach * v;
    made.mesh = std::make_shared<const Mesh>(std::move(mesh));
  }
  made.volume = source.volume;
  made.bottom = middle.z - radius;
  made.top = middle.z + radius;
  for (const FloorCut& cut : floor_cuts(made.bottom, 2 * radius, source.storey_height)) {
    const double squared = radius * radius - (cut.at - middle.z) * (cut.at - middle.z);
    if (!(squared > 0)) continue;
    FormedStorey storey{cut.bottom, cut.top, cut.share * std::numbers::pi * squared, {}};
    if (with_body) storey.faces.push_back({circle(middle, std::sqrt(squared)), {}});
    add_floor(std::move(storey), cut, made);
  }
  return made;
}

FormedVolume as_cell(const FormSource& source) {
  FormedVolume made;
  const MeshPointer cell = flat_cell(source);
  if (!cell) return made;
  Mesh mesh{cell->vertices, cell->triangles, {}, {}};
  made.volume = enclosed_volume(mesh);
  made.bottom = source.bottom;
  made.top = source.bottom + source.height;
  for (const FloorCut& cut : floor_cuts(made.bottom, source.height, source.storey_height)) {
    FormedStorey storey{cut.bottom, cut.top, 0, {}};
    for (geometry::Polyline& line : geometry::section(mesh, cut.at, [](std::size_t) { return true; })) {
      if (!line.is_closed || line.points.size() < 3) continue;
      for (Point3& p : line.points) p.z = 0;
      if (geometry::signed_area(line.points) < 0) std::reverse(line.points.begin(), line.points.end());
      storey.area += geometry::signed_area(line.points);
      storey.faces.push_back({std::move(line.points), {}});
    }
    if (storey.faces.empty()) continue;
    storey.area *= cut.share;
    add_floor(std::move(storey), cut, made);
  }
  made.mesh = std::make_shared<const Mesh>(std::move(mesh));
  return made;
}

void pile_up(FormedVolume& made, bool with_body) {
  Mesh mesh;
  for (const FormedStorey& storey : made.storeys) {
    made.floor_area += storey.area;
    // Of their drawing: the floor area of the highest storey counts what is left above it, or is a share of its plate.
    made.volume += geometry::area_of(storey.faces) * (storey.top - storey.bottom);
    for (std::size_t k = 0; with_body && k < storey.faces.size(); ++k)
      append(geometry::prism_mesh(storey.faces[k].outer, storey.faces[k].holes, storey.bottom, storey.top), mesh);
  }
  if (made.storeys.empty()) return;
  made.bottom = made.storeys.front().bottom;
  made.top = made.storeys.back().top;
  if (with_body) made.mesh = std::make_shared<const Mesh>(std::move(mesh));
}

FormedVolume as_slabs(const FormSource& source, bool with_body) {
  FormedVolume made;
  made.storeys = source.storeys;
  pile_up(made, with_body);
  return made;
}

FormedVolume as_standing(const FormSource& source, bool with_body) {
  FormedVolume made;
  const auto largest = std::max_element(
      source.storeys.begin(), source.storeys.end(),
      [](const FormedStorey& a, const FormedStorey& b) { return geometry::area_of(a.faces) < geometry::area_of(b.faces); });
  const double plate = largest == source.storeys.end() ? 0 : geometry::area_of(largest->faces);
  if (!(plate > 0)) return made;
  const double filled = source.volume / (plate * source.storey_height);
  const int count = static_cast<int>(std::clamp(std::round(filled), 1.0, 5000.0));
  for (int k = 0; k < count; ++k) {
    const double floor = source.bottom + k * source.storey_height;
    made.storeys.push_back({floor, floor + source.storey_height, plate, largest->faces});
  }
  pile_up(made, with_body);
  if (!with_body) return made;
  // One body: there is nothing between its storeys.
  Mesh mesh;
  for (const geometry::PlateFace& face : largest->faces)
    append(geometry::prism_mesh(face.outer, face.holes, made.bottom, made.top), mesh);
  made.mesh = std::make_shared<const Mesh>(std::move(mesh));
  return made;
}

}  // namespace

std::vector<FloorCut> floor_cuts(double bottom, double height, double storey) {
  std::vector<FloorCut> cuts;
  if (height < storey) return {{bottom, bottom + height, bottom + 0.5 * height, 1, true}};
  const double whole = std::min(std::floor(height / storey), geometry::kMostStoreys), rest = height - whole * storey;
  for (int k = 0; k < static_cast<int>(whole); ++k) {
    const double floor = bottom + k * storey;
    cuts.push_back({floor, floor + storey, floor + 0.5 * storey, 1, true});
  }
  // A hair more than half a storey, so that rounding does not decide.
  if (rest > 0) {
    const double top = bottom + height;
    cuts.push_back({top - rest, top, top - 0.5 * rest, rest / storey, rest / storey > 0.5 + 1e-9});
  }
  return cuts;
}

std::span<const VolumeFormChoice> volume_forms() { return kForms; }

const VolumeFormChoice& choice_of(VolumeForm form) {
  return *std::find_if(kForms.begin(), kForms.end(), [&](const VolumeFormChoice& choice) { return choice.form == form; });
}

double ball_radius(double volume) { return volume > 0 ? mathematics::cube_root(0.75 * volume / std::numbers::pi) : 0; }

Point3 ball_middle(const FormSource& source) {
  Point3 middle = source.position;
  if (source.is_standing) middle.z = source.bottom + source.height / 2;
  return middle;
}

// Without its wrap, so that its faces stay flat.
MeshPointer flat_cell(const FormSource& source) {
  const std::shared_ptr<const Mesh> coarse = source.shape ? source.shape.coarse() : nullptr;
  if (!coarse) return nullptr;
  const Mesh& whole = coarse->whole ? *coarse->whole : *coarse;
  if (!whole.wrap) return nullptr;
  Mesh loose = whole;
  MeshWrap wrap = *whole.wrap;
  wrap.radius = 1e9;  // nothing lies beyond such a ball
  loose.wrap = std::make_shared<const MeshWrap>(std::move(wrap));
  const MeshPointer cut = cut_cell(loose, source.bottom + source.height, Kept::below);
  return cut ? cut_cell(*cut, source.bottom, Kept::above) : nullptr;
}

FormedVolume in_form(const FormSource& source, VolumeForm form, bool with_body) {
  switch (form) {
    case VolumeForm::balls: return as_ball(source, with_body);
    case VolumeForm::cells: return as_cell(source);
    case VolumeForm::slabs: return as_slabs(source, with_body);
    case VolumeForm::standing: return as_standing(source, with_body);
    default: return {};
  }
}

}  // namespace bl::reading
