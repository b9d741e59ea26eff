// Layers within each group of linked boxes, shelves for the groups, a grid for boxes on their own.
#include "ui/desktop/panels/canvas/auto_layout.h"

#include <algorithm>
#include <numeric>

namespace bl::desktop::canvas {

namespace {

using Links = std::vector<std::pair<std::size_t, std::size_t>>;

constexpr float kGapX = 102, kGapY = 30, kGridGapX = 22, kGridGapY = 20, kColumnGap = 132, kSnap = 10;
constexpr int kSweeps = 6;
constexpr float kMostCentred = 1600;
// About as wide as high: beside the field stand the sources, and beside the canvas the 3D view.
constexpr float kAspect = 0.9f;

float snapped(float v) { return std::round(v / kSnap) * kSnap; }

// Groups of field items that are joined by links, each ascending, ordered by their first item.
std::vector<std::vector<std::size_t>> groups_of(const std::vector<LayoutItem>& items, const Links& links) {
  std::vector<std::size_t> root(items.size());
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto find = [&](std::size_t k) {
    while (root[k] != k) k = root[k] = root[root[k]];
    return k;
  };
  for (const auto& [a, b] : links) {
    if (items[a].column >= 0 || items[b].column >= 0) continue;
    const std::size_t ra = find(a), rb = find(b);
    root[std::max(ra, rb)] = std::min(ra, rb);
  }
  std::vector<std::vector<std::size_t>> groups(items.size());
  for (std::size_t k = 0; k < items.size(); ++k)
    if (items[k].column < 0) groups[find(k)].push_back(k);
  std::erase_if(groups, [](const auto& group) { return group.empty(); });
  return groups;
}

// One group, laid out by itself: its places from (0, 0), and how much room it takes.
struct Block {
  std::vector<std::size_t> items;
  std::vector<ImVec2> places;
  ImVec2 size;
};

// The layer of each item of a group: one beyond the deepest item that leads to it. Links that lead back count the other way.
std::vector<int> layers_of(const std::vector<std::size_t>& group, const Links& links, std::size_t count) {
  std::vector<int> layer(count, -1);
  std::vector<std::vector<std::size_t>> next(count), before(count);
  std::vector<char> is_in(count, 0);
  for (const std::size_t k : group) is_in[k] = 1;
  for (const auto& [a, b] : links)
    if (is_in[a] != 0 && is_in[b] != 0 && a != b) next[a].push_back(b), before[b].push_back(a);
  // In breadth from the items that nothing leads to; what only rings lead to starts from the first of the ring.
  std::vector<std::size_t> queue;
  for (const std::size_t k : group)
    if (before[k].empty()) layer[k] = 0, queue.push_back(k);
  std::size_t at = 0;
  for (const std::size_t seed : group) {
    if (at == queue.size() && layer[seed] < 0) layer[seed] = 0, queue.push_back(seed);
    for (; at < queue.size(); ++at) {
      const std::size_t k = queue[at];
      for (const std::size_t n : next[k])
        if (layer[n] < 0) layer[n] = layer[k] + 1, queue.push_back(n);
      for (const std::size_t n : before[k])
        if (layer[n] < 0) layer[n] = std::max(0, layer[k] - 1), queue.push_back(n);
    }
  }
  return layer;
}

// Sorts each layer by the mean place of its neighbours, to and fro, so that few links cross.
void untangle(std::vector<std::vector<std::size_t>>& columns, const Links& links, std::size_t count) {
  std::vector<std::vector<std::size_t>> near(count);
  for (const auto& [a, b] : links) near[a].push_back(b), near[b].push_back(a);
  std::vector<float> place(count, 0);
  const auto number = [&](const std::vector<std::size_t>& column) {
    for (std::size_t k = 0; k < column.size(); ++k)
      place[column[k]] = (static_cast<float>(k) + 0.5f) / static_cast<float>(column.size());
  };
  for (const auto& column : columns) number(column);
  for (int sweep = 0; sweep < kSweeps; ++sweep)
    for (std::size_t c = 0; c < columns.size(); ++c) {
      auto& column = columns[sweep % 2 == 0 ? c : columns.size() - 1 - c];
      std::vector<std::pair<float, std::size_t>> keyed;
      for (const std::size_t k : column) {
        float sum = place[k], weight = 1;
        for (const std::size_t n : near[k]) sum += 2 * place[n], weight += 2;
        keyed.emplace_back(sum / weight, k);
      }
      std::stable_sort(keyed.begin(), keyed.end());
      for (std::size_t k = 0; k < column.size(); ++k) column[k] = keyed[k].second;
      number(column);
    }
}

Block layered(const std::vector<LayoutItem>& items, const std::vector<std::size_t>& group, const Links& links) {
  const std::vector<int> layer = layers_of(group, links, items.size());
  std::vector<std::vector<std::size_t>> columns;
  for (const std::size_t k : group) {
    const auto column = static_cast<std::size_t>(std::max(0, layer[k]));
    if (columns.size() <= column) columns.resize(column + 1);
    columns[column].push_back(k);
  }
  untangle(columns, links, items.size());
  Block block;
  std::vector<float> heights;
  for (const auto& column : columns) {
    float height = -kGapY;
    for (const std::size_t k : column) height += items[k].size.y + kGapY;
    heights.push_back(height);
    block.size.y = std::max(block.size.y, height);
  }
  float x = 0;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    float y = (block.size.y - heights[c]) / 2, width = 0;
    for (const std::size_t k : columns[c]) {
      block.items.push_back(k);
      block.places.push_back({snapped(x), snapped(y)});
      y += items[k].size.y + kGapY;
      width = std::max(width, items[k].size.x);
    }
    x += width + kGapX;
  }
  block.size.x = x - kGapX;
  return block;
}

// Boxes on their own, kin beside kin, in rows of equal width.
Block gridded(const std::vector<LayoutItem>& items, std::vector<std::size_t> group, float least_width) {
  std::stable_sort(group.begin(), group.end(), [&](std::size_t a, std::size_t b) { return items[a].kin < items[b].kin; });
  float area = 0;
  for (const std::size_t k : group) area += (items[k].size.x + kGridGapX) * (items[k].size.y + kGridGapY);
  const float width = std::max(least_width, std::sqrt(area * kAspect));
  Block block;
  float x = 0, y = 0, height = 0;
  for (const std::size_t k : group) {
    if (x > 0 && x + items[k].size.x > width) x = 0, y += height + kGridGapY, height = 0;
    block.items.push_back(k);
    block.places.push_back({snapped(x), snapped(y)});
    x += items[k].size.x + kGridGapX;
    height = std::max(height, items[k].size.y);
    block.size.x = std::max(block.size.x, x - kGridGapX);
  }
  block.size.y = y + height;
  return block;
}

// Columns of sources stand at the middle of the field's height, as far as it does not lead far away from its top.
void centre_columns(const std::vector<LayoutItem>& items, const std::vector<float>& heights, float field,
                    std::vector<ImVec2>& places) {
  float tallest = std::min(field, kMostCentred);
  for (const float height : heights) tallest = std::max(tallest, height);
  for (std::size_t k = 0; k < items.size(); ++k)
    if (items[k].column >= 0) places[k].y += snapped((tallest - heights[static_cast<std::size_t>(items[k].column)]) / 2);
}

}  // namespace

std::vector<ImVec2> lay_out(const std::vector<LayoutItem>& items, const Links& links) {
  std::vector<ImVec2> places(items.size());
  // Columns of sources, each from the top.
  int last_column = -1;
  for (const LayoutItem& item : items) last_column = std::max(last_column, item.column);
  float left = 0;
  std::vector<float> column_heights;
  for (int column = 0; column <= last_column; ++column) {
    float y = 0, width = 0;
    for (std::size_t k = 0; k < items.size(); ++k) {
      if (items[k].column != column) continue;
      places[k] = {left, snapped(y)};
      y += items[k].size.y + kGapY;
      width = std::max(width, items[k].size.x);
    }
    column_heights.push_back(y - kGapY);
    if (width > 0) left = snapped(left + width + kColumnGap);
  }
  // Groups on shelves, the tallest first; boxes on their own below them.
  std::vector<Block> blocks;
  std::vector<std::size_t> alone;
  float area = 0, widest = 0;
  for (const auto& group : groups_of(items, links)) {
    if (group.size() == 1) alone.push_back(group.front());
    else blocks.push_back(layered(items, group, links));
  }
  for (const Block& block : blocks)
    area += (block.size.x + kGapX) * (block.size.y + kGapY), widest = std::max(widest, block.size.x);
  for (const std::size_t k : alone) area += (items[k].size.x + kGridGapX) * (items[k].size.y + kGridGapY);
  std::stable_sort(blocks.begin(), blocks.end(), [](const Block& a, const Block& b) { return a.size.y > b.size.y; });
  const float shelf_width = std::max(widest, std::sqrt(area * kAspect));
  float x = 0, y = 0, height = 0, reached = 0;
  const auto put = [&](const Block& block) {
    for (std::size_t k = 0; k < block.items.size(); ++k)
      places[block.items[k]] = {snapped(left + x + block.places[k].x), snapped(y + block.places[k].y)};
  };
  for (const Block& block : blocks) {
    if (x > 0 && x + block.size.x > shelf_width) x = 0, y += height + 2 * kGapY, height = 0;
    put(block);
    x += block.size.x + kGapX;
    height = std::max(height, block.size.y);
    reached = std::max(reached, x - kGapX);
  }
  if (!blocks.empty()) y += height + 2 * kGapY;
  x = 0;
  if (!alone.empty()) {
    const Block rest = gridded(items, alone, std::max(reached, shelf_width));
    put(rest);
    y += rest.size.y;
  }
  centre_columns(items, column_heights, y, places);
  return places;
}

}  // namespace bl::desktop::canvas
