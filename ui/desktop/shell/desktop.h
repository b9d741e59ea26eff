// The whole window as one ImGui frame after another; knows no window system, so that tests can drive it without one.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ui/desktop/panels/workbench.h"
#include "ui/desktop/view/camera.h"

namespace bl::desktop {

class Renderer;
class StartPage;

class Desktop {
 public:
  /// `renderer` draws the 3D view; it outlives the desktop.
  Desktop(const Registry& registry, PersonSettings& person, Renderer& renderer);
  ~Desktop();

  /// One frame, between ImGui::NewFrame and ImGui::Render; `now` on the window's clock [s]. Afterwards `Editor::next_frame` says
  /// when the next one is wanted, though nobody does anything.
  void frame(double now);
  Workbench& editor() { return *editor_; }
  /// What the window is called: the scene, and a mark where it has unsaved changes.
  std::string title();
  /// A file that was dropped onto the window: a scene is opened, a link script (.lua) is taken into the open scene.
  void drop(const std::string& path) { drop(std::vector<std::string>{path}); }
  /// Several at once: surroundings (OpenStreetMap, city models, grids, tables) are offered for import together.
  void drop(const std::vector<std::string>& paths);
  /// A picture becomes a node of the open scene.
  void place_picture(const std::string& path);
  /// The person wants to close the window; asks first where something would be lost.
  void ask_to_quit();
  /// Once, at the start: what windows that did not end well have left.
  void offer_recovery();

 private:
  void draw_workspace(float top);
  void drop_one(const std::string& path);
  void draw_notices();
  void watch_journal();
  void let_rest();
  void follow_somebody();
  void tell_whereabouts();

  std::unique_ptr<Workbench> editor_;
  std::unique_ptr<Canvas> canvas_;
  std::unique_ptr<SceneView> view_;
  std::unique_ptr<Dialogs> dialogs_;
  std::unique_ptr<StartPage> start_page_;
  Renderer* renderer_;
  std::uint64_t fitted_ = 0;  ///< the document of a room whose scene was brought into sight when it came
  std::optional<Camera> followed_camera_;  ///< as it was set last
  Area was_area_ = Area::canvas;
  std::string told_problem_;  ///< of the journal, as people know it
};

}  // namespace bl::desktop
