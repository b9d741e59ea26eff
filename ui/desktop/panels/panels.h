// The panels around canvas and 3D view; each fills the pane that it is called in.
#pragma once

#include "ui/desktop/panels/workbench.h"

namespace bl::desktop {

/// Takes note of each tick and of what is wrong in it, whether or not a pane shows it: once in every frame.
void watch_run(Workbench& editor);
/// Toolbar: play, pause, one tick, rewind, speed; what the simulation does and whether it keeps up.
void draw_clock(Workbench& editor);
/// At the end of the toolbar: the room that the scene runs in, if it is one.
void draw_room(Workbench& editor);
/// Tab Room of a scene that runs in a room: who is here and what may be done now; facilitators lead from it.
void draw_room_panel(Workbench& editor);
/// What is chosen, with all of its ports; several nodes are edited together.
void draw_inspector(Workbench& editor);
/// Tabs below: problems and conflicts, statistics with charts, times, history, imports.
void draw_bottom(Workbench& editor);
void draw_problems(Workbench& editor);
void draw_history(Workbench& editor);
void draw_statistics(Workbench& editor);
/// What a tick takes, and who takes it.
void draw_times(Workbench& editor);
/// What became of every element of imported files; a press goes to it.
void draw_imports(Workbench& editor);

}  // namespace bl::desktop
