// What a brief asks for, and how links deal it out.
#pragma once

#include "core/reading/view.h"

namespace bl::reading {

/// A brief: one row for each use.
struct ProgrammeFigures {
  Shared<Table> rows;

  static void declare(ViewBuilder<ProgrammeFigures>& v);
  static const ViewDefinition& view();
};

/// A use of the scene.
struct UseKind {
  std::string use;
  bool is_open = false;  ///< it is open space, without volumes

  static void declare(ViewBuilder<UseKind>& v);
  static const ViewDefinition& view();
};

/// How a brief speaks to volumes.
struct DemandParameters {
  std::string use;  ///< that its volumes are credited to; empty for their own

  static void declare(ViewBuilder<DemandParameters>& v);
  static const ViewDefinition& view();
};

}  // namespace bl::reading
