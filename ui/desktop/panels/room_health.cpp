// The tab Room for facilitators: the phases that were planned, and how the room and its computer are.
#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "core/reading/figures.h"
#include "core/serve/readiness.h"
#include "ui/desktop/panels/host_dialog.h"
#include "ui/desktop/panels/inspector_cell.h"
#include "ui/desktop/panels/room_panel.h"

namespace bl::desktop {

namespace {

// One figure with its verdict; text that is not good says what to do.
void draw_line(const RoomDesk& desk, serve::Verdict verdict, const std::string& text) {
  const Colours& c = desk.editor.theme.colours();
  const ImU32 colour = verdict == serve::Verdict::good ? c.text_soft : verdict == serve::Verdict::look ? c.warning : c.bad;
  const char* sign = verdict == serve::Verdict::good ? "" : verdict == serve::Verdict::look ? "look: " : "bad: ";
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted((sign + text).c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

void draw_line(const RoomDesk& desk, const serve::Finding& finding) { draw_line(desk, finding.verdict, finding.text); }

std::string health_time(double value) { return reading::duration(value / 1000); }

void draw_ticks(const RoomDesk& desk, const wire::HealthOut& health) {
  constexpr double kBehind = 0.8;
  const bool is_paused = desk.room.people().is_paused;
  const bool is_slow = !is_paused && health.tick_ms * health.wanted > 1000 * kBehind;
  draw_line(desk, is_slow ? serve::Verdict::look : serve::Verdict::good,
            "A tick takes " + health_time(health.tick_ms) + " on the server. " +
                (is_paused ? "The model is paused." : reading::readable(health.wanted) + " ticks a second are wanted.") +
                (is_slow ? " The model is slower than it should be." : ""));
  if (!health.failure.empty()) draw_line(desk, serve::Verdict::bad, "The ticks have stopped: " + health.failure);
  draw_line(desk, serve::Verdict::good,
            std::string(health.settled ? "The model has settled." : "The model moves.") +
                (health.worst_of.empty() ? ""
                                         : " The largest error is " + reading::percent(health.worst) + ", of " +
                                               desk.editor.name_of(health.worst_of) + "."));
}

void draw_storing(const RoomDesk& desk, const wire::HealthOut& health) {
  constexpr double kSlow = 50;  // [ms]
  if (!health.problem.empty()) return draw_line(desk, serve::Verdict::bad, "Nothing can be stored: " + health.problem);
  draw_line(desk, health.disk_slow_ms > kSlow ? serve::Verdict::look : serve::Verdict::good,
            "Storing takes " + health_time(health.disk_ms) + ", seldom more than " + health_time(health.disk_slow_ms) + ".");
  draw_line(
      desk, serve::Verdict::good,
      "The session file has " + reading::readable(static_cast<double>(health.journal) / 1e6) + " MB. " +
          (health.snapshot_age < 0 ? "No snapshot was needed since the room was opened."
                                   : "Last snapshot: " + reading::duration(static_cast<double>(health.snapshot_age)) + " ago."));
  draw_line(desk, serve::Verdict::good,
            health.followers == 0 ? "No second laptop follows."
                                  : reading::counted(static_cast<std::size_t>(health.followers), "laptop") + " follow.");
}

void draw_machine(const RoomDesk& desk, const wire::HealthOut& health) {
  using Mains = wire::HealthOut::Mains;
  serve::Machine machine;
  if (health.battery >= 0) machine.battery = health.battery;
  if (health.mains != Mains::unknown) machine.is_on_mains = health.mains == Mains::yes;
  draw_line(desk, serve::judge_power(machine));
  if (health.memory_free >= 0) draw_line(desk, serve::judge_memory(health.memory_free));
  if (health.disk_free >= 0) draw_line(desk, serve::judge_free_disk(health.disk_free));
  const auto wireless = health.wireless.read();
  if (wireless && (*wireless)->is_object())
    for (const auto& [interface, quality] : (*wireless)->items())
      if (quality.is_number()) draw_line(desk, serve::judge_wireless(interface, quality.get<double>()));
  const auto reached = health.reached.read();
  if (reached && (*reached)->is_object())
    for (const auto& [address, count] : (*reached)->items())
      if (count.is_number_unsigned()) draw_line(desk, serve::judge_reach(address, count.get<std::size_t>()));
}

}  // namespace

void draw_health(const RoomDesk& desk) {
  desk.heading("Health");
  note_place(desk.editor, "roompanel/health");
  const guest::Standing standing = desk.room.standing();
  if (const auto& health = desk.room.health()) {
    draw_ticks(desk, *health);
    draw_storing(desk, *health);
    draw_machine(desk, *health);
  } else {
    desk.quiet("The server has not said yet how it is.");
  }
  if (standing.waiting > 0) desk.quiet(std::to_string(standing.waiting) + " of this window wait for an answer.");
  desk.quiet("This window is at tick " + reading::grouped(static_cast<double>(desk.room.follower().tick())) + ".");
  if (desk.room.differed() > 0)
    desk.quiet("This window had another result than the server " + std::to_string(desk.room.differed()) + " times.");
}

void draw_plan(const RoomDesk& desk) {
  const auto kept = desk.editor.person.plans.find(desk.room.code());
  if (kept == desk.editor.person.plans.end()) return;
  const PhasePlan plan = plan_of_text(kept->second);
  if (plan.empty()) return;
  ImGui::Spacing();
  desk.heading("Planned phases");
  for (std::size_t k = 0; k < plan.size(); ++k) {
    const PlannedPhase& phase = plan[k];
    const std::string key = "roompanel/plan/" + std::to_string(k);
    if (phase.name == desk.agenda.phase) desk.quiet("now");
    else if (desk.button("Begin", key)) begin_phase(desk.room, phase, desk.agenda.forms);
    ImGui::SameLine();
    ImGui::TextUnformatted((phase.name + (phase.minutes > 0 ? ", " + std::to_string(phase.minutes) + " min" : "")).c_str());
  }
}

}  // namespace bl::desktop
