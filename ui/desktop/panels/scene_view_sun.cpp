// The sun's time along the bottom of the 3D view: another moment to look at, and the way to make it the scene's.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "core/base/text.h"
#include "core/define/json_text.h"
#include "core/reading/report_model.h"
#include "core/reading/views/sun.h"
#include "core/reading/views/traffic.h"
#include "ui/desktop/look/buttons.h"
#include "ui/desktop/panels/scene_view.h"

namespace bl::desktop {

namespace {

constexpr double kDay = 86400, kStep = 300, kFineStep = 60, kCoarseStep = 1800;
// While it runs, an hour of the sun passes in a second.
constexpr double kRunSpeed = 3600;
constexpr float kStrip = 54, kSunMargin = 14, kRow = 24;

constexpr std::array<const char*, 12> kMonths = {"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                                 "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};

// "15:40"; to the minute, as clocks show it.
std::string clock_text(double seconds) {
  const int all = static_cast<int>(std::floor(std::clamp(seconds, 0.0, kDay) / 60 + 1e-6));
  char text[16];
  std::snprintf(text, sizeof text, "%02d:%02d", all / 60, all % 60);
  return text;
}

std::string day_text(sun::DayNumber day, bool with_year) {
  const sun::Date date = sun::date_of(day);
  const std::string text = std::to_string(date.day) + " " + kMonths[static_cast<std::size_t>(date.month - 1)];
  return with_year ? text + " " + std::to_string(date.year) : text;
}

// Years that clocks and dates are meant for.
sun::DayNumber kept_day(sun::DayNumber day) {
  return std::clamp(day, sun::day_number({1900, 1, 1}), sun::day_number({2100, 12, 31}));
}

}  // namespace

// The chosen one, or the first.
const SunFacts* SceneView::sun() const {
  if (!has_sun()) return nullptr;
  for (const SunFacts& sun : facts_->urban.suns)
    if (editor_->picks.nodes.contains(sun.id)) return &sun;
  return &facts_->urban.suns.front();
}

const sun::SunDay& SceneView::day_of(const sun::SunPlace& place, sun::DayNumber day) {
  if (!day_key_ || *day_key_ != std::pair{place, day}) {
    day_key_ = {place, day};
    day_ = sun_day(place, day);
  }
  return day_;
}

void SceneView::preview_sun(const SunClock& clock) {
  if (has_sun()) preview_ = SunClock{kept_day(clock.day), std::clamp(clock.seconds, 0.0, kDay)};
}

void SceneView::step_sun(double seconds, int days) {
  const SunFacts* shown = sun();
  if (shown == nullptr) return;
  SunClock clock = preview_.value_or(shown->clock);
  clock.day += days;
  clock.seconds += seconds;
  // Over midnight into the next day.
  const double turns = std::floor(clock.seconds / kDay);
  if (clock.seconds != kDay) clock = {clock.day + static_cast<sun::DayNumber>(turns), clock.seconds - turns * kDay};
  preview_sun(clock);
}

void SceneView::end_preview() {
  preview_.reset();
  is_sun_running_ = false;
}

void SceneView::toggle_sun_run() { is_sun_running_ = has_sun() && !is_sun_running_; }

// The settings of the node, in as few ports as it takes; what a link says of them is said again here.
void SceneView::set_sun_in_scene() {
  const SunFacts* shown = sun();
  if (shown == nullptr || !preview_) return;
  std::vector<Command> commands;
  if (preview_->day != shown->clock.day)
    commands.push_back(
        command<SetPort>({shown->id,
                          {reading::path_of<&reading::SunFigures::date>()},
                          {'"' + sun::date_text(preview_->day - static_cast<sun::DayNumber>(shown->added_days)) + '"'}}));
  if (preview_->seconds != shown->clock.seconds)
    commands.push_back(
        command<SetPort>({shown->id, {reading::path_of<&reading::SunFigures::time>()}, {shortest(preview_->seconds)}}));
  const std::string node = shown->id;
  const Plan& plan = *facts_->state->plan;
  if (!commands.empty() && !editor_->submit(commands)) return;
  for (const LinkPlan& link : plan.links)
    for (const PortRef& target : link.targets)
      if (!link.is_muted && link.is_enabled && plan.nodes[target.node].id == node &&
          reading::port_of<&reading::SunFigures::time>(plan, target.node) == target)
        editor_->notify(NoticeKind::warning,
                        "The link `" + link.id + "` proposes the time of `" + node + "`, so it may change again.");
  end_preview();
}

std::string SceneView::sun_words() const {
  const SunFacts* shown = sun();
  if (shown == nullptr) return "";
  if (!preview_) return clock_text(shown->clock.seconds) + ", the scene's time";
  const bool is_other_day = preview_->day != shown->clock.day;
  const auto words = [&](const SunClock& clock) {
    return (is_other_day ? day_text(clock.day, false) + " " : "") + clock_text(clock.seconds);
  };
  return words(*preview_) + ", preview; scene: " + words(shown->clock);
}

// What the sun that is shown casts, before the picture is made.
void SceneView::follow_sun() {
  const SunFacts* shown = sun();
  if (shown == nullptr) end_preview();
  choices_.sun = {};
  if (shown == nullptr) return;
  if (is_sun_running_) {
    const sun::SunDay& day = day_of(shown->place, preview_.value_or(shown->clock).day);
    SunClock clock = preview_.value_or(shown->clock);
    clock.seconds += kRunSpeed * std::min(0.1, editor_->now - last_frame_);
    const double rise = day.sunrise.value_or(0), set = day.sunset.value_or(kDay);
    // By night there is nothing to see.
    if (rise < set && (clock.seconds > set || clock.seconds < rise)) clock.seconds = rise;
    if (clock.seconds > kDay) clock.seconds = 0;
    preview_sun(clock);
  }
  SunLook& look = choices_.sun;
  look.is_there = true;
  look.is_preview = preview_.has_value();
  const SunClock clock = preview_.value_or(shown->clock);
  look.toward = preview_ ? direction_to_sun(shown->place, clock) : shown->toward;
  look.clock = (clock.day != shown->clock.day ? day_text(clock.day, false) + ", " : "") + clock_text(clock.seconds);
  if (look.is_preview && shows("shadow_outlines")) look.outlines = shade_.outlines(facts_->urban.casters, look.toward);
  if (!shows("shade_bodies")) return;
  // Those of what is chosen; where nobody has chosen a caster, of all.
  std::vector<CasterFacts> wanted;
  for (const CasterFacts& caster : facts_->urban.casters)
    if (editor_->picks.nodes.contains(caster.id)) wanted.push_back(caster);
  look.bodies = shade_.bodies(wanted.empty() ? facts_->urban.casters : wanted, look.toward);
}

// How far one gets from the node that is chosen, or else pointed at.
void SceneView::follow_choice() {
  choices_.isochrones = shows("isochrones") ? choices_.isochrones : nullptr;
  const auto none = static_cast<std::uint32_t>(facts_->state->plan->nodes.size());
  const auto is_place = [&](std::uint32_t node) {
    return node < none && (reading::is_a<reading::ZoneFigures>(*facts_->state, node) ||
                           reading::is_a<reading::JunctionPlace>(*facts_->state, node));
  };
  std::uint32_t chosen = none;
  if (shows("isochrones") && shows("streets") && !facts_->urban.streets.empty()) {
    for (const std::string& id : editor_->picks.nodes)
      if (chosen == none && is_place(seen_index(id))) chosen = seen_index(id);
    if (chosen == none && is_place(seen_index(editor_->picks.hovered_node))) chosen = seen_index(editor_->picks.hovered_node);
  }
  const std::pair key{chosen, shows("isochrones_by_car")};
  if (reach_state_ == facts_->state && reach_key_ == key) return;
  reach_state_ = facts_->state;
  reach_key_ = key;
  choices_.isochrones = chosen == none ? nullptr : isochrones_of(*facts_->state, chosen, key.second);
}

float SceneView::strip_height() const { return has_sun() && shows("sun_time") ? editor_->theme.px(kStrip) : 0; }

void SceneView::draw_sun_strip() {
  sun_track_ = sun_button_ = {};
  const SunFacts* shown = sun();
  const Theme& theme = editor_->theme;
  const float tall = strip_height(), margin = theme.px(kSunMargin), length = width() - 2 * margin;
  if (shown == nullptr || tall <= 0 || length < theme.px(150)) return;
  const ImVec2 low{at_.x, at_.y + height() - tall};
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(low, {at_.x + width(), at_.y + height()}, faded(theme.colours().panel, 0.9f));
  list.AddLine(low, {at_.x + width(), low.y}, theme.colours().line);
  ImGui::PushID("sun");
  draw_sun_words(*shown, {low.x + margin, low.y + theme.px(4)});
  draw_sun_track(*shown, {low.x + margin, low.y + theme.px(kRow + 6)}, length);
  ImGui::PopID();
}

// Date with its steps, what is shown, and the way into the scene.
void SceneView::draw_sun_words(const SunFacts& sun, const ImVec2& corner) {
  const Theme& theme = editor_->theme;
  const Colours& c = theme.colours();
  const SunClock clock = preview_.value_or(sun.clock);
  ImGui::SetCursorScreenPos(corner);
  ImGui::PushFont(theme.fonts().small);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {theme.px(6), 0});
  const auto hint = [](const char* text) {
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", text);
  };
  if (ImGui::SmallButton(is_sun_running_ ? icon::kPause : icon::kPlay)) toggle_sun_run();
  hint("Runs the sun through the day, in the view only");
  ImGui::SameLine();
  if (ImGui::SmallButton("<")) step_sun(0, ImGui::GetIO().KeyShift ? -30 : -1);
  hint("A day earlier; with Shift a month");
  ImGui::SameLine();
  ImGui::TextUnformatted(day_text(clock.day, true).c_str());
  ImGui::SameLine();
  if (ImGui::SmallButton(">")) step_sun(0, ImGui::GetIO().KeyShift ? 30 : 1);
  hint("A day later; with Shift a month");
  ImGui::SameLine(0, theme.px(14));
  ImGui::PushStyleColor(ImGuiCol_Text, preview_ ? c.accent : c.text_soft);
  ImGui::TextUnformatted(sun_words().c_str());
  ImGui::PopStyleColor();
  if (preview_) {
    const char* label = "Set in the scene";
    const float wide = ImGui::CalcTextSize(label).x + 2 * ImGui::GetStyle().FramePadding.x;
    ImGui::SetCursorScreenPos(
        {std::max(ImGui::GetItemRectMax().x + theme.px(8), at_.x + width() - theme.px(kSunMargin) - wide), corner.y});
    if (ImGui::SmallButton(label)) set_sun_in_scene();
    else hint("Makes this moment the scene's; Ctrl+Z takes it back");
    const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    sun_button_ = {low.x, low.y, high.x, high.y};
  }
  ImGui::PopStyleVar();
  ImGui::PopFont();
}

// From midnight to midnight, with the day between sunrise and sunset; pulling along it looks at another time.
void SceneView::draw_sun_track(const SunFacts& sun, const ImVec2& corner, float length) {
  const Theme& theme = editor_->theme;
  const Colours& c = theme.colours();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const SunClock clock = preview_.value_or(sun.clock);
  const sun::SunDay day = day_of(sun.place, clock.day);
  const float bar = theme.px(7), top = corner.y, bottom = top + bar;
  const auto place = [&](double seconds) { return corner.x + length * static_cast<float>(std::clamp(seconds / kDay, 0.0, 1.0)); };
  ImGui::SetCursorScreenPos({corner.x, top - theme.px(4)});
  press_area("track", {length, bar + theme.px(8)});
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  sun_track_ = {low.x, low.y, high.x, high.y};
  const bool is_hovered = ImGui::IsItemHovered();
  const ImGuiIO& io = ImGui::GetIO();
  const double step = io.KeyShift ? kFineStep : io.KeyCtrl ? kCoarseStep : kStep;
  if (is_hovered && ImGui::IsMouseDoubleClicked(0)) end_preview();
  else if (ImGui::IsItemActive() && !(preview_ == std::nullopt && ImGui::GetIO().MouseDownDurationPrev[0] >= 0)) {
    is_sun_running_ = false;
    const double wanted = kDay * static_cast<double>((io.MousePos.x - corner.x) / std::max(1.0f, length));
    preview_sun({clock.day, std::round(wanted / step) * step});
  }
  if (is_hovered && io.MouseWheel != 0) step_sun(step * static_cast<double>(io.MouseWheel > 0 ? 1 : -1), 0);
  if (is_hovered)
    ImGui::SetTooltip(
        "Drag to show the sun of another time in the view only (Shift: minutes, Ctrl: half hours)\nDouble-click or Esc: back to "
        "the scene's time");
  list.AddRectFilled({corner.x, top}, {corner.x + length, bottom}, theme.is_dark() ? 0xff3a2c22u : 0xffa08870u, bar / 2);
  const Colour light = theme.is_dark() ? 0xff6fbfe6u : 0xff7fd2f6u;
  const double rise = day.sunrise.value_or(0), set = day.sunset.value_or(kDay);
  const bool is_always = !day.sunrise && !day.sunset;
  const auto lit = [&](double from, double to) { list.AddRectFilled({place(from), top}, {place(to), bottom}, light); };
  if (is_always ? day.day_length > kDay / 2 : rise < set) lit(is_always ? 0 : rise, is_always ? kDay : set);
  else if (!is_always) lit(0, set), lit(rise, kDay);
  ImFont* font = theme.fonts().small;
  const auto mark = [&](double seconds, const std::string& text, ImU32 colour) {
    const ImVec2 extent = font->CalcTextSizeA(font->FontSize, 1e4f, 0, text.c_str());
    const float x = std::clamp(place(seconds) - extent.x / 2, corner.x, corner.x + length - extent.x);
    list.AddLine({place(seconds), bottom}, {place(seconds), bottom + theme.px(3)}, colour, theme.px(1.2f));
    list.AddText(font, font->FontSize, {x, bottom + theme.px(2)}, colour, text.c_str());
  };
  if (day.sunrise) mark(*day.sunrise, "sunrise " + clock_text(*day.sunrise), c.text_soft);
  if (day.sunset) mark(*day.sunset, "sunset " + clock_text(*day.sunset), c.text_soft);
  if (is_always) mark(kDay / 2, day.day_length > 0 ? "the sun does not set" : "the sun does not rise", c.text_soft);
  if (preview_)
    list.AddLine({place(sun.clock.seconds), top - theme.px(3)}, {place(sun.clock.seconds), bottom + theme.px(3)}, c.text,
                 theme.px(2));
  const ImVec2 knob{place(clock.seconds), (top + bottom) / 2};
  list.AddCircleFilled(knob, theme.px(7), preview_ ? c.accent : c.raised, 24);
  list.AddCircle(knob, theme.px(7), c.text, 24, theme.px(1.4f));
}

}  // namespace bl::desktop
