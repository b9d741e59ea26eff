// Blocks of sites, and what is asked of them outside the inner loop.
#include "core/geometry/inside/site_grid.h"

#include <algorithm>
#include <limits>

namespace bl::geometry {

namespace {

// More than so many times the even number of pairs that share a block, and a triangulation is faster.
constexpr double kUnevenness = 40;

}  // namespace

const std::vector<SiteGrid::Offset>& SiteGrid::offsets(unsigned eighth, bool is_half) {
  const auto make = [](unsigned upper, bool is_from_home) {
    std::vector<Offset> made;
    // Along one axis: from the lower or upper half of the home block to a block so many steps away.
    const auto gap = [](bool is_upper, int steps) {
      if (steps == 0) return 0.0;
      return steps > 0 ? steps - 1 + (is_upper ? 0.0 : 0.5) : -steps - 1 + (is_upper ? 0.5 : 0.0);
    };
    for (int z = -kFar; z <= kFar; ++z) {
      for (int y = -kFar; y <= kFar; ++y) {
        for (int x = -kFar; x <= kFar; ++x) {
          const bool is_before = z != 0 ? z < 0 : y != 0 ? y < 0 : x < 0;
          if (is_from_home && is_before) continue;
          const double dx = gap((upper & 1u) != 0, x), dy = gap((upper & 2u) != 0, y), dz = gap((upper & 4u) != 0, z);
          made.push_back({{x, y, z}, dx * dx + dy * dy + dz * dz});
        }
      }
    }
    // Of blocks with the same gap the one with the nearer centre first.
    std::sort(made.begin(), made.end(), [](const Offset& a, const Offset& b) {
      const auto centre = [](const Offset& o) { return o.at[0] * o.at[0] + o.at[1] * o.at[1] + o.at[2] * o.at[2]; };
      if (a.squared_gap != b.squared_gap) return a.squared_gap < b.squared_gap;
      return centre(a) != centre(b) ? centre(a) < centre(b) : a.at < b.at;
    });
    return made;
  };
  static const std::array<std::vector<Offset>, 16> tables = [&] {
    std::array<std::vector<Offset>, 16> made;
    for (unsigned k = 0; k < 16; ++k) made[k] = make(k % 8, k >= 8);
    return made;
  }();
  return tables[eighth + (is_half ? 8 : 0)];
}

std::array<int, 3> SiteGrid::block_of(const Point3& p) const {
  const auto steps = [&](double from, double to, int count) {
    return static_cast<int>(std::clamp((to - from) / side_, 0.0, static_cast<double>(count - 1)));
  };
  return {steps(origin_.x, p.x, count_[0]), steps(origin_.y, p.y, count_[1]), steps(origin_.z, p.z, count_[2])};
}

void SiteGrid::build(std::span<const PowerSite> sites, std::span<const std::uint32_t> participants) {
  strays_.clear();
  slot_of_.assign(sites.size(), kNone);
  order_.resize(participants.size());
  for (std::vector<double>* numbers : {&x_, &y_, &z_, &weight_}) numbers->resize(participants.size() + 1);
  site_.resize(participants.size() + 1);
  remove_entry(static_cast<std::uint32_t>(participants.size()));
  is_uneven_ = false;
  largest_weight_ = -std::numeric_limits<double>::infinity();
  Vector3 low, high;
  for (std::size_t k = 0; k < participants.size(); ++k) {
    const PowerSite& site = sites[participants[k]];
    const Point3& p = site.position;
    if (k == 0) low = high = p;
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    largest_weight_ = std::max(largest_weight_, site.weight);
  }
  origin_ = low;
  const Vector3 extent = high - low;
  const double longest = std::max({extent.x, extent.y, extent.z}),
               wanted = std::max(1.0, static_cast<double>(participants.size()) / kSitesPerBlock);
  const auto steps = [&](double length) { return std::max(1.0, std::ceil(length / side_ * (1 + 1e-12))); };
  // The side that makes about as many blocks as wanted, whatever the shape of the box.
  side_ = longest > 0 ? longest : 1;
  for (int k = 0; k < 200 && steps(extent.x) * steps(extent.y) * steps(extent.z) < wanted && longest > 0; ++k) side_ *= 0.95;
  count_ = {static_cast<int>(steps(extent.x)), static_cast<int>(steps(extent.y)), static_cast<int>(steps(extent.z))};
  const std::size_t blocks = static_cast<std::size_t>(count_[0]) * count_[1] * count_[2];
  first_.assign(blocks + 1, 0);
  block_weight_.assign(blocks, -std::numeric_limits<double>::infinity());
  std::vector<std::uint32_t> block(participants.size());
  for (std::size_t k = 0; k < participants.size(); ++k) {
    block[k] = static_cast<std::uint32_t>(index_of(block_of(sites[participants[k]].position)));
    ++first_[block[k] + 1];
  }
  double pairs = 0;
  for (std::size_t b = 0; b < blocks; ++b) {
    pairs += static_cast<double>(first_[b + 1]) * first_[b + 1];
    first_[b + 1] += first_[b];
  }
  is_uneven_ = participants.size() > 100 && pairs > kUnevenness * kSitesPerBlock * static_cast<double>(participants.size());
  std::vector<std::uint32_t> at(first_.begin(), first_.end() - 1);
  for (std::size_t k = 0; k < participants.size(); ++k) {
    const std::uint32_t site = participants[k], slot = at[block[k]]++;
    set_entry(slot, {sites[site].position, sites[site].weight, site});
    slot_of_[site] = slot;
    order_[slot] = site;
    block_weight_[block[k]] = std::max(block_weight_[block[k]], sites[site].weight);
  }
}

void SiteGrid::set_entry(std::uint32_t place, const Entry& entry) {
  x_[place] = entry.position.x;
  y_[place] = entry.position.y;
  z_[place] = entry.position.z;
  weight_[place] = entry.weight;
  site_[place] = entry.site;
}

// The position stays: it tells the block.
void SiteGrid::remove_entry(std::uint32_t place) {
  weight_[place] = -std::numeric_limits<double>::infinity();
  site_[place] = kNone;
}

SiteGrid::Entry SiteGrid::stray_of(std::uint32_t site) const {
  return *std::find_if(strays_.begin(), strays_.end(), [&](const Entry& stray) { return stray.site == site; });
}

void SiteGrid::refresh_weights(std::span<const PowerSite> sites) {
  constexpr double kLightest = -std::numeric_limits<double>::infinity();
  largest_weight_ = kLightest;
  for (Entry& stray : strays_) {
    stray.weight = sites[stray.site].weight;
    largest_weight_ = std::max(largest_weight_, stray.weight);
  }
  for (std::size_t b = 0; b < block_weight_.size(); ++b) {
    block_weight_[b] = kLightest;
    for (std::uint32_t k = first_[b]; k < first_[b + 1]; ++k) {
      if (site_[k] == kNone) continue;
      weight_[k] = sites[site_[k]].weight;
      block_weight_[b] = std::max(block_weight_[b], weight_[k]);
    }
    largest_weight_ = std::max(largest_weight_, block_weight_[b]);
  }
}

void SiteGrid::change(std::uint32_t site, const PowerSite& now) {
  largest_weight_ = std::max(largest_weight_, now.weight);
  for (Entry& stray : strays_) {
    if (stray.site == site) {
      stray = {now.position, now.weight, site};
      return;
    }
  }
  const std::uint32_t slot = slot_of_[site];
  const std::size_t block = index_of(block_of(entry(slot).position));
  // What lies outside of all blocks belongs to none: the search reckons with the borders of a block.
  const Vector3 high = origin_ + side_ * Vector3{double(count_[0]), double(count_[1]), double(count_[2])};
  const Point3& p = now.position;
  const bool is_in_box =
      p.x >= origin_.x && p.y >= origin_.y && p.z >= origin_.z && p.x <= high.x && p.y <= high.y && p.z <= high.z;
  if (!is_in_box || index_of(block_of(p)) != block) {
    remove_entry(slot);
    strays_.push_back({now.position, now.weight, site});
    return;
  }
  set_entry(slot, {now.position, now.weight, site});
  find_block_weight(block);
}

void SiteGrid::find_block_weight(std::size_t block) {
  block_weight_[block] = -std::numeric_limits<double>::infinity();
  for (std::uint32_t k = first_[block]; k < first_[block + 1]; ++k) {
    block_weight_[block] = std::max(block_weight_[block], weight_[k]);
  }
}

void SiteGrid::insert(std::uint32_t site, const PowerSite& now) {
  if (slot_of_.size() <= site) slot_of_.resize(std::size_t{site} + 1, kNone);
  slot_of_[site] = kNone;
  largest_weight_ = std::max(largest_weight_, now.weight);
  strays_.push_back({now.position, now.weight, site});
}

void SiteGrid::erase(std::uint32_t site) {
  std::erase_if(strays_, [&](const Entry& stray) { return stray.site == site; });
  const std::uint32_t slot = site < slot_of_.size() ? slot_of_[site] : kNone;
  if (slot == kNone || site_[slot] != site) return;
  remove_entry(slot);
  find_block_weight(index_of(block_of(entry(slot).position)));
}

bool SiteGrid::has_site_within(const Point3& p, double limit, std::uint32_t self) const {
  bool is_found = false;
  visit_near(p, limit,
             [&](const Entry& entry) { is_found = is_found || (entry.site != self && distance(entry.position, p) <= limit); });
  return is_found;
}

std::uint32_t SiteGrid::least_power(const Point3& p) const {
  double best = std::numeric_limits<double>::infinity();
  std::uint32_t found = kNone;
  const auto consider = [&](const Entry& entry) {
    const double power = squared_norm(entry.position - p) - entry.weight;
    if (power < best || (power == best && entry.site < found)) {
      best = power;
      found = entry.site;
    }
  };
  for (const Entry& stray : strays_) consider(stray);
  std::array<int, 3> block{};
  for (block[2] = 0; block[2] < count_[2]; ++block[2]) {
    for (block[1] = 0; block[1] < count_[1]; ++block[1]) {
      for (block[0] = 0; block[0] < count_[0]; ++block[0]) {
        const std::size_t index = index_of(block);
        const Vector3 low{origin_.x + block[0] * side_, origin_.y + block[1] * side_, origin_.z + block[2] * side_};
        const double dx = gap(low.x - p.x), dy = gap(low.y - p.y), dz = gap(low.z - p.z);
        if ((1 - 1e-9) * (dx * dx + dy * dy + dz * dz) - block_weight_[index] > best) continue;
        for (std::uint32_t k = first_[index]; k < first_[index + 1]; ++k) {
          if (site_[k] != kNone) consider(entry(k));
        }
      }
    }
  }
  return found;
}

}  // namespace bl::geometry
