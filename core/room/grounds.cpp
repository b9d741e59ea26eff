// Each touch needs a ground of its own: areas and pens, what somebody has made, the role card, a visitor's form, the layout.
#include "core/room/grounds.h"

#include <algorithm>
#include <cctype>

#include <nlohmann/json.hpp>

#include "core/define/codec.h"
#include "core/room/areas.h"

namespace bl::room {

namespace {

using Given = std::optional<Refusal>;  // nothing: the ground holds

const NodeRecord* node_in(const Scene& scene, const std::string& id) {
  const auto found = scene.nodes.find(id);
  return found == scene.nodes.end() ? nullptr : &found->second;
}
const LinkRecord* link_in(const Scene& scene, const std::string& id) {
  const auto found = scene.links.find(id);
  return found == scene.links.end() ? nullptr : &found->second;
}

// `types/plot/rows/housing` split at its slashes.
std::vector<std::string_view> steps_of(std::string_view path) {
  std::vector<std::string_view> steps;
  while (!path.empty()) {
    const std::size_t slash = path.find('/');
    steps.push_back(path.substr(0, slash));
    path.remove_prefix(slash == std::string_view::npos ? path.size() : slash + 1);
  }
  return steps;
}

class Judge {
 public:
  Judge(const Asking& asking, Grounds grounds, const Command& command, const TriedChange& change)
      : asking_(asking), seat_(*asking.state.seat(asking.seat)), grounds_(grounds), command_(command), change_(change) {}

  Given look_at(const Touch& touch) {
    if (auto refusal = why_out_of_reach(touch)) return refusal;
    if (has(Ground::always)) return std::nullopt;
    if (asking_.is_in_draft) return in_draft(touch);
    if (has(Ground::if_allowed) && touch.part == ScenePart::script) return std::nullopt;
    if (has(Ground::own) && is_own(touch)) return std::nullopt;
    if (has(Ground::open_form) && is_open_form(touch)) return std::nullopt;
    Given refusal;
    if (has(Ground::on_card))
      if (!(refusal = on_card(touch))) return std::nullopt;
    if (has(Ground::in_area) || (has(Ground::own_in_area) && is_own(touch)))
      if (!(refusal = in_area(touch))) return std::nullopt;
    if (has(Ground::own_in_view) && touch.part == ScenePart::view)
      if (!(refusal = in_view(touch))) return std::nullopt;
    return refusal ? refusal : no(Reason::right, touch, "is not yours to change");
  }

 private:
  bool has(Ground ground) const { return has_ground(grounds_, ground); }

  static Given no(Reason why, const Touch& touch, const std::string& text, Json args = Json::object()) {
    return Refusal{why, text_of(touch), text, JsonValue::of(std::move(args))};
  }

  // What opens files and connections, and what runs text: the same for everybody and on all grounds.
  Given why_out_of_reach(const Touch& touch) const {
    if (touch.part != ScenePart::node) return std::nullopt;
    const NodeRecord* after = node_in(change_.after, touch.id);
    if (after == nullptr) return std::nullopt;
    const NodeRecord* before = node_in(change_.before, touch.id);
    if (!is_undo() && command_.id != "cast_vote" && has_other_ballots(before, *after))
      return no(Reason::right, touch, "holds ballots, which people give themselves");
    for (const auto& [id, values] : after->types) {
      const TypificationDefinition* type = asking_.registry.typification(id);
      if (type == nullptr) continue;
      for (const PortDefinition& port : type->ports)
        if (port.reaches_out && is_changed(before, id, values, port))
          if (!asking_.allowances.live || seat_.role != Role::facilitator)
            return no(Reason::right, touch,
                      "names a file or a connection (`" + id + "." + port.id +
                          "`), which only the facilitator may set, in a room with live connections");
    }
    return std::nullopt;
  }

  bool is_undo() const { return command_.id.empty(); }

  static bool has_other_ballots(const NodeRecord* before, const NodeRecord& after) {
    const auto vote = after.types.find("vote");
    if (vote == after.types.end()) return false;
    const auto ballots = vote->second.find("ballots");
    const PortValues* old = before != nullptr && before->types.contains("vote") ? &before->types.at("vote") : nullptr;
    const bool had = old != nullptr && old->contains("ballots");
    if (ballots == vote->second.end()) return had;
    return !had || !(old->at("ballots") == ballots->second);
  }

  static bool is_changed(const NodeRecord* before, const std::string& type, const PortValues& values,
                         const PortDefinition& port) {
    const auto now = values.find(port.id);
    if (now == values.end()) return false;  // its default reaches nothing
    const PortValues* old = before != nullptr && before->types.contains(type) ? &before->types.at(type) : nullptr;
    return old == nullptr || !old->contains(port.id) || !(old->at(port.id) == now->second);
  }

  Given in_draft(const Touch& touch) const {
    if (has(Ground::in_draft) || (has(Ground::own_in_draft) && is_own(touch))) return std::nullopt;
    return no(Reason::right, touch, "is not yours to change, not even in a draft");
  }

  // Made by this person, or their own row of a table; a device has the nodes that bear its name, and the one on its card.
  bool is_own(const Touch& touch) const {
    const std::string author = RoomState::author_of_seat(asking_.seat);
    if (touch.part == ScenePart::node) {
      const auto steps = steps_of(touch.path);
      if (steps.size() >= 4 && steps[0] == "types" && steps[3] == step_of(author)) return true;
      if (seat_.role == Role::device && is_of_device(touch.id)) return true;
    }
    if (touch.part != ScenePart::node && touch.part != ScenePart::link) return false;
    const auto maker = asking_.state.makers.find((touch.part == ScenePart::node ? "nodes/" : "links/") + touch.id);
    return maker != asking_.state.makers.end() && maker->second == asking_.seat;
  }

  // As many as the node on its card allows, where that is a sensor of people.
  bool is_of_device(const std::string& node) const {
    const std::string of_card = seat_.card + "#";
    if (!seat_.card.empty() && node.starts_with(of_card)) {
      const NodeRecord* card = node_in(change_.before, seat_.card);
      const TypificationDefinition* type = asking_.registry.typification("people_sensor");
      if (card == nullptr || type == nullptr || !card->types.contains(type->id)) return false;
      if (node_in(change_.before, node) != nullptr) return true;
      const auto count = std::count_if(change_.after.nodes.begin(), change_.after.nodes.end(),
                                       [&](const auto& one) { return one.first.starts_with(of_card); });
      const PortValues& values = card->types.at(type->id);
      const auto most = values.find("most");
      return count <= std::get<std::int64_t>(most == values.end() ? type->find_port("most")->default_value : most->second);
    }
    return node == seat_.card || node.starts_with("device_" + std::to_string(asking_.seat) + "_");
  }

  // A new node, of kinds that the phase lets visitors add, in their area where they have one.
  bool is_open_form(const Touch& touch) const {
    const NodeRecord* node = node_in(change_.after, touch.id);
    if (touch.part != ScenePart::node || !touch.path.empty() || node == nullptr || node_in(change_.before, touch.id) != nullptr)
      return false;
    const auto& forms = asking_.state.phase.forms;
    bool is_of_form = false;
    for (const auto& [type, values] : node->types) {
      if (type != kBaseNode && !forms.contains(type)) return false;
      is_of_form = is_of_form || type != kBaseNode;
    }
    if (!is_of_form || !node->ghosts.empty() || !node->locked.empty()) return false;
    return seat_.areas.empty() || may_change(asking_.state, asking_.registry, asking_.seat, touch.id, *node).is_granted;
  }

  // What is there before lies in an area, and what is there afterwards: nobody carries things in or out.
  Given in_area(const Touch& touch) const {
    bool is_somewhere = false;
    for (const Scene* scene : {&change_.before, &change_.after}) {
      AreaAnswer answer;
      if (touch.part == ScenePart::node) {
        const NodeRecord* node = node_in(*scene, touch.id);
        if (node == nullptr) continue;
        answer = may_change(asking_.state, asking_.registry, asking_.seat, touch.id, *node);
      } else if (touch.part == ScenePart::link) {
        const LinkRecord* link = link_in(*scene, touch.id);
        if (link == nullptr) continue;
        answer = may_change(asking_.state, asking_.registry, asking_.seat, *scene, *link);
      } else {
        return no(Reason::area, touch, "belongs to the whole scene; propose it in a draft");
      }
      if (!answer.is_granted) return outside(touch, answer);
      is_somewhere = true;
    }
    return is_somewhere ? std::nullopt : no(Reason::area, touch, "lies in none of your areas");
  }

  Given outside(const Touch& touch, const AreaAnswer& answer) const {
    if (answer.held.empty()) return no(Reason::area, touch, "lies in none of your areas");
    const Seat* holder = asking_.state.seat(answer.holder);
    const std::string who = holder == nullptr ? "somebody" : holder->name;
    return no(Reason::area, touch, who + " holds the pen of the area " + answer.held, {{"area", answer.held}, {"holder", who}});
  }

  // `types/smart_volume/demand` of a node, or `strength` or `parameters/gain` of a link, as a row of the role card names it.
  Given on_card(const Touch& touch) const {
    const auto steps = steps_of(touch.path);
    std::string port;
    if (touch.part == ScenePart::node && steps.size() == 3 && steps[0] == "types")
      port = std::string(steps[1]) + "." + std::string(steps[2]);
    else if (touch.part == ScenePart::link && touch.path == "strength") port = "strength";
    else if (touch.part == ScenePart::link && steps.size() == 2 && steps[0] == "parameters") port = std::string(steps[1]);
    else return no(Reason::right, touch, "is not on your role card");
    const Table* controls = controls_of_card();
    if (controls == nullptr) return no(Reason::right, touch, "is not yours to change: you have no role card");
    for (std::size_t row = 0; row < controls->rows.size(); ++row) {
      if (controls->text(row, "node") != touch.id || controls->text(row, "port") != port) continue;
      return in_range(touch, port, controls->number(row, "minimum"), controls->number(row, "maximum"));
    }
    return no(Reason::right, touch, "is not on your role card");
  }

  const Table* controls_of_card() const {
    const NodeRecord* card = node_in(change_.before, seat_.card);
    if (card == nullptr) return nullptr;
    const auto group = card->types.find("stakeholder_group");
    if (group == card->types.end()) return nullptr;
    const auto controls = group->second.find("controls");
    return controls == group->second.end() ? nullptr : &**std::get_if<Shared<Table>>(&controls->second);
  }

  Given in_range(const Touch& touch, const std::string& port, double minimum, double maximum) const {
    if (is_undo()) return std::nullopt;  // what was there before was somebody's to set
    const std::optional<double> value = number_after(touch, port);
    if (!value || minimum >= maximum || (*value >= minimum && *value <= maximum)) return std::nullopt;
    return no(Reason::range, touch, "goes from " + Json(minimum).dump() + " to " + Json(maximum).dump() + " on your role card",
              {{"minimum", minimum}, {"maximum", maximum}});
  }

  // Nothing where the value is no number.
  std::optional<double> number_after(const Touch& touch, const std::string& port) const {
    if (touch.part == ScenePart::link) {
      const LinkRecord* link = link_in(change_.after, touch.id);
      if (link == nullptr) return std::nullopt;
      if (port == "strength") return link->strength;
      const LinkDefinition* kind = change_.after.scripts.types(asking_.registry).link(link->kind);
      const PortDefinition* parameter = kind == nullptr ? nullptr : kind->find_port(port);
      return parameter == nullptr ? std::nullopt : number_of(link->parameters, *parameter);
    }
    const auto path = parse_port_path(port);
    const NodeRecord* node = node_in(change_.after, touch.id);
    if (!path || node == nullptr || !node->types.contains(path->typification)) return std::nullopt;
    const auto definition = asking_.registry.port(*path);
    return definition ? number_of(node->types.at(path->typification), **definition) : std::nullopt;
  }

  static std::optional<double> number_of(const PortValues& values, const PortDefinition& port) {
    const auto set = values.find(port.id);
    const Value& value = set == values.end() ? port.default_value : set->second;
    const bool is_number = std::holds_alternative<double>(value) || std::holds_alternative<std::int64_t>(value);
    return is_number ? std::optional(as_number(value)) : std::nullopt;
  }

  // A place of the view inside a part named after a node: `boxes/tower`.
  Given in_view(const Touch& touch) const {
    const auto* changes = command_.id == "set_view" ? &command_.arguments : nullptr;
    if (changes != nullptr && changes->contains("whole") && std::get<bool>(changes->at("whole")))
      return no(Reason::right, touch, "as a whole is only for the facilitator to replace");
    if (changes != nullptr && changes->contains("changes") &&
        std::get<JsonValue>(changes->at("changes")).text().size() > kLongestViewPatch)
      return no(Reason::size, touch, "changes by " + std::to_string(kLongestViewPatch) + " characters at most");
    const auto steps = steps_of(touch.path);
    const NodeRecord* node = steps.size() < 2 ? nullptr : node_in(change_.after, std::string(steps[1]));
    if (node == nullptr) return no(Reason::right, touch, "is the view that everybody sees, not the place of one of your nodes");
    const AreaAnswer answer = may_change(asking_.state, asking_.registry, asking_.seat, std::string(steps[1]), *node);
    return answer.is_granted ? std::nullopt : outside(touch, answer);
  }

  const Asking& asking_;
  const Seat& seat_;
  const Grounds grounds_;
  const Command& command_;
  const TriedChange& change_;
};

}  // namespace

std::optional<Refusal> why_ungrounded(const Asking& asking, Grounds grounds, const Command& command, const TriedChange& change) {
  Judge judge(asking, grounds, command, change);
  if (change.after.view.size() > kLongestView && change.after.view.size() > change.before.view.size())
    return Refusal{Reason::size, "view", "the view has " + std::to_string(kLongestView) + " characters at most", {}};
  for (const Touch& touch : change.touches)
    if (auto refusal = judge.look_at(touch)) return refusal;
  return std::nullopt;
}

std::string lower_first(std::string_view label) {
  std::string text(label);
  if (!text.empty()) text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  return text;
}

std::string_view name_of(Role role) { return kRoleNames[static_cast<std::size_t>(role)]; }

}  // namespace bl::room
