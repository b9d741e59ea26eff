// The tab Room for facilitators: the phases that were planned, and how the room and its computer are.
#include <algorithm>

#include <nlohmann/json.hpp>

#include "core/reading/figures.h"
#include "core/serve/readiness.h"
#include "ui/desktop/panels/host_dialog.h"
#include "ui/desktop/panels/inspector_cell.h"
#include "ui/desktop/panels/room_panel.h"

namespace bl::desktop {

namespace {

using Findings = std::vector<serve::Finding>;

// One figure with its verdict; text that is not good says what to do.
void draw_finding(const RoomDesk& desk, const serve::Finding& finding) {
  const Colours& c = desk.editor.theme.colours();
  const bool is_good = finding.verdict == serve::Verdict::good;
  const ImU32 colour = is_good ? c.text_soft : finding.verdict == serve::Verdict::look ? c.warning : c.bad;
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(((is_good ? "" : std::string(serve::word_of(finding.verdict)) + ": ") + finding.text).c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

void add_ticks(const RoomDesk& desk, const wire::HealthOut& health, Findings& findings) {
  findings.push_back(serve::judge_pace(health.tick_ms / 1000, health.wanted, desk.room.people().is_paused));
  if (!health.failure.empty()) findings.push_back({serve::Verdict::bad, "ticks", "The ticks have stopped: " + health.failure});
  const std::string worst = health.worst_of.empty() ? ""
                                                    : " The largest error is " + reading::percent(health.worst) + ", of " +
                                                          desk.editor.name_of(health.worst_of) + ".";
  findings.push_back({serve::Verdict::good, "ticks", (health.settled ? "The model has settled." : "The model moves.") + worst});
}

void add_storing(const wire::HealthOut& health, Findings& findings) {
  if (!health.problem.empty()) findings.push_back({serve::Verdict::bad, "disk", "Nothing can be stored: " + health.problem});
  findings.push_back(serve::judge_storing(health.disk_ms / 1000, health.disk_slow_ms / 1000));
  findings.push_back({serve::Verdict::good, "disk",
                      "The session file has " + reading::readable(static_cast<double>(health.journal) / 1e6) + " MB. " +
                          (health.snapshot_age < 0
                               ? "No snapshot has been stored since the room was opened."
                               : "Last snapshot: " + reading::duration(static_cast<double>(health.snapshot_age)) + " ago.")});
  const auto followers = static_cast<std::size_t>(std::max<std::int64_t>(0, health.followers));
  findings.push_back({serve::Verdict::good, "second",
                      followers == 0 ? "No second laptop follows." : "Laptops that follow: " + std::to_string(followers) + "."});
}

void add_machine(const wire::HealthOut& health, Findings& findings) {
  using Mains = wire::HealthOut::Mains;
  serve::Machine machine;
  if (health.battery >= 0) machine.battery = health.battery;
  if (health.mains != Mains::unknown) machine.is_on_mains = health.mains == Mains::yes;
  findings.push_back(serve::judge_power(machine));
  if (health.memory_free >= 0) findings.push_back(serve::judge_memory(health.memory_free));
  if (health.disk_free >= 0) findings.push_back(serve::judge_free_disk(health.disk_free));
  const auto wireless = health.wireless.read();
  if (wireless && (*wireless)->is_object())
    for (const auto& [interface, quality] : (*wireless)->items())
      if (quality.is_number()) findings.push_back(serve::judge_wireless(interface, quality.get<double>()));
  const auto reached = health.reached.read();
  if (reached && (*reached)->is_object())
    for (const auto& [address, count] : (*reached)->items())
      if (count.is_number_unsigned()) findings.push_back(serve::judge_reach(address, count.get<std::size_t>()));
}

}  // namespace

void draw_health(const RoomDesk& desk) {
  ImGui::Spacing();
  desk.heading("Health");
  note_place(desk.editor, "roompanel/health");
  if (const auto& health = desk.room.health()) {
    Findings findings;
    add_ticks(desk, *health, findings);
    add_storing(*health, findings);
    add_machine(*health, findings);
    // What needs somebody comes first.
    std::stable_sort(findings.begin(), findings.end(), [](const auto& a, const auto& b) { return a.verdict > b.verdict; });
    for (const serve::Finding& finding : findings) draw_finding(desk, finding);
  } else {
    desk.quiet("The server has not said yet how it is.");
  }
  if (const std::size_t waiting = desk.room.standing().waiting; waiting > 0)
    desk.quiet(std::to_string(waiting) + " of this window wait for an answer.");
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
