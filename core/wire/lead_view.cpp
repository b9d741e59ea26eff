// Tags and roles are counted in the scene as people have set it.
#include "core/wire/lead_view.h"

#include <map>

#include <nlohmann/json.hpp>

#include "core/define/codec.h"
#include "core/wire/view_parts.h"

namespace bl::wire {

namespace {

Json areas_of(const room::RoomState& state) {
  Json areas = Json::object();
  for (const auto& [name, area] : state.areas) {
    Json told = {{"nodes", selection_to_json(area.nodes)}, {"corners", area.outline.size()}};
    for (const Point3& corner : area.outline) told["outline"].push_back({corner.x, corner.y});
    areas[name] = std::move(told);
  }
  return areas;
}

// What an area can be made of besides things by name.
void put_choices(View& view, const Scene& scene) {
  std::map<std::string, std::int64_t> tags, roles;
  for (const auto& [id, node] : scene.nodes)
    for (const auto& [type, values] : node.types) {
      if (type != kBaseNode) ++roles[type];
      const auto list = type == kBaseNode ? values.find("tags") : values.end();
      if (list == values.end()) continue;
      for (const std::string& tag : *std::get<Shared<std::vector<std::string>>>(list->second)) ++tags[tag];
    }
  Json told_tags = Json::object(), told_roles = Json::object();
  for (const auto& [tag, count] : tags) told_tags[tag] = count;
  for (const auto& [type, count] : roles) {
    const TypificationDefinition* definition = full_registry().typification(type);
    told_roles[type] = {{"label", definition == nullptr ? type : definition->label}, {"count", count}};
  }
  put(view, "tags", told_tags);
  put(view, "roles", told_roles);
}

}  // namespace

View lead_view(const ViewSources& sources, std::int64_t number) {
  View view;
  const room::Seat* seat = sources.room.state().seat(number);
  if (seat == nullptr || seat->role != Role::facilitator) return view;
  Json spans = Json::array();
  for (const auto& [first, last] : sources.room.unchanged_since()) spans.push_back({first, last});
  put(view, "unchanged", spans);
  put(view, "areas", areas_of(sources.room.state()));
  put_choices(view, sources.room.scene());
  return view;
}

}  // namespace bl::wire
