// The people that should be there, compared with the nodes that are.
#include "core/live/crowd.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/csv/csv_reader.h"
#include "core/define/json_text.h"
#include "core/define/registry.h"
#include "core/live/message.h"

namespace bl::live {

namespace {

Error in_line(const csv::CsvRecord& record, const std::string& sentence) {
  return {ErrorCode::parse, "line " + std::to_string(record.line), sentence};
}

Json place_of(const Vector3& place) { return {place.x, place.y, place.z}; }

}  // namespace

Result<std::vector<WalkStep>> read_walk(std::string_view text, const address::LiveAddress& address) {
  const auto csv = csv::read_csv(text);
  if (!csv) return csv.error();
  if (csv->records.empty()) return Error{ErrorCode::missing, "line 1", "the table is empty"};
  const std::vector<std::string>& header = csv->records.front().fields;
  std::size_t columns[4] = {};
  const std::string names[4] = {address.column, address.time.empty() ? "time" : address.time, "x", "y"};
  for (std::size_t k = 0; k < 4; ++k) {
    const auto found = std::find(header.begin(), header.end(), names[k]);
    if (found == header.end())
      return Error{ErrorCode::not_found, "line 1",
                   "the table has no column " + in_quotes(names[k]) + did_you_mean(names[k], header)};
    columns[k] = static_cast<std::size_t>(found - header.begin());
  }
  std::vector<WalkStep> walk;
  for (std::size_t r = 1; r < csv->records.size(); ++r) {
    const csv::CsvRecord& record = csv->records[r];
    const auto field = [&](std::size_t k) {
      return columns[k] < record.fields.size() ? record.fields[columns[k]] : std::string();
    };
    const auto seconds = parse_number(field(1));
    if (!is_identifier(field(0)) || field(0).size() > 20)
      return in_line(record, in_quotes(field(0)) + " is no name of up to 20 letters and digits");
    if (!seconds || !std::isfinite(*seconds)) return in_line(record, in_quotes(field(1)) + " is no time in seconds");
    WalkStep step{*seconds, field(0), {}};
    if (!field(2).empty() || !field(3).empty()) {
      const auto x = parse_number(field(2)), y = parse_number(field(3));
      if (!x || !y || !std::isfinite(*x) || !std::isfinite(*y))
        return in_line(record, "expects a place `x` and `y` in metres, or neither");
      step.place = Vector3{*x, *y, 0};
    }
    walk.push_back(std::move(step));
  }
  if (walk.empty()) return Error{ErrorCode::missing, "", "the table has no rows"};
  std::stable_sort(walk.begin(), walk.end(), [](const WalkStep& a, const WalkStep& b) { return a.seconds < b.seconds; });
  return walk;
}

void Crowd::follow(const std::string& id, const reading::PeopleFigures& wanted, const Scene& scene) {
  sensor = id;
  address = wanted.address;
  wanted_ = wanted;
  there_.clear();
  const std::string prefix = id + "#";
  for (auto node = scene.nodes.lower_bound(prefix); node != scene.nodes.end() && node->first.starts_with(prefix); ++node) {
    const auto base = node->second.types.find(std::string(kBaseNode));
    Vector3 place;
    if (base != node->second.types.end())
      if (const auto position = base->second.find("position"); position != base->second.end())
        place = std::get<Vector3>(position->second);
    there_[node->first] = place;
  }
}

void Crowd::set_walk(Result<std::vector<WalkStep>> walk) {
  line = walk ? std::string() : "the table cannot be played: " + walk.error().text();
  walk_ = walk ? std::move(*walk) : std::vector<WalkStep>();
}

// The first row belongs to tick 1, the others to the tick nearest to their time.
std::size_t Crowd::played(std::int64_t tick) const {
  const auto later = std::partition_point(walk_.begin(), walk_.end(), [&](const WalkStep& step) {
    return 1 + std::floor((step.seconds - walk_.front().seconds) / wanted_.tick_length + 0.5) <= static_cast<double>(tick);
  });
  return static_cast<std::size_t>(later - walk_.begin());
}

// Of too many people, those who came first.
std::map<std::string, Vector3> Crowd::people_at(std::int64_t tick) const {
  std::map<std::string, std::pair<std::size_t, Vector3>> all;  // by person: the row with which they came
  for (std::size_t r = 0; r < played(tick); ++r) {
    const WalkStep& step = walk_[r];
    if (!step.place) all.erase(step.person);
    else all.try_emplace(step.person, r, Vector3{}).first->second.second = {step.place->x, step.place->y, wanted_.height};
  }
  std::vector<std::pair<std::size_t, std::string>> order;
  for (const auto& [person, one] : all) order.emplace_back(one.first, person);
  std::sort(order.begin(), order.end());
  if (order.size() > static_cast<std::size_t>(std::max<std::int64_t>(0, wanted_.most)))
    order.resize(static_cast<std::size_t>(std::max<std::int64_t>(0, wanted_.most)));
  std::map<std::string, Vector3> places;
  for (const auto& [row, person] : order) places[sensor + "#" + person] = all.at(person).second;
  return places;
}

std::optional<Command> Crowd::step(std::int64_t tick) const {
  std::vector<Command> commands;
  const auto people = people_at(tick + 1);
  for (const auto& [node, place] : there_)
    if (!people.contains(node)) commands.push_back(command<RemoveNode>({node}));
  for (const auto& [node, place] : people) {
    const auto known = there_.find(node);
    if (known == there_.end()) {
      Json record = {{"name", "Person " + node.substr(sensor.size() + 1)}, {"position", place_of(place)}, {"tags", {"person"}}};
      record["types"] = {{"smart_volume", {{"use", wanted_.use}, {"demand", wanted_.demand}}}};
      commands.push_back(command<AddNode>({node, JsonValue::of(record)}));
    } else if (!(known->second == place)) {
      commands.push_back(command<SetPort>({node, {"node.position"}, JsonValue::of(place_of(place))}));
    }
  }
  if (wanted_.present != static_cast<std::int64_t>(people.size()))
    commands.push_back(command<SetPort>({sensor, {"people_sensor.present"}, JsonValue::of(people.size())}));
  if (wanted_.connection != line)
    commands.push_back(command<SetPort>({sensor, {"people_sensor.connection"}, JsonValue::of(line)}));
  if (commands.empty()) return std::nullopt;
  return commands.size() == 1 ? commands.front() : command<Batch>({std::move(commands)});
}

}  // namespace bl::live
