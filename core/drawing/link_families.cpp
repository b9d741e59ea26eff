// Which links become lines: those between volumes, unless a set is so large that the lines would hide the plan.
#include "core/drawing/link_families.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "core/reading/views/volume.h"

namespace bl::drawing {

namespace {

// A link over more pairs than this would be a thicket; it is named in the caption instead.
constexpr std::size_t kMostPairs = 16;

// In the order of the families.
constexpr std::array kInks = {FamilyInk{"adjacency, attraction", "#117733", ""},
                              FamilyInk{"separation, repulsion", "#aa3311", "5 3"},
                              FamilyInk{"distance", "#225599", "1.5 2.5"},
                              FamilyInk{"alignment, stacking", "#882288", "9 3"},
                              FamilyInk{"numbers: ratios, caps, mapped values", "#666a73", "8 3 1.5 3"},
                              FamilyInk{"data, sensors, actuators", "#332288", "10 3 1.5 3 1.5 3"},
                              FamilyInk{"ground, plots", "#5f6b00", "4 1.5"},
                              FamilyInk{"traffic", "#00727f", "14 3"},
                              FamilyInk{"sun and shadow", "#b85000", "1 3"},
                              FamilyInk{"façades", "#b02a70", "6 2 2 2"},
                              FamilyInk{"other kinds", "#8a5a00", "3 2 1 2"}};
static_assert(kInks.size() == static_cast<std::size_t>(LinkFamily::brief), "each family that joins places has an ink");

}  // namespace

const FamilyInk* ink_of(LinkFamily family) {
  return family == LinkFamily::brief ? nullptr : &kInks[static_cast<std::size_t>(family)];
}

namespace {

bool joins_volumes_only(const State& state, const LinkPlan& link) {
  const auto is_volume = [&](std::uint32_t node) { return reading::is_a<reading::VolumeFigures>(state, node); };
  return std::all_of(link.nodes[0].begin(), link.nodes[0].end(), is_volume) &&
         std::all_of(link.nodes[1].begin(), link.nodes[1].end(), is_volume);
}

}  // namespace

DrawnLinks links_to_draw(const State& state) {
  DrawnLinks drawn;
  std::map<std::string, std::size_t> beside;
  std::set<const FamilyInk*> seen;
  for (const LinkPlan& link : state.plan->links) {
    if (link.definition == nullptr || !link.is_enabled) continue;
    const FamilyInk* ink = ink_of(link.definition->family);
    if (ink == nullptr) continue;
    // Links to streets, studies, styles and data say nothing of where volumes stand to each other, and would cover the plan.
    if (!joins_volumes_only(state, link)) {
      ++beside[link.definition->label];
      continue;
    }
    std::vector<DrawnLink> lines;
    std::size_t pairs = 0;
    for (const std::uint32_t from : link.nodes[0])
      for (const std::uint32_t to : link.nodes[1]) {
        if (from == to || (link.is_symmetric && to < from)) continue;
        if (++pairs > kMostPairs) break;
        lines.push_back({ink, from, to, link.definition->label + " (" + link.id + (link.is_muted ? ", muted)" : ")")});
      }
    if (pairs > kMostPairs) {
      drawn.left_out.push_back(link.definition->label + " (" + link.id + ")");
      continue;
    }
    if (!lines.empty()) seen.insert(ink);
    drawn.lines.insert(drawn.lines.end(), lines.begin(), lines.end());
  }
  for (const FamilyInk& ink : kInks)
    if (seen.contains(&ink)) drawn.families.push_back(&ink);
  for (const auto& [label, count] : beside)
    drawn.beside.push_back(label + (count == 1 ? "" : " (" + std::to_string(count) + ")"));
  return drawn;
}

}  // namespace bl::drawing
