// Hashes of what an import set tell whether people have changed it; ids, sources and places tell what is the same.
#include "core/making/earlier_imports.h"

#include <algorithm>
#include <array>
#include <tuple>

#include <nlohmann/json.hpp>

#include "core/base/hash.h"
#include "core/base/plural.h"
#include "core/file/scene_file.h"
#include "core/import/context.h"
#include "core/making/named_list.h"
#include "core/session/commands.h"

namespace bl::making {

namespace {

constexpr const char* kRecord = "imported";
// The typifications that imports make; what else a node has is people's.
constexpr std::array kImportedTypes{"existing_building", "street", "junction", "turn_rules", "plot", "terrain", "data_layer"};
// Elements of different files that stand so near and have the same id are the same.
constexpr double kSamePlace = 1;  // [m]
// A feature without an id whose geometry has changed lies no farther from where it lay before.
constexpr double kMovedPlace = 5;  // [m]
// Of scenes without records: so many nodes of one name are looked at.
constexpr int kMostOfOneName = 200;

Point3 place_of(const NodeRecord& node) {
  const auto position = node.types.find("node");
  if (position == node.types.end()) return {};
  const auto value = position->second.find("position");
  const Point3* place = value == position->second.end() ? nullptr : std::get_if<Point3>(&value->second);
  return place == nullptr ? Point3{} : *place;
}

std::string text_of(const PortValues& values, const char* port) {
  const auto value = values.find(port);
  const std::string* text = value == values.end() ? nullptr : std::get_if<std::string>(&value->second);
  return text == nullptr ? "" : *text;
}

double distance_in_plan(const Point3& a, const Point3& b) { return distance({a.x, a.y, 0}, {b.x, b.y, 0}); }

// What an import sets of a node.
NodeRecord set_by_import(const NodeRecord& node) {
  NodeRecord part;
  part.name = node.name;
  if (const Point3 place = place_of(node); place != Point3{}) part.types["node"]["position"] = place;
  for (const char* type : kImportedTypes)
    if (const auto found = node.types.find(type); found != node.types.end()) part.types.insert(*found);
  return part;
}

std::string hash_of_node(const NodeRecord& node, const Registry& registry) {
  Hash hash;
  hash.add(std::string_view(node_to_json(node, registry).dump(-1, ' ', false, Json::error_handler_t::replace)));
  return hash.hex();
}

std::string key_of(const std::string& kind, const std::string& element) { return kind + "\n" + element; }

}  // namespace

bool set_as_imported(NodeRecord& node, const NodeRecord& before, const Registry& registry) {
  const auto record = node.types.find(kRecord);
  if (record == node.types.end() || hash_of_node(set_by_import(before), registry) != text_of(record->second, "as_read"))
    return false;
  record->second["as_read"] = hash_of_node(set_by_import(node), registry);
  return true;
}

EarlierImports::EarlierImports(const Scene& scene, const Registry& registry) : scene_(&scene), registry_(&registry) {
  for (const auto& [id, node] : scene.nodes) {
    const auto record = node.types.find(kRecord);
    if (record == node.types.end()) continue;
    for (const char* type : kImportedTypes)
      if (node.types.contains(type))
        known_[key_of(type, text_of(record->second, "element"))].nodes.push_back(
            {id, text_of(record->second, "source"), place_of(node)});
  }
}

void EarlierImports::begin(const std::string& source, const std::string& licence, bool has_lasting_ids,
                           std::set<std::string> elements) {
  source_ = source;
  licence_ = licence;
  has_lasting_ids_ = has_lasting_ids;
  elements_ = std::move(elements);
  left_.clear();
  claimed_before_.merge(claimed_);
  claimed_.clear();
  for (auto& [key, nodes] : known_) nodes.first = 0;
  counts_ = {};
  both_.clear();
}

bool EarlierImports::is_near(const std::string& node, const Point3& place) const {
  const auto found = scene_->nodes.find(node);
  if (found == scene_->nodes.end()) return false;
  const Point3 other = place_of(found->second);
  return distance_in_plan(other, place) <= kSamePlace;
}

// The nearest place first: in files where one id stands for several elements their order says nothing. What a file before has
// claimed in this import is that element, and not another one of the same name.
std::string EarlierImports::claim_known(Knowns& knowns, const Point3& place) {
  auto& [nodes, first] = knowns;
  while (first < nodes.size() && !is_free(nodes[first].node)) ++first;
  const auto begin = nodes.begin() + static_cast<std::ptrdiff_t>(first);
  auto found = std::find_if(begin, nodes.end(), [&](const Known& one) {
    return distance_in_plan(one.place, place) <= kSamePlace && is_free(one.node);
  });
  if (found == nodes.end())
    found = std::find_if(begin, nodes.end(), [&](const Known& one) {
      return (has_lasting_ids_ || (one.source == source_ && !claimed_before_.contains(one.node))) && is_free(one.node);
    });
  if (found == nodes.end()) return "";
  claimed_.insert(found->node);
  return found->node;
}

// Of what the source brought before and its file does not have any more.
std::string EarlierImports::claim_near(const std::string& kind, const Point3& place) {
  const auto [entry, is_new] = left_.try_emplace(kind);
  std::vector<Known>& left = entry->second;
  if (is_new) {
    for (const auto& [key, knowns] : known_)
      if (key.starts_with(key_of(kind, "")) && !elements_.contains(key.substr(kind.size() + 1)))
        for (const Known& one : knowns.nodes)
          if (one.source == source_ && !claimed_before_.contains(one.node)) left.push_back(one);
    std::sort(left.begin(), left.end(), [](const Known& a, const Known& b) {
      return std::tie(a.place.x, a.place.y, a.node) < std::tie(b.place.x, b.place.y, b.node);
    });
  }
  const Known* nearest = nullptr;
  double least = kMovedPlace;
  for (auto one = std::lower_bound(left.begin(), left.end(), place.x - kMovedPlace,
                                   [](const Known&known, double west) { return known.place.x < west; });
       one != left.end() && one->place.x <= place.x + kMovedPlace; ++one) {
    const double aside = distance_in_plan(one->place, place);
    if (aside > least || (aside == least && nearest != nullptr) || !is_free(one->node)) continue;
    nearest = &*one;
    least = aside;
  }
  if (nearest == nullptr) return "";
  claimed_.insert(nearest->node);
  return nearest->node;
}

std::string EarlierImports::claim(const std::string& kind, const std::string& id, const std::string& element,
                                  const Point3& place) {
  kinds_[source_].insert(kind);
  std::string node;
  if (const auto known = known_.find(key_of(kind, element)); known != known_.end()) node = claim_known(known->second, place);
  if (node.empty() && element.starts_with(importing::kGeometryId)) node = claim_near(kind, place);
  if (!node.empty()) return node;
  std::string candidate = id;
  for (int number = 2; number < kMostOfOneName; ++number) {
    const auto found = scene_->nodes.find(candidate);
    if (found == scene_->nodes.end() || found->second.types.contains(kRecord) || !found->second.types.contains(kind)) return "";
    const bool is_same = is_near(candidate, place) && !removed_.contains(candidate);
    if (is_same && claimed_.insert(candidate).second) return candidate;
    candidate = id + "_" + std::to_string(number);
  }
  return "";
}

bool EarlierImports::is_left_alone(const std::string& node) const {
  const NodeRecord& whole = scene_->nodes.at(node);
  const auto record = whole.types.find(kRecord);
  return record != whole.types.end() && hash_of_node(set_by_import(whole), *registry_) == text_of(record->second, "as_read");
}

std::optional<Command> EarlierImports::remove(const std::string& id) {
  if (!made_now_.contains(id) && !is_left_alone(id)) {
    ++counts_.edited;
    return std::nullopt;
  }
  removed_.insert(id);
  ++counts_.removed;
  return command<RemoveNode>({id});
}

Json EarlierImports::record(const std::string& element, const std::string& hash) const {
  Json record = {{"source", source_}, {"element", element}, {"as_read", hash}};
  if (!licence_.empty()) record["licence"] = licence_;
  return record;
}

Result<EarlierImports::Change> EarlierImports::put(const std::string& kind, const std::string& id, const std::string& element,
                                                   const Json& node) {
  Change change;
  if (made_now_.contains(id)) {
    ++counts_.unchanged;
    change.fate = Fate::as_before;
    return change;
  }
  auto made = node_from_json(node, *registry_, "nodes/" + id);
  if (!made) return made.error();
  const NodeRecord wanted = set_by_import(*made);
  const std::string hash = hash_of_node(wanted, *registry_);
  if (!is_claimed(id)) {
    Json content = node;
    content["types"][kRecord] = record(element, hash);
    change.commands.push_back(command<AddNode>({id, JsonValue::of(std::move(content))}));
    made_here_.emplace_back(key_of(kind, element), Known{id, source_, place_of(*made)});
    claimed_.insert(id);
    made_now_.insert(id);
    ++counts_.made;
    return change;
  }
  const NodeRecord& whole = scene_->nodes.at(id);
  const NodeRecord now = set_by_import(whole);
  const auto before = whole.types.find(kRecord);
  const std::string as_read = before == whole.types.end() ? "" : text_of(before->second, "as_read");
  const std::string hash_now = hash_of_node(now, *registry_);
  const bool is_left_alone = hash_now == as_read, is_same = hash_now == hash;
  change.fate = is_left_alone && !is_same ? Fate::updated : Fate::as_before;
  if (change.fate == Fate::updated) update(id, now, wanted, change.commands);
  // What people have changed keeps the hash of what was read before, so that a later import sees their change again.
  if (before == whole.types.end()) {
    change.commands.push_back(command<Typify>({id, kRecord, JsonValue::of(record(element, hash))}));
  } else {
    const auto set = [&](const char* port, const std::string& value) {
      if (text_of(before->second, port) != value)
        change.commands.push_back(command<SetPort>({id, {std::string(kRecord) + "." + port}, JsonValue::of(Json(value))}));
    };
    set("source", source_);
    set("element", element);
    if (is_left_alone || is_same) set("as_read", hash);
  }
  if (is_same) ++counts_.unchanged;
  else if (is_left_alone) ++counts_.updated;
  else {
    ++counts_.edited;
    if (hash != as_read) both_.push_back(id);
  }
  return change;
}

void EarlierImports::update(const std::string& id, const NodeRecord& now, const NodeRecord& wanted,
                            std::vector<Command>& commands) const {
  if (now.name != wanted.name) commands.push_back(command<RenameNode>({id, wanted.name}));
  std::set<std::string> types;
  for (const auto* node : {&now, &wanted})
    for (const auto& [type, values] : node->types) types.insert(type);
  static const PortValues nothing;
  for (const std::string& type : types) {
    const auto old_values = now.types.find(type), new_values = wanted.types.find(type);
    if (type != "node" && new_values == wanted.types.end()) {
      commands.push_back(command<Untypify>({id, type}));
      continue;
    }
    const PortValues& set = new_values == wanted.types.end() ? nothing : new_values->second;
    const TypificationDefinition* definition = registry_->typification(type);
    Json added = Json::object();
    std::set<std::string> ports;
    for (const auto& [port, value] : set) ports.insert(port);
    if (old_values != now.types.end())
      for (const auto& [port, value] : old_values->second) ports.insert(port);
    for (const std::string& port : ports) {
      const auto value = set.find(port);
      const PortDefinition* found = definition->find_port(port);
      if (found == nullptr) continue;
      const Json json = value == set.end() ? Json() : value_to_json(value->second, *found);
      if (type != "node" && old_values == now.types.end()) {
        added[port] = json;
        continue;
      }
      const auto old_value = old_values == now.types.end() ? nothing.end() : old_values->second.find(port);
      const bool had = old_values != now.types.end() && old_value != old_values->second.end();
      if (had != (value != set.end()) || (had && old_value->second != value->second))
        commands.push_back(command<SetPort>({id, {type + "." + port}, JsonValue::of(json)}));
    }
    if (type != "node" && old_values == now.types.end()) commands.push_back(command<Typify>({id, type, JsonValue::of(added)}));
  }
}

std::vector<std::string> EarlierImports::end(bool is_last) {
  std::vector<std::string> gone;
  const std::set<std::string>& kinds = kinds_[source_];
  for (const auto& [key, nodes] : known_)
    for (const Known& one : nodes.nodes)
      if (is_last && one.source == source_ && kinds.contains(key.substr(0, key.find('\n'))) && is_free(one.node) &&
          !claimed_before_.contains(one.node))
        gone.push_back(one.node);
  std::vector<std::string> made;
  for (auto& [key, one] : made_here_) {
    made.push_back(one.node);
    known_[key].nodes.push_back(std::move(one));
  }
  made_here_.clear();
  if (counts_.updated + counts_.unchanged + counts_.edited + counts_.removed + gone.size() == 0) return {};
  std::sort(gone.begin(), gone.end());
  std::vector<std::string> notes{"was imported before, and nothing is doubled: " + std::to_string(counts_.made) + " new, " +
                                 std::to_string(counts_.updated) + " updated, " + std::to_string(counts_.unchanged) +
                                 " unchanged, " + std::to_string(counts_.edited) + " changed by people, " +
                                 std::to_string(gone.size()) + " gone" +
                                 (counts_.removed > 0 ? ", " + std::to_string(counts_.removed) + " removed." : ".")};
  if (counts_.edited > 0)
    notes.push_back("What people have changed stays as they made it" +
                    (both_.empty() ? std::string(".")
                                   : "; the import has something else of " + named_list(both_) +
                                         ": remove a node and import again to have it as in the file."));
  if (!made.empty())
    notes.push_back("New means that the scene does not have it (it came into the file, the options take it in, or people have " +
                    std::string("removed it, which no import knows): ") + named_list(made) + ".");
  if (!gone.empty())
    notes.push_back(
        "Gone means that this import does not bring it any more (it left the file, or the options leave it out). It "
        "stays in the scene: " +
        named_list(gone) + ".");
  return notes;
}

}  // namespace bl::making
