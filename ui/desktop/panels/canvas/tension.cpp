// Reads tensions and voices from the state, for marks and for the card of a node.
#include "ui/desktop/panels/canvas/tension.h"

#include <algorithm>

#include "core/reading/figures.h"
#include "core/reading/report_model.h"
#include "core/reading/views/volume.h"

namespace bl::desktop::canvas {

double tension_share(const State& state, PortRef ref) {
  const auto& tension = state.nodes[ref.node].types[ref.type].tension;
  if (ref.port >= tension.size() || !(tension[ref.port] > 0)) return 0;
  const Value& value = state.value(ref);
  // Places have no size of their own: a pull counts against the radius of what it moves.
  const double size = std::holds_alternative<Vector3>(value)
                          ? std::max(1.0, reading::read<&reading::VolumeFigures::radius>(state, ref.node))
                          : std::max(std::abs(as_number(value)), 1e-9);
  return tension[ref.port] / size;
}

double worst_tension(const State& state, std::uint32_t node) {
  double worst = 0;
  const auto& types = state.nodes[node].types;
  for (std::uint16_t t = 0; t < types.size(); ++t)
    for (std::uint16_t p = 0; p < types[t].tension.size(); ++p)
      if (types[t].tension[p] > 0) worst = std::max(worst, tension_share(state, {node, t, p}));
  return worst;
}

std::vector<Pull> pulls_of(const State& state, std::uint32_t node) {
  std::vector<Pull> pulls;
  const auto& types = state.nodes[node].types;
  for (std::uint16_t t = 0; t < types.size(); ++t)
    for (std::uint16_t p = 0; p < types[t].tension.size(); ++p) {
      const PortRef ref{node, t, p};
      const double share = tension_share(state, ref);
      if (share < kMarkedTension) continue;
      const PortDefinition& port = state.plan->port(ref);
      pulls.push_back({ref, share, port.id + ": " + reading::quantity(types[t].tension[p], port.unit) + " apart"});
    }
  std::stable_sort(pulls.begin(), pulls.end(), [](const Pull& a, const Pull& b) { return a.share > b.share; });
  return pulls;
}

std::vector<std::string> voices_at(const State& state, PortRef ref) {
  std::vector<std::string> texts;
  const PortDefinition& port = state.plan->port(ref);
  for (std::size_t l = 0; l < state.links.size(); ++l) {
    const LinkPlan& link = state.plan->links[l];
    if (!link.is_enabled || link.is_muted || link.definition == nullptr) continue;
    for (const Voice& voice : state.links[l].voices) {
      const bool is_sum = port.rule == CombineRule::sum;
      if (voice.target != ref || voice.strength <= 0 || (is_sum && voice.magnitude <= 0)) continue;
      const std::string who = link.definition->label + " (" + link.id + ") ";
      if (port.rule == CombineRule::collect) {
        texts.push_back(who + reading::voice_text(state, voice));
        continue;
      }
      const double size = is_sum ? voice.magnitude : as_number(voice.value);
      texts.push_back(who + (is_sum ? "pulls " : "wants ") + reading::quantity(size, port.unit));
    }
  }
  return texts;
}

std::string error_of(const State& state, std::uint32_t node) {
  for (const TypeState& type : state.nodes[node].types)
    if (type.error) return type.error->message;
  return "";
}

bool has_error(const State& state, std::uint32_t node) {
  const auto& types = state.nodes[node].types;
  return std::any_of(types.begin(), types.end(),
                     [](const TypeState& type) { return type.error && !type.error->message.empty(); });
}

}  // namespace bl::desktop::canvas
