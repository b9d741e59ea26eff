// Ballots of all kinds in the tab Room. What a ballot still lacks is said by core/vote, which counts it.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include <imgui.h>
#include <imgui_stdlib.h>
#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/reading/figures.h"
#include "core/session/commands.h"
#include "core/vote/ballot_json.h"
#include "ui/desktop/panels/inspector_cell.h"
#include "ui/desktop/panels/room_panel.h"
#include "ui/desktop/panels/scene_view.h"

namespace bl::desktop {

namespace {

// What is filled in and not cast yet; it begins as the ballot that counts.
vote::Ballot& ballot_for(const RoomDesk& desk, const AgendaVote& vote) {
  std::map<std::string, vote::Ballot>& ballots = memory_of(desk.editor).ballots;
  return ballots.try_emplace(vote.id, vote.mine.value_or(vote::Ballot{})).first->second;
}

void cast_ballot(const RoomDesk& desk, const AgendaVote& vote, const Json& ballot) {
  PanelMemory& memory = memory_of(desk.editor);
  if (!desk.editor.submit(command<CastVote>({vote.id, desk.room.author(), JsonValue::of(ballot)}))) return;
  memory.ballots.erase(vote.id);
  desk.text("secret/" + vote.id) = vote.is_secret && !ballot.is_null() ? "cast" : "";
  if (memory.placing && memory.placing->vote == vote.id) memory.placing.reset();
}

std::string why_no_ballot(const RoomDesk& desk) {
  const std::string& role = desk.room.role();
  if (role == "viewer" || role == "recorder" || role == "device") return "A " + role + " does not vote.";
  if (!desk.leads && !desk.agenda.may.contains("vote")) return "In this phase nobody can vote.";
  return "";
}

// The sentence of core/vote, with the words of options in place of their ids.
std::string gap_words(const AgendaVote& vote, const vote::Ballot& ballot) {
  const auto fits = vote::check_ballot(vote.asks, ballot);
  if (fits) return "";
  std::string text = fits.error().message;
  for (const vote::Option& option : vote.asks.options) {
    const std::string id = "`" + option.id + "`";
    for (std::size_t at = text.find(id); at != std::string::npos; at = text.find(id))
      text.replace(at, id.size(), option_words(vote, option.id));
  }
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text + ".";
}

std::string left_words(std::int64_t left, std::int64_t all) {
  return std::to_string(left) + " of " + std::to_string(all) + " left";
}

// --- One form for each kind -----------------------------------------------------------------------------------------

void fill_yes_no(const RoomDesk& desk, const AgendaVote& vote, const std::string& why) {
  for (const vote::Option& option : vote.asks.options) {
    if (&option != &vote.asks.options.front()) ImGui::SameLine();
    const bool is_mine = vote.mine && vote.mine->options.size() == 1 && vote.mine->options.front() == option.id;
    if (is_mine) ImGui::PushStyleColor(ImGuiCol_Button, desk.editor.theme.colours().accent_soft);
    const std::string key = "roompanel/" + option.id + "/" + vote.id;
    if (desk.button((is_mine ? "> " : "") + option.label, key, why)) cast_ballot(desk, vote, option.id);
    if (is_mine) ImGui::PopStyleColor();
  }
}

void fill_slider(const RoomDesk& desk, const AgendaVote& vote, vote::Ballot& ballot) {
  std::string& typed = desk.text("ballot/" + vote.id);
  if (typed.empty() && vote.mine) typed = shortest(ballot.value);
  char* end = nullptr;
  double value = std::strtod(typed.c_str(), &end);
  const bool is_number = !typed.empty() && *end == '\0' && std::isfinite(value);
  if (!is_number) value = std::numeric_limits<double>::quiet_NaN();  // no answer yet: outside every range
  double shown = is_number ? std::clamp(value, vote.asks.least, vote.asks.most) : (vote.asks.least + vote.asks.most) / 2;
  ImGui::SetNextItemWidth(-desk.editor.theme.px(90));
  if (ImGui::SliderScalar("##slide", ImGuiDataType_Double, &shown, &vote.asks.least, &vote.asks.most,
                          is_number ? "%.4g" : "slide or type")) {
    // Steps that people can hit: about a hundred of them, round.
    const double step = std::pow(10.0, std::floor(std::log10(vote.asks.most - vote.asks.least)) - 2);
    value = std::clamp(std::round(shown / step) * step, vote.asks.least, vote.asks.most);
    typed = reading::readable(value);
    typed.erase(std::remove(typed.begin(), typed.end(), ' '), typed.end());
    value = std::strtod(typed.c_str(), nullptr);
  }
  note_place(desk.editor, "roompanel/slide/" + vote.id);
  ImGui::SameLine();
  ImGui::SetNextItemWidth(desk.editor.theme.px(60));
  ImGui::InputText("##ballot", &typed);
  note_place(desk.editor, "roompanel/ballot/" + vote.id);
  if (!vote.unit.empty()) {
    ImGui::SameLine();
    ImGui::TextUnformatted(vote.unit.c_str());
  }
  ballot = vote::Ballot{};
  ballot.value = value;
}

void fill_rank(const RoomDesk& desk, const AgendaVote& vote, vote::Ballot& ballot) {
  desk.quiet("Add the best first. Drag a line, or use the buttons, to change the order.");
  std::vector<std::string>& ranked = ballot.options;
  std::optional<std::pair<std::size_t, std::size_t>> swapped;
  float buttons = desk.editor.theme.px(8);
  for (const char* label : {"up", "down", "x"})
    buttons += ImGui::CalcTextSize(label).x + 2 * ImGui::GetStyle().FramePadding.x + desk.editor.theme.px(4);
  std::size_t gone = ranked.size();
  for (std::size_t k = 0; k < ranked.size(); ++k) {
    ImGui::PushID(ranked[k].c_str());  // a line that is dragged stays the same one
    const std::string key = "roompanel/rank/" + vote.id + "/" + ranked[k];
    const float room = ImGui::GetContentRegionAvail().x - buttons;
    ImGui::Selectable((std::to_string(k + 1) + ".  " + option_words(vote, ranked[k]) + "###line").c_str(), false, 0, {room, 0});
    note_place(desk.editor, key);
    // A line that is dragged changes places with the one that it has come to.
    if (ImGui::IsItemActive() && !ImGui::IsItemHovered()) {
      const bool is_up = ImGui::GetIO().MousePos.y < ImGui::GetItemRectMin().y;
      const bool is_down = ImGui::GetIO().MousePos.y > ImGui::GetItemRectMax().y;
      if (is_up && k > 0) swapped = {k, k - 1};
      if (is_down && k + 1 < ranked.size()) swapped = {k, k + 1};
    }
    ImGui::SameLine(0, desk.editor.theme.px(4));
    if (desk.button("up", key + "/up", k == 0 ? "It is the first." : "")) swapped = {k, k - 1};
    ImGui::SameLine(0, desk.editor.theme.px(4));
    if (desk.button("down", key + "/down", k + 1 == ranked.size() ? "It is the last." : "")) swapped = {k, k + 1};
    ImGui::SameLine(0, desk.editor.theme.px(4));
    if (desk.button("x", key + "/x")) gone = k;
    ImGui::PopID();
  }
  if (swapped) std::swap(ranked[swapped->first], ranked[swapped->second]);
  if (gone < ranked.size()) ranked.erase(ranked.begin() + static_cast<std::ptrdiff_t>(gone));
  for (const vote::Option& option : vote.asks.options) {
    if (std::find(ranked.begin(), ranked.end(), option.id) != ranked.end()) continue;
    const std::string label = "Place " + std::to_string(ranked.size() + 1) + ": " + option_words(vote, option.id);
    if (desk.button(label, "roompanel/rank/" + vote.id + "/add/" + option.id)) ranked.push_back(option.id);
  }
}

void fill_coins(const RoomDesk& desk, const AgendaVote& vote, vote::Ballot& ballot) {
  double given = 0;
  for (const double coins : ballot.coins) given += coins;
  const std::int64_t left = vote.asks.points - std::llround(given);
  desk.quiet("Coins: " + left_words(left, vote.asks.points) + ". You need not spend all.");
  for (const vote::Option& option : vote.asks.options) {
    const auto k =
        static_cast<std::size_t>(std::find(ballot.options.begin(), ballot.options.end(), option.id) - ballot.options.begin());
    const double coins = k < ballot.coins.size() ? ballot.coins[k] : 0;
    const std::string key = "roompanel/coins/" + vote.id + "/" + option.id;
    if (desk.button("-", key + "/less", coins > 0 ? "" : "No coin lies there.")) {
      if (coins > 1) {
        ballot.coins[k] -= 1;
      } else {
        ballot.options.erase(ballot.options.begin() + static_cast<std::ptrdiff_t>(k));
        ballot.coins.erase(ballot.coins.begin() + static_cast<std::ptrdiff_t>(k));
      }
    }
    ImGui::SameLine(0, desk.editor.theme.px(6));
    ImGui::Text("%3d", static_cast<int>(coins));
    ImGui::SameLine(0, desk.editor.theme.px(6));
    if (desk.button("+", key + "/more", left > 0 ? "" : "No coin is left.")) {
      if (coins > 0) {
        ballot.coins[k] += 1;
      } else {
        ballot.options.push_back(option.id);
        ballot.coins.push_back(1);
      }
    }
    ImGui::SameLine();
    ImGui::TextUnformatted(option_words(vote, option.id).c_str());
  }
}

// Where the 3D view shows a node; nothing where there is none.
std::optional<Point3> shown_place(const RoomDesk& desk, std::uint32_t node) {
  const SceneFacts* facts = desk.editor.view == nullptr ? nullptr : desk.editor.view->facts();
  if (facts == nullptr || node >= facts->places.size()) return std::nullopt;
  return facts->places[node];
}

// The name of the node that stands nearest, where it is near.
std::string place_words(const RoomDesk& desk, const Point3& place) {
  constexpr double kNear = 20;  // [m]
  std::string best;
  double least = kNear;
  const State& state = desk.editor.state();
  for (std::uint32_t node = 0; node < state.plan->nodes.size(); ++node) {
    const auto at = shown_place(desk, node);
    const double far = at ? std::hypot(at->x - place.x, at->y - place.y) : kNear;
    if (far >= least) continue;
    least = far;
    best = desk.editor.name_of(state.plan->nodes[node].id);
  }
  return best.empty() ? "somewhere" : best;
}

void fill_dots(const RoomDesk& desk, const AgendaVote& vote, vote::Ballot& ballot) {
  PanelMemory& memory = memory_of(desk.editor);
  const auto most = static_cast<std::size_t>(std::max<std::int64_t>(0, vote.asks.points));
  const std::size_t left = most - std::min(most, ballot.options.size());
  std::string& chosen = desk.text("dot/" + vote.id);
  if (chosen.empty() && !vote.asks.options.empty()) chosen = vote.asks.options.front().id;
  desk.quiet("Dots: " + left_words(static_cast<std::int64_t>(left), vote.asks.points) + ". Choose what the next dot says:");
  for (const vote::Option& option : vote.asks.options) {
    if (&option != &vote.asks.options.front()) desk.same_line_for(option_words(vote, option.id));
    if (ImGui::RadioButton(option_words(vote, option.id).c_str(), chosen == option.id)) chosen = option.id;
    note_place(desk.editor, "roompanel/dots/" + vote.id + "/says/" + option.id);
  }
  const bool is_placing = memory.placing && memory.placing->vote == vote.id;
  if (desk.button(is_placing ? "Done" : "Set dots in the 3D view", "roompanel/dots/" + vote.id + "/place")) {
    if (is_placing) memory.placing.reset();
    else memory.placing.emplace().vote = vote.id;
  }
  if (memory.placing && memory.placing->vote == vote.id) {
    memory.placing->option = chosen;
    memory.placing->words = option_words(vote, chosen);
    memory.placing->options.clear();
    for (const vote::Option& option : vote.asks.options) memory.placing->options.push_back(option.id);
    memory.placing->most = most;
  }
  const std::set<std::string>& nodes = desk.editor.picks.nodes;
  const auto at = nodes.size() == 1 ? shown_place(desk, desk.editor.index_of(*nodes.begin())) : std::nullopt;
  const std::string on = at ? "Set on " + desk.editor.name_of(*nodes.begin()) : "Set on what is chosen";
  desk.same_line_for(on);
  if (desk.button(on, "roompanel/dots/" + vote.id + "/on", !at ? "Choose one node first." : left == 0 ? "No dot is left." : "")) {
    ballot.options.push_back(chosen);
    ballot.places.push_back(*at);
  }
  std::size_t gone = ballot.options.size();
  for (std::size_t k = 0; k < ballot.options.size() && k < ballot.places.size(); ++k) {
    ImGui::PushID(static_cast<int>(k));
    if (desk.button("x", "roompanel/dots/" + vote.id + "/x/" + std::to_string(k))) gone = k;
    ImGui::SameLine();
    ImGui::TextUnformatted((option_words(vote, ballot.options[k]) + ", near " + place_words(desk, ballot.places[k])).c_str());
    ImGui::PopID();
  }
  if (gone >= ballot.options.size()) return;
  ballot.options.erase(ballot.options.begin() + static_cast<std::ptrdiff_t>(gone));
  ballot.places.erase(ballot.places.begin() + static_cast<std::ptrdiff_t>(gone));
}

}  // namespace

void draw_ballot(const RoomDesk& desk, const AgendaVote& vote) {
  const std::string why = why_no_ballot(desk);
  if (!why.empty()) return desk.quiet(why);
  if (vote.asks.kind == vote::Kind::yes_no) {
    fill_yes_no(desk, vote, why);
  } else {
    vote::Ballot& ballot = ballot_for(desk, vote);
    if (vote.asks.kind == vote::Kind::slider) fill_slider(desk, vote, ballot);
    else if (vote.asks.kind == vote::Kind::rank) fill_rank(desk, vote, ballot);
    else if (vote.asks.kind == vote::Kind::coins) fill_coins(desk, vote, ballot);
    else fill_dots(desk, vote, ballot);
    const bool is_new = !vote.mine || ballot != *vote.mine;
    const std::string gap =
        vote.asks.kind == vote::Kind::slider && std::isnan(ballot.value)
            ? "Type a number from " + reading::readable(vote.asks.least) + " to " + reading::readable(vote.asks.most) + "."
            : gap_words(vote, ballot);
    const std::string held = !gap.empty() ? gap : is_new ? "" : "This is your vote already.";
    if (desk.button(vote.mine ? "Change my vote" : "Vote", "roompanel/cast/" + vote.id, held))
      return cast_ballot(desk, vote, vote::ballot_to_json(vote.asks.kind, ballot));
    if (is_new && !gap.empty()) desk.quiet(gap);
    if (is_new && gap.empty()) desk.quiet("This is not sent yet.");
    if (!is_new) desk.quiet("Your vote counts. You can change it until the vote is closed.");
  }
  const bool is_secretly_cast = !desk.text("secret/" + vote.id).empty();
  if (is_secretly_cast) desk.quiet("Your secret vote is sent. You can vote again until the close; the last ballot counts.");
  if (!vote.mine && !is_secretly_cast) return;
  if (vote.mine && vote.asks.kind == vote::Kind::yes_no)
    desk.quiet("Your vote counts. You can change it until the vote is closed.");
  if (desk.button("Withdraw my vote", "roompanel/withdraw/" + vote.id)) {
    desk.text("ballot/" + vote.id).clear();
    cast_ballot(desk, vote, nullptr);
  }
}

}  // namespace bl::desktop
