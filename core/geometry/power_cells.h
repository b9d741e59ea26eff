// The bounded, shrink-wrapped power diagram: each site's cell, measured in closed form.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/mesh.h"
#include "core/base/parallel.h"
#include "core/base/result.h"
#include "core/geometry/domain.h"
#include "core/geometry/inside/polyhedron.h"

namespace bl::geometry {

/// A site of the power diagram: power distance |x - position|² - weight, shrink-wrap radius sqrt(weight).
struct PowerSite {
  Point3 position;    ///< [m]
  double weight = 0;  ///< [m²]; not positive: no ball, hence an empty shape, but the site still bounds the other cells
  bool operator==(const PowerSite&) const = default;
};

/// Largest absolute weight [m²] that is accepted: a radius of a million kilometres.
inline constexpr double kLargestWeight = 1e18;
/// Sites nearer than this share of the domain's size are one position (nearly parallel bisectors lose all digits).
inline constexpr double kCoincidenceShare = 1e-6;
/// Storeys a domain may have from bottom to top, a guard against storey heights in the wrong unit.
inline constexpr double kMostStoreys = 10000;

/// The state of a site. The first that applies, in this order: coincident, outside, hidden, starved, alive.
enum class SiteState : std::uint8_t {
  alive,       ///< inside the domain, with a volume
  hidden,      ///< has no power cell inside the domain: heavier neighbours cover it, or its cell lies outside the boundary
  outside,     ///< position outside the domain; its cell may reach in, and is measured all the same
  coincident,  ///< same position as another alive site (the heavier, or the lower index on equal weight)
  starved,     ///< has a power cell but no volume: weight not positive, or its ball does not reach its own cell
};

/// Stable lower-case name of a state, as shown to people and in files.
std::string_view name_of(SiteState state);

/// Area [m²] of one flat facet of the shape (inside the ball).
struct FacetArea {
  using Kind = FaceKind;
  Kind kind = Kind::plane;  ///< a boundary side, or another site
  std::uint32_t index = 0;  ///< of the boundary side, or of the site on the other side
  double area = 0;          ///< [m²], positive
  bool operator==(const FacetArea&) const = default;
};

/// All measures of one site's shape: power cell ∩ domain ∩ ball, a convex body.
struct CellMeasure {
  SiteState state = SiteState::alive;
  std::string reason;  ///< a sentence for people; empty where the site is alive

  double volume = 0;                ///< of the shape [m³]
  double cell_volume = 0;           ///< of power cell ∩ domain, without the ball [m³]; these tile the domain
  double surface_area = 0;          ///< of the shape: all flat facets and the spherical part [m²]
  double spherical_area = 0;        ///< the part of the surface on the ball [m²]
  double floor_area = 0;            ///< sum of the horizontal sections at mid-storey heights [m²]; 0 where not asked for
  double footprint = 0;             ///< exact area of the plan projection [m²]; 0 where not asked for
  double height = 0;                ///< exact vertical extent [m]; 0 where not asked for
  double bottom = 0;                ///< lowest z [m]; the site's own z where the shape is empty
  double volume_by_own_weight = 0;  ///< dV_i/dw_i [m]: sum over shared facets of A/(2 d), plus spherical area/(2 radius)
  Point3 centroid;                  ///< of the shape [m]; the site's own position where the shape is empty
  std::vector<FacetArea> facets;    ///< sorted by (kind, index), only those with an area
  /// The power cell inside the domain, not shrunk, relative to the site: one polyhedron per piece of the domain that it reaches
  /// into. Null where not asked for.
  std::shared_ptr<const std::vector<Polyhedron>> outlines;
  MeshPointer mesh;  ///< tessellated and shrink-wrapped by who looks; null where not requested or where the shape is empty
};

struct CellOptions {
  double storey_height = 3;                     ///< [m], for the floor area
  std::span<const double> storey_heights = {};  ///< [m], per site; overrides `storey_height` where not empty
  bool with_shape = true;                       ///< off: volumes, areas and centroid of the shape only; cell_volume, floor area,
                                                ///< footprint, height and bottom stay 0, and hidden sites count as starved
  bool with_storeys = true;                     ///< off: floor area, footprint, height and bottom stay 0
  bool with_centroid = true;                    ///< off: centroids are the sites' positions
  bool with_outlines = false;                   ///< keep the polyhedra of the cells; together with `with_shape` only
  bool with_coarse_mesh = false;                ///< the mesh, where it is asked for, brings the coarse one along
  int tessellation_depth = -1;                  ///< -1: no mesh; 0 to 4: each face's triangles are split in four so many times
  ThreadPool* pool = nullptr;                   ///< null: on the calling thread. The result does not depend on it
};

/// The cells of all sites, in the order of the sites. Every site gets a record. Fails on non-finite or absurd input only.
Result<std::vector<CellMeasure>> power_cells(const Domain& domain, std::span<const PowerSite> sites,
                                             const CellOptions& options = {});

/// The same with memory kept between calls, for a solver that evaluates the same sites many times. Results depend on the
/// arguments alone, never on earlier calls. Where few sites have changed, cells that cannot have changed are kept; they equal new
/// ones bit for bit.
class PowerDiagram {
 public:
  PowerDiagram();
  ~PowerDiagram();
  PowerDiagram(PowerDiagram&&) noexcept;
  PowerDiagram& operator=(PowerDiagram&&) noexcept;

  Result<void> set_domain(const Domain& domain);
  const Domain& domain() const;
  /// Valid until the next call. An error leaves the last measures as they were.
  Result<std::span<const CellMeasure>> update(std::span<const PowerSite> sites, const CellOptions& options = {});
  /// The storeys and meshes that the last updates have left out, of the same sites: for cells that were made anew since the last
  /// call, or of which it asks for something else. To be asked after an update with outlines and centroids. Like this a fit makes
  /// cells many times, and who looks at the result has these measured once. Cells that an update without them keeps, keep them
  /// too.
  Result<std::span<const CellMeasure>> complete(const CellOptions& options);
  /// The measures of the last update.
  std::span<const CellMeasure> cells() const;
  /// Their volumes alone, which take less to be read than the records.
  std::span<const double> volumes() const;
  /// Does any site lie where another one does?
  bool has_coincident() const;
  /// The sites whose cells the last update has computed anew; the other cells cannot have changed.
  std::span<const std::uint32_t> made() const;
  /// The sites whose cells the last complete() has completed; the other cells have not changed since the one before.
  std::span<const std::uint32_t> completed() const;

 private:
  struct Workshop;
  std::unique_ptr<Workshop> workshop_;
};

/// The sums of the records, as a check that nothing is missing.
struct CellTotals {
  std::size_t alive = 0, hidden = 0, outside = 0, coincident = 0, starved = 0;
  double volume = 0;       ///< [m³]
  double cell_volume = 0;  ///< [m³]; the domain's volume up to rounding, as soon as one site has a cell
  double floor_area = 0;   ///< [m²]
};
CellTotals totals_of(std::span<const CellMeasure> cells);

}  // namespace bl::geometry
