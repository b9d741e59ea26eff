// The program `behaviourlinks`: reads the command line and hands over to one command.
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include "core/base/scarcity.h"
#include "core/base/text.h"
#include "ui/cli/declarations.h"
#include "ui/cli/file_rule.h"
#include "ui/cli/plugin_choice.h"
#include "ui/cli/report/report.h"
#include "ui/cli/terminal.h"
#include "ui/cli/usage.h"

namespace bl::cli {

void add_threads(CLI::App& command, int& threads) {
  command.add_option("--threads", threads, "Threads to compute with; the result does not depend on it. Default: 1.")
      ->type_name("K")
      ->check(CLI::Range(1, 256));
}

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
  auto* ticks = c.add_option("--ticks", o.ticks, "Runs so many ticks, settled or not.")
                    ->type_name("N")
                    ->check(CLI::Range(0ll, 1000000000ll));
  c.add_flag("--settle", o.is_settling, "Runs until the scene settles (this is the default); exit code 3 where it does not.")
      ->excludes(ticks);
  c.add_option("--max-ticks", o.max_ticks, "Gives up settling after so many ticks. Default: 2000.")
      ->type_name("N")
      ->check(CLI::Range(1ll, 1000000000ll));
  c.add_option("--set", o.set,
               "Sets a value before the first tick, as often as needed; VALUE is JSON or a quantity such as \"12 m\"; "
               "LINK/PARAMETER=VALUE sets a parameter of a link.")
      ->type_name("NODE/TYPIFICATION.PORT=VALUE")
      ->expected(1)
      ->take_all();
  c.add_option("--script", o.scripts,
               "Adds a link kind written in Lua before the first tick, or replaces it; as often as needed.")
      ->type_name("FILE.lua")
      ->expected(1)
      ->take_all();
  add_threads(c, o.threads);
  auto* live = c.add_flag("--live", o.is_live,
                          "Connects to the sensors and actuators of the scene, and ticks in real time until Ctrl-C or --ticks. "
                          "Without it, recorded tables are played, and nothing is connected to.");
  c.add_flag("--recordings-anywhere", o.reads_anywhere,
             "Plays recorded tables that lie outside the folder of the scene, too; for scenes that you trust.");
  c.add_option("--rate", o.rate, "Ticks per second of a live run. Default: as the tick length of its sensors says.")
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
  files_of(c).writes("--save", FileKind::scene, "scene").fills("--report", {".html", ".csv", ".obj"}, may_fill_with_report);
  c.footer(
      "Example:\n  behaviourlinks run scenes/start/quarter.json --set site/boundary.height=\"60 m\" --report proposal\n\n"
      "Exit codes: 0 settled, or all ticks done; 2 bad input; 3 not settled; 130 stopped by Ctrl-C, with everything written.");
}

void declare_open(CLI::App& app) {
  CLI::App& c = *app.add_subcommand("open", "Opens the window: wire a scene by hand, and watch it negotiate.");
  c.prefix_command();
  c.footer(
      "What follows is handed on: SCENE (without one, the start page opens), --paused, and more that\n"
      "`behaviourlinks-desktop --help` lists.\n\nExample:\n  behaviourlinks open scenes/start/quarter.json");
}

void declare_compare(CLI::App& app, CompareOptions& o) {
  CLI::App& c = *app.add_subcommand("compare", "Runs two scenes and tells every indicator that differs between them.");
  c.add_option("first", o.first, "The scene that is compared with.")->type_name("SCENE_A")->required();
  c.add_option("second", o.second, "A second scene, which is compared with the first.")->type_name("SCENE_B")->required();
  c.add_option("--ticks", o.ticks, "Runs both for so many ticks, settled or not; 0 compares them as they were saved.")
      ->type_name("N")
      ->check(CLI::Range(0ll, 1000000000ll));
  c.add_option("--max-ticks", o.max_ticks, "Gives up settling after so many ticks. Default: 2000.")
      ->type_name("N")
      ->check(CLI::Range(1ll, 1000000000ll));
  add_threads(c, o.threads);
  c.add_option("--report", o.report, "Writes a page with both drawings, bars and every number.")->type_name("FILE");
  files_of(c).reads({"first", "second"}).writes("--report", FileKind::page);
  c.footer(
      "What one scene has and the other has not is told too. Amounts are added up over all nodes, shares and rates averaged.\n\n"
      "Example:\n  behaviourlinks compare scenes/start/quarter.json other.json --report difference.html\n\n"
      "Exit codes: 0 compared; 2 bad input; 130 stopped by Ctrl-C.");
}

void declare_check(CLI::App& app, CheckOptions& o) {
  CLI::App& c = *app.add_subcommand("check", "Says everything that is wrong with scene files and link scripts.");
  c.add_option("scenes", o.scenes, "The scene files, and link scripts (.lua).")->type_name("FILE")->required();
  c.add_flag("--write", o.is_writing, "Rewrites each sound file in the one canonical form.");
  c.add_option("--json", o.json, "Writes the problems as JSON.")->type_name("FILE");
  files_of(c).reads({"scenes"}).writes("--json", FileKind::figures);
  c.footer("Example:\n  behaviourlinks check scenes/start/*.json\n\nExit codes: 0 no errors; 2 errors.");
}

void declare_replay(CLI::App& app, ReplayOptions& o) {
  CLI::App& c = *app.add_subcommand("replay", "Runs a log again and compares every hash in it.");
  c.add_option("log", o.log, "The log, as `run --log` wrote it.")->type_name("LOG")->required();
  files_of(c).reads({"log"});
  add_threads(c, o.threads);
  c.footer(
      "Example:\n  behaviourlinks run scene.json --log run.log && behaviourlinks replay run.log --threads 2\n\n"
      "Exit codes: 0 all hashes agree; 2 bad input; 3 a hash differs.");
}

void declare_papers(CLI::App& app, DocsOptions& docs, SchemaOptions& schema) {
  CLI::App& d = *app.add_subcommand("docs", "Explains typifications, link kinds and commands, from their declarations.");
  auto* type = d.add_option("type", docs.type, "Shows the page of this type.")->type_name("TYPE");
  auto* list = d.add_flag("--list", docs.is_list, "Lists all types, one line each (this is the default).");
  d.add_option("--from", docs.from, "Also knows the link kinds of this scene's scripts, or of this link script (.lua).")
      ->type_name("FILE");
  d.add_option("--out", docs.out, "Writes all pages as Markdown into a folder.")
      ->type_name("DIR")
      ->excludes(type)
      ->excludes(list);
  files_of(d).reads({"--from"}).fills("--out", {".md"});
  d.footer(
      "TYPE may be such a file itself: then the pages of all that it declares are shown. Types of plugins are known with\n"
      "`behaviourlinks --plugins DIR docs`.\n\nExample:\n  behaviourlinks docs keep_distance\n"
      "  behaviourlinks docs fair_share --from scene.json\n  behaviourlinks docs links/scripts/fair_share.lua");
  CLI::App& s = *app.add_subcommand("schema", "Prints the JSON Schema (2020-12) of scene files.");
  s.add_option("--out", schema.out, "Writes it to a file.")->type_name("FILE");
  files_of(s).writes("--out", FileKind::figures);
  s.footer("Example:\n  behaviourlinks schema --out scene.schema.json");
}

void declare_bench(CLI::App& app, BenchOptions& o) {
  CLI::App& c = *app.add_subcommand("bench", "Measures ticks per second and where the time goes.");
  c.add_option("scenes", o.scenes, "Scenes to measure.")->type_name("SCENE");
  c.add_option("--sites", o.sites, "Random volumes in a box, half full; several numbers give several rows.")
      ->type_name("N")
      ->check(CLI::Range(1, 10000000));
  c.add_option("--threads", o.threads, "Threads; several numbers give several rows. Default: 1.")
      ->type_name("K")
      ->check(CLI::Range(1, 256));
  c.add_option("--repeat", o.repeat, "Measures so often and takes the median. Default: 3, of the solver 5.")
      ->type_name("R")
      ->check(CLI::Range(1, 1000));
  c.add_option("--ticks", o.ticks, "Ticks of one measurement. Default: 20.")->type_name("N")->check(CLI::Range(1, 1000000));
  c.add_option("--json", o.json, "Writes the rows as JSON, times in seconds.")->type_name("FILE");
  auto* solver = c.add_flag(
      "--solver", o.is_solver,
      "Measures the algorithms without ticks: cells, fits, drags, growth, rays, traffic, and the feedback on a scene.");
  c.add_flag("--quick", o.is_quick, "Of the solver: small sizes only, to see that all runs.")->needs(solver);
  c.add_option("--rows", o.rows, "Of the solver: these rows only.")
      ->type_name("ROWS")
      ->check(CLI::IsMember({"diagram", "wrapped", "fit", "drag", "growth", "complex", "rays", "traffic", "study"}))
      ->needs(solver);
  c.add_option("--seeds", o.seeds, "Of the solver: cold fits of so many random sets at each fill, the most steps of all.")
      ->type_name("K")
      ->check(CLI::Range(1, 1000000))
      ->needs(solver);
  c.add_option("--tntp", o.tntp, "Of the solver: networks for the rows of traffic, NAME_net.tntp with NAME_trips.tntp.")
      ->type_name("DIR")
      ->needs(solver);
  c.add_option("--chart", o.chart, "Of the solver: writes growth.svg and feedback_newton.svg into a folder.")
      ->type_name("DIR")
      ->needs(solver);
  files_of(c).reads({"scenes", "--tntp"}).writes("--json", FileKind::figures).fills("--chart", {".svg"});
  c.footer(
      "Without scenes and --sites: 100 and 1000 random volumes; of the solver the sizes that suit each row, threads 1 and 2, "
      "and\n"
      "scenes/studies/sixty_volumes.json for the feedback.\n\nExample:\n  behaviourlinks bench --sites 100 1000 --threads 1 2\n"
      "  behaviourlinks bench --solver --rows drag --sites 5000");
}

int run_program(int count, char** arguments) {
  CLI::App app{kOverview, "behaviourlinks"};
  app.set_version_flag("--version", std::string("behaviourlinks ") + BL_VERSION, "Prints the version and ends.");
  app.require_subcommand(0, 1);
  std::vector<std::string> plugins;
  app.add_option("--plugins", plugins,
                 "Folder of plugins: link kinds and typifications as shared libraries; as often as needed, before the command.")
      ->type_name("DIR")
      ->expected(1)
      ->take_all();
  RunOptions run;
  ScriptOptions script;
  OpenOptions window;
  NewOptions fresh;
  ImportOptions import;
  PlaceOptions place;
  CheckOptions check;
  ReplayOptions replay;
  CompareOptions compare;
  DocsOptions docs;
  SchemaOptions schema;
  CellsOptions cells;
  FitFileOptions fit;
  AssignOptions assign;
  BenchOptions bench;
  declare_run(app, run);
  declare_open(app);
  declare_script(app, script);
  declare_new(app, fresh);
  declare_import(app, import);
  declare_place(app, place);
  declare_check(app, check);
  declare_papers(app, docs, schema);
  declare_replay(app, replay);
  declare_compare(app, compare);
  declare_bench(app, bench);
  declare_cells(app, cells);
  declare_fit(app, fit);
  declare_assign(app, assign);
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) names.push_back(command->get_name());
  if (count > 1 && arguments[1][0] != '-' && std::find(names.begin(), names.end(), arguments[1]) == names.end()) {
    complain("there is no command `" + std::string(arguments[1]) + "`" + did_you_mean(arguments[1], names) +
             "; `behaviourlinks --help` lists all.");
    return kBadInput;
  }
  try {
    app.parse(count, arguments);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    const auto chosen = app.get_subcommands();
    complain(usage_sentence(chosen.empty() ? app : *chosen.front(), error));
    const auto is_plugins = [](const char* argument) { return std::string_view(argument).starts_with("--plugins"); };
    if (!chosen.empty() && plugins.empty() && std::any_of(arguments + 1, arguments + count, is_plugins))
      complain("--plugins FOLDER stands before the task: behaviourlinks --plugins FOLDER " + chosen.front()->get_name() + " ...");
    complain("`behaviourlinks " + (chosen.empty() ? "" : chosen.front()->get_name() + " ") + "--help` explains.");
    return kBadInput;
  }
  for (const CLI::App* chosen : app.get_subcommands())
    if (const std::string sentence = wrong_files(*chosen); !sentence.empty()) {
      complain(sentence);
      return kBadInput;
    }
  if (const CLI::App* open = app.get_subcommand("open"); !open->parsed()) load_chosen_plugins(plugins);
  if (app.got_subcommand("run")) return run_command(run);
  if (app.got_subcommand("script")) return script_command(script);
  if (const CLI::App* open = app.get_subcommand("open"); open->parsed()) {
    window.arguments = open->remaining();
    for (const std::string& folder : plugins) window.arguments.push_back("--plugins=" + folder);
    return open_command(window);
  }
  if (app.got_subcommand("new")) return new_command(fresh);
  if (app.got_subcommand("import")) return import_command(import);
  if (app.got_subcommand("place")) return place_command(place);
  if (app.got_subcommand("check")) return check_command(check);
  if (app.got_subcommand("docs")) return docs_command(docs);
  if (app.got_subcommand("schema")) return schema_command(schema);
  if (app.got_subcommand("replay")) return replay_command(replay);
  if (app.got_subcommand("compare")) return compare_command(compare);
  if (app.got_subcommand("bench")) return bench_command(bench);
  if (app.got_subcommand("cells")) return cells_command(cells);
  if (app.got_subcommand("fit")) return fit_command(fit);
  if (app.got_subcommand("assign")) return assign_command(assign);
  std::fputs(app.help().c_str(), stdout);
  return kDone;
}

}  // namespace

}  // namespace bl::cli

int main(int count, char** arguments) {
  // A limit on the size of files shall be an error of the write, which is told and cleaned up after, not the end of the program.
  std::signal(SIGXFSZ, SIG_IGN);
  bl::prepare_for_scarcity();
  try {
    const int code = bl::cli::run_program(count, arguments);
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
    bl::cli::complain("what was to be printed could not be written: the disk is full, or nobody reads it.");
    return bl::cli::kBadInput;
  } catch (const std::bad_alloc&) { bl::cli::complain(bl::memory_sentence()); } catch (const std::system_error& error) {
    if (error.code() == std::errc::resource_unavailable_try_again) bl::cli::complain(bl::thread_sentence());
    else bl::cli::complain(std::string("the system refused something that the program needs: ") + error.what());
  } catch (const std::exception& error) {
    bl::cli::complain(std::string("this is a defect of the program, please report it: ") + error.what());
  }
  return 1;
}
