// Reads the standing and the positions of volumes; groups are found by joining pairs that are too near.
#include "core/reading/place_problems.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "core/base/text.h"
#include "core/geometry/touching_balls.h"
#include "core/reading/views/building.h"
#include "core/reading/views/node.h"
#include "core/reading/views/volume.h"

namespace bl::reading {

namespace {

constexpr std::size_t kNamedVolumes = 4, kNamedLinks = 6;
// Of more volumes that have moved, looking at all pairs anew takes less than looking at all others of each.
constexpr std::size_t kMostMoved = 64;
// [m] a tick: less lifts nobody that anybody sees.
constexpr double kLeastLift = 0.005;

using reading::NodePlace;
using reading::VolumeFigures;
using reading::VolumePlace;

bool is_place(const State& state, PortRef port) { return reading::port_of<&NodePlace::position>(*state.plan, port.node) == port; }

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
  // Room is made by a solver of rounded volumes alone.
  const bool stands = std::any_of(nodes.begin(), nodes.end(),
                                  [&](std::uint32_t node) { return reading::row_of<StoreyFigures>(state, node).has_value(); });
  problem.text = quoted_list(problem.nodes, kNamedVolumes) + "; " +
                 (problem.links.empty() ? "move them apart"
                  : stands              ? "weaken the links that pull, or move them apart"
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

bool shares_all(const LinkStates& a, const LinkStates& b) {
  bool is_shared = a.size() == b.size();
  for (std::size_t leaf = 0; is_shared && leaf < a.leaf_count(); ++leaf) is_shared = a.shares_leaf(b, leaf);
  return is_shared;
}

PlaceProblem hanging_volume(const State& state, std::uint32_t node, const VolumeFigures& volume) {
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

VolumePlaces::Volume VolumePlaces::volume_of(const State& state, std::uint32_t node, const VolumePlace& place) {
  std::optional<Level> level;
  if (const auto storeys = reading::row_of<StoreyFigures>(state, node))
    level = {place.bottom, storeys->bases.empty() ? "" : storeys->bases.front()};
  // What shares the footprint of another divides no ground with anybody: its place says nothing.
  if (const auto sharing = reading::row_of<SharingFigures>(state, node); level && sharing && !sharing->shares.empty())
    level->base = state.plan->nodes[node].id;
  return {node, place.position, geometry::ball_radius(place.wanted), place.hang, std::move(level)};
}

void VolumePlaces::join(std::size_t a, std::size_t b) {
  // One upon another they share a place in plan, and are no less separate bodies.
  if (volumes_[a].level && volumes_[b].level && !(*volumes_[a].level == *volumes_[b].level)) return;
  if (distance(volumes_[a].position, volumes_[b].position) > kOnePoint * std::min(volumes_[a].radius, volumes_[b].radius)) return;
  on_one_point_.emplace(a, b);
  on_one_point_.emplace(b, a);
}

void VolumePlaces::part(std::size_t row) {
  auto pair = on_one_point_.lower_bound({row, 0});
  while (pair != on_one_point_.end() && pair->first == row) {
    on_one_point_.erase({pair->second, row});
    pair = on_one_point_.erase(pair);
  }
}

void VolumePlaces::find_all_pairs() {
  on_one_point_.clear();
  std::vector<std::size_t> by_x(volumes_.size());
  std::iota(by_x.begin(), by_x.end(), std::size_t{0});
  std::stable_sort(by_x.begin(), by_x.end(),
                   [&](std::size_t a, std::size_t b) { return volumes_[a].position.x < volumes_[b].position.x; });
  for (std::size_t k = 0; k < by_x.size(); ++k)
    for (std::size_t m = k + 1; m < by_x.size(); ++m) {
      const Volume &a = volumes_[by_x[k]], &b = volumes_[by_x[m]];
      // No pair is on one point that is further apart along x than what the left one allows.
      if (b.position.x - a.position.x > kOnePoint * a.radius) break;
      join(by_x[k], by_x[m]);
    }
}

void VolumePlaces::read_changed(const State& state, const std::vector<std::uint32_t>& changed) {
  std::vector<std::size_t> moved;
  for (const std::uint32_t node : changed) {
    const auto at =
        std::lower_bound(volumes_.begin(), volumes_.end(), node, [](const Volume& v, std::uint32_t n) { return v.node < n; });
    if (at == volumes_.end() || at->node != node) continue;
    const Volume now = volume_of(state, node, *reading::row_of<VolumePlace>(state, node));
    if (now.position != at->position || now.radius != at->radius || now.level != at->level)
      moved.push_back(static_cast<std::size_t>(at - volumes_.begin()));
    *at = now;
    read_hanging(state, now);
  }
  if (moved.size() > kMostMoved) return find_all_pairs();
  for (const std::size_t row : moved) {
    part(row);
    for (std::size_t other = 0; other < volumes_.size(); ++other)
      if (other != row) join(row, other);
  }
}

void VolumePlaces::read_hanging(const State& state, const Volume& volume) {
  if (volume.hang > kLeastHang)
    hanging_[volume.node] = hanging_volume(state, volume.node, *reading::row_of<VolumeFigures>(state, volume.node));
  else hanging_.erase(volume.node);
}

void VolumePlaces::read(const State& state, const std::optional<std::vector<std::uint32_t>>& changed) {
  const bool says_the_same = changed && shares_all(state.links, links_);
  links_ = state.links;
  if (changed) {
    read_changed(state, *changed);
    if (says_the_same) return;
  } else {
    volumes_.clear();
    for (const auto& [node, place] : reading::rows<VolumePlace>(state)) volumes_.push_back(volume_of(state, node, place));
    find_all_pairs();
  }
  hanging_.clear();
  for (const Volume& volume : volumes_) read_hanging(state, volume);
}

// Volumes that are joined by pairs on one point: a group stands where its first volume does, the largest groups first.
std::vector<std::vector<std::uint32_t>> VolumePlaces::groups_on_one_point() const {
  std::map<std::size_t, std::size_t> head;
  const auto head_of = [&](std::size_t row) {
    auto at = head.emplace(row, row).first;
    while (at->second != at->first) at = head.find(at->second);
    return at->first;
  };
  for (const auto& [a, b] : on_one_point_) {
    const std::size_t first = head_of(a), second = head_of(b);
    head[std::max(first, second)] = std::min(first, second);
  }
  std::map<std::size_t, std::vector<std::uint32_t>> members;
  for (const auto& [row, next] : head)
    if (volumes_[row].radius > 0) members[head_of(row)].push_back(volumes_[row].node);
  std::vector<std::vector<std::uint32_t>> groups;
  for (auto& [first, nodes] : members)
    if (nodes.size() > 1) groups.push_back(std::move(nodes));
  std::stable_sort(groups.begin(), groups.end(), [](const auto& a, const auto& b) { return a.size() > b.size(); });
  return groups;
}

std::vector<PlaceProblem> VolumePlaces::collapsed(const State& state) const {
  std::vector<PlaceProblem> problems;
  for (const std::vector<std::uint32_t>& nodes : groups_on_one_point()) problems.push_back(collapse_of(state, nodes));
  return problems;
}

std::vector<PlaceProblem> hanging_volumes(const State& state) {
  VolumePlaces places;
  places.read(state, std::nullopt);
  std::vector<PlaceProblem> problems;
  for (const auto& [node, problem] : places.hanging()) problems.push_back(problem);
  return problems;
}

std::vector<PlaceProblem> collapsed_volumes(const State& state) {
  VolumePlaces places;
  places.read(state, std::nullopt);
  return places.collapsed(state);
}

std::vector<PlaceProblem> place_problems(const State& state) {
  VolumePlaces places;
  places.read(state, std::nullopt);
  std::vector<PlaceProblem> problems = places.collapsed(state);
  for (const auto& [node, problem] : places.hanging()) problems.push_back(problem);
  return problems;
}

}  // namespace bl::reading
