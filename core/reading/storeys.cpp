// Reads wished and built storeys, and the voices of links at the height limit.
#include "core/reading/storeys.h"

#include <algorithm>
#include <vector>

#include "core/base/text.h"
#include "core/demand/shared_storeys.h"
#include "core/reading/views/building.h"
#include "core/reading/views/volume.h"

namespace bl::reading {

namespace {

// Who holds the limit where it is: links, and people who have set it.
std::string holders_of(const State& state, PortRef ref) {
  const double limit = as_number(state.value(ref));
  const auto holds = [&](const Value& value) { return as_number(value) <= limit * (1 + 1e-9); };
  std::string who;
  const auto add = [&](const std::string& one) { who += (who.empty() ? "" : " and ") + one; };
  for (std::size_t l = 0; l < state.links.size(); ++l) {
    const LinkPlan& link = state.plan->links[l];
    if (!link.is_enabled || link.is_muted || link.definition == nullptr) continue;
    const std::vector<Voice>& voices = state.links[l].voices;
    const auto voice =
        std::lower_bound(voices.begin(), voices.end(), ref, [](const Voice& v, PortRef r) { return v.target < r; });
    if (voice != voices.end() && voice->target == ref && voice->strength > 0 && holds(voice->value))
      add("link `" + link.id + "` (" + link.definition->label + ")");
  }
  const TypePlan& type = state.plan->nodes[ref.node].types[ref.type];
  if (type.is_set[ref.port] && holds(type.set_values[ref.port])) add("a limit set by hand");
  return who.empty() ? "its height limit" : who;
}

// The storeys that limits hold: of a volume, or of the building that it shares with others.
struct HeldStoreys {
  std::int64_t wished = 0, built = 0;
  bool is_limited = false;
  double storey_height = 0, limit = 0;  // [m]
  std::uint32_t limited_by = 0;         // the node that has this limit
  bool is_its_own = true;               // not those of the building of another
};

std::optional<HeldStoreys> held_storeys(const State& state, std::uint32_t node) {
  const auto figures = reading::row_of<StoreyFigures>(state, node);
  const auto sharing = reading::row_of<SharingFigures>(state, node);
  if (!figures || !sharing) return std::nullopt;
  HeldStoreys held{figures->storeys, sharing->storeys_held, figures->is_limited, 0, figures->height_limit, node, true};
  if (const auto building = demand::building_in(sharing->building)) {
    const std::uint32_t by = state.plan->node_index(building->limited_by);
    return HeldStoreys{building->wished,
                       building->held,
                       held.is_limited,
                       building->storey_height,
                       building->limit,
                       by < state.nodes.size() ? by : node,
                       building->host == state.plan->nodes[node].id};
  }
  // Before the first tick, and where its host is none.
  if (!sharing->shares.empty()) return std::nullopt;
  held.storey_height = reading::read<&VolumeFigures::storey_height>(state, node);
  return held;
}

}  // namespace

std::optional<WithheldHeight> withheld_height(const State& state, std::uint32_t node) {
  const auto held = held_storeys(state, node);
  if (!held || held->limited_by != node || !held->is_limited || held->built >= held->wished) return std::nullopt;
  const auto limit = reading::port_of<&StoreyFigures::height_limit>(*state.plan, node);
  const auto missing = static_cast<double>(held->wished - held->built);
  return WithheldHeight{*limit, missing * held->storey_height, missing / static_cast<double>(held->wished), held->wished};
}

bool has_effect(const State& state, PortRef ref) {
  const Plan& plan = *state.plan;
  if (ref == reading::port_of<&FootprintFigures::angle>(plan, ref.node) ||
      ref == reading::port_of<&FootprintFigures::aspect>(plan, ref.node))
    return reading::read<&FootprintFigures::form>(state, ref.node) == "block";
  if (ref == reading::port_of<&StoreyFigures::ground>(plan, ref.node))
    return reading::read<&StoreyFigures::bases>(state, ref.node).empty();
  return true;
}

std::string why_lower(const State& state, std::uint32_t node) {
  const auto held = held_storeys(state, node);
  if (!held || !held->is_its_own || held->built == 0 || held->built >= held->wished) return "";
  const std::string had = std::to_string(held->built) + " of " + std::to_string(held->wished) + " storeys: ";
  if (!held->is_limited) return had + "the boundary is no higher";
  const auto limit = reading::port_of<&StoreyFigures::height_limit>(*state.plan, held->limited_by);
  return had + (limit ? holders_of(state, *limit) : "its height limit") + " leaves " + fixed(held->limit, 2) + " m";
}

bool has_all_storeys(const State& state, std::uint32_t node) {
  const auto held = held_storeys(state, node);
  return held && held->built > 0 && held->built >= held->wished;
}

}  // namespace bl::reading
