// What phase 3 keeps of links from tick to tick; with nothing kept, every tick comes to the same bits.
#pragma once

#include <memory>
#include <vector>

#include "core/graph/link_reach.h"
#include "core/graph/whole_reads.h"

namespace bl {

struct LinkMemo {
  LinkReach reach;
  WholeReads whole;
};

struct LinkMemos {
  std::shared_ptr<const Dependents> structure;  ///< of the plans that have these links
  std::vector<LinkMemo> links;                  ///< by link

  /// Nothing is kept of plans with other links.
  void follow(const Plan& plan) {
    if (structure == plan.dependents) return;
    structure = plan.dependents;
    links.clear();
    links.resize(plan.links.size());
  }
};

}  // namespace bl
