// Judging, damping and taking the steps: the rules of the exact fit (demand_fit.cpp), for any metric.
#include "core/geometry/inside/sampled_newton.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/hash.h"
#include "core/base/text.h"
#include "core/geometry/inside/fit_numbers.h"
#include "core/geometry/inside/potential_system.h"

namespace bl::geometry {

namespace {

// An emptied cell's site is put back into its own cell by this margin (1 would put it on the border).
constexpr double kSampledRepair = 0.8;
// A step leaves at least this share of r³, and takes no more than so many times it.
constexpr double kLeastOfCube = 0.1, kMostOfCube = 8;
// A step is halved no further than this.
constexpr double kLeastStep = 1.0 / 256;
// A weight never falls below this share of the weight whose whole ball has the demanded volume.
constexpr double kLeastShare = 1e-4;
// A radius never exceeds so many times what it takes to hold the whole domain. Where distances are divided by radii, small
// demands beside large ones need room for ratios.
constexpr double kMostSampledReach = 100;
// Steps go on to this share of the declared errors.
constexpr double kSampledSettled = 0.1;

double reach_of(const Domain& domain, const PowerSite& site) { return domain.size() + distance(site.position, domain.centroid); }

std::vector<double> volumes_of(std::span<const CellMeasure> cells) {
  std::vector<double> volumes;
  for (const CellMeasure& cell : cells) volumes.push_back(cell.volume);
  return volumes;
}

}  // namespace

SampledNewton::SampledNewton(const Domain& domain, const SampledDiagram& diagram, std::span<const PowerSite> sites,
                             FitTargets targets, const FitState& state, const Options& options)
    : domain_(domain),
      diagram_(diagram),
      options_(options),
      sites_(sites.begin(), sites.end()),
      targets_(std::move(targets)),
      state_(state) {
  if (state_.previous_move.size() != sites_.size()) {
    state_ = {};
    state_.previous_move.assign(sites_.size(), 0);
  }
  recognise();
  start_fresh_sites();
  keep_in_bounds();
}

// Moves of the last call are comparable only while the problem is the same.
void SampledNewton::recognise() {
  Hash hash;
  hash.add(static_cast<std::uint64_t>(options_.metric) + 1);
  hash.add(static_cast<std::uint64_t>(options_.samples));
  for (const Domain::Piece& piece : domain_.pieces) {
    for (const Point3& v : piece.shape.vertices) hash.add(v);
  }
  for (std::size_t i = 0; i < sites_.size(); ++i) {
    const std::uint32_t k = targets_.owner(i);
    hash.add(sites_[i].position);
    hash.add(std::uint64_t{k});
    hash.add(k != FitTargets::kNone ? targets_.least(k) : sites_[i].weight);
    if (k != FitTargets::kNone) hash.add(targets_.most(k));
  }
  if (state_.problem != hash.value()) state_.residual = -1;
  state_.problem = hash.value();
}

// Sites without a weight yet: all alike where no site has one, which is an ordinary Voronoi diagram under every metric.
void SampledNewton::start_fresh_sites() {
  const bool all_fresh = std::none_of(sites_.begin(), sites_.end(), [](const PowerSite& s) { return s.weight > 0; });
  std::vector<double> parts;
  for (std::size_t i = 0; i < sites_.size(); ++i) {
    if (targets_.owner(i) != FitTargets::kNone) parts.push_back(targets_.part(i));
  }
  double common = 0;
  if (all_fresh && !parts.empty()) {
    const PowerSite somewhere{domain_.largest_piece().centroid, 0};
    common = initial_weights(domain_, std::span(&somewhere, 1), parts).front();
  }
  for (std::size_t i = 0; i < sites_.size(); ++i) {
    if (targets_.owner(i) == FitTargets::kNone || sites_[i].weight > 0) continue;
    sites_[i].weight = all_fresh ? common : weight_of_volume(targets_.part(i));
  }
}

// Balls that take the whole domain never cut: all potentials are raised alike, which changes no border.
bool SampledNewton::start_full() {
  for (std::size_t i = 0; i < sites_.size(); ++i) {
    if (targets_.owner(i) != FitTargets::kNone && !targets_.is_fitted(i)) sites_[i].weight = 0;
  }
  if (!targets_.is_full()) return false;
  double sum = 0, factor = 1;
  for (std::size_t i = 0; i < sites_.size(); ++i) {
    if (!targets_.is_fitted(i)) continue;
    const double reach = reach_of(domain_, sites_[i]), radius = std::sqrt(sites_[i].weight);
    sum = std::max(sum, options_.metric == Metric::power ? reach * reach - sites_[i].weight : reach - radius);
    if (radius > 0) factor = std::max(factor, reach / radius);
  }
  for (std::size_t i = 0; i < sites_.size(); ++i) {
    if (!targets_.is_fitted(i)) continue;
    double& weight = sites_[i].weight;
    if (options_.metric == Metric::power) weight += sum;
    if (options_.metric == Metric::additive) weight = (std::sqrt(weight) + sum) * (std::sqrt(weight) + sum);
    if (options_.metric == Metric::multiplicative) weight *= factor * factor;
  }
  return options_.metric == Metric::multiplicative ? factor > 1 : sum > 0;
}

void SampledNewton::keep_in_bounds() {
  for (std::size_t i = 0; i < sites_.size(); ++i) {
    if (targets_.owner(i) == FitTargets::kNone) continue;
    const double reach = kMostSampledReach * reach_of(domain_, sites_[i]);
    sites_[i].weight = std::clamp(sites_[i].weight, 0.0, std::min(kLargestWeight, reach * reach));
  }
}

Result<void> SampledNewton::measure() {
  const SampleOptions options{
      .metric = options_.metric, .samples = options_.samples, .with_storeys = false, .pool = options_.pool};
  auto measured = diagram_.measure(sites_, options);
  if (!measured) return measured.error();
  if (evaluations_ == 0) {
    std::vector<std::uint8_t> is_lost;
    for (const CellMeasure& cell : measured->cells) is_lost.push_back(cell.state == SiteState::coincident);
    targets_.grant(volumes_of(measured->cells), domain_.volume, is_lost);
    if (start_full()) measured = diagram_.measure(sites_, options);
    if (!measured) return measured.error();
  }
  ++evaluations_;
  cells_ = std::move(*measured);
  judge();
  return {};
}

double SampledNewton::resolution(std::size_t target) const {
  double sum = 0;
  for (const std::uint32_t i : targets_.sites(target)) sum += cells_.errors[i];
  return targets_.most(target) > 0 && targets_.aim(target) > 0 ? sum / targets_.aim(target) : 0;
}

void SampledNewton::judge() {
  targets_.measure(volumes_of(cells_.cells));
  error_ = 0;
  worst_ = 0;
  is_met_ = is_settled_ = true;
  for (std::uint32_t k = 0; k < targets_.size(); ++k) {
    const double error = targets_.error(k);
    // What has no volume at all is missed, however little was asked for.
    const bool is_gone = targets_.aim(k) > 0 && !targets_.sites(k).empty() && !(targets_.total(k) > 0);
    if (is_gone || error > std::max(options_.tolerance, resolution(k))) is_met_ = false;
    if (is_gone || error > std::max(options_.tolerance, kSampledSettled * resolution(k))) is_settled_ = false;
    if (!(error > error_)) continue;
    error_ = error;
    worst_ = k;
  }
}

// What the steps aim at, as a share of the demands: where these take the whole domain, all of it as the samples see it, for no
// weights could give them more or less.
double SampledNewton::scale() const {
  if (!targets_.is_full()) return 1;
  double total = 0, aim = 0;
  for (std::size_t k = 0; k < targets_.size(); ++k) {
    if (targets_.sites(k).empty()) continue;
    total += targets_.total(k);
    aim += targets_.aim(k);
  }
  return aim > 0 && total > 0 ? total / aim : 1;
}

std::string SampledNewton::resolution_text() const {
  double worst = options_.tolerance;
  std::uint32_t site = FitTargets::kNone;
  for (std::size_t k = 0; k < targets_.size(); ++k) {
    if (!(resolution(k) > worst)) continue;
    worst = resolution(k);
    site = targets_.sites(k).front();
  }
  if (site == FitTargets::kNone) return "";
  return "sample lines " + fixed(cells_.step, 3) + " m apart know the volume of site " + std::to_string(site) + " to " +
         fixed(100 * worst, 3) + " % only, which is coarser than the tolerance of " + shortest(options_.tolerance) +
         ": take more samples or a larger tolerance";
}

// Damped Newton. The last move is judged by what it led to: taken back by half where it went too far (Kitagawa, Mérigot and
// Thibert 2019: cells must not vanish, the residual has to fall), else followed by the next step.
void SampledNewton::move() {
  const double scale = this->scale();
  double squares = 0, ratio = 1;
  for (std::uint32_t k = 0; k < targets_.size(); ++k) {
    if (targets_.sites(k).empty() || !(targets_.aim(k) > 0)) continue;
    const double error = targets_.total(k) - scale * targets_.aim(k);
    squares += error * error / targets_.aim(k);
    ratio = std::min(ratio, targets_.total(k) / targets_.aim(k));
  }
  const double residual = std::sqrt(squares);
  if (state_.residual >= 0 && state_.share > kLeastStep) {
    const bool falls = residual <= (1 - 0.1 * state_.share) * state_.residual;
    if (!falls || ratio < state_.least_ratio) {
      take_back(0.5 * state_.share);
      return keep_in_bounds();
    }
  }
  // A round of repair first; what is empty even then must not hold up the others.
  if (ratio <= 0 && state_.share != 0) {
    repair();
  } else {
    if (state_.residual < 0) state_.least_ratio = 0.5 * ratio;
    step(residual);
  }
  keep_in_bounds();
}

void SampledNewton::step(double residual) {
  ++iterations_;
  const double scale = this->scale();
  std::vector<double> wanted(targets_.size(), 0);
  std::vector<std::uint32_t> unknown(sites_.size(), FitTargets::kNone);
  for (std::size_t i = 0; i < sites_.size(); ++i) {
    if (moves(i) && cells_.cells[i].volume > 0) unknown[i] = targets_.owner(i);
  }
  for (std::size_t k = 0; k < targets_.size(); ++k) {
    if (!targets_.sites(k).empty() && targets_.is_active(k)) wanted[k] = scale * targets_.aim(k) - targets_.total(k);
  }
  const auto change = solve_potentials(cells_, unknown, wanted, std::min(1e-3, 0.1 * std::max(1e-9, error_)));
  state_.residual = residual;
  state_.share = 1;
  state_.direction.assign(sites_.size(), 0);
  for (std::size_t i = 0; i < sites_.size(); ++i) {
    const double radius = std::sqrt(std::max(0.0, sites_[i].weight));
    // In r³, in which the volume of a ball is linear: d(r³)/dψ = 3 r² dr/dψ.
    if (unknown[i] != FitTargets::kNone) {
      state_.direction[i] = 3 * radius * radius * radius_by_potential(options_.metric, radius) * change[unknown[i]];
    }
    if (targets_.is_fitted(i)) follow(i, cube_of_radius(sites_[i].weight));
  }
}

void SampledNewton::take_back(double share) {
  state_.share = share;
  for (std::size_t i = 0; i < sites_.size(); ++i) {
    if (targets_.is_fitted(i)) follow(i, cube_of_radius(sites_[i].weight) - state_.previous_move[i]);
  }
}

// Goes the current share of the step from a place.
void SampledNewton::follow(std::size_t i, double from) {
  state_.previous_move[i] = 0;
  const double move = i < state_.direction.size() ? state_.direction[i] : 0;
  if (move == 0) {
    if (from != cube_of_radius(sites_[i].weight)) sites_[i].weight = weight_of_cube(from);
    return;
  }
  const double cube = std::clamp(from + state_.share * move, kLeastOfCube * from, kMostOfCube * from);
  sites_[i].weight = std::max(weight_of_cube(cube), kLeastShare * weight_of_volume(targets_.part(i)));
  state_.previous_move[i] = cube_of_radius(sites_[i].weight) - from;
}

// Weight that brings an emptied cell back: with it the site wins at its own position, or at a place inside the domain.
double SampledNewton::repaired_weight(std::size_t i) const {
  const Point3 place = domain_.place_inside(sites_[i].position);
  const double own = distance(place, sites_[i].position);
  // The ball has to reach the place, and some way beyond.
  double radius = own + std::sqrt(0.1 * weight_of_volume(targets_.part(i)));
  for (std::size_t j = 0; j < sites_.size(); ++j) {
    const double other = std::sqrt(std::max(0.0, sites_[j].weight)), d = distance(sites_[j].position, place);
    if (j == i || !(other > 0)) continue;
    if (options_.metric == Metric::power) {
      radius = std::max(radius, std::sqrt(std::max(0.0, sites_[j].weight - kSampledRepair * d * d + own * own)));
    } else if (options_.metric == Metric::additive) {
      radius = std::max(radius, other - kSampledRepair * d + own);
    } else if (d > 0) {
      radius = std::max(radius, other * own / (kSampledRepair * d));
    }
  }
  return std::max(sites_[i].weight, radius * radius);
}

void SampledNewton::repair() {
  state_.residual = -1;
  state_.share = 0;
  std::vector<double> weights(sites_.size());
  for (std::size_t i = 0; i < sites_.size(); ++i) {
    const bool is_empty = targets_.is_fitted(i) && !(cells_.cells[i].volume > 0);
    weights[i] = is_empty ? repaired_weight(i) : sites_[i].weight;
  }
  for (std::size_t i = 0; i < sites_.size(); ++i) sites_[i].weight = weights[i];
}

}  // namespace bl::geometry
