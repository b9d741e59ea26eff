// Nodes, roles, ports and links of an addition, as one batch; what is there already is set, not doubled.
#include "core/making/scene_additions.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "core/base/plural.h"
#include "core/base/text.h"
#include "core/define/codec.h"
#include "core/geometry/plan_ring.h"
#include "core/making/addition_checks.h"
#include "core/making/garden_outline.h"
#include "core/making/open_rows.h"
#include "core/making/room_left.h"
#include "core/making/scene_ground.h"
#include "core/making/site.h"
#include "core/making/use_rates.h"
#include "core/session/commands.h"

namespace bl::making {

namespace {

constexpr double kHighestRule = 10000;  // [m]
// A garden whose corners leave out less of its rectangle is said to be one.
constexpr double kRectangle = 0.02;  // [ratio]
// A garden of which less lies in a boundary touches it only.
constexpr double kTouch = 1e-6;       // [ratio]
constexpr double kLeastShared = 0.5;  // [m²] with what is left out already, to be told

Error refused(const std::string& place, const std::string& sentence) { return {ErrorCode::out_of_range, place, sentence}; }

std::vector<std::string> nodes_with(const Scene& scene, const char* type) {
  std::vector<std::string> ids;
  for (const auto& [id, node] : scene.nodes)
    if (node.types.contains(type)) ids.push_back(id);
  return ids;
}

std::string list_of(const std::vector<std::string>& ids) {
  std::string list;
  for (std::size_t i = 0; i < ids.size() && i < 8; ++i) list += (i == 0 ? "`" : ", `") + ids[i] + "`";
  return ids.size() > 8 ? list + ", ..." : list;
}

template <class Map>
std::string fresh_id(const Map& taken, const std::string& wanted) {
  std::string id = wanted;
  for (int number = 2; taken.contains(id); ++number) id = wanted + "_" + std::to_string(number);
  return id;
}

// A value that is in its range, or a sentence.
Result<void> within(const char* option, const std::optional<double>& value, double low, double high, const char* unit) {
  if (!value || (*value >= low && *value <= high)) return {};
  return refused(option,
                 "must be between " + written_out(low) + " and " + written_out(high) + unit + ", found " + written_out(*value));
}

// A day of the calendar such as 2026-03-21, in the years that a sun knows.
bool is_date(const std::string& text) {
  if (text.size() != 10 || text[4] != '-' || text[7] != '-') return false;
  const auto number = [&text](std::size_t from, std::size_t length) {
    int value = 0;
    for (std::size_t i = from; i < from + length; ++i) {
      if (text[i] < '0' || text[i] > '9') return -1;
      value = 10 * value + (text[i] - '0');
    }
    return value;
  };
  const int year = number(0, 4), month = number(5, 2), day = number(8, 2);
  if (year < 1900 || year > 2100 || month < 1 || month > 12 || day < 1) return false;
  constexpr int kDays[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  const bool is_leap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
  return day <= kDays[month - 1] + (month == 2 && is_leap ? 1 : 0);
}

class Adding {
 public:
  Adding(const Scene& scene, const Registry& registry) : scene_(scene), registry_(registry) {}

  void node(const std::string& id, const Json& content) { add(command<AddNode>({id, JsonValue::of(content)})); }
  void link(const std::string& id, const Json& content) { add(command<AddLink>({id, JsonValue::of(content)})); }
  void set(const std::string& node, const std::string& port, const Json& value) {
    add(command<SetPort>({node, {port}, JsonValue::of(value)}));
  }
  void role(const std::string& node, const char* type, const Json& values = Json::object()) {
    add(command<Typify>({node, type, JsonValue::of(values)}));
  }
  Result<void> leave_out(const std::string& name, const std::string& use, const std::vector<Point3>& corners);
  void say(const std::string& sentence) { result_.said.push_back(sentence); }
  std::string new_node(const std::string& wanted) const { return fresh_id(scene_.nodes, wanted); }
  std::string new_link(const std::string& wanted) const { return fresh_id(scene_.links, wanted); }

  /// Is there a link of the kind from that node?
  bool has_link(const char* kind, const std::string& from) const {
    return std::any_of(scene_.links.begin(), scene_.links.end(), [&](const auto& entry) {
      const LinkRecord& link = entry.second;
      return link.kind == kind && selects_one(link.from, from);
    });
  }

  Result<void> sun(const SunAddition& o);
  Addition take() {
    result_.command = command<Batch>({commands_});
    return std::move(result_);
  }

 private:
  void add(Command command) { commands_.push_back(std::move(command)); }
  bool selects_one(const Selection& selection, const std::string& id) const {
    const auto node = scene_.nodes.find(id);
    return node != scene_.nodes.end() && selects(registry_, selection, id, node->second);
  }
  Result<void> open_use(const std::string& use);
  Json sun_ports(const SunAddition& o, bool is_new);
  void casters();

  const Scene& scene_;
  const Registry& registry_;
  std::vector<Command> commands_;
  Addition result_;
};

Json Adding::sun_ports(const SunAddition& o, bool is_new) {
  Json ports = Json::object();
  if (o.latitude) ports["latitude"] = *o.latitude;
  if (o.longitude) ports["longitude"] = *o.longitude;
  if (!o.date.empty()) ports["date"] = o.date;
  if (o.utc_offset) {
    ports["utc_offset"] = *o.utc_offset * 3600;
  } else if (is_new) {
    const double hours = std::round((o.longitude ? *o.longitude : settings_of(scene_).longitude) / 15);
    ports["utc_offset"] = hours * 3600;
    say("Clocks are " + std::string(hours < 0 ? "" : "+") + shortest(hours) +
        " h from universal time, by the longitude alone, without summer time and the law of the place: where clocks show "
        "another time, as in much of western Europe, give it by --utc-offset or in the port `utc_offset` of the sun.");
  }
  return ports;
}

void Adding::casters() {
  std::size_t given = 0;
  for (const auto& [id, node] : scene_.nodes)
    if ((node.types.contains("smart_volume") || node.types.contains("existing_building")) &&
        !node.types.contains("shadow_caster")) {
      role(id, "shadow_caster");
      ++given;
    }
  if (given > 0)
    say(how_many(given, "volume or building", "volumes and buildings") + by_number(given, " casts", " cast") + " shadow now.");
}

Result<void> Adding::sun(const SunAddition& o) {
  if (auto sound = within("--latitude", o.latitude, -90, 90, "°"); !sound) return sound;
  if (auto sound = within("--longitude", o.longitude, -180, 180, "°"); !sound) return sound;
  if (auto sound = within("--utc-offset", o.utc_offset, -14, 14, " h"); !sound) return sound;
  if (!o.date.empty() && !is_date(o.date))
    return Error{ErrorCode::parse, "--date", "expects a day such as 2026-03-21, found `" + o.date + "`"};
  if (o.latitude.has_value() != o.longitude.has_value())
    return Error{ErrorCode::missing, o.latitude ? "--longitude" : "--latitude", "a place has both a latitude and a longitude"};
  const std::vector<std::string> suns = nodes_with(scene_, "sun_and_sky");
  if (suns.size() > 1)
    return Error{ErrorCode::conflict, "",
                 "the scene has several suns, " + list_of(suns) + ": leave one, so that it is clear whose day counts"};
  const Settings settings = settings_of(scene_);
  if (suns.empty() && !o.latitude && settings.latitude == 0 && settings.longitude == 0)
    return Error{ErrorCode::missing, "--latitude",
                 "the scene has no place on Earth: say where its sun stands by --latitude and --longitude"};
  const Json ports = sun_ports(o, suns.empty());
  const std::string sun = suns.empty() ? new_node("sun") : suns.front();
  if (suns.empty()) node(sun, {{"name", "Sun"}, {"types", {{"sun_and_sky", ports}}}});
  else
    for (const auto& [port, value] : ports.items()) set(sun, "sun_and_sky." + port, value);
  say(std::string(suns.empty() ? "New: the sun `" : "The sun is `") + sun + "`" + (o.date.empty() ? "" : " on " + o.date) + ".");
  if (nodes_with(scene_, "sun_study").empty()) {
    const std::string study = new_node("sun_study");
    node(study, {{"name", "Sun study"}, {"types", {{"sun_study", Json::object()}}}});
    say("New: the study `" + study + "` of all volumes, buildings and gardens.");
  }
  casters();
  return {};
}

// The outline of a boundary with the form of a plan; empty for all others.
std::vector<Point3> plan_of(const Scene& scene, const Registry& registry, const NodeRecord& node) {
  const TypificationDefinition* type = registry.typification("boundary");
  if (type == nullptr || !node.types.contains("boundary")) return {};
  const Value& form = set_value(scene, node, *type, *type->find_port("form"));
  if (std::get<std::string>(form) != "plan") return {};
  return *std::get<Shared<std::vector<Point3>>>(set_value(scene, node, *type, *type->find_port("plan")));
}

// The node that says that the use is open space: so rows of programmes ask for its ground.
Result<void> Adding::open_use(const std::string& use) {
  const TypificationDefinition& type = *registry_.typification("use");
  for (const auto& [id, node] : scene_.nodes) {
    if (!node.types.contains("use") ||
        lower_case(std::get<std::string>(set_value(scene_, node, type, *type.find_port("use")))) != lower_case(use))
      continue;
    if (std::get<bool>(set_value(scene_, node, type, *type.find_port("is_open")))) return {};
    return Error{ErrorCode::conflict, "--use",
                 "`" + use + "` is no open space: set `is_open` of `" + id + "`, or name another use"};
  }
  const UseRates* rates = use_rates(use);
  const bool is_known = rates != nullptr && rates->is_open;
  const std::string id = new_node("use_" + to_identifier(use));
  node(id, {{"name", "Use: " + use},
            {"types",
             {{"use",
               {{"use", use},
                {"is_open", true},
                {"least_sun", is_known ? rates->least_sun : 0},
                {"source", is_known ? std::string(rates->source) : "open space by whoever added it"}}}}}});
  say("New: the node `" + id + "`, by which `" + use + "` is open space: a row of the programme with this use asks for ground.");
  return {};
}

// From the underside of a boundary to its top, so that nothing hangs above open space. Rows of a garden that has gone give way,
// and one rectangle that was laid for the same use until somebody would say where it belongs.
Result<void> Adding::leave_out(const std::string& name, const std::string& use, const std::vector<Point3>& corners) {
  if (auto known = open_use(use); !known) return known;
  const double whole = std::abs(geometry::signed_area(corners));
  bool reaches_any = false, has_taken_place = false;
  for (Site& site : sites_of(scene_, registry_)) {
    double common = 0;
    for (const std::vector<geometry::Ring>& ground : site.grounds) common += area_on(ground, {&corners});
    common = std::min(common, whole);
    if (!(common > kTouch * whole)) continue;
    reaches_any = true;
    const std::string laid = has_taken_place || site.leaves_out(name) ? "" : laid_by_new(scene_, site, use, corners);
    has_taken_place = has_taken_place || !laid.empty();
    const auto is_old = [&](const std::string& other) { return other == name || (!laid.empty() && other == laid); };
    const bool had_some = site.replace(is_old, {});
    const double before = ground_of(site, false);
    (void)site.replace(is_old, {{name, use, corners, site.bottom, site.top}});
    const double taken = std::min(common, before - ground_of(site, false));
    const PortDefinition& port = *registry_.typification("boundary")->find_port("exclusions");
    set(site.id, "boundary.exclusions", value_to_json(Shared<Table>(site.rows), port));
    say("The boundary `" + site.id + "` leaves out " +
        (whole - common <= kTouch * whole
             ? "its " + fixed(whole, 1) + " m²"
             : "the " + fixed(common, 1) + " m² of it that lie inside, of " + fixed(whole, 1) + " m²") +
        ": open space, which plots count as not built." +
        (common - taken > kLeastShared
             ? " Of these, " + fixed(common - taken, 1) +
                   " m² were left out before, as a street or another open space, and count there: move it where it has all."
             : "") +
        (!laid.empty() ? " It takes the place of the rectangle `" + laid + "`, which `new` had laid for `" + use + "`."
         : had_some    ? " What it left out as `" + name + "` before is replaced."
                       : ""));
  }
  if (!reaches_any) say("No boundary reaches it, so that none leaves its ground out.");
  return {};
}

double to_millimetres(double value) { return std::round(value * 1000) / 1000 + 0.0; }

}  // namespace

Result<Addition> add_sun(const Scene& scene, const Registry& registry, const SunAddition& sun) {
  Adding adding(scene, registry);
  if (auto added = adding.sun(sun); !added) return added.error();
  return adding.take();
}

namespace {

// The id of a plot, or of a boundary that becomes one.
Result<std::string> plot_of(const Scene& scene, const std::string& wanted) {
  std::vector<std::string> plots = nodes_with(scene, "plot");
  if (!wanted.empty()) {
    if (scene.nodes.contains(wanted)) return wanted;
    for (const std::string& boundary : nodes_with(scene, "boundary")) plots.push_back(boundary);
    return Error{ErrorCode::not_found, "--plot", "there is no node `" + wanted + "`" + did_you_mean(wanted, plots)};
  }
  if (plots.empty()) plots = nodes_with(scene, "boundary");
  if (plots.empty()) return Error{ErrorCode::not_found, "--plot", "the scene has neither a plot nor a boundary"};
  if (plots.size() > 1)
    return Error{ErrorCode::missing, "--plot", "the scene has several plots: say which by --plot, such as " + list_of(plots)};
  return plots.front();
}

}  // namespace

Result<Addition> add_rules(const Scene& scene, const Registry& registry, const RuleAddition& rules) {
  if (!rules.fsi && !rules.gsi && !rules.height && !rules.setback)
    return Error{ErrorCode::missing, "", "say which rules: --fsi, --gsi, --height or --setback"};
  if (auto sound = within("--fsi", rules.fsi, 0, 100, ""); !sound) return sound.error();
  if (auto sound = within("--gsi", rules.gsi, 0, 1, ""); !sound) return sound.error();
  if (auto sound = within("--height", rules.height, 0, kHighestRule, " m"); !sound) return sound.error();
  if (auto sound = within("--setback", rules.setback, 0, 1000, " m"); !sound) return sound.error();
  const auto plot_id = plot_of(scene, rules.plot);
  if (!plot_id) return plot_id.error();
  const std::string& id = *plot_id;
  const auto node = scene.nodes.find(id);
  Adding adding(scene, registry);
  Json ports = Json::object();
  std::string list;
  const auto take = [&](const char* port, const std::optional<double>& value, const char* label, const char* unit) {
    if (!value) return;
    ports[port] = *value;
    list += (list.empty() ? "" : ", ") + std::string(label) + " " + shortest(*value) + unit;
  };
  take("fsi_max", rules.fsi, "FSI", "");
  take("gsi_max", rules.gsi, "GSI", "");
  take("height_max", rules.height, "height", " m");
  take("setback", rules.setback, "setback", " m");
  std::vector<Point3> plan;
  if (node->second.types.contains("plot")) {
    const TypificationDefinition& plot = *registry.typification("plot");
    plan = *std::get<Shared<std::vector<Point3>>>(set_value(scene, node->second, plot, *plot.find_port("polygon")));
    for (const auto& [port, value] : ports.items()) adding.set(id, "plot." + port, value);
  } else {
    plan = plan_of(scene, registry, node->second);
    if (plan.empty())
      return Error{ErrorCode::wrong_kind, "--plot",
                   "`" + id + "` is neither a plot nor a boundary with a plan, which would become one"};
    ports["polygon"] = Json::array();
    for (const Point3& corner : plan) ports["polygon"].push_back({corner.x, corner.y, 0.0});
    for (const Site& site : sites_of(scene, registry))
      if (site.id == id && site.bottom != 0) ports["ground"] = site.bottom;
    adding.role(id, "plot", ports);
    adding.say("The boundary `" + id + "` is a plot as well now.");
  }
  adding.say("The rules of `" + id + "`: " + list + ".");
  for (const std::string& warning : rule_warnings(scene, registry, rules, id, plan)) adding.say(warning);
  if (rules.setback)
    adding.say("Volumes that stand keep the setback from the border in all storeys; of balls it is measured only.");
  if (!adding.has_link("plot_rules", id)) {
    const std::string link = adding.new_link("plot_rules");
    adding.link(link, {{"kind", "plot_rules"}, {"from", id}, {"to", {{"typification", "smart_volume"}}}});
    adding.say("New: the link `" + link + "`, which holds all volumes on it to these rules.");
  }
  return adding.take();
}

namespace {

// Is it said where the garden is, in one way only?
Result<void> check_garden(const Scene& scene, const GardenAddition& garden) {
  if (auto sound = within("--hours", garden.hours, 0, 24, " h"); !sound) return sound.error();
  if (auto sound = within("--share", garden.share, 0.01, 1, ""); !sound) return sound.error();
  if (garden.id.empty() && garden.corners.empty())
    return Error{ErrorCode::missing, "--corners", "say where the garden is: by --corners X,Y X,Y X,Y ..., or by --id of a node"};
  const auto node = garden.id.empty() ? scene.nodes.end() : scene.nodes.find(garden.id);
  if (!garden.id.empty() && garden.corners.empty() && node == scene.nodes.end())
    return Error{ErrorCode::not_found, "--id",
                 "there is no node `" + garden.id + "`" + did_you_mean(garden.id, nodes_with(scene, "plot")) +
                     "; a new garden has --corners"};
  if (node != scene.nodes.end() && !garden.corners.empty())
    return Error{ErrorCode::duplicate, "--id",
                 "the node `" + garden.id + "` is there already: leave --corners out, or choose another id"};
  if (garden.corners.empty() && !node->second.types.contains("shadow_receiver") && !node->second.types.contains("plot"))
    return Error{ErrorCode::wrong_kind, "--id",
                 "`" + garden.id + "` is neither a plot nor a shadow receiver: give the garden --corners"};
  if (garden.is_open && garden.corners.empty() && node->second.types.contains("shadow_receiver"))
    return Error{ErrorCode::conflict, "--open", "`" + garden.id + "` is there already: open space is laid with a new garden"};
  return {};
}

}  // namespace

Result<Addition> add_garden(const Scene& scene, const Registry& registry, const GardenAddition& garden) {
  if (auto sound = check_garden(scene, garden); !sound) return sound.error();
  const auto node = garden.id.empty() ? scene.nodes.end() : scene.nodes.find(garden.id);
  Adding adding(scene, registry);
  if (nodes_with(scene, "sun_study").empty() || nodes_with(scene, "sun_and_sky").empty() || garden.sun.is_given())
    if (auto added = adding.sun(garden.sun); !added) return added.error();
  const double hours = garden.hours.value_or(2), share = garden.share.value_or(0.5);
  std::string id = garden.id;
  if (garden.corners.empty() && node->second.types.contains("shadow_receiver")) {
    if (garden.hours) adding.set(id, "shadow_receiver.required_sun", hours * 3600);
    if (garden.share) adding.set(id, "shadow_receiver.required_share", share);
  } else {
    std::vector<Point3> corners;
    if (garden.corners.empty()) {
      const TypificationDefinition& plot = *registry.typification("plot");
      corners = *std::get<Shared<std::vector<Point3>>>(set_value(scene, node->second, plot, *plot.find_port("polygon")));
      for (Point3& corner : corners) corner.z = 0;
      id = adding.new_node(garden.id + "_garden");
    } else {
      auto read = read_corners(garden.corners);
      if (!read) return read.error();
      corners = std::move(*read);
      if (id.empty()) id = adding.new_node("garden");
    }
    const Rectangle box = around(corners);
    if (!(box.depth > 0.01)) return Error{ErrorCode::geometry, "--corners", "the garden has no area"};
    const double ground = ground_at(scene, registry, box.middle);
    adding.node(id, {{"name", "Garden"},
                     {"position", {to_millimetres(box.middle.x), to_millimetres(box.middle.y), to_millimetres(ground)}},
                     {"types",
                      {{"shadow_receiver",
                        {{"width", to_millimetres(box.width)},
                         {"depth", to_millimetres(box.depth)},
                         {"rotation", to_millimetres(box.rotation)},
                         {"required_sun", hours * 3600},
                         {"required_share", share}}}}}});
    adding.say("New: the garden `" + id + "`, " + fixed(box.width, 1) + " m by " + fixed(box.depth, 1) + " m, with " +
               shortest(hours) + " h of sun a day on " + shortest(100 * share) + " % of its area.");
    for (const std::string& warning : garden_warnings(scene, registry, corners)) adding.say(warning);
    if (garden.is_open) {
      const OpenRow row = open_row_for(scene, registry, garden.use);
      if (!row.said.empty()) adding.say(row.said);
      if (auto open = adding.leave_out(id, row.use, corners); !open) return open.error();
    }
    if (box.beyond > kRectangle)
      adding.say("A garden is a rectangle: " + fixed(100 * box.beyond, 0) + " % of this one lies outside of the corners.");
  }
  if (!adding.has_link("solar_right", id)) {
    const std::string link = adding.new_link("sun_of_" + id);
    adding.link(link, {{"kind", "solar_right"}, {"from", id}, {"to", {{"typification", "smart_volume"}}}});
    adding.say("New: the link `" + link + "`: volumes that take its sun give way.");
  }
  return adding.take();
}

}  // namespace bl::making
