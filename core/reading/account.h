// The account of demands: what was asked for, by whoever asked, what limits leave of it, what there is, and who goes short.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/graph/state.h"
#include "core/reading/views/volume.h"

namespace bl::reading {

/// Of a volume, a use, or everything together. List, colours, statistics, tables, comparison and page read this and nothing else,
/// so that none of them can call met what another one calls short.
struct Account {
  double asked = 0;         ///< by briefs, people and links, before any limit [m³]
  double limited = 0;       ///< what limits leave of that: what the solver aims at [m³]
  double volume = 0;        ///< what there is [m³]
  bool is_by_area = false;  ///< a brief asks, and briefs ask for floor area; else volume alone was asked for
  double asked_area = 0;    ///< floor area that was asked for, or that the volume asked for makes [m²]
  double limited_area = 0;  ///< floor area that the volume aimed at makes [m²]
  double floor_area = 0;    ///< what there is [m²]

  /// What of the volume, and of the floor area, is missing against what was asked for; never below 0.
  double missing() const;
  double missing_area() const;
  /// The same as shares of what was asked for, from 0 to 1.
  double missing_share() const;
  double missing_area_share() const;
  /// What limits hold back of the volume asked for.
  double withheld() const;
  /// The larger of both shares where floor area was asked for, else that of the volume.
  double short_share() const;
  /// What there is against what was asked for, below 0 where it is less; 0 where nothing was asked for.
  double difference() const;
  double area_difference() const;
  /// Below 0 the share that is short, above it what there is beyond what was asked for: one number for a colour or a bar.
  double standing() const;
  bool is_short(double tolerance) const { return short_share() > tolerance; }

  void add(const Account& other);
};

struct VolumeAccount : Account {
  std::uint32_t node = 0;
  std::string use;        ///< that it counts for: its own, or the one that a demand link credits it to
  bool is_alive = false;  ///< it has a shape
  reading::VolumeFigures figures;
};

struct UseAccount : Account {
  std::string use;
  bool is_in_programme = false;
  std::size_t volumes = 0, short_volumes = 0;
  double brief_volume = 0, brief_area = 0;  ///< what programmes ask for [m³], [m²]
};

struct Accounts {
  double tolerance = 0;                ///< share of what was asked for below which nobody is short
  std::vector<VolumeAccount> volumes;  ///< ascending node
  std::vector<UseAccount> uses;        ///< in the order of programmes, then by name
  UseAccount all;

  /// The largest share that a volume or a use is short of; and of whom, in words: "housing", "volume Café".
  double worst_short = 0;
  std::string worst;
};

Accounts accounts_of(const State& state);

/// What programmes ask for a use: all of its rows and items together.
struct BriefRow {
  double volume = 0, area = 0;  ///< [m³], [m²]
};
/// In the order of the rows, which is the order that people gave.
std::vector<std::pair<std::string, BriefRow>> brief_of(const State& state);

/// Who holds a volume below what it asks for: "link `cap`", "people"; empty where nobody does.
std::vector<std::string> who_limits(const State& state, const VolumeAccount& volume);
/// Why a volume or a use has less than was asked for, as parts of a sentence with what helps; empty where it is not short.
/// Of a use that has enough as a whole: why single volumes of it have not.
std::string why_short(const State& state, const Accounts& accounts, const VolumeAccount& volume);
std::string why_short(const State& state, const Accounts& accounts, const UseAccount& use);

}  // namespace bl::reading
