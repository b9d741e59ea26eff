// `import`: adds the surroundings of a site to a scene, and says what became of every element.
#include <sys/stat.h>

#include <algorithm>

#include "core/file/file_io.h"
#include "core/session/ledger.h"
#include "ui/cli/commands.h"
#include "ui/cli/scene_loading.h"
#include "ui/cli/terminal.h"

namespace bl::cli {

namespace {

void print_counts(const ImportedScene& imported) {
  for (const auto& [file, report] : imported.reports) {
    print_line(file, Colour::bold);
    TextTable table({{"outcome"}, {"kind"}, {"number", true}, {"what it is, or why not"}});
    for (const auto& [key, number] : report.counts()) {
      const auto& [outcome, kind, reason] = key;
      const Colour colour = outcome == ImportOutcome::taken      ? Colour::plain
                            : outcome == ImportOutcome::repaired ? Colour::yellow
                                                                 : Colour::dim;
      table.add({std::string(name_of(outcome)), kind, std::to_string(number), reason}, colour);
    }
    table.print();
    print_line("total: " + std::to_string(report.count(ImportOutcome::taken)) + " taken, " +
               std::to_string(report.count(ImportOutcome::repaired)) + " repaired, " +
               std::to_string(report.count(ImportOutcome::skipped)) + " skipped of " + counted(report.total(), "element"));
  }
}

bool is_there(const std::string& file) {
  struct stat status {};
  return ::stat(file.c_str(), &status) == 0;
}

// Pictures alone: as `place` does it.
int import_pictures(const ImportOptions& options) {
  if (options.into.empty()) {
    complain("pictures are put into a scene: name it by --into");
    return kBadInput;
  }
  PlaceOptions place;
  place.files = options.files;
  place.into = options.into;
  place.out = options.out;
  place.is_forced = options.is_forced;
  place.media.licence = options.licence;
  return place_command(place);
}

}  // namespace

int import_command(const ImportOptions& options) {
  if (std::all_of(options.files.begin(), options.files.end(), is_picture_name)) return import_pictures(options);
  const Registry& registry = full_registry();
  Scene scene;
  if (!options.into.empty()) {
    auto reading = load_scene(options.into);
    if (!reading) return kBadInput;
    scene = std::move(reading->scene);
  }
  const bool is_taken = !options.is_forced && is_there(options.out);
  if (is_taken)
    print_error(options.out, {ErrorCode::conflict, "", "exists already; choose another name, or replace it with --force"});
  const ImportedScene imported = import_context(scene, options, registry);
  print_counts(imported);
  for (const std::string& note : imported.notes) print_line("note: " + note);
  for (const auto& [file, error] : imported.errors) print_error(file, error);
  if (!options.report.empty() && !imported.reports.empty())
    if (auto written = write_file(options.report, import_csv(imported.reports)); !written) {
      print_error(options.report, written.error());
      return kBadInput;
    }
  if (is_taken || !imported.scene) return kBadInput;
  print_problems(options.out, check_scene(*imported.scene, registry));
  if (auto written = write_file(options.out, write_scene(*imported.scene, registry)); !written) {
    print_error(options.out, written.error());
    return kBadInput;
  }
  std::string made;
  for (const auto& [type, number] : imported.nodes) made += (made.empty() ? "" : ", ") + std::to_string(number) + " " + type;
  print_line("wrote " + options.out + ": " + (made.empty() ? "no new nodes" : "new nodes: " + made) + "; " +
             counted(imported.scene->nodes.size(), "node") + " in all");
  return kDone;
}

}  // namespace bl::cli
