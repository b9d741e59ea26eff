// Declares the commands that make scenes: new, import, place and script.
#include "core/base/text.h"
#include "core/making/site_grounds.h"
#include "ui/cli/declarations.h"
#include "ui/cli/file_rule.h"

namespace bl::cli {

void declare_script(CLI::App& app, ScriptOptions& o) {
  CLI::App& c = *app.add_subcommand("script", "Puts link kinds written in Lua into a scene, lists them, takes them out.");
  c.add_option("scene", o.scene, "The scene file.")->type_name("SCENE")->required();
  c.add_option("files", o.files, "Lua files; a script of the same name is replaced.")->type_name("FILE.lua");
  c.add_option("--remove", o.removed, "Removes a script; its links stay and do not run. May be repeated.")
      ->type_name("NAME")
      ->expected(1)
      ->take_all();
  c.add_option("--extract", o.extract, "Writes all scripts of the scene as files into a folder.")->type_name("DIR");
  c.add_option("--out", o.out, "File for the changed scene; may be the scene itself.")->type_name("SCENE");
  c.add_flag("--force", o.is_forced,
             "Replaces --out where it exists and is another file than the scene, and extracted files that were changed since.");
  files_of(c).reads({"scene", "files"}).writes("--out", FileKind::scene, "scene").fills("--extract", {".lua"});
  c.footer("Example:\n  behaviourlinks script scene.json lean_uphill.lua --out scene.json");
}

void declare_new(CLI::App& app, making::NewOptions& o) {
  CLI::App& c = *app.add_subcommand("new", "Makes a scene from a plan boundary and a programme of demands.");
  c.add_option("--boundary", o.boundary, "Plan polygon as GeoJSON, in WGS84 or in a CRS in metres.")
      ->type_name("FILE")
      ->required();
  c.add_option("--height", o.height, "Height of the boundary above the ground, in m.")->type_name("METRES")->required();
  c.add_option("--programme", o.programme,
               "Table of uses as CSV: use, floor_area_m2, count, storey_height_m, adjacent_to, standing, open, ...")
      ->type_name("FILE")
      ->required();
  c.add_option("--out", o.out, "The scene file to write.")->type_name("FILE")->required();
  c.add_flag("--force", o.is_forced, "Replaces --out where it exists.");
  files_of(c).reads({"--boundary", "--programme"}).writes("--out", FileKind::scene);
  c.add_option("--title", o.title, "Name of the project. Default: the name of the programme's file.")->type_name("TEXT");
  c.add_option("--feature", o.feature, "Which polygon: its index from 0, or PROPERTY=VALUE. Default: the only or largest one.")
      ->type_name("WHICH");
  c.add_option(
       "--crs", o.crs,
       "CRS of the boundary in place of what the file says, such as EPSG:28992; `local` for metres without a place on Earth.")
      ->type_name("CRS");
  c.add_flag("--hull", o.use_hull, "Takes the convex hull of a plan that is not convex.");
  c.add_option("--column", o.columns, "Maps a column to another header of the table: use=\"Room name\". May be repeated.")
      ->type_name("OURS=HEADER")
      ->expected(1)
      ->take_all();
  c.add_option("--storey-height", o.storey_height, "Storey height of rows that give none, in m. Default: 3.2.")
      ->type_name("METRES");
  c.add_option("--margin", o.margin, "Least distance of positions from the boundary, in m. Default: 1.")->type_name("METRES");
  std::vector<std::string> forms;
  std::string form_words;
  for (const making::VolumeForm& form : making::kVolumeForms) {
    form_words += (forms.empty() ? "`" : ", or `") + std::string(form.id) + "`, " + form.words;
    forms.emplace_back(form.id);
  }
  c.add_option("--form", o.form, "What volumes are: " + form_words + ". Default: " + forms.front() + ".")
      ->type_name("FORM")
      ->check(CLI::IsMember(forms));
  c.add_option("--seed", o.seed, "Seed of the first positions. Default: 1.")->type_name("N");
  c.footer("Example:\n  behaviourlinks new --boundary site.geojson --height 45 --programme brief.csv --out scene.json");
}

namespace {

std::string in_one_line(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : ", ") + word;
  return line;
}

// What files of surroundings leave open, such as heights.
void declare_assumptions(CLI::App& c, making::ImportOptions& o) {
  c.add_option(
       "--height-unit", o.context.height_unit,
       "Metres in one unit of height of city models and terrains, such as 0.3048. Default: the unit of the file or its CRS.")
      ->type_name("METRES");
  c.add_option("--storey-height", o.context.storey_height,
               "Height of storeys where only their number is known, in m. Default: 3.2.")
      ->type_name("METRES");
  c.add_option("--default-height", o.context.default_height,
               "Height of buildings that nothing is known about, in m. Default: 9.6.")
      ->type_name("METRES");
  c.add_option("--neighbours", o.context.neighbour_distance,
               "Distance within which the heights of neighbouring buildings are used, in m. Default: 100.")
      ->type_name("METRES");
  c.add_option("--lod", o.context.level_of_detail, "The finest level of detail that is taken from city models. Default: 9.")
      ->type_name("LEVEL");
}

}  // namespace

void declare_import(CLI::App& app, making::ImportOptions& o) {
  CLI::App& c =
      *app.add_subcommand("import", "Brings the surroundings of a site into a scene: buildings, streets, terrain, data.");
  c.add_option("files", o.files,
               std::string(making::kContextFormats) + " with coordinates (" + in_one_line(making::context_endings()) +
                   "); or pictures (JPEG, PNG).")
      ->type_name("FILE")
      ->required();
  c.add_option("--into", o.into, "The scene that is added to. Default: an empty one.")->type_name("SCENE");
  c.add_option("--out", o.out, "The scene file to write.")->type_name("SCENE")->required();
  c.add_flag("--force", o.is_forced, "Replaces --out where it exists; no other file.");
  std::vector<std::string> kinds;
  for (const making::ImportKind& kind : making::kImportKinds) kinds.emplace_back(kind.id);
  c.add_option("--as", o.kind, "Kind of the features or of the grid where the file does not give it: " + in_one_line(kinds) + ".")
      ->type_name("KIND")
      ->check(CLI::IsMember(kinds));
  c.add_option("--crs", o.context.crs,
               "CRS of the files in place of what they say, such as EPSG:28992; `local` for metres of a model that has no place "
               "on Earth.")
      ->type_name("CRS");
  c.add_option("--origin", o.origin,
               "Origin of the scene as X,Y in the CRS of the first file. Default: the middle of what is in it.")
      ->type_name("X,Y");
  c.add_option("--radius", o.context.radius,
               "Imports only elements within this distance of the origin, in m. Default: 0, which takes all.")
      ->type_name("METRES");
  c.add_option("--property", o.properties, "Maps a property to another name in the file: height=H_MAX. May be repeated.")
      ->type_name("OURS=THEIRS")
      ->expected(1)
      ->take_all();
  c.add_option("--value", o.value, "Column or property with the values of a data layer.")->type_name("NAME");
  c.add_option("--unit", o.unit, "Unit of the values of a data layer, such as dB.")->type_name("UNIT");
  c.add_option("--source", o.source, "Source of the data, for nodes that record it. Default: the name of the file.")
      ->type_name("TEXT");
  c.add_option("--licence", o.licence, "Licence of the data, for nodes that record it.")->type_name("TEXT");
  declare_assumptions(c, o);
  c.add_flag("--extruded", o.is_extruded, "Makes buildings from outline and height even where the file has solids.");
  c.add_flag("--all-streets", o.takes_all_streets, "Imports footpaths, cycleways and steps as well, not only streets for cars.");
  c.add_flag("--keep", o.keeps,
             "Keeps buildings inside a site of the scene; the site leaves out their ground up to their roofs. Default: asks; "
             "without a terminal, keeps them.");
  c.add_flag("--clear", o.clears,
             "Leaves out buildings inside a site of the scene, also those that an import before has kept. A building with less "
             "than half of its ground inside is kept.");
  const std::vector<std::string> grounds(making::kClearGrounds.begin(), making::kClearGrounds.end());
  c.add_option("--keep-clear", o.keep_clear,
               "Kinds of ground that are kept clear: " + in_one_line(grounds) + ". " + making::kKeepClearDoc +
                   " Several, separated by commas.")
      ->type_name("KINDS")
      ->delimiter(',')
      ->check(CLI::IsMember(grounds));
  c.add_option("--least-green", o.least_green, std::string(making::kLeastGreenDoc) + " Default: 10.")->type_name("M2");
  c.add_option("--report", o.report, "Writes the result for every element as CSV.")->type_name("FILE");
  files_of(c).reads({"files", "--into"}).writes("--out", FileKind::scene, "--into").writes("--report", FileKind::table);
  c.footer(
      "Example:\n  behaviourlinks import quarter.osm.gz heights.asc --into scene.json --out scene_in_context.json --radius 400 "
      "--report import.csv\n\nHeights that the file lacks are assumed, and marked as assumed. Exit codes: 0 imported; 2 bad "
      "input, nothing written.");
}

namespace {

// An option of one addition, which the others do not know.
void of_addition(CLI::Option* option, const AddOptions& o, const char* what, const char* also = "") {
  option->check(CLI::Validator(
      [&o, what, also](std::string&) {
        if (o.what.empty() || o.what == what || o.what == also) return std::string();
        return "belongs to `" + std::string(what) + "`, not to `" + o.what + "`";
      },
      ""));
}

}  // namespace

void declare_add(CLI::App& app, AddOptions& o) {
  CLI::App& c = *app.add_subcommand("add", "Adds building rules, a sun or a garden to a scene.");
  const std::vector<std::string> kinds(std::begin(making::kAdditions), std::end(making::kAdditions));
  c.add_option("scene", o.scene, "The scene.")->type_name("SCENE")->required();
  c.add_option("what", o.what, "What is added: " + in_one_line(kinds) + ".")
      ->type_name("WHAT")
      ->required()
      ->check(CLI::IsMember(kinds));
  c.add_option("--out", o.out, "File for the changed scene. Default: the same file.")->type_name("SCENE");
  c.add_flag("--force", o.is_forced, "Replaces --out where it exists and is another file than the scene.");
  files_of(c).reads({"scene"}).writes("--out", FileKind::scene, "scene");
  const auto option = [&c, &o](const char* name, auto& value, const std::string& doc, const char* type, const char* what,
                               const char* also = "") {
    CLI::Option* made = c.add_option(name, value, doc)->type_name(type);
    of_addition(made, o, what, also);
    return made;
  };
  option("--plot", o.rules.plot, "rules: the plot, or the boundary that becomes one. Default: the only one.", "ID", "rules");
  option("--fsi", o.rules.fsi, "rules: the largest floor area over land.", "RATIO", "rules");
  option("--gsi", o.rules.gsi, "rules: the largest built ground over land.", "RATIO", "rules");
  option("--height", o.rules.height, "rules: the largest height above the ground, in m.", "METRES", "rules");
  option("--setback", o.rules.setback, "rules: how far volumes that stand keep from the border of the plot, in m.", "METRES",
         "rules");
  option("--latitude", o.sun.latitude, "sun, garden: where the sun stands, in degrees. Default: where the scene lies.", "DEGREES",
         "sun", "garden");
  option("--longitude", o.sun.longitude, "sun, garden: the same to the east.", "DEGREES", "sun", "garden");
  option("--date", o.sun.date, "sun, garden: the day that is studied. Default: 2026-03-21.", "YYYY-MM-DD", "sun", "garden");
  option("--utc-offset", o.sun.utc_offset,
         "sun, garden: hours that clocks are ahead of universal time. Default: by the longitude.", "HOURS", "sun", "garden");
  option("--corners", o.garden.corners, "garden: its corners in order, in m of the scene.", "X,Y", "garden")->expected(1, 1000);
  option("--id", o.garden.id, "garden: a plot or a garden of the scene; with --corners the id of the new one.", "ID", "garden");
  of_addition(c.add_flag("--open", o.garden.is_open, "garden: keeps its ground free, as open space inside the boundary."), o,
              "garden");
  option(
      "--use", o.garden.use,
      "garden: with --open, the use of the ground, as a row of the programme names it. Default: the only such row, else garden.",
      "USE", "garden");
  option("--hours", o.garden.hours, "garden: hours of sun a day that it needs. Default: 2.", "HOURS", "garden");
  option("--share", o.garden.share, "garden: share of its area that needs them. Default of a new one: 0.5.", "RATIO", "garden");
  c.footer(
      "A garden brings a sun along where the scene has none. What is there already is set and not doubled.\n\nExample:\n"
      "  behaviourlinks add scene.json rules --fsi 2.5 --gsi 0.5 --height 24\n"
      "  behaviourlinks add scene.json sun --date 2026-03-21\n"
      "  behaviourlinks add scene.json garden --corners 10,60 34,60 34,72 10,72 --hours 3");
}

void declare_place(CLI::App& app, PlaceOptions& o) {
  CLI::App& c =
      *app.add_subcommand("place", "Adds pictures to a scene, at the position and direction that they were taken from.");
  c.add_option("pictures", o.files, "JPEG or PNG files; they stay where they are.")->type_name("PICTURE")->required();
  c.add_option("--into", o.into, "The scene.")->type_name("SCENE")->required();
  c.add_option("--out", o.out, "File for the changed scene. Default: the same file.")->type_name("SCENE");
  c.add_flag("--force", o.is_forced, "Replaces --out where it exists and is another file than the scene.");
  files_of(c).reads({"pictures", "--into"}).writes("--out", FileKind::scene, "--into");
  c.add_option("--at", o.at, "Position in m. Default: the coordinates in the picture.")->type_name("X Y Z")->expected(3);
  c.add_option("--placement", o.media.placement, "Placement. Default: camera where the picture has a direction, else billboard.")
      ->check(CLI::IsMember({"ground", "billboard", "camera"}));
  c.add_option("--consent", o.media.consent, "Consent to show the picture. Default: unknown, which veils it.")
      ->check(CLI::IsMember({"unknown", "given", "not_needed", "refused"}));
  c.add_option("--licence", o.media.licence, "Licence. Default: the licence in the picture.")->type_name("TEXT");
  c.add_option("--author", o.media.author, "Author. Default: the author in the picture.")->type_name("TEXT");
  c.add_option("--size", o.media.size, "Width in m, of a billboard or on the ground. Default: 10.")
      ->type_name("METRES")
      ->check(CLI::Validator(
          [](const std::string& text) {
            const auto width = parse_number(text);
            return !width || *width > 0 ? "" : "must be a width of more than 0 m, found " + text;
          },
          ""));
  c.footer("Example:\n  behaviourlinks place site.jpg --into scene.json --consent given");
}

}  // namespace bl::cli
