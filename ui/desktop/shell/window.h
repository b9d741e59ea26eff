// A real window with OpenGL: input in, pictures out.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace bl::desktop {

struct WindowOptions {
  std::string scene;                 ///< empty: the start page
  std::string pictures;              ///< a folder for the pictures that F12 takes; empty: the person's own
  std::string times;                 ///< where the frame times are written at the end, as CSV; empty: nowhere
  std::string room_report;           ///< where it is written at the end what became of the room, as CSV; empty: nowhere
  bool is_playing = true;            ///< the clock runs from the start
  bool is_live = false;              ///< connects to the sensors and actuators of scenes; recorded tables are played in any case
  std::vector<std::string> plugins;  ///< folders of plugins
  double seconds = 0;                ///< ends by itself after so long; 0: when people close it
};

/// What is said where memory runs out, besides that: every change lies in the journal as soon as it is made.
inline constexpr std::string_view kComfort =
    " Your changes since the last save are kept, and offered when the window opens again.";

/// Opens the window and stays in it until it is closed. Exit codes as those of the command line program. What nobody has caught
/// ends the program without taking down the open scene, whose journal is thereby kept.
int run_window(const WindowOptions& options) noexcept;

}  // namespace bl::desktop
