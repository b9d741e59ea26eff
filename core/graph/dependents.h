// Who has to be asked again when a port of a plan changes: links, sets and typifications, found by port and by node.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace bl {

struct Plan;
struct PortRef;

/// Lists of numbers, one for each key, in one block.
class NumberLists {
 public:
  std::span<const std::uint32_t> operator[](std::size_t key) const {
    return std::span(numbers_).subspan(starts_[key], starts_[key + 1] - starts_[key]);
  }
  std::size_t keys() const { return starts_.size() - 1; }
  /// Pairs of a key below `keys` and a number, in any order; each list ascends and holds a number once.
  static NumberLists made(std::size_t keys, std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs);

 private:
  std::vector<std::uint32_t> starts_{0}, numbers_;
};

/// One typification with all of its sets: what is evaluated together in phase 6.
struct SetGroup {
  std::uint32_t node = 0, type = 0;
  std::size_t first = 0, count = 0;  ///< in Plan::sets
  std::size_t analysis = kNone;      ///< in Plan::analyses
  /// Asked in every tick: it reads the time, or others write to a port of it, so that who comes first has to be found out.
  bool is_always_due = false;
  static constexpr std::size_t kNone = ~std::size_t{0};
};

struct Dependents {
  std::vector<std::uint32_t> first_port;    ///< by node and then by type, see port_index(): index of the first port
  std::vector<std::uint32_t> first_type;    ///< by node, in first_port
  std::vector<SetGroup> groups;             ///< in the order of Plan::sets
  NumberLists links_reading;                ///< by port index
  NumberLists groups_reading;               ///< by port index; also those whose own setting it is
  NumberLists groups_writing;               ///< by port index
  NumberLists links_at;                     ///< by node: links that may propose something to it
  std::vector<std::uint32_t> timed_links;   ///< that read the time
  std::vector<std::uint32_t> broken_links;  ///< that cannot run: what they said last may stand, whatever their targets are now
  std::vector<std::uint32_t> timed_nodes;   ///< with a typification without sets that reads the time

  std::size_t port_index(const PortRef& ref) const;
};

Dependents dependents_of(const Plan& plan);

}  // namespace bl
