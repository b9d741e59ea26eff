// The account of demands: what briefs, people and links demand, the part that limits leave, the present amount, and shortages.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/graph/state.h"
#include "core/reading/open_space.h"
#include "core/reading/views/volume.h"

namespace bl::reading {

/// The account of a volume, a use, or all together. List, colours, statistics, tables, comparison and page all read it, so that
/// they agree on what is met and what is short.
struct Account {
  double asked = 0;         ///< by briefs, people and links, before any limit [m³]
  double limited = 0;       ///< the part that limits leave, which the solver aims at [m³]
  double volume = 0;        ///< the present volume [m³]
  bool is_by_area = false;  ///< a brief asks for floor area; else only volume was asked for
  double asked_area = 0;    ///< the floor area asked for, or that of the volume asked for [m²]
  double limited_area = 0;  ///< the floor area of the volume aimed at [m²]
  double floor_area = 0;    ///< the present floor area [m²]

  /// The volume and the floor area missing to the demand; never below 0. Where floor area was asked for, the missing volume is
  /// that of the missing floor area: the shape may take whatever volume its floors need.
  double missing() const;
  double missing_area() const;
  /// The same as shares of the demand, from 0 to 1.
  double missing_share() const;
  double missing_area_share() const;
  /// The part of the demanded volume that limits take away.
  double withheld() const;
  /// Of what was asked for: floor area or volume.
  double short_share() const;
  /// The present amount of what was asked for minus the demand, as a share of it, below 0 where it is less; 0 where nothing was
  /// asked for.
  double difference() const;
  double area_difference() const;
  /// Below 0 the missing share, above 0 the excess share: one number for a colour or a bar.
  double standing() const;
  bool is_short(double tolerance) const { return short_share() > tolerance; }

  void add(const Account& other);
  bool operator==(const Account&) const = default;
};

struct VolumeAccount : Account {
  std::uint32_t node = 0;
  std::string use;        ///< the use that it counts for: its own, or the one that a demand link credits it to
  bool is_alive = false;  ///< it has a shape
  reading::VolumeFigures figures;
  bool operator==(const VolumeAccount&) const = default;
};

struct UseAccount : Account {
  std::string use;
  bool is_in_programme = false;
  std::size_t volumes = 0, short_volumes = 0;
  double brief_volume = 0, brief_area = 0;  ///< what programmes ask for [m³], [m²]
  bool operator==(const UseAccount&) const = default;
};

struct Accounts {
  double tolerance = 0;                ///< share of the demand below which a volume does not count as short
  std::vector<VolumeAccount> volumes;  ///< ascending node
  std::vector<UseAccount> uses;        ///< in the order of programmes, then by name
  UseAccount all;
  std::vector<OpenAccount> open;  ///< uses that are open space; no part of `uses` and `all`

  /// The largest missing share of a volume or a use, and its name: "housing", "volume Café".
  double worst_short = 0;
  std::string worst;

  /// Among `volumes`; volumes.size() where the node is none.
  std::size_t row_of(std::uint32_t node) const;
  bool operator==(const Accounts&) const = default;
};

/// What programmes ask for a use that is not open space: all of its rows and items together.
struct BriefRow {
  double volume = 0, area = 0;  ///< [m³], [m²]
  bool operator==(const BriefRow&) const = default;
};
/// In the order of the rows, which is the order that people gave.
using Brief = std::vector<std::pair<std::string, BriefRow>>;
Brief brief_of(const State& state);
/// The same uses in the same order; what they are asked for may differ.
bool has_same_uses(const Brief& a, const Brief& b);

/// To whom demand links speak for programmes. It follows from the links of the plan alone.
struct BriefTargets {
  std::map<std::uint32_t, std::string> use_by_node;  ///< by a link with a use of its own
  std::set<std::uint32_t> nodes;
};
BriefTargets brief_targets(const Plan& plan);

Accounts accounts_of(const State& state);
/// As Accounts has it.
double account_tolerance(const State& state);
/// The same of these nodes alone, as far as they are volumes, in their order.
std::vector<VolumeAccount> accounts_of_volumes(const State& state, const std::vector<std::uint32_t>& nodes,
                                               const BriefTargets& targets, const Brief& brief);
/// Of accounts whose volumes are read: tolerance, uses, all together, and the worst.
void add_up(const State& state, const Brief& brief, Accounts& accounts);

/// What holds a volume below its demand: "link `cap`", "people"; empty where nothing does.
std::vector<std::string> who_limits(const State& state, const VolumeAccount& volume);
/// Why a volume or a use has less than its demand, as parts of a sentence with advice; empty where it is not short. For a use
/// that has enough as a whole: why single volumes of it have less.
std::string why_short(const State& state, const Accounts& accounts, const VolumeAccount& volume);
std::string why_short(const State& state, const Accounts& accounts, const UseAccount& use);

}  // namespace bl::reading
