// What all panels of a window share: the document, the selection, the theme, and `submit`, which changes the scene.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "ui/desktop/document/document.h"
#include "ui/desktop/document/person_settings.h"
#include "ui/desktop/editor/script_watch.h"
#include "ui/desktop/look/theme.h"

namespace bl::desktop {

struct PanelMemory;

/// The selected and hovered elements, shared by all panels. It is no part of the scene, and is not undone.
struct Picks {
  std::set<std::string> nodes, links;
  std::string hovered_node, hovered_link;  ///< hovered in this frame, in any panel
  std::string lit_node, lit_link;          ///< hovered in the frame before, for panels that are drawn earlier

  void clear() { nodes.clear(), links.clear(); }
  void only_node(const std::string& id) { links.clear(), nodes = {id}; }
  void only_link(const std::string& id) { nodes.clear(), links = {id}; }
};

/// The area that gets keys: canvas or 3D view once the mouse has moved over them, lists and inspector after a click; F6 switches.
enum class Area { none, canvas, view, panels };

enum class NoticeKind { told, warning, error };
struct Notice {
  NoticeKind kind = NoticeKind::told;
  std::string text;
  double until = kUnseen;  ///< on the window's clock [s]
  /// Its time begins with the first frame that shows it: the window may have rested for long before.
  static constexpr double kUnseen = -1;
};

/// Nothing that is drawn changes by itself.
inline constexpr double kNoFrame = std::numeric_limits<double>::infinity();

/// The wanted id, or the first free one of wish-2, wish-3 and so on.
std::string fresh_key(const std::string& wish, const std::function<bool(const std::string&)>& is_taken);

/// The status of an actuator's messages according to its connection; no part of the state.
struct Delivery {
  std::int64_t messages = 0;
  double sent_at = -1;  ///< on the window's clock [s]; -1: nothing was sent yet
  std::string problem;  ///< of the connection
};

/// Somebody else in the room of the open scene.
struct Other {
  std::int64_t seat = 0;
  std::string name;
  ImU32 colour = 0;
  std::set<std::string> holds;  ///< nodes that they have selected
  std::optional<Vector3> cursor;
  std::string camera;  ///< as text; empty: not told
};

class Editor {
 public:
  Editor(const Registry& all_types, PersonSettings& somebody) : program(all_types), person(somebody) {}

  const Registry& program;  ///< the types that need no scene
  PersonSettings& person;
  Theme theme;
  Picks picks;
  std::unique_ptr<Document> document;          ///< none: the start page
  std::vector<Problem> problems;               ///< of the last file that was opened, or tried: set by `list_problems`
  std::string problem_file;                    ///< that file
  std::uint64_t problems_revision = 0;         ///< changes with each list
  std::shared_ptr<const host::Moment> moment;  ///< taken once for each frame; none without a document
  double now = 0;                              ///< the window's clock [s]
  mutable double next_frame = kNoFrame;        ///< when this frame's panels want the next one, though nobody does anything [s]
  Area area = Area::canvas;
  std::vector<Notice> notices;
  bool is_beamer = false, wants_quit = false, wants_picture = false;
  bool has_devices = false;                    ///< sensors and actuators are connected: they are served in each tick
  bool serves_ticks = false;                   ///< each tick of a scene with recordings waits until it was served
  ScriptWatch script_watch;                    ///< files that link kinds of this scene are read from
  std::shared_ptr<PanelMemory> panels;         ///< memory of inspector, lists and charts for this document
  std::uint64_t bytes_sent = 0;                ///< bytes sent to the graphics processor since the window opened
  std::vector<Other> others;                   ///< who else is in the room, as their windows have said last
  std::int64_t followed = 0;                   ///< the seat whose camera this window follows; 0: nobody's
  std::map<std::string, Delivery> deliveries;  ///< by actuator, where there is a connection

  // --- Reading: the scene as people have left it, and the state as the last tick has left it.
  const Scene& scene() const { return document->scene(); }
  const State& state() const { return *moment->state; }
  /// The types of the program and the kinds of the scene's scripts. Pointers into it stay valid until the frame after the next.
  const Registry& types() const;
  /// Index of the node in the state; state().nodes.size() where no tick has evaluated it yet.
  std::uint32_t index_of(const std::string& node) const { return state().plan->node_index(node); }
  /// Name, or id where there is none.
  std::string name_of(const std::string& node) const;

  // --- Changing. Errors become notices; whether it went well.
  /// `label`: the name of the step in the history, where its commands alone do not say what was meant.
  bool submit(const std::vector<Command>& commands, std::int64_t gesture = 0, const std::string& label = "");
  bool submit(const Command& command, std::int64_t gesture = 0) { return submit(std::vector<Command>{command}, gesture); }
  /// One frame of a gesture: values that the next frame sets anew. It is shown at once.
  bool show(const std::vector<Command>& commands, std::int64_t gesture);
  void end_gesture(std::int64_t gesture);
  /// A patch of the scene's view (canvas layout, cameras), as one step.
  bool arrange(const JsonValue& patch, std::int64_t gesture = 0);
  std::int64_t new_gesture() { return document->running().new_gesture(); }
  void undo();
  void redo();
  /// A free id for a new node or link, made from a wanted one such as "tower".
  std::string fresh_id(const std::string& wish) const;

  /// The mouse is over this area. A mouse that does not move leaves the keys with the other area.
  void point_at(Area where);
  void notify(NoticeKind kind, std::string text);
  /// Asks for a frame at that time of the window's clock: what is drawn then is something else than now.
  void wake_at(double time) const { next_frame = std::min(next_frame, time); }
  /// Asks for a frame as soon as possible: something moves.
  void go_on() const { wake_at(now); }
  /// Sets the problems of a file in place of those of the last one.
  void list_problems(std::string file, std::vector<Problem> found);
  /// Opens a file and shows its problems; the old document stays where the new one cannot be opened.
  bool open(const std::string& path, bool plays = false);
  /// Joins the room of an address, in place of the open document.
  bool join(const std::string& address);
  void take(std::unique_ptr<Document> fresh);
  /// At the beginning of a frame: submits due values of gestures, and releases scripts that nothing can point into any more.
  void begin_frame();

  /// Who of the others has selected this node; nobody where nobody has.
  const Other* holder_of(const std::string& node) const;

 private:
  void hear_room();
  // Panels keep pointers into types() until they hear of a change; scripts that were replaced live on until then.
  mutable std::vector<Scripts> held_, held_before_;
};

}  // namespace bl::desktop
