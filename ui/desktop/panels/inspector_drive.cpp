// Drives a number by a formula: an expression node and the link that carries its result are added in one step.
#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/define/codec.h"
#include "core/reading/views/formula.h"
#include "ui/desktop/panels/canvas/canvas.h"
#include "ui/desktop/panels/inspector.h"
#include "ui/desktop/panels/inspector_quantity.h"

namespace bl::desktop {

namespace {

using reading::CarriedPort;
using reading::FormulaSettings;
using reading::path_of;
using reading::port_name_of;

}  // namespace

bool can_be_driven(const Workbench& editor, const PortDefinition& port) {
  const bool is_choosing = port.rule == CombineRule::blend || port.rule == CombineRule::min || port.rule == CombineRule::max;
  return port.kind == ValueKind::number && is_choosing &&
         editor.types().typification(reading::type_of<reading::FormulaSettings>()) != nullptr &&
         editor.types().link(reading::type_of<reading::CarriedPort>()) != nullptr;
}

// The formula begins as `a`, with the number that stands there now: nothing jumps, and the formula is then changed in its own
// node.
void drive_by_expression(Workbench& editor, const std::string& node, const std::string& path, double now, Unit unit) {
  const Scene& scene = editor.scene();
  const std::string subject = editor.name_of(node), port = path.substr(path.find('.') + 1);
  const std::string expression = editor.fresh_id(node + "_" + port), link = editor.fresh_id(expression + "_drive");
  const std::string symbol = info(unit).pretty.empty() ? "" : std::string(info(unit).symbol);
  Json position = {0, 0, 0};
  const auto record = scene.nodes.find(node);
  if (record == scene.nodes.end()) return;
  if (const auto base = record->second.types.find(std::string(kBaseNode)); base != record->second.types.end())
    for (const auto& [id, value] : base->second)
      if (const auto* at = std::get_if<Vector3>(&value)) position = {at->x, at->y, at->z + 10};
  const Json formula = {{port_name_of<&reading::FormulaSettings::formula>(), port_name_of<&reading::FormulaSettings::a>()},
                        {port_name_of<&reading::FormulaSettings::a>(), now},
                        {port_name_of<&reading::FormulaSettings::a_unit>(), symbol},
                        {port_name_of<&reading::FormulaSettings::unit>(), symbol}};
  const Json made = {{"name", label_of(port) + " of " + subject},
                     {"position", position},
                     {"types", {{reading::type_of<reading::FormulaSettings>(), formula}}}};
  const Json laid = {{"kind", reading::type_of<reading::CarriedPort>()},
                     {"from", expression},
                     {"to", node},
                     {"parameters",
                      {{port_name_of<&reading::CarriedPort::source>(), path_of<&reading::FormulaSettings::result>()},
                       {port_name_of<&reading::CarriedPort::target>(), path}}}};
  std::vector<Command> commands{command<AddNode>({expression, JsonValue::of(made)}),
                                command<AddLink>({link, JsonValue::of(laid)})};
  // A value that is set would be blended with the formula's: the formula shall have its way.
  const auto parsed = parse_port_path(path);
  if (parsed && record->second.types.contains(parsed->typification) &&
      record->second.types.at(parsed->typification).contains(parsed->port))
    commands.push_back(command<SetPort>({node, {path}, {"null"}}));
  if (editor.canvas != nullptr)
    if (auto joining = editor.canvas->joining(expression)) commands.push_back(std::move(*joining));
  if (!editor.submit(commands)) return;
  editor.picks.only_node(expression);
  editor.notify(NoticeKind::told, "An expression now drives " + label_of(port) + " of " + subject + ": change its formula here.");
}

}  // namespace bl::desktop
