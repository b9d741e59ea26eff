// Writes the files of a report: the page, tables and shapes.
#include "ui/cli/report/report.h"

#include <filesystem>
#include <system_error>

#include "core/exchange/csv_table.h"
#include "core/exchange/wavefront_obj.h"
#include "core/file/file_io.h"
#include "ui/cli/report/page.h"

namespace bl {

namespace {

using report::ReportModel;
using report::VolumeRow;

std::string csv_of(const ReportModel& model, const State& state) {
  const std::vector<std::string> header = {"number",
                                           "id",
                                           "name",
                                           "use",
                                           "x [m]",
                                           "y [m]",
                                           "z [m]",
                                           "storey_height [m]",
                                           "demand [m3]",
                                           "wanted [m3]",
                                           "volume [m3]",
                                           "cell_volume [m3]",
                                           "error [%]",
                                           "floor_area [m2]",
                                           "surface_area [m2]",
                                           "footprint [m2]",
                                           "bottom [m]",
                                           "height [m]",
                                           "weight [m2]",
                                           "state",
                                           "reason",
                                           "facade_style",
                                           "facade_area [m2]",
                                           "glazed_area [m2]",
                                           "opaque_area [m2]",
                                           "facade_cost [EUR]"};
  std::vector<std::vector<CsvCell>> rows;
  for (const VolumeRow& v : model.volumes) {
    rows.push_back({v.number,        v.id,        v.name,   v.use,    v.position.x,  v.position.y,    v.position.z,
                    v.storey_height, v.demand,    v.wanted, v.volume, v.cell_volume, v.error() * 100, v.floor_area,
                    v.surface_area,  v.footprint, v.bottom, v.height, v.weight,      v.state,         v.reason});
    if (!report::has_type(state, v.node, "facade")) continue;
    rows.back().emplace_back(report::text_at(state, v.node, "facade", "style_in_force"));
    for (const char* port : {"facade_area", "glazed_area", "opaque_area", "cost"})
      rows.back().emplace_back(report::number_at(state, v.node, "facade", port));
  }
  return write_csv(header, rows);
}

// One row for each orientation of each dressed volume.
std::string facades_csv_of(const ReportModel& model, const State& state) {
  std::vector<std::vector<CsvCell>> rows;
  for (const VolumeRow& v : model.volumes) {
    const Table* sides = report::table_at(state, v.node, "facade", "by_orientation");
    for (std::size_t row = 0; sides != nullptr && row < sides->rows.size(); ++row)
      rows.push_back({v.id, v.name, v.use, report::text_at(state, v.node, "facade", "style_in_force"),
                      sides->text(row, "orientation"), sides->number(row, "area"), sides->number(row, "glazed"),
                      sides->number(row, "opaque"), sides->number(row, "cost")});
  }
  if (rows.empty()) return "";
  const std::vector<std::string> header = {"id",          "name",        "use",        "style", "orientation", "area [m2]",
                                           "glazed [m2]", "opaque [m2]", "cost [EUR]"};
  return write_csv(header, rows);
}

std::string obj_of(const ReportModel& model) {
  std::vector<NamedMesh> meshes;
  for (const VolumeRow& volume : model.volumes) meshes.push_back({volume.name, volume.mesh});
  return write_obj(meshes);
}

Result<void> make_directory(const std::string& directory) {
  std::error_code code;
  std::filesystem::create_directories(directory, code);
  if (std::error_code ignored; std::filesystem::is_directory(directory, ignored)) return {};
  const std::string why = code ? code.message() : std::string("something else of that name is there");
  return Error{ErrorCode::io, directory, "the folder for the report cannot be made (" + why + "): choose another one"};
}

}  // namespace

Result<void> write_report(const std::string& directory, const ReportData& data) {
  if (data.state == nullptr || data.state->plan == nullptr)
    return Error{ErrorCode::missing, directory, "there is no state to report on: run the scene first"};
  if (auto made = make_directory(directory); !made) return made;
  ReportModel model;
  report::read_model(*data.state, model);
  const report::Palette palette(model.use_names());
  const std::filesystem::path folder(directory);
  if (auto written = write_file((folder / "volumes.csv").string(), csv_of(model, *data.state)); !written) return written;
  if (const std::string facades = facades_csv_of(model, *data.state); !facades.empty())
    if (auto written = write_file((folder / "facades.csv").string(), facades); !written) return written;
  if (auto written = write_file((folder / "volumes.obj").string(), obj_of(model)); !written) return written;
  return write_file((folder / "report.html").string(), report::write_page(model, data, palette));
}

}  // namespace bl
