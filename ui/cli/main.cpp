// The program `behaviourlinks`: reads the command line and hands over to one command.
#include <cstdio>
#include <string>
#include <vector>

#include "core/base/moment.h"
#include "core/minutes/minutes.h"
#include "core/report/report.h"
#include "core/session/types/plugins.h"
#include "ui/cli/declarations.h"
#include "ui/cli/file_rule.h"
#include "ui/cli/program.h"
#include "ui/cli/terminal.h"

namespace bl::cli {

namespace {

constexpr const char* kOverview =
    "BehaviourLinks: nodes are entities, links are code, and every tick they negotiate.\n\n"
    "A first try:\n"
    "  behaviourlinks run scenes/start/quarter.json\n"
    "  behaviourlinks open scenes/start/quarter.json\n"
    "  behaviourlinks new --boundary site.geojson --height 45 --programme brief.csv --out scene.json\n"
    "  behaviourlinks run scene.json --report proposal\n"
    "  behaviourlinks docs --list\n\n"
    "Each command explains itself with --help.";

void declare_run(CLI::App& app, RunOptions& o) {
  CLI::App& c = *app.add_subcommand("run", "Runs a scene until it settles, and shows what every volume got.");
  c.add_option("scene", o.scene, "The scene file.")->type_name("SCENE")->required();
  auto* ticks = c.add_option("--ticks", o.ticks, "Number of ticks to run, settled or not.")
                    ->type_name("N")
                    ->check(CLI::Range(0ll, 1000000000ll));
  c.add_flag("--settle", o.is_settling, "Runs until the scene settles (this is the default); exit code 3 where it does not.")
      ->excludes(ticks);
  c.add_option("--max-ticks", o.max_ticks, "Largest number of ticks to settle. Default: 2000.")
      ->type_name("N")
      ->check(CLI::Range(1ll, 1000000000ll));
  c.add_option("--set", o.set,
               "Sets a value before the first tick; VALUE is JSON or a quantity such as \"12 m\". LINK/PARAMETER=VALUE sets a "
               "parameter of a link. May be repeated.")
      ->type_name("NODE/TYPIFICATION.PORT=VALUE")
      ->expected(1)
      ->take_all();
  c.add_option("--script", o.scripts, "Adds or replaces a link kind written in Lua before the first tick. May be repeated.")
      ->type_name("FILE.lua")
      ->expected(1)
      ->take_all();
  add_threads(c, o.threads);
  auto* live = c.add_flag("--live", o.is_live,
                          "Connects to the sensors and actuators of the scene, and ticks in real time until Ctrl-C or --ticks. "
                          "Without it, recorded tables are played, and nothing is connected to.");
  c.add_flag("--recordings-anywhere", o.reads_anywhere,
             "Also plays recorded tables outside the folder of the scene; only for scenes that you trust.");
  c.add_option("--rate", o.rate, "Ticks per second of a live run. Default: the tick length of its sensors.")
      ->type_name("R")
      ->needs(live)
      ->check(CLI::Range(0.001, 1000.0));
  c.add_option("--log", o.log, "Writes the log of commands and hashes, for `replay`.")->type_name("FILE");
  c.add_option("--report", o.report,
               "Writes report.html, volumes.csv, volumes.obj and, of dressed volumes, facades.csv into a folder.")
      ->type_name("DIR");
  c.add_option("--json", o.json, "Writes all figures as JSON, lengths in m, areas in m2, volumes in m3.")->type_name("FILE");
  c.add_option("--save", o.save, "Saves the scene with its running state, to continue later; may be the scene itself.")
      ->type_name("FILE");
  files_of(c).reads({"scene", "--script"}).writes("--log", FileKind::log).writes("--json", FileKind::figures);
  files_of(c)
      .writes("--save", FileKind::scene, "scene")
      .fills("--report", {".html", ".csv", ".obj"}, report::may_fill_with_report);
  c.footer(
      "Example:\n  behaviourlinks run scenes/start/quarter.json --set site/boundary.height=\"60 m\" --report proposal\n\n"
      "Exit codes: 0 settled, or all ticks done; 2 bad input; 3 not settled; 130 stopped by Ctrl-C, with everything written.");
}

void declare_open(CLI::App& app) {
  CLI::App& c = *app.add_subcommand("open", "Opens the window: wire a scene by hand, and watch it negotiate.");
  c.prefix_command();
  c.footer(
      "All arguments are handed on: SCENE (without one, the start page opens), --paused, and more that\n`behaviourlinks-desktop "
      "--help` lists.\n\nExample:\n  behaviourlinks open scenes/start/quarter.json");
}

void declare_compare(CLI::App& app, CompareOptions& o) {
  CLI::App& c = *app.add_subcommand("compare", "Runs two scenes and lists every indicator that differs between them.");
  c.add_option("first", o.first, "The scene that is compared with.")->type_name("SCENE_A")->required();
  c.add_option("second", o.second, "A second scene, which is compared with the first.")->type_name("SCENE_B")->required();
  c.add_option("--ticks", o.ticks, "Number of ticks to run both, settled or not; 0 compares them as they were saved.")
      ->type_name("N")
      ->check(CLI::Range(0ll, 1000000000ll));
  c.add_option("--max-ticks", o.max_ticks, "Largest number of ticks to settle. Default: 2000.")
      ->type_name("N")
      ->check(CLI::Range(1ll, 1000000000ll));
  add_threads(c, o.threads);
  c.add_option("--report", o.report, "Writes a page with both drawings, bars and every number.")->type_name("FILE");
  files_of(c).reads({"first", "second"}).writes("--report", FileKind::page);
  c.footer(
      "Nodes that only one scene has are listed, too. Amounts are summed over all nodes; shares and rates are "
      "averaged.\n\nExample:\n  behaviourlinks compare scenes/start/quarter.json other.json --report difference.html\n\nExit "
      "codes: 0 compared; 2 bad input; 130 stopped by Ctrl-C.");
}

void declare_check(CLI::App& app, CheckOptions& o) {
  CLI::App& c = *app.add_subcommand("check", "Lists all problems of scene files and link scripts.");
  c.add_option("scenes", o.scenes, "The scene files, and link scripts (.lua).")->type_name("FILE")->required();
  c.add_flag("--write", o.is_writing, "Rewrites each file without errors in its canonical form.");
  c.add_option("--json", o.json, "Writes the problems as JSON.")->type_name("FILE");
  files_of(c).reads({"scenes"}).writes("--json", FileKind::figures);
  c.footer("Example:\n  behaviourlinks check scenes/start/*.json\n\nExit codes: 0 no errors; 2 errors.");
}

void declare_replay(CLI::App& app, ReplayOptions& o) {
  CLI::App& c = *app.add_subcommand("replay", "Runs a log or a stored session again and compares every hash in it.");
  c.add_option("log", o.log, "The log, as `run --log` wrote it, or a session file (.blsession).")->type_name("LOG")->required();
  files_of(c).reads({"log"});
  add_threads(c, o.threads);
  c.footer(
      "Example:\n  behaviourlinks run scene.json --log run.log && behaviourlinks replay run.log --threads 2\n\n"
      "A session file is not changed.\n\n"
      "Exit codes: 0 no hash differs; 2 bad input; 3 a hash differs. Hashes of logs of older programs cannot be compared.");
}

void declare_erase(CLI::App& app, EraseOptions& o) {
  CLI::App& c = *app.add_subcommand("erase", "Takes a person out of a session file: the name, the words and the token.");
  c.add_option("session", o.session, "The session file (.blsession).")->type_name("FILE")->required();
  c.add_option("--seat", o.seat, "The number of the person's seat.")
      ->type_name("N")
      ->required()
      ->check(CLI::Range(1ll, 1000000000ll));
  files_of(c).reads({"session"});
  c.footer(
      "What the person changed in the scene stays, under the number of the seat, so `replay` comes to the same hashes. Copies\n"
      "of the file are not reached: erase there as well.\n\n"
      "Example:\n  behaviourlinks erase quarter.blsession --seat 3\n\n"
      "Exit codes: 0 nothing of the person is left; 2 bad input, or the file is in use.");
}

void declare_minutes(CLI::App& app, MinutesOptions& o) {
  CLI::App& c = *app.add_subcommand("minutes", "Writes the minutes of a session file: a page, tables, the log and the scenes.");
  c.add_option("session", o.session, "The session file (.blsession).")->type_name("FILE")->required();
  c.add_option("--out", o.out, "The folder for minutes.html and what lies beside it.")->type_name("DIR")->required();
  c.add_option("--zone", o.zone, "The clocks of the times: UTC, or how far they are ahead of it, such as +01:00. Default: UTC.")
      ->type_name("ZONE")
      ->check([](const std::string& zone) -> std::string {
        return read_zone(zone) ? "" : "expects UTC, or hours and minutes such as +01:00 or -03:30, found " + zone;
      });
  files_of(c).reads({"session"}).fills("--out", {".html", ".csv", ".jsonl"}, minutes::may_fill_with_minutes);
  c.footer(
      "minutes.html says who took part, what was decided, proposed, voted and commented, and what was refused. People appear by\n"
      "their pseudonyms. decisions.csv, comments.csv and votes.csv hold the same for spreadsheets, log.jsonl can be replayed, "
      "and\n"
      "scenes/ has each scenario and the end. The session file is not changed.\n"
      "The same file and zone give the same minutes on every computer. A zone is no name of a place: what that means changes.\n\n"
      "Example:\n  behaviourlinks minutes quarter.blsession --out minutes --zone +01:00\n\n"
      "Exit codes: 0 written; 2 bad input, or the file is in use.");
}

void declare_papers(CLI::App& app, DocsOptions& docs, SchemaOptions& schema) {
  CLI::App& d =
      *app.add_subcommand("docs", "Explains typifications, link kinds, commands and export formats, from their declarations.");
  auto* type = d.add_option("type", docs.type, "Shows the page of this type.")->type_name("TYPE");
  auto* list = d.add_flag("--list", docs.is_list, "Lists all types, one line each (this is the default).");
  d.add_option("--from", docs.from, "Includes the link kinds of this scene's scripts, or of this link script (.lua).")
      ->type_name("FILE");
  d.add_option("--out", docs.out, "Writes all pages as Markdown into a folder.")
      ->type_name("DIR")
      ->excludes(type)
      ->excludes(list);
  files_of(d).reads({"--from"}).fills("--out", {".md"});
  d.footer(
      "TYPE may be such a file itself; the pages of all its types are then shown. Types of plugins are included "
      "with\n`behaviourlinks --plugins DIR docs`.\n\nExample:\n  behaviourlinks docs keep_distance\n  behaviourlinks docs "
      "fair_share --from scene.json\n  behaviourlinks docs links/scripts/fair_share.lua");
  CLI::App& s = *app.add_subcommand("schema", "Prints the JSON Schema (2020-12) of scene files, or of the messages of rooms.");
  s.add_option("--out", schema.out, "Writes it to a file.")->type_name("FILE");
  s.add_flag("--messages", schema.is_of_messages, "The schema of the messages between a room and its pages instead.");
  s.add_flag("--typescript", schema.is_types, "The messages as types of TypeScript, as the page has them.")
      ->needs(s.get_option("--messages"));
  files_of(s).writes("--out", FileKind::figures);
  s.footer("Example:\n  behaviourlinks schema --out scene.schema.json");
}

struct Options {
  RunOptions run;
  ScriptOptions script;
  OpenOptions window;
  making::NewOptions fresh;
  making::ImportOptions import;
  PlaceOptions place;
  AddOptions add;
  ExportOptions export_of;
  CheckOptions check;
  ReplayOptions replay;
  EraseOptions erase;
  MinutesOptions minutes;
  ServeOptions serve;
  RehearseOptions rehearse;
  CompareOptions compare;
  DocsOptions docs;
  SchemaOptions schema;
  CellsOptions cells;
  FitFileOptions fit;
  AssignOptions assign;
};

void declare_all(CLI::App& app, Options& o) {
  declare_run(app, o.run);
  declare_open(app);
  declare_script(app, o.script);
  declare_new(app, o.fresh);
  declare_import(app, o.import);
  declare_place(app, o.place);
  declare_add(app, o.add);
  declare_export(app, o.export_of);
  declare_check(app, o.check);
  declare_papers(app, o.docs, o.schema);
  declare_replay(app, o.replay);
  declare_serve(app, o.serve);
  declare_rehearse(app, o.rehearse);
  declare_erase(app, o.erase);
  declare_minutes(app, o.minutes);
  declare_compare(app, o.compare);
  declare_cells(app, o.cells);
  declare_fit(app, o.fit);
  declare_assign(app, o.assign);
}

int run_chosen(const CLI::App& app, const Options& o) {
  if (app.got_subcommand("run")) return run_command(o.run);
  if (app.got_subcommand("script")) return script_command(o.script);
  if (app.got_subcommand("new")) return new_command(o.fresh);
  if (app.got_subcommand("import")) return import_command(o.import);
  if (app.got_subcommand("place")) return place_command(o.place);
  if (app.got_subcommand("add")) return add_command(o.add);
  if (app.got_subcommand("export")) return export_command(o.export_of);
  if (app.got_subcommand("check")) return check_command(o.check);
  if (app.got_subcommand("docs")) return docs_command(o.docs);
  if (app.got_subcommand("schema")) return schema_command(o.schema);
  if (app.got_subcommand("replay")) return replay_command(o.replay);
  if (app.got_subcommand("serve")) return serve_command(o.serve);
  if (app.got_subcommand("rehearse")) return rehearse_command(o.rehearse);
  if (app.got_subcommand("erase")) return erase_command(o.erase);
  if (app.got_subcommand("minutes")) return minutes_command(o.minutes);
  if (app.got_subcommand("compare")) return compare_command(o.compare);
  if (app.got_subcommand("cells")) return cells_command(o.cells);
  if (app.got_subcommand("fit")) return fit_command(o.fit);
  if (app.got_subcommand("assign")) return assign_command(o.assign);
  std::fputs(app.help().c_str(), stdout);
  return kDone;
}

// Plugins add types, which is told before anything is read that may need them.
void load_chosen_plugins(std::vector<std::string> folders) {
  use_plugins(std::move(folders));
  for (const PluginReport& report : plugin_reports())
    if (report.error) complain(report.error->text());
}

int run_program(int count, char** arguments) {
  CLI::App app{kOverview, "behaviourlinks"};
  app.set_version_flag("--version", std::string("behaviourlinks ") + BL_VERSION, "Prints the version.");
  app.require_subcommand(0, 1);
  std::vector<std::string> plugins;
  app.add_option(
         "--plugins", plugins,
         "Folder of plugins: link kinds and typifications as shared libraries. Stands before the command; may be repeated.")
      ->type_name("DIR")
      ->expected(1)
      ->take_all();
  Options options;
  declare_all(app, options);
  if (const auto code = refusal(app, count, arguments)) return *code;
  if (const CLI::App* open = app.get_subcommand("open"); open->parsed()) {
    options.window.arguments = open->remaining();
    for (const std::string& folder : plugins) options.window.arguments.push_back("--plugins=" + folder);
    return open_command(options.window);
  }
  load_chosen_plugins(plugins);
  return run_chosen(app, options);
}

}  // namespace

}  // namespace bl::cli

int main(int count, char** arguments) {
  return bl::cli::guarded([&] { return bl::cli::run_program(count, arguments); });
}
