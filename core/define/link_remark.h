// What a link that runs has to say beside its proposals: who goes without, or which rule is not kept.
#pragma once

#include <optional>
#include <utility>

#include "core/base/result.h"
#include "core/define/definition.h"

namespace bl {

/// Whatever is remarked, the proposals stand. In ascending gravity.
enum class LinkRemark {
  short_of,  ///< somebody goes without: shown as a problem; the scene settles nevertheless
  /// What of a rule is not kept yet while the link is bringing it about: nothing is settled before it is, and it is a problem
  /// once nothing changes any more.
  at_work,
  unmet,  ///< a rule cannot be kept: shown as a problem, and the scene does not settle
};

/// What one link has remarked in one tick. The gravest of its pairs speaks; among equals the first.
struct LinkRemarks {
  LinkRemark kind = LinkRemark::short_of;
  std::optional<Error> said;
};

/// To be called from within evaluate(). Where nobody listens, nothing is said.
inline void remark(const Tick& tick, LinkRemark kind, Error what) {
  if (tick.remarks == nullptr) return;
  LinkRemarks& remarks = *tick.remarks;
  if (remarks.said && kind <= remarks.kind) return;
  remarks.kind = kind;
  remarks.said = std::move(what);
}

}  // namespace bl
