// Reads wished and built storeys, and the voices of links at the height limit.
#include "core/reading/storeys.h"

#include <algorithm>
#include <vector>

#include "core/base/text.h"
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

// The storeys that limits hold; a volume that shares the footprint of another has none of its own to ask for.
std::optional<StoreyFigures> held_storeys(const State& state, std::uint32_t node) {
  auto figures = reading::row_of<StoreyFigures>(state, node);
  const auto sharing = reading::row_of<SharingFigures>(state, node);
  if (!figures || !sharing || !sharing->shares.empty()) return std::nullopt;
  figures->storeys_built = sharing->storeys_held;
  return figures;
}

}  // namespace

std::optional<WithheldHeight> withheld_height(const State& state, std::uint32_t node) {
  const auto figures = held_storeys(state, node);
  if (!figures || !figures->is_limited || figures->storeys_built >= figures->storeys) return std::nullopt;
  const auto limit = reading::port_of<&StoreyFigures::height_limit>(*state.plan, node);
  const double storey = reading::read<&VolumeFigures::storey_height>(state, node);
  const auto missing = static_cast<double>(figures->storeys - figures->storeys_built);
  return WithheldHeight{*limit, missing * storey, missing / static_cast<double>(figures->storeys)};
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
  const auto figures = held_storeys(state, node);
  if (!figures || figures->storeys_built == 0 || figures->storeys_built >= figures->storeys) return "";
  const std::string had = std::to_string(figures->storeys_built) + " of " + std::to_string(figures->storeys) + " storeys: ";
  if (!figures->is_limited) return had + "the boundary is no higher";
  const auto limit = reading::port_of<&StoreyFigures::height_limit>(*state.plan, node);
  return had + holders_of(state, *limit) + " leaves " + fixed(figures->height_limit, 2) + " m";
}

bool has_all_storeys(const State& state, std::uint32_t node) {
  const auto figures = held_storeys(state, node);
  return figures && figures->storeys_built > 0 && figures->storeys_built >= figures->storeys;
}

}  // namespace bl::reading
