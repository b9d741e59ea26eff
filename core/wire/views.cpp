// Each view is a pure function of the published state and the room; what is sent is the difference of two of them.
#include "core/wire/views.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/base/unit.h"
#include "core/define/codec.h"
#include "core/reading/figures.h"
#include "core/reading/plot_problems.h"
#include "core/reading/views/people.h"
#include "core/wire/decisions_view.h"
#include "core/wire/draft_views.h"
#include "core/wire/lead_view.h"
#include "core/wire/messages.h"
#include "core/wire/past_view.h"
#include "core/wire/plan_view.h"
#include "core/wire/shapes_view.h"
#include "core/wire/view_parts.h"

namespace bl::wire {

namespace {

const std::string& name_of(const State& state, std::uint32_t node) {
  const NodePlan& plan = state.plan->nodes[node];
  return plan.name.empty() ? plan.id : plan.name;
}

// The numbers that a visitor's form asks for, with their usual ranges.
Json form_of(const std::string& typification) {
  Json form = Json::object();
  const TypificationDefinition* type = full_registry().typification(typification);
  if (type == nullptr) return form;
  for (const PortDefinition& port : type->ports)
    if (!port.is_computed && port.kind == ValueKind::number && port.soft_minimum && port.soft_maximum)
      form[port.id] = {{"minimum", *port.soft_minimum}, {"maximum", *port.soft_maximum}, {"unit", info(port.unit).symbol}};
  return form;
}

// The role cards of the scene: who can be given which.
Json cards_of(const State& state) {
  Json cards = Json::object();
  for (const auto& row : reading::rows<reading::GroupFigures>(state))
    cards[state.plan->nodes[row.node].id] = {{"name", name_of(state, row.node)}, {"interest", row.figures.interest}};
  return cards;
}

View room_view(const ViewSources& sources) {
  const room::RoomState& state = sources.room.state();
  View view;
  Json phase = {{"name", sources.room.words(state.phase.name)},
                {"activities", Json::array()},
                {"ends_at", state.phase.ends_at},
                {"forms", state.phase.forms}};
  for (const Activity activity : state.phase.activities)
    phase["activities"].push_back(kActivityNames[static_cast<std::size_t>(activity)]);
  Json seats = Json::object();
  for (const auto& [number, seat] : state.seats) {
    if (seat.is_removed) continue;
    seats[std::to_string(number)] = {{"role", kRoleNames[static_cast<std::size_t>(seat.role)]},
                                     {"name", seat.name},
                                     {"colour", seat.colour},
                                     {"card", seat.card},
                                     {"areas", seat.areas},
                                     {"here", seat.is_here},
                                     {"muted", seat.is_muted}};
    if (seat.is_waiting) seats[std::to_string(number)]["waits"] = true;
  }
  put(view, "title", sources.title);
  put(view, "code", sources.code);
  put(view, "phase", phase);
  put(view, "seats", seats);
  Json forms = Json::object();
  for (const std::string& typification : state.phase.forms) forms[typification] = form_of(typification);
  put(view, "forms", forms);
  put(view, "cards", cards_of(sources.state));
  put(view, "areas", [&] {
    Json areas = Json::object();
    for (const auto& [name, area] : state.areas) areas[name] = {{"pen", area.pen}, {"asking", area.asking}};
    return areas;
  }());
  put(view, "scenarios", [&] {
    Json scenarios = Json::object();
    for (const auto& [id, scenario] : state.scenarios)
      scenarios[id] = {{"name", sources.room.words(scenario.name)},
                       {"note", sources.room.words(scenario.note)},
                       {"seat", scenario.seat},
                       {"seq", scenario.seq},
                       {"tick", scenario.tick}};
    return scenarios;
  }());
  put(view, "epoch", state.epoch);
  put(view, "door", room::kDoorNames[static_cast<std::size_t>(state.door)]);
  put(view, "layout", state.layout);
  put(view, "paused", state.is_paused);
  put(view, "closed", state.is_closed);
  put(view, "shares_minutes", state.shares_minutes);
  put(view, "rate", state.rate);
  return view;
}

Json figure_of(const State& state, const reading::Row<reading::IndicatorFigures>& row) {
  const reading::IndicatorFigures& figures = row.figures;
  return {{"name", name_of(state, row.node)}, {"value", figures.value},   {"unit", figures.unit},  {"target", figures.target},
          {"direction", figures.direction},   {"status", figures.status}, {"score", figures.score}};
}

// A rule of a plot that is broken stands among the figures, so that a room sees it without asking.
Json figure_of(const State& state, const reading::BrokenRule& rule) {
  static const std::map<std::string_view, std::pair<const char*, const char*>> kRules = {
      {"fsi_max", {"FSI", ""}}, {"gsi_max", {"GSI", ""}}, {"height_max", {"height", "m"}}, {"setback", {"set-back", "m"}}};
  const auto& [name, unit] = kRules.at(rule.port);
  return {{"name", name_of(state, rule.plot) + ": " + name},
          {"value", rule.found},
          {"unit", unit},
          {"target", rule.allowed},
          {"direction", rule.port == "setback" ? "at_least" : "at_most"},
          {"status", "far"},
          {"score", 0},
          {"why", rule.text}};
}

View figures_view(const ViewSources& sources) {
  View view;
  if (sources.state.tick > 0)
    for (const reading::BrokenRule& rule : reading::broken_rules(sources.state))
      put(view, sources.state.plan->nodes[rule.plot].id + "/" + rule.port, figure_of(sources.state, rule));
  for (const auto& row : reading::rows<reading::IndicatorFigures>(sources.state))
    put(view, sources.state.plan->nodes[row.node].id, figure_of(sources.state, row));
  return view;
}

// A number that links leave of what people have set; nothing where it is the same.
std::optional<double> outcome_of(const State& state, const std::string& node, const PortPath& path, const Json& set) {
  const std::uint32_t index = state.plan->node_index(node);
  const auto port = index < state.plan->nodes.size() ? state.plan->find(index, path) : std::nullopt;
  if (!port || !set.is_number()) return std::nullopt;
  const Value& value = state.value(*port);
  const double wanted = set.get<double>();
  if (!std::holds_alternative<double>(value) || as_number(value) == wanted) return std::nullopt;
  return as_number(value);
}

// What a control is of: the port, the value as people have set it, and where that stands.
void describe_value(Json& control, const PortDefinition& port, const PortValues& values) {
  const auto set = values.find(port.id);
  control["value"] = value_to_json(set == values.end() ? port.default_value : set->second, port);
  control["unit"] = info(port.unit).symbol;
  if (control["label"] == "") control["label"] = port.id;
}

// Of a node: also what comes of the value together with the links that act on it.
void describe_node_control(Json& control, const ViewSources& sources, const std::string& node, const std::string& port) {
  const auto path = parse_port_path(port);
  const auto definition = path ? full_registry().port(*path) : Result<const PortDefinition*>(Error{});
  const auto record = sources.room.scene().nodes.find(node);
  if (!definition || record == sources.room.scene().nodes.end() || !record->second.types.contains(path->typification)) return;
  describe_value(control, **definition, record->second.types.at(path->typification));
  if (const auto outcome = outcome_of(sources.state, node, *path, control["value"])) control["outcome"] = *outcome;
}

// Of a link: its strength, or a parameter of its kind.
void describe_link_control(Json& control, const LinkRecord& link, const std::string& port, const Registry& kinds) {
  const LinkDefinition* kind = kinds.link(link.kind);
  if (port == "strength") {
    control["value"] = link.strength;
    control["unit"] = "";
    if (control["label"] == "") control["label"] = port;
  } else if (const PortDefinition* parameter = kind == nullptr ? nullptr : kind->find_port(port)) {
    describe_value(control, *parameter, link.parameters);
  }
}

// A row of a role card.
Json control_of(const ViewSources& sources, const Table& controls, std::size_t row) {
  const std::string node = controls.text(row, "node"), port = controls.text(row, "port");
  Json control = {{"node", node}, {"port", port}, {"label", controls.text(row, "label")}};
  const Scene& scene = sources.room.scene();
  Touch place{ScenePart::node, node, ""};
  if (const auto link = scene.links.find(node); link != scene.links.end() && !scene.nodes.contains(node)) {
    describe_link_control(control, link->second, port, scene.scripts.types(full_registry()));
    place = {ScenePart::link, node, port == "strength" ? port : "parameters/" + step_of(port)};
  } else {
    describe_node_control(control, sources, node, port);
    if (const auto path = parse_port_path(port)) place.path = "types/" + step_of(path->typification) + "/" + step_of(path->port);
  }
  const std::string by = control.contains("value") ? sources.room.last_writer(place) : std::string();
  if (!by.empty()) control["by"] = seat_name(sources.room.state(), by);
  for (const char* number : {"minimum", "maximum", "step"}) control[number] = controls.number(row, number);
  control["costs"] = controls.text(row, "costs_whom");
  return control;
}

View card_view(const ViewSources& sources, std::int64_t number) {
  View view;
  const room::Seat* seat = sources.room.state().seat(number);
  const State& state = sources.state;
  const std::uint32_t node = seat == nullptr || seat->card.empty() ? static_cast<std::uint32_t>(state.plan->nodes.size())
                                                                   : state.plan->node_index(seat->card);
  if (node >= state.plan->nodes.size()) return view;
  const auto group = reading::row_of<reading::GroupFigures>(state, node);
  if (!group) return view;
  put(view, "name", name_of(state, node));
  put(view, "interest", group->interest);
  put(view, "budget", {{"budget", group->budget}, {"spent", group->spent}, {"left", group->budget_left}});
  Json goals = Json::array(), controls = Json::array();
  for (const std::string& id : resolve(state.plan->scene, full_registry(), group->goals)) {
    const std::uint32_t goal = state.plan->node_index(id);
    if (goal >= state.plan->nodes.size()) continue;
    if (const auto figures = reading::row_of<reading::IndicatorFigures>(state, goal))
      goals.push_back(figure_of(state, {goal, *figures}));
  }
  for (std::size_t row = 0; row < group->controls->rows.size(); ++row)
    controls.push_back(control_of(sources, *group->controls, row));
  put(view, "goals", goals);
  put(view, "controls", controls);
  return view;
}

// Of a named vote; a secret ballot is nobody's any more once it is cast.
Json own_ballot(const Table& ballots, const std::string& kind, std::int64_t seat) {
  const std::size_t row = ballots.row_of("voter", room::RoomState::author_of_seat(seat));
  if (row == ballots.rows.size()) return nullptr;
  if (kind == "slider") return ballots.number(row, "value");
  if (kind == "yes_no") return ballots.text(row, "answer");
  Json list = Json::array();
  std::string rest = ballots.text(row, "answer");
  while (!rest.empty()) {
    const std::size_t space = rest.find(' ');
    list.push_back(rest.substr(0, space));
    rest = space == std::string::npos ? "" : rest.substr(space + 1);
  }
  if (kind == "rank") return list;
  if (kind == "coins") {
    Json coins = Json::object();
    const std::vector<double>& numbers = *ballots.numbers(row, "coins");
    for (std::size_t k = 0; k < list.size() && k < numbers.size(); ++k) coins[list[k].get<std::string>()] = numbers[k];
    return coins;
  }
  Json dots = Json::array();
  const std::vector<double>& places = *ballots.numbers(row, "places");
  for (std::size_t k = 0; k < list.size() && 3 * k + 2 < places.size(); ++k)
    dots.push_back({{"place", {places[3 * k], places[3 * k + 1], places[3 * k + 2]}}, {"option", list[k]}});
  return dots;
}

Json result_of(const Table& results) {
  Json list = Json::array();
  for (std::size_t row = 0; row < results.rows.size(); ++row)
    list.push_back({{"option", results.text(row, "option")},
                    {"label", results.text(row, "label")},
                    {"points", results.number(row, "points")},
                    {"share", results.number(row, "share")}});
  return list;
}

View votes_view(const ViewSources& sources, std::int64_t seat) {
  View view;
  for (const auto& [node, figures] : reading::rows<reading::VoteFigures>(sources.state)) {
    const std::string& id = sources.state.plan->nodes[node].id;
    const auto open = sources.room.state().votes.find(id);
    Json options = Json::array();
    for (std::size_t row = 0; row < figures.options->rows.size(); ++row)
      options.push_back({{"id", figures.options->text(row, "id")}, {"label", figures.options->text(row, "label")}});
    Json vote = {{"question", figures.question.empty() ? name_of(sources.state, node) : figures.question},
                 {"kind", figures.kind},
                 {"options", options},
                 {"points", figures.points},
                 {"whole", figures.is_whole_ranking},
                 {"least", figures.least},
                 {"most", figures.most},
                 {"unit", figures.unit},
                 {"open", open != sources.room.state().votes.end()},
                 {"opened", sources.room.state().opened.contains(id)},
                 {"secret", figures.is_secret},
                 {"ends_at", open == sources.room.state().votes.end() ? 0 : open->second.ends_at},
                 {"mine", own_ballot(*figures.ballots, figures.kind, seat)},
                 {"count", figures.ballot_count},
                 {"electorate", figures.electorate}};
    vote["turnout"] = figures.electorate > 0 ? Json(figures.turnout) : Json();
    vote["result"] = figures.is_shown ? result_of(*figures.results) : Json();
    vote["leading"] = figures.is_shown ? figures.leading : "";
    vote["mean"] = figures.is_shown ? Json(figures.mean) : Json();
    vote["median"] = figures.is_shown ? Json(figures.median) : Json();
    put(view, id, vote);
  }
  return view;
}

View comments_view(const ViewSources& sources, std::int64_t seat) {
  View view;
  for (const auto& [id, comment] : sources.room.state().comments) {
    Json json = {{"seat", comment.seat},
                 {"text", text_of(sources.room, comment.text)},
                 {"state", room::kCommentStateNames[static_cast<std::size_t>(comment.state)]}};
    if (!comment.anchor.node.empty()) json["node"] = comment.anchor.node;
    if (!comment.anchor.scenario.empty()) json["scenario"] = comment.anchor.scenario;
    if (comment.anchor.place) json["place"] = {comment.anchor.place->x, comment.anchor.place->y, comment.anchor.place->z};
    if (comment.anchor.tick) json["tick"] = *comment.anchor.tick;
    if (!comment.parent.empty()) json["parent"] = comment.parent;
    if (!comment.answer.empty()) json["answer"] = text_of(sources.room, comment.answer);
    const auto count = [&](int rating) {
      return std::count_if(comment.ratings.begin(), comment.ratings.end(),
                           [rating](const auto& one) { return one.second == rating; });
    };
    const auto mine = comment.ratings.find(seat);
    json["plus"] = count(1);
    json["minus"] = count(-1);
    json["mine"] = mine == comment.ratings.end() ? 0 : mine->second;
    put(view, id, json);
  }
  return view;
}

// The keys of invitations: who has one can give seats away, so only who leads sees them.
View keys_view(const ViewSources& sources, std::int64_t number) {
  View view;
  const room::Seat* seat = sources.room.state().seat(number);
  if (seat == nullptr || seat->role != Role::facilitator || sources.invites == nullptr) return view;
  for (const auto& [role, key] : *sources.invites) put(view, role, key);
  return view;
}

}  // namespace

bool is_view(std::string_view name) {
  return std::find(std::begin(kViewNames), std::end(kViewNames), name) != std::end(kViewNames);
}

bool is_of_seat(std::string_view view) {
  static constexpr std::string_view kOfSeats[] = {"card",        "votes",       "comments", "drafts",
                                                  "draft_steps", "draft_plans", "keys",     "lead"};
  return std::find(std::begin(kOfSeats), std::end(kOfSeats), view) != std::end(kOfSeats);
}

bool is_as_for_all(std::string_view name, const ViewSources& sources, std::int64_t seat) {
  const auto& comments = sources.room.state().comments;
  return name == "comments" &&
         std::none_of(comments.begin(), comments.end(), [seat](const auto& one) { return one.second.ratings.contains(seat); });
}

bool is_of_events(std::string_view name) { return name == "comments"; }

bool is_of_state(std::string_view view) { return view == "plan" || view == "shapes"; }

View make_view(std::string_view name, const ViewSources& sources, std::int64_t seat) {
  if (name == "room") return room_view(sources);
  if (name == "plan") return plan_view(sources.state);
  if (name == "figures") return figures_view(sources);
  if (name == "card") return card_view(sources, seat);
  if (name == "votes") return votes_view(sources, seat);
  if (name == "comments") return comments_view(sources, seat);
  if (name == "proposals") return proposals_view(sources);
  if (name == "drafts") return drafts_view(sources, seat);
  if (name == "draft_steps") return draft_steps_view(sources, seat);
  if (name == "draft_plans") return draft_plans_view(sources, seat);
  if (name == "keys") return keys_view(sources, seat);
  if (name == "lead") return lead_view(sources, seat);
  if (name == "decisions") return decisions_view(sources);
  if (name == "past") return past_view(sources);
  if (name == "shapes") return shapes_view(sources.state);
  return {};
}

std::optional<std::string> changes_of(std::string_view name, const View* before, const View& now, std::int64_t tick,
                                      std::int64_t seq) {
  StateOut message{.view = std::string(name), .k = tick, .s = seq, .set = {}, .drop = {}, .whole = before == nullptr};
  Json set = Json::object();
  for (const auto& [key, content] : now) {
    const auto old = before == nullptr ? View::const_iterator() : before->find(key);
    if (before == nullptr || old == before->end() || old->second != content) set[key] = *parse_json(content);
  }
  if (before != nullptr)
    for (const auto& [key, content] : *before)
      if (!now.contains(key)) message.drop.push_back(key);
  if (before != nullptr && set.empty() && message.drop.empty()) return std::nullopt;
  message.set = JsonValue::of(std::move(set));
  return write_message(message);
}

}  // namespace bl::wire
