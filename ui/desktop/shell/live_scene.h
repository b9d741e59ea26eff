// The devices of the open scene: served once for each tick, between two frames of the window.
#pragma once

#include <cstdint>
#include <memory>

#include "core/host/device_door.h"
#include "ui/desktop/editor/editor.h"

namespace bl::desktop {

// What a recording says belongs to a tick, however fast ticks and frames are: so with recordings, ticks wait for a frame each.
class LiveScene {
 public:
  LiveScene(Editor& editor, bool is_live) : editor_(&editor), is_live_(is_live) { editor.serves_ticks = true; }
  ~LiveScene() { editor_->serves_ticks = editor_->has_devices = false; }
  LiveScene(const LiveScene&) = delete;
  LiveScene& operator=(const LiveScene&) = delete;
  /// Once for each frame of the window.
  void frame();

 private:
  void note_deliveries() const;

  Editor* editor_;
  bool is_live_;
  std::uint64_t document_ = 0;  // its number; 0: none
  std::unique_ptr<host::DeviceDoor> devices_;
  std::string folder_;      // where the recordings of its sensors are
  std::int64_t tick_ = -1;  // the last one that was served
};

}  // namespace bl::desktop
