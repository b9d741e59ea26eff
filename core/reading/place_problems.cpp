// Reads the standing and the positions of volumes; groups are found by joining pairs that are too near.
#include "core/reading/place_problems.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/text.h"
#include "core/geometry/touching_balls.h"
#include "core/reading/views/node.h"
#include "core/reading/views/volume.h"

namespace bl::reading {

namespace {

constexpr std::size_t kNamedVolumes = 4, kNamedLinks = 6;
// [m] a tick: less lifts nobody that anybody sees.
constexpr double kLeastLift = 0.005;

using reading::NodePlace;
using reading::VolumeFigures;

bool is_place(const State& state, PortRef port) { return reading::port_of<&NodePlace::position>(*state.plan, port.node) == port; }

struct PlacedVolume {
  std::uint32_t node = 0;
  Point3 position;
  double radius = 0;  // of a ball of the wanted volume [m]
};

std::vector<PlacedVolume> placed_volumes(const State& state) {
  std::vector<PlacedVolume> volumes;
  for (const auto& [node, volume] : reading::rows<VolumeFigures>(state))
    volumes.push_back({node, volume.position, geometry::ball_radius(volume.wanted)});
  return volumes;
}

// Volumes that are joined by pairs on one point carry the same number: the smallest index among them.
std::vector<std::size_t> groups_on_one_point(const std::vector<PlacedVolume>& volumes) {
  std::vector<std::size_t> group(volumes.size()), by_x(volumes.size());
  std::iota(group.begin(), group.end(), std::size_t{0});
  std::iota(by_x.begin(), by_x.end(), std::size_t{0});
  std::stable_sort(by_x.begin(), by_x.end(),
                   [&](std::size_t a, std::size_t b) { return volumes[a].position.x < volumes[b].position.x; });
  const auto head = [&](std::size_t i) {
    while (group[i] != i) i = group[i];
    return i;
  };
  for (std::size_t k = 0; k < by_x.size(); ++k)
    for (std::size_t m = k + 1; m < by_x.size(); ++m) {
      const PlacedVolume &a = volumes[by_x[k]], &b = volumes[by_x[m]];
      // No pair is on one point that is further apart along x than what the left one allows.
      if (b.position.x - a.position.x > kOnePoint * a.radius) break;
      if (distance(a.position, b.position) > kOnePoint * std::min(a.radius, b.radius)) continue;
      const std::size_t first = head(by_x[k]), second = head(by_x[m]);
      group[std::max(first, second)] = std::min(first, second);
    }
  for (std::size_t i = 0; i < group.size(); ++i) group[i] = head(i);
  return group;
}

// Does the link move its nodes away from the point? Then it is not what brought them there.
bool is_parting(const State& state, std::size_t link, const std::vector<std::uint32_t>& nodes, const Point3& middle) {
  double outward = 0;
  for (const Voice& voice : state.links[link].voices)
    if (const auto* move = std::get_if<Vector3>(&voice.value);
        move != nullptr && std::binary_search(nodes.begin(), nodes.end(), voice.target.node))
      outward += dot(*move, reading::read<&NodePlace::position>(state, voice.target.node) - middle);
  return outward > 0;
}

// Links that run between the volumes of a group and move them.
std::vector<std::string> links_between(const State& state, const std::vector<std::uint32_t>& nodes) {
  Point3 middle;
  for (const std::uint32_t node : nodes)
    middle += reading::read<&NodePlace::position>(state, node) / static_cast<double>(nodes.size());
  const auto has_member = [&](const std::vector<std::uint32_t>& end) {
    return std::any_of(end.begin(), end.end(),
                       [&](std::uint32_t n) { return std::binary_search(nodes.begin(), nodes.end(), n); });
  };
  std::vector<std::string> ids;
  for (std::size_t l = 0; l < state.plan->links.size(); ++l) {
    const LinkPlan& link = state.plan->links[l];
    if (!link.is_enabled || link.is_muted || !has_member(link.nodes[0]) || !has_member(link.nodes[1])) continue;
    const bool moves =
        std::any_of(link.targets.begin(), link.targets.end(), [&](PortRef target) { return is_place(state, target); });
    if (moves && !is_parting(state, l, nodes, middle)) ids.push_back(link.id);
  }
  return ids;
}

std::string quoted_list(const std::vector<std::string>& ids, std::size_t most) {
  std::string text;
  for (std::size_t i = 0; i < std::min(most, ids.size()); ++i) text += (i > 0 ? ", `" : "`") + ids[i] + "`";
  if (ids.size() > most) text += " and " + std::to_string(ids.size() - most) + " more";
  return text;
}

PlaceProblem collapse_of(const State& state, const std::vector<std::uint32_t>& nodes) {
  PlaceProblem problem;
  for (const std::uint32_t node : nodes) problem.nodes.push_back(state.plan->nodes[node].id);
  problem.links = links_between(state, nodes);
  problem.subject = std::to_string(nodes.size()) + " volumes lie on one point";
  if (!problem.links.empty()) problem.subject += ", pulled by " + quoted_list(problem.links, kNamedLinks);
  problem.text =
      quoted_list(problem.nodes, kNamedVolumes) + "; " +
      (problem.links.empty() ? "move them apart"
                             : "weaken the links that pull, or add a `make_room` link from the solver to the volumes") +
      ", so they have no separate bodies";
  return problem;
}

// Links that say something to where a node is, by whether they are a `stand`, and which of the others lift it.
struct Holding {
  std::string stand;
  std::vector<std::string> lifting;
};

Holding who_holds(const State& state, std::uint32_t node) {
  Holding holding;
  for (std::size_t l = 0; l < state.plan->links.size(); ++l) {
    const LinkPlan& link = state.plan->links[l];
    if (link.definition == nullptr || !link.is_enabled || link.is_muted || link.error) continue;
    if (reading::is_a<reading::StandParameters>(*link.definition)) {
      if (std::find(link.nodes[1].begin(), link.nodes[1].end(), node) != link.nodes[1].end()) holding.stand = link.id;
      continue;
    }
    const bool lifts = std::any_of(state.links[l].voices.begin(), state.links[l].voices.end(), [&](const Voice& voice) {
      const auto* move = std::get_if<Vector3>(&voice.value);
      return voice.target.node == node && move != nullptr && move->z > kLeastLift && is_place(state, voice.target);
    });
    if (lifts) holding.lifting.push_back(link.id);
  }
  return holding;
}

// What helps who hangs: a `stand`, or where one runs already, whatever keeps it from its work.
std::string help_for(const State& state, std::uint32_t node) {
  const Holding holding = who_holds(state, node);
  if (holding.stand.empty()) return "add a `stand` link from the solver to it, or let its `standing` allow it";
  if (holding.lifting.empty())
    return "`" + holding.stand +
           "` still lets it down: let more ticks run; if it stays, unlock its place, or let its `standing` allow it";
  return "`" + holding.stand + "` lets it down, but " + quoted_list(holding.lifting, kNamedLinks) +
         (holding.lifting.size() == 1 ? " holds" : " hold") + " it up: weaken that, or let its `standing` allow it";
}

PlaceProblem hanging(const State& state, std::uint32_t node, const VolumeFigures& volume) {
  const std::string &rule = volume.standing, &on = volume.stands_on;
  PlaceProblem problem;
  problem.nodes = {state.plan->nodes[node].id};
  problem.subject =
      state.plan->nodes[node].name + (on.empty() ? " hangs " : " stands ") + fixed(volume.hang, 1) + " m above the ground";
  if (rule == "ground")
    problem.text = (on.empty() ? "it" : "it stands on `" + on + "`, and") + std::string(" has to stand on the ground");
  else if (rule == "bridge") problem.text = "nothing that stands carries it, and fewer than two volumes that stand hold it";
  else problem.text = "nothing that stands carries it";
  problem.text += "; " + help_for(state, node);
  return problem;
}

}  // namespace

std::vector<PlaceProblem> hanging_volumes(const State& state) {
  std::vector<PlaceProblem> problems;
  for (const auto& [node, volume] : reading::rows<VolumeFigures>(state))
    if (volume.hang > kLeastHang) problems.push_back(hanging(state, node, volume));
  return problems;
}

std::vector<PlaceProblem> collapsed_volumes(const State& state) {
  const std::vector<PlacedVolume> volumes = placed_volumes(state);
  const std::vector<std::size_t> group = groups_on_one_point(volumes);
  std::vector<std::vector<std::uint32_t>> members(volumes.size());
  for (std::size_t i = 0; i < volumes.size(); ++i)
    if (volumes[i].radius > 0) members[group[i]].push_back(volumes[i].node);
  std::vector<PlaceProblem> problems;
  for (const std::vector<std::uint32_t>& nodes : members)
    if (nodes.size() > 1) problems.push_back(collapse_of(state, nodes));
  std::stable_sort(problems.begin(), problems.end(),
                   [](const PlaceProblem& a, const PlaceProblem& b) { return a.nodes.size() > b.nodes.size(); });
  return problems;
}

std::vector<PlaceProblem> place_problems(const State& state) {
  std::vector<PlaceProblem> problems = collapsed_volumes(state), hanging = hanging_volumes(state);
  problems.insert(problems.end(), hanging.begin(), hanging.end());
  return problems;
}

}  // namespace bl::reading
