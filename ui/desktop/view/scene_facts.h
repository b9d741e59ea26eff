// What the 3D view shows of a state, read once for each tick.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/base/shared_list.h"
#include "core/graph/state.h"
#include "core/reading/account.h"
#include "ui/desktop/view/urban_facts.h"
#include "ui/desktop/view/view_scene.h"
#include "ui/desktop/view/volume_columns.h"

namespace bl::desktop {

/// With what was asked for and what there is, by the account that list, statistics and report read too.
struct VolumeFacts : reading::Account {
  std::uint32_t node = 0;
  std::string id, name;
  reading::VolumeFigures figures;
  MeshPointer cell;      ///< coarse, with its wrap; a ball where the solver gives a volume but no shape; none without a volume
  bool is_ball = false;  ///< the shape is not known, only its radius
  bool is_dressed = false;
  ViewFacade facade;                        ///< where it is dressed
  bool is_drawn_otherwise = false;          ///< `cell` is another shape than that of the state (see drawn_form.h)
  bool is_edgeless = false;                 ///< it is round, though its shape has facets
  double drawn_volume = 0, drawn_area = 0;  ///< what that shape measures [m³], and its floors [m²]
  /// Where that shape has its lowest floor, and how high its storeys are, where these are not those of the volume [m].
  std::optional<std::pair<double, double>> drawn_storeys;
};

/// What lies below the ground of a volume that stands. It is no part of its shape, and the ground hides it.
struct CellarFacts {
  std::uint32_t node = 0;
  int storeys = 0;
  double bottom = 0, storey_height = 0;  ///< of the lowest floor; [m]
  double area = 0;                       ///< of each plate [m²]
  MeshPointer cell;                      ///< only where something lays it open (see drawn_form.h)
};

/// A node without a volume, as a small mark.
struct MarkFacts {
  std::uint32_t node = 0;
  std::string id, name;
  Icon icon = Icon::link;  ///< of its role
  Point3 position;
};

struct BoundaryFacts {
  std::uint32_t node = 0;
  std::string id;
  MeshPointer shape;
  std::vector<std::pair<Point3, Point3>> edges;
};

/// A picture or a sequence in the scene.
struct MediaFacts {
  std::uint32_t node = 0;
  std::string id, name, message;
  std::string file;     ///< of the frame that this tick shows, as the scene names it
  ViewPicture picture;  ///< without its path
};

/// One pair of nodes that a link joins.
struct LinkFacts {
  std::size_t link = 0;  ///< index in the plan
  std::string id;
  std::uint32_t from = 0, to = 0;
};

/// What one link wants of one node's place in this tick.
struct PullFacts {
  std::size_t link = 0;
  std::uint32_t node = 0;
  Vector3 change;  ///< [m]
};

/// Volumes in ascending node. Facts of two states share those that are the same.
struct NoDigest {};
using VolumeList = SharedList<VolumeFacts, NoDigest>;

struct SceneFacts {
  std::shared_ptr<const State> state;
  VolumeList volumes;
  std::vector<CellarFacts> cellars;  ///< ascending node
  std::optional<double> pit;         ///< the ground is taken away down to here [m]
  SightBalls balls;                  ///< as volumes
  VolumeColumns columns;             ///< as volumes
  /// Volumes whose shape this picture did without, ascending: they show the one before, or a ball. Whoever draws reads on until
  /// there are none.
  std::vector<std::uint32_t> awaited;
  std::uint32_t next_shape = 0;                          ///< the node whose shape is made first then
  double tolerance = 0;                                  ///< share of what was asked for below which nobody is short
  std::shared_ptr<const reading::BriefTargets> targets;  ///< of the plan, and what programmes ask for: what accounts go by
  reading::Brief brief;
  std::vector<MarkFacts> marks;
  std::vector<BoundaryFacts> boundaries;
  std::vector<MediaFacts> media;
  bool has_sequence = false;     ///< a medium that shows another file in another tick
  std::vector<LinkFacts> links;  ///< of sets that are not too large
  std::vector<PullFacts> pulls;
  std::vector<std::string> uses;   ///< ascending
  std::vector<Point3> places;      ///< of all nodes; of a boundary the middle of its ground
  UrbanFacts urban;                ///< what stands and runs around them
  Point3 centre;                   ///< of volumes and boundaries [m]
  double radius = 50, ground = 0;  ///< [m]
  double reach = 50;               ///< [m] from the centre to the farthest surroundings

  /// Among `volumes`; volumes.size() where the node is none.
  std::size_t row_of(std::uint32_t node) const;
  const VolumeFacts* volume_of(std::uint32_t node) const;
};

/// Volumes that share a face, the lower node first.
std::vector<std::pair<std::uint32_t, std::uint32_t>> neighbours_of(const SceneFacts& facts);

inline constexpr std::size_t kAllShapes = std::numeric_limits<std::size_t>::max();
/// `last`: facts of an earlier state, or of this one, of which what has not changed is taken over; may be null. At most
/// `most_shapes` are made that nobody has looked at yet: where thousands of volumes move, making all of them for each picture
/// would take seconds.
std::shared_ptr<const SceneFacts> read_facts(std::shared_ptr<const State> state, const SceneFacts* last,
                                             std::size_t most_shapes = kAllShapes);

/// The same without some nodes: their volumes, marks, boundaries, and whatever is drawn of their links.
std::shared_ptr<const SceneFacts> facts_without(const SceneFacts& facts, const std::set<std::string>& hidden);

/// The same with other shapes of its volumes, in ascending node; those that are left out are not drawn.
std::shared_ptr<SceneFacts> facts_with(const SceneFacts& facts, std::vector<VolumeFacts> volumes);

/// The line of a street; where somebody has one of its junctions in the hand, the one that it will have.
std::vector<Point3> line_of(const StreetFacts& street, const std::map<std::uint32_t, Point3>& held);

/// A coarse mesh around a ball, to be wrapped onto it: for volumes whose shape nobody has.
MeshPointer ball_cell(const Point3& centre, double radius);
/// A body as the renderer takes volumes: one part, wrapped onto a ball that is too large to cut anything. Not for an empty mesh.
MeshPointer as_cell(const Mesh& mesh);
/// Edges of a closed mesh where its faces meet at an angle [m].
std::vector<std::pair<Point3, Point3>> sharp_edges(const Mesh& mesh);

}  // namespace bl::desktop
