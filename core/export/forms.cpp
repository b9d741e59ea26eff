// Volumes in other forms, and the sums that follow.
#include "core/export/forms.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/export/read_proposal.h"
#include "core/geometry/mesh_lines.h"

namespace bl::exporting {

namespace {

reading::FormSource source_of(const Building& building) {
  reading::FormSource source{building.is_standing,   building.position, building.volume,
                             building.floor_area,    building.bottom,   building.top - building.bottom,
                             building.storey_height, building.shape,    {}};
  for (const Storey& storey : building.storeys)
    source.storeys.push_back({storey.bottom, storey.top, storey.floor_area, storey.faces});
  return source;
}

// False where the volume has no body in that form.
bool take_form(VolumeForm form, Building& building) {
  // What stands has flat walls and whole storeys already.
  if (building.is_standing && form != VolumeForm::balls) return true;
  const reading::FormedVolume formed = reading::in_form(source_of(building), form);
  if (formed.mesh == nullptr || formed.mesh->triangles.empty() || formed.storeys.empty()) return false;
  building.is_standing = form == VolumeForm::slabs || form == VolumeForm::standing;
  building.volume = formed.volume;
  building.floor_area = formed.floor_area;
  building.bottom = formed.bottom;
  building.top = formed.top;
  building.mesh = building.light_mesh = formed.mesh;
  building.shape = nullptr;
  building.storeys.clear();
  for (const reading::FormedStorey& storey : formed.storeys)
    building.storeys.push_back(
        {static_cast<int>(building.storeys.size()), 0, storey.bottom, storey.top, storey.area, storey.faces, {}, {}});
  building.outline.clear();
  if (building.is_standing) {
    building.outline = building.storeys.front().faces;
  } else if (geometry::Ring hull = geometry::hull_of_plan(formed.mesh->vertices); hull.size() >= 3) {
    for (Point3& corner : hull) corner.z = 0;
    building.outline.push_back({std::move(hull), {}});
  }
  building.footprint = area_of(building.outline);
  return true;
}

void add_up(Proposal& all) {
  for (UseRow* row : [&] {
         std::vector<UseRow*> rows{&all.all};
         for (UseRow& use : all.uses) rows.push_back(&use);
         return rows;
       }()) {
    row->floor_area = row->volume = 0;
  }
  const auto count = [&](const Building& building) {
    const std::size_t use = all.use_number(building.use);
    for (UseRow* row : {&all.all, use < all.uses.size() ? &all.uses[use] : nullptr}) {
      if (row == nullptr) continue;
      row->floor_area += building.floor_area;
      row->volume += building.volume;
    }
  };
  for (const Building& building : all.buildings) count(building);
  for (const Building& building : all.shapeless) count(building);
}

}  // namespace

std::vector<Choice<VolumeForm>> form_choices() {
  std::vector<Choice<VolumeForm>> choices;
  for (const reading::VolumeFormChoice& choice : reading::volume_forms()) choices.push_back({choice.form, choice.id, choice.doc});
  return choices;
}

Proposal in_form(const Proposal& proposal, VolumeForm form) {
  Proposal all = proposal;
  if (form == VolumeForm::as_is) return all;
  all.form = form;
  std::vector<Building> taken;
  for (Building& building : all.buildings) {
    if (take_form(form, building)) {
      taken.push_back(std::move(building));
      continue;
    }
    building.why_shapeless = std::string("it has no body ") + reading::choice_of(form).measured;
    building.storeys.clear();
    building.mesh = building.light_mesh = nullptr;
    all.shapeless.push_back(std::move(building));
  }
  // What has no body measures nothing in this form.
  for (Building& building : all.shapeless) building.floor_area = building.volume = building.footprint = 0;
  all.buildings = std::move(taken);
  number_levels(all);
  add_up(all);
  return all;
}

}  // namespace bl::exporting
