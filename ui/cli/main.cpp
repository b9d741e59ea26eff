// The program `behaviourlinks`: reads the command line and hands over to one command.
#include <CLI/CLI.hpp>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "core/base/text.h"
#include "ui/cli/commands.h"
#include "ui/cli/plugin_choice.h"
#include "ui/cli/terminal.h"

namespace bl::cli {

namespace {

constexpr int kMostThreads = 256;

constexpr const char* kOverview =
    "BehaviourLinks: nodes are entities, links are code, and every tick they negotiate.\n\n"
    "A first try:\n"
    "  behaviourlinks run scenes/start/quarter.json\n"
    "  behaviourlinks open scenes/start/quarter.json\n"
    "  behaviourlinks new --boundary site.geojson --height 45 --programme brief.csv --out scene.json\n"
    "  behaviourlinks run scene.json --report proposal\n"
    "  behaviourlinks docs --list\n\n"
    "Each command explains itself with --help.";

void add_threads(CLI::App& command, int& threads) {
  command.add_option("--threads", threads, "Threads to compute with; the result does not depend on it. Default: 1.")
      ->type_name("K")
      ->check(CLI::Range(1, kMostThreads));
}

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
               "Sets a value before the first tick, as often as needed; VALUE is JSON or a quantity such as \"12 m\".")
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
  c.add_option("--rate", o.rate, "Ticks per second of a live run. Default: as the tick length of its sensors says.")
      ->type_name("R")
      ->needs(live)
      ->check(CLI::Range(0.001, 1000.0));
  c.add_option("--log", o.log, "Writes the log of commands and hashes, for `replay`.")->type_name("FILE");
  c.add_option("--report", o.report, "Writes report.html, volumes.csv, volumes.obj and, of dressed volumes, facades.csv into a folder.")->type_name("DIR");
  c.add_option("--json", o.json, "Writes all figures as JSON, lengths in m, areas in m2, volumes in m3.")->type_name("FILE");
  c.add_option("--save", o.save, "Saves the scene with its running state, to continue later.")->type_name("FILE");
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
  c.add_option("second", o.second, "The scene that is compared.")->type_name("SCENE_B")->required();
  c.add_option("--ticks", o.ticks, "Runs both for so many ticks, settled or not; 0 compares them as they were saved.")
      ->type_name("N")
      ->check(CLI::Range(0ll, 1000000000ll));
  c.add_option("--max-ticks", o.max_ticks, "Gives up settling after so many ticks. Default: 2000.")
      ->type_name("N")
      ->check(CLI::Range(1ll, 1000000000ll));
  add_threads(c, o.threads);
  c.add_option("--report", o.report, "Writes a page with both drawings, bars and every number.")->type_name("FILE");
  c.footer(
      "What one scene has and the other has not is told too. Amounts are added up over all nodes, shares and rates averaged.\n\n"
      "Example:\n  behaviourlinks compare scenes/start/quarter.json other.json --report difference.html\n\n"
      "Exit codes: 0 compared; 2 bad input; 130 stopped by Ctrl-C.");
}

void declare_script(CLI::App& app, ScriptOptions& o) {
  CLI::App& c = *app.add_subcommand("script", "Puts link kinds written in Lua into a scene, lists them, takes them out.");
  c.add_option("scene", o.scene, "The scene file.")->type_name("SCENE")->required();
  c.add_option("files", o.files, "Lua files; a script of the same name is replaced.")->type_name("FILE.lua");
  c.add_option("--remove", o.removed, "Takes a script away, as often as needed; its links stay and do not run.")
      ->type_name("NAME")
      ->expected(1)
      ->take_all();
  c.add_option("--extract", o.extract, "Writes all scripts of the scene as files into a folder.")->type_name("DIR");
  c.add_option("--out", o.out, "Where the changed scene is written; may be the scene itself.")->type_name("SCENE");
  c.footer("Example:\n  behaviourlinks script scene.json lean_uphill.lua --out scene.json");
}

void declare_new(CLI::App& app, NewOptions& o) {
  CLI::App& c = *app.add_subcommand("new", "Makes a scene from a plan boundary and a programme of demands.");
  c.add_option("--boundary", o.boundary, "Plan polygon as GeoJSON, in WGS84 or in a CRS in metres.")
      ->type_name("FILE")
      ->required();
  c.add_option("--height", o.height, "Height of the boundary above the ground, in m.")->type_name("METRES")->required();
  c.add_option("--programme", o.programme, "Table of uses as CSV: use, floor_area_m2, count, storey_height_m, adjacent_to, ...")
      ->type_name("FILE")
      ->required();
  c.add_option("--out", o.out, "The scene file to write.")->type_name("FILE")->required();
  c.add_flag("--force", o.is_forced, "Replaces --out where it exists.");
  c.add_option("--title", o.title, "Name of the project. Default: the name of the programme's file.")->type_name("TEXT");
  c.add_option("--feature", o.feature, "Which polygon: its index from 0, or PROPERTY=VALUE. Default: the only or largest one.")
      ->type_name("WHICH");
  c.add_option("--crs", o.crs, "CRS of the boundary in place of what the file says, such as EPSG:28992.")->type_name("CRS");
  c.add_flag("--hull", o.use_hull, "Takes the convex hull of a plan that is not convex.");
  c.add_option("--column", o.columns,
               "Names a column that is called otherwise in the table, as often as needed: use=\"Room name\".")
      ->type_name("OURS=HEADER")
      ->expected(1)
      ->take_all();
  c.add_option("--storey-height", o.storey_height, "Storey height of rows that give none, in m. Default: 3.2.")
      ->type_name("METRES");
  c.add_option("--margin", o.margin, "How far inside the boundary the positions stay, in m. Default: 1.")->type_name("METRES");
  c.add_option("--seed", o.seed, "Seed of the first positions. Default: 1.")->type_name("N");
  c.footer("Example:\n  behaviourlinks new --boundary site.geojson --height 45 --programme brief.csv --out scene.json");
}

void declare_import(CLI::App& app, ImportOptions& o) {
  CLI::App& c = *app.add_subcommand("import", "Brings the surroundings of a site into a scene: buildings, streets, terrain, data.");
  c.add_option("files", o.files, "OSM (.osm, .osm.gz, .pbf), CityJSON (.json, .jsonl), GeoJSON, ASCII grid (.asc), GeoTIFF, CSV with coordinates; or pictures (JPEG, PNG).")
      ->type_name("FILE")
      ->required();
  c.add_option("--into", o.into, "The scene that is added to. Default: an empty one.")->type_name("SCENE");
  c.add_option("--out", o.out, "The scene file to write.")->type_name("SCENE")->required();
  c.add_flag("--force", o.is_forced, "Replaces --out where it exists.");
  c.add_option("--as", o.kind, "What the features or the grid are, where the file does not say: building, street, plot, area, terrain, layer.")
      ->type_name("KIND")
      ->check(CLI::IsMember({"building", "street", "plot", "area", "terrain", "layer"}));
  c.add_option("--crs", o.context.crs, "CRS of the files in place of what they say, such as EPSG:28992.")->type_name("CRS");
  c.add_option("--origin", o.origin, "Origin of the scene as X,Y in the CRS of the first file. Default: the middle of what is in it.")
      ->type_name("X,Y");
  c.add_option("--radius", o.context.radius, "Takes only what is that near to the origin, in m.")->type_name("METRES");
  c.add_option("--property", o.properties, "Names a property that is called otherwise, as often as needed: height=H_MAX.")
      ->type_name("OURS=THEIRS")
      ->expected(1)
      ->take_all();
  c.add_option("--value", o.value, "Of a data layer: the column or property with the values.")->type_name("NAME");
  c.add_option("--unit", o.unit, "Of a data layer: the unit of the values, such as dB.")->type_name("UNIT");
  c.add_option("--source", o.source, "Who made the data, for the nodes that keep it. Default: the name of the file.")->type_name("TEXT");
  c.add_option("--licence", o.licence, "What may be done with the data, for the nodes that keep it.")->type_name("TEXT");
  c.add_option("--storey-height", o.context.storey_height, "Height of storeys where only their number is known, in m. Default: 3.2.")
      ->type_name("METRES");
  c.add_option("--default-height", o.context.default_height, "Height of buildings that nothing is known about, in m. Default: 9.6.")
      ->type_name("METRES");
  c.add_option("--neighbours", o.context.neighbour_distance, "How near buildings are whose heights are taken over, in m. Default: 100.")
      ->type_name("METRES");
  c.add_option("--lod", o.context.level_of_detail, "Of city models: the finest level of detail up to this. Default: 9.")->type_name("LEVEL");
  c.add_flag("--extruded", o.is_extruded, "Makes buildings from outline and height even where the file has solids.");
  c.add_flag("--all-streets", o.takes_all_streets, "Takes footpaths, cycleways and steps as well, not only streets for cars.");
  c.add_option("--report", o.report, "Writes what became of every single element as CSV.")->type_name("FILE");
  c.footer(
      "Example:\n  behaviourlinks import quarter.osm.gz heights.asc --into scene.json --out scene_in_context.json --radius 400 "
      "--report import.csv\n\nHeights that are not in the file are assumed, and marked as such. Exit codes: 0 imported; 2 bad input, "
      "nothing written.");
}

void declare_place(CLI::App& app, PlaceOptions& o) {
  CLI::App& c = *app.add_subcommand("place", "Puts pictures into a scene, where and as they were taken.");
  c.add_option("pictures", o.files, "JPEG or PNG files; they stay where they are.")->type_name("PICTURE")->required();
  c.add_option("--into", o.into, "The scene.")->type_name("SCENE")->required();
  c.add_option("--out", o.out, "Where the scene is written. Default: the same file.")->type_name("SCENE");
  c.add_option("--at", o.at, "Position in m. Default: by the coordinates in the picture.")->type_name("X Y Z")->expected(3);
  c.add_option("--placement", o.media.placement, "Default: camera where the picture says where it looked, else billboard.")
      ->check(CLI::IsMember({"ground", "billboard", "camera"}));
  c.add_option("--consent", o.media.consent, "May it be shown? Default: unknown, which veils it.")
      ->check(CLI::IsMember({"unknown", "given", "not_needed", "refused"}));
  c.add_option("--licence", o.media.licence, "Terms of its use. Default: what the picture says.")->type_name("TEXT");
  c.add_option("--author", o.media.author, "Who made it. Default: what the picture says.")->type_name("TEXT");
  c.add_option("--size", o.media.size, "Width in m, of a billboard or on the ground. Default: 10.")->type_name("METRES");
  c.footer("Example:\n  behaviourlinks place site.jpg --into scene.json --consent given");
}

void declare_check(CLI::App& app, CheckOptions& o) {
  CLI::App& c = *app.add_subcommand("check", "Says everything that is wrong with scene files and link scripts.");
  c.add_option("scenes", o.scenes, "The scene files, and link scripts (.lua).")->type_name("FILE")->required();
  c.add_flag("--write", o.is_writing, "Rewrites each sound file in the one canonical form.");
  c.add_option("--json", o.json, "Writes the problems as JSON.")->type_name("FILE");
  c.footer("Example:\n  behaviourlinks check scenes/start/*.json\n\nExit codes: 0 no errors; 2 errors.");
}

void declare_replay(CLI::App& app, ReplayOptions& o) {
  CLI::App& c = *app.add_subcommand("replay", "Runs a log again and compares every hash in it.");
  c.add_option("log", o.log, "The log, as `run --log` wrote it.")->type_name("LOG")->required();
  add_threads(c, o.threads);
  c.footer(
      "Example:\n  behaviourlinks run scene.json --log run.log && behaviourlinks replay run.log --threads 2\n\n"
      "Exit codes: 0 all hashes agree; 2 bad input; 3 a hash differs.");
}

void declare_papers(CLI::App& app, DocsOptions& docs, SchemaOptions& schema) {
  CLI::App& d = *app.add_subcommand("docs", "Explains typifications, link kinds and commands, from their declarations.");
  auto* type = d.add_option("type", docs.type, "Shows the page of this type.")->type_name("TYPE");
  auto* list = d.add_flag("--list", docs.is_list, "Lists all types, one line each (this is the default).");
  d.add_option("--out", docs.out, "Writes all pages as Markdown into a folder.")
      ->type_name("DIR")
      ->excludes(type)
      ->excludes(list);
  d.footer("Example:\n  behaviourlinks docs keep_distance");
  CLI::App& s = *app.add_subcommand("schema", "Prints the JSON Schema (2020-12) of scene files.");
  s.add_option("--out", schema.out, "Writes it to a file.")->type_name("FILE");
  s.footer("Example:\n  behaviourlinks schema --out scene.schema.json");
}

constexpr const char* kBoundaryHelp =
    "Boundary of a file without one: JSON of a boundary, or of a case that has one; tables need it.";
constexpr const char* kBoundaryFormsHelp =
    "Boundary: {\"planes\": [[a, b, c, d], ...]}         holds a x + b y + c z <= d\n"
    "          {\"vertices\": [[x, y, z], ...]}         their convex hull\n"
    "          {\"plan\": [[x, y], ...], \"holes\": [[[x, y], ...], ...], \"bottom\": z, \"top\": z}\n"
    "          {\"mesh\": {\"vertices\": [[x, y, z], ...], \"triangles\": [[i, j, k], ...]}}\n";

void declare_cells(CLI::App& app, CellsOptions& o) {
  CLI::App& c = *app.add_subcommand("cells", "Computes the shrink-wrapped power cells of given sites and weights.");
  c.add_option("input", o.input, "Boundary, sites and weights as JSON, or sites and weights as CSV, in m and m2.")
      ->type_name("FILE")
      ->required();
  c.add_option("--json", o.json, "Where the cells are written, in m2 and m3.")->type_name("OUT")->required();
  c.add_option("--boundary", o.boundary, kBoundaryHelp)->type_name("FILE");
  c.add_flag("--complex", o.with_complex, "Writes the facets, edges and vertices between the unshrunk cells as well.");
  add_threads(c, o.threads);
  c.footer(
      "Input:  {\"boundary\": ..., \"sites\": [[x, y, z], ...], \"weights\": [w, ...]}\n"
      "        or {\"cases\": [...]} with many of these; or a .csv with the columns x, y, z and weight (or radius)\n" +
      std::string(kBoundaryFormsHelp) +
      "Output: {\"cells\": [{\"volume\", \"cell_volume\", \"surface_area\", \"spherical_area\",\n"
      "         \"facet_areas\": {\"plane:k\": area, \"site:j\": area}, \"centroid\", \"state\", \"reason\"}, ...]}\n"
      "        in the order of the sites; where no planes were given, those that were found stand beside the cells\n"
      "        --complex: {\"complex\": {\"vertices\": [{\"name\", \"position\"}], \"edges\": [{\"name\", \"length\", "
      "\"vertices\"}],\n"
      "         \"facets\": [{\"name\", \"area\", \"edges\", \"polygons\"}]}}; a name such as {3,7,#2} is the sites and\n"
      "         sides that meet there\n\n"
      "Example:\n  behaviourlinks cells sites.json --json cells.json");
}

void declare_fit(CLI::App& app, FitFileOptions& o) {
  CLI::App& c = *app.add_subcommand("fit", "Finds the weights with which sites have the volumes that they are to have.");
  c.add_option("input", o.input, "Boundary, sites and demands as JSON, or sites and demands as CSV, in m, m2 and m3.")
      ->type_name("FILE")
      ->required();
  c.add_option("--json", o.json, "Where weights, volumes and what became of the demands are written.")
      ->type_name("OUT")
      ->required();
  c.add_option("--method", o.method, "newton: all sites together, few steps; feedback: each by its own error. Default: newton.")
      ->type_name("METHOD")
      ->check(CLI::IsMember({"newton", "feedback"}));
  c.add_option("--tolerance", o.tolerance, "Largest relative error that counts as met. Default: 1e-6.")->type_name("T");
  c.add_option("--steps", o.steps, "Gives up after so many evaluations of all cells. Default: 200.")
      ->type_name("N")
      ->check(CLI::Range(1, 1000000));
  c.add_option("--boundary", o.boundary, kBoundaryHelp)->type_name("FILE");
  add_threads(c, o.threads);
  c.footer(
      "Input:  {\"boundary\": ..., \"sites\": [[x, y, z], ...], \"demands\": [demand, ...]} and, where wanted,\n"
      "         \"weights\": [w, ...] to start from (not given, or 0: the solver starts by itself),\n"
      "         \"groups\": [[i, j, ...], ...] that meet one demand together, \"locked\": [i, ...] that keep their weight;\n"
      "        or {\"cases\": [...]} with many of these\n"
      "        or a .csv with the columns x, y, z, demand or demand_min and demand_max, weight or radius, group, name\n"
      "Demand: 1200 (m3), {\"min\": 900, \"max\": 1200} (either alone will do),\n"
      "        {\"floor_area\": 400 or {\"min\", \"max\"}, \"storey_height\": 3} (m2 and m); for each site, null for a\n"
      "        locked one, or with `groups` for each group; sites in no group keep their weight\n" +
      std::string(kBoundaryFormsHelp) +
      "Output: {\"weights\", \"volumes\", \"iterations\", \"evaluations\", \"max_relative_error\",\n"
      "         \"status\": \"met\", \"infeasible\", \"step limit\" or \"cancelled\", \"reasons\": [sentence, ...],\n"
      "         \"losses\": [{\"demand\", \"sites\", \"wanted\", \"had\"}, ...]}\n\n"
      "Example:\n  behaviourlinks fit sites.json --json weights.json\n\n"
      "Exit codes: 0 all demands met; 2 bad input; 3 some are not, with the best that was found written; 130 stopped by Ctrl-C, "
      "with everything written.");
}

void declare_assign(CLI::App& app, AssignOptions& o) {
  CLI::App& c =
      *app.add_subcommand("assign", "Spreads trips over a road network so that nobody gains by another way (TNTP files).");
  c.add_option("net", o.net, "The network, `..._net.tntp`.")->type_name("NET")->required();
  c.add_option("trips", o.trips, "The trips between its zones, `..._trips.tntp`.")->type_name("TRIPS")->required();
  c.add_option("--gap", o.gap, "Relative gap to reach. Default: 1e-6.")->type_name("G")->check(CLI::Range(0.0, 1.0));
  c.add_option("--iterations", o.iterations, "Gives up after so many iterations. Default: 1000.")
      ->type_name("N")
      ->check(CLI::Range(0, 1000000));
  c.add_option("--toll-factor", o.toll_factor,
               "What a unit of toll counts in units of time. Default: what the network says, or 0.")
      ->type_name("F")
      ->check(CLI::NonNegativeNumber);
  c.add_option("--distance-factor", o.distance_factor,
               "What a unit of length counts in units of time. Default: what the network says, or 0.")
      ->type_name("F")
      ->check(CLI::NonNegativeNumber);
  c.add_option("--flows", o.flows, "Compares the flows with those of a file, `..._flow.tntp`.")->type_name("FILE");
  c.add_option("--edit-capacity", o.edit_capacity,
               "Then changes the capacity of a link, as often as needed, and finds the new equilibrium from the old one.")
      ->type_name("LINK=VALUE")
      ->expected(1)
      ->take_all();
  c.add_option("--close", o.close, "Then closes a link, as often as needed, and goes on in the same way.")
      ->type_name("LINK")
      ->expected(1)
      ->take_all();
  c.add_option("--routes", o.routes, "Lists the ways that the trips from one zone to another use, as often as needed.")
      ->type_name("FROM-TO")
      ->expected(1)
      ->take_all();
  c.add_option("--reach", o.reach, "Says how far one gets from a node at these flows within a cost, as often as needed.")
      ->type_name("NODE=LIMIT")
      ->expected(1)
      ->take_all();
  c.add_option("--repeat", o.repeat, "Measures so often and tells the median time. Default: 1.")
      ->type_name("R")
      ->check(CLI::Range(1, 100000));
  auto* json = c.add_option("--json", o.json, "Writes figures, and flow and cost of each link.")->type_name("OUT");
  c.add_option("--nodes", o.nodes, "Adds the places of the nodes to --json, for maps: `..._node.tntp`.")
      ->type_name("FILE")
      ->needs(json);
  c.footer(
      "A link is named by its nodes, 3-12; others between the same two are 3-12#2 and so on. Times, flows and lengths have the\n"
      "units of the files. The gap is the share of the total cost that vanished if all took today's shortest way.\n\n"
      "Example:\n  behaviourlinks assign city_net.tntp city_trips.tntp --gap 1e-4 --edit-capacity 3-12=9000\n\n"
      "Exit codes: 0 the gap is reached; 2 bad input; 3 it is not; 130 stopped by Ctrl-C.");
}

void declare_bench(CLI::App& app, BenchOptions& o) {
  CLI::App& c = *app.add_subcommand("bench", "Measures ticks per second and where the time goes.");
  c.add_option("scenes", o.scenes, "Scenes to measure.")->type_name("SCENE");
  c.add_option("--sites", o.sites, "Random volumes in a box, half full; several numbers give several rows.")
      ->type_name("N")
      ->check(CLI::Range(1, 10000000));
  c.add_option("--threads", o.threads, "Threads; several numbers give several rows. Default: 1.")
      ->type_name("K")
      ->check(CLI::Range(1, kMostThreads));
  c.add_option("--repeat", o.repeat, "Measures so often and takes the median. Default: 3, of the solver 5.")
      ->type_name("R")
      ->check(CLI::Range(1, 1000));
  c.add_option("--ticks", o.ticks, "Ticks of one measurement. Default: 20.")->type_name("N")->check(CLI::Range(1, 1000000));
  c.add_option("--json", o.json, "Writes the rows as JSON, times in seconds.")->type_name("FILE");
  auto* solver = c.add_flag("--solver", o.is_solver,
                            "Measures the solver without ticks: cells, fits, drags, growth, and the feedback on a scene.");
  c.add_flag("--quick", o.is_quick, "Of the solver: small sizes only, to see that all runs.")->needs(solver);
  c.add_option("--rows", o.rows, "Of the solver: these rows only.")
      ->type_name("ROWS")
      ->check(CLI::IsMember({"diagram", "wrapped", "fit", "drag", "growth", "complex", "rays", "study"}))
      ->needs(solver);
  c.add_option("--seeds", o.seeds, "Of the solver: cold fits of so many random sets at each fill, the most steps of all.")
      ->type_name("K")
      ->check(CLI::Range(1, 1000000))
      ->needs(solver);
  c.add_option("--chart", o.chart, "Of the solver: writes growth.svg and feedback_newton.svg into a folder.")
      ->type_name("DIR")
      ->needs(solver);
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
    complain(error.what());
    complain("`behaviourlinks " + (chosen.empty() ? "" : chosen.front()->get_name() + " ") + "--help` explains.");
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
  try {
    const int code = bl::cli::run_program(count, arguments);
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
    bl::cli::complain("what was to be printed could not be written: the disk is full, or nobody reads it.");
    return bl::cli::kBadInput;
  } catch (const std::bad_alloc&) { bl::cli::complain("memory ran out."); } catch (const std::exception& error) {
    bl::cli::complain(std::string("this is a defect of the program, please report it: ") + error.what());
  }
  return 1;
}
