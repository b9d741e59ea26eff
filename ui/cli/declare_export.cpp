// Declares `export`; the list of formats in its help follows from their declarations.
#include "core/export/option_text.h"
#include "ui/cli/declarations.h"
#include "ui/cli/file_rule.h"

namespace bl::cli {

void declare_export(CLI::App& app, ExportOptions& o) {
  CLI::App& c = *app.add_subcommand("export", "Writes the proposal of a scene in the formats that other programs read.");
  c.add_option("scene", o.scene, "The scene file.")->type_name("SCENE")->required();
  c.add_option("--format", o.formats, "A format of the list below; one for each --out, in the same order. May be repeated.")
      ->type_name("F")
      ->required()
      ->expected(1)
      ->take_all();
  c.add_option("--out", o.outs, "The file of a format; a folder where the format makes several files. May be repeated.")
      ->type_name("PATH")
      ->required()
      ->expected(1)
      ->take_all();
  c.add_option("--option", o.options, "Sets an option of the formats that have it. May be repeated.")
      ->type_name("NAME=VALUE")
      ->expected(1)
      ->take_all();
  c.add_flag("--settle", o.is_settling, "First runs until the scene settles. Without it, the scene is exported as it was saved.");
  c.add_option("--max-ticks", o.max_ticks, "Largest number of ticks to settle. Default: 2000.")
      ->type_name("N")
      ->check(CLI::Range(1ll, 1000000000ll));
  add_threads(c, o.threads);
  files_of(c).reads({"scene"}).exports("--out");
  c.footer(
      "Formats and their options:\n" + exporting::formats_text() +
      "\nAll files are made before the first is written. A format that cannot hold the proposal says why, and the others are "
      "written; where a file may not be written, none is. A folder ends with `/`, or is there already.\n\nExample:\n  "
      "behaviourlinks export scenes/start/quarter.json --settle --format csv --out schedule.csv "
      "--format dxf --out plans.dxf\n\nExit codes: 0 written; 2 bad input, or a format that cannot hold the proposal; 3 written, "
      "but not "
      "settled; 130 stopped by Ctrl-C.");
}

}  // namespace bl::cli
