// The list of tables: which figures of which typification are shown where.
#include "core/report/figure_tables.h"

namespace bl::report {

namespace {

constexpr Shown kAll = Shown::everywhere, kFiles = Shown::files, kJson = Shown::json;

// Building regulations say FSI, GSI and OSR; everywhere else names are those that people read in the window.
FigureTable plots_table() {
  return {"plots",
          "plot",
          "Plots",
          "Built floor and ground against what the rules of each plot allow. FSI: floor area to plot area; GSI: built ground to "
          "plot "
          "area; OSR: open space to floor area; storeys: floor area to built ground. Plot area is gross land, with streets and "
          "water in it; buildings that stay count neither as floor nor as built ground.",
          {{"area", "Area"},
           {"count", "Volumes"},
           {"floor_area", "Floor area"},
           {"footprint", "Built ground"},
           {"fsi", "FSI"},
           {"fsi_max", "allowed"},
           {"gsi", "GSI"},
           {"gsi_max", "allowed"},
           {"osr", "OSR"},
           {"layers", "Storeys"},
           {"top", "Height"},
           {"height_max", "allowed"},
           {"overshoot", "Overshoot", kAll, true},
           {"floor_overshoot", "", kFiles},
           {"footprint_overshoot", "", kFiles},
           {"height_overshoot", "", kFiles},
           {"setback_overshoot", "", kFiles},
           {"message", "Remark"},
           {"polygon", "", kJson}},
          {}};
}

FigureTable streets_table() {
  return {
      "streets",
      "street",
      "Streets",
      "Flows of the hour that the network looks at. Load: flow to open capacity, the larger of both directions; above 100 % the "
      "street is overloaded.",
      {{"used_length", "Length"},
       {"lanes", "Lanes"},
       {"open", "Open", kAll, true},
       {"flow_forth", "Flow forth"},
       {"flow_back", "Flow back"},
       {"volume_over_capacity", "Load", kAll, true},
       {"delay", "Delay"},
       {"time_forth", "", kFiles},
       {"time_back", "", kFiles},
       {"capacity_per_lane", "", kFiles},
       {"speed", "", kFiles},
       {"toll", "", kFiles},
       {"reason", "Remark"},
       {"start", "", kJson},
       {"end", "", kJson},
       {"course", "", kJson}},
      {}};
}

FigureTable junctions_table() {
  return {"junctions",
          "junction",
          "Junctions",
          "Vehicles that arrive by all streets together, and the largest load of these streets.",
          {{"streets", "Streets"}, {"flow", "Flow"}, {"volume_over_capacity", "Largest load", kAll, true}},
          {},
          "traffic_network"};
}

FigureTable zones_table() {
  return {"zones",
          "traffic_zone",
          "Traffic zones",
          "Where trips begin and end: volumes, and places beyond the site.",
          {{"trips_out", "Trips out"},
           {"trips_in", "Trips in"},
           {"trips_served", "Served"},
           {"trips_lost", "Lost"},
           {"trips_ending", "Ending"},
           {"mean_travel_time", "Mean time"},
           {"accessibility", "", kFiles},
           {"reason", "Remark"}},
          {}};
}

FigureTable networks_table() {
  return {"networks",
          "traffic_network",
          "Traffic as a whole",
          "",
          {{"trips", "Trips"},
           {"trips_lost", "Lost"},
           {"mean_travel_time", "Mean time"},
           {"total_time", "Time of all"},
           {"largest_load", "Largest load", kAll, true},
           {"relative_gap", "", kFiles},
           {"trips_missing", "", kFiles},
           {"message", "Remark"}},
          {}};
}

FigureTable sun_table() {
  return {
      "sun",
      "shadow_receiver",
      "Direct sun",
      "Hours of sun per day of the period studied, on the points of each receiver. Without casters: what it would be if nothing "
      "stood around.",
      {{"area", "Area"},
       {"required_sun", "Required"},
       {"required_share", "On a share of", kAll, true},
       {"sun_of_share", "That share has"},
       {"sun_min", "Least"},
       {"sun_mean", "Mean"},
       {"sun_max", "Most"},
       {"sun_possible", "Without casters"},
       {"share_met", "Area that has enough", kAll, true},
       {"deficit", "Short by"}},
      {{"sun_map", "map"}, {"sun_losses", "losses"}}};
}

FigureTable sun_studies_table() {
  return {"sun_studies",
          "sun_study",
          "Sun studies",
          "",
          {{"caster_count", "Casters"},
           {"receiver_count", "Receivers"},
           {"area", "Area"},
           {"sun_mean", "Mean"},
           {"sun_possible", "Without casters"},
           {"share_met", "Area that has enough", kAll, true},
           {"moment_count", "", kFiles},
           {"message", "Remark"}},
          {}};
}

FigureTable buildings_table() {
  return {"buildings",
          "existing_building",
          "Existing buildings",
          "What stands around the site, and stays.",
          {{"use", "Use"},
           {"footprint", "Footprint"},
           {"floor_area", "Floor area"},
           {"base", "", kFiles},
           {"top", "Top"},
           {"volume", "Volume"},
           {"is_assumed", "Height assumed"},
           {"height_source", "", kFiles},
           {"origin", "", kFiles},
           {"outline", "", kJson}},
          {{"building_courts", "holes"}}};
}

FigureTable terrain_table() {
  return {"terrain",
          "terrain",
          "Terrain",
          "",
          {{"width", "Width"},
           {"depth", "Depth"},
           {"cell", "Cell"},
           {"minimum", "Lowest"},
           {"mean", "Mean"},
           {"maximum", "Highest"},
           {"without_height", "Cells without height"},
           {"west", "", kFiles},
           {"north", "", kFiles},
           {"origin", "Origin"}},
          {}};
}

FigureTable layers_table() {
  return {"layers",
          "data_layer",
          "Data layers",
          "Urban data under the site.",
          {{"quantity", "Quantity"},
           {"unit", "Unit"},
           {"count", "Points"},
           {"minimum", "Least"},
           {"mean", "Mean"},
           {"maximum", "Most"},
           {"sum", "", kFiles},
           {"source", "Source"},
           {"licence", "Licence"}},
          {}};
}

FigureTable facade_totals_table() {
  return {"facade_totals",
          "facade",
          "",
          "",
          {{"style_in_force", "", kFiles},
           {"facade_area", "", kFiles},
           {"glazed_area", "", kFiles},
           {"opaque_area", "", kFiles},
           {"roof_area", "", kFiles},
           {"shared_area", "", kFiles},
           {"glazing_ratio", "", kFiles},
           {"panels", "", kFiles},
           {"cost", "", kFiles},
           {"message", "", kFiles}},
          {{"facade_sides", "by_orientation"}, {"facade_storeys", "by_storey"}}};
}

FigureTable use_sums_table() {
  return {
      "use_sums",
      "use",
      "What the uses bring and need",
      "By the floor areas of the volumes and the figures of their uses for 100 m\xC2\xB2. Trips are by day, both ways together.",
      {{"use", "Use"},
       {"count", "Volumes"},
       {"floor_area", "Floor area"},
       {"people", "People"},
       {"parking", "Parking places"},
       {"trips", "Trips"},
       {"cost", "Cost"},
       {"value", "Value"},
       {"source", "Source of the figures"},
       {"people_per_100", "", kFiles},
       {"parking_per_100", "", kFiles},
       {"trips_per_100", "", kFiles},
       {"cost_per_area", "", kFiles},
       {"value_per_area", "", kFiles}},
      {}};
}

FigureTable use_figures_table() {
  return {"use_figures",
          "use_figures",
          "",
          "",
          {{"use", "", kFiles},
           {"people", "", kFiles},
           {"parking", "", kFiles},
           {"trips", "", kFiles},
           {"car_share", "", kFiles},
           {"out_share", "", kFiles},
           {"cost", "", kFiles},
           {"value", "", kFiles},
           {"least_sun", "", kFiles},
           {"most_noise", "", kFiles},
           {"message", "", kFiles}},
          {}};
}

FigureTable statistics_table() {
  return {"statistics",
          "statistics",
          "Statistics",
          "",
          {{"port", "Of"}, {"count", "Nodes"}, {"sum", "Sum"}, {"mean", "Mean"}, {"minimum", "Least"}, {"maximum", "Most"}},
          {}};
}

}  // namespace

std::span<const FigureTable> figure_tables() {
  static const std::vector<FigureTable> tables{plots_table(),       streets_table(),   junctions_table(),     zones_table(),
                                               networks_table(),    sun_table(),       sun_studies_table(),   buildings_table(),
                                               terrain_table(),     layers_table(),    facade_totals_table(), use_sums_table(),
                                               use_figures_table(), statistics_table()};
  return tables;
}

}  // namespace bl::report
