// Picks the field by the kind of value; numbers, points, texts and choices.
#include "ui/desktop/panels/inspector_value.h"

#include <algorithm>
#include <cmath>

#include "core/define/codec.h"
#include "core/reading/figures.h"
#include "core/reading/views/volume.h"
#include "ui/desktop/panels/brief_uses.h"
#include "ui/desktop/panels/inspector_quantity.h"

namespace bl::desktop {

namespace {

constexpr const char* kSeveral = "several";

Value as_kind(const PortDefinition& port, double number) {
  if (port.kind == ValueKind::integer) return static_cast<std::int64_t>(std::llround(std::clamp(number, -9e15, 9e15)));
  return number;
}

// How much a pixel is worth: the soft range over the width of the field, or a share of the number itself.
double worth_of_pixel(const PortDefinition& port, double value, float width) {
  if (port.soft_minimum && port.soft_maximum)
    return (*port.soft_maximum - *port.soft_minimum) / std::max(40.0, static_cast<double>(width));
  const bool is_ranged =
      std::isfinite(port.hard_minimum) && std::isfinite(port.hard_maximum) && port.hard_maximum - port.hard_minimum < 1e4;
  if (is_ranged) return (port.hard_maximum - port.hard_minimum) / std::max(40.0, static_cast<double>(width));
  return std::max(std::abs(value), 1.0) * 0.005;
}

// Round numbers while scrubbing, as fine as a pixel is.
double rounded(double value, double worth) {
  const double quantum = std::pow(10, std::floor(std::log10(std::max(worth, 1e-12))));
  return std::round(value / quantum) * quantum;
}

double at_most_nine_digits(double value) {
  if (value == 0 || !std::isfinite(value)) return value;
  const double scale = std::pow(10, 8 - std::floor(std::log10(std::abs(value))));
  return std::round(value * scale) / scale;
}

std::optional<Change> typed_change(Workbench& editor, const Subject& subject, const std::string& text) {
  const double now = as_number(subject.value);
  if (const auto none = value_of_none(*subject.port); none && text == kNoneWord) return constant(*none);
  const auto number = typed_number(text, subject.unit, now);
  const std::string what = "`" + text + "` was refused: ";
  if (!number) {
    complain(editor, subject.key, what + number.error().message);
    return std::nullopt;
  }
  const PortDefinition& port = *subject.port;
  if (port.kind == ValueKind::integer && std::floor(*number) != *number) {
    complain(editor, subject.key, what + "type a whole number");
    return std::nullopt;
  }
  if (is_relative(text))
    return Change{[&port, unit = subject.unit, text](const Value& old) {
                    const auto changed = typed_number(text, unit, as_number(old));
                    return changed ? as_kind(port, *changed) : old;
                  },
                  false};
  return constant(as_kind(port, *number));
}

std::optional<Change> scrubbed_change(Workbench& editor, const Subject& subject, const CellEvent& event, float width) {
  Scrub& scrub = memory_of(editor).scrub;
  const PortDefinition& port = *subject.port;
  const double now = as_number(subject.value), worth = worth_of_pixel(port, now, width);
  if (event.has_scrub_begun) {
    scrub.exact = subject.is_mixed ? 0 : now;
    scrub.is_by = subject.is_mixed;
  }
  const ImGuiIO& io = ImGui::GetIO();
  const double fineness = io.KeyShift ? 0.1 : io.KeyCtrl ? 10 : 1;
  const double step = event.scrubbed * worth;
  const auto limited = [&port](double value) { return std::clamp(value, port.hard_minimum, port.hard_maximum); };
  if (scrub.is_by) {
    double by = step;
    if (port.kind == ValueKind::integer) {
      // Parts of a whole are kept until they come to one; rounded away in each frame, a slow hand would move nothing.
      scrub.exact += step;
      by = std::trunc(scrub.exact);
      scrub.exact -= by;
    }
    if (by == 0) return std::nullopt;
    return Change{[&port, limited, by](const Value& old) { return as_kind(port, limited(as_number(old) + by)); }, true};
  }
  scrub.exact = limited(scrub.exact + step);
  const double number = limited(at_most_nine_digits(rounded(scrub.exact, worth * fineness)));
  if (as_kind(port, number) == subject.value) return std::nullopt;
  Change change = constant(as_kind(port, number));
  change.is_live = true;
  return change;
}

std::optional<Change> text_field(Workbench& editor, const Subject& subject, float width) {
  const auto& text = std::get<std::string>(subject.value);
  CellLook look;
  look.is_long = true;
  look.is_fixed = subject.is_fixed;
  look.hint = subject.is_mixed ? kSeveral : "empty";
  if (subject.is_fixed || (text.size() > 60 && memory_of(editor).typing.key != subject.key)) {
    // Sentences are shown whole; a click on them types.
    const Colours& c = editor.theme.colours();
    ImGui::BeginGroup();
    ImGui::AlignTextToFramePadding();
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + width);
    ImGui::PushStyleColor(ImGuiCol_Text, subject.is_fixed ? c.text_soft : c.text);
    ImGui::TextUnformatted(subject.is_mixed ? kSeveral : text.empty() ? "\xE2\x80\x93" : text.c_str());
    ImGui::PopStyleColor();
    ImGui::PopTextWrapPos();
    ImGui::EndGroup();
    note_place(editor, subject.key);
    if (!subject.is_fixed && ImGui::IsItemHovered()) {
      const ImVec2 a = ImGui::GetItemRectMin(), b = ImGui::GetItemRectMax();
      ImGui::GetWindowDrawList()->AddRect({a.x - 4, a.y}, {b.x + 4, b.y}, c.line, ImGui::GetStyle().FrameRounding);
      if (ImGui::IsMouseClicked(0)) memory_of(editor).typing = {subject.key, text, text, true, false, 0};
    }
    return std::nullopt;
  }
  const CellEvent event = cell(editor, subject.key, subject.is_mixed ? "" : text, subject.is_mixed ? "" : text, width, look);
  if (!event.is_typed) return std::nullopt;
  return constant(event.text);
}

// A use can be any text, and is mostly one that the scene knows: it is typed, or taken from the list behind it.
std::optional<Change> use_field(Workbench& editor, const Subject& subject, float width) {
  const float arrow = ImGui::GetFrameHeight(), gap = editor.theme.px(2);
  std::optional<Change> change = text_field(editor, subject, width - arrow - gap);
  ImGui::SameLine(0, gap);
  if (!begin_list(editor, subject.key + "/list", "", arrow, 0, width - arrow)) return change;
  const auto& chosen = std::get<std::string>(subject.value);
  const std::vector<std::string> uses = known_uses(editor.scene());
  for (const std::string& use : uses)
    if (list_entry(editor, use, "", !subject.is_mixed && use == chosen)) {
      change = constant(use);
      ImGui::CloseCurrentPopup();
    }
  if (uses.empty())
    small_text(editor, "No brief and no volume of this scene names a use: type one.", editor.theme.colours().text_soft);
  ImGui::EndPopup();
  return change;
}

std::optional<Change> choice_field(Workbench& editor, const Subject& subject, float width) {
  const auto& chosen = std::get<std::string>(subject.value);
  std::optional<Change> change;
  const Colours& c = editor.theme.colours();
  const std::string shown = subject.is_mixed ? kSeveral : label_of(chosen);
  if (begin_list(editor, subject.key, shown, width, subject.is_mixed ? c.text_faint : 0)) {
    for (const ChoiceDefinition& choice : subject.port->choices)
      if (list_entry(editor, label_of(choice.id), choice.doc, !subject.is_mixed && choice.id == chosen)) {
        change = constant(choice.id);
        ImGui::CloseCurrentPopup();
      }
    ImGui::EndPopup();
  }
  return change;
}

std::optional<Change> fixed_field(Workbench& editor, const Subject& subject, float width) {
  switch (subject.port->kind) {
    case ValueKind::table: return table_field(editor, subject, width);
    case ValueKind::points: return points_field(editor, subject, width);
    case ValueKind::text: return text_field(editor, subject, width);
    default: break;
  }
  CellLook look;
  look.is_fixed = true;
  look.colour = editor.theme.colours().text_soft;
  const std::string text = subject.is_mixed ? kSeveral : value_text(subject.value, *subject.port, subject.unit);
  cell(editor, subject.key, text, "", width, look);
  return std::nullopt;
}

}  // namespace

Change constant(Value value) {
  return {[value = std::move(value)](const Value&) { return value; }, false};
}

std::optional<Change> number_field(Workbench& editor, const Subject& subject, float width) {
  const PortDefinition& port = *subject.port;
  const double number = as_number(subject.value);
  CellLook look;
  look.is_scrubbed = true;
  look.colour = subject.is_default ? editor.theme.colours().text_soft : 0;
  look.hint = kSeveral;
  // Beyond the soft range the slider would only say "full".
  const bool is_soft = port.soft_minimum && port.soft_maximum && number >= *port.soft_minimum && number <= *port.soft_maximum;
  if (!subject.is_mixed && is_soft && *port.soft_maximum > *port.soft_minimum)
    look.fill = (number - *port.soft_minimum) / (*port.soft_maximum - *port.soft_minimum);
  const std::string shown = subject.is_mixed ? "" : means_none(port, number) ? kNoneWord : shown_number(number, subject.unit);
  const CellEvent event = cell(editor, subject.key, shown, subject.is_mixed ? "" : typed_form(number, subject.unit), width, look);
  if (event.is_typed) return typed_change(editor, subject, event.text);
  if (event.is_scrubbing) return scrubbed_change(editor, subject, event, width);
  return std::nullopt;
}

std::optional<Change> point_field(Workbench& editor, const Subject& subject, float width) {
  const Vector3 point = std::get<Vector3>(subject.value);
  const float gap = editor.theme.px(4), each = (width - 2 * gap) / 3;
  PortDefinition part;
  part.unit = subject.unit;
  part.hard_minimum = -kCoordinateLimit;
  part.hard_maximum = kCoordinateLimit;
  constexpr double Vector3::*kParts[] = {&Vector3::x, &Vector3::y, &Vector3::z};
  constexpr const char* kNames[] = {"/x", "/y", "/z"};
  std::optional<Change> change;
  for (int k = 0; k < 3; ++k) {
    if (k > 0) ImGui::SameLine(0, gap);
    CellLook look;
    look.is_scrubbed = true;
    look.hint = each > editor.theme.px(80) ? kSeveral : "\xE2\x80\x93";
    const std::string key = subject.key + kNames[k];
    const double now = point.*kParts[k];
    const CellEvent event = cell(editor, key, subject.is_mixed ? "" : shown_number(now, Unit::none),
                                 subject.is_mixed ? "" : typed_form(now, subject.unit), each, look);
    if (event.is_hovered)
      ImGui::SetTooltip("%s  %s", k == 0 ? "x, east" : k == 1 ? "y, north" : "z, up", shown_number(now, subject.unit).c_str());
    Subject one{key, &part, subject.unit, now, subject.is_mixed, false, false};
    std::optional<Change> moved;
    if (event.is_typed) moved = typed_change(editor, one, event.text);
    else if (event.is_scrubbing) moved = scrubbed_change(editor, one, event, each * 10);
    if (!moved) continue;
    const auto member = kParts[k];
    // The field that a change refers to lives for this frame only, hence numbers instead of the port.
    const bool is_same = !moved->is_live && is_relative(event.text);
    const double target = as_number(moved->make(now)), by = target - now;
    const std::string text = event.text;
    const Unit unit = subject.unit;
    const bool is_mixed = subject.is_mixed;
    const bool is_live = moved->is_live;
    change = Change{[=](const Value& old) {
                      Vector3 v = std::get<Vector3>(old);
                      if (is_same) {
                        // What fits one node may come to no number for another, which then stays where it is.
                        if (const auto typed = typed_number(text, unit, v.*member)) v.*member = *typed;
                      } else if (is_mixed && is_live) v.*member += by;
                      else v.*member = target;
                      return Value(v);
                    },
                    is_live};
  }
  return change;
}

std::string value_text(const Value& value, const PortDefinition& port, Unit unit) {
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "on" : "off";
  if (const auto* point = std::get_if<Vector3>(&value)) {
    const auto coordinate = [](double x) { return reading::grouped(x, 2); };
    return coordinate(point->x) + ", " + coordinate(point->y) + ", " + coordinate(point->z) + " m";
  }
  if (const auto* mesh = std::get_if<MeshPointer>(&value))
    return *mesh ? reading::grouped(static_cast<double>((*mesh)->vertices.size())) + " vertices, " +
                       reading::counted((*mesh)->triangles.size(), "triangle")
                 : "none";
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* numbers = std::get_if<Numbers>(&value)) return reading::counted((*numbers)->size(), "number");
  if (port.kind == ValueKind::made) return std::string(kind_text(port.kind, port.made));
  if (const auto* points = std::get_if<Shared<std::vector<Point3>>>(&value)) return reading::counted((*points)->size(), "point");
  if (const auto* table = std::get_if<Shared<Table>>(&value)) return reading::counted((*table)->rows.size(), "row");
  if (const auto* texts = std::get_if<Shared<std::vector<std::string>>>(&value)) {
    std::string all;
    for (const std::string& one : **texts) all += (all.empty() ? "" : ", ") + one;
    return all;
  }
  if (const auto* selection = std::get_if<Shared<Selection>>(&value)) {
    if ((*selection)->is_query()) return (*selection)->typification + " " + (*selection)->tag;
    return reading::counted((*selection)->ids.size(), "node");
  }
  if (port.kind == ValueKind::number && means_none(port, as_number(value))) return kNoneWord;
  if (port.kind == ValueKind::number && !port.is_computed) return shown_number(as_number(value), unit);
  if (std::holds_alternative<std::int64_t>(value)) return reading::grouped(as_number(value));
  if (unit == Unit::ratio) return reading::percent(as_number(value));
  return reading::quantity(as_number(value), unit);
}

std::optional<Change> value_field(Workbench& editor, const Subject& subject, float width) {
  if (subject.is_fixed) return fixed_field(editor, subject, width);
  switch (subject.port->kind) {
    case ValueKind::boolean: {
      const bool is_on = std::get<bool>(subject.value);
      if (!switch_field(editor, subject.key, is_on, subject.is_mixed)) return std::nullopt;
      return constant(subject.is_mixed || !is_on);
    }
    case ValueKind::integer:
    case ValueKind::number: return number_field(editor, subject, width);
    case ValueKind::text:
      return subject.port->id == reading::port_name_of<&reading::VolumeFigures::use>() ? use_field(editor, subject, width)
                                                                                       : text_field(editor, subject, width);
    case ValueKind::choice: return choice_field(editor, subject, width);
    case ValueKind::port: return port_field(editor, subject, width);
    case ValueKind::point: return point_field(editor, subject, width);
    case ValueKind::points: return points_field(editor, subject, width);
    case ValueKind::texts: return texts_field(editor, subject, width);
    case ValueKind::table: return table_field(editor, subject, width);
    case ValueKind::selection: {
      const auto chosen =
          selection_field(editor, subject.key, *std::get<Shared<Selection>>(subject.value), subject.is_mixed, width);
      if (!chosen) return std::nullopt;
      return constant(Shared<Selection>(*chosen));
    }
    case ValueKind::json:
    case ValueKind::numbers:
    case ValueKind::made:
    case ValueKind::commands:
    case ValueKind::mesh: break;
  }
  return fixed_field(editor, subject, width);
}

}  // namespace bl::desktop
