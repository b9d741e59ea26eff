// Who stands on what, kept from call to call: what a change cannot have touched is not measured again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/geometry/inside/plan_buckets.h"
#include "core/geometry/standing.h"

namespace bl::geometry {

/// The stances are those that `stances_of` finds, bit for bit, whatever has been asked before.
class StanceFinder {
 public:
  /// `made`: the sites whose cells may differ from those of the last call. It names all sites where the domain is another one; it
  /// does not count where their number is another one.
  void update(const Domain& domain, std::span<const PowerSite> sites, std::span<const CellMeasure> cells,
              std::span<const Standing> rules, std::span<const std::uint32_t> made);

  /// In the order of the sites.
  const std::vector<Stance>& stances() const { return stances_; }
  /// Ascending: the sites whose stance the last update has changed; all where the number of sites was another one.
  std::span<const std::uint32_t> differing() const { return differing_; }
  /// How many stances the last update has measured.
  std::size_t measured() const { return measured_; }

 private:
  struct Neighbour {
    std::uint32_t site;
    bool is_below;  // level enough to carry
    bool operator==(const Neighbour&) const = default;
  };

  // What the stances need to know of a site's cell.
  struct Body {
    double volume = 0, bottom = 0;
    double ground = 0;  // the height under the site [m]
    bool touches_underside = false, is_on_ground = false;
    bool looks_around = false;          // its stance depends on all balls in reach, not only on its neighbours
    std::vector<Neighbour> neighbours;  // in the order of the facets
    bool is_there() const { return volume > 0; }
  };

  void start(std::size_t count);
  void take_domain(const Domain& domain);
  void take_rules(std::span<const Standing> rules);
  void find_changed(std::span<const PowerSite> sites);
  void mark_who_look_around(std::span<const PowerSite> sites, std::span<const CellMeasure> cells);
  void mark_near(const Point3& centre, double radius);
  void take_sites(std::span<const PowerSite> sites);
  void take_cells(std::span<const CellMeasure> cells);
  void take_neighbours(std::uint32_t i, const CellMeasure& cell);
  void name_neighbours(std::uint32_t i);
  void judge_neighbours(std::uint32_t i);
  void find_ground(std::uint32_t i);
  void find_carried();
  std::vector<std::uint32_t> let_go();
  void raise(std::vector<std::uint32_t>& changed);
  std::int32_t round_after(std::uint32_t lower, std::uint32_t upper) const;
  std::int32_t round_of(std::uint32_t i) const;
  std::int32_t holder_of(std::uint32_t i) const;
  void measure_marked();
  Stance measure(std::size_t i);
  void look_around(std::size_t i, Stance& stance);
  bool is_beyond_stop(const Point3& lower, double radius, std::size_t upper, double drop) const;
  double gap_above(std::size_t lower, std::size_t upper, double otherwise) const;
  bool is_carried_by(std::size_t lower, std::size_t upper) const;
  bool is_below(std::size_t lower, std::size_t upper) const;
  double radius_of(std::size_t i) const;
  const PlanBuckets& buckets();

  Domain domain_;
  std::vector<bool> is_underside_;  // per side of the domain
  std::vector<PowerSite> sites_;
  std::vector<Standing> rules_;
  std::vector<Body> bodies_;
  std::vector<std::vector<std::uint32_t>> namers_;  // per site: those who have it among their neighbours, in no order
  // Who carries a site: a site, Stance::kGround, kNothing, or two of whom none is below.
  std::vector<std::int32_t> holders_;
  std::vector<std::int32_t> rounds_;  // per site: in which round it comes to stand, see the source
  std::vector<Stance> stances_;
  std::optional<PlanBuckets> buckets_;  // as soon as one looks around
  std::size_t looking_around_ = 0;      // how many do

  // Of the last update.
  std::vector<std::uint32_t> made_, changed_;  // cells; sites with another position or weight
  std::vector<std::uint8_t> marks_;            // per site, see the source
  std::vector<std::uint32_t> differing_;
  std::vector<Neighbour> found_;
  std::vector<std::uint32_t> loose_;  // who may be carried otherwise than before
  bool is_domain_new_ = true;
  std::size_t measured_ = 0;
};

}  // namespace bl::geometry
