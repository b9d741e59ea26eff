// Walks both plans in ascending ids, side by side.
#include "core/reading/changes.h"

#include <algorithm>

namespace bl::reading {

namespace {

// Calls `only_before` and `only_after` with an index, and `both` with two, for two lists of ascending ids.
template <class List, class One, class Other, class Both>
void walk(const List& before, const List& after, const One& only_before, const Other& only_after, const Both& both) {
  std::uint32_t a = 0, b = 0;
  while (a < before.size() || b < after.size()) {
    if (b == after.size() || (a < before.size() && before[a].id < after[b].id)) only_before(a++);
    else if (a == before.size() || after[b].id < before[a].id) only_after(b++);
    else both(a++, b++);
  }
}

const std::string& type_id(const TypePlan& type) { return type.definition->id; }

class Walk {
 public:
  Walk(const State& before, const State& after) : before_(before), after_(after) {}

  Changes run() {
    const Plan &a = *before_.plan, &b = *after_.plan;
    if (a.dependents && a.dependents == b.dependents) return run_shared();
    walk(
        a.nodes, b.nodes, [&](std::uint32_t n) { changes_.removed_nodes.push_back(a.nodes[n].id); },
        [&](std::uint32_t n) { changes_.added_nodes.push_back(b.nodes[n].id); },
        [&](std::uint32_t first, std::uint32_t second) { compare_node(first, second); });
    walk(
        a.links, b.links, [&](std::uint32_t l) { changes_.removed_links.push_back(a.links[l].id); },
        [&](std::uint32_t l) { changes_.added_links.push_back(b.links[l].id); }, [](std::uint32_t, std::uint32_t) {});
    return std::move(changes_);
  }

 private:
  // Plans of the same nodes: whatever the two states share is the same.
  Changes run_shared() {
    constexpr std::size_t kLeaf = NodeStates::kLeaf;
    for (std::size_t leaf = 0; leaf < after_.nodes.leaf_count(); ++leaf) {
      if (after_.nodes.shares_leaf(before_.nodes, leaf)) continue;
      for (std::size_t n = leaf * kLeaf; n < std::min(after_.nodes.size(), (leaf + 1) * kLeaf); ++n)
        if (after_.nodes.item(n) != before_.nodes.item(n))
          compare_node(static_cast<std::uint32_t>(n), static_cast<std::uint32_t>(n));
    }
    return std::move(changes_);
  }

  void compare_node(std::uint32_t first, std::uint32_t second) {
    const std::vector<TypePlan>&a = before_.plan->nodes[first].types, &b = after_.plan->nodes[second].types;
    if (!std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const TypePlan& x, const TypePlan& y) { return type_id(x) == type_id(y); }))
      changes_.retyped_nodes.push_back(after_.plan->nodes[second].id);
    for (std::uint16_t t = 0; t < b.size(); ++t) {
      const auto other = std::find_if(a.begin(), a.end(), [&](const TypePlan& type) { return type_id(type) == type_id(b[t]); });
      const std::vector<Value>& now = after_.nodes[second].types[t].values;
      const std::vector<Value>* then =
          other == a.end() ? nullptr : &before_.nodes[first].types[static_cast<std::size_t>(other - a.begin())].values;
      // One program made both plans: values of a typification stand in one order.
      for (std::uint16_t p = 0; p < now.size(); ++p)
        if (then == nullptr || !((*then)[p] == now[p])) changes_.ports.push_back({second, t, p});
    }
  }

  const State &before_, &after_;
  Changes changes_;
};

}  // namespace

bool Changes::is_empty() const {
  return added_nodes.empty() && removed_nodes.empty() && added_links.empty() && removed_links.empty() && retyped_nodes.empty() &&
         ports.empty();
}

Changes changes_between(const State& before, const State& after) { return Walk(before, after).run(); }

}  // namespace bl::reading
