// What has happened lately: values over the last seconds for spark-lines, and when each link last moved something.
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "ui/desktop/panels/canvas/model.h"

namespace bl::desktop::canvas {

/// Seconds that a spark-line shows.
inline constexpr double kSparkSeconds = 10;

/// Time [s] and value; the oldest first.
using Spark = std::vector<std::pair<double, double>>;

struct LinkPulse {
  double magnitude = 0;  ///< of its loudest voice, or what it asks for
  double pulse_at = -1;  ///< when it last changed something [s]
  std::string text;      ///< the last change, with its unit
};

class Live {
 public:
  /// Takes note of a new state; nothing to do where there is none.
  void update(const Workbench& editor, const Model& model);
  /// Empty where there is none.
  Spark spark(const std::string& node, std::size_t section) const;
  const LinkPulse* pulse(const std::string& link) const;

 private:
  void sample(const Workbench& editor, const Model& model);
  void sample(const Workbench& editor, const NodeBox& box);
  void listen(const Workbench& editor, const Model& model);

  std::deque<double> times_;  ///< of all samples of the last seconds; the oldest first
  /// By node and section, the samples that differ from the one before: most values stand still most of the time.
  std::map<std::pair<std::string, std::size_t>, Spark> steps_;
  std::shared_ptr<const State> sampled_;  ///< what was sampled last, of this revision of the model
  std::size_t revision_ = 0;
  std::map<std::string, LinkPulse> pulses_;
  std::uint64_t document_ = 0;  ///< whose samples these are
  std::size_t seen_ = 0;
  double sampled_at_ = -1;
  std::int64_t tick_ = -1;
};

}  // namespace bl::desktop::canvas
