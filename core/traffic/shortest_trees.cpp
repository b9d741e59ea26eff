// Measuring kept ways anew, and mending them.
#include "core/traffic/shortest_trees.h"

#include <algorithm>

namespace bl::traffic {

ShortestTrees::ShortestTrees(const TrafficNetwork& network, std::vector<std::uint32_t> origins)
    : network_(&network), origins_(std::move(origins)), nodes_(network.node_count()), paths_(network) {
  place_.assign(nodes_, kNoTrafficIndex);
  for (std::size_t k = 0; k < origins_.size(); ++k) place_[origins_[k]] = static_cast<std::uint32_t>(k);
}

void ShortestTrees::move_to(const TrafficNetwork& network) {
  if (!network.has_structure_of(*network_)) {
    *this = ShortestTrees(network, origins_);
    return;
  }
  network_ = &network;
  paths_ = ShortestPaths(network);
}

std::span<const double> ShortestTrees::labels_of(std::uint32_t origin) const {
  return place_[origin] == kNoTrafficIndex ? std::span<const double>() : labels(place_[origin]);
}

void ShortestTrees::update(std::span<const double> costs) {
  if (!labels_.empty() && std::equal(costs.begin(), costs.end(), costs_.begin(), costs_.end())) return;
  const bool is_first = labels_.empty();
  costs_.assign(costs.begin(), costs.end());
  labels_.resize(origins_.size() * nodes_);
  last_links_.resize(labels_.size());
  for (std::size_t k = 0; k < origins_.size(); ++k) {
    if (is_first) {
      paths_.run(origins_[k], costs_);
      std::copy(paths_.labels().begin(), paths_.labels().end(), labels_.begin() + static_cast<std::ptrdiff_t>(k * nodes_));
      std::copy(paths_.last_links().begin(), paths_.last_links().end(),
                last_links_.begin() + static_cast<std::ptrdiff_t>(k * nodes_));
    } else {
      measure(k);
      paths_.mend(origins_[k], costs_, std::span(labels_).subspan(k * nodes_, nodes_),
                  std::span(last_links_).subspan(k * nodes_, nodes_));
    }
  }
}

// From each node back to one whose way is measured already, and onward again.
void ShortestTrees::measure(std::size_t place) {
  double* const labels = labels_.data() + place * nodes_;
  const std::uint32_t* const last = last_links_.data() + place * nodes_;
  is_known_.assign(nodes_, 0);
  labels[origins_[place]] = 0;
  is_known_[origins_[place]] = 1;
  for (std::uint32_t n = 0; n < nodes_; ++n) {
    waiting_.clear();
    std::uint32_t at = n;
    while (!is_known_[at] && last[at] != kNoTrafficIndex) {
      waiting_.push_back(at);
      at = network_->from(last[at]);
    }
    if (!is_known_[at]) {
      labels[at] = kUnreached;
      is_known_[at] = 1;
    }
    for (auto w = waiting_.rbegin(); w != waiting_.rend(); ++w) {
      labels[*w] = labels[at] + costs_[last[*w]];
      is_known_[*w] = 1;
      at = *w;
    }
  }
}

}  // namespace bl::traffic
