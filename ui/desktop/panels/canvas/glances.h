// What boxes show of themselves from far away, and their colours: of a new state only the nodes that have changed are read.
#pragma once

#include <memory>
#include <vector>

#include "ui/desktop/panels/canvas/model.h"
#include "ui/desktop/view/colouring.h"

namespace bl::desktop::canvas {

struct Board;

struct Glance {
  ImU32 tone = 0;  ///< of the box as a whole
  bool has_error = false, has_bar = false;
  AccountTone bar_tone = AccountTone::far;
  float bar_share = 0;  ///< what there is, of the bar's whole length
  bool operator==(const Glance&) const = default;
};

class Glances {
 public:
  /// Follows model, state and figures.
  void update(Board& board);
  const Glance& of(std::size_t box) const { return rows_[box]; }
  const std::vector<Glance>& rows() const { return rows_; }

 private:
  void read_all(Board& board);
  void read_bar(Board& board, std::size_t box);
  void read_bars(Board& board);
  void follow_bars(Board& board);

  std::vector<Glance> rows_;                ///< as the model's boxes
  std::vector<std::uint32_t> box_of_node_;  ///< kNoIndex: the node has none
  std::vector<std::size_t> bars_;           ///< boxes that have one
  std::vector<std::size_t> unknown_bars_;   ///< of volumes that no tick has seen: what they ask for is in the scene
  std::shared_ptr<const State> state_;      ///< what they were read from, as the next two
  std::size_t revision_ = 0;                ///< of the model
  std::uint64_t figures_ = 0;               ///< revision of the record's figures
};

}  // namespace bl::desktop::canvas
