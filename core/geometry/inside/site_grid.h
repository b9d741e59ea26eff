// Finds the sites whose bisectors may come near a site, block by block, without a triangulation.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/inside/lane_pair.h"
#include "core/geometry/power_cells.h"

namespace bl::geometry {

/// Sites in cubic blocks of about equal number. In the order of the blocks their data lie side by side in memory.
class SiteGrid {
 public:
  /// One site as the search sees it.
  struct Entry {
    Point3 position;
    double weight;
    std::uint32_t site;
  };

  /// On the average. Measured: fewer make more blocks to look at, more make more sites to look at.
  static constexpr double kSitesPerBlock = 6;

  /// Sorts the participants (indices into `sites`) into blocks.
  void build(std::span<const PowerSite> sites, std::span<const std::uint32_t> participants);

  /// A participant has another weight, or another position, now. Cheap; after many moves to other blocks build() is due.
  void change(std::uint32_t site, const PowerSite& now);

  /// A new participant, whose index may be beyond all others; and one that takes part no longer.
  void insert(std::uint32_t site, const PowerSite& now);
  void erase(std::uint32_t site);

  /// Are the sites spread so unevenly that a triangulation finds neighbours faster?
  bool is_uneven() const { return is_uneven_; }
  /// Have so many sites left their blocks that the grid should be built anew?
  bool is_stale() const { return strays_.size() > 64; }

  /// Participants in the order in which they lie in memory: the order to work through them.
  std::span<const std::uint32_t> order() const { return order_; }
  /// The participants have other weights now, but their old positions.
  void refresh_weights(std::span<const PowerSite> sites);

  /// Place of a participant in that order.
  std::uint32_t place_of(std::uint32_t site) const { return slot_of_[site]; }
  /// The participant of a place in that order, wherever it is now. Places that follow each other lie side by side in memory, as
  /// the sites themselves do not.
  Entry at_place(std::uint32_t place) const { return site_[place] == order_[place] ? entry(place) : stray_of(order_[place]); }
  /// A participant; the same thing as the site, but near in memory to those around it.
  Entry of(std::uint32_t site) const { return slot_of_[site] == kNone ? stray_of(site) : at_place(slot_of_[site]); }
  /// A stretch of that order.
  struct Range {
    std::uint32_t begin = 0, end = 0;
  };

  /// Calls consider(entry) for every other participant whose bisector with a site of this position and weight may lie nearer
  /// than reach() [m], near blocks first, and whose place is not in `skip`. The bisector's distance from the position is (d² +
  /// weight - weight_j) / (2 d).
  template <class Reach, class Consider>
  void search(const Point3& position, double weight, std::uint32_t self, Range skip, Reach&& reach, Consider&& consider) const {
    const auto home = block_of(position);
    for (const Entry& entry : strays_) {
      if (entry.site != self) consider(entry);
    }
    const double lighter = weight - largest_weight_;
    const Vector3 middle{origin_.x + (home[0] + 0.5) * side_, origin_.y + (home[1] + 0.5) * side_,
                         origin_.z + (home[2] + 0.5) * side_};
    const unsigned eighth =
        (position.x > middle.x ? 1u : 0u) + (position.y > middle.y ? 2u : 0u) + (position.z > middle.z ? 4u : 0u);
    // Where all places before the home block are left out, the blocks before it need not even be looked at.
    const bool is_half = skip.begin == 0 && skip.end >= first_[index_of(home)];
    for (const Offset& offset : offsets(eighth, is_half)) {
      // A hair less than the gap: a site on the border of its block may lie beyond it by rounding.
      const double squared_gap = (1 - 1e-9) * offset.squared_gap * side_ * side_;
      if (is_beyond(squared_gap, lighter, reach())) break;
      const std::array<int, 3> block{home[0] + offset.at[0], home[1] + offset.at[1], home[2] + offset.at[2]};
      if (static_cast<unsigned>(block[0]) >= static_cast<unsigned>(count_[0]) ||
          static_cast<unsigned>(block[1]) >= static_cast<unsigned>(count_[1]) ||
          static_cast<unsigned>(block[2]) >= static_cast<unsigned>(count_[2]))
        continue;
      visit_block(position, weight, self, skip, block, squared_gap, reach, consider);
    }
    // The table's own corners are farther than the nearest blocks that it does not hold.
    if (is_beyond((1 - 1e-9) * kFar * kFar * side_ * side_, lighter, reach())) return;
    search_far(position, weight, self, skip, home, reach, consider);
  }

  /// Is there another participant within this distance [m]?
  bool has_site_within(const Point3& position, double distance, std::uint32_t self) const;

  /// Calls consider(entry) for every participant within a distance [m], and for some beyond it.
  template <class Consider>
  void visit_near(const Point3& position, double distance, Consider&& consider) const {
    for (const Entry& entry : strays_) consider(entry);
    const Vector3 room{1.001 * distance, 1.001 * distance, 1.001 * distance};
    const auto low = block_of(position - room), high = block_of(position + room);
    for (int z = low[2]; z <= high[2]; ++z) {
      for (int y = low[1]; y <= high[1]; ++y) {
        const std::uint32_t end = first_[index_of({high[0], y, z}) + 1];
        for (std::uint32_t k = first_[index_of({low[0], y, z})]; k < end; ++k) {
          if (site_[k] != kNone) consider(entry(k));
        }
      }
    }
  }

  /// The participant of least power |p - p_j|² - w_j at a position; of equals the lowest index.
  std::uint32_t least_power(const Point3& position) const;

 private:
  struct Offset {
    std::array<int, 3> at;
    double squared_gap;  ///< least squared distance between an eighth of the home block and the block, in sides²
  };
  static constexpr int kFar = 5;
  static constexpr std::uint32_t kNone = 0xffffffffu;
  /// Blocks around one of the eight corners of the home block, near ones first: all, or those from the home block on.
  static const std::vector<Offset>& offsets(unsigned eighth, bool is_half);

  // Can no bisector of a site at least sqrt(squared_gap) away come nearer than reach? `lighter` is w - max w_j.
  static bool is_beyond(double squared_gap, double lighter, double reach) {
    if (lighter > squared_gap) return lighter >= reach * reach;  // least at d = sqrt(lighter), where it is that much
    const double least = squared_gap + lighter;
    return least > 0 && least * least >= 4 * squared_gap * reach * reach;
  }

  // Distance along an axis from a block that begins so far away.
  double gap(double to_begin) const { return std::max(0.0, std::max(to_begin, -to_begin - side_)); }

  std::array<int, 3> block_of(const Point3& p) const;
  void find_block_weight(std::size_t block);
  std::size_t index_of(const std::array<int, 3>& block) const {
    return (static_cast<std::size_t>(block[2]) * count_[1] + block[1]) * count_[0] + block[0];
  }

  template <class Reach, class Consider>
  void visit_block(const Point3& p, double weight, std::uint32_t self, Range skip, const std::array<int, 3>& block,
                   double squared_gap, Reach&& reach, Consider&& consider) const {
    const std::size_t index = index_of(block);
    const std::uint32_t begin = first_[index], end = first_[index + 1];
    if (begin == end || (begin >= skip.begin && end <= skip.end)) return;
    if (is_beyond(squared_gap, weight - block_weight_[index], reach())) return;
    const std::uint32_t before = std::clamp(skip.begin, begin, end), after = std::clamp(skip.end, before, end);
    visit_entries(p, weight, self, begin, before, reach, consider);
    visit_entries(p, weight, self, after, end, reach, consider);
  }

  // Sifts before it considers: which entries come near is a coin's throw, and no processor likes to bet on that.
  template <class Reach, class Consider>
  void visit_entries(const Point3& p, double weight, std::uint32_t self, std::uint32_t begin, std::uint32_t end, Reach&& reach,
                     Consider&& consider) const {
    for (std::uint32_t from = begin; from < end; from += 64) {
      for (std::uint64_t near = sift(p, weight, from, std::min(end - from, 64u), reach()); near != 0; near &= near - 1) {
        const std::uint32_t k = from + static_cast<std::uint32_t>(std::countr_zero(near));
        if (site_[k] != self) consider(entry(k));
      }
    }
  }

  // A bit for each of up to 64 entries whose bisector may lie nearer than the reach. The weight of none is so small that it
  // never does; also where it lies at the very place, at any reach: 0 times a finite number is 0.
  std::uint64_t sift(const Point3& p, double weight, std::uint32_t from, std::uint32_t count, double reach) const {
    const double *const x = x_.data() + from, *const y = y_.data() + from, *const z = z_.data() + from,
                        *const weights = weight_.data() + from;
    const LanePair at_x = in_both_lanes(p.x), at_y = in_both_lanes(p.y), at_z = in_both_lanes(p.z), own = in_both_lanes(weight),
                   four_reach_squared = in_both_lanes(4 * std::min(reach, 1e150) * std::min(reach, 1e150)),
                   zero = in_both_lanes(0);
    std::uint64_t far = 0;
    for (std::uint32_t k = 0; k < count; k += 2) {
      const LanePair dx = lanes_at(x + k) - at_x, dy = lanes_at(y + k) - at_y, dz = lanes_at(z + k) - at_z,
                     squared = dx * dx + dy * dy + dz * dz, sum = squared + (own - lanes_at(weights + k));
      far |= bits_of(is_larger(sum, zero) & is_no_less(sum * sum, squared * four_reach_squared)) << k;
    }
    return ~far & lowest_bits(count);
  }

  Entry entry(std::uint32_t place) const { return {{x_[place], y_[place], z_[place]}, weight_[place], site_[place]}; }
  void set_entry(std::uint32_t place, const Entry& entry);
  void remove_entry(std::uint32_t place);
  Entry stray_of(std::uint32_t site) const;

  // All blocks that the table of offsets does not hold.
  template <class Reach, class Consider>
  void search_far(const Point3& p, double weight, std::uint32_t self, Range skip, const std::array<int, 3>& home, Reach&& reach,
                  Consider&& consider) const {
    std::array<int, 3> block{};
    for (block[2] = 0; block[2] < count_[2]; ++block[2]) {
      for (block[1] = 0; block[1] < count_[1]; ++block[1]) {
        const bool near_row = std::abs(block[2] - home[2]) <= kFar && std::abs(block[1] - home[1]) <= kFar;
        for (block[0] = 0; block[0] < count_[0]; ++block[0]) {
          if (near_row && std::abs(block[0] - home[0]) <= kFar) continue;
          const Vector3 low{origin_.x + block[0] * side_, origin_.y + block[1] * side_, origin_.z + block[2] * side_};
          const double dx = gap(low.x - p.x), dy = gap(low.y - p.y), dz = gap(low.z - p.z);
          visit_block(p, weight, self, skip, block, (1 - 1e-9) * (dx * dx + dy * dy + dz * dz), reach, consider);
        }
      }
    }
  }

  Vector3 origin_;
  double side_ = 1;  // of a block [m]
  std::array<int, 3> count_{1, 1, 1};
  bool is_uneven_ = false;
  double largest_weight_ = 0;
  std::vector<std::uint32_t> first_;        // block b: entries first_[b] .. first_[b + 1)
  std::vector<double> block_weight_;        // largest weight in a block
  std::vector<double> x_, y_, z_, weight_;  // of the entries, and one more that is none
  std::vector<std::uint32_t> site_;         // kNone: it has moved to another block
  std::vector<std::uint32_t> order_, slot_of_;
  std::vector<Entry> strays_;  // sites that have left their blocks
};

}  // namespace bl::geometry
