// `cells`: the raw geometry of given sites and weights, for scripts and for checks against other programs.
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/base/stop.h"
#include "core/define/json_text.h"
#include "core/file/file_io.h"
#include "core/geometry/power_cells.h"
#include "ui/cli/commands.h"
#include "ui/cli/complex_json.h"
#include "ui/cli/interrupt.h"
#include "ui/cli/json_fields.h"
#include "ui/cli/site_case.h"
#include "ui/cli/terminal.h"

namespace bl::cli {

namespace {

Json cell_json(const geometry::CellMeasure& cell) {
  Json facets = Json::object();
  for (const geometry::FacetArea& facet : cell.facets)
    facets[(facet.kind == geometry::FacetArea::Kind::plane ? "plane:" : "site:") + std::to_string(facet.index)] = facet.area;
  return {{"volume", cell.volume},
          {"cell_volume", cell.cell_volume},
          {"surface_area", cell.surface_area},
          {"spherical_area", cell.spherical_area},
          {"facet_areas", std::move(facets)},
          {"centroid", {cell.centroid.x, cell.centroid.y, cell.centroid.z}},
          {"state", std::string(name_of(cell.state))},
          {"reason", cell.reason}};
}

// Boundary sides that nobody numbered by hand: the plane of each.
Json side_planes(const geometry::Domain& domain) {
  Json planes = Json::array();
  for (std::uint32_t side = 0; side < domain.side_count; ++side) planes.push_back(nullptr);
  for (const geometry::Domain::Piece& piece : domain.pieces)
    for (std::size_t k = 0; k < piece.sides.size(); ++k) {
      const geometry::Plane& plane = piece.shape.planes[k];
      if (piece.sides[k] != geometry::Domain::kInner)
        planes[piece.sides[k]] = {plane.normal.x, plane.normal.y, plane.normal.z, plane.offset};
    }
  return planes;
}

Result<Json> solved(const SiteCase& input, bool with_complex, ThreadPool& pool) {
  const geometry::Domain& domain = input.boundary.domain;
  geometry::CellOptions options;
  options.storey_height = domain.maximum.z - domain.minimum.z;  // floor areas are not written: one storey
  options.pool = &pool;
  options.with_outlines = with_complex;
  geometry::PowerDiagram diagram;
  if (auto set = diagram.set_domain(domain); !set) return set.error().within(input.place);
  const auto cells = diagram.update(input.problem.sites, options);
  if (!cells) return cells.error().within(input.place);
  Json result = Json::object();
  result["cells"] = Json::array();
  for (const geometry::CellMeasure& cell : *cells) result["cells"].push_back(cell_json(cell));
  if (!input.boundary.has_given_planes) result["planes"] = side_planes(domain);
  if (with_complex) {
    auto complex = complex_json(diagram, input.problem.sites);
    if (!complex) return complex.error().within(input.place);
    result["complex"] = std::move(*complex);
  }
  return result;
}

// All cases up to an interrupt, or all of what is wrong with them.
std::optional<Json> all_cases(const SiteCases& input, const CellsOptions& options, ThreadPool& pool) {
  bool is_all_well = true;
  Progress progress;
  Json results = Json::array();
  const StopScope scope(is_interrupted);
  for (std::size_t i = 0; i < input.cases.size() && !is_interrupted(); ++i) {
    auto result = solved(input.cases[i], options.with_complex, pool);
    if (is_interrupted()) break;  // in the middle of it: what came of it are no cells
    if (!result) {
      progress.clear();
      print_error(options.input, result.error());
    }
    is_all_well &= result.ok();
    if (result) results.push_back(std::move(*result));
    progress.show("case " + std::to_string(i + 1) + " of " + std::to_string(input.cases.size()));
  }
  if (!is_all_well) return std::nullopt;
  return input.is_list ? Json{{"cases", std::move(results)}} : results.empty() ? Json::object() : std::move(results.front());
}

}  // namespace

int cells_command(const CellsOptions& options) {
  const auto input = load_site_cases({options.input, options.boundary, options.json}, CasePurpose::cells);
  if (!input) return kBadInput;
  catch_interrupts();
  ThreadPool pool(options.threads);
  const auto output = all_cases(*input, options, pool);
  if (!output) return kBadInput;
  if (is_interrupted() && !input->is_list) {
    print_line("stopped before the cells were computed; nothing is written", Colour::red);
    return interrupt_exit_code();
  }
  if (auto written = write_file(options.json, write_json(*output) + "\n"); !written) {
    print_error(options.json, written.error());
    return kBadInput;
  }
  return is_interrupted() ? interrupt_exit_code() : kDone;
}

}  // namespace bl::cli
