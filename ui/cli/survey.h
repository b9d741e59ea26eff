// What a state says in figures: every volume, the totals per use, the conflicts, and what is out of order.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/graph/state.h"
#include "core/reading/account.h"
#include "core/reading/report_model.h"

namespace bl::cli {

/// The record of one SmartVolume, whatever became of it, with what was asked for and what there is.
struct VolumeRow : report::Account {
  std::string id, name, use, state, reason;
  Point3 position;                                             ///< [m]
  double weight = 0;                                           ///< [m²]
  double demand = 0;                                           ///< what the solver aims at: `limited` [m³]
  std::string why_short;                                       ///< empty where it is not short
  double cell_volume = 0;                                      ///< [m³]
  double error = 0;                                            ///< share of what the solver aims at
  double surface_area = 0, footprint = 0, spherical_area = 0;  ///< [m²]
  double storey_height = 0, height = 0, bottom = 0;            ///< [m]
};

/// One use: what is asked for, and what its volumes have.
struct UseRow {
  report::UseAccount account;
  std::size_t alive = 0;
  std::string why_short;
};

/// A voice in a conflict: of a link, or of people, who have set or locked the value; then there is no link.
struct Pull {
  std::string link;
  Value value;  ///< a change for moves, a wanted value elsewhere
  double strength = 1;
  bool is_locked = false;
};

/// One port on which proposals disagree.
struct TensionRow {
  std::string node, port, unit;
  double tension = 0;
  std::vector<Pull> pulls;  ///< ascending link id
};

struct SolverRow {
  std::string id, message;
  double boundary_volume = 0;                 ///< [m³]
  double total_demand = 0, total_volume = 0;  ///< [m³]
};

struct Survey {
  std::vector<VolumeRow> volumes;  ///< ascending id
  std::vector<UseRow> uses;        ///< ascending use
  UseRow all;
  std::vector<TensionRow> tensions;  ///< greatest first, ties in ascending node and port
  std::vector<SolverRow> solvers;
  std::vector<Error> problems;             ///< errors of nodes and links, with their places
  double tolerance = 0;                    ///< below this share nobody is short
  double worst_short = 0;                  ///< the largest share that a volume or a use is short of
  std::string worst_short_of;              ///< who that is, in words
  std::vector<report::PullerRow> pullers;  ///< who stands in the conflicts, links and people
  double worst_error = 0;                  ///< share of a demand
  std::string worst;                       ///< id of the node that has it; empty where all is exact
};

Survey survey_of(const State& state);

/// The volumes only: what every tick of a report needs.
std::vector<VolumeRow> volumes_of(const State& state);
/// Ids of the solvers with what they say cannot be had; empty where all can.
std::string solver_message(const State& state);
/// Errors of nodes and links.
std::vector<Error> problems_of(const State& state);

}  // namespace bl::cli
