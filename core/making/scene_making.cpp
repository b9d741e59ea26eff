// Reads, checks and joins the parts of a new scene.
#include "core/making/scene_making.h"

#include <cmath>

#include "core/base/plural.h"
#include "core/base/text.h"
#include "core/file/file_io.h"
#include "core/making/use_rates.h"
#include "core/session/ledger.h"
#include "core/session/session.h"

namespace bl::making {

namespace {

constexpr double kLargestHeight = 10000;  // [m]

class Maker {
 public:
  Maker(const NewOptions& options, MadeScene& made) : o_(options), made_(made) {}

  void run(const Registry& registry) {
    check_numbers();
    load_plan();
    const auto programme = load_programme();
    if (!made_.errors.empty()) return;
    SceneParts& parts = made_.parts;
    const bool takes_hull = o_.use_hull && !made_.plan->is_convex;
    const importing::ConvexPlan hull = convex_hull_plan(*made_.plan);
    parts.title = o_.title.empty() ? file_stem(o_.programme) : o_.title;
    parts.reference = made_.plan->reference;
    parts.plan = takes_hull ? hull.ring : made_.plan->outer;
    if (!takes_hull) parts.holes = made_.plan->holes;
    parts.height = o_.height;
    parts.margin = o_.margin;
    parts.is_standing = o_.form == "standing";
    parts.programme = *programme;
    parts.seed = o_.seed;
    parts.open_places = lay_open_places(parts.plan, parts.holes, parts.programme.rows, made_.notes);
    made_.plan_area = takes_hull ? hull.area : made_.plan->area;
    for (const NewVolume& volume : volumes_of(parts.programme)) made_.demand += volume.demand;
    const auto fresh = new_scene_command(parts);
    if (!fresh) return fail(o_.out, fresh.error());
    made_.notes.insert(made_.notes.end(), fresh->notes.begin(), fresh->notes.end());
    made_.footprints = fresh->footprints;
    Ledger ledger(registry, Scene{});
    if (auto done = ledger.submit(fresh->command, "new", 0); !done) return fail(o_.out, done.error());
    if (const auto room = room_inside(ledger.scene(), registry); !room) return fail("", room.error());
    made_.scene = ledger.scene();
    if (const std::string note = tell_uses_without_figures(*made_.scene, registry); !note.empty()) made_.notes.push_back(note);
  }

 private:
  // Is there room inside the margin? The link that keeps it knows: it is asked with the site and one volume alone, and without
  // anybody who computes. Its answer comes in the second tick, when it sees the boundary.
  static Result<void> room_inside(Scene scene, const Registry& registry) {
    if (!scene.links.contains(kInsideLink)) return {};
    scene.links = {{kInsideLink, scene.links.at(kInsideLink)}};
    bool has_volume = false;
    const SharedMap<NodeRecord> all = std::exchange(scene.nodes, {});
    for (const auto& [id, node] : all) {
      const bool is_volume = !has_volume && node.types.contains("smart_volume");
      has_volume = has_volume || is_volume;
      if (is_volume || node.types.contains("boundary")) scene.nodes.emplace(id, node);
    }
    const auto session = Session::start(registry, scene, nullptr, 1);
    if (!session) return {};
    for (int tick = 0; tick < 2; ++tick) (*session)->tick();
    for (const LinkState& link : (*session)->state()->links)
      if (link.error) return Error{link.error->code, "--margin", link.error->message};
    return {};
  }

  void fail(const std::string& file, Error error) { made_.errors.emplace_back(file, std::move(error)); }
  void refuse(const std::string& place, const std::string& sentence) { fail("", {ErrorCode::out_of_range, place, sentence}); }

  static std::string file_stem(const std::string& path) {
    const std::string name = path.substr(path.rfind('/') == std::string::npos ? 0 : path.rfind('/') + 1);
    const std::size_t dot = name.rfind('.');
    return dot == std::string::npos || dot == 0 ? name : name.substr(0, dot);
  }

  void check_numbers() {
    if (!(o_.height > 0) || !(o_.height <= kLargestHeight))
      refuse("--height", "must be a height in m, more than 0 and at most " + written_out(kLargestHeight) + ", found " +
                             written_out(o_.height));
    if (!(o_.storey_height >= 1) || !(o_.storey_height <= 50))
      refuse("--storey-height", "must be between 1 and 50 m, found " + written_out(o_.storey_height));
    if (!(o_.margin >= 0) || !std::isfinite(o_.margin))
      refuse("--margin", "must be 0 m or more, found " + written_out(o_.margin));
  }

  std::optional<std::string> text_of(const std::string& file) {
    auto text = read_file(file);
    if (text) return std::move(*text);
    fail(file, text.error());
    return std::nullopt;
  }

  void load_plan() {
    const auto text = text_of(o_.boundary);
    if (!text) return;
    importing::PlanOptions options;
    options.feature = o_.feature;
    options.crs = o_.crs;
    auto plan = read_plan_boundary(*text, options);
    if (!plan) return fail(o_.boundary, plan.error());
    for (const std::string& note : plan->notes) made_.notes.push_back(o_.boundary + ": " + note);
    made_.plan = std::move(*plan);
  }

  std::optional<importing::ProgrammeImport> load_programme() {
    const auto text = text_of(o_.programme);
    if (!text) return std::nullopt;
    importing::ProgrammeOptions options;
    options.storey_height = o_.storey_height;
    options.is_open_space = [](const std::string& use) {
      const UseRates* rates = use_rates(use);
      return rates != nullptr && rates->is_open;
    };
    for (const std::string& column : o_.columns) {
      const std::size_t equals = column.find('=');
      if (equals == std::string::npos || equals == 0) {
        refuse("--column", "expects OURS=HEADER such as use=\"Room name\", found `" + column + "`");
        return std::nullopt;
      }
      options.columns[column.substr(0, equals)] = column.substr(equals + 1);
    }
    options.is_standing = o_.form == "standing";
    options.is_below_ground = is_cellar_use;
    auto [programme, errors] = read_programme_table(*text, options);
    for (Error& error : errors) fail(o_.programme, std::move(error));
    if (!programme) return std::nullopt;
    for (const std::string& note : programme->notes) made_.notes.push_back(o_.programme + ": " + note);
    for (const std::string& warning : programme->warnings)
      made_.warnings.emplace_back(o_.programme, Error{ErrorCode::unknown_field, "", warning});
    warn_of_standing(*programme);
    std::vector<std::string> uses;
    for (const importing::ProgrammeRow& row : programme->rows)
      if (row.has_volumes()) uses.push_back(row.use);
    if (const std::string note = tell_taken_uses(uses); !note.empty()) made_.notes.push_back(o_.programme + ": " + note);
    return programme;
  }

  // What stands in storeys stands on the ground where no column names what carries it.
  void warn_of_standing(const importing::ProgrammeImport& programme) {
    if (o_.form != "standing") return;
    for (const importing::ProgrammeRow& row : programme.rows)
      if (row.has_volumes() && row.is_standing_said && row.standing != "ground" && row.on.empty() && row.shares.empty())
        made_.warnings.emplace_back(
            o_.programme, Error{ErrorCode::missing, "line " + std::to_string(row.line),
                                "`" + row.use + "` stands on the ground: `" + row.standing +
                                    "` in the column `standing` does not say on what it stands. Name the row below it in a "
                                    "column `on`, or, for storeys of one building, in a column `shares`."});
  }

  const NewOptions& o_;
  MadeScene& made_;
};

}  // namespace

MadeScene make_scene(const NewOptions& options, const Registry& registry) {
  MadeScene made;
  Maker(options, made).run(registry);
  return made;
}

}  // namespace bl::making
