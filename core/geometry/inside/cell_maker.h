// One power cell after the other, as polyhedra: which planes to cut with, in which order, and where to stop.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/domain.h"
#include "core/geometry/inside/clipper.h"
#include "core/geometry/inside/site_grid.h"
#include "core/geometry/power_neighbours.h"

namespace bl::geometry {

/// What all threads read while cells are made.
struct CellInput {
  Domain domain;
  std::vector<Clipper::Start> pieces;  ///< of the domain, ready to be clipped
  std::span<const PowerSite> sites;
  SiteGrid grid;
  bool is_triangulated = false;  ///< candidates come from `neighbours` instead of the grid
  PowerNeighbours neighbours;

  void set_domain(const Domain& given);
  /// How far from its site a cell is made [m]: infinity for the whole of it, 0 for none.
  double limit_of(double weight, bool whole) const;
  /// Spreads the participants over the grid; where they lie too unevenly for one, triangulates them.
  Result<void> set_sites(std::span<const PowerSite> all, std::span<const std::uint32_t> participants);
};

/// The working memory of one thread. A cell depends on the ground and the site alone, never on the cells made before.
class CellMaker {
 public:
  /// From here on cells will be made in the order of the grid, from a place on: who borders whom is then remembered, and sites
  /// whose cells are done are not searched for again. It saves time and changes no cell.
  void start_run(const CellInput& ground, std::uint32_t first_place, std::uint32_t count);
  void end_run() {
    run_ = {};
    known_.clear();
  }

  /// `whole`: the whole power cell inside the domain; otherwise only what may lie in the site's ball. `expected`: participants
  /// that may border the cell, each once, such as those that did before a change. They are cut with first, so that the search
  /// ends early; outside of a run only.
  void make(const CellInput& ground, std::uint32_t site, bool whole, std::span<const std::uint32_t> expected = {});

  /// Relative to the site; one for each piece of the domain that the cell reaches into.
  std::span<const Polyhedron> parts() const { return std::span(parts_).first(part_count_); }
  /// All sites whose bisectors bound the cell (or nearly so), in ascending order: a change of another site cannot change it.
  std::span<const std::uint32_t> borders() const { return borders_; }
  /// Those of them that share a face with the cell, in ascending order.
  std::span<const std::uint32_t> faces() const { return faces_; }

 private:
  struct Candidate {
    double offset;
    std::uint32_t site;
    Vector3 normal;
  };
  void remember(const CellInput& ground, std::uint32_t site, bool is_sure);
  void begin(const CellInput& ground, std::uint32_t site);
  void cut_by_search(const CellInput& ground, std::uint32_t site, std::span<const std::uint32_t> expected);
  void cut_in_order(const CellInput& ground, std::uint32_t site);
  void gather(const CellInput& ground, std::uint32_t site, double reach);
  bool keep_parts(const CellInput& ground, const Point3& origin);
  double reach() const;
  bool finish(Clipper& shape, Polyhedron& out);
  Polyhedron& next_part();

  Clipper cell_, piece_;
  Polyhedron outline_;
  double limit_ = 0;                    // nothing beyond this distance matters [m]
  std::vector<std::uint32_t> is_done_;  // per site: the number of the cell that was last cut by it before the search
  std::uint32_t cell_number_ = 0;
  std::vector<Candidate> candidates_;
  std::vector<std::uint32_t> borders_, faces_;
  std::vector<Polyhedron> parts_;
  std::size_t part_count_ = 0;

  // The run: places [begin, end) are done; per place of the run, a list of done sites that border it.
  SiteGrid::Range run_;
  struct Link {
    std::uint32_t place, next;
    bool is_sure;  ///< the border has an extent beyond all rounding
  };
  std::vector<std::uint32_t> known_;
  std::vector<Link> links_;
  std::uint32_t free_link_ = 0;  // the first of those that nobody needs any more
};

}  // namespace bl::geometry
