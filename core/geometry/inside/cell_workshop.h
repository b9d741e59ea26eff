// Makes and measures any selection of the cells of a site set: what the diagram and the fit share.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "core/geometry/inside/cell_maker.h"
#include "core/geometry/inside/shape_measure.h"
#include "core/geometry/power_cells.h"

namespace bl::geometry {

/// What one thread needs to make and measure cells.
struct CellBench {
  CellMaker maker;
  ShapeMeasure shape;
  std::vector<ShapeMeasure> shapes;
};

/// What is kept of each cell besides its record: null, or one list per site.
struct CellLists {
  std::vector<std::uint32_t>* borders = nullptr;  ///< the sites whose change can change the cell
  std::vector<std::uint32_t>* faces = nullptr;    ///< those of them that share a face with it; only together with `borders`
  std::vector<ShapeMeasure>* shapes = nullptr;    ///< of the parts of its outlines
};

/// Is a position so far outside that a ball around it that reaches the domain cannot be measured in it?
bool is_out_of_reach(const Domain& domain, const Point3& position);
std::vector<std::uint8_t> out_of_reach(const Domain& domain, std::span<const PowerSite> sites);

/// Sites in a domain, ready for their cells to be made. Every cell is a pure function of domain, sites and options: which cells
/// are made, when, and on which thread leaves no trace in them.
class CellWorkshop {
 public:
  void set_domain(const Domain& domain);
  const Domain& domain() const { return ground_.domain; }

  /// All sites anew: finds who coincides with whom and sorts the others into the search structure. `absent` (empty, or one flag
  /// per site) marks places in the list without a site.
  Result<void> set_sites(std::span<const PowerSite> sites, std::span<const std::uint8_t> absent = {});
  /// Other weights, the same positions. Much cheaper.
  Result<void> set_weights(std::span<const PowerSite> sites);
  /// One site anew. False where that is more than a local change (it meets another site, say): then set_sites() is due.
  bool change(std::uint32_t site, const PowerSite& now);
  /// A site at a place that is absent, or at the end of the list; and none at a place any more. False as with change().
  bool insert(std::uint32_t site, const PowerSite& now);
  void erase(std::uint32_t site);

  std::span<const PowerSite> sites() const { return sites_; }
  /// How far from its site a cell is made [m]: infinity for the whole of it, 0 for none.
  double limit_of(double weight, const CellOptions& options) const { return ground_.limit_of(weight, options.with_shape); }
  /// Calls consider(entry) for every site within a distance [m], and for some beyond it; each has site, position and weight.
  template <class Consider>
  void visit_near(const Point3& position, double distance, Consider&& consider) const {
    ground_.grid.visit_near(position, distance, consider);
  }
  /// Per site: the site it coincides with, or 0xffffffff; an absent site is named by itself.
  std::span<const std::uint32_t> twins() const { return twin_; }
  bool has_twins() const { return has_twins_; }
  /// Sites in the order in which they lie in memory: nearby cells are made one after the other.
  std::span<const std::uint32_t> order() const { return ground_.grid.order(); }

  /// Makes the cells of `which`, each into its place of `cells` and of the lists.
  void make(std::span<const std::uint32_t> which, const CellOptions& options, std::span<CellMeasure> cells,
            const CellLists& lists = {});
  /// Adds what cells were made without, storeys and meshes, to their records, from their outlines and `shapes`.
  void complete(std::span<const std::uint32_t> which, const CellOptions& options, std::span<CellMeasure> cells,
                std::vector<ShapeMeasure>* shapes);
  /// Makes all cells, which takes less than making each of them.
  void make_all(const CellOptions& options, std::span<CellMeasure> cells, const CellLists& lists = {});

 private:
  void make_range(std::span<const std::uint32_t> which, bool is_run, std::size_t begin, std::size_t end,
                  const CellOptions& options, std::span<CellMeasure> cells, const CellLists& lists);
  std::size_t runs_per_thread(std::size_t threads, const CellOptions& options) const;
  void make_place(std::uint32_t site);
  bool has_room_for(std::uint32_t site, const Point3& position) const;
  void make_one(std::uint32_t site, const CellOptions& options, std::span<const std::uint32_t> expected, CellBench& bench,
                CellMeasure& out) const;
  void measure_one(std::uint32_t site, std::span<const Polyhedron> parts, const CellOptions& options, CellBench& bench,
                   CellMeasure& out) const;
  void complete_one(std::uint32_t site, std::span<const Polyhedron> parts, const CellOptions& options,
                    std::span<ShapeMeasure> shapes, CellMeasure& out) const;
  template <class Body>
  void share_out(std::size_t count, ThreadPool* pool, const Body& body);
  std::unique_ptr<CellBench> take_bench();
  void give_back(std::unique_ptr<CellBench> bench);

  CellInput ground_;
  std::vector<PowerSite> sites_;
  std::vector<std::uint32_t> twin_, participants_;
  std::vector<std::uint8_t> absent_;
  bool has_twins_ = false;
  std::vector<std::unique_ptr<CellBench>> benches_;
  std::mutex mutex_;
};

/// Fails on what cannot be computed with: numbers that are not finite or absurd.
Result<void> check_site(std::size_t number, const PowerSite& site);
Result<void> check_sites(std::span<const PowerSite> sites);

}  // namespace bl::geometry
