// The clock: play, pause, one tick, rewind and speed, and whether the simulation keeps up with it.
#include <algorithm>

#include <GLFW/glfw3.h>

#include "core/base/text.h"
#include "core/reading/figures.h"
#include "ui/desktop/panels/actions.h"
#include "ui/desktop/panels/panels.h"

namespace bl::desktop {

namespace {

constexpr double kSlowest = 0.5, kFastest = 240;
constexpr double kRewindSeconds = 5;

// Five seconds of what was seen: at the speed that was reached, not the one that was asked for.
std::int64_t rewind_ticks(const host::Moment& moment) {
  const double rate =
      std::max(1.0, std::min(moment.wanted_rate, moment.tick_seconds > 0 ? 1 / moment.tick_seconds : moment.wanted_rate));
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(kRewindSeconds * rate));
}

void change_rate(Workbench& editor, double factor) {
  editor.document->running().set_rate(std::clamp(editor.moment->wanted_rate * factor, kSlowest, kFastest));
}

void toggle_play(Workbench& editor) { editor.document->running().play(!editor.moment->is_playing); }
void one_tick(Workbench& editor) { editor.document->running().step(1); }
void rewind(Workbench& editor) { editor.document->running().rewind(rewind_ticks(*editor.moment)); }
bool can_rewind(const Workbench& editor) {
  return has_document(editor) && editor.moment && editor.document->running().can_rewind();
}

bool may_set_clock(const Workbench& editor) { return has_document(editor) && editor.document->running().why_no_clock().empty(); }

std::string rewind_hint(const host::Moment& moment) {
  std::string hint = "Rewind five seconds (Backspace)";
  if (moment.has_forgotten)
    hint += ".\nTicks before " + std::to_string(moment.oldest) + " are given up: the history takes " +
            std::to_string(moment.history_bytes >> 20) + " MB and has reached its limit.";
  return hint;
}

bool tool_button(Workbench& editor, const char* sign, const char* hint, bool is_on = false, bool is_possible = true) {
  const Colours& c = editor.theme.colours();
  ImGui::BeginDisabled(!is_possible);
  if (is_on) {
    ImGui::PushStyleColor(ImGuiCol_Button, c.accent);
    ImGui::PushStyleColor(ImGuiCol_Text, c.on_accent);
  }
  const bool is_hit = ImGui::Button(sign, {editor.theme.px(34), editor.theme.px(28)});
  if (is_on) ImGui::PopStyleColor(2);
  ImGui::EndDisabled();
  if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) ImGui::SetTooltip("%s", hint);
  ImGui::SameLine();
  return is_hit;
}

std::string distance_text(double metres) {
  return metres < 1 ? reading::readable(1000 * metres) + "\xC2\xA0mm" : reading::quantity(metres, Unit::metre);
}

// What the simulation is doing, in one sentence with a colour.
void draw_standing(Workbench& editor) {
  const host::Moment& moment = *editor.moment;
  const State& state = *moment.state;
  const Colours& c = editor.theme.colours();
  std::string text;
  ImU32 colour = c.text_soft;
  if (!moment.failure.empty()) {
    colour = c.bad;
    text = std::string(icon::kError) + "  " + moment.failure;
  } else if (moment.is_behind()) {
    colour = c.warning;
    text = std::string(icon::kClock) + "  behind: " + fixed(moment.rate, 1) + " of " + fixed(moment.wanted_rate, 0) +
           " ticks/s, " + fixed(1000 * moment.tick_seconds, 0) + " ms each";
  } else if (state.is_settled()) {
    colour = c.good;
    text = std::string(icon::kCheck) + "  settled, worst error " + fixed(100 * state.largest_residual, 2) + " %";
  } else if (moment.is_resting) {
    colour = c.warning;
    text = "nothing moves, but not settled: " + (state.largest_residual <= state.plan->settings.tolerance && has_failure(state)
                                                     ? "see the problems for what fails or cannot be met"
                                                     : "worst error " + fixed(100 * state.largest_residual, 2) + " %");
  } else if (state.tick > 0 && !moment.is_playing) {
    text = "paused: worst error " + fixed(100 * state.largest_residual, 2) + " %, press P to go on";
  } else if (state.tick > 0) {
    text = "negotiating: worst error " + fixed(100 * state.largest_residual, 2) + " %, moves up to " +
           distance_text(state.largest_move) + " a tick";
  } else {
    text = moment.is_playing ? "the first tick is under way" : "press P to run the links and the solver";
  }
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopStyleColor();
}

}  // namespace

void draw_clock(Workbench& editor) {
  const host::Moment& moment = *editor.moment;
  const Theme& theme = editor.theme;
  // In a room not everybody sets the clock; why not is said in place of what a button does.
  const std::string why_not = editor.document->running().why_no_clock();
  const bool is_possible = why_not.empty(), is_room = editor.document->room() != nullptr;
  const auto hint = [&](const std::string& otherwise) { return is_possible ? otherwise : why_not; };
  const std::string back =
      is_room ? "Takes back what everybody has changed in the last five seconds (Backspace)" : rewind_hint(moment);
  if (tool_button(editor, icon::kRewind, hint(back).c_str(), false, is_possible && can_rewind(editor))) rewind(editor);
  if (tool_button(editor, moment.is_playing ? icon::kPause : icon::kPlay,
                  hint(moment.is_playing ? "Pause (P)" : "Play (P)").c_str(), moment.is_playing, is_possible))
    toggle_play(editor);
  if (tool_button(editor, icon::kStep, hint("One tick (.)").c_str(), false, is_possible && !moment.is_playing)) one_tick(editor);
  ImGui::BeginDisabled(!is_possible);
  ImGui::SetNextItemWidth(theme.px(120));
  float rate = static_cast<float>(moment.wanted_rate);
  if (ImGui::SliderFloat("##rate", &rate, static_cast<float>(kSlowest), static_cast<float>(kFastest), "%.3g ticks/s",
                         ImGuiSliderFlags_Logarithmic))
    editor.document->running().set_rate(rate);
  ImGui::EndDisabled();
  if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
    ImGui::SetTooltip("%s", hint(is_room ? "Ticks per second for everybody, from 1 to 20 (- slower, = faster)"
                                         : "Wanted ticks per second (- slower, = faster)")
                                .c_str());
  ImGui::SameLine(0, theme.px(16));
  ImGui::AlignTextToFramePadding();
  ImGui::PushFont(theme.fonts().strong);
  // A number that counts on while nothing else happens would keep the whole window busy.
  if (moment.is_resting) ImGui::TextUnformatted("at rest");
  else ImGui::Text("tick %lld", static_cast<long long>(editor.state().tick));
  ImGui::PopFont();
  ImGui::SameLine(0, theme.px(16));
  ImGui::AlignTextToFramePadding();
  draw_standing(editor);
  draw_room(editor);
}

void add_clock_actions(std::vector<Action>& list) {
  auto is_playing = [](const Workbench& e) { return e.moment && e.moment->is_playing; };
  auto is_paused = [](const Workbench& e) { return may_set_clock(e) && e.moment && !e.moment->is_playing; };
  list.push_back({"Clock", "Play", {GLFW_KEY_P}, {}, Area::none, may_set_clock, toggle_play, false, is_playing});
  list.push_back({"Clock", "One tick", {GLFW_KEY_PERIOD}, {}, Area::none, is_paused, one_tick, true});
  list.push_back({"Clock", "Rewind five seconds", {GLFW_KEY_BACKSPACE}, {}, Area::none, can_rewind, rewind});
  list.push_back({"Clock", "Slower", {GLFW_KEY_MINUS}, {}, Area::none, may_set_clock, [](Workbench& e) { change_rate(e, 0.5); }});
  list.push_back({"Clock", "Faster", {GLFW_KEY_EQUAL}, {}, Area::none, may_set_clock, [](Workbench& e) { change_rate(e, 2); }});
}

}  // namespace bl::desktop
