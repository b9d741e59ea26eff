// The connections of the open scene: readings go into its log between ticks, and what actuators say goes out.
#pragma once

#include <cstdint>
#include <memory>

#include "core/live/connections.h"
#include "ui/desktop/editor/editor.h"

namespace bl::desktop {

// What a recording says belongs to a tick, however fast ticks and frames are: so with recordings, ticks wait for a frame each.
class LiveScene {
 public:
  explicit LiveScene(bool is_live) : is_live_(is_live) { ++LiveSession::servers; }
  ~LiveScene() { --LiveSession::servers; }
  LiveScene(const LiveScene&) = delete;
  LiveScene& operator=(const LiveScene&) = delete;
  /// Once for each frame of the window.
  void frame(Editor& editor);

 private:
  void follow(LiveSession& session);
  void note_deliveries(Editor& editor) const;

  bool is_live_;
  std::uint64_t document_ = 0;  // its number; 0: none
  std::unique_ptr<Connections> connections_;
  std::string folder_;       // where the recordings of its sensors are
  std::int64_t tick_ = -1;   // the last one that was served
  std::size_t entries_ = 0;  // of the log, when the connections last followed it, and one more
};

}  // namespace bl::desktop
