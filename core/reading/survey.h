// The figures of a state: every volume, the totals per use, the conflicts, and the failures.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/graph/state.h"
#include "core/reading/account.h"
#include "core/reading/report_model.h"
#include "core/reading/views/solver.h"

namespace bl::reading {

/// One use: its demand, and the figures of its volumes.
struct UseRow {
  UseAccount account;
  std::size_t alive = 0;
  std::string why_short;
};

/// The same of open space.
struct OpenRow {
  OpenAccount account;
  std::string why_short;
};

/// A proposal in a conflict: of a link, or of people, who have set or locked the value; then there is no link.
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
  double severity = 0;      ///< as TensePort has it
  bool is_minor = false;    ///< too small to be listed
  std::vector<Pull> pulls;  ///< ascending link id
};

/// A solver, and its message with the shortages of its volumes.
struct SolverRow {
  std::string id, message;
  reading::SolverFigures figures;
};

struct Survey {
  std::vector<VolumeRow> volumes;              ///< ascending id; without shapes
  std::vector<std::string> why_volumes_short;  ///< one for each of them; empty where it is not short
  std::vector<UseRow> uses;                    ///< ascending use
  UseRow all;
  std::vector<OpenRow> open;         ///< uses that are open space, in the order of programmes
  std::vector<TensionRow> tensions;  ///< those first that are listed, the worst first, ties in ascending node and port
  std::vector<SolverRow> solvers;
  std::vector<Error> problems;     ///< errors of nodes and links, and broken rules, with their places
  double tolerance = 0;            ///< below this share a volume does not count as short
  double worst_short = 0;          ///< the largest missing share of a volume or a use
  std::string worst_short_of;      ///< its name, in words
  std::vector<PullerRow> pullers;  ///< participants of the conflicts: links and people
  double worst_error = 0;          ///< share of a demand
  std::string worst;               ///< id of the node that has it; empty where all is exact
};

Survey survey_of(const State& state);

/// Ids of the solvers with their messages on unmet demands; empty where all demands are met.
std::string solver_message(const State& state);
/// Errors of nodes and links.
std::vector<Error> problems_of(const State& state);
/// Broken rules of plots with their places, as rule_problems() has them; then receivers that are short of sun.
std::vector<Error> rule_errors(const State& state);

}  // namespace bl::reading
