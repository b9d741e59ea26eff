// The proposal as plain data, made once from a state of a scene: what all exporters write, each in its own format.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/mesh.h"
#include "core/drawing/palette.h"
#include "core/geometry/plates.h"
#include "core/import/local_frame.h"
#include "core/reading/volume_form.h"

namespace bl::exporting {

/// One storey of a building.
struct Storey {
  int number = 0;  ///< from 0, the lowest of its building above the ground; below it -1, -2, ...
  int level = 0;   ///< of the plan that shows it, from 0; each storey of a building has a level of its own; of a cellar `number`
  double bottom = 0, top = 0;              ///< height above the origin [m]
  double floor_area = 0;                   ///< the storey's part of the building's figure [m²]
  std::vector<geometry::PlateFace> faces;  ///< its outline, arcs as chords
  /// The same with arcs, of standing volumes only: outlines, and what is not built of them; all as `geometry::PlateStack` has
  /// them.
  std::vector<geometry::PlateRing> rings, courtyards;
};

/// A SmartVolume with a shape.
struct Building {
  std::string id, label, use;
  drawing::Colour colour;    ///< of its use
  Point3 position;           ///< [m]
  Point3 place;              ///< of its ground, at the position or nearest to it [m]
  Point3 arc_centre;         ///< of all arcs of a standing volume [m]
  bool is_standing = false;  ///< whole storeys on a footprint; else a rounded volume, cut at the middle of each storey
  double asked_area = 0, floor_area = 0;  ///< [m²]
  double asked_volume = 0, volume = 0;    ///< [m³]
  double footprint = 0;                   ///< [m²]
  double storey_height = 0;               ///< [m]
  double bottom = 0, top = 0;             ///< height above the origin [m]
  std::vector<Storey> storeys;            ///< from the ground up; the sum of their floor areas is `floor_area`
  /// Below the ground, from the top down. They are neither part of `floor_area` nor of `volume` and `mesh`.
  std::vector<Storey> cellars;
  std::vector<geometry::PlateFace> outline;  ///< of its lowest storey where it stands, else as seen from above
  std::shared_ptr<const Mesh> mesh;          ///< closed; never empty
  std::shared_ptr<const Mesh> light_mesh;    ///< of a standing volume: the same with fewer triangles, for pages
  MeshPointer shape;                         ///< of a rounded one: as its solver made it; meshes of other depths follow from it
  std::string why_shapeless;                 ///< of a volume without a shape: the reason
};

/// A plot with its indices, or the boundary that volumes stay in.
struct Land {
  std::string id, name;
  bool is_boundary = false;
  std::vector<geometry::PlateFace> faces;
  double area = 0;                         ///< [m²]
  double open_area = 0;                    ///< kept open beside it by a boundary [m²]
  double ground = 0;                       ///< height above the origin [m]
  double fsi = 0, gsi = 0;                 ///< of a plot
  std::optional<double> fsi_max, gsi_max;  ///< none where there is no rule
  std::optional<double> height_max;        ///< [m]
  double osr = 0, storeys = 0;             ///< open space ratio, and mean number of storeys, of a plot
  double top = 0;                          ///< of the highest volume above its ground [m]
};

/// The ground that a solver of standing volumes divides, with its indices: net of what nobody may build on, but with open space.
struct NetGround {
  std::string id, name;
  double area = 0, open_area = 0;  ///< [m²]
  double fsi = 0, gsi = 0, osr = 0, storeys = 0;
};

/// Sun on open ground, such as a garden, per day of the period studied.
struct SunPlace {
  std::string id, name;
  double required_hours = 0;  ///< [h]
  double share = 0;           ///< of its area that has as much
  double required_share = 1;  ///< that should have it
  double mean = 0;            ///< of all of its area [h]
  bool is_met() const { return share >= required_share - 1e-9; }
};

/// Ground on which nothing is built, for no use of the programme.
struct KeptGround {
  std::string kind;  ///< such as "street"
  std::vector<geometry::PlateFace> faces;
};

/// A building of the surroundings, which stands already.
struct Neighbour {
  std::string id, name, use;
  geometry::PlateFace face;
  double bottom = 0, top = 0;        ///< height above the origin [m]
  std::shared_ptr<const Mesh> mesh;  ///< may be null
};

struct Street {
  std::string name;
  std::vector<Point3> line;
};

/// A use as it is written: those without a name have one here.
inline std::string use_name(const std::string& use) { return use.empty() ? "no use" : use; }

/// What was asked for a use, and what it got. The one without a name is all of them together.
struct UseRow {
  std::string use, letter;
  drawing::Colour colour;
  std::size_t buildings = 0;
  double asked_area = 0, floor_area = 0;  ///< [m²]
  double asked_volume = 0, volume = 0;    ///< [m³]
};

/// Ground that nobody builds on, for a use such as a garden: it has neither volumes nor floor area.
struct OpenSpace {
  std::string use;
  drawing::Colour colour;
  double asked_area = 0, area = 0;         ///< asked for by programmes, and kept open [m²]
  std::string why_short;                   ///< empty where it is enough
  std::vector<geometry::PlateFace> faces;  ///< as they are drawn; parts of them may lie outside of the boundary
};

/// A number that people have agreed to look at, with its goal.
struct Indicator {
  std::string id, name;
  double value = 0, target = 0;  ///< in the unit of the indicator
  std::string unit;              ///< its symbol; empty for a plain number
  std::string direction;         ///< `at_least`, `at_most` or `near`
  std::string status;            ///< `met`, `close` or `far`
  double score = 0;              ///< 1 where the goal is met
};

/// A port on which proposals disagree, in words.
struct Conflict {
  std::string node, port, tension;
  std::vector<std::string> pulls;  ///< who wants what, as sentences
};

/// Something that fails, or that cannot be met.
struct Trouble {
  std::string place, message;
};

struct Proposal {
  std::string title, about;
  std::string file;  ///< the scene's file, without its folder
  std::string hash;  ///< of the state
  std::int64_t tick = 0;
  bool is_settled = false;
  reading::VolumeForm form = reading::VolumeForm::as_is;  ///< that buildings, uses and sums have; the rest is of the scene
  importing::GeoReference reference;                      ///< of the local frame; `crs` is empty where the scene says nothing
  std::vector<Building> buildings;                        ///< ascending id
  std::vector<Building> shapeless;  ///< volumes without a shape: they have figures, but neither storeys nor a mesh
  std::vector<Land> lands;
  std::vector<Neighbour> neighbours;
  std::vector<Street> streets;
  std::vector<std::shared_ptr<const Mesh>> terrains;  ///< surfaces of the ground, open
  std::vector<Indicator> indicators;                  ///< ascending id
  std::vector<Conflict> conflicts;                    ///< the worst first
  std::size_t minor_conflicts = 0;                    ///< too small to be listed
  std::vector<Trouble> troubles;
  std::vector<UseRow> uses;
  UseRow all;
  std::vector<NetGround> grounds;      ///< ascending id
  std::vector<SunPlace> suns;          ///< ascending id
  std::vector<KeptGround> kept;        ///< by kind
  std::vector<OpenSpace> open_spaces;  ///< in the order of programmes; no part of `uses` and `all`
  double ground = 0;                   ///< of level 0 [m]
  double level_height = 3;             ///< of one level: the least height of a storey with another one above it [m]
  int levels = 0;                      ///< number of plans that show all storeys
  std::string shell;                   ///< the built page, where a format asks for it; empty: there is none

  /// Where a use stands in `uses`; their number where it is none of them.
  std::size_t use_number(const std::string& use) const {
    std::size_t number = 0;
    while (number < uses.size() && uses[number].use != use) ++number;
    return number;
  }
  /// "Urban quarter", or the file where the scene has no title.
  const std::string& name() const { return title.empty() ? file : title; }
};

}  // namespace bl::exporting
