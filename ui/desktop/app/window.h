// A real window with OpenGL: input in, pictures out.
#pragma once

#include <string>
#include <vector>

namespace bl::desktop {

struct WindowOptions {
  std::string scene;                 ///< empty: the start page
  std::string pictures;              ///< a folder for the pictures that F12 takes; empty: the person's own
  std::string times;                 ///< where the frame times are written at the end, as CSV; empty: nowhere
  bool is_playing = true;            ///< the clock runs from the start
  bool is_live = false;              ///< connects to the sensors and actuators of scenes; recorded tables are played in any case
  std::vector<std::string> plugins;  ///< folders of plugins
  double seconds = 0;                ///< ends by itself after so long; 0: when people close it
};

/// Opens the window and stays in it until it is closed. Exit codes as those of the command line program.
int run_window(const WindowOptions& options);

}  // namespace bl::desktop
