// A scene while a command changes it. All changes of scenes go through this class, which records the touched places.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/graph/namers.h"
#include "core/graph/scene.h"
#include "core/graph/touch.h"

namespace bl {

/// Holds the types, records each place at which the scene changes, and collects the ports that were placed by hand. A call that
/// changes nothing is not recorded. The functions that change the scene do not check anything; commands check before.
class SceneEdit {
 public:
  /// `kept`, where given, outlives the edit. It holds the namers of the scene, or nothing where they were not needed yet.
  SceneEdit(Scene& scene, const Registry& registry, std::optional<Namers>* kept = nullptr)
      : scene_(&scene), registry_(&registry), kept_(kept) {}
  const Scene& scene() const { return *scene_; }
  /// The types of this scene: those of the program, and the kinds of its scripts.
  const Registry& registry() const { return scene_->scripts.types(*registry_); }
  /// The types of the program alone.
  const Registry& program() const { return *registry_; }
  /// The node or link of that id, or an error that names the nearest one.
  Result<const NodeRecord*> node(const std::string& id) const;
  Result<const LinkRecord*> link(const std::string& id) const;

  void add_node(const std::string& id, NodeRecord node);
  void remove_node(const std::string& id);
  void set_name(const std::string& node, const std::string& name);
  void add_type(const std::string& node, const std::string& type, PortValues values);
  void remove_type(const std::string& node, const std::string& type);
  /// Removes the value where it is not kept (`is_kept`).
  void set_value(const std::string& node, const std::string& type, const PortDefinition& port, const Value& value);
  void erase_value(const std::string& node, const std::string& type, const PortDefinition& port);
  /// Returns whether the state changed.
  bool set_locked(const std::string& node, const std::string& path, bool is_locked);
  void add_link(const std::string& id, LinkRecord link);
  void remove_link(const std::string& id);
  /// Records the changed parts of the link; the whole link where its kind changes, or becomes known or unknown.
  void change_link(const std::string& id, LinkRecord link);
  void set_setting(const PortDefinition& port, const Value& value);
  void erase_setting(const std::string& port);
  void set_scripts(Scripts scripts);
  /// `paths` are the places inside the view that change.
  void set_view(std::string view, const std::vector<std::string>& paths);

  /// A port that accumulates (a position) starts again from its set value after this.
  void place(std::string node, std::string path) { placed_.emplace(std::move(node), std::move(path)); }
  const std::set<std::pair<std::string, std::string>>& placed() const { return placed_; }
  /// In the order of the changes; a place may occur more than once.
  const std::vector<Touch>& touches() const { return touches_; }
  std::vector<Touch> take_touches() { return std::exchange(touches_, {}); }
  /// Whether more than the view was touched, so that the scene must be compiled again.
  bool is_logic_touched() const { return is_logic_touched_ || !placed_.empty(); }

  /// The namers of the scene. The first call searches the whole scene; afterwards they are kept up to date.
  const Namers& namers();

 private:
  std::optional<Namers>& namers_slot() { return kept_ != nullptr ? *kept_ : own_; }
  template <class Content>
  void note_names(const std::string& id, const Content& content) {
    if (namers_slot()) namers_slot()->note(id, content);
  }
  void touch(ScenePart part, const std::string& id, std::string path = {});
  void touch_port(const std::string& node, const std::string& type, const PortDefinition& port, const Value& before,
                  const Value& after);
  /// Returns whether the values changed.
  bool put(PortValues& values, const PortDefinition& port, const Value& value);

  // The record to write to. Commands may hold references to what it was before.
  NodeRecord& own_node(const std::string& id);
  LinkRecord& own_link(const std::string& id);

  Scene* scene_;
  const Registry* registry_;
  std::optional<Namers>* kept_;
  std::optional<Namers> own_;
  std::set<std::pair<std::string, std::string>> placed_;
  std::vector<Touch> touches_;
  std::vector<SharedMap<NodeRecord>> past_nodes_;
  std::vector<SharedMap<LinkRecord>> past_links_;
  bool is_logic_touched_ = false;
};

}  // namespace bl
