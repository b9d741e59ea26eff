// The node canvas: entities as boxes, links between their bodies, wired by hand.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "ui/desktop/panels/workbench.h"

namespace bl::desktop {

namespace canvas {
struct Board;
}

class Canvas {
 public:
  explicit Canvas(Workbench& editor);
  ~Canvas();
  /// Fills the current pane, of `size` pixels.
  void draw(ImVec2 size);
  /// Brings everything, or what is chosen, into sight.
  void fit(bool all);
  /// Before the scene is saved: what was changed since the last frame has its places as well.
  void store_places();
  /// Brings a node into sight, if it is outside.
  void show(const std::string& node);
  /// Part of the step that adds a node somewhere else: it lies in the frame that is entered. Nothing where none is.
  std::optional<Command> joining(const std::string& node) const;

  // For actions, tests and tours.
  canvas::Board& board() { return *board_; }
  /// The middle of a node's head on the screen, or the middle of a link's curve; nothing for what is not there.
  std::optional<ImVec2> screen_of(const std::string& node) const;
  std::optional<ImVec2> screen_of_link(const std::string& link) const;
  /// The middle of the right edge, where links are pulled from.
  std::optional<ImVec2> handle_of(const std::string& node) const;
  double zoom() const;
  ImVec2 to_plane(ImVec2 screen) const;
  ImVec2 to_screen(ImVec2 plane) const;

 private:
  std::unique_ptr<canvas::Board> board_;
};

}  // namespace bl::desktop
