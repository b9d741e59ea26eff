// From sums along lines to records of cells.
#include "core/geometry/inside/sampled_diagram.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <string>

#include "core/base/text.h"
#include "core/geometry/inside/cell_workshop.h"
#include "core/geometry/inside/coincidence.h"
#include "core/geometry/inside/line_sums.h"
#include "core/geometry/inside/none.h"
#include "core/geometry/inside/sample_lines.h"

namespace bl::geometry {

namespace {

// Declared errors: see the header.
constexpr double kErrorShare = 0.4, kErrorOfSpread = 0.75;

std::string site_number(std::size_t site) { return "site " + std::to_string(site); }

Result<void> check_samples(int samples) {
  if (samples < 1) return Error{ErrorCode::out_of_range, "", "sampling takes at least one sample along the longest side"};
  if (samples > kMostSamples) {
    return Error{ErrorCode::out_of_range, "",
                 std::to_string(samples) +
                     " samples along the longest side do not fit into memory: " + std::to_string(kMostSamples) + " are the most"};
  }
  return {};
}

Result<void> check_input(const Domain& domain, std::span<const PowerSite> sites, const SampleOptions& options) {
  if (auto checked = check_sites(sites); !checked) return checked.error();
  for (std::size_t i = 0; i < sites.size() && options.metric != Metric::power; ++i) {
    if (sites[i].weight < 0) {
      return Error{ErrorCode::out_of_range, "",
                   "the weight of " + site_number(i) + " is negative: under the " + std::string(name_of(options.metric)) +
                       " metric a weight is the square of a radius"};
    }
  }
  if (!options.with_storeys) return {};
  if (!options.storey_heights.empty() && options.storey_heights.size() != sites.size()) {
    return Error{ErrorCode::out_of_range, "", "there has to be one storey height for each site"};
  }
  const auto is_fit = [&](double storey) {
    return storey > 0 && std::isfinite(storey) && (domain.maximum.z - domain.minimum.z) / storey <= kMostStoreys;
  };
  const bool all_fit = options.storey_heights.empty()
                           ? is_fit(options.storey_height)
                           : std::all_of(options.storey_heights.begin(), options.storey_heights.end(), is_fit);
  if (all_fit) return {};
  return Error{ErrorCode::out_of_range, "", "a storey height has to be positive, and the boundary no higher than 10000 storeys"};
}

double closeness_to(Metric metric, const PowerSite& site, const Point3& place) {
  const double squared = squared_norm(place - site.position), radius = std::sqrt(std::max(0.0, site.weight));
  switch (metric) {
    case Metric::power: return closeness<Metric::power>(squared, site.weight, radius);
    case Metric::additive: return closeness<Metric::additive>(squared, site.weight, radius);
    case Metric::multiplicative: break;
  }
  return closeness<Metric::multiplicative>(squared, site.weight, radius);
}

}  // namespace

std::string_view name_of(Metric metric) {
  switch (metric) {
    case Metric::power: return "power";
    case Metric::additive: return "additive";
    case Metric::multiplicative: return "multiplicative";
  }
  return "unknown";
}

struct SampledDiagram::Ground {
  int samples = 0;  // 0: no lines yet
  Domain domain;
  SampleFrame frame;
  std::array<SampleLines, 3> lines;

  // What one measure() works with.
  struct Work {
    std::vector<std::uint32_t> twin, participants;
    std::vector<FrameSite> sites;
  };

  Work prepare(std::span<const PowerSite> sites, Metric metric, const SampleFrame& in) const {
    Work work;
    find_coincident(sites, kCoincidenceShare * domain.size(), work.twin);
    for (std::uint32_t i = 0; i < sites.size(); ++i) {
      const Vector3 f = in.to_frame(sites[i].position);
      work.sites.push_back({{f.x, f.y, f.z}, sites[i].weight, std::sqrt(std::max(0.0, sites[i].weight))});
      // Without a radius every distance is infinite where it is multiplied.
      const bool owns_nothing = metric == Metric::multiplicative && !(sites[i].weight > 0);
      if (work.twin[i] == kNone && !owns_nothing) work.participants.push_back(i);
    }
    return work;
  }

  void write_volumes(const DiagramSums& sums, std::span<const PowerSite> sites, SampledCells& out) const {
    const double column = frame.step * frame.step;
    for (std::size_t i = 0; i < sites.size(); ++i) {
      CellMeasure& cell = out.cells[i];
      const LineSums& s = sums.sites[i];
      cell.centroid = sites[i].position;
      cell.bottom = sites[i].position.z;
      cell.cell_volume = column * (s.cell[0] + s.cell[1] + s.cell[2]) / 3;
      const double length = s.shape[0] + s.shape[1] + s.shape[2];
      cell.volume = column * length / 3;
      cell.spherical_area = cell.surface_area = column * s.sphere;
      if (length > 0) cell.centroid = frame.to_world(s.moment / length);
    }
  }

  void write_facets(const DiagramSums& sums, SampledCells& out) const {
    const double column = frame.step * frame.step;
    const auto give = [&](std::uint32_t site, FaceKind kind, std::uint32_t index, double area) {
      out.cells[site].surface_area += area;
      out.cells[site].facets.push_back({kind, index, area});
    };
    for (const LineFacetSum& facet : sums.facets) {
      if (!(facet.area > 0)) continue;
      give(facet.site, facet.kind, facet.index, column * facet.area);
      if (facet.kind != FaceKind::site) continue;
      give(facet.index, facet.kind, facet.site, column * facet.area);
      out.bonds.push_back({facet.site, facet.index, column * facet.response});
    }
    for (CellMeasure& cell : out.cells) {
      std::sort(cell.facets.begin(), cell.facets.end(),
                [](const FacetArea& a, const FacetArea& b) { return a.kind != b.kind ? a.kind < b.kind : a.index < b.index; });
    }
  }

  // Responses to the site's own weight, and the declared error.
  void write_responses(const DiagramSums& sums, std::span<const PowerSite> sites, Metric metric, const Work& work,
                       SampledCells& out) const {
    std::vector<double> own(sites.size(), 0);
    for (const SampledBond& bond : out.bonds) {
      own[bond.a] += bond.response;
      own[bond.b] += bond.response;
    }
    for (std::size_t i = 0; i < sites.size(); ++i) {
      out.free_responses.push_back(0);
      out.errors.push_back(0);
      const double radius = work.sites[i].radius;
      if (!(radius > 0) || work.twin[i] != kNone) continue;
      // On the ball |∇c| is dψ/dr.
      const double by_potential = radius_by_potential(metric, radius);
      out.free_responses[i] = out.cells[i].spherical_area * by_potential;
      out.cells[i].volume_by_own_weight = (own[i] + out.free_responses[i]) / (2 * radius * by_potential);
      const double h = frame.step;
      const auto [least, most] = std::minmax({sums.sites[i].shape[0], sums.sites[i].shape[1], sums.sites[i].shape[2]});
      out.errors[i] = h * h * (kErrorShare * std::sqrt(out.cells[i].surface_area + 6 * h * h) + kErrorOfSpread * (most - least));
    }
  }

  void write_storeys(std::span<const PowerSite> sites, const SampleOptions& options, SampledCells& out) const {
    const SampleFrame upright = upright_frame(domain, frame.step);
    SampleLines upward;
    upward.build(domain, upright, 2, options.pool);
    const Work work = prepare(sites, options.metric, upright);
    std::vector<double> storeys(options.storey_heights.begin(), options.storey_heights.end());
    storeys.resize(sites.size(), options.storey_height);
    const auto sums = sum_upright(options.metric, upright, upward, work.sites, work.participants, storeys, options.pool);
    const double column = upright.step * upright.step;
    for (std::size_t i = 0; i < sites.size(); ++i) {
      if (sums[i].footprint == 0) continue;
      CellMeasure& cell = out.cells[i];
      cell.height = sums[i].highest - sums[i].lowest;
      cell.bottom = upright.origin.z + sums[i].lowest;
      cell.footprint = column * static_cast<double>(sums[i].footprint);
      const double rest = cell.height / storeys[i] - std::floor(cell.height / storeys[i]);
      cell.floor_area = column * (static_cast<double>(sums[i].sections) + rest * static_cast<double>(sums[i].rest));
    }
  }

  std::uint32_t closest(std::span<const PowerSite> sites, const Work& work, Metric metric, const Point3& place) const {
    std::uint32_t best = kNone;
    double least = 0;
    for (const std::uint32_t j : work.participants) {
      const double value = closeness_to(metric, sites[j], place);
      if (best == kNone || value < least) best = j, least = value;
    }
    return best;
  }

  // Why a site has no volume; also decides between hidden and starved.
  std::string emptiness(std::span<const PowerSite> sites, std::uint32_t i, Metric metric, const Work& work, bool is_inside,
                        CellMeasure& cell) const {
    const bool has_weight = sites[i].weight > 0;
    const std::uint32_t winner = closest(sites, work, metric, sites[i].position);
    cell.state = cell.cell_volume > 0 ? SiteState::starved : SiteState::hidden;
    if (winner == i && is_inside && has_weight) {
      cell.state = SiteState::starved;
      return "its shape slips between the sample lines, which are " + fixed(frame.step, 3) + " m apart: take more samples";
    }
    if (!has_weight && (cell.cell_volume > 0 || metric == Metric::multiplicative))
      return "its weight is not positive, so it has no ball";
    if (cell.cell_volume > 0) return "its ball does not reach its own cell: neighbours are heavier";
    if (winner != i && winner != kNone) return "swallowed: " + site_number(winner) + " outweighs it at its position";
    return "its cell lies outside the domain";
  }

  void write_states(std::span<const PowerSite> sites, Metric metric, const Work& work, SampledCells& out) const {
    for (std::uint32_t i = 0; i < sites.size(); ++i) {
      CellMeasure& cell = out.cells[i];
      if (work.twin[i] != kNone) {
        cell.state = SiteState::coincident;
        cell.reason = "lies at the position of " + site_number(work.twin[i]) + ", which is heavier or comes first";
        continue;
      }
      const bool is_inside = domain.contains(sites[i].position, 1e-12 * domain.size());
      if (!(cell.volume > 0)) cell.reason = emptiness(sites, i, metric, work, is_inside, cell);
      if (is_inside) continue;
      cell.state = SiteState::outside;
      cell.reason = "lies outside the domain; " + (cell.reason.empty() ? std::string("its cell reaches in") : cell.reason);
    }
  }

  SampledCells measure(std::span<const PowerSite> sites, const SampleOptions& options) const {
    const Work work = prepare(sites, options.metric, frame);
    SampledCells out;
    out.cells.resize(sites.size());
    out.step = frame.step;
    for (const SampleLines& one : lines) {
      out.domain_volume += frame.step * frame.step * one.length() / 3;
      out.lines += one.count();
    }
    const DiagramSums sums = sum_lines(options.metric, frame, lines, work.sites, work.participants, options.pool);
    write_volumes(sums, sites, out);
    write_facets(sums, out);
    write_responses(sums, sites, options.metric, work, out);
    if (options.with_storeys) write_storeys(sites, options, out);
    write_states(sites, options.metric, work, out);
    return out;
  }
};

SampledDiagram::SampledDiagram() : ground_(std::make_unique<Ground>()) {}
SampledDiagram::~SampledDiagram() = default;
SampledDiagram::SampledDiagram(SampledDiagram&&) noexcept = default;
SampledDiagram& SampledDiagram::operator=(SampledDiagram&&) noexcept = default;

Result<void> SampledDiagram::set_domain(const Domain& domain, int samples, ThreadPool* pool) try {
  if (domain.pieces.empty()) {
    return Error{ErrorCode::geometry, "", "the domain is empty: make it with convex_hull, from_planes, extrude or from_mesh"};
  }
  if (auto checked = check_samples(samples); !checked) return checked.error();
  if (ground_->samples == samples && ground_->domain == domain) return {};
  ground_->samples = 0;
  ground_->domain = domain;
  const Vector3 extent = domain.maximum - domain.minimum;
  ground_->frame = tilted_frame(domain, std::max({extent.x, extent.y, extent.z}) / samples);
  for (std::size_t k = 0; k < 3; ++k) ground_->lines[k].build(domain, ground_->frame, k, pool);
  ground_->samples = samples;
  return {};
} catch (const std::exception& problem) {
  return Error{ErrorCode::internal, "", std::string("the sample lines failed: ") + problem.what()};
}

Result<SampledCells> SampledDiagram::measure(std::span<const PowerSite> sites, const SampleOptions& options) const try {
  if (ground_->samples == 0) return Error{ErrorCode::missing, "", "the sampled diagram has no domain yet"};
  if (auto checked = check_input(ground_->domain, sites, options); !checked) return checked.error();
  return ground_->measure(sites, options);
} catch (const std::exception& problem) {
  return Error{ErrorCode::internal, "", std::string("the sampled cells failed: ") + problem.what()};
}

Result<SampledCells> sampled_cells(const Domain& domain, std::span<const PowerSite> sites, const SampleOptions& options) {
  SampledDiagram diagram;
  if (auto set = diagram.set_domain(domain, options.samples, options.pool); !set) return set.error();
  return diagram.measure(sites, options);
}

}  // namespace bl::geometry
