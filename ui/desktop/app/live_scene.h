// The connections of the open scene: readings go into its log between ticks, and what actuators say goes out.
#pragma once

#include <cstdint>
#include <memory>

#include "core/live/connections.h"
#include "ui/desktop/app/editor.h"

namespace bl::desktop {

class LiveScene {
 public:
  explicit LiveScene(bool is_live) : is_live_(is_live) {}
  /// Once for each frame of the window.
  void frame(Editor& editor);

 private:
  void note_deliveries(Editor& editor) const;

  bool is_live_;
  std::uint64_t document_ = 0;  // its number; 0: none
  std::unique_ptr<Connections> connections_;
  std::string folder_;      // where the recordings of its sensors are
  std::int64_t tick_ = -1;  // the last one that was served
};

}  // namespace bl::desktop
