// The 3D view as a panel: camera, picking, gizmo, labels and the card of the nearest node.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/geometry/plates.h"
#include "core/sun/sun_day.h"
#include "ui/desktop/panels/hidden.h"
#include "ui/desktop/panels/workbench.h"
#include "ui/desktop/view/colouring.h"
#include "ui/desktop/view/drawn_form.h"
#include "ui/desktop/view/picking.h"
#include "ui/desktop/view/renderer.h"
#include "ui/desktop/view/scene_facts.h"
#include "ui/desktop/view/section_plane.h"
#include "ui/desktop/view/view_builder.h"

namespace bl::desktop {

/// Which legends stand in the view, and which wait behind a button.
struct LegendPlaces {
  struct Shown {
    std::size_t legend = 0;
    ImVec2 corner{};  ///< its lower left one [pixels]
  };
  std::vector<Legend> legends;
  std::vector<Shown> shown;
  std::vector<std::size_t> folded;  ///< also those that are cut
  float top = 0, highest = 0;       ///< where they end, and where they have to [pixels]
};

/// What is to be written beside a node.
struct LabelRequest;

class SceneView {
 public:
  SceneView(Workbench& editor, Renderer& renderer) : editor_(&editor), renderer_(&renderer) {}
  /// Fills the current pane, of `size` pixels.
  void draw(ImVec2 size);
  /// There is no document any more: what was read from it goes.
  void forget();
  /// Moves the camera so that the selection fills the view, or everything where `all` or where nothing is chosen.
  void fit(bool all);
  /// Moves the camera so that a box fills the view [m].
  void fit_to(const Point3& low, const Point3& high);
  /// A pin with a sentence at a place where no node stands, until the next one, another choice or Esc; the camera goes there.
  struct Pin {
    Point3 place;
    std::string text;
  };
  void put_pin(const Pin& pin);
  void drop_pin() { pin_.reset(); }
  const std::optional<Pin>& pin() const { return pin_; }

  // --- What actions ask for.
  enum class Side { plan, south, east, axonometric };
  void look_from(Side side);
  void toggle_parallel();
  void toggle_walk();
  /// Off, level, from south to north, from east to west, off.
  void next_section();
  void toggle_section();
  void set_section(const ViewSection& section);
  /// The section that is shown, as exporters of drawings take it; empty where there is none.
  std::string section_for_export() const;
  void store_camera(int number);
  void recall_camera(int number);
  void begin_move_by_key();
  void colour_by(const std::string& choice) { editor_->person.colour_by = choice; }

  // --- In which form volumes are drawn, and how many storeys from the ground up.
  DrawnLook drawn_look() const;
  void draw_as(const std::string& form) { editor_->person.drawn_as = form; }
  /// What a volume measures in that form; nothing where volumes are drawn as they are.
  std::optional<DrawnShapes::FormFigures> form_figures(std::uint32_t node) const { return drawn_.figures_of(node); }
  /// So many from the ground up. 0, or as many as there are: all. Below 0 only cellars: -1 all of them, -2 from the second down.
  void show_storeys(int count);
  /// So many more or fewer than are shown now.
  void step_storeys(int by);
  /// The number of storeys from the ground up that show everything.
  int storeys_in_all() const { return storeys_in_all_; }
  /// The number of storeys below the ground.
  int cellars_in_all() const { return cellars_in_all_; }
  /// Where the slider of storeys was drawn in the last frame [pixels]; no size where there is none.
  ImVec4 storey_slider() const { return storey_slider_; }
  /// Lengths that were written into the plan in the last frame, in the order of the sides [m].
  const std::vector<double>& dimensions() const { return dimensions_; }

  // --- The sun of another moment, for the eye alone: the scene stays as it is.
  bool has_sun() const { return facts_ && !facts_->urban.suns.empty(); }
  const std::optional<SunClock>& preview() const { return preview_; }
  void preview_sun(const SunClock& clock);
  void step_sun(double seconds, int days);
  void end_preview();
  void toggle_sun_run();
  bool is_sun_running() const { return is_sun_running_; }
  /// Makes the previewed moment the scene's, as one step that can be undone.
  void set_sun_in_scene();
  /// What is written beside the sun's track.
  std::string sun_words() const;
  /// Where the sun's track and the button beside it were drawn in the last frame [pixels]; no size where there are none.
  ImVec4 sun_track() const { return sun_track_; }
  ImVec4 sun_button() const { return sun_button_; }

  /// What the last picture was made from, besides the scene.
  const ViewChoices& choices() const { return choices_; }
  const Camera& camera() const { return choices_.camera; }
  void set_camera(const Camera& camera);
  const ViewSection& section() const { return choices_.section; }
  const std::string& colour_choice() const { return editor_->person.colour_by; }
  bool is_walking() const { return is_walking_; }
  bool is_moving() const { return move_ || reshape_ || plane_drag_; }
  /// What a hand can change of the form of the chosen standing volume.
  enum class Handle { angle, aspect, storeys };
  /// Where its handles stand in the window [pixels]; only those that can be taken hold of.
  std::vector<std::pair<Handle, ImVec2>> handles() const;
  /// What a hand can change of the section's plane.
  enum class PlaneHandle { place, angle };
  /// Where its handles stand in the window [pixels].
  std::vector<std::pair<PlaneHandle, ImVec2>> plane_handles() const;
  /// Where the mouse is in the scene; nothing where it is elsewhere.
  std::optional<Point3> cursor() const;
  /// The node under the mouse in the last frame, so that other panels can light it in the next one.
  const std::string& pointed_at() const { return pointed_at_; }
  /// What is drawn and can be picked: without the nodes that are hidden.
  const SceneFacts* facts() const { return facts_.get(); }
  /// Does what is drawn follow from the number of the tick alone?
  bool shows_ticks() const { return all_facts_ && all_facts_->has_sequence; }
  /// Where the note on hidden nodes was drawn in the last frame [pixels]; no size where there is none.
  ImVec4 hidden_note() const { return hidden_note_; }
  /// As they were drawn in the last frame.
  const LegendPlaces& legend_places() const { return legend_places_; }
  /// Where a point is in the window [pixels].
  Seen place_in_window(const Point3& point) const;

 private:
  // What a hand does with the selection: 0 to 2 along an axis, 3 to 5 in the plane across it, 6 level or facing the eye.
  struct Move {
    static constexpr int kFree = 6;
    int handle = kFree;
    bool is_by_key = false;
    Point3 anchor, grip;  // middle of what moves; where it was taken hold of
    Vector3 shift;        // so far
    std::map<std::string, Point3> starts;
    std::int64_t gesture = 0;
    std::string typed;
  };
  // What a hand does with the form of a standing volume.
  struct Reshape {
    Handle handle = Handle::angle;
    std::string node;
    Point3 centre;
    double start = 0, value = 0;  ///< of the port
    double grip = 0;              ///< where the hand took hold: an angle [degree], a distance or a height [m]
    double turned = 0;            ///< how far the hand has come around since then [degree]
    double storey_height = 3;     ///< [m]
    std::int64_t gesture = 0;
  };
  // What a hand does with the section's plane.
  struct PlaneDrag {
    PlaneHandle handle = PlaneHandle::place;
    ViewSection start;
    Point3 pivot;
    double grip = 0;    ///< where the hand took hold: along the axis [m], or an angle [degree]
    double turned = 0;  ///< how far the hand has come around since then [degree]
  };
  enum class Drag { none, pressed, orbit, pan, zoom, box };

  // Every frame, in this order.
  void follow_document();
  void follow_state();
  void advance_camera();
  void take_keys();
  void take_mouse();
  void draw_overlay();

  // scene_view_mouse.cpp
  void navigate(ImVec2 moved);
  void take_wheel();
  void take_left_button();
  void click(bool is_double);
  void select_box();
  void point_at();
  Drag drag_of_preset(int& button) const;
  Ray ray_at(ImVec2 mouse) const;
  Point3 place_under(ImVec2 mouse) const;
  void walk_about();
  void choose(const std::string& node, bool is_node);

  // scene_view_move.cpp
  std::vector<std::string> placed(bool tells);
  std::vector<std::string> movable(bool tells);
  std::optional<Point3> gizmo_centre();
  int handle_at(ImVec2 mouse);
  void begin_move(int handle, bool is_by_key);
  void go_on_moving();
  void take_typed();
  std::optional<Vector3> hand_shift() const;
  void apply_move();
  void end_move(bool is_kept);
  void draw_gizmo();
  void draw_typed();
  void draw_beside_hand(const std::string& text, const std::string& hint);

  // scene_view_reshape.cpp
  struct HandlePlace {
    Handle handle = Handle::angle;
    Point3 at, foot;  ///< of its sign; where its line begins [m]
    std::string node;
  };
  std::vector<HandlePlace> handle_places() const;
  std::optional<HandlePlace> reshape_at(ImVec2 mouse) const;
  void begin_reshape(const HandlePlace& place);
  std::optional<double> hand_on(const Reshape& reshape) const;
  void go_on_reshaping();
  void end_reshape(bool is_kept);
  void draw_reshape();

  // scene_view_section.cpp
  struct PlaneHandlePlace {
    PlaneHandle handle = PlaneHandle::place;
    Point3 at;
  };
  void recall_section();
  void keep_section();
  std::vector<PlaneHandlePlace> plane_handle_places() const;
  std::optional<PlaneHandlePlace> plane_handle_at(ImVec2 mouse) const;
  std::optional<double> hand_on(const PlaneDrag& drag) const;
  void begin_plane_drag(const PlaneHandlePlace& place);
  void go_on_with_plane();
  void draw_plane_handles();
  std::optional<double> plane_field(const char* key, const std::string& shown, double value, double per_pixel, bool is_length);
  void draw_section_strip();

  // scene_view_storeys.cpp
  void follow_look();
  void show_step(int step);
  int step_shown() const;
  int lowest_step() const { return 1 - cellars_in_all_; }
  std::string storeys_text(bool is_touched) const;
  void draw_storey_slider();
  geometry::PlateStack cellar_drawn(const geometry::StandingBody& body, std::uint32_t node) const;
  void draw_dimensions();
  void draw_forms_popup();

  // scene_view_overlay.cpp
  void draw_marks();
  std::vector<LabelRequest> label_wishes() const;
  void draw_labels();
  void draw_media_notes();
  void draw_others();
  void draw_draft_banner();
  void draw_pin();
  // scene_view_dots.cpp
  bool is_placing() const;
  bool take_dot(const ImVec2& mouse);
  void draw_dots();
  Seen visible_anchor(std::uint32_t node, const Seen& middle) const;
  void draw_scale_and_north();
  std::string street_under(const ImVec2& mouse) const;
  void note_pressed();
  void draw_hint(const std::string& text);
  void draw_tools();
  void draw_layers_popup();

  // scene_view_legends.cpp
  std::vector<Legend> legends() const;
  LegendPlaces place_legends(std::vector<Legend> all, bool is_large, float lift);
  void draw_legends(bool is_large);
  void draw_folded(const ImVec2& corner);
  ImVec2 draw_legend(const Legend& legend, const ImVec2& corner, bool is_large, float room, ImDrawList* list);

  // scene_view_sun.cpp
  const SunFacts* sun() const;
  void follow_sun();
  void follow_choice();
  float strip_height() const;
  void draw_sun_strip();
  void draw_sun_words(const SunFacts& sun, const ImVec2& corner);
  void draw_sun_track(const SunFacts& sun, const ImVec2& corner, float length);
  const sun::SunDay& day_of(const sun::SunPlace& place, sun::DayNumber day);

  // scene_view_card.cpp
  const VolumeFacts* nearest_volume() const;
  void draw_card();
  void draw_title();
  std::vector<std::string> pulls_on(std::uint32_t node) const;

  float width() const { return size_.x; }
  float height() const { return size_.y; }
  ImVec2 on_screen(const Seen& seen) const { return {at_.x + static_cast<float>(seen.x), at_.y + static_cast<float>(seen.y)}; }
  Seen seen(const Point3& point) const { return choices_.camera.project(point, width(), height()); }
  bool shows(const char* layer) const { return is_on(editor_->person, layer); }
  const std::string& id_of(std::uint32_t node) const { return facts_->state->plan->nodes[node].id; }
  /// In the state that is shown: where actions run, the editor may have a newer one already.
  std::uint32_t seen_index(const std::string& id) const { return facts_->state->plan->node_index(id); }
  void go_to(const Camera& camera);
  Point3 place_of(std::uint32_t node) const;

  Workbench* editor_;
  Renderer* renderer_;
  ViewChoices choices_;
  std::shared_ptr<const SceneFacts> all_facts_, facts_;  ///< of the state; of those nodes that are not hidden
  std::shared_ptr<const SceneFacts> whole_;              ///< as `facts_`, with the shapes of the state
  DrawnShapes drawn_;
  int storeys_shown_ = 0, storeys_in_all_ = 0, cellars_in_all_ = 0;  ///< the first as `show_storeys` has it
  ImVec4 storey_slider_{};
  std::vector<double> dimensions_;
  HiddenNodes hidden_;
  std::set<std::string> left_out_;  ///< of `facts_`
  ColourMemo colours_;
  VolumePictures pictures_;
  std::uint64_t document_ = 0;  ///< whose facts these are
  bool wants_fit_ = true, has_fitted_boundary_ = false;
  Camera from_, to_;
  double change_began_ = -1, last_frame_ = 0;
  Camera still_camera_;
  std::shared_ptr<const SceneFacts> still_facts_;
  Vector3 still_sun_;
  double still_since_ = 0;
  bool is_walking_ = false;
  Camera before_walk_;  ///< where one stood before: a walker sees too little to look around from
  double walk_began_ = -1;
  ImVec2 at_{}, size_{};
  ImVec4 hidden_note_{};
  LegendPlaces legend_places_;
  std::string wanted_legend_;  ///< the title of the one that was asked for
  bool is_hovered_ = false;

  Drag drag_ = Drag::none;
  int drag_button_ = 0;
  ImVec2 pressed_at_{};
  std::string pressed_on_;  ///< a node: pulling moves it, with all that is chosen if it is
  std::optional<Hit> hit_;
  std::string pointed_at_, pointed_link_;
  // What the last frame has shown below the mouse, and where that was: a click takes it though the picture goes on.
  std::string shown_node_, shown_link_;
  ImVec2 shown_for_{-1, -1};
  std::string clicked_node_, clicked_link_;  ///< of the press that may become a click
  std::optional<Move> move_;
  std::optional<Reshape> reshape_;
  std::optional<PlaneDrag> plane_drag_;
  ViewSection kept_section_;  ///< as the person's settings have it
  double plane_scrub_ = 0;    ///< where the drag of a field of the strip has come to, before rounding
  float strip_width_ = 0;     ///< of the strip in the last frame [pixels]
  int hot_handle_ = -1;
  std::optional<std::pair<Point3, Point3>> wanted_box_;  ///< to be brought into sight once its nodes are known
  std::optional<Pin> pin_;
  std::set<std::string> chosen_at_pin_;  ///< what was chosen when the pin was put

  std::optional<SunClock> preview_;
  bool is_sun_running_ = false;
  ShadeStore shade_;
  std::optional<std::pair<sun::SunPlace, sun::DayNumber>> day_key_;  ///< of `day_`
  sun::SunDay day_;
  ImVec4 sun_track_{}, sun_button_{};
  std::shared_ptr<const State> reach_state_;  ///< of choices_.isochrones, also where there are none
  std::pair<std::uint32_t, bool> reach_key_{};
};

}  // namespace bl::desktop
