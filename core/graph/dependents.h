// Who has to be asked again when a port of a plan changes: links, sets and typifications, found by port and by node.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/base/heap_bytes.h"
#include "core/graph/item_edits.h"
#include "core/graph/port_ref.h"

namespace bl {

struct Plan;

/// Lists of numbers, one for each key, in one block.
class NumberLists {
 public:
  std::span<const std::uint32_t> operator[](std::size_t key) const {
    return std::span(numbers_).subspan(starts_[key], starts_[key + 1] - starts_[key]);
  }
  std::size_t keys() const { return starts_.size() - 1; }
  std::size_t bytes() const { return heap_bytes(starts_) + heap_bytes(numbers_); }
  /// Pairs of a key below `keys` and a number, in ascending numbers; each list ascends and holds a number once.
  static NumberLists made(std::size_t keys, const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs);

 private:
  std::vector<std::uint32_t> starts_{0}, numbers_;
};

/// Lists of links, one for each port, found by node and then by port. Ports without links take no room.
class LinkLists {
 public:
  struct Entry {
    PortRef port;
    std::uint32_t link = 0;
    auto operator<=>(const Entry&) const = default;
  };

  /// Ascending, each link once.
  std::span<const std::uint32_t> operator[](const PortRef& port) const;
  /// Without the entries `less`, then with links renumbered, then with the entries `more`. `places`: by link, its number then;
  /// empty: they keep their numbers. `less` and `more` in any order.
  LinkLists edited(std::size_t nodes, std::vector<Entry> less, std::span<const std::uint32_t> places,
                   std::vector<Entry> more) const;
  std::size_t bytes() const { return heap_bytes(starts_) + heap_bytes(ports_) + heap_bytes(links_); }

 private:
  // Where the lists of a node begin. Nodes that have no lists yet have none.
  std::uint32_t start(std::uint32_t node) const { return starts_[std::min<std::size_t>(node, starts_.size() - 1)]; }
  // Appends the lists of the nodes [first, last) of another one as they are, but for new numbers.
  void append(const LinkLists& from, std::uint32_t first, std::uint32_t last, std::span<const std::uint32_t> places);

  std::vector<std::uint32_t> starts_{0};      // by node
  std::vector<std::uint32_t> ports_, links_;  // typification and port in one number; ascending in each node, then by link
};

/// One typification with all of its sets: what is evaluated together in phase 6.
struct SetGroup {
  std::uint32_t node = 0, type = 0;
  std::size_t first = 0, count = 0;  ///< in Plan::sets
  std::size_t analysis = kNone;      ///< in Plan::analyses
  bool is_always_due = false;        ///< asked in every tick: it reads the time, or an analysis is among its rivals
  /// The first of the groups that it shares a port with to write to, or that share one with these, and so on; kNone where it has
  /// its ports to itself. Such groups are asked together, so that who comes first is found out.
  std::size_t rivals = kNone;
  /// None of the ports that it replies to is written to twice, by a rival or by itself.
  bool writes_alone = true;
  static constexpr std::size_t kNone = ~std::size_t{0};
};

/// What follows from the nodes and sets of a plan.
struct SetDependents {
  std::vector<std::uint32_t> first_port;   ///< by node and then by type, see port_index(): index of the first port
  std::vector<std::uint32_t> first_type;   ///< by node, in first_port
  std::vector<SetGroup> groups;            ///< in the order of Plan::sets
  NumberLists groups_reading;              ///< by port index; also those whose own setting it is
  NumberLists groups_writing;              ///< by port index
  std::vector<std::uint32_t> timed_nodes;  ///< with a typification without sets that reads the time

  std::size_t port_index(const PortRef& ref) const { return first_port[first_type[ref.node] + ref.type] + ref.port; }
  std::size_t bytes() const {
    return sizeof(*this) + heap_bytes(first_port) + heap_bytes(first_type) + heap_bytes(groups) + groups_reading.bytes() +
           groups_writing.bytes() + heap_bytes(timed_nodes);
  }
};

/// What follows from its links.
struct LinkDependents {
  LinkLists reading;                  ///< by port
  LinkLists at;                       ///< by node, as port {node, 0, 0}: links that may propose something to it
  std::vector<std::uint32_t> timed;   ///< that read the time
  std::vector<std::uint32_t> broken;  ///< that cannot run: what they said last may stand, whatever their targets are now

  std::size_t bytes() const { return sizeof(*this) + reading.bytes() + at.bytes() + heap_bytes(timed) + heap_bytes(broken); }
};

/// Plans of the same Dependents have the same nodes, names, tags, typifications, sets and links; other values may differ.
struct Dependents {
  std::shared_ptr<const SetDependents> sets;  ///< shared with plans that are amended and have the same sets
  std::shared_ptr<const LinkDependents> links;

  /// About how much memory they take that `before` (nullptr: none) do not.
  std::size_t unshared_bytes(const Dependents* before) const {
    return sizeof(*this) + (before != nullptr && sets == before->sets ? 0 : kBytesOfBlock + sets->bytes()) +
           (before != nullptr && links == before->links ? 0 : kBytesOfBlock + links->bytes());
  }
};

std::shared_ptr<const Dependents> dependents_of(const Plan& plan);
/// The same for a plan of nodes with the same typifications as in `before`, from that of `before`; `edits` of its links ascend.
std::shared_ptr<const Dependents> amended_dependents(const Plan& before, const Plan& plan, std::span<const ItemEdit> edits,
                                                     bool has_other_sets);

}  // namespace bl
