// Nodes and links drawn from the registry; what a file could not hold is taken out again.
#include "tests/support/random_scenes.h"

#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <vector>

#include "core/define/codec.h"
#include "core/file/scene_file.h"
#include "tests/support/random_values.h"

namespace bl {

namespace {

class SceneDice {
 public:
  explicit SceneDice(std::uint64_t seed) : random_(seed, 15) {}

  Scene roll() {
    for (const auto& [id, type] : full_registry().typifications())
      if (id != kBaseNode) types_.push_back(&type);
    for (const auto& [id, kind] : full_registry().links()) kinds_.push_back(&kind);
    // Random values name the node `a`.
    add_node("a", "smart_volume");
    for (std::uint64_t n = 4 + random_.below(5); n > 0; --n)
      add_node("n" + std::to_string(n), types_[random_.below(types_.size())]->id);
    if (random_.below(2) == 0) add_plan();
    for (std::uint64_t k = random_.below(4); k > 0; --k) add_mistake(k);
    for (std::uint64_t l = 3 + random_.below(8); l > 0; --l) add_link("l" + std::to_string(l));
    return std::move(scene_);
  }

 private:
  bool happens(double share) { return random_.uniform() < share; }
  template <class List>
  const auto& one_of(const List& list) {
    return list[random_.below(std::size(list))];
  }
  std::string any_node() {
    auto it = scene_.nodes.begin();
    std::advance(it, static_cast<std::ptrdiff_t>(random_.below(scene_.nodes.size())));
    return it->first;
  }

  void add_node(const std::string& id, const std::string& type) {
    NodeRecord& node = scene_.nodes[id];
    PortValues& base = node.types[std::string(kBaseNode)];
    base["position"] = Vector3{random_.uniform(-30, 30), random_.uniform(-30, 30), random_.uniform(0, 30)};
    if (happens(0.4)) base["tags"] = Shared(std::vector<std::string>{"x"});
    add_type(id, type);
    if (happens(0.3)) add_type(id, types_[random_.below(types_.size())]->id);
  }

  void add_type(const std::string& id, const std::string& type_id) {
    const TypificationDefinition& type = *full_registry().typification(type_id);
    NodeRecord& node = scene_.nodes.edit(id);
    if (!node.types.contains(type.id)) node.types[type.id] = values_of(type, happens(0.5) ? 0.4 : 0.05);
    for (const PortDefinition& port : type.ports)
      if (!port.is_computed && port.of_scene == OfScene::no && happens(0.03)) node.locked.insert(type.id + "." + port.id);
  }

  PortValues values_of(const TypeDefinition& type, double share) {
    PortValues values;
    for (const PortDefinition& port : type.ports)
      if (why_unsettable(port).empty() && happens(share)) {
        Value value = value_of(port);
        if (is_kept(port, value)) values[port.id] = std::move(value);
      }
    return values;
  }

  Value value_of(const PortDefinition& port) {
    if (port.kind == ValueKind::selection) return Shared<Selection>(any_selection());
    if (port.kind == ValueKind::port) return any_path();
    // Samples cost their third power.
    if (port.id == "resolution") return Value(std::int64_t{8});
    if (port.id == "formula") {
      static const char* kFormulas[] = {"a +", "1/a", "a + 3*m", "sqrt(0-1)", "nobody", "", "a*b - c", "-a"};
      return std::string(one_of(kFormulas));
    }
    return random_value(port, random_);
  }

  Selection any_selection() {
    switch (random_.below(6)) {
      case 0: return {{}, "", "x"};
      case 1: return {{}, "", "nobody"};
      case 2: return {{}, types_[random_.below(types_.size())]->id, ""};
      case 3: return {};
      default: return {{any_node()}, "", ""};
    }
  }

  std::string any_path() {
    const TypificationDefinition& type = *types_[random_.below(types_.size())];
    if (type.ports.empty()) return "node.position";
    return type.id + "." + type.ports[random_.below(type.ports.size())].id;
  }

  // A boundary and a solver, so that volumes get cells, or the reason why not.
  void add_plan() {
    add_node("site", "boundary");
    add_node("solver", "smart_volumes_solver");
    scene_.nodes.edit("solver").types.at("smart_volumes_solver").erase("members");
    for (std::uint64_t v = 1 + random_.below(4); v > 0; --v) add_node("v" + std::to_string(v), "smart_volume");
  }

  void add_mistake(std::uint64_t number) {
    const std::string id = "wrong" + std::to_string(number);
    const auto put = [&](const char* type, const char* port, Value value) {
      add_node(id, type);
      scene_.nodes.edit(id).types.at(type)[port] = std::move(value);
    };
    switch (random_.below(6)) {
      case 0: return put("expression", "formula", std::string("a +"));
      case 1: return put("control", "maximum", -1.0);
      case 2: return put("plot", "volumes", Shared<Selection>(Selection{{any_node()}, "", ""}));
      case 3:
        put("boundary", "plan", Shared(std::vector<Point3>{{0, 0, 0}, {0, 0, 0}, {1, 0, 0}}));
        scene_.nodes.edit(id).types.at("boundary")["form"] = std::string("plan");
        return;
      case 4: return put("statistics", "nodes", Shared<Selection>(Selection{{any_node()}, "", ""}));
      default: return put("plot", "polygon", Shared(std::vector<Point3>{{0, 0, 0}, {30, 30, 0}, {30, 0, 0}, {0, 30, 0}}));
    }
  }

  // Nodes that have what a kind needs at this end; where there are none, one gets it.
  Selection end_of(const LinkDefinition& kind, End end) {
    std::vector<std::string> needed;
    for (const LinkRead& read : kind.reads)
      if (read.end == end && !read.path.typification.empty()) needed.push_back(read.path.typification);
    for (const LinkWrite& write : kind.proposes)
      if (write.end == end && !write.path.typification.empty()) needed.push_back(write.path.typification);
    if (happens(0.1)) return happens(0.5) ? Selection{{}, "", "x"} : Selection{{any_node()}, "", ""};
    if (!needed.empty() && happens(0.3)) return {{}, needed.front(), ""};
    std::vector<std::string> fitting;
    for (const auto& [id, node] : scene_.nodes) {
      bool fits = true;
      for (const std::string& type : needed) fits = fits && node.types.contains(type);
      if (fits) fitting.push_back(id);
    }
    if (!fitting.empty()) return {{one_of(fitting)}, "", ""};
    const std::string id = any_node();
    for (const std::string& type : needed) add_type(id, type);
    return {{id}, "", ""};
  }

  void add_link(const std::string& id) {
    const LinkDefinition& kind = *kinds_[random_.below(kinds_.size())];
    LinkRecord link;
    link.kind = kind.id;
    link.from = end_of(kind, End::from);
    link.to = end_of(kind, End::to);
    link.strength = happens(0.3) ? random_.uniform() : 1;
    link.is_muted = happens(0.05);
    link.is_enabled = !happens(0.05);
    link.parameters = values_of(kind, 0.3);
    // A port that the end has, mostly: of another one there is nothing to fail.
    for (const PortDefinition& port : kind.ports)
      if (port.kind == ValueKind::port) link.parameters[port.id] = happens(0.5) ? std::string("control.output") : any_path();
    scene_.links[id] = std::move(link);
  }

  Random random_;
  Scene scene_;
  std::vector<const TypificationDefinition*> types_;
  std::vector<const LinkDefinition*> kinds_;
};

// What the first error speaks of: a link, or the values of a type of a node. Whether anything was taken out.
bool take_out(Scene& scene, const std::string& place) {
  const std::size_t first = place.find('/'), second = place.find('/', first + 1);
  if (first == std::string::npos) return false;
  const std::string id = place.substr(first + 1, second - first - 1);
  if (place.starts_with("links/")) return scene.links.erase(id) > 0;
  if (!scene.nodes.contains(id)) return false;
  NodeRecord& node = scene.nodes.edit(id);
  node.locked.clear();
  for (auto& [type, values] : node.types)
    if (type != kBaseNode && place.find("/" + type) != std::string::npos && !values.empty()) {
      values.clear();
      return true;
    }
  return std::erase_if(node.types, [](const auto& type) { return type.first != kBaseNode; }) > 0;
}

}  // namespace

std::string random_scene(std::uint64_t seed) {
  Scene scene = SceneDice(seed).roll();
  for (int tries = 0; tries < 200; ++tries) {
    std::string text = write_scene(scene, full_registry());
    const SceneReading reading = read_scene(text, full_registry());
    if (reading.is_usable()) return text;
    if (!take_out(scene, reading.first_error().place)) break;
  }
  std::fprintf(stderr, "random scene %llu cannot be read\n", static_cast<unsigned long long>(seed));
  std::abort();
}

}  // namespace bl
