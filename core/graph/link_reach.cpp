// Keeps the places of nodes, and searches among them.
#include "core/graph/link_reach.h"

#include <algorithm>
#include <bit>

#include "core/graph/link_run.h"

namespace bl {

namespace {

// Fewer pairs are sooner asked than sifted.
constexpr std::size_t kFewPairs = 64;

// What lies as near to the bounds of silence as this is asked: kinds may measure with other roundings.
constexpr double kMargin = 1e-9;

PortRef position_read(const LinkPlan& plan, End end, std::size_t node) {
  return plan.reads[plan.definition->silent_reads[static_cast<std::size_t>(end)]][node];
}

const std::vector<std::uint32_t>& nodes_of(const LinkPlan& plan, End end) { return plan.nodes[static_cast<std::size_t>(end)]; }

// A pair that reads what failed has to fail, too, however far apart its nodes are; and a whole end has no pairs.
bool can_be_silent(const State& frozen, const LinkPlan& plan) {
  const LinkDefinition& definition = *plan.definition;
  if (!definition.silent_band || definition.is_whole(End::from) || definition.is_whole(End::to)) return false;
  for (const auto& refs : plan.reads)
    for (const PortRef& ref : refs)
      if (ref.type != PortRef::kNodeId && frozen.plan->port(ref).is_computed) return false;
  return plan.nodes[0].size() * plan.nodes[1].size() >= kFewPairs;
}

}  // namespace

bool LinkReach::follow(const State& frozen, const LinkPlan& plan) {
  if (!is_known_) begin(frozen, plan);
  else if (is_useful_) read_changes(frozen, plan);
  return is_useful_;
}

void LinkReach::begin(const State& frozen, const LinkPlan& plan) {
  if (!can_be_silent(frozen, plan)) {
    is_known_ = true;
    return;
  }
  const SilentBand band = plan.definition->silent_band(plan.parameters.get());
  least_ = band.least * (1 + kMargin) + kMargin;
  most_ = band.most * (1 - kMargin) - kMargin;
  least_squared_ = least_ * least_;
  most_squared_ = most_ * most_;
  is_symmetric_ = plan.nodes[0] == plan.nodes[1];
  in_plan_ = band.in_plan;
  const bool is_useful = least_ <= most_;
  if (is_useful) read_all(frozen, plan);
  // Last of all: an exception on the way leaves what has to be begun again.
  is_useful_ = is_useful;
  is_known_ = true;
}

void LinkReach::read_all(const State& frozen, const LinkPlan& plan) {
  std::size_t most_nodes = 0;
  for (const End end : {End::from, End::to}) {
    const std::size_t count = nodes_of(plan, end).size();
    most_nodes = std::max(most_nodes, count);
    if (is_symmetric_ && end == End::to) break;
    std::vector<Point3> places;
    places.reserve(count);
    for (std::size_t i = 0; i < count; ++i) places.push_back(std::get<Point3>(frozen.value(position_read(plan, end, i))));
    grids_[static_cast<std::size_t>(end)] = PointGrid(std::move(places), least_, in_plan_);
  }
  marks_.assign(most_nodes / 64 + 1, 0);
  nodes_ = frozen.nodes;
  moves_ = 0;
}

void LinkReach::read_changes(const State& frozen, const LinkPlan& plan) {
  // Whoever leaves widens the bounds of a grid for good: now and then they are found anew.
  if (moves_ > plan.nodes[0].size() + plan.nodes[1].size()) return read_all(frozen, plan);
  each_difference(nodes_, frozen.nodes, [&](std::uint32_t n) {
    for (const End end : {End::from, End::to}) {
      if (is_symmetric_ && end == End::to) break;
      const auto at = place_in(nodes_of(plan, end), n);
      if (!at) continue;
      const auto& now = std::get<Point3>(frozen.value(position_read(plan, end, *at)));
      if (now == grid(end)[*at]) continue;
      grid(end).move(*at, now);
      ++moves_;
    }
  });
  nodes_ = frozen.nodes;
}

void LinkReach::find_partners(End end, const Point3& there) {
  const PointGrid& places = grid(end);
  const auto mark = [&](std::uint32_t place) {
    if (!is_silent(squared_norm(places.way(there, places[place])))) marks_[place / 64] |= std::uint64_t{1} << (place % 64);
  };
  if (places.farthest(there) > most_)
    for (std::uint32_t place = 0; place < places.size(); ++place) mark(place);
  else places.visit_near(there, least_, mark);
  found_.clear();
  for (std::size_t word = 0; word <= places.size() / 64; ++word)
    for (std::uint64_t& bits = marks_[word]; bits != 0; bits &= bits - 1)
      found_.push_back(static_cast<std::uint32_t>(64 * word + static_cast<unsigned>(std::countr_zero(bits))));
}

std::optional<std::vector<std::uint32_t>> LinkReach::concerned(const State& frozen, const LinkPlan& plan,
                                                               std::span<const std::uint32_t> changed) {
  const std::size_t many = (plan.nodes[0].size() + (is_symmetric_ ? 0 : plan.nodes[1].size())) / 2;
  if (changed.size() > many) return std::nullopt;
  std::vector<std::uint32_t> nodes(changed.begin(), changed.end());
  const auto add_partners = [&](End end, const Point3& there) {
    find_partners(end, there);
    for (const std::uint32_t place : found_) nodes.push_back(nodes_of(plan, end)[place]);
  };
  const auto tidy = [&] {
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  };
  std::size_t tidy_from = 4 * many;
  for (const std::uint32_t node : changed)
    for (const End end : {End::from, End::to}) {
      const auto at = place_in(nodes_of(plan, end), node);
      if (!at) continue;
      const End other = end == End::from ? End::to : End::from;
      add_partners(other, grid(end)[*at]);
      const PortRef place = position_read(plan, end, *at);
      const auto was = std::lower_bound(frozen.due.were.begin(), frozen.due.were.end(), place,
                                        [](const PointBefore& before, const PortRef& ref) { return before.port < ref; });
      if (was != frozen.due.were.end() && was->port == place) add_partners(other, was->at);
      if (nodes.size() > tidy_from) {
        tidy();
        if (nodes.size() > many) return std::nullopt;
      }
      if (is_symmetric_) break;
    }
  tidy();
  if (nodes.size() > many) return std::nullopt;
  return nodes;
}

std::vector<LinkReach::Pair> LinkReach::pairs_of(const LinkPlan& plan, std::span<const std::uint32_t> nodes) {
  std::vector<Pair> pairs;
  for (const std::uint32_t node : nodes)
    for (const End end : {End::from, End::to}) {
      const auto at = place_in(nodes_of(plan, end), node);
      if (!at) continue;
      find_partners(end == End::from ? End::to : End::from, grid(end)[*at]);
      for (const std::uint32_t partner : found_) {
        const bool is_turned = is_symmetric_ ? partner < *at : end == End::to;
        pairs.push_back(is_turned ? Pair{partner, *at} : Pair{*at, partner});
      }
      if (is_symmetric_) break;
    }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace bl
