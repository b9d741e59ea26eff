// Checking, ordering and costing a street network.
#include "core/traffic/network.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/mathematics.h"

namespace bl::traffic {

namespace {

template <class Item>
Result<void> order_by_id(std::vector<Item>& items, const char* what) {
  std::sort(items.begin(), items.end(), [](const Item& a, const Item& b) { return a.id < b.id; });
  for (std::size_t i = 1; i < items.size(); ++i)
    if (items[i - 1].id == items[i].id)
      return Error{ErrorCode::duplicate, items[i].id,
                   "there are two " + std::string(what) + " of this id; give one of them another"};
  return {};
}

template <class Item>
std::uint32_t index_of(const std::vector<Item>& items, std::string_view id) {
  const auto it =
      std::lower_bound(items.begin(), items.end(), id, [](const Item& item, std::string_view key) { return item.id < key; });
  return it != items.end() && it->id == id ? static_cast<std::uint32_t>(it - items.begin()) : kNoTrafficIndex;
}

// Links by the node at one of their ends, ascending.
void order_by_end(const std::vector<std::uint32_t>& ends, std::size_t nodes, std::vector<std::uint32_t>& begin,
                  std::vector<std::uint32_t>& links) {
  begin.assign(nodes + 1, 0);
  for (const std::uint32_t node : ends) ++begin[node + 1];
  for (std::size_t n = 1; n < begin.size(); ++n) begin[n] += begin[n - 1];
  links.resize(ends.size());
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  for (std::uint32_t l = 0; l < ends.size(); ++l) links[next[ends[l]]++] = l;
}

// From this delay on [times of the data] it goes on along its tangent, so that costs and their sums stay finite.
constexpr double kLongest = 1e100;
// The power itself, without the numbers it is multiplied by, stays finite as well.
constexpr double kSteepest = 1e200;
// Where the slope of a root is taken for less: at no flow it rises upright, and no step would ever lead away from there
// [capacity].
constexpr double kRootFoot = 1e-6;

bool is_amount(double number) { return std::isfinite(number) && number >= 0; }

Result<void> check_link(const TrafficLink& link) {
  if (!is_amount(link.free_time)) return Error{ErrorCode::out_of_range, link.id, "the time without traffic has to be 0 or more"};
  if (!is_amount(link.alpha) || !is_amount(link.power))
    return Error{ErrorCode::out_of_range, link.id, "the two numbers of the delay formula have to be 0 or more"};
  if (!is_amount(link.capacity) || (link.capacity == 0 && link.free_time > 0 && link.alpha > 0))
    return Error{ErrorCode::out_of_range, link.id, "the capacity has to be above 0; close the street where nobody may pass"};
  if (!is_amount(link.wait)) return Error{ErrorCode::out_of_range, link.id, "the time at its end has to be 0 or more"};
  if (!is_amount(link.length)) return Error{ErrorCode::out_of_range, link.id, "the length has to be 0 or more"};
  if (!std::isfinite(link.toll)) return Error{ErrorCode::not_finite, link.id, "the toll has to be a finite number"};
  return {};
}

// base^power; whole powers, which are the rule, by multiplication.
double power_of(double base, double power) {
  if (power == 4) return (base * base) * (base * base);
  if (power == 1) return base;
  if (power >= 0 && power <= 16 && power == std::floor(power)) {
    double result = 1;
    for (int i = 0; i < static_cast<int>(power); ++i) result *= base;
    return result;
  }
  return mathematics::power(base, power);
}

// load^power, its slope and the area under it, with the tangent beyond the load `edge`.
struct Rise {
  double value = 0, slope = 0, area = 0;
};
Rise rise_of(double load, double power, double edge) {
  const double at = std::min(load, edge), beyond = load - at;
  const double value = power_of(at, power), slope = power * power_of(power < 1 ? std::max(at, kRootFoot) : at, power - 1);
  const Rise rise{value, slope, value * at / (power + 1)};
  if (!(beyond > 0)) return rise;
  return {value + slope * beyond, slope, rise.area + (value + 0.5 * slope * beyond) * beyond};
}

}  // namespace

Result<TrafficNetwork> TrafficNetwork::make(std::vector<TrafficNode> nodes, std::vector<TrafficLink> links,
                                            const CostFactors& factors) {
  if (auto ordered = order_by_id(nodes, "junctions"); !ordered) return ordered.error();
  if (auto ordered = order_by_id(links, "links"); !ordered) return ordered.error();
  TrafficNetwork network;
  network.nodes_ = std::move(nodes);
  network.links_ = std::move(links);
  for (const TrafficNode& node : network.nodes_) network.is_through_.push_back(node.is_through);
  for (const TrafficLink& link : network.links_) {
    if (auto good = check_link(link); !good) return good.error();
    const std::uint32_t from = network.node_index(link.from), to = network.node_index(link.to);
    if (from == kNoTrafficIndex || to == kNoTrafficIndex)
      return Error{ErrorCode::not_found, link.id,
                   "there is no junction `" + (from == kNoTrafficIndex ? link.from : link.to) + "` for it to end at"};
    if (from == to) return Error{ErrorCode::conflict, link.id, "it begins and ends at the same junction `" + link.from + "`"};
    const double fixed = factors.toll * link.toll + factors.distance * link.length;
    if (!(link.free_time + fixed >= 0))
      return Error{ErrorCode::out_of_range, link.id,
                   "its toll makes it cheaper than nothing; raise the toll or lower the factor"};
    network.from_.push_back(from);
    network.to_.push_back(to);
    network.is_open_.push_back(link.is_open);
    network.fixed_.push_back(fixed);
    network.delays_.push_back(delay_of(link));
  }
  order_by_end(network.from_, network.nodes_.size(), network.out_begin_, network.out_);
  order_by_end(network.to_, network.nodes_.size(), network.in_begin_, network.in_);
  return network;
}

std::uint32_t TrafficNetwork::node_index(std::string_view id) const { return index_of(nodes_, id); }
std::uint32_t TrafficNetwork::link_index(std::string_view id) const { return index_of(links_, id); }

Result<void> TrafficNetwork::set_capacity(std::uint32_t link, double capacity) {
  TrafficLink changed = links_[link];
  changed.capacity = capacity;
  if (auto good = check_link(changed); !good) return good;
  links_[link] = std::move(changed);
  delays_[link] = delay_of(links_[link]);
  return {};
}

Result<void> TrafficNetwork::set_free_time(std::uint32_t link, double free_time) {
  TrafficLink changed = links_[link];
  changed.free_time = free_time;
  if (auto good = check_link(changed); !good) return good;
  links_[link] = std::move(changed);
  delays_[link] = delay_of(links_[link]);
  return {};
}

// What is cut is the delay, not the power of the load: a network that writes capacity 1, and the real one within the factor, has
// huge loads and common delays.
TrafficNetwork::Delay TrafficNetwork::delay_of(const TrafficLink& link) {
  const double scale = link.free_time * link.alpha;
  double edge = std::numeric_limits<double>::infinity();
  if (scale > 0 && link.power > 0) edge = mathematics::power(std::min(kLongest / scale, kSteepest), 1 / link.power);
  return {link.free_time + link.wait, scale, link.capacity, link.power, edge};
}

bool TrafficNetwork::is_cut(std::uint32_t index, double flow) const {
  const Delay& delay = delays_[index];
  return delay.scale > 0 && delay.power != 1 && flow / delay.capacity > delay.edge;
}

bool TrafficNetwork::has_other_costs() const {
  return std::any_of(fixed_.begin(), fixed_.end(), [](double cost) { return cost != 0; });
}

// Nothing is added where the time does not depend on the flow; there capacities may be 0.
double TrafficNetwork::time(std::uint32_t index, double flow) const {
  const Delay& delay = delays_[index];
  return delay.least + (delay.scale > 0 ? delay.scale * rise_of(flow / delay.capacity, delay.power, delay.edge).value : 0);
}

double TrafficNetwork::slope(std::uint32_t index, double flow) const { return cost_and_slope(index, flow).slope; }

TrafficNetwork::CostAndSlope TrafficNetwork::cost_and_slope(std::uint32_t index, double flow) const {
  const Delay& delay = delays_[index];
  if (!(delay.scale > 0)) return {delay.least + fixed_[index], 0};
  const Rise rise = rise_of(flow / delay.capacity, delay.power, delay.edge);
  return {delay.least + delay.scale * rise.value + fixed_[index],
          delay.power > 0 ? delay.scale * rise.slope / delay.capacity : 0};
}

double TrafficNetwork::integral(std::uint32_t index, double flow) const {
  const Delay& delay = delays_[index];
  return (delay.least + fixed_[index]) * flow +
         (delay.scale > 0 ? delay.scale * delay.capacity * rise_of(flow / delay.capacity, delay.power, delay.edge).area : 0);
}

}  // namespace bl::traffic
