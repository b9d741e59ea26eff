// Directions, steps and loads of the bi-conjugate Frank-Wolfe method.
#include "tests/bench/bench_frank_wolfe.h"

#include <algorithm>
#include <cmath>

namespace bl::cli::bench {

namespace {

// A step this near to 1 leaves nothing of the last direction to be conjugate to.
constexpr double kWholeStep = 0.99999;

}  // namespace

FrankWolfe::FrankWolfe(traffic::TrafficNetwork network, std::vector<traffic::TripDemand> demands)
    : network_(std::move(network)), demands_(std::move(demands)), paths_(network_) {
  for (std::uint32_t l = 0; l < network_.link_count(); ++l) costs_.push_back(network_.cost(l, 0));
  load_shortest(flows_);
}

void FrankWolfe::set_capacity(std::uint32_t link, double capacity) {
  (void)network_.set_capacity(link, capacity);
  directions_ = 0;
}

void FrankWolfe::set_flows(std::vector<double> flows) {
  flows_ = std::move(flows);
  directions_ = 0;
  iterations_ = 0;
}

double FrankWolfe::objective() const {
  double sum = 0;
  for (std::uint32_t l = 0; l < network_.link_count(); ++l) sum += network_.integral(l, flows_[l]);
  return sum;
}

// Everybody on the way that is shortest at the costs as they are.
void FrankWolfe::load_shortest(std::vector<double>& target) {
  target.assign(network_.link_count(), 0);
  std::uint32_t origin = traffic::kNoTrafficIndex;
  for (const traffic::TripDemand& demand : demands_) {
    if (demand.origin != origin) paths_.run(origin = demand.origin, costs_);
    if (paths_.labels()[demand.destination] == traffic::kUnreached) continue;
    for (std::uint32_t node = demand.destination; node != origin;) {
      const std::uint32_t link = paths_.last_links()[node];
      target[link] += demand.trips;
      node = network_.from(link);
    }
  }
}

// The target is a mean of the shortest ways and the last two targets whose direction is conjugate to the last two directions, as
// the curvature is now. Names as in the paper: x flows, y shortest ways, s targets, tau the last step.
void FrankWolfe::choose_target() {
  const std::size_t count = flows_.size();
  double of_last_y = 0, of_last_last = 0, of_both_y = 0, of_both_change = 0;
  const double tau = last_step_;
  for (std::uint32_t l = 0; l < count; ++l) {
    const double curvature = network_.slope(l, flows_[l]), to_y = shortest_[l] - flows_[l];
    const double to_last = last_[l] - flows_[l], to_both = tau * last_[l] - flows_[l] + (1 - tau) * before_last_[l];
    of_last_y += to_last * curvature * to_y;
    of_last_last += to_last * curvature * to_last;
    of_both_y += to_both * curvature * to_y;
    of_both_change += to_both * curvature * (before_last_[l] - last_[l]);
  }
  double mu = 0, nu = 0;
  if (directions_ > 1 && of_both_change != 0) mu = std::max(0.0, -of_both_y / of_both_change);
  if (directions_ > 0 && of_last_last > 0) nu = std::max(0.0, -of_last_y / of_last_last + mu * tau / (1 - tau));
  const double share = 1 / (1 + mu + nu);
  target_.resize(count);
  for (std::size_t l = 0; l < count; ++l) target_[l] = share * (shortest_[l] + nu * last_[l] + mu * before_last_[l]);
}

// Where the cost along the direction has come down to nothing, or all of it: halving, and Newton's step where it stays between.
double FrankWolfe::step_length(std::span<const double> direction) const {
  const auto slope_at = [&](double step, double& curvature) {
    double slope = 0;
    curvature = 0;
    for (std::uint32_t l = 0; l < direction.size(); ++l) {
      if (direction[l] == 0) continue;
      const double flow = std::max(0.0, flows_[l] + step * direction[l]);
      slope += direction[l] * network_.cost(l, flow);
      curvature += direction[l] * direction[l] * network_.slope(l, flow);
    }
    return slope;
  };
  double low = 0, high = 1, step = 1, curvature = 0;
  if (slope_at(1, curvature) <= 0) return 1;
  step = 0;
  for (int round = 0; round < 30 && high - low > 1e-12; ++round) {
    const double slope = slope_at(step, curvature);
    (slope > 0 ? high : low) = step;
    const double newton = curvature > 0 ? step - slope / curvature : low;
    const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
    if (std::abs(next - step) < 1e-12) break;
    step = next;
  }
  return step;
}

bool FrankWolfe::run(double gap, int most) {
  for (int end = iterations_ + most;; ++iterations_) {
    double total = 0, least = 0;
    for (std::uint32_t l = 0; l < network_.link_count(); ++l) costs_[l] = network_.cost(l, flows_[l]);
    load_shortest(shortest_);
    for (std::size_t l = 0; l < flows_.size(); ++l) total += flows_[l] * costs_[l], least += shortest_[l] * costs_[l];
    gap_ = total > 0 ? (total - least) / total : 0;
    if (gap_ <= gap) return true;
    if (iterations_ >= end) return false;
    if (last_.empty()) last_ = before_last_ = shortest_;
    choose_target();
    std::vector<double> direction(flows_.size());
    for (std::size_t l = 0; l < flows_.size(); ++l) direction[l] = target_[l] - flows_[l];
    last_step_ = step_length(direction);
    for (std::size_t l = 0; l < flows_.size(); ++l) flows_[l] = std::max(0.0, flows_[l] + last_step_ * direction[l]);
    before_last_.swap(last_);
    last_.swap(target_);
    directions_ = last_step_ >= kWholeStep ? 0 : std::min(2, directions_ + 1);
  }
}

}  // namespace bl::cli::bench
