// The scene: what people have said. Nodes with their typifications and set values, links, settings; no running state.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/define/registry.h"
#include "core/graph/scripts.h"

namespace bl {

/// Values that differ from their defaults, by port id.
using PortValues = std::map<std::string, Value>;

struct NodeRecord {
  std::string name;
  std::map<std::string, PortValues> types;    ///< by typification id; every node has `node`
  std::map<std::string, std::string> ghosts;  ///< unknown typifications: their JSON as it stood in the file
  std::set<std::string> locked;               ///< "typification.port": links cannot change these
  bool operator==(const NodeRecord&) const = default;
};

struct LinkRecord {
  std::string kind;
  Selection from, to;
  bool is_enabled = true;  ///< off: not evaluated at all
  bool is_muted = false;   ///< on: evaluated and shown, but its proposals do not count
  double strength = 1;     ///< [ratio] 0 to 1: how loud its voice is
  PortValues parameters;
  std::string ghost;  ///< of an unknown kind: the whole link's JSON as it stood in the file
  bool operator==(const LinkRecord&) const = default;
};

/// What holds for the whole scene; declared like a type, so that files, schema and docs know it.
struct Settings {
  std::string title, about;
  double tolerance = 0.01;
  double move_limit = 0.02;
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
  std::map<std::string, NodeRecord> nodes;
  std::map<std::string, LinkRecord> links;
  Scripts scripts;   ///< link kinds that people wrote for this scene
  std::string view;  ///< JSON of canvas layout and cameras; never read by the tick
  bool operator==(const Scene&) const = default;
};

/// The settings as a struct, defaults filled in.
Settings settings_of(const Scene& scene);
/// A hash of everything but `view`.
std::uint64_t hash_of(const Scene& scene);
/// The nodes that a selection names, in ascending id; unknown ids are left out (check_scene reports them).
std::vector<std::string> resolve(const Scene& scene, const Registry& registry, const Selection& selection);
/// What `values` say of a port, its default, or the scene's setting where the port stands for one.
const Value& set_value(const PortValues& settings, const PortValues& values, const PortDefinition& port);
/// The same of a node of the scene, which must carry the typification.
const Value& set_value(const Scene& scene, const NodeRecord& node, const TypificationDefinition& type,
                       const PortDefinition& port);
/// Whether people have said something of a port whose set value is `value`: what differs from the default, or is kept although it
/// does not.
inline bool is_said(const PortValues& values, const PortDefinition& port, const Value& value) {
  return value != port.default_value || (port.keeps_default && values.contains(port.id));
}
/// The unit of a node's port, following `unit_from` to the port that names it.
Unit unit_of(const Registry& registry, const NodeRecord& node, const TypificationDefinition& type, const PortDefinition& port);

/// What check_scene found: an error makes a scene unfit to run, a warning leaves a link or node idle.
struct Problem {
  bool is_error = true;
  Error error;
};
/// Everything that is wrong with a scene beyond its form: dangling ids, ends without the ports, units that do not meet, ghosts.
std::vector<Problem> check_scene(const Scene& scene, const Registry& registry);

}  // namespace bl
