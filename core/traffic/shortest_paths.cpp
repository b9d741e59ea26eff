// Dijkstra's algorithm with a four-way heap; equal labels are told apart by indices, so that the result has no order of its own.
#include "core/traffic/shortest_paths.h"

#include <algorithm>
#include <utility>

namespace bl::traffic {

namespace {

bool comes_before(std::uint32_t a, std::uint32_t b, std::span<const double> labels) {
  return labels[a] != labels[b] ? labels[a] < labels[b] : a < b;
}

}  // namespace

void NodeHeap::push(std::uint32_t node, std::span<const double> labels) {
  if (place_[node] == kNoTrafficIndex) {
    place_[node] = static_cast<std::uint32_t>(heap_.size());
    heap_.push_back(node);
  }
  rise(place_[node], labels);
}

std::uint32_t NodeHeap::pop(std::span<const double> labels) {
  const std::uint32_t first = heap_.front(), last = heap_.back();
  heap_.pop_back();
  place_[first] = kNoTrafficIndex;
  if (!heap_.empty()) {
    heap_.front() = last;
    place_[last] = 0;
    sink(0, labels);
  }
  return first;
}

void NodeHeap::rise(std::size_t at, std::span<const double> labels) {
  const std::uint32_t node = heap_[at];
  while (at > 0) {
    const std::size_t parent = (at - 1) / 4;
    if (!comes_before(node, heap_[parent], labels)) break;
    heap_[at] = heap_[parent];
    place_[heap_[at]] = static_cast<std::uint32_t>(at);
    at = parent;
  }
  heap_[at] = node;
  place_[node] = static_cast<std::uint32_t>(at);
}

void NodeHeap::sink(std::size_t at, std::span<const double> labels) {
  const std::uint32_t node = heap_[at];
  for (std::size_t child = 4 * at + 1; child < heap_.size(); child = 4 * at + 1) {
    for (std::size_t c = child + 1, end = std::min(4 * at + 5, heap_.size()); c < end; ++c)
      if (comes_before(heap_[c], heap_[child], labels)) child = c;
    if (!comes_before(heap_[child], node, labels)) break;
    heap_[at] = heap_[child];
    place_[heap_[at]] = static_cast<std::uint32_t>(at);
    at = child;
  }
  heap_[at] = node;
  place_[node] = static_cast<std::uint32_t>(at);
}

ShortestPaths::ShortestPaths(const TrafficNetwork& network) : network_(&network), heap_(network.node_count()) {}

template <class Push>
void ShortestPaths::relax(std::uint32_t node, std::span<const double> costs, std::span<double> labels,
                          std::span<std::uint32_t> last_links, Push&& push) {
  for (const std::uint32_t l : network_->out_links(node)) {
    const std::uint32_t j = network_->to(l);
    const double way = labels[node] + costs[l];
    if (!(way < labels[j]) || !network_->is_open(l)) continue;
    labels[j] = way;
    if (!last_links.empty()) last_links[j] = l;
    push(j);
  }
}

void ShortestPaths::run(std::uint32_t origin, std::span<const double> costs) {
  labels_.assign(network_->node_count(), kUnreached);
  last_links_.assign(network_->node_count(), kNoTrafficIndex);
  labels_[origin] = 0;
  heap_.push(origin, labels_);
  while (!heap_.is_empty()) {
    const std::uint32_t i = heap_.pop(labels_);
    if (i == origin || network_->is_through(i))
      relax(i, costs, labels_, last_links_, [&](std::uint32_t j) { heap_.push(j, labels_); });
  }
}

// Few labels fall, and by little, so that a queue does it; the labels are the same in whatever order they fall.
void ShortestPaths::mend(std::uint32_t origin, std::span<const double> costs, std::span<double> labels,
                         std::span<std::uint32_t> last_links) {
  is_waiting_.resize(labels.size(), 0);
  queue_.clear();
  const auto push = [&](std::uint32_t node) {
    if (is_waiting_[node]) return;
    is_waiting_[node] = 1;
    queue_.push_back(node);
  };
  for (std::uint32_t i = 0; i < labels.size(); ++i)
    if (labels[i] != kUnreached && (i == origin || network_->is_through(i))) relax(i, costs, labels, last_links, push);
  for (std::size_t at = 0; at < queue_.size(); ++at) {
    const std::uint32_t i = queue_[at];
    is_waiting_[i] = 0;
    if (i == origin || network_->is_through(i)) relax(i, costs, labels, last_links, push);
  }
}

}  // namespace bl::traffic
