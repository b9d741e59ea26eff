// A person's settings for windows of this program: kept between runs, no part of any scene.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace bl::desktop {

struct PersonSettings {
  bool is_dark = true;
  float scale = 1;  ///< 1 to 2
  float canvas_share = 0.5f, side_width = 320, bottom_height = 210;
  bool shows_side = true, shows_bottom = true;
  std::string colour_by = "use";                ///< what the 3D view colours volumes by
  std::string drawn_as = "as_is";               ///< in which form the 3D view draws volumes
  std::string navigation = "rhino";             ///< rhino, blender, sketchup, polyscope
  int width = 1440, height = 900;               ///< of the window
  std::vector<std::string> recent;              ///< scene files, the last first
  std::vector<std::string> recent_rooms;        ///< addresses, the last first
  std::vector<std::string> recent_additions;    ///< typifications and link kinds that were added last
  std::map<std::string, bool> layers;           ///< of the 3D view, by id; those that differ from their defaults
  std::map<std::string, std::string> seats;     ///< in rooms: by HOST:PORT/CODE, what opens the seat again
  std::map<std::string, std::string> plans;     ///< by the code of a room: the phases that this person has planned for it
  std::map<std::string, std::string> sections;  ///< by scene file: the section of the 3D view that is on there
  std::string file;                             ///< where it is kept; empty: nowhere (tests)

  void remember(std::vector<std::string>& list, const std::string& item, std::size_t most = 12);
};

struct Extent {
  int width = 0, height = 0;
};
/// The size of a new window: the wanted size, reduced to fit a screen of the size `room` with its title bar (0: not known).
Extent fitting_window(Extent wished, Extent room);

/// Reads the person's file; settings that are missing or unreadable get their defaults.
PersonSettings read_person_settings(const std::string& file);
Result<void> write_person_settings(const PersonSettings& settings);

}  // namespace bl::desktop
