// One value of a declared port as a field: which field it is follows from the kind of value alone.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/define/definition.h"
#include "ui/desktop/panels/inspector_cell.h"

namespace bl::desktop {

/// A value to be shown, of one owner or of several at once.
struct Subject {
  std::string key;  ///< unique among the fields that are seen, such as `smart_volume.demand`
  const PortDefinition* port = nullptr;
  Unit unit = Unit::none;
  Value value;
  bool is_mixed = false;  ///< the owners hold different values
  bool is_fixed = false;  ///< computed, or of something that cannot be changed
  bool is_default = false;
};

/// What a person wants of it: a new value made from each owner's old one.
struct Change {
  std::function<Value(const Value&)> make;
  bool is_live = false;  ///< part of a drag: goes into the gesture of the scrub
};

std::optional<Change> value_field(Workbench& editor, const Subject& subject, float width);
/// The value in one line, for computed ones and for "now ...".
std::string value_text(const Value& value, const PortDefinition& port, Unit unit);

// The fields of single kinds.
std::optional<Change> number_field(Workbench& editor, const Subject& subject, float width);
std::optional<Change> point_field(Workbench& editor, const Subject& subject, float width);
std::optional<Change> points_field(Workbench& editor, const Subject& subject, float width);
std::optional<Change> table_field(Workbench& editor, const Subject& subject, float width);
std::optional<Change> texts_field(Workbench& editor, const Subject& subject, float width);
std::optional<Change> port_field(Workbench& editor, const Subject& subject, float width);
/// `members`: how many nodes it names, where somebody knows.
std::optional<Selection> selection_field(Workbench& editor, const std::string& key, const Selection& selection, bool is_mixed,
                                         float width);
/// The change to one constant value.
Change constant(Value value);

}  // namespace bl::desktop
