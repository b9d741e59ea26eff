// What the panels around canvas and 3D view remember between frames: what is being typed or scrubbed, and what was worked out per
// tick.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <imgui.h>

#include "core/vote/ballot.h"
#include "ui/desktop/panels/workbench.h"

namespace bl::desktop {

struct Agenda;
class ImportList;
class InspectorView;
struct PlanPictures;
class ProblemList;
class RunRecord;
class TimeList;

/// A field that a person types into. Its key is that of the field.
struct Typing {
  std::string key, text, start;
  bool wants_focus = false, was_active = false;
  int frames = 0;
};

/// A number that is being dragged.
struct Scrub {
  std::string key;
  bool has_moved = false;
  std::int64_t gesture = 0;
  double exact = 0;           ///< where the drag has come to, before rounding; of several integers what is not yet a whole step
  bool is_abandoned = false;  ///< by Esc; the button is still held
  bool is_by = false;         ///< moves several different values, each by the same
};

/// Whose dots clicks in the 3D view set and take away.
struct DotPlacing {
  std::string vote, option, words;  ///< what the next dot says, also in words
  std::vector<std::string> options;
  std::size_t most = 0;
};

struct PanelMemory {
  PanelMemory();
  ~PanelMemory();

  Typing typing;
  Scrub scrub;
  bool wants_next = false;               ///< Tab was pressed: the next field takes over
  std::string complaint_key, complaint;  ///< why the last value that was typed was refused, and where
  std::string wanted_tab;                ///< of the lists below, to be brought to the front
  Picks shown;                           ///< what the inspector shows; stands still while somebody types
  std::string filter;                    ///< of the search field that is open
  int places_frame = -1;
  std::size_t seen_steps = 0;             ///< of the history, when it was drawn last
  std::string import_search;              ///< what rows of the import report have to hold
  std::map<std::string, ImVec4> places;   ///< fields of the last frame by key: where they stand, for tests and tours
  std::unique_ptr<InspectorView> view;    ///< of what is chosen, per tick
  std::unique_ptr<ProblemList> problems;  ///< of the last tick
  std::unique_ptr<RunRecord> record;      ///< of the last ticks
  std::shared_ptr<const State> watched;   ///< of `record` and `problems`
  std::uint64_t watched_problems = 0;     ///< the revision of those of the file
  double watch_at = 0;                    ///< when they are made anew at the earliest [s]
  std::unique_ptr<ImportList> imports;    ///< of the reports, as they are shown
  std::unique_ptr<TimeList> times;        ///< of the ticks, as they are shown
  int times_frame = -1;                   ///< the last frame in which somebody saw them
  std::unique_ptr<Agenda> agenda;         ///< of the room, as its views were at `agenda_revision`
  std::uint64_t agenda_revision = 0;
  std::map<std::string, std::string> room_texts;           ///< what is being typed in the tab Room, by field
  std::optional<std::set<std::string>> room_activities;    ///< of the next phase; none: nothing was chosen yet
  bool room_shares_minutes = false;                        ///< with everybody who took part, when the session ends
  std::map<std::string, vote::Ballot> ballots;             ///< that are filled in and not cast yet, by vote
  std::optional<DotPlacing> placing;                       ///< clicks in the 3D view set dots
  std::map<std::string, std::set<std::int64_t>> left_out;  ///< steps of proposals, by draft
  std::unique_ptr<PlanPictures> plans;                     ///< of the room as it is, and with drafts
};

/// The memory of this editor's panels; a fresh one after another document was opened.
PanelMemory& memory_of(Workbench& editor);

}  // namespace bl::desktop
