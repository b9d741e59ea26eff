// The parts of the inspector: rows with a label and a field, sections, and what is shown of nodes, links and the scene.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/reading/report_model.h"
#include "ui/desktop/panels/inspector_value.h"

namespace bl::desktop {

/// The small signs at the end of a row.
struct RowSigns {
  bool can_reset = false, can_lock = false, is_locked = false, can_drive = false;
};
struct RowEvent {
  bool wants_reset = false, wants_lock = false, wants_drive = false;
};
/// Label and signs of a row; the field follows, `width` wide, and then end_row.
RowEvent begin_row(Workbench& editor, const std::string& key, const std::string& label, const std::string& doc,
                   const std::string& facts, const RowSigns& signs, float& width);
void end_row();
/// A heading that folds its rows away; `wants_removal` may be nothing.
bool section(Workbench& editor, const std::string& key, const std::string& label, const std::string& doc, bool* wants_removal);
/// The name of what is shown, and a quiet line below it.
void heading(Workbench& editor, const std::string& name, const std::string& below, ImU32 colour = 0);
/// JSON that this program does not understand, with a note.
void draw_ghost(Workbench& editor, const std::string& json, const std::string& note);

/// A setting of several owners at once.
struct SharedPort {
  const PortDefinition* port = nullptr;
  Unit unit = Unit::none;
  Value value;
  bool is_mixed = false, is_default = true, is_locked = false, is_partly_locked = false;
};
/// A role that all chosen nodes have.
struct SharedType {
  const TypificationDefinition* type = nullptr;
  std::vector<SharedPort> settings;
};

/// What the chosen nodes and links have in common; made anew after changes, and per tick where it shows the state.
class InspectorView {
 public:
  void refresh(Workbench& editor, const Picks& shown);
  const std::vector<std::string>& nodes() const { return nodes_; }
  const std::vector<std::string>& links() const { return links_; }
  const std::vector<SharedType>& types() const { return types_; }
  /// Of the only link kind that all chosen links have; nothing where they differ.
  const LinkDefinition* kind() const { return kind_; }
  const std::vector<SharedPort>& parameters() const { return parameters_; }
  /// Indices of the links that start or end at the only chosen node.
  const std::vector<std::size_t>& touching(const State& state);
  /// Who pulls on a setting of the only chosen node.
  const reading::ConflictRow& pulls(const State& state, PortRef ref);

 private:
  void merge_nodes(const Workbench& editor);
  void merge_links(const Workbench& editor);

  std::vector<std::string> nodes_, links_;
  std::set<std::string> asked_nodes_, asked_links_;
  std::size_t log_size_ = static_cast<std::size_t>(-1);
  std::vector<SharedType> types_;
  const LinkDefinition* kind_ = nullptr;
  std::vector<SharedPort> parameters_;
  std::shared_ptr<const State> state_;
  std::map<PortRef, reading::ConflictRow> pulls_;
  std::shared_ptr<const Plan> touched_plan_;  ///< held, so that no other plan can have its address
  std::string touched_node_;
  std::vector<std::size_t> touching_;
};

/// Changes a setting of all given nodes as one step; the gesture of the scrub where the change is live.
void change_ports(Workbench& editor, const std::vector<std::string>& nodes, const TypificationDefinition& type,
                  const PortDefinition& port, const std::string& key, const Change& change);

void inspect_nodes(Workbench& editor, InspectorView& view);
void inspect_links(Workbench& editor, InspectorView& view);
/// The links of the only chosen node, as a way to get to them.
void list_links(Workbench& editor, InspectorView& view);
void inspect_scene(Workbench& editor);
/// What the state makes of a setting: its effective value, what moved it, its tension.
void draw_effective(Workbench& editor, InspectorView& view, PortRef ref, const Value& set, float width);
/// Offers a formula for a number: a node that computes it and a link that carries it, in one step.
void drive_by_expression(Workbench& editor, const std::string& node, const std::string& path, double now, Unit unit);
bool can_be_driven(const Workbench& editor, const PortDefinition& port);

}  // namespace bl::desktop
