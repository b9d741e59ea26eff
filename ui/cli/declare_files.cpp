// Declares the commands that work on files without scenes: cells, fit and assign.
#include "ui/cli/declarations.h"
#include "ui/cli/file_rule.h"

namespace bl::cli {

void add_threads(CLI::App& command, int& threads) {
  command.add_option("--threads", threads, "Threads to compute with; the result does not depend on it. Default: 1.")
      ->type_name("K")
      ->check(CLI::Range(1, 256));
}

namespace {

constexpr const char* kBoundaryHelp =
    "Boundary of a file without one: JSON of a boundary, or of a case that has one; tables need it.";
constexpr const char* kBoundaryFormsHelp =
    "Boundary: {\"planes\": [[a, b, c, d], ...]}         holds a x + b y + c z <= d\n"
    "          {\"vertices\": [[x, y, z], ...]}         their convex hull\n"
    "          {\"plan\": [[x, y], ...], \"holes\": [[[x, y], ...], ...], \"bottom\": z, \"top\": z}\n"
    "          {\"mesh\": {\"vertices\": [[x, y, z], ...], \"triangles\": [[i, j, k], ...]}}\n";

}  // namespace

void declare_cells(CLI::App& app, CellsOptions& o) {
  CLI::App& c = *app.add_subcommand("cells", "Computes the shrink-wrapped power cells of given sites and weights.");
  c.add_option("input", o.input, "Boundary, sites and weights as JSON, or sites and weights as CSV, in m and m2.")
      ->type_name("FILE")
      ->required();
  c.add_option("--json", o.json, "File for the cells, in m2 and m3.")->type_name("OUT")->required();
  c.add_option("--boundary", o.boundary, kBoundaryHelp)->type_name("FILE");
  files_of(c).reads({"input", "--boundary"}).writes("--json", FileKind::figures);
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
  CLI::App& c = *app.add_subcommand("fit", "Finds the weights with which sites get their demanded volumes.");
  c.add_option("input", o.input, "Boundary, sites and demands as JSON, or sites and demands as CSV, in m, m2 and m3.")
      ->type_name("FILE")
      ->required();
  c.add_option("--json", o.json, "File for weights, volumes and the result of each demand.")->type_name("OUT")->required();
  c.add_option("--method", o.method, "newton: all sites together, few steps; feedback: each by its own error. Default: newton.")
      ->type_name("METHOD")
      ->check(CLI::IsMember({"newton", "feedback"}));
  c.add_option("--tolerance", o.tolerance, "Largest relative error that counts as met. Default: 1e-6.")->type_name("T");
  c.add_option("--steps", o.steps, "Largest number of evaluations of all cells. Default: 200.")
      ->type_name("N")
      ->check(CLI::Range(1, 1000000));
  c.add_option("--boundary", o.boundary, kBoundaryHelp)->type_name("FILE");
  files_of(c).reads({"input", "--boundary"}).writes("--json", FileKind::figures);
  add_threads(c, o.threads);
  c.footer(
      "Input:  {\"boundary\": ..., \"sites\": [[x, y, z], ...], \"demands\": [demand, ...]} and, where wanted,\n"
      "         \"weights\": [w, ...] to start from (not given, or 0: the solver starts by itself),\n"
      "         \"groups\": [[i, j, ...], ...] that meet one demand together, \"locked\": [i, ...] that keep their weight;\n"
      "        or {\"cases\": [...]} with many of these\n"
      "        or a .csv with the columns x, y, z, demand or demand_min and demand_max, weight or radius, group, name\n"
      "Demand: 1200 (m3), {\"min\": 900, \"max\": 1200} (either alone will do),\n"
      "        {\"floor_area\": 400 or {\"min\", \"max\"}, \"storey_height\": 3} (m2 and m); for each site, null for a\n"
      "        locked one, or with `groups` for each group; sites in no group keep their weight\n"
      "Form:   volumes are balls; with `form` they stand, as whole storeys on footprints. A footprint is what the power cell "
      "in\n"
      "        plan, the plot (the section of the boundary a little above its bottom) and the form share:\n"
      "        {\"kind\": \"round\" (a disc of radius sqrt(w)), \"block\" (a rectangle) or \"cell\" (no form of its own),\n"
      "         \"storeys\": [n, ...] a whole number for each site, \"storey_height\": 3 (m),\n"
      "         \"setbacks\": [s, ...] (m) how far the plate of each storey from the ground up lies inside the footprint;\n"
      "         above the last one it holds on; not given: 0,\n"
      "         \"depth\": d (m) what lies deeper than d inside a plate is a courtyard; null or not given: none,\n"
      "         \"sides\": what holds at each kind of side, each where wanted: {\"party_walls\": true (set-backs do not hold\n"
      "         towards neighbours), \"border_walls\": true (nor towards the border of the plot), \"border\": d and \"street\": "
      "d\n"
      "         (m) that all storeys keep from the border and from its sides along \"streets\": [{\"points\": [[x, y], ...],\n"
      "         \"reach\": m}], \"wing_depth\": d (m) the depth along walls that touch, \"courtyards\": [s, ...] (m) how far\n"
      "         each storey lies behind the edge that the depth gives the courtyard},\n"
      "         \"angle\": a (degrees) of the first side of a block, counter-clockwise from the x axis; not given: 0,\n"
      "         \"aspect\": r first side / second side of a block, whose half sides are sqrt(w r) and sqrt(w / r); not given: "
      "1}\n"
      "        Demands are then volumes (floor area times storey height) or floor areas of the same storey height.\n" +
      std::string(kBoundaryFormsHelp) +
      "Output: {\"weights\", \"volumes\", \"iterations\", \"evaluations\", \"max_relative_error\",\n         \"status\": "
      "\"met\", \"infeasible\", \"step limit\" or \"cancelled\", \"reasons\": [sentence, ...],\n         \"losses\": "
      "[{\"demand\", \"sites\", \"wanted\", \"had\"}, ...]}; with `form` also \"sites\": [{\"weight\", \"floor_area\",\n"
      "         \"plates\": [area of each storey from the ground up, ...]}, ...] (m2) and \"notes\": [sentence, ...]\n\n"
      "Example:\n  behaviourlinks fit sites.json --json weights.json\n\nExit codes: 0 all demands met; 2 bad input; 3 some are "
      "not met, and the best weights found are written; "
      "130 stopped by Ctrl-C, with everything written.");
}

void declare_assign(CLI::App& app, AssignOptions& o) {
  CLI::App& c =
      *app.add_subcommand("assign", "Finds the user equilibrium of a road network: no trip has a cheaper route (TNTP files).");
  c.add_option("net", o.net, "The network, `..._net.tntp`.")->type_name("NET")->required();
  c.add_option("trips", o.trips, "The trips between its zones, `..._trips.tntp`.")->type_name("TRIPS")->required();
  c.add_option("--gap", o.gap, "Relative gap to reach. Default: 1e-6.")->type_name("G")->check(CLI::Range(0.0, 1.0));
  c.add_option("--iterations", o.iterations, "Largest number of iterations. Default: 1000.")
      ->type_name("N")
      ->check(CLI::Range(0, 1000000));
  c.add_option("--toll-factor", o.toll_factor,
               "Units of time that a unit of toll counts as. Default: the value of the network, or 0.")
      ->type_name("F")
      ->check(CLI::NonNegativeNumber);
  c.add_option("--distance-factor", o.distance_factor,
               "Units of time that a unit of length counts as. Default: the value of the network, or 0.")
      ->type_name("F")
      ->check(CLI::NonNegativeNumber);
  c.add_option("--flows", o.flows, "Compares the flows with those of a file, `..._flow.tntp`.")->type_name("FILE");
  c.add_option("--edit-capacity", o.edit_capacity,
               "Then changes the capacity of a link and finds the new equilibrium from the old one. May be repeated.")
      ->type_name("LINK=VALUE")
      ->expected(1)
      ->take_all();
  c.add_option("--close", o.close, "Then closes a link and finds the new equilibrium. May be repeated.")
      ->type_name("LINK")
      ->expected(1)
      ->take_all();
  c.add_option("--routes", o.routes, "Lists the routes of the trips from one zone to another. May be repeated.")
      ->type_name("FROM-TO")
      ->expected(1)
      ->take_all();
  c.add_option("--reach", o.reach, "Lists what can be reached from a node within a cost, at these flows. May be repeated.")
      ->type_name("NODE=LIMIT")
      ->expected(1)
      ->take_all();
  c.add_option("--repeat", o.repeat, "Number of measurements, of which the median time is printed. Default: 1.")
      ->type_name("R")
      ->check(CLI::Range(1, 100000));
  auto* json = c.add_option("--json", o.json, "File for the figures, and for flow and cost of each link.")->type_name("OUT");
  c.add_option("--nodes", o.nodes, "Adds the places of the nodes to --json, for maps: `..._node.tntp`.")
      ->type_name("FILE")
      ->needs(json);
  files_of(c).reads({"net", "trips", "--flows", "--nodes"}).writes("--json", FileKind::figures);
  c.footer(
      "A link is named by its nodes, 3-12; others between the same two are 3-12#2 and so on. Times, flows and lengths have "
      "the\nunits of the files. The gap is the share of the total cost that would be saved if each trip took its cheapest route "
      "now.\n\nExample:\n  behaviourlinks assign city_net.tntp city_trips.tntp --gap 1e-4 --edit-capacity 3-12=9000\n\nExit "
      "codes: 0 the gap is reached; 2 bad input; 3 it is not; 130 stopped by Ctrl-C.");
}

}  // namespace bl::cli
