// The scene, as people have set it: nodes with their typifications and set values, links, and settings, without running state.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/base/shared_map.h"
#include "core/define/registry.h"
#include "core/graph/scripts.h"

namespace bl {

/// Values that differ from their defaults, by port id.
using PortValues = std::map<std::string, Value>;

struct NodeRecord {
  std::string name;
  std::map<std::string, PortValues> types;    ///< by typification id; every node has `node`
  std::map<std::string, std::string> ghosts;  ///< unknown typifications: their unchanged JSON from the file
  std::set<std::string> locked;               ///< "typification.port": links cannot change these
  bool operator==(const NodeRecord&) const = default;
};

struct LinkRecord {
  std::string kind;
  Selection from, to;
  bool is_enabled = true;  ///< off: not evaluated
  bool is_muted = false;   ///< on: evaluated and shown, but its proposals do not count
  double strength = 1;     ///< [ratio] 0 to 1: how much its proposals count
  PortValues parameters;
  std::string ghost;  ///< of an unknown kind: the unchanged JSON of the whole link from the file
  bool operator==(const LinkRecord&) const = default;
};

/// Settings of the whole scene; declared like a type, so that the file format, the schema and the catalogue follow from it.
struct Settings {
  std::string title, about;
  double tolerance = 0.01;
  double move_limit = 0.02;
  double least_move = 1e-6;
  double change_limit = 0.001;
  int calm_ticks = 5;
  std::string coordinate_system;
  double origin_x = 0, origin_y = 0;
  double latitude = 0, longitude = 0;
  double true_north = 0;
};
const TypeDefinition& settings_type();

struct Scene {
  PortValues settings;
  SharedMap<NodeRecord> nodes;
  SharedMap<LinkRecord> links;
  Scripts scripts;   ///< link kinds that people wrote for this scene
  std::string view;  ///< JSON of the canvas layout and the cameras; the tick never reads it
  bool operator==(const Scene&) const = default;
};

/// The settings as a struct, defaults filled in.
Settings settings_of(const Scene& scene);
/// A hash of everything but `view`.
std::uint64_t hash_of(const Scene& scene);
/// Is the node among those that the selection means?
bool selects(const Registry& registry, const Selection& selection, const std::string& id, const NodeRecord& node);
/// The nodes of a selection in ascending id; unknown ids are left out (check_scene reports them).
std::vector<std::string> resolve(const Scene& scene, const Registry& registry, const Selection& selection);
/// The value of a port in `values`, else its default, or the scene's setting where the port stands for one.
const Value& set_value(const PortValues& settings, const PortValues& values, const PortDefinition& port);
/// The same for a node of the scene, which must carry the typification.
const Value& set_value(const Scene& scene, const NodeRecord& node, const TypificationDefinition& type,
                       const PortDefinition& port);
/// Does the set value `value` of a port count as set by people? It does where it differs from the default, and for ports that
/// keep the default.
inline bool is_said(const PortValues& values, const PortDefinition& port, const Value& value) {
  return value != port.default_value || (port.keeps_default && values.contains(port.id));
}
/// The unit of a node's port, following `unit_from` to the port that names it.
Unit unit_of(const Registry& registry, const NodeRecord& node, const TypificationDefinition& type, const PortDefinition& port);

/// A problem found by check_scene: with an error a scene cannot run, with a warning a link or node is idle.
struct Problem {
  bool is_error = true;
  Error error;
};
/// All problems of a scene beyond its form: ids of nothing, ends without the needed ports, units that differ, ghosts.
std::vector<Problem> check_scene(const Scene& scene, const Registry& registry);

}  // namespace bl
