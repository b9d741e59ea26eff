// A formula on the canvas, and the link that carries its result.
#include "core/reading/views/formula.h"

namespace bl::reading {

void FormulaSettings::declare(ViewBuilder<FormulaSettings>& v) {
  v.of("expression");
  v.reads(&FormulaSettings::formula, "expression.formula");
  v.reads(&FormulaSettings::a, "expression.a");
  v.reads(&FormulaSettings::a_unit, "expression.a_unit");
  v.reads(&FormulaSettings::unit, "expression.unit");
  v.reads(&FormulaSettings::result, "expression.result");
}
BL_VIEW(FormulaSettings)

void CarriedPort::declare(ViewBuilder<CarriedPort>& v) {
  v.of_links("map_value");
  v.reads(&CarriedPort::source, "map_value.source");
  v.reads(&CarriedPort::target, "map_value.target");
}
BL_VIEW(CarriedPort)

BL_VIEWS(formula, FormulaSettings, CarriedPort)

}  // namespace bl::reading
