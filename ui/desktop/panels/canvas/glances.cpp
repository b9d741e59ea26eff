// Bars follow the figures, which large scenes make anew only now and then; errors follow the state.
#include "ui/desktop/panels/canvas/glances.h"

#include <algorithm>
#include <utility>

#include "core/reading/changed_nodes.h"
#include "ui/desktop/panels/canvas/bars.h"
#include "ui/desktop/panels/canvas/draw.h"
#include "ui/desktop/panels/canvas/tension.h"
#include "ui/desktop/panels/panel_memory.h"
#include "ui/desktop/panels/statistics_record.h"

namespace bl::desktop::canvas {

void Glances::read_all(Board& board) {
  const State& state = board.editor.state();
  const std::vector<NodeBox>& boxes = board.model.boxes;
  rows_.assign(boxes.size(), {});
  bars_.clear();
  box_of_node_.assign(state.nodes.size(), kNoIndex);
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    const NodeBox& box = boxes[k];
    rows_[k].tone = tone_of(board, box);
    rows_[k].has_bar = std::any_of(box.sections.begin(), box.sections.end(), [](const Section& s) { return s.has_bar; });
    if (rows_[k].has_bar) bars_.push_back(k);
    if (box.in_state == kNoIndex) continue;
    box_of_node_[box.in_state] = static_cast<std::uint32_t>(k);
    rows_[k].has_error = has_error(state, box.in_state);
  }
  read_bars(board);
}

void Glances::read_bar(Board& board, std::size_t box) {
  const BarFigures bar = bar_figures(board.editor, board.model.boxes[box]);
  rows_[box].bar_tone = bar.tone;
  rows_[box].bar_share = bar.share(bar.account.volume);
  if (!bar.is_known) unknown_bars_.push_back(box);
}

void Glances::read_bars(Board& board) {
  unknown_bars_.clear();
  for (const std::size_t box : bars_) read_bar(board, box);
}

// After the figures of the last revision come those of this one.
void Glances::follow_bars(Board& board) {
  for (const std::size_t box : std::exchange(unknown_bars_, {})) read_bar(board, box);
  for (const std::uint32_t node : *memory_of(board.editor).record->changed_figures())
    if (const std::uint32_t box = box_of_node_[node]; box != kNoIndex && rows_[box].has_bar) read_bar(board, box);
}

void Glances::update(Board& board) {
  const std::shared_ptr<const State>& state = board.editor.moment->state;
  RunRecord& record = *memory_of(board.editor).record;
  const bool is_same_model = state_ && revision_ == board.model.revision;
  const auto changed = is_same_model ? reading::changed_nodes(*state_, *state) : std::nullopt;
  if (!changed) {
    read_all(board);
  } else {
    for (const std::uint32_t node : *changed)
      if (const std::uint32_t box = box_of_node_[node]; box != kNoIndex) rows_[box].has_error = has_error(*state, node);
    // Nobody pays for figures that no bar shows.
    if (!bars_.empty()) (void)record.figures(board.editor);
    const std::uint64_t figures = record.figures_revision();
    if (figures == figures_ + 1 && record.changed_figures()) follow_bars(board);
    else if (figures != figures_) read_bars(board);
  }
  state_ = state;
  revision_ = board.model.revision;
  figures_ = record.figures_revision();
}

}  // namespace bl::desktop::canvas
