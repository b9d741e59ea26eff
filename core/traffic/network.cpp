// Checking, ordering and costing a street network.
#include "core/traffic/network.h"

#include <algorithm>
#include <cmath>

namespace bl {

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

// Beyond this factor a delay goes on along its tangent.
constexpr double kSteepest = 1e9;
// Where the slope of a root is taken for less: at no flow it rises upright, and no step would ever lead away from there [capacity].
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
  return std::pow(base, power);
}

// load^power, its slope and the area under it, with the tangent beyond `kSteepest`.
struct Rise {
  double value = 0, slope = 0, area = 0;
};
Rise rise_of(double load, double power) {
  const double value = power_of(load, power);
  if (value <= kSteepest)
    return {value, power * power_of(power < 1 ? std::max(load, kRootFoot) : load, power - 1), value * load / (power + 1)};
  const double edge = std::pow(kSteepest, 1 / power), slope = power * kSteepest / edge, beyond = load - edge;
  return {kSteepest + slope * beyond, slope, kSteepest * edge / (power + 1) + (kSteepest + 0.5 * slope * beyond) * beyond};
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
  std::vector<std::uint32_t>& begin = network.out_begin_;
  begin.assign(network.nodes_.size() + 1, 0);
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
    ++begin[from + 1];
  }
  for (std::size_t n = 1; n < begin.size(); ++n) begin[n] += begin[n - 1];
  network.out_.resize(network.links_.size());
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  for (std::uint32_t l = 0; l < network.links_.size(); ++l) network.out_[next[network.from_[l]]++] = l;
  return network;
}

std::uint32_t TrafficNetwork::node_index(std::string_view id) const { return index_of(nodes_, id); }
std::uint32_t TrafficNetwork::link_index(std::string_view id) const { return index_of(links_, id); }

Result<void> TrafficNetwork::set_capacity(std::uint32_t link, double capacity) {
  TrafficLink changed = links_[link];
  changed.capacity = capacity;
  if (auto good = check_link(changed); !good) return good;
  links_[link] = std::move(changed);
  return {};
}

Result<void> TrafficNetwork::set_free_time(std::uint32_t link, double free_time) {
  TrafficLink changed = links_[link];
  changed.free_time = free_time;
  if (auto good = check_link(changed); !good) return good;
  links_[link] = std::move(changed);
  return {};
}

// Nothing is added where the time does not depend on the flow; there capacities may be 0.
double TrafficNetwork::time(std::uint32_t index, double flow) const {
  const TrafficLink& link = links_[index];
  const double scale = link.free_time * link.alpha;
  return link.free_time + link.wait + (scale > 0 ? scale * rise_of(flow / link.capacity, link.power).value : 0);
}

double TrafficNetwork::slope(std::uint32_t index, double flow) const {
  const TrafficLink& link = links_[index];
  const double scale = link.free_time * link.alpha;
  return scale > 0 && link.power > 0 ? scale * rise_of(flow / link.capacity, link.power).slope / link.capacity : 0;
}

double TrafficNetwork::integral(std::uint32_t index, double flow) const {
  const TrafficLink& link = links_[index];
  const double scale = link.free_time * link.alpha;
  return (link.free_time + link.wait + fixed_[index]) * flow +
         (scale > 0 ? scale * link.capacity * rise_of(flow / link.capacity, link.power).area : 0);
}

}  // namespace bl
