// Rows of the response, and conjugate gradients over a selection of them.
#include "core/geometry/inside/local_response.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace bl::geometry {

namespace {

constexpr int kMostLocalIterations = 1000;
// With no free surface at all the system has the constant vector in its kernel; this share of the diagonal takes it out.
constexpr double kLocalPin = 1e-9;
// Where more than this share of the sites would be active, all are: the rim costs more than it saves.
constexpr double kManyActive = 0.3;

}  // namespace

void LocalResponse::reset(std::size_t count) {
  rows_.clear();
  resize(count);
}

void LocalResponse::resize(std::size_t count) {
  rows_.resize(count);
  is_active_.assign(count, 0);
  vectors_.assign(count);
  shift_.assign(count, 0);
}

void LocalResponse::set_row(std::uint32_t site, std::span<const PowerSite> sites, const CellMeasure& cell,
                            std::vector<std::uint32_t>& lost) {
  Row& row = rows_[site];
  // Bonds that are gone are gone on the other side too.
  const std::size_t first_lost = lost.size();
  for (const Bond& old : row.bonds) {
    lost.push_back(old.other);
    auto& back = rows_[old.other].bonds;
    const auto at = std::find_if(back.begin(), back.end(), [&](const Bond& bond) { return bond.other == site; });
    if (at == back.end()) continue;
    rows_[old.other].bound -= at->value;
    back.erase(at);
  }
  row.bonds.clear();
  row.bound = 0;
  row.lever = sites[site].weight > 0 ? 0.5 / std::sqrt(sites[site].weight) : 0;
  row.free = cell.spherical_area > 0 ? cell.spherical_area / (2 * std::sqrt(sites[site].weight)) : 0;
  for (const FacetArea& facet : cell.facets) {
    if (facet.kind != FacetArea::Kind::site) continue;
    const double lever = 0.5 / distance(sites[site].position, sites[facet.index].position), value = facet.area * lever;
    row.bonds.push_back({facet.index, value, lever});
    row.bound += value;
    rows_[facet.index].bonds.push_back({site, value, lever});
    rows_[facet.index].bound += value;
  }
  const auto is_bound = [&](std::uint32_t other) {
    return std::any_of(row.bonds.begin(), row.bonds.end(), [&](const Bond& bond) { return bond.other == other; });
  };
  lost.erase(std::remove_if(lost.begin() + static_cast<std::ptrdiff_t>(first_lost), lost.end(), is_bound), lost.end());
}

std::span<const std::uint32_t> LocalResponse::active_around(std::span<const double> demand, std::span<const double> volume,
                                                            std::span<const std::uint8_t> absent, double enough, int rings) {
  const auto counts = [&](std::uint32_t i) { return !absent[i] && demand[i] > 0 && volume[i] > 0 && diagonal(i) > 0; };
  const auto many = static_cast<std::size_t>(kManyActive * static_cast<double>(rows_.size()));
  active_.clear();
  for (std::uint32_t i = 0; i < rows_.size(); ++i) {
    if (!counts(i) || !(std::abs(demand[i] - volume[i]) > enough * demand[i])) continue;
    is_active_[i] = 1;
    active_.push_back(i);
  }
  std::size_t begin = 0;
  for (int ring = 0; ring < rings && active_.size() <= many; ++ring) {
    const std::size_t end = active_.size();
    for (; begin < end; ++begin) {
      for (const Bond& bond : rows_[active_[begin]].bonds) {
        if (is_active_[bond.other] || !counts(bond.other)) continue;
        is_active_[bond.other] = 1;
        active_.push_back(bond.other);
      }
    }
  }
  for (const std::uint32_t i : active_) is_active_[i] = 0;
  if (active_.size() > many) {
    active_.clear();
    for (std::uint32_t i = 0; i < rows_.size(); ++i) {
      if (counts(i)) active_.push_back(i);
    }
  }
  std::sort(active_.begin(), active_.end());
  return active_;
}

void LocalResponse::multiply(std::span<const std::uint32_t> active, const std::vector<double>& x,
                             std::vector<double>& result) const {
  for (const std::uint32_t i : active) {
    const Row& row = rows_[i];
    double sum = (row.free + row.bound) * (1 + kLocalPin) * x[i];
    for (const Bond& bond : row.bonds) sum -= bond.value * x[bond.other];
    result[i] = sum;
  }
}

const std::vector<double>& LocalResponse::solve(std::span<const std::uint32_t> active, std::span<const double> demand,
                                                std::span<const double> volume, double enough) {
  // Everything outside of the selection is zero and stays so: the product reads it.
  std::fill(vectors_.direction.begin(), vectors_.direction.end(), 0);
  for (const std::uint32_t i : active) vectors_.residual[i] = demand[i] - volume[i];
  conjugate_gradients(
      active, vectors_, kMostLocalIterations,
      [&](const std::vector<double>& x, std::vector<double>& image) { multiply(active, x, image); },
      [&](std::uint32_t i, double residual) { return residual / diagonal(i); },
      [&](double, double) {
        return std::all_of(active.begin(), active.end(),
                           [&](std::uint32_t i) { return std::abs(vectors_.residual[i]) <= enough * demand[i]; });
      });
  return vectors_.solution;
}

double LocalResponse::largest_sweep(std::span<const std::uint32_t> active, std::span<const double> volume) {
  double most = 0;
  for (const std::uint32_t i : active) is_active_[i] = 1;
  for (const std::uint32_t i : active) {
    double swept = rows_[i].free * std::abs(vectors_.solution[i]);
    for (const Bond& bond : rows_[i].bonds) {
      swept += bond.value * std::abs(vectors_.solution[i] - (is_active_[bond.other] ? vectors_.solution[bond.other] : 0));
    }
    most = std::max(most, swept / volume[i]);
  }
  for (const std::uint32_t i : active) is_active_[i] = 0;
  return most;
}

void LocalResponse::apply(std::span<const std::uint32_t> active, double share, std::vector<double>& volume,
                          std::vector<double>& shift) {
  touched_.assign(active.begin(), active.end());
  for (const std::uint32_t i : active) is_active_[i] = 1;
  for (const std::uint32_t i : active) {
    const double change = share * vectors_.solution[i];
    volume[i] += rows_[i].free * change;
    if (rows_[i].free > 0) shift_[i] = std::max(shift_[i], rows_[i].lever * std::abs(change));
    for (const Bond& bond : rows_[i].bonds) {
      // Between two active sites the border moves by the difference; both rows see to their own side.
      const bool both = is_active_[bond.other] != 0;
      const double difference = change - (both ? share * vectors_.solution[bond.other] : 0);
      volume[i] += bond.value * difference;
      shift_[i] = std::max(shift_[i], bond.lever * std::abs(difference));
      if (both) continue;
      volume[bond.other] -= bond.value * difference;
      shift_[bond.other] = std::max(shift_[bond.other], bond.lever * std::abs(difference));
      touched_.push_back(bond.other);
    }
  }
  for (const std::uint32_t i : active) is_active_[i] = 0;
  for (const std::uint32_t i : touched_) {
    shift[i] += shift_[i];
    shift_[i] = 0;
  }
}

}  // namespace bl::geometry
