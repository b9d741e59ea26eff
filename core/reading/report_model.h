// The content of a report, read from a state by views; parts that a scene lacks are empty.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/geometry/mesh_lines.h"
#include "core/geometry/plates.h"
#include "core/graph/state.h"
#include "core/reading/account.h"
#include "core/reading/exact_shape.h"
#include "core/reading/surroundings.h"

namespace bl::reading {

/// A SmartVolume, with or without a shape, with its demand and its present figures.
struct VolumeRow : VolumeAccount {
  std::size_t number = 0;  ///< from 1, as in the table and the pictures
  std::string id, name;
  MeshPointer mesh;             ///< none where there is no shape
  ExactShape exact;             ///< radius 0 where only the mesh is known
  geometry::StandingBody body;  ///< its plates where it stands, else without stacks
  /// Its position; of one that stands elsewhere, the middle of the largest part of its lowest plate, or the place of it that is
  /// nearest to that.
  Point3 place;
  std::size_t group = 0;  ///< volumes of one solver stand together

  /// How far the volume is from what the solver aims at, in the unit of its demand, as a share of it: what settling looks at.
  double error() const { return figures.error; }
};

/// A boundary and the lines that draw it.
struct SiteRow {
  std::string name;
  double volume = 0, ground_area = 0;  ///< [m³], [m²]
  double open_area = 0;                ///< kept open beside it [m²]
  double bottom = 0;                   ///< [m]
  MeshPointer shape;
  std::vector<geometry::Polyline> ground, plan;  ///< outline of its underside, and of all of it seen from above
};

/// A port on which proposals disagree, with the tension.
struct TensePort {
  PortRef ref;
  double tension = 0;     ///< in the port's unit
  double severity = 0;    ///< tension against the size of what is pulled at; of a limit the share that it takes away
  bool is_minor = false;  ///< nobody loses anything by it that shows in the result
  bool operator==(const TensePort&) const = default;
};

/// The same in words.
struct ConflictRow {
  std::string node, port, tension;
  std::vector<std::string> pulls;
  double amount = 0;    ///< of the tension, in the port's unit
  double severity = 0;  ///< against the size of what is pulled at
  PortRef ref;
  std::string node_id;
  std::vector<std::string> links;  ///< ids, one for each of `pulls`; empty for values that people have set or locked
};

/// A link, or people, with the conflicts that they take part in.
struct PullerRow {
  std::string link, kind;  ///< id and label of its kind; without an id: people, who have set or locked values
  std::size_t conflicts = 0;
  double share = 0;  ///< of the severity of all conflicts, each divided evenly among its participants
};

/// A failure, or something that cannot be met.
struct ProblemRow {
  std::string place, message;
  std::string node, link;    ///< ids of where it is, as far as it is somewhere
  bool is_shortage = false;  ///< no failure: a demand is not met
  bool is_place = false;     ///< no failure: volumes hang in the air or lie on one point
  bool is_rule = false;      ///< no failure: a rule of a plot is broken
  /// Ids of further nodes that take part: the volumes that break a rule.
  std::vector<std::string> others = {};
  bool operator==(const ProblemRow&) const = default;
};

struct ReportModel {
  std::string title, about;
  double tolerance = 0.01, move_limit = 0, true_north = 0;
  std::int64_t tick = 0;
  std::string hash;
  bool is_settled = false;
  std::vector<VolumeRow> volumes;  ///< ascending id
  Accounts accounts;               ///< of uses and of all together; of volumes as in `volumes`
  std::vector<SiteRow> sites;
  Surroundings surroundings;
  std::vector<ConflictRow> conflicts;  ///< the worst first
  std::size_t minor_conflicts = 0;     ///< too small to be listed
  std::vector<PullerRow> pullers;      ///< the participants of the conflicts, the largest share first
  std::vector<ProblemRow> problems;
  double plan_area = 0, site_volume = 0;  ///< of boundaries, with what they keep open [m²], without it [m³]
  double plots_area = 0;  ///< of all plots, which may be more than the ground within boundaries; 0 where there are none [m²]
  std::size_t shapes = 0;
  std::string mesh_note;             ///< the fineness of the meshes and its meaning; empty where there are none
  const VolumeRow* worst = nullptr;  ///< the largest error; nothing where there are no volumes

  std::vector<std::string> use_names() const;
};

/// Everything but conflicts and problems, then those; `worst` points into the model, which is therefore not copied.
void read_model(const State& state, ReportModel& model);
void read_conflicts(const State& state, ReportModel& model);
void read_problems(const State& state, ReportModel& model);
/// What fails or cannot be met, without the places of volumes. `links`: those of links_with_errors().
std::vector<ProblemRow> failures_of(const State& state, const std::vector<std::uint32_t>& links);
/// The part of it that plots have: broken rules, and what no smaller demand corrects. Nothing before the first tick.
std::vector<ProblemRow> rule_problems(const State& state);
/// Links that fail, remark on something, or cannot run at all; ascending.
std::vector<std::uint32_t> links_with_errors(const State& state);
bool has_error(const State& state, std::size_t link);
/// Names, figures and accounts of volumes and uses, and their totals, without shapes, sites, conflicts and problems. Readers in
/// every tick keep a FiguresMemo.
void read_figures(const State& state, ReportModel& model);
/// What follows from sites, plots and volumes together; `worst` points into the model.
void add_totals(const State& state, ReportModel& model);

/// A tension below this share of the value's size is too small to be listed; or one below the tolerance of the scene, where that
/// is more, because solvers miss what they aim at by so much.
inline constexpr double kMinorSeverity = 0.002;
/// Pulls on a place below this share of the radius are too small: bodies that touch push each other by so much all the time.
inline constexpr double kMinorPull = 0.05;
/// All ports under tension, ascending; minor ones too. Of limits only those that take something away, or that a lock keeps from
/// being kept: a limit that leaves more than another one has what it wants.
std::vector<TensePort> tense_ports(const State& state);
/// Those of one node, behind what is there.
void add_tense_ports(const State& state, std::uint32_t node, std::vector<TensePort>& tense);
/// A tension as a share of the value's size.
double severity_of(const State& state, PortRef ref, double tension);
/// Does this voice take part in what its port is now? At a limit only who holds it, or wants it tighter still.
bool takes_part(const State& state, const Voice& voice);
/// The proposals on the port, as sentences.
ConflictRow conflict_row(const State& state, const TensePort& tense);
/// The participants of these conflicts with their counts; the largest share first, then in ascending id.
std::vector<PullerRow> pullers_of(const State& state, const std::vector<ConflictRow>& conflicts);
/// "wants 7 200 m³, strength 0.5": what a link says, without its name.
std::string voice_text(const State& state, const Voice& voice);

/// Index of a link in the plan, or plan.links.size().
std::size_t link_index(const Plan& plan, std::string_view id);

}  // namespace bl::reading
