// Tells formats apart, reads each file into the frame of the scene, and adds its nodes by one command.
#include "core/making/context_import.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>

#include "core/base/foreign_bytes.h"
#include "core/base/plural.h"
#include "core/base/stop.h"
#include "core/base/text.h"
#include "core/file/file_io.h"
#include "core/import/cityjson_context.h"
#include "core/import/context_shape.h"
#include "core/import/data_layer.h"
#include "core/import/geojson_context.h"
#include "core/import/geojson_polygons.h"
#include "core/import/inflate.h"
#include "core/import/osm_context.h"
#include "core/import/terrain_grid.h"
#include "core/making/context_nodes.h"
#include "core/making/room_left.h"
#include "core/making/site_on_ground.h"
#include "core/session/ledger.h"

namespace bl::making {

namespace {

// Of a file that is compared to tell formats apart [bytes].
constexpr std::size_t kHead = 65536;

enum class Format { osm, cityjson, geojson, grid, table, unknown };

// By the name first, since a table can look like anything; then by how the file begins.
Format format_of(const std::string& path, std::string_view text) {
  std::string name = lower_case(path);
  if (name.ends_with(".gz")) name.resize(name.size() - 3);
  const auto ends = [&name](std::initializer_list<const char*> list) {
    return std::any_of(list.begin(), list.end(), [&name](const char* ending) { return name.ends_with(ending); });
  };
  if (ends({".osm", ".pbf", ".osm.xml"})) return Format::osm;
  if (ends({".asc", ".grd", ".tif", ".tiff"})) return Format::grid;
  if (ends({".csv", ".tsv", ".txt"})) return Format::table;
  if (ends({".city.json", ".jsonl"})) return Format::cityjson;
  const std::string_view head = text.substr(0, kHead);
  // Writers that sort their keys say so behind all of the geometry.
  if (text.find("\"CityJSON\"") != std::string_view::npos) return Format::cityjson;
  if (ends({".geojson"}) || head.find_first_of("{[") == head.find_first_not_of(" \t\r\n\xEF\xBB\xBF")) return Format::geojson;
  if (head.find("<osm") != std::string_view::npos || head.substr(0, 64).find("OSMHeader") != std::string_view::npos)
    return Format::osm;
  if (head.starts_with("II") || head.starts_with("MM") ||
      lower_case(std::string(head.substr(0, 64))).find("ncols") != std::string::npos)
    return Format::grid;
  return Format::unknown;
}

// A name promises one format; what is something else altogether is told so in its words.
std::optional<Error> foreign_to_name(const std::string& path, Format format, std::string_view text) {
  const std::string name = lower_case(path);
  const auto ends = [&name](const char* ending) { return name.ends_with(ending) || name.ends_with(std::string(ending) + ".gz"); };
  const std::string_view wanted = ends(".tif") || ends(".tiff") ? "GeoTIFF" : ends(".asc") || ends(".grd") ? "ASCII grid" : "";
  const bool is_raster = text.starts_with("II") || text.starts_with("MM");
  if (format == Format::grid && !wanted.empty() && !is_raster && !text.empty()) {
    if (auto foreign = foreign_bytes(text, wanted, "export it again")) return foreign;
    if (wanted == "GeoTIFF" && lower_case(std::string(text.substr(0, 64))).find("ncols") == std::string::npos)
      return Error{ErrorCode::parse, "byte 0", "This is no GeoTIFF but text: export it again."};
  }
  if (format == Format::unknown && !text.empty())
    return foreign_bytes(text, "file that is read", std::string(kContextFormats) + " are");
  return std::nullopt;
}

std::string where(const importing::GeoReference& place) {
  if (place.has_system() || !place.is_on_earth()) return "in " + place.crs;
  return "at latitude " + shortest(place.latitude) + "°, longitude " + shortest(place.longitude) + "°";
}

std::set<std::string> elements_of(const importing::Context& context) {
  std::set<std::string> ids;
  for (const auto& one : context.buildings) ids.insert(one.id);
  for (const auto& one : context.junctions) ids.insert(one.id);
  for (const auto& one : context.streets) ids.insert(one.id);
  for (const auto& one : context.areas) ids.insert(one.id);
  return ids;
}

class Import {
 public:
  Import(const Scene& scene, const ImportOptions& options, const Registry& registry)
      : scene_(scene),
        o_(options),
        registry_(registry),
        context_(options.context),
        nodes_(scene, registry),
        sites_(scene, registry, options.inside, options.ask_to_clear) {}

  ImportedScene run() {
    check();
    if (result_.errors.empty())
      for (std::size_t i = 0; i < o_.files.size() && !is_stopped(); ++i) {
        if (context_.watch != nullptr) context_.watch->file = i;
        (void)goes_on(context_.watch, "reading", 0, 0);
        is_last_of_source_ = true;
        for (std::size_t later = i + 1; later < o_.files.size(); ++later)
          if (source_of(o_.files[later]) == source_of(o_.files[i])) is_last_of_source_ = false;
        read(o_.files[i]);
      }
    if (is_stopped() && result_.errors.empty()) fail("", importing::stopped_error());
    if (result_.errors.empty()) check_properties();
    for (const auto& [site, rows] : sites_.exclusions()) nodes_.set_port(site, "boundary.exclusions", Shared<Table>(rows));
    for (const std::string& note : sites_.notes()) result_.notes.push_back(note);
    result_.warnings = sites_.warnings();
    result_.notes.insert(result_.notes.end(), nodes_.notes().begin(), nodes_.notes().end());
    result_.nodes = nodes_.made();
    tell_of_ground();
    if (!result_.errors.empty()) return std::move(result_);
    // A site that was to be cleared and had all of a file's buildings is cleared: nothing is missing then.
    if (result_.nodes.empty() && !result_.reports.empty() && !sites_.has_cleared() && !nodes_.is_again() && !sites_.is_again() &&
        sites_.exclusions().empty()) {
      fail("", {ErrorCode::not_found, "", "nothing of the files was taken, and nothing was written; " + why_nothing()});
      return std::move(result_);
    }
    if (nodes_.is_empty()) result_.scene = scene_;
    else add({nodes_.batch()});
    if (result_.scene && has_terrain_) stand_on_ground();
    if (result_.scene && !o_.keep_clear.empty())
      if (const std::string room = room_left_text(*result_.scene, registry_); !room.empty()) result_.notes.push_back(room);
    return std::move(result_);
  }

 private:
  // Adds to the scene by one command.
  void add(std::vector<Command> commands) {
    (void)goes_on(context_.watch, "adding to the scene", 0, 0);
    result_.command = commands.size() == 1 ? std::move(commands.front()) : command<Batch>({std::move(commands)});
    result_.bounds = nodes_.bounds();
    Ledger ledger(registry_, scene_);
    if (auto done = ledger.submit(result_.command, "import", 0); !done) fail(o_.out, done.error());
    else result_.scene = ledger.scene();
  }

  // Sites and volumes on a terrain that was imported.
  void stand_on_ground() {
    SitesOnGround on_ground = sites_on_ground(scene_, *result_.scene, registry_);
    result_.notes.insert(result_.notes.end(), on_ground.notes.begin(), on_ground.notes.end());
    result_.warnings.insert(result_.warnings.end(), on_ground.warnings.begin(), on_ground.warnings.end());
    if (on_ground.commands.empty()) return;
    on_ground.commands.insert(on_ground.commands.begin(), nodes_.batch());
    result_.scene.reset();
    add(std::move(on_ground.commands));
  }

  bool is_stopped() const { return context_.watch != nullptr && context_.watch->is_stopped; }
  void fail(const std::string& file, Error error) {
    if (!file.empty() && std::find(o_.files.begin(), o_.files.end(), file) != o_.files.end())
      result_.reports.emplace_back(file, importing::ImportReport()).second.skip("file", "", "it cannot be read", error.text());
    result_.errors.emplace_back(file, std::move(error));
  }
  void refuse(const std::string& place, const std::string& sentence) { fail("", {ErrorCode::out_of_range, place, sentence}); }

  void check() {
    for (const auto& [name, value] :
         {std::pair{"--storey-height", context_.storey_height}, {"--default-height", context_.default_height}})
      if (!(value >= 1) || !(value <= 1000)) refuse(name, "must be between 1 and 1000 m, found " + shortest(value));
    if (!(o_.least_green >= 0) || o_.least_green > 1e6)
      refuse("--least-green", "must be between 0 and 1000000 m², found " + shortest(o_.least_green));
    if (!(context_.height_unit >= 0) || context_.height_unit > 1000)
      refuse("--height-unit", "must be more than 0 and at most 1000 m, found " + shortest(context_.height_unit));
    if (!(context_.radius >= 0) || !(context_.neighbour_distance >= 0)) refuse("--radius", "distances must be 0 m or more");
    for (const std::string& property : o_.properties) {
      const std::size_t equals = property.find('=');
      const std::vector<std::string> known = importing::context_property_names();
      const std::string ours = property.substr(0, equals);
      if (equals == std::string::npos || equals == 0 || equals + 1 == property.size()) {
        refuse("--property", "expects OURS=THEIRS such as height=H_MAX, found `" + property + "`");
      } else if (std::find(known.begin(), known.end(), ours) == known.end()) {
        std::string list;
        for (const std::string& name : known) list += (list.empty() ? "" : ", ") + name;
        refuse("--property", "there is no property `" + ours + "` that an import looks for" + did_you_mean(ours, known) +
                                 (did_you_mean(ours, known).empty() ? ". These are: " : " These are: ") + list + ".");
      } else context_.properties.emplace_back(property.substr(0, equals), property.substr(equals + 1));
    }
    for (const ImportKind& kind : kImportKinds)
      if (kind.is_of_features && kind.id == o_.kind) context_.feature_kind = kind.id;
    const Settings settings = settings_of(scene_);
    const importing::GeoReference place{settings.coordinate_system, settings.origin_x,  settings.origin_y,
                                        settings.latitude,          settings.longitude, settings.true_north};
    if (!place.crs.empty() || place.is_on_earth()) context_.target = place;
    // What was drawn without a place on Earth is drawn in the metres of the model.
    if (o_.origin.empty() && !context_.target && !scene_.nodes.empty() &&
        importing::tidy_crs_name(context_.crs) == importing::kLocalCrs)
      context_.origin = {0, 0};
    if (o_.origin.empty()) return;
    const std::size_t comma = o_.origin.find(',');
    const auto x = parse_number(o_.origin.substr(0, comma)),
               y = comma == std::string::npos ? std::nullopt : parse_number(o_.origin.substr(comma + 1));
    if (!x || !y) return refuse("--origin", "expects two numbers such as 85000,447000, found `" + o_.origin + "`");
    if (context_.target)
      return fail(
          "", {ErrorCode::conflict, "--origin",
               "the scene lies " + where(*context_.target) + " already, and its origin stays where it is: leave the origin out"});
    context_.origin = {*x, *y};
  }

  // A name that no feature has would be passed over in silence, with all that it should have said.
  void check_properties() {
    for (const auto& [ours, theirs] : context_.properties) {
      if (properties_.empty() && has_layer_) {
        refuse("--property", "a data layer has one value at each place, and no `" + ours +
                                 "`: name the column or property with the values by --value " + theirs);
        continue;
      }
      const bool is_there = std::any_of(properties_.begin(), properties_.end(), [&theirs = theirs](const std::string& name) {
        return lower_case(name) == lower_case(theirs);
      });
      if (is_there) continue;
      const std::vector<std::string> names(properties_.begin(), properties_.end());
      std::string list;
      for (std::size_t i = 0; i < names.size() && i < 12; ++i) list += (i == 0 ? "" : ", ") + names[i].substr(0, 40);
      if (names.size() > 12) list += ", ...";
      const std::string near = did_you_mean(theirs, names);
      refuse("--property", names.empty()
                               ? "none of the files has features with properties: leave `" + ours + "=" + theirs + "` out"
                               : "no feature has a property `" + theirs + "`" + near + (near.empty() ? ". " : " ") +
                                     "They have: " + list + ".");
    }
  }

  // The first file decides where the scene lies, unless the scene says so; all others follow it.
  void settle(const importing::GeoReference& reference) {
    const bool is_model = importing::tidy_crs_name(context_.crs) == importing::kLocalCrs;
    if (context_.target && !context_.target->has_system() && context_.target->is_on_earth() && !is_model) {
      const char* sentence = "The scene has no coordinate system: the files lie in it by its latitude, longitude and true north.";
      if (std::find(result_.notes.begin(), result_.notes.end(), sentence) == result_.notes.end())
        result_.notes.push_back(sentence);
    }
    if (context_.target) return;
    if (!scene_.nodes.empty() && reference.crs != importing::kLocalCrs)
      result_.notes.push_back(
          "The scene had no place on Earth: it has that of the first file now, and what was in it is about its origin.");
    nodes_.place(reference);
    context_.target = reference;
    context_.origin.reset();
  }

  std::string why_nothing() const {
    std::string questions;
    if (!o_.origin.empty())
      questions += "is --origin right (X,Y = longitude,latitude or east,north in the CRS of the first file)? ";
    if (context_.radius > 0) questions += "is anything within --radius " + shortest(context_.radius) + " m of the origin? ";
    if (questions.empty() && context_.target)
      questions = "do the files lie where the scene does (" + where(*context_.target) + ")? ";
    return questions + "--report FILE lists every element with its reason";
  }

  void take(const std::string& file, const importing::ImportReport& report, const std::vector<std::string>& notes,
            const importing::GeoReference& reference) {
    result_.reports.emplace_back(file, report);
    for (const std::string& note : notes) result_.notes.push_back(file + ": " + note);
    if (report.total() > 0 &&
        report.count(importing::ImportOutcome::taken) + report.count(importing::ImportOutcome::repaired) == 0)
      result_.notes.push_back(file + ": nothing of this file was taken; " + why_nothing());
    settle(reference);
  }

  // Maps count heights from the ground, terrains from the sea.
  void tell_of_ground() {
    const bool has_terrain = result_.nodes.contains("terrain") ||
                             std::any_of(scene_.nodes.begin(), scene_.nodes.end(),
                                         [](const auto& entry) { return entry.second.types.contains("terrain"); });
    if (has_terrain && from_ground_ > 0)
      result_.notes.push_back(how_many(from_ground_, "piece of street", "pieces of street") +
                              by_number(from_ground_, " has no height: it is drawn", " have no height: they are drawn") +
                              " at 0, and the terrain, whose heights count from the sea, lies above or below.");
  }

  // By its source an import knows again what it brought before.
  std::string source_of(const std::string& file) const {
    return o_.source.empty() ? file.substr(file.rfind('/') == std::string::npos ? 0 : file.rfind('/') + 1) : o_.source;
  }

  template <class Read>
  bool told(const std::string& file, const Read& read) {
    if (read) return true;
    fail(file, read.error());
    return false;
  }

  void read(const std::string& file) {
    auto bytes = read_file(file);
    if (!bytes) return fail(file, bytes.error());
    auto text = importing::unpacked(*bytes);
    if (!text) return fail(file, text.error());
    const Format format = format_of(file, *text);
    making_ = {source_of(file), o_.licence, o_.unit, o_.is_extruded, o_.takes_all_streets, format == Format::osm, context_.watch};
    if (text->substr(0, 4096).find("\"behaviourlinks\"") != std::string::npos)
      return fail(
          file, {ErrorCode::wrong_kind, "", "this is a scene of BehaviourLinks; the scene that is added to is named by --into"});
    if (auto foreign = foreign_to_name(file, format, *text)) return fail(file, *foreign);
    if (format == Format::grid) return read_grid(file, *text);
    if (format == Format::table || o_.kind == "layer") return read_layer(file, *text, format);
    if (o_.kind == "terrain")
      return fail(file, {ErrorCode::wrong_kind, "--as", "a terrain is read from an ASCII grid or a GeoTIFF"});
    auto context = format == Format::osm        ? read_osm_context(*text, context_)
                   : format == Format::cityjson ? read_cityjson_context(*text, context_)
                   : format == Format::geojson
                       ? read_geojson_context(*text, context_)
                       : Result<importing::Context>(Error{
                             ErrorCode::parse, "", "This is no format that is read: " + std::string(kContextFormats) + " are."});
    if (!told(file, context)) return;
    if (!o_.kind.empty() && format != Format::geojson)
      result_.notes.push_back(file + ": --as " + o_.kind + " was not needed: the file says what its elements are");
    from_ground_ += context->streets.size();
    properties_.insert(context->properties.begin(), context->properties.end());
    sites_.judge(*context);
    sites_.clear_grounds(*context, {{o_.keep_clear.begin(), o_.keep_clear.end()}, o_.takes_all_streets, o_.least_green},
                         {making_.source, making_.has_lasting_ids});
    take(file, context->report, context->notes, context->reference);
    nodes_.begin(making_, elements_of(*context));
    nodes_.add(*context, making_, sites_, result_.reports.back().second);
    nodes_.end(file, is_last_of_source_);
  }

  void read_grid(const std::string& file, const std::string& text) {
    const auto grid = importing::read_terrain_grid(text);
    if (!told(file, grid)) return;
    if (o_.kind == "layer") return read_layer(file, text, Format::grid);
    const auto terrain = local_terrain(*grid, context_);
    if (!told(file, terrain)) return;
    std::vector<std::string> notes = grid->notes;
    notes.insert(notes.end(), terrain->notes.begin(), terrain->notes.end());
    take(file, terrain->report, notes, terrain->reference);
    nodes_.begin(making_);
    nodes_.add(*terrain, making_, result_.reports.back().second);
    has_terrain_ = true;
    nodes_.end(file, is_last_of_source_);
  }

  void read_layer(const std::string& file, const std::string& text, Format format) {
    const auto from_grid = [&]() -> Result<importing::DataLayer> {
      const auto grid = importing::read_terrain_grid(text);
      return grid ? layer_of_grid(*grid, context_) : Result<importing::DataLayer>(grid.error());
    };
    const auto layer = format == Format::grid      ? from_grid()
                       : format == Format::geojson ? read_layer_geojson(text, context_, o_.value)
                                                   : read_layer_csv(text, context_, o_.value);
    if (!told(file, layer)) return;
    has_layer_ = true;
    take(file, layer->report, layer->notes, layer->reference);
    nodes_.begin(making_);
    nodes_.add(*layer, making_, result_.reports.back().second);
    nodes_.end(file, is_last_of_source_);
  }

  const Scene& scene_;
  const ImportOptions& o_;
  const Registry& registry_;
  importing::ContextOptions context_;
  ContextNodes nodes_;
  SiteBuildings sites_;
  std::set<std::string> properties_;  // of all features
  bool is_last_of_source_ = true;     // no file after it has the same source
  bool has_layer_ = false;            // some file was read as a data layer, which looks for no properties
  bool has_terrain_ = false;          // some file was read as one
  NodeMaking making_;
  std::size_t from_ground_ = 0;  // streets
  ImportedScene result_;
};

}  // namespace

bool is_context_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string head(kHead, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(std::max<std::streamsize>(0, file.gcount())));
  const Format format = format_of(path, head);
  if (format == Format::unknown) return false;
  const bool can_be_scene = lower_case(path).ends_with(".json") && format == Format::geojson;
  return !can_be_scene || head.find("\"behaviourlinks\"") == std::string::npos;
}

const std::vector<std::string>& context_endings() {
  static const std::vector<std::string> endings{".osm",      ".osm.gz",  ".pbf",        ".json",   ".json.gz", ".jsonl",
                                                ".jsonl.gz", ".geojson", ".geojson.gz", ".asc",    ".asc.gz",  ".grd",
                                                ".tif",      ".tiff",    ".csv",        ".csv.gz", ".tsv",     ".txt"};
  return endings;
}

ImportedScene import_context(const Scene& scene, const ImportOptions& options, const Registry& registry) {
  // Parsers deep down learn of a stop as well.
  const importing::ImportWatch* watch = options.context.watch;
  const StopScope scope([watch] { return watch != nullptr && watch->is_stopped; });
  return Import(scene, options, registry).run();
}

}  // namespace bl::making
