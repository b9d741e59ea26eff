// Writes the files of a report: the page, tables and shapes.
#include "core/report/report.h"

#include <filesystem>
#include <system_error>

#include "core/csv/csv_table.h"
#include "core/export/wavefront_obj.h"
#include "core/file/file_io.h"
#include "core/graph/sums_of_now.h"
#include "core/reading/views/facade.h"
#include "core/report/figure_tables.h"
#include "core/report/page.h"

namespace bl::report {

namespace {

using reading::ReportModel;
using reading::VolumeRow;

const std::vector<std::string> kVolumeHeader = {
    "number",
    "id",
    "name",
    "use",
    "x [m]",
    "y [m]",
    "z [m]",
    "storey_height [m]",
    "asked [m3]",
    "limited_to [m3]",
    "volume [m3]",
    "short_of_volume [m3]",
    "short_of_volume [%]",
    "asked_floor_area [m2]",
    "floor_area [m2]",
    "short_of_floor_area [m2]",
    "short_of_floor_area [%]",
    "cell_volume [m3]",
    "error",
    "surface_area [m2]",
    "footprint [m2]",
    "bottom [m]",
    "height [m]",
    "weight [m2]",
    "state",
    "reason",
    "why_short",
    "facade_style",
    "facade_area [m2]",
    "glazed_area [m2]",
    "opaque_area [m2]",
    "facade_cost [EUR]",
};

std::string csv_of(const reading::ReportModel& model, const State& state) {
  std::vector<std::vector<csv::CsvCell>> rows;
  for (const reading::VolumeRow& v : model.volumes) {
    rows.push_back({v.number,
                    v.id,
                    v.name,
                    v.use,
                    v.place.x,
                    v.place.y,
                    v.place.z,
                    v.figures.storey_height,
                    v.asked,
                    v.limited,
                    v.volume,
                    v.missing(),
                    v.missing_share() * 100,
                    v.asked_area,
                    v.floor_area,
                    v.missing_area(),
                    v.missing_area_share() * 100,
                    v.figures.cell_volume,
                    v.figures.error,
                    v.figures.surface_area,
                    v.figures.footprint,
                    v.figures.bottom,
                    v.figures.height,
                    v.figures.weight,
                    v.figures.state,
                    v.figures.reason,
                    reading::why_short(state, model.accounts, v)});
    const auto facade = reading::row_of<reading::FacadeFigures>(state, v.node);
    if (!facade) continue;
    rows.back().emplace_back(facade->style_in_force);
    for (const double figure : {facade->facade_area, facade->glazed_area, facade->opaque_area, facade->cost})
      rows.back().emplace_back(figure);
  }
  return write_csv(kVolumeHeader, rows);
}

std::string uses_csv_of(const reading::ReportModel& model, const State& state) {
  const std::vector<std::string> header = {"use",
                                           "in_programme",
                                           "volumes",
                                           "short_volumes",
                                           "asked_floor_area [m2]",
                                           "limited_to_floor_area [m2]",
                                           "floor_area [m2]",
                                           "asked [m3]",
                                           "limited_to [m3]",
                                           "volume [m3]",
                                           "short_of_volume [m3]",
                                           "short_of_volume [%]",
                                           "short_of_floor_area [m2]",
                                           "short_of_floor_area [%]",
                                           "why_short"};
  std::vector<std::vector<csv::CsvCell>> rows;
  for (const reading::UseAccount& use : model.accounts.uses)
    rows.push_back({use.use, use.is_in_programme ? "yes" : "no", use.volumes, use.short_volumes, use.asked_area, use.limited_area,
                    use.floor_area, use.asked, use.limited, use.volume, use.missing(), use.missing_share() * 100,
                    use.missing_area(), use.missing_area_share() * 100, reading::why_short(state, model.accounts, use)});
  return write_csv(header, rows);
}

report::CsvFile open_csv_of(const reading::ReportModel& model) {
  const std::vector<std::string> header = {"use",
                                           "in_programme",
                                           "asked_area [m2]",
                                           "open_area [m2]",
                                           "drawn_area [m2]",
                                           "short_of_area [m2]",
                                           "short_of_area [%]",
                                           "why_short"};
  std::vector<std::vector<csv::CsvCell>> rows;
  for (const reading::OpenAccount& open : model.accounts.open)
    rows.push_back({open.use, open.is_in_programme ? "yes" : "no", open.asked, open.area, open.drawn, open.missing(),
                    open.missing_share() * 100, reading::why_short(open, model.accounts.tolerance)});
  return {"open_space.csv", write_csv(header, rows), !rows.empty()};
}

// One row for each conflict and each who pulls in it; who is empty where people have set or locked the value.
std::string conflicts_csv_of(const reading::ReportModel& model, const State& state) {
  const std::vector<std::string> header = {"node", "name", "port", "tension", "unit", "severity [%]", "link", "kind", "says"};
  std::vector<std::vector<csv::CsvCell>> rows;
  for (const reading::ConflictRow& conflict : model.conflicts) {
    const std::string unit(info(state.plan->port(conflict.ref).unit).symbol);
    for (std::size_t k = 0; k < std::max<std::size_t>(1, conflict.pulls.size()); ++k) {
      const std::string link = k < conflict.links.size() ? conflict.links[k] : "";
      const std::size_t index = reading::link_index(*state.plan, link);
      const bool is_link = index < state.plan->links.size() && state.plan->links[index].definition != nullptr;
      rows.push_back({conflict.node_id, conflict.node, conflict.port, conflict.amount, unit, conflict.severity * 100, link,
                      is_link                                   ? state.plan->links[index].definition->label
                      : link.empty() && !conflict.pulls.empty() ? "by hand"
                                                                : "",
                      k < conflict.pulls.size() ? conflict.pulls[k] : "a limit of the port itself"});
    }
  }
  return write_csv(header, rows);
}

// One row for each orientation of each dressed volume.
report::CsvFile facades_csv_of(const reading::ReportModel& model, const State& state) {
  std::vector<std::vector<csv::CsvCell>> rows;
  for (const reading::VolumeRow& v : model.volumes) {
    const auto facade = reading::row_of<reading::FacadeFigures>(state, v.node);
    if (!facade) continue;
    const Table& sides = *facade->by_orientation;
    for (std::size_t row = 0; row < sides.rows.size(); ++row)
      rows.push_back({v.id, v.name, v.use, facade->style_in_force, sides.text(row, "orientation"), sides.number(row, "area"),
                      sides.number(row, "glazed"), sides.number(row, "opaque"), sides.number(row, "cost")});
  }
  const std::vector<std::string> header = {"id",        "name",        "use",         "style",     "orientation",
                                           "area [m2]", "glazed [m2]", "opaque [m2]", "cost [EUR]"};
  return {"facades.csv", write_csv(header, rows), !rows.empty()};
}

std::string obj_of(const reading::ReportModel& model) {
  std::vector<exporting::NamedMesh> meshes;
  for (const reading::VolumeRow& volume : model.volumes) meshes.push_back({volume.name, volume.mesh});
  return write_obj(meshes, model.mesh_note);
}

Result<void> make_directory(const std::string& directory) {
  std::error_code code;
  std::filesystem::create_directories(directory, code);
  if (std::error_code ignored; std::filesystem::is_directory(directory, ignored)) return {};
  const std::string why = code ? code.message() : std::string("something else of that name is there");
  return Error{ErrorCode::io, directory, "the folder for the report cannot be made (" + why + "): choose another one"};
}

Result<void> write_files(const std::string& directory, const ReportData& data) {
  reading::ReportModel model;
  reading::read_model(*data.state, model);
  if (data.state->tick == 0) {
    // As the page: what volumes are born with is nobody's result.
    model.volumes.clear();
    model.accounts = {};
  }
  const drawing::Palette palette(model.use_names());
  const std::filesystem::path folder(directory);
  std::vector<report::CsvFile> tables = report::figure_files(*data.state);
  tables.push_back({"volumes.csv", csv_of(model, *data.state), true});
  tables.push_back({"uses.csv", uses_csv_of(model, *data.state), !model.accounts.uses.empty()});
  tables.push_back(open_csv_of(model));
  tables.push_back({"conflicts.csv", conflicts_csv_of(model, *data.state), !model.conflicts.empty()});
  tables.push_back(facades_csv_of(model, *data.state));
  for (const report::CsvFile& table : tables) {
    const std::string file = (folder / table.name).string();
    std::error_code ignored;
    // A table without rows is not written; but what an earlier report has left under its name would be taken for this one's.
    if (!table.has_rows && !std::filesystem::exists(file, ignored)) continue;
    if (auto written = write_file(file, table.text); !written) return written;
  }
  if (auto written = write_file((folder / "volumes.obj").string(), obj_of(model)); !written) return written;
  return write_file((folder / "report.html").string(), report::write_page(model, data, palette));
}

}  // namespace

Result<void> write_report(const std::string& directory, const ReportData& data) {
  if (data.state == nullptr || data.state->plan == nullptr)
    return Error{ErrorCode::missing, directory, "there is no state to report on: run the scene first"};
  if (auto made = make_directory(directory); !made) return made;
  if (auto may = may_fill_with_report(directory); !may) return may;
  const State seen = with_sums_of_now(*data.state);
  return write_files(directory, {&seen, data.history, data.scene_path, data.outcome});
}

}  // namespace bl::report
