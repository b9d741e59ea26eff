// Votes in the tab Room: turnout, result as a chart, and what facilitators do with them.
#include <algorithm>
#include <cmath>

#include <imgui.h>
#include <imgui_stdlib.h>
#include <nlohmann/json.hpp>

#include "core/reading/figures.h"
#include "core/session/commands.h"
#include "ui/desktop/panels/charts.h"
#include "ui/desktop/panels/inspector_cell.h"
#include "ui/desktop/panels/room_panel.h"

namespace bl::desktop {

namespace {

constexpr double kLargestNumber = 1e9;

struct VoteTemplate {
  const char *id, *label;  ///< the id of the kind, as the node `vote` has it
  bool has_options, has_points, has_range;
};
constexpr VoteTemplate kVoteTemplates[] = {{"yes_no", "Yes or no", false, false, false},
                                           {"rank", "Order", true, false, false},
                                           {"coins", "Coins", true, true, false},
                                           {"dots", "Dots on the plan", true, true, false},
                                           {"slider", "Number", false, false, true}};

void draw_row(const RoomDesk& desk, const std::string& label, const std::string& value, double share, double mark, ImU32 colour) {
  const Theme& theme = desk.editor.theme;
  ImGui::TextUnformatted(label.c_str());
  ImGui::SameLine(std::max(0.0f, ImGui::GetContentRegionMax().x - ImGui::CalcTextSize(value.c_str()).x));
  ImGui::TextUnformatted(value.c_str());
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float wide = ImGui::GetContentRegionAvail().x, high = theme.px(6);
  bar(theme, at, {at.x + wide, at.y + high}, std::clamp(share, 0.0, 1.0), mark, colour);
  ImGui::Dummy({wide, high});
}

void draw_result(const RoomDesk& desk, const AgendaVote& vote) {
  const Colours& c = desk.editor.theme.colours();
  if (vote.result.empty() || vote.count == 0) return;
  if (vote.asks.kind == vote::Kind::slider) {
    if (!vote.mean) return;
    const std::string unit = vote.unit.empty() ? "" : " " + vote.unit;
    const double range = vote.asks.most - vote.asks.least;
    const double median = vote.median.value_or(*vote.mean);
    draw_row(desk, "Mean " + reading::readable(*vote.mean) + unit, "median " + reading::readable(median) + unit,
             (*vote.mean - vote.asks.least) / range, (median - vote.asks.least) / range, c.accent);
    return;
  }
  for (const vote::Tally& tally : vote.result) {
    const bool leads = tally.option == vote.leading;
    const std::string points = vote.asks.kind == vote::Kind::yes_no ? "" : reading::readable(tally.points) + " points, ";
    draw_row(desk, option_words(vote, tally.option) + (leads ? " (leads)" : ""), points + reading::percent(tally.share),
             tally.share, -1, leads ? c.good : c.accent);
  }
  if (vote.leading.empty()) desk.quiet("No option leads: there is a tie.");
}

void draw_turnout(const RoomDesk& desk, const AgendaVote& vote) {
  std::string words = std::string(vote.is_open ? "Open" : "Closed") + (vote.is_secret ? ", secret" : "");
  const std::string ballots = reading::counted(static_cast<std::size_t>(std::max<std::int64_t>(0, vote.count)), "ballot");
  if (vote.electorate <= 0) return desk.quiet(words + ", " + ballots + ".");
  const double turnout = static_cast<double>(vote.count) / static_cast<double>(vote.electorate);
  draw_row(desk, words, ballots + " of " + std::to_string(vote.electorate), turnout, -1, desk.editor.theme.colours().text_faint);
}

// Ballots are taken in phases that name them.
void open_vote(const RoomDesk& desk, const std::string& id) {
  if (!desk.agenda.may.contains("vote")) {
    std::set<std::string> activities = desk.agenda.may;
    activities.insert("vote");
    desk.say("set_phase", JsonValue::of({{"name", desk.agenda.phase},
                                         {"activities", activities},
                                         {"forms", desk.agenda.forms},
                                         {"ends_at", desk.agenda.ends_at}}));
  }
  desk.say("open_vote", JsonValue::of({{"vote", id}, {"ends_at", 0}}));
}

// The links by which the result acts: each is a switch.
void draw_effects(const RoomDesk& desk, const AgendaVote& vote) {
  const Scene& scene = desk.editor.scene();
  bool has_one = false;
  for (const auto& [id, link] : scene.links) {
    if (link.kind != "vote_to_weight") continue;
    const auto from = resolve(scene, desk.editor.types(), link.from);
    if (std::find(from.begin(), from.end(), vote.id) == from.end()) continue;
    has_one = true;
    const auto to = resolve(scene, desk.editor.types(), link.to);
    const std::string on = to.empty()       ? "nothing"
                           : to.size() == 1 ? desk.editor.name_of(to.front())
                                            : reading::counted(to.size(), "node");
    bool is_on = link.is_enabled;
    ImGui::BeginDisabled(!desk.why_not.empty());
    if (ImGui::Checkbox(("Apply to the model: " + on + "##" + id).c_str(), &is_on))
      (void)desk.editor.submit(command<EnableLink>({id, is_on}));
    ImGui::EndDisabled();
    note_place(desk.editor, "roompanel/apply/" + id);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", desk.editor.types().link("vote_to_weight")->doc.c_str());
  }
  if (has_one) return;
  bool is_on = false;
  ImGui::BeginDisabled();
  ImGui::Checkbox("Apply to the model", &is_on);
  ImGui::EndDisabled();
  if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
    ImGui::SetTooltip(
        "No link leads from this vote. Draw a link \"Vote to number\" in the canvas, from the vote to what it shall set.");
}

std::string text_without_ends(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string::npos ? std::string() : text.substr(first, last - first + 1);
}

// Options in words, with commas between them; their ids are numbers, so that words may be anything.
Json options_in(const std::string& text) {
  Json options = Json::array();
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    if (const std::string label = text_without_ends(text.substr(at, end - at)); !label.empty())
      options.push_back({{"id", "option_" + std::to_string(options.size() + 1)}, {"label", label}});
    at = end + 1;
  }
  return options;
}

std::optional<double> number_in(const std::string& text, double least, double most) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !(value >= least && value <= most)) return std::nullopt;
  return value;
}

std::string& field(const RoomDesk& desk, const std::string& key, const char* hint, float width) {
  std::string& text = desk.text("new_vote/" + key);
  ImGui::SetNextItemWidth(width);
  ImGui::InputTextWithHint(("##" + key).c_str(), hint, &text);
  note_place(desk.editor, "roompanel/new_vote/" + key);
  return text;
}

// The settings of the node that the fields describe; `why`: what is missing.
Json settings_of(const RoomDesk& desk, const VoteTemplate& chosen, std::string& why) {
  const float small = desk.editor.theme.px(70);
  const std::string question = text_without_ends(field(desk, "question", "question", -1));
  Json settings = {{"question", question}, {"kind", chosen.id}};
  if (question.empty()) why = "Type the question.";
  if (chosen.has_options) {
    const bool may_be_empty = std::string_view(chosen.id) == "dots";
    settings["options"] = options_in(
        field(desk, "options", may_be_empty ? "options, with commas; none: plus and minus" : "options, with commas", -1));
    if (why.empty() && !may_be_empty && settings["options"].size() < 2)
      why = "Type two options or more, with commas between them.";
  }
  if (chosen.has_points) {
    const auto points = number_in(field(desk, "points", "how many", small), 1, 1000);
    ImGui::SameLine();
    desk.quiet("for each person");
    if (points) settings["points"] = std::llround(*points);
    else if (why.empty()) why = "Type how many each person has, from 1 to 1000.";
  }
  if (chosen.has_range) {
    const auto least = number_in(field(desk, "least", "least", small), -kLargestNumber, kLargestNumber);
    ImGui::SameLine();
    const auto most = number_in(field(desk, "most", "most", small), -kLargestNumber, kLargestNumber);
    ImGui::SameLine();
    settings["unit"] = text_without_ends(field(desk, "unit", "unit", small));
    if (least && most && *least < *most) settings["least"] = *least, settings["most"] = *most;
    else if (why.empty()) why = "Type the least and the most number.";
  }
  return settings;
}

// Who may vote and is here now.
std::int64_t voters_here(const Agenda& agenda) {
  return std::count_if(agenda.seats.begin(), agenda.seats.end(), [](const AgendaSeat& seat) {
    return seat.is_here && seat.role != "viewer" && seat.role != "recorder" && seat.role != "device";
  });
}

}  // namespace

void draw_votes(const RoomDesk& desk) {
  if (desk.leads || !desk.agenda.votes.empty()) desk.heading("Votes");
  std::optional<DotPlacing>& placing = memory_of(desk.editor).placing;
  const auto is_placed = [&](const AgendaVote& vote) { return vote.is_open && vote.id == placing->vote; };
  if (placing && std::none_of(desk.agenda.votes.begin(), desk.agenda.votes.end(), is_placed)) placing.reset();
  for (const AgendaVote& vote : desk.agenda.votes) {
    if (!vote.is_open && !desk.leads && vote.result.empty()) continue;
    ImGui::PushID(vote.id.c_str());
    ImGui::Spacing();
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(vote.question.c_str());
    ImGui::PopTextWrapPos();
    draw_turnout(desk, vote);
    if (vote.is_open) draw_ballot(desk, vote);
    draw_result(desk, vote);
    if (desk.leads && vote.is_open) {
      if (desk.button("Close the vote", "roompanel/close/" + vote.id)) desk.say("close_vote", JsonValue::of({{"vote", vote.id}}));
    } else if (desk.leads && desk.button("Open the vote", "roompanel/open/" + vote.id)) {
      open_vote(desk, vote.id);
    }
    if (desk.leads) draw_effects(desk, vote);
    ImGui::Separator();
    ImGui::PopID();
  }
}

void draw_new_vote(const RoomDesk& desk) {
  ImGui::Spacing();
  desk.heading("New vote");
  std::string& kind = desk.text("new_vote/kind");
  if (kind.empty()) kind = kVoteTemplates[0].id;
  const VoteTemplate* chosen = kVoteTemplates;
  const PortDefinition& port = **desk.editor.types().port(*parse_port_path("vote.kind"));
  for (const VoteTemplate& one : kVoteTemplates) {
    if (&one != kVoteTemplates) desk.same_line_for(one.label);
    if (ImGui::RadioButton(one.label, kind == one.id)) kind = one.id;
    note_place(desk.editor, std::string("roompanel/new_vote/kind/") + one.id);
    if (kind == one.id) chosen = &one;
  }
  for (const auto& choice : port.choices)
    if (choice.id == kind) desk.quiet(choice.doc);
  std::string why;
  Json settings = settings_of(desk, *chosen, why);
  bool is_secret = !desk.text("new_vote/secret").empty();
  if (ImGui::Checkbox("Secret", &is_secret)) desk.text("new_vote/secret") = is_secret ? "yes" : "";
  note_place(desk.editor, "roompanel/new_vote/secret");
  ImGui::SameLine();
  if (!desk.button("Add it and open it", "roompanel/new_vote/open", why)) return;
  settings["is_secret"] = is_secret;
  settings["electorate"] = voters_here(desk.agenda);
  const std::string id = desk.editor.fresh_id("vote");
  const Json node = {{"name", settings["question"]}, {"types", {{"vote", settings}}}};
  if (!desk.editor.submit(command<AddNode>({id, JsonValue::of(node)}))) return;
  open_vote(desk, id);
  for (const char* key : {"question", "options", "points", "least", "most", "unit", "secret"})
    desk.text(std::string("new_vote/") + key).clear();
}

}  // namespace bl::desktop
