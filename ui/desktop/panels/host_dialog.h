// The dialog in which a facilitator opens a room: scene, people, phases, address and file, and a check of this computer.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/serve/readiness.h"
#include "ui/desktop/document/hosting.h"
#include "ui/desktop/document/rehearsal.h"
#include "ui/desktop/panels/file_chooser.h"
#include "ui/desktop/panels/workbench.h"

namespace bl::desktop {

class HostDialog {
 public:
  enum class Page { scene, people, phases, place, check };

  explicit HostDialog(Workbench& editor);
  ~HostDialog();
  /// Begins anew for the open scene. What was chosen before for this scene stays.
  void begin();
  /// Inside the modal window; `takes_enter`: the key means the chief button. True once the dialog is over: the room is open and
  /// joined, or people want no room.
  bool draw(bool takes_enter);
  /// Gives up what is under way.
  void stop();
  HostingPlan& plan() { return plan_; }
  Page page() const { return page_; }
  bool is_opening() const { return opening_ != nullptr; }
  bool is_checking() const { return checking_ != nullptr; }
  const std::vector<serve::Finding>& findings() const { return findings_; }
  bool is_rehearsing() const { return rehearsing_ != nullptr; }
  RehearsalSize& rehearsal() { return rehearsal_; }
  /// What the last rehearsal has shown; empty where there was none, or where it was cancelled.
  const std::vector<serve::Finding>& rehearsed() const { return rehearsed_; }
  /// Why the last try has not gone well.
  const std::string& told() const { return told_; }

 private:
  void draw_steps();
  void draw_page();
  bool draw_foot(bool takes_enter);
  void draw_scene();
  void draw_people();
  void draw_phases();
  void draw_phase_row(std::size_t row, std::optional<std::size_t>& removed);
  void draw_place();
  void draw_certificate();
  void draw_check();
  void draw_rehearsal();
  void draw_findings(const char* id, const std::vector<serve::Finding>& findings);
  void draw_file(const char* label, const char* key, std::string& path, FileChooser::Purpose purpose,
                 std::vector<std::string> endings);
  void quiet(const std::string& words) const;
  void strong(const char* words) const;
  /// Why the next page cannot be shown yet; empty where it can.
  std::string missing() const;
  void go(Page page);
  void next();
  void name_files();
  void begin_check();
  void turn_check();
  void begin_rehearsal();
  void turn_rehearsal();
  void open_room();
  /// True once the room is open and this window has joined it.
  bool turn_opening();
  void write_sheet(const Hosting& room);

  Workbench* editor_;
  Page page_ = Page::scene;
  HostingPlan plan_;
  std::vector<serve::NetworkAddress> addresses_;
  std::unique_ptr<ServerProcess> checking_;
  std::unique_ptr<Hosting> opening_;
  std::unique_ptr<RehearsalRun> rehearsing_;
  RehearsalSize rehearsal_;
  std::vector<serve::Finding> findings_, rehearsed_;
  std::string told_, planned_scene_;
};

/// Begins a planned phase now. `forms`: what visitors may add, as it is.
void begin_phase(guest::RoomGuest& room, const PlannedPhase& phase, const std::vector<std::string>& forms = {});
/// Looks after the room that this window has opened: once in every frame.
void watch_hosting(Workbench& editor);

}  // namespace bl::desktop
