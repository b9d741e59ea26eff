// Problems with the positions of volumes: bodies in the air, and volumes that lie on one point.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/base/vector.h"

#include "core/graph/state.h"

namespace bl::reading {

struct VolumePlace;

/// A problem of one or several volumes, in words. `subject` and `text` can stand beside each other, `sentence()` alone.
struct PlaceProblem {
  std::string subject;             ///< "Playground pavilion hangs 15.3 m above the ground"
  std::string text;                ///< the allowed standing, and what to do
  std::vector<std::string> nodes;  ///< ids, ascending
  std::vector<std::string> links;  ///< ids of the links that cause it, ascending

  bool operator==(const PlaceProblem&) const = default;
  std::string sentence() const { return text.empty() ? subject : subject + ": " + text; }
};

/// A lowest point no higher than this above what it should stand on is no problem [m].
inline constexpr double kLeastHang = 0.1;
/// Volumes whose positions are nearer than this share of the smaller one's radius lie on one point.
inline constexpr double kOnePoint = 0.1;

/// The places of volumes in one state after another: of the next state only nodes that have changed are read, and only they are
/// looked at for neighbours on one point.
class VolumePlaces {
 public:
  /// `changed`: the nodes in which the state differs from the one that was read last, as changed_nodes() has them.
  void read(const State& state, const std::optional<std::vector<std::uint32_t>>& changed);
  /// Volumes of the state that was read last which hang, by node. What is said of one follows from its node and from the links.
  const std::map<std::uint32_t, PlaceProblem>& hanging() const { return hanging_; }
  /// Groups on one point in the same state, which has to be given.
  std::vector<PlaceProblem> collapsed(const State& state) const;

 private:
  struct Level {
    double bottom = 0;  // of its lowest floor [m]
    std::string base;   // on whose roof it stands, or would if that had one
    bool operator==(const Level&) const = default;
  };
  struct Volume {
    std::uint32_t node = 0;
    Point3 position;
    double radius = 0;           // of a ball of the wanted volume [m]
    double hang = 0;             // [m]
    std::optional<Level> level;  // where it has storeys
  };
  using Pair = std::pair<std::size_t, std::size_t>;

  static Volume volume_of(const State& state, std::uint32_t node, const VolumePlace& place);
  void join(std::size_t a, std::size_t b);
  void part(std::size_t row);
  void find_all_pairs();
  void read_changed(const State& state, const std::vector<std::uint32_t>& changed);
  void read_hanging(const State& state, const Volume& volume);
  std::vector<std::vector<std::uint32_t>> groups_on_one_point() const;

  std::vector<Volume> volumes_;  // ascending node
  std::set<Pair> on_one_point_;  // rows, each pair in both orders
  std::map<std::uint32_t, PlaceProblem> hanging_;
  LinkStates links_;  // which `hanging_` tells of
};

/// Volumes that stand on nothing that they may stand on, ascending id.
std::vector<PlaceProblem> hanging_volumes(const State& state);
/// Groups of volumes on one point, the largest first, with the links that pull them together.
std::vector<PlaceProblem> collapsed_volumes(const State& state);
/// Both: first the groups on one point.
std::vector<PlaceProblem> place_problems(const State& state);

}  // namespace bl::reading
