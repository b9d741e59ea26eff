// Tells files of an earlier report from what somebody else has put under the same names: by how they begin.
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "core/define/registry.h"
#include "core/report/figure_tables.h"
#include "core/report/report.h"

namespace bl::report {

namespace {

// A file by its name, and what it begins with, whatever version of the program wrote it.
std::vector<std::pair<std::string, std::string>> report_files() {
  std::vector<std::pair<std::string, std::string>> files = {
      {"volumes.csv", "number,id,name,use,"},
      {"uses.csv", "use,in_programme,volumes,"},
      {"open_space.csv", "use,in_programme,asked_area"},
      {"conflicts.csv", "node,name,port,tension,"},
      {"facades.csv", "id,name,use,style,orientation,"},
      {"volumes.obj", "# BehaviourLinks: "},
      {"report.html", "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\""}};
  for (const report::FigureTable& table : report::figure_tables()) {
    for (const report::FigureColumn& column : table.columns) {
      if (column.shown == report::Shown::json) continue;
      files.emplace_back(std::string(table.id) + ".csv", "id,name," + std::string(column.port));
      break;
    }
    const TypificationDefinition* type = full_registry().typification(table.type);
    for (const report::FigurePart& part : table.parts) {
      const PortDefinition* port = type == nullptr ? nullptr : type->find_port(part.port);
      // Without nodes of the typification, the table has the first column alone.
      const bool has_columns = port != nullptr && !port->columns.empty();
      files.emplace_back(std::string(part.id) + ".csv", has_columns ? "node," + port->columns.front().id : "node");
    }
  }
  return files;
}

std::string beginning_of(const std::string& file) {
  std::string text(1 << 16, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(std::max<std::streamsize>(0, stream.gcount())));
  return text;
}

}  // namespace

Result<void> may_fill_with_report(const std::string& directory) {
  for (const auto& [name, begin] : report_files()) {
    const std::string file = (std::filesystem::path(directory) / name).string();
    std::error_code none;
    if (!std::filesystem::exists(file, none)) continue;
    const std::string text = beginning_of(file);
    const bool is_page = name.ends_with(".html");
    // The page of a comparison begins alike.
    bool is_ours = text.starts_with(begin) && (!is_page || text.find(": report</title>") != std::string::npos);
    is_ours = is_ours || (text == "node\r\n" && begin.starts_with("node"));
    if (text.empty() && std::filesystem::is_regular_file(file, none)) continue;
    if (!is_ours)
      return Error{ErrorCode::conflict, file,
                   std::string("is there already and is ") +
                       (is_page                  ? "no page"
                        : name.ends_with(".obj") ? "no shapes"
                                                 : "no table") +
                       " of a report; choose another folder, or remove it first"};
  }
  return {};
}

}  // namespace bl::report
