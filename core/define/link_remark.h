// Remarks of a running link besides its proposals: unmet demands, or rules that are not kept.
#pragma once

#include <optional>
#include <utility>

#include "core/base/result.h"
#include "core/define/definition.h"

namespace bl {

/// The proposals stay in force whatever is remarked. In ascending severity.
enum class LinkRemark {
  short_of,  ///< a demand is not met: shown as a problem; the scene settles nevertheless
  /// A rule is not kept yet, and the link is working on it: the scene does not settle before it is kept. It becomes a problem
  /// once nothing changes any more.
  at_work,
  unmet,  ///< a rule cannot be kept: shown as a problem, and the scene does not settle
};

/// The remark of one link in one tick: the most severe of its pairs, among equals the first.
struct LinkRemarks {
  LinkRemark kind = LinkRemark::short_of;
  std::optional<Error> said;
};

/// Call it within evaluate(). Without a receiver it does nothing.
inline void remark(const Tick& tick, LinkRemark kind, Error what) {
  if (tick.remarks == nullptr) return;
  LinkRemarks& remarks = *tick.remarks;
  if (remarks.said && kind <= remarks.kind) return;
  remarks.kind = kind;
  remarks.said = std::move(what);
}

}  // namespace bl
