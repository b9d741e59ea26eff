// When the window draws: after input, for another moment of the scene, and while something says that it moves; else not at all.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>

#include "ui/desktop/shell/desktop.h"

namespace bl::desktop {

class FrameWatch {
 public:
  /// `wake` ends a wait of the window's loop. The thread that ticks calls it, too.
  FrameWatch(Desktop& desktop, std::function<void()> wake);
  ~FrameWatch();
  FrameWatch(const FrameWatch&) = delete;
  FrameWatch& operator=(const FrameWatch&) = delete;

  /// Something has been done at the window: a key, the mouse, another size.
  void touch();
  /// Is there anything new to draw? Looks at watched files as well, when that is due.
  bool is_due(double now);
  /// When is_due() has to be asked again although nothing has happened [s]; infinity: never.
  double next_look() const;
  /// A frame was drawn at this time.
  void drawn(double now);
  /// Does `work`, which may wait: from its beginning on, each new moment of the scene ends the wait. False where one has come
  /// just before; then nothing was done.
  bool wait(const std::function<void()>& work);

 private:
  // Shared with the listener, which lives as long as the session.
  struct Sleep {
    std::atomic<bool> is_asleep = false;
    std::function<void()> wake;
  };
  void follow_document();
  bool has_news() const;
  std::uint64_t document() const;

  Desktop* desktop_;
  std::shared_ptr<Sleep> sleep_;
  std::uint64_t document_ = 0;  // whose moments are listened to; 0: none
  std::size_t listener_ = 0;
  std::shared_ptr<const host::Moment> drawn_;
  int settling_ = 0;  // frames that are drawn because of what has happened already
  bool is_touched_ = false;
  double late_ = kNoFrame;
};

}  // namespace bl::desktop
