// What is left of the model in an entered frame: what lies in it, and a door for each thing outside that a link leads to.
#include <algorithm>
#include <map>

#include "ui/desktop/panels/canvas/model.h"

namespace bl::desktop::canvas {

namespace {

constexpr float kDoorWidth = 140, kDoorHeight = 24, kDoorStep = 36, kDoorAway = 96;

}  // namespace

void Model::narrow() {
  doors.clear();
  outside_boxes.clear();
  outside_lines.clear();
  if (entered.empty()) return;
  // The new number of each anchor that stays; those of boxes come first, then pills, then doors.
  std::vector<std::size_t> place(anchors(), kNoIndex);
  std::size_t count = 0;
  for (std::size_t k = 0; k < boxes.size(); ++k)
    if (view.holds_node(entered, boxes[k].id)) place[k] = count++;
  for (std::size_t k = 0; k < pills.size(); ++k) {
    // A set that is named one by one lies where its members lie; a set by a rule may grow beyond any frame.
    const auto& members = pills[k].members;
    const bool is_in = !pills[k].selection.is_query() && !members.empty() &&
                       std::all_of(members.begin(), members.end(), [&](std::size_t m) { return place[m] != kNoIndex; });
    if (is_in) place[boxes.size() + k] = count++;
  }
  std::map<std::size_t, std::size_t> door_of;
  std::vector<ImVec2> origins;
  const auto enter = [&](std::size_t& end, Line& line) {
    if (place[end] != kNoIndex) return void(end = place[end]);
    const auto [known, is_new] = door_of.emplace(end, count + doors.size());
    if (is_new) {
      origins.push_back(anchor(end).centre());
      const bool is_set = end >= boxes.size();
      const std::string label = is_set ? pills[end - boxes.size()].label : boxes[end].name;
      doors.push_back({is_set ? pills[end - boxes.size()].key : boxes[end].id, label, selection_of(end), is_set, false, {}});
    }
    end = known->second;
    line.is_crossing = true;
    line.dots.clear();  // they lie on the way outside
  };
  std::vector<Line> shown_lines;
  for (Line& line : lines) {
    if (place[line.from] == kNoIndex && place[line.to] == kNoIndex) {
      outside_lines.push_back(std::move(line));
      continue;
    }
    enter(line.from, line);
    enter(line.to, line);
    shown_lines.push_back(std::move(line));
  }
  lines = std::move(shown_lines);
  std::vector<NodeBox> shown_boxes;
  std::vector<Pill> shown_pills;
  for (std::size_t k = 0; k < pills.size(); ++k) {
    if (place[boxes.size() + k] == kNoIndex) continue;
    for (std::size_t& member : pills[k].members) member = place[member];
    shown_pills.push_back(std::move(pills[k]));
  }
  for (std::size_t k = 0; k < boxes.size(); ++k)
    (place[k] == kNoIndex ? outside_boxes : shown_boxes).push_back(std::move(boxes[k]));
  boxes = std::move(shown_boxes);
  pills = std::move(shown_pills);
  place_doors(origins);
}

// In two columns beside the frame's content: on the side where the thing outside lies, at the height of what it is linked to.
void Model::place_doors(const std::vector<ImVec2>& origins) {
  std::vector<Door> waiting;
  std::swap(waiting, doors);
  const Box content = bounds();
  const std::size_t first = boxes.size() + pills.size();
  std::vector<float> wanted(waiting.size(), 0), ends(waiting.size(), 0);
  for (const Line& line : lines)
    for (const auto& [outer, inner] : {std::pair(line.from, line.to), std::pair(line.to, line.from)})
      if (outer >= first) wanted[outer - first] += anchor(inner).centre().y, ends[outer - first] += 1;
  for (std::size_t k = 0; k < waiting.size(); ++k) {
    wanted[k] /= std::max(1.0f, ends[k]);
    waiting[k].is_left = origins[k].x < content.centre().x;
  }
  for (const bool is_left : {true, false}) {
    std::vector<std::size_t> column;
    for (std::size_t k = 0; k < waiting.size(); ++k)
      if (waiting[k].is_left == is_left) column.push_back(k);
    std::stable_sort(column.begin(), column.end(), [&](std::size_t a, std::size_t b) { return wanted[a] < wanted[b]; });
    const float x = is_left ? content.low().x - kDoorAway - kDoorWidth : content.high().x + kDoorAway;
    float y = -1e30f, drift = 0;
    for (const std::size_t k : column) {
      y = std::max(wanted[k] - kDoorHeight / 2, y + kDoorStep);
      waiting[k].box = {{x, y}, {kDoorWidth, kDoorHeight}};
      drift += y - (wanted[k] - kDoorHeight / 2);
    }
    // Crowded doors spread to both sides of where they want to be.
    for (const std::size_t k : column) waiting[k].box.at.y -= drift / static_cast<float>(column.size());
  }
  doors = std::move(waiting);
}

}  // namespace bl::desktop::canvas
