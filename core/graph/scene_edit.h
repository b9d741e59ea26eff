// A scene being changed by a command: the only door through which scenes change, which records what is touched.
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

/// Knows the types, records each place at which the scene becomes another one, and collects which ports were placed by hand. What
/// would change nothing is not recorded. The functions that change check nothing: commands do that before.
class SceneEdit {
 public:
  /// `kept`, where given, outlives the edit: who names whom in the scene as it is, or nothing where nobody has asked.
  SceneEdit(Scene& scene, const Registry& registry, std::optional<Namers>* kept = nullptr)
      : scene_(&scene), registry_(&registry), kept_(kept) {}
  const Scene& scene() const { return *scene_; }
  /// The types that this scene knows: those of the program, and the kinds of its scripts.
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
  /// Takes the value away where it is one that is not kept (`is_kept`).
  void set_value(const std::string& node, const std::string& type, const PortDefinition& port, const Value& value);
  void erase_value(const std::string& node, const std::string& type, const PortDefinition& port);
  /// Whether that was another state than before.
  bool set_locked(const std::string& node, const std::string& path, bool is_locked);
  void add_link(const std::string& id, LinkRecord link);
  void remove_link(const std::string& id);
  /// Records what of the link is another; all of it where its kind is, or whether that is known.
  void change_link(const std::string& id, LinkRecord link);
  void set_setting(const PortDefinition& port, const Value& value);
  void erase_setting(const std::string& port);
  void set_scripts(Scripts scripts);
  /// `paths` are the places inside the view at which it becomes another one.
  void set_view(std::string view, const std::vector<std::string>& paths);

  /// A port that accumulates (a position) starts again from its set value after this.
  void place(std::string node, std::string path) { placed_.emplace(std::move(node), std::move(path)); }
  const std::set<std::pair<std::string, std::string>>& placed() const { return placed_; }
  /// In the order of the changes; a place may stand in it more than once.
  const std::vector<Touch>& touches() const { return touches_; }
  std::vector<Touch> take_touches() { return std::exchange(touches_, {}); }
  /// Whether more than the view was touched, so that the running scene has to be compiled again.
  bool is_logic_touched() const { return is_logic_touched_ || !placed_.empty(); }

  /// Who names whom. Looked up in the whole scene by the first who asks, and kept true from then on.
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
  /// Whether the values became others.
  bool put(PortValues& values, const PortDefinition& port, const Value& value);

  Scene* scene_;
  const Registry* registry_;
  std::optional<Namers>* kept_;
  std::optional<Namers> own_;
  std::set<std::pair<std::string, std::string>> placed_;
  std::vector<Touch> touches_;
  bool is_logic_touched_ = false;
};

}  // namespace bl
