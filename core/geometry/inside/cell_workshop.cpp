// From a polyhedron and a ball to a record of the cell; and the bookkeeping of sites behind it.
#include "core/geometry/inside/cell_workshop.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "core/base/mathematics.h"
#include "core/base/stop_check.h"
#include "core/base/text.h"
#include "core/geometry/cell_mesh.h"
#include "core/geometry/inside/cell_recipe.h"
#include "core/geometry/inside/coincidence.h"
#include "core/geometry/inside/none.h"
#include "core/geometry/inside/plan_cover.h"

namespace bl::geometry {

namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();
// Facets below this share of the shape's squared reach are slivers of rounding: they carry no name.
constexpr double kSliverShare = 1e-14;
constexpr std::size_t kSitesAtATime = 16;
// Runs a few times as many as threads even out the load. Whole cells, which tell the next ones of a run who borders them, lose
// that at the ends of a run: theirs are at least so many blocks thick, about.
constexpr std::size_t kRunsPerThread = 4;
constexpr double kThickness = 4;

void add_facet(FaceKind kind, std::uint32_t index, double area, std::vector<FacetArea>& facets) {
  // Faces come in the order of kind and index, so only parts of other pieces have to look back.
  const FacetArea facet{kind, index, area};
  const auto is_before = [](const FacetArea& a, const FacetArea& b) {
    return a.kind != b.kind ? a.kind < b.kind : a.index < b.index;
  };
  if (facets.empty() || is_before(facets.back(), facet)) return facets.push_back(facet);
  const auto at = std::lower_bound(facets.begin(), facets.end(), facet, is_before);
  if (at != facets.end() && at->kind == kind && at->index == index) {
    at->area += area;
  } else {
    facets.insert(at, facet);
  }
}

void gather_facets(const Polyhedron& part, double squared_radius, const ShapeMeasure& shape, CellMeasure& out) {
  const double sliver = kSliverShare * std::min(part.reach_squared, squared_radius);
  if (out.facets.empty()) out.facets.reserve(part.faces.size());
  for (std::size_t k = 0; k < part.faces.size(); ++k) {
    const PolyhedronFace& face = part.faces[k];
    const bool is_surface = face.kind == FaceKind::plane || face.kind == FaceKind::site;
    if (is_surface && shape.areas[k] > sliver) add_facet(face.kind, face.index, shape.areas[k], out.facets);
  }
}

// What follows from facets and spherical area.
void add_up(const CellInput& ground, const PowerSite& site, CellMeasure& out) {
  out.surface_area = out.spherical_area;
  out.volume_by_own_weight = out.spherical_area > 0 ? out.spherical_area / (2 * std::sqrt(site.weight)) : 0;
  for (const FacetArea& facet : out.facets) {
    out.surface_area += facet.area;
    if (facet.kind != FacetArea::Kind::site) continue;
    out.volume_by_own_weight += facet.area / (2 * distance(site.position, ground.grid.of(facet.index).position));
  }
}

// Height, floor area and footprint of all parts together.
void measure_storeys(std::span<const Polyhedron> parts, std::span<ShapeMeasure> shapes, const PowerSite& site, double storey,
                     CellMeasure& out) {
  double lowest = kNoLimit, highest = -kNoLimit;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (shapes[k].is_empty) continue;
    measure_extent(parts[k], site.weight, shapes[k]);
    lowest = std::min(lowest, shapes[k].lowest);
    highest = std::max(highest, shapes[k].highest);
  }
  out.height = highest - lowest;
  out.bottom = site.position.z + lowest;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (shapes[k].is_empty) continue;
    shapes[k].lowest = lowest;
    shapes[k].highest = highest;
    out.floor_area += floor_area(parts[k], site.weight, storey, shapes[k]);
  }
  out.footprint = plan_cover(parts, shapes, site.weight);
}

std::shared_ptr<const std::vector<Polyhedron>> polyhedra_of(std::span<const Polyhedron> parts) {
  return std::make_shared<const std::vector<Polyhedron>>(parts.begin(), parts.end());
}

// Of all parts together, relative to the site.
Point3 centroid_of(std::span<const ShapeMeasure> shapes, double volume) {
  if (shapes.size() == 1) return shapes[0].centroid;
  Vector3 moment;
  for (const ShapeMeasure& shape : shapes)
    if (!shape.is_empty && shape.volume > 0) moment += shape.volume * shape.centroid;
  return moment / volume;
}

void measure_parts(const CellInput& ground, std::uint32_t index, std::span<const Polyhedron> parts, const CellOptions& options,
                   std::span<ShapeMeasure> shapes, CellMeasure& out) {
  const PowerSite& site = ground.sites[index];
  for (std::size_t k = 0; k < parts.size(); ++k) {
    ShapeMeasure& shape = shapes[k];
    const WholeMeasure whole = options.with_shape ? measure_whole(parts[k]) : WholeMeasure{};
    if (options.with_shape) out.cell_volume += whole.volume;
    shape.is_empty = true;
    if (!(site.weight > 0)) continue;
    measure_shape(parts[k], site.weight, whole, options.with_centroid, shape);
    if (shape.is_empty || !(shape.volume > 0)) continue;
    // A sliver seen from a far-away site may have a centroid of pure rounding; a point of its facets is then the better answer.
    if (options.with_centroid && !holds(parts[k], site.weight, shape.centroid, 0)) shape.centroid = shape.point_inside;
    out.volume += shape.volume;
    out.spherical_area += shape.spherical_area;
    gather_facets(parts[k], site.weight, shape, out);
  }
  if (!(out.volume > 0)) return;
  if (options.with_centroid) out.centroid = site.position + centroid_of(shapes, out.volume);
  add_up(ground, site, out);
}

// Farther from the domain than so many times its size, the ball that reaches it is so large that rounding moves it by a share of
// the domain that shows.
constexpr double kFarthest = 3000;

// Cells between two looks at whether anybody still wants them: some tenths of a millisecond.
constexpr std::size_t kCellsPerLook = 32;

template <class Record>
void fetch_ahead(const Record& record) {
  constexpr std::size_t kLine = 64;
  const char* const begin = reinterpret_cast<const char*>(&record);
  for (std::size_t at = 0; at < sizeof(Record); at += kLine) __builtin_prefetch(begin + at);
}

std::string number(std::uint32_t site) { return "site " + std::to_string(site); }

}  // namespace

bool is_out_of_reach(const Domain& domain, const Point3& position) {
  return distance(position, domain.centroid) > kFarthest * domain.size();
}

std::vector<std::uint8_t> out_of_reach(const Domain& domain, std::span<const PowerSite> sites) {
  std::vector<std::uint8_t> flags(sites.size());
  // Whoever is that near along each axis needs no look at the distance itself.
  const double near = 0.5 * kFarthest * domain.size();
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const Vector3 way = sites[i].position - domain.centroid;
    if (std::abs(way.x) < near && std::abs(way.y) < near && std::abs(way.z) < near) continue;
    flags[i] = is_out_of_reach(domain, sites[i].position);
  }
  return flags;
}

void CellWorkshop::set_domain(const Domain& domain) {
  ground_.set_domain(domain);
  sites_.clear();
}

Result<void> CellWorkshop::set_sites(std::span<const PowerSite> sites, std::span<const std::uint8_t> absent) {
  sites_.assign(sites.begin(), sites.end());
  absent_.assign(absent.begin(), absent.end());
  find_coincident(sites_, kCoincidenceShare * ground_.domain.size(), twin_);
  participants_.clear();
  has_twins_ = false;
  for (std::uint32_t i = 0; i < sites_.size(); ++i) {
    if (!absent_.empty() && absent_[i]) {
      twin_[i] = i;
    } else if (twin_[i] == kNone) {
      participants_.push_back(i);
    } else {
      has_twins_ = true;
    }
  }
  return ground_.set_sites(sites_, participants_);
}

Result<void> CellWorkshop::set_weights(std::span<const PowerSite> sites) {
  // Of two sites at one place the heavier lives, so with twins other weights may mean other participants.
  if (has_twins_ || ground_.is_triangulated || sites.size() != sites_.size()) {
    const std::vector<std::uint8_t> absent = absent_;
    return set_sites(sites, absent);
  }
  sites_.assign(sites.begin(), sites.end());
  ground_.sites = sites_;
  ground_.grid.refresh_weights(sites_);
  return {};
}

bool CellWorkshop::has_room_for(std::uint32_t site, const Point3& position) const {
  if (has_twins_ || ground_.is_triangulated || ground_.grid.is_stale()) return false;
  return !ground_.grid.has_site_within(position, kCoincidenceShare * ground_.domain.size(), site);
}

bool CellWorkshop::change(std::uint32_t site, const PowerSite& now) {
  if (now.position == sites_[site].position ? ground_.is_triangulated || has_twins_ : !has_room_for(site, now.position))
    return false;
  sites_[site] = now;
  ground_.grid.change(site, now);
  return true;
}

// Lengthens the list up to a place; what is new in it is absent.
void CellWorkshop::make_place(std::uint32_t site) {
  absent_.resize(sites_.size(), 0);
  for (auto k = static_cast<std::uint32_t>(sites_.size()); k <= site; ++k) {
    sites_.emplace_back();
    twin_.push_back(k);
    absent_.push_back(1);
  }
  ground_.sites = sites_;
}

bool CellWorkshop::insert(std::uint32_t site, const PowerSite& now) {
  if (!has_room_for(site, now.position)) return false;
  make_place(site);
  sites_[site] = now;
  twin_[site] = kNone;
  absent_[site] = 0;
  ground_.grid.insert(site, now);
  return true;
}

void CellWorkshop::erase(std::uint32_t site) {
  make_place(site);
  absent_[site] = 1;
  twin_[site] = site;
  ground_.grid.erase(site);
}

void CellWorkshop::make_one(std::uint32_t site, const CellOptions& options, std::span<const std::uint32_t> expected,
                            CellBench& bench, CellMeasure& out) const {
  out.outlines.reset();
  if (twin_[site] != kNone) return measure_one(site, {}, options, bench, out);
  bench.maker.make(ground_, site, options.with_shape, expected);
  if (options.with_outlines && options.with_shape) out.outlines = polyhedra_of(bench.maker.parts());
  measure_one(site, bench.maker.parts(), options, bench, out);
}

// Of the record that was there only the outlines count, and the room that its lists take.
void CellWorkshop::measure_one(std::uint32_t site, std::span<const Polyhedron> parts, const CellOptions& options,
                               CellBench& bench, CellMeasure& out) const {
  std::vector<FacetArea> facets = std::move(out.facets);
  facets.clear();
  auto outlines = std::move(out.outlines);
  out = CellMeasure{};
  out.facets = std::move(facets);
  out.outlines = std::move(outlines);
  out.centroid = sites_[site].position;
  out.bottom = sites_[site].position.z;
  const std::uint32_t twin = twin_[site];
  if (twin == kNone) {
    bench.shapes.resize(parts.size());
    measure_parts(ground_, site, parts, options, bench.shapes, out);
    complete_one(site, parts, options, bench.shapes, out);
  }
  std::string emptiness;
  if (twin == kNone && !(out.volume > 0)) {
    const bool has_cell = out.cell_volume > 0 || (!options.with_shape && !parts.empty());
    const std::uint32_t winner = has_cell ? kNone : ground_.grid.least_power(sites_[site].position);
    out.state = has_cell ? SiteState::starved : SiteState::hidden;
    emptiness = winner != kNone && winner != site ? "swallowed: " + number(winner) + " outweighs it at its position"
                : !has_cell                       ? std::string("its power cell lies outside the domain")
                : !(sites_[site].weight > 0)      ? std::string("its weight is not positive, so it has no ball")
                                             : std::string("its ball does not reach its own power cell: neighbours are heavier");
    out.reason = emptiness;
  }
  if (twin != kNone) {
    out.state = SiteState::coincident;
    out.reason = "lies at the position of " + number(twin) + ", which is heavier or comes first";
  } else if (!ground_.domain.contains(sites_[site].position, 1e-12 * ground_.domain.size())) {
    out.state = SiteState::outside;
    if (!emptiness.empty() && is_out_of_reach(ground_.domain, sites_[site].position)) {
      emptiness = "it is more than " + shortest(kFarthest) + " times the size of the domain away";
    }
    out.reason = "lies outside the domain" + (emptiness.empty() ? std::string("; its cell reaches in") : "; " + emptiness);
  }
}

void CellWorkshop::complete_one(std::uint32_t site, std::span<const Polyhedron> parts, const CellOptions& options,
                                std::span<ShapeMeasure> shapes, CellMeasure& out) const {
  const PowerSite& own = sites_[site];
  out.floor_area = out.footprint = out.height = 0;
  out.bottom = own.position.z;
  out.mesh = {};
  if (!(out.volume > 0)) return;
  if (options.with_shape && options.with_storeys) {
    const double storey = options.storey_heights.empty() ? options.storey_height : options.storey_heights[site];
    measure_storeys(parts, shapes, own, storey, out);
  }
  if (options.tessellation_depth < 0) return;
  // Most meshes are never looked at.
  auto kept = out.outlines ? out.outlines : polyhedra_of(parts);
  out.mesh = MeshPointer(std::make_unique<CellRecipe>(std::move(kept), shapes, own, centroid_of(shapes, out.volume), options));
}

std::unique_ptr<CellBench> CellWorkshop::take_bench() {
  const std::lock_guard lock(mutex_);
  if (benches_.empty()) return std::make_unique<CellBench>();
  auto bench = std::move(benches_.back());
  benches_.pop_back();
  return bench;
}

void CellWorkshop::give_back(std::unique_ptr<CellBench> bench) {
  const std::lock_guard lock(mutex_);
  benches_.push_back(std::move(bench));
}

void CellWorkshop::make_range(std::span<const std::uint32_t> which, bool is_run, std::size_t begin, std::size_t end,
                              const CellOptions& options, std::span<CellMeasure> cells, const CellLists& lists) {
  auto bench = take_bench();
  // Who bordered a cell before is likely to do so again. Of sites at one place only one has a cell that can be cut by.
  const bool is_expected = !is_run && lists.faces != nullptr && !has_twins_ && !ground_.is_triangulated;
  if (is_run) bench->maker.start_run(ground_, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end - begin));
  for (std::size_t k = begin; k < end; ++k) {
    if (k % kCellsPerLook == 0 && is_stop_wished()) break;
    // Records lie in the order of the sites, not in that of the work: the next one is fetched while this one is made.
    if (k + 1 < end) {
      fetch_ahead(cells[which[k + 1]]);
      fetch_ahead(sites_[which[k + 1]]);
    }
    make_one(which[k], options, is_expected ? lists.faces[which[k]] : std::span<const std::uint32_t>{}, *bench, cells[which[k]]);
    const bool is_made = twin_[which[k]] == kNone;
    const auto keep = [&](std::vector<std::uint32_t>* list, std::span<const std::uint32_t> found) {
      if (list != nullptr) list[which[k]].assign(found.begin(), is_made ? found.end() : found.begin());
    };
    keep(lists.borders, bench->maker.borders());
    keep(lists.faces, bench->maker.faces());
    if (lists.shapes != nullptr && is_made) lists.shapes[which[k]].swap(bench->shapes);
  }
  bench->maker.end_run();
  give_back(std::move(bench));
}

void CellWorkshop::make(std::span<const std::uint32_t> which, const CellOptions& options, std::span<CellMeasure> cells,
                        const CellLists& lists) {
  share_out(which.size(), options.pool,
            [&](std::size_t begin, std::size_t end) { make_range(which, false, begin, end, options, cells, lists); });
}

void CellWorkshop::complete(std::span<const std::uint32_t> which, const CellOptions& options, std::span<CellMeasure> cells,
                            std::vector<ShapeMeasure>* shapes) {
  share_out(which.size(), options.pool, [&](std::size_t begin, std::size_t end) {
    for (const std::uint32_t site : which.subspan(begin, end - begin))
      if (cells[site].outlines) complete_one(site, *cells[site].outlines, options, shapes[site], cells[site]);
  });
}

template <class Body>
void CellWorkshop::share_out(std::size_t count, ThreadPool* pool, const Body& body) {
  if (pool != nullptr && count > kSitesAtATime) {
    pool->for_each_chunk(count, kSitesAtATime, body);
  } else if (count > 0) {
    body(0, count);
  }
}

std::size_t CellWorkshop::runs_per_thread(std::size_t threads, const CellOptions& options) const {
  const auto whole = std::count_if(sites_.begin(), sites_.end(),
                                   [&](const PowerSite& site) { return limit_of(site.weight, options) == kNoLimit; });
  if (2 * static_cast<std::size_t>(whole) < sites_.size()) return kRunsPerThread;
  const double layers = mathematics::cube_root(static_cast<double>(sites_.size()) / SiteGrid::kSitesPerBlock);
  const double most = layers / (kThickness * static_cast<double>(threads));
  return std::clamp<std::size_t>(static_cast<std::size_t>(most), 1, kRunsPerThread);
}

void CellWorkshop::make_all(const CellOptions& options, std::span<CellMeasure> cells, const CellLists& lists) {
  const auto order = ground_.grid.order();
  const auto body = [&](std::size_t begin, std::size_t end) { make_range(order, true, begin, end, options, cells, lists); };
  const std::size_t threads = options.pool != nullptr ? static_cast<std::size_t>(options.pool->threads()) : 1;
  const std::size_t runs = threads > 1 && order.size() > 2 * kSitesAtATime ? threads * runs_per_thread(threads, options) : 1;
  if (runs > 1) {
    options.pool->for_each_chunk(order.size(), (order.size() + runs - 1) / runs, body);
  } else {
    body(0, order.size());
  }
  std::vector<std::uint32_t> others;
  for (std::uint32_t i = 0; has_twins_ && i < sites_.size(); ++i) {
    if (twin_[i] != kNone) others.push_back(i);
  }
  make(others, options, cells, lists);
}

Result<void> check_site(std::size_t number, const PowerSite& site) {
  if (!is_finite(site.position) || !std::isfinite(site.weight)) {
    return Error{ErrorCode::not_finite, "", "site " + std::to_string(number) + " has a position or weight that is not a number"};
  }
  const Point3& p = site.position;
  if (std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > kLargestCoordinate) {
    return Error{ErrorCode::out_of_range, "", "site " + std::to_string(number) + " lies more than 1e8 m from the origin"};
  }
  if (std::abs(site.weight) > kLargestWeight) {
    return Error{ErrorCode::out_of_range, "", "the weight of site " + std::to_string(number) + " exceeds 1e18 m²"};
  }
  return {};
}

Result<void> check_sites(std::span<const PowerSite> sites) {
  for (std::size_t i = 0; i < sites.size(); ++i)
    if (auto checked = check_site(i, sites[i]); !checked) return checked;
  return {};
}

}  // namespace bl::geometry
