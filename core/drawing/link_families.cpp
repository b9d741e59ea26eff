// Which links become lines: those between volumes, unless a set is so large that the lines would hide the plan.
#include "core/drawing/link_families.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

namespace bl::report {

namespace {

// A link over more pairs than this would be a thicket; it is named in the caption instead.
constexpr std::size_t kMostPairs = 16;

constexpr std::array kFamilies = {LinkFamily{"adjacency, attraction", "#117733", ""},
                                  LinkFamily{"separation, repulsion", "#aa3311", "5 3"},
                                  LinkFamily{"distance", "#225599", "1.5 2.5"},
                                  LinkFamily{"alignment, stacking", "#882288", "9 3"},
                                  LinkFamily{"numbers: ratios, caps, mapped values", "#666a73", "8 3 1.5 3"},
                                  LinkFamily{"other kinds", "#8a5a00", "3 2 1 2"}};

}  // namespace

const LinkFamily* family_of(std::string_view kind) {
  if (kind == "demand" || kind == "inside_boundary") return nullptr;
  if (kind == "adjacency" || kind == "attract") return &kFamilies[0];
  if (kind == "separation" || kind == "repel") return &kFamilies[1];
  if (kind == "keep_distance") return &kFamilies[2];
  if (kind == "align" || kind == "stack") return &kFamilies[3];
  if (kind == "ratio" || kind == "set_cap" || kind == "map_value") return &kFamilies[4];
  return &kFamilies[5];
}

namespace {

bool joins_volumes_only(const Plan& plan, const LinkPlan& link) {
  const auto is_volume = [&](std::uint32_t node) {
    const auto& types = plan.nodes[node].types;
    return std::any_of(types.begin(), types.end(), [](const TypePlan& type) { return type.definition->id == "smart_volume"; });
  };
  return std::all_of(link.nodes[0].begin(), link.nodes[0].end(), is_volume) &&
         std::all_of(link.nodes[1].begin(), link.nodes[1].end(), is_volume);
}

}  // namespace

DrawnLinks links_to_draw(const State& state) {
  DrawnLinks drawn;
  std::map<std::string, std::size_t> beside;
  std::set<const LinkFamily*> seen;
  for (const LinkPlan& link : state.plan->links) {
    if (link.definition == nullptr || !link.is_enabled) continue;
    const LinkFamily* family = family_of(link.definition->id);
    if (family == nullptr) continue;
    // Links to streets, studies, styles and data say nothing of where volumes stand to each other, and would cover the plan.
    if (!joins_volumes_only(*state.plan, link)) {
      ++beside[link.definition->label];
      continue;
    }
    std::vector<DrawnLink> lines;
    std::size_t pairs = 0;
    for (const std::uint32_t from : link.nodes[0])
      for (const std::uint32_t to : link.nodes[1]) {
        if (from == to || (link.is_symmetric && to < from)) continue;
        if (++pairs > kMostPairs) break;
        lines.push_back({family, from, to, link.definition->label + " (" + link.id + (link.is_muted ? ", muted)" : ")")});
      }
    if (pairs > kMostPairs) {
      drawn.left_out.push_back(link.definition->label + " (" + link.id + ")");
      continue;
    }
    if (!lines.empty()) seen.insert(family);
    drawn.lines.insert(drawn.lines.end(), lines.begin(), lines.end());
  }
  for (const LinkFamily& family : kFamilies)
    if (seen.contains(&family)) drawn.families.push_back(&family);
  for (const auto& [label, count] : beside)
    drawn.beside.push_back(label + (count == 1 ? "" : " (" + std::to_string(count) + ")"));
  return drawn;
}

}  // namespace bl::report
