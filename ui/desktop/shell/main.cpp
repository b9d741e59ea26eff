// The program `behaviourlinks-desktop`, which `behaviourlinks open` starts.
#include <cstdlib>
#include <iostream>
#include <string>

#include <CLI/CLI.hpp>

#include "core/base/scarcity.h"
#include "ui/desktop/shell/window.h"

int main(int count, char** arguments) {
  bl::prepare_for_scarcity(bl::desktop::kComfort);
  CLI::App app{"The window of BehaviourLinks: wire an urban scene by hand, and watch it negotiate."};
  bl::desktop::WindowOptions options;
  bool is_paused = false;
  app.add_option("scene", options.scene,
                 "The scene file, or the address of a room: room://HOST:PORT/CODE. Without one, the start page opens.")
      ->type_name("SCENE");
  app.add_flag("--paused", is_paused, "Opens with the clock stopped.");
  app.add_flag("--live", options.is_live, "Connects to the sensors and actuators of the scene.");
  app.add_option("--pictures", options.pictures, "Folder for the pictures that F12 takes.")->type_name("DIR");
  app.add_option("--frame-times", options.times,
                 "File for the time that every frame took [ms] and when it began [s], as CSV, written at the end.")
      ->type_name("FILE");
  app.add_option(
         "--room-report", options.room_report,
         "File for what became of the room: tick, hash, and how many hashes were the server's, as CSV, written at the end.")
      ->type_name("FILE");
  app.add_option("--seconds", options.seconds, "Closes the window after this number of seconds.")->type_name("S");
  app.add_option("--plugins", options.plugins,
                 "Folder of plugins: link kinds and typifications as shared libraries. May be repeated.")
      ->type_name("DIR")
      ->expected(1)
      ->take_all();
  try {
    app.parse(count, arguments);
  } catch (const CLI::ParseError& error) { return app.exit(error) == 0 ? 0 : 2; }
  options.is_playing = !is_paused;
  return bl::desktop::run_window(options);
}
