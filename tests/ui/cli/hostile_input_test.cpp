// Bad and hostile input of `cells` and `fit`, as a table: each kind has its exit code and a sentence with a place.
#include <algorithm>
#include <cstdlib>

#include <gtest/gtest.h>

#include "tests/ui/cli/program.h"

namespace bl::test {

namespace {

struct Hostile {
  std::string name, command, text;
  int code;
  std::string said;                       // a part of what standard error says
  std::string file = "i.json";            // what the text is called
  std::vector<std::string> options = {};  // further arguments
  friend std::ostream& operator<<(std::ostream& out, const Hostile& row) { return out << row.command << " " << row.name; }
};

const std::string kBox = R"("boundary": {"plan": [[0,0],[10,0],[10,10],[0,10]], "bottom": 0, "top": 10})";
const std::string kTwo = "[[2,5,5],[8,5,5]]";

std::string cells_case(const std::string& sites, const std::string& weights) {
  return "{" + kBox + ", \"sites\": " + sites + ", \"weights\": " + weights + "}";
}
std::string fit_case(const std::string& sites, const std::string& demands, const std::string& more = "") {
  return "{" + kBox + ", \"sites\": " + sites + ", \"demands\": " + demands + (more.empty() ? "" : ", " + more) + "}";
}
std::string bounded_by(const std::string& boundary) {
  return "{\"boundary\": " + boundary + ", \"sites\": [[5,5,5]], \"weights\": [1], \"demands\": [10]}";
}

std::vector<Hostile> files() {
  const std::string good = fit_case(kTwo, "[100, 100]");
  std::vector<Hostile> rows{
      {"empty", "", "", 2, "i.json: the file is empty: it needs a JSON object"},
      {"only_blanks", "", " \n\n ", 2, "i.json: the file is empty"},
      {"truncated", "", good.substr(0, good.size() / 2), 2, "the file is cut off"},
      {"not_json", "", "volumes = 3", 2, "i.json: line 1, column 1: this is not JSON"},
      {"xml", "", "<?xml version=\"1.0\"?><sites/>", 2, "this is not JSON"},
      {"utf16", "", std::string("\xFF\xFE{\0}\0", 6), 2, "A zero byte stands here"},
      {"no_utf8", "", "{\"note\": \"\xC3(\"}", 2, "this is not JSON"},
      {"zero_bytes", "", std::string(64, '\0'), 2, "A zero byte stands here"},
      {"two_values", "", good + good, 2, "this is not JSON"},
      {"trailing_comma", "", "{\"sites\": [[1,2,3],]}", 2,
       "line 1, column 20: this is not JSON (no comments, no trailing commas"},
      {"nan", "", cells_case("[[NaN,1,1]]", "[1]"), 2, "line 1, column "},
      {"infinity", "", cells_case("[[1,1,-Infinity]]", "[1]"), 2, "line 1, column "},
      {"beyond_a_double", "", cells_case("[[1,1,1e400]]", "[1]"), 2, "a number is too large for a double"},
      {"too_deep", "", std::string(100000, '['), 2, "nested deeper than 64 levels"},
      {"key_twice", "", R"({"sites": [], "sites": [], "weights": []})", 2, "the key \"sites\" stands twice in one object"},
      {"top_is_a_list", "", "[[1,2,3]]", 2, "expects {\"boundary\": ..., \"sites\""},
      {"top_is_a_text", "", "\"sites\"", 2, "found \"sites\""},
      {"top_is_null", "", "null", 2, "found null"},
      {"cases_are_no_list", "", R"({"cases": {"a": 1}})", 2, "cases: expects a list of cases"},
      {"case_is_no_object", "", R"({"cases": [17]})", 2, "cases/0: expects {\"boundary\""},
      {"a_table_called_otherwise", "", "x,y,z,weight\n1,2,3,4\n", 2, "a table needs a name that ends in .csv"}};
  std::vector<Hostile> both;
  for (const Hostile& row : rows)
    for (const char* command : {"cells", "fit"}) {
      both.push_back(row);
      both.back().command = command;
    }
  both.push_back({"missing", "cells", "", 2, "nowhere.json: cannot be opened: No such file", "nowhere.json"});
  both.push_back({"missing", "fit", "", 2, "nowhere.json: cannot be opened: No such file", "nowhere.json"});
  both.push_back({"is_a_folder", "fit", "", 2, "/: is a folder, not a file", "/"});
  return both;
}

std::vector<Hostile> boundaries() {
  std::vector<Hostile> both;
  const std::vector<std::tuple<const char*, const char*, const char*>> rows{
      {"no_object", "[0, 1]", "boundary: expects {\"planes\""},
      {"no_form", "{}", "boundary: expects `planes`, `vertices`, `plan` or `mesh`"},
      {"planes_are_no_list", R"({"planes": 6})", "boundary/planes: expects a list, found 6"},
      {"plane_of_three", R"({"planes": [[1,0,0]]})", "boundary/planes/0: expects a plane [a, b, c, d], found [1, 0, 0]"},
      {"text_in_a_plane", R"({"planes": [[1,0,0,"x"]]})", "boundary/planes/0/3: expects a finite number, found \"x\""},
      {"few_planes", R"({"planes": [[1,0,0,1],[-1,0,0,1]]})", "boundary/planes: a boundary needs at least 4 planes, 2 given"},
      {"unbounded", R"({"planes": [[1,0,0,1],[-1,0,0,1],[0,1,0,1],[0,-1,0,1],[0,0,1,1]]})", "the boundary planes do not close"},
      {"contradicting", R"({"planes": [[1,0,0,1],[-1,0,0,-2],[0,1,0,1],[0,-1,0,1],[0,0,1,1],[0,0,-1,1]]})",
       "the boundary planes leave no space: plane 1"},
      {"flat_planes", R"({"planes": [[1,0,0,0],[-1,0,0,0],[0,1,0,1],[0,-1,0,1],[0,0,1,1],[0,0,-1,1]]})", "boundary/planes: "},
      {"plane_without_direction", R"({"planes": [[0,0,0,1],[-1,0,0,1],[0,1,0,1],[0,-1,0,1],[0,0,1,1]]})",
       "boundary plane 0 has no direction"},
      {"three_vertices", R"({"vertices": [[0,0,0],[1,0,0],[0,1,0]]})", "boundary/vertices: a boundary needs at least 4 points"},
      {"flat_vertices", R"({"vertices": [[0,0,0],[1,0,0],[0,1,0],[1,1,0]]})", "all boundary points lie in one plane"},
      {"far_vertices", R"({"vertices": [[0,0,0],[1e9,0,0],[0,1,0],[0,0,1]]})", "lies more than 1e8 m from the origin"},
      {"vertex_of_two", R"({"vertices": [[0,0]]})", "boundary/vertices/0: expects a point [x, y, z], found [0, 0]"},
      {"plan_without_heights", R"({"plan": [[0,0],[1,0],[0,1]]})", "boundary/bottom: `bottom` is missing"},
      {"plan_upside_down", R"({"plan": [[0,0],[1,0],[0,1]], "bottom": 3, "top": 1})", "has to lie above its bottom"},
      {"plan_of_two", R"({"plan": [[0,0],[1,0]], "bottom": 0, "top": 1})", "at least 3 corners"},
      {"plan_that_crosses", R"({"plan": [[0,0],[1,1],[1,0],[0,1]], "bottom": 0, "top": 1})", "cross"},
      {"corner_of_three", R"({"plan": [[0,0,0],[1,0,0]], "bottom": 0, "top": 1})", "plan/0: expects a corner [x, y]"},
      {"holes_are_no_list", R"({"plan": [[0,0],[9,0],[0,9]], "holes": 1, "bottom": 0, "top": 1})",
       "boundary/holes: expects a list, found 1"},
      {"hole_of_two", R"({"plan": [[0,0],[9,0],[0,9]], "holes": [[[1,1],[2,2]]], "bottom": 0, "top": 1})", "boundary/holes/0: "},
      {"hole_beyond_the_plan", R"({"plan": [[0,0],[9,0],[0,9]], "holes": [[[20,20],[21,20],[20,21]]], "bottom": 0, "top": 1})",
       "boundary/holes/0: "},
      {"hole_across_the_plan", R"({"plan": [[0,0],[9,0],[0,9]], "holes": [[[1,1],[12,1],[1,2]]], "bottom": 0, "top": 1})",
       "boundary/holes/0: "},
      {"mesh_is_no_object", R"({"mesh": []})", "boundary/mesh: expects {\"vertices\""},
      {"mesh_names_no_vertex", R"({"mesh": {"vertices": [[0,0,0],[1,0,0],[0,1,0]], "triangles": [[0,1,9]]}})",
       "boundary/mesh/triangles/0/2: there is no vertex 9: they are numbered from 0 to 2"},
      {"open_mesh",
       R"({"mesh": {"vertices": [[0,0,0],[1,0,0],[0,1,0],[0,0,1]], "triangles": [[0,2,1],[0,1,3],[1,2,3],[0,1,2]]}})", "mesh"}};
  for (const auto& [name, boundary, said] : rows)
    for (const char* command : {"cells", "fit"}) both.push_back({name, command, bounded_by(boundary), 2, said});
  return both;
}

std::vector<Hostile> sites() {
  return {
      {"no_boundary", "cells", R"({"sites": [], "weights": []})", 2, "boundary: `boundary` is missing: put it into the case"},
      {"no_sites", "cells", "{" + kBox + R"(, "weights": []})", 2, "sites: `sites` is missing"},
      {"sites_are_no_list", "fit", fit_case("7", "[1]"), 2, "sites: expects a list, found 7"},
      {"site_of_two", "fit", fit_case("[[1,2]]", "[1]"), 2, "sites/0: expects a point [x, y, z], found [1, 2]"},
      {"text_for_a_number", "cells", cells_case("[[1,\"2\",3]]", "[1]"), 2, "sites/0/1: expects a finite number, found \"2\""},
      {"null_for_a_number", "fit", fit_case("[[1,null,3]]", "[1]"), 2, "sites/0/1: expects a finite number, found null"},
      {"far_site", "cells", cells_case("[[1e300,1,1]]", "[1]"), 2, "sites/0: lies more than 1e8 m from the origin"},
      {"far_site", "fit", fit_case("[[1,1,-1e12]]", "[1]"), 2, "sites/0: lies more than 1e8 m from the origin"},
      {"weight_missing", "cells", cells_case(kTwo, "[1]"), 2, "weights: there are 2 sites, but 1 weight"},
      {"weights_missing", "cells", "{" + kBox + ", \"sites\": " + kTwo + "}", 2, "weights: `weights` is missing"},
      {"one_weight_more", "fit", fit_case(kTwo, "[1, 1]", "\"weights\": [1,2,3]"), 2, "there are 2 sites, but 3 weights"},
      {"weight_as_text", "cells", cells_case("[[1,1,1]]", "[\"4 m2\"]"), 2, "weights/0: expects a finite number, found \"4 m2\""},
      {"huge_weight", "cells", cells_case("[[1,1,1]]", "[1e19]"), 2, "weights/0: a weight is at most 1e18 m²"},
      {"huge_weight", "fit", fit_case(kTwo, "[1, 1]", "\"weights\": [1, 1e300]"), 2, "weights/1: a weight is at most 1e18 m²"},
      {"no_site_at_all", "fit", fit_case("[]", "[]"), 2, "sites: there are no sites: a fit needs at least one"},
      {"misspelt_list", "fit", fit_case(kTwo, "[1, 1]", "\"weigths\": [1, 2]"), 2,
       "weigths: unknown field, did you mean `weights`?"},
      {"bad_case_of_many", "fit", "{\"cases\": [" + fit_case(kTwo, "[1, 1]") + ", " + fit_case(kTwo, "[1, true]") + "]}", 2,
       "i.json: cases/1/demands/1: expects a volume in m³"}};
}

std::vector<Hostile> demands() {
  return {
      {"demands_missing", "fit", cells_case(kTwo, "[1, 1]"), 2, "demands: `demands` is missing"},
      {"demands_are_no_list", "fit", fit_case(kTwo, "{\"a\": 1}"), 2, "demands: expects a list, found {\"a\": 1}"},
      {"demand_missing", "fit", fit_case(kTwo, "[1]"), 2, "demands: expects one demand for each site: 2 sites, 1 demand"},
      {"demand_is_text", "fit", fit_case(kTwo, "[1, \"5 m3\"]"), 2, "demands/1: expects a volume in m³ such as 1200"},
      {"negative_demand", "fit", fit_case(kTwo, "[1, -2]"), 2, "demands/1: a demand is 0 or more, found -2"},
      {"absurd_demand", "fit", fit_case(kTwo, "[1, 1e300]"), 2, "demands/1: no boundary is that large (1e+300): check the unit"},
      {"min_over_max", "fit", fit_case(kTwo, "[1, {\"min\": 9, \"max\": 3}]"), 2,
       "demands/1: the minimum 9 is more than the maximum 3"},
      {"negative_min", "fit", fit_case(kTwo, "[1, {\"min\": -9}]"), 2, "demands/1/min: a demand is 0 or more, found -9"},
      {"no_bounds", "fit", fit_case(kTwo, "[1, {}]"), 2, "demands/1: has neither `min` nor `max`"},
      {"misspelt_bound", "fit", fit_case(kTwo, "[1, {\"mim\": 3}]"), 2, "demands/1/mim: unknown field, did you mean `min`?"},
      {"text_for_a_bound", "fit", fit_case(kTwo, "[1, {\"max\": \"3\"}]"), 2,
       "demands/1/max: expects a finite number, found \"3\""},
      {"storey_without_area", "fit", fit_case(kTwo, "[1, {\"storey_height\": 3}]"), 2,
       "demands/1/floor_area: `floor_area` is missing"},
      {"storey_of_nothing", "fit", fit_case(kTwo, "[1, {\"floor_area\": 9, \"storey_height\": 0}]"), 2,
       "demands/1/storey_height: must be a height in m"},
      {"storey_of_a_micron", "fit", fit_case(kTwo, "[1, {\"floor_area\": 9, \"storey_height\": 1e-6}]"), 2,
       "at most 10000 storeys"},
      {"area_over_its_max", "fit", fit_case(kTwo, "[1, {\"floor_area\": {\"min\": 9, \"max\": 8}}]"), 2,
       "demands/1/floor_area: the minimum 9 is more than the maximum 8"},
      {"null_that_is_not_locked", "fit", fit_case(kTwo, "[1, null]"), 2,
       "demands/1: null stands for a site that keeps its weight"},
      {"all_locked", "fit", fit_case(kTwo, "[null, null]", "\"locked\": [0, 1], \"weights\": [1, 1]"), 2,
       "there is no demand to meet"},
      {"locked_without_weight", "fit", fit_case(kTwo, "[1, null]", "\"locked\": [1]"), 2,
       "weights: `weights` is missing: site 1 has no demand and keeps its weight"},
      {"locked_out_of_range", "fit", fit_case(kTwo, "[1, 1]", "\"locked\": [2]"), 2,
       "locked/0: there is no site 2: they are numbered from 0 to 1"},
      {"locked_twice", "fit", fit_case(kTwo, "[1, 1]", "\"locked\": [1, 1]"), 2, "locked: site 1 stands there twice"},
      {"locked_is_true", "fit", fit_case(kTwo, "[1, 1]", "\"locked\": true"), 2,
       "locked: expects a list of site numbers [i, j, ...], found true"},
      {"groups_are_no_list", "fit", fit_case(kTwo, "[1]", "\"groups\": 2"), 2, "groups: expects a list, found 2"},
      {"group_is_a_number", "fit", fit_case(kTwo, "[1]", "\"groups\": [0]"), 2, "groups/0: expects a list of site numbers"},
      {"empty_group", "fit", fit_case(kTwo, "[1, 1]", "\"groups\": [[0, 1], []]"), 2, "groups/1: the group is empty"},
      {"site_in_two_groups", "fit", fit_case(kTwo, "[1, 1]", "\"groups\": [[0, 1], [1]]"), 2,
       "groups/1: site 1 is in group 0 already"},
      {"site_twice_in_a_group", "fit", fit_case(kTwo, "[1]", "\"groups\": [[0, 0]]"), 2, "groups/0: site 0 stands there twice"},
      {"group_out_of_range", "fit", fit_case(kTwo, "[1]", "\"groups\": [[0, 7]]"), 2, "groups/0/1: there is no site 7"},
      {"negative_index", "fit", fit_case(kTwo, "[1]", "\"groups\": [[-1]]"), 2, "groups/0/0: there is no site -1"},
      {"half_an_index", "fit", fit_case(kTwo, "[1]", "\"groups\": [[0.5]]"), 2,
       "groups/0/0: expects a whole site number, found 0.5"},
      {"huge_index", "fit", fit_case(kTwo, "[1]", "\"groups\": [[4294967296]]"), 2, "groups/0/0: there is no site 4294967296"},
      {"locked_in_a_group", "fit", fit_case(kTwo, "[1]", "\"groups\": [[0, 1]], \"locked\": [1]"), 2,
       "groups/0: site 1 is locked"},
      {"demand_for_each_group", "fit", fit_case(kTwo, "[1, 1]", "\"groups\": [[0, 1]]"), 2,
       "one demand for each group: 1 group, 2 demands"},
      {"null_for_a_group", "fit", fit_case(kTwo, "[null]", "\"groups\": [[0, 1]]"), 2, "demands/0: expects a volume in m³"},
      {"more_than_the_boundary", "fit", fit_case(kTwo, "[900, 900]"), 3, "i.json: "},
      {"least_more_than_the_boundary", "fit", fit_case(kTwo, "[{\"min\": 1500}, 1]"), 3, "i.json: "},
      {"more_than_the_boundary_in_a_list", "fit", "{\"cases\": [" + fit_case(kTwo, "[900, 900]") + "]}", 3, "i.json: cases/0: "},
      {"coincident_sites", "fit", fit_case("[[5,5,5],[5,5,5]]", "[100, 100]"), 3, "i.json: "},
      {"floor_area_beyond_the_boundary", "fit", fit_case(kTwo, "[{\"floor_area\": 9000}, 1]"), 3, "i.json: "},
      {"one_step_is_not_enough",
       "fit",
       fit_case(kTwo, "[10, 700]"),
       3,
       "i.json: not met after 1 evaluation",
       "i.json",
       {"--steps", "1"}}};
}

std::vector<Hostile> tables() {
  const std::vector<std::string> box{"--boundary", "box.json"};
  const auto row = [&](const char* name, const std::string& text, int code, const char* said) {
    return Hostile{name, "fit", text, code, said, "t.csv", box};
  };
  const std::string head = "x,y,z,demand\n";
  std::vector<Hostile> rows{
      row("empty_table", "", 2, "t.csv: line 1: The table is empty: it needs a header"),
      row("only_a_header", head, 2, "t.csv: line 1: there are no sites below the header"),
      row("no_header", "1,2,3,40\n2,2,3,40\n", 2, "t.csv: line 1: The first line holds numbers: put a header above it"),
      row("unknown_column", "x,y,z,demand,colour\n1,2,3,4,red\n", 2,
          "line 1, column 5: `colour` is no column of sites; accepted are x, y, z, weight"),
      row("misspelt_column", "x,y,z,demmand\n1,2,3,4\n", 2, "`demmand` is no column of sites (did you mean `demand`?)"),
      row("column_twice", "x,y,z,demand,volume\n1,2,3,4,5\n", 2, "The columns `demand` and `volume` are both read as demand"),
      row("no_z", "x,y,demand\n1,2,3\n", 2, "line 1: There is no column z among `x`, `y`, `demand`; accepted are"),
      row("no_demand_column", "x,y,z\n1,2,3\n", 2, "line 1: there is no column demand, demand_min or demand_max"),
      row("weight_and_radius", "x,y,z,demand,weight,radius\n1,2,3,4,5,6\n", 2, "Both weight and radius are given"),
      row("wrong_unit", "x,y,z,demand [m2]\n1,2,3,4\n", 2, "The unit `m2` is not read for demand: give it in m3"),
      row("ragged_rows", head + "1,2,3,4\n1,2,3,4,5\n", 2, "line 3: The row has 5 fields, the header 4"),
      row("short_row", head + "1,2\n", 2, "line 2, column 3 `z`: The site has no z"),
      row("word_for_a_number", head + "1,two,3,4\n", 2, "line 2, column 2 `y`: `two` is not understood: write a length"),
      row("nan_in_a_table", head + "1,nan,3,4\n", 2, "line 2, column 2 `y`: `nan` is not understood"),
      row("infinity_in_a_table", head + "1,1e999,3,4\n", 2, "line 2, column 2 `y`: `1e999` is not understood"),
      row("decimal_commas_between_commas", head + "1,5,2,5,3,5,4,5\n", 2,
          "write numbers of rows split by commas with decimal points"),
      row("changing_decimal_marks", "x;y;z;demand\n1,5;2;3;4\n1.5;2;3;4\n", 2, "The decimal mark changes"),
      row("fraction_or_thousands", "x;y;z;demand\n1.234;2;3;4\n", 2, "`1.234` may be a fraction or thousands"),
      row("open_quote", head + "\"1,2,3,4\n", 2, "line 2: A double quote opens a field in this record and is never closed"),
      row("table_in_utf16", std::string("\xFF\xFEx\0,\0", 6), 2, "byte 0: This is no CSV table but text in UTF-16"),
      row("table_in_no_encoding", "x,y,z,demand,name\n1,2,3,4,\x81\n", 2, "line 2: The text is neither UTF-8 nor Windows-1252"),
      row("binary_table", std::string(64, '\0'), 2, "byte 0: This is no CSV table but binary data"),
      row("negative_demand_in_a_table", head + "1,2,3,-4\n", 2, "t.csv: line 2: a demand is 0 or more, found -4"),
      row("negative_radius", "x,y,z,radius,demand\n1,2,3,-1,4\n", 2, "line 2, column 4 `radius`: A radius is 0 m or more"),
      row("min_over_max_in_a_table", "x,y,z,demand_min,demand_max\n1,2,3,9,3\n", 2,
          "line 2: the minimum 9 is more than the maximum 3"),
      row("demand_and_bounds", "x,y,z,demand,demand_min\n1,2,3,9,3\n", 2, "line 2: has both a demand and bounds of it"),
      row("neither_demand_nor_weight", head + "1,2,3,4\n1,2,4,\n", 2, "line 3: has neither a demand nor a weight to keep"),
      row("group_of_two_demands", "x,y,z,demand,group\n1,2,3,4,a\n2,2,3,5,a\n", 2,
          "line 3: group `a` has another demand in line 2"),
      row("group_without_demand", "x,y,z,demand,group\n1,2,3,,a\n2,2,3,5,b\n", 2, "line 2: no row of group `a` has its demand"),
      row("far_site_in_a_table", head + "1e12,2,3,4\n", 2, "t.csv: line 2: lies more than 1e8 m from the origin"),
      row("huge_weight_in_a_table", "x,y,z,weight,demand\n1,2,3,1e20,4\n", 2, "line 2: a weight is at most 1e18 m²"),
      row("more_than_the_boundary_in_a_table", head + "2,5,5,900\n8,5,5,900\n", 3, "t.csv: ")};
  rows.push_back({"no_boundary_for_a_table", "fit", head + "1,2,3,4\n", 2,
                  "t.csv: a table has no boundary: give one as JSON by --boundary FILE", "t.csv"});
  rows.push_back({"no_boundary_for_a_table", "cells", "x,y,z,w\n1,2,3,4\n", 2, "t.csv: a table has no boundary", "t.csv"});
  rows.push_back({"no_weight_column", "cells", "x,y,z\n1,2,3\n", 2, "line 1: there is no column weight or radius", "t.csv", box});
  rows.push_back(
      {"row_without_weight", "cells", "x,y,z,w\n1,2,3,4\n1,2,4,\n", 2, "line 3: the site has no weight", "t.csv", box});
  return rows;
}

std::vector<Hostile> options() {
  const std::string good = fit_case(kTwo, "[100, 100]");
  const auto row = [&](const char* name, std::vector<std::string> arguments, const char* said) {
    return Hostile{name, "fit", good, 2, said, "i.json", std::move(arguments)};
  };
  return {row("tolerance_of_nothing", {"--tolerance", "0"}, "--tolerance: must be more than 0 and less than 1"),
          row("negative_tolerance", {"--tolerance=-1e-6"}, "--tolerance: must be more than 0 and less than 1"),
          row("tolerance_nan", {"--tolerance", "nan"}, "--tolerance: must be more than 0 and less than 1"),
          row("tolerance_infinite", {"--tolerance", "inf"}, "--tolerance: must be more than 0 and less than 1"),
          row("tolerance_is_a_word", {"--tolerance", "fine"}, "--tolerance"),
          row("no_threads", {"--threads", "0"}, "--threads"),
          row("too_many_threads", {"--threads", "100000"}, "--threads"),
          row("no_steps", {"--steps", "0"}, "--steps"),
          row("negative_steps", {"--steps=-3"}, "--steps"),
          row("unknown_method", {"--method", "newtn"}, "--method"),
          row("unknown_option", {"--tolerence", "1e-3"}, "--tolerence"),
          row("boundary_twice", {"--boundary", "box.json"}, "boundary: is given here and by --boundary: keep one of them"),
          row("boundary_that_is_not_there", {"--boundary", "nowhere.json"}, "nowhere.json: cannot be opened"),
          row("boundary_of_many_cases", {"--boundary", "many.json"},
              "many.json: cases: holds a list of cases instead of one boundary"),
          row("boundary_that_is_none", {"--boundary", "none.json"}, "none.json: expects `planes`, `vertices`, `plan` or `mesh`"),
          row("output_without_folder", {"--json", "no/where/o.json"},
              "--json: no/where/o.json: cannot be written: there is no folder no/where"),
          row("output_is_the_input", {"--json", "i.json"}, "--json: i.json: is read as FILE; choose another file"),
          row("output_is_a_folder", {"--json", "/"}, "/: is a folder, not a file"),
          row("output_on_a_full_disk", {"--json", "/dev/full"}, "/dev/full: cannot be written: No space left on device")};
}

class HostileInput : public testing::TestWithParam<Hostile> {};

// With BL_SENTENCES=FILE the table of kinds and sentences is written there, row by row.
void keep(const Hostile& row, const Outcome& outcome) {
  const char* file = std::getenv("BL_SENTENCES");
  if (file == nullptr) return;
  std::ofstream(file, std::ios::app) << row.command << "\t" << row.name << "\t" << outcome.code << "\t"
                                     << outcome.err.substr(0, outcome.err.find('\n')) << "\n";
}

TEST_P(HostileInput, HasACodeAndASentence) {
  const Hostile& row = GetParam();
  const Workplace place;
  const bool is_written = row.file != "/" && row.file != "nowhere.json";
  if (is_written) place.write(row.file, row.text);
  place.write("box.json", "{" + kBox + "}");
  place.write("many.json", "{\"cases\": [{" + kBox + "}]}");
  place.write("none.json", "{}");
  std::vector<std::string> arguments{row.command, row.file};
  arguments.insert(arguments.end(), row.options.begin(), row.options.end());
  if (std::find(arguments.begin(), arguments.end(), "--json") == arguments.end())
    arguments.insert(arguments.end(), {"--json", "o.json"});
  const Outcome outcome = place.run(arguments);
  keep(row, outcome);
  EXPECT_EQ(outcome.code, row.code) << outcome.out << outcome.err;
  EXPECT_NE(outcome.err.find(row.said), std::string::npos) << outcome.err;
  // One sentence; what is wrong on the command line is followed by a pointer to --help, what cannot be met by who goes without.
  const bool is_usage = outcome.err.find("--help` explains") != std::string::npos;
  const auto lines = std::count(outcome.err.begin(), outcome.err.end(), '\n');
  if (row.code == 3) {
    EXPECT_GE(lines, 1) << outcome.err;
  } else {
    EXPECT_EQ(lines, is_usage ? 2 : 1) << outcome.err;
  }
  EXPECT_EQ(std::filesystem::exists(place.path("o.json")), row.code != 2) << "bad input leaves no output, all else does";
  if (is_written) { EXPECT_EQ(place.text(row.file), row.text) << "the input was touched"; }
}

std::string test_name(const testing::TestParamInfo<Hostile>& info) { return info.param.command + "_" + info.param.name; }

INSTANTIATE_TEST_SUITE_P(Files, HostileInput, testing::ValuesIn(files()), test_name);
INSTANTIATE_TEST_SUITE_P(Boundaries, HostileInput, testing::ValuesIn(boundaries()), test_name);
INSTANTIATE_TEST_SUITE_P(Sites, HostileInput, testing::ValuesIn(sites()), test_name);
INSTANTIATE_TEST_SUITE_P(Demands, HostileInput, testing::ValuesIn(demands()), test_name);
INSTANTIATE_TEST_SUITE_P(Tables, HostileInput, testing::ValuesIn(tables()), test_name);
INSTANTIATE_TEST_SUITE_P(Options, HostileInput, testing::ValuesIn(options()), test_name);

}  // namespace

}  // namespace bl::test
