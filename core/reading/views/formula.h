// A formula on the canvas, and the link that carries its result.
#pragma once

#include "core/reading/view.h"

namespace bl::reading {

/// A number computed from others.
struct FormulaSettings {
  std::string formula;
  double a = 0;  ///< the first of its numbers
  std::string a_unit;
  std::string unit;  ///< of the result
  double result = 0;

  static void declare(ViewBuilder<FormulaSettings>& v);
  static const ViewDefinition& view();
};

/// From which port a number goes to which.
struct CarriedPort {
  PortChoice source;
  PortChoice target;

  static void declare(ViewBuilder<CarriedPort>& v);
  static const ViewDefinition& view();
};

}  // namespace bl::reading
