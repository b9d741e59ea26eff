// What has happened lately: values over the last seconds for spark-lines, and when each link last moved something.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "ui/desktop/panels/canvas/model.h"

namespace bl::desktop::canvas {

/// Seconds that a spark-line shows.
inline constexpr double kSparkSeconds = 10;

struct Spark {
  std::vector<std::pair<double, double>> samples;  ///< time [s], value; oldest first
};

struct LinkPulse {
  double magnitude = 0;  ///< of its loudest voice, or what it asks for
  double pulse_at = -1;  ///< when it last changed something [s]
  std::string text;      ///< the last change, with its unit
};

class Live {
 public:
  /// Takes note of a new state; nothing to do where there is none.
  void update(const Workbench& editor, const Model& model);
  const Spark* spark(const std::string& node, std::size_t section) const;
  const LinkPulse* pulse(const std::string& link) const;

 private:
  void sample(const Workbench& editor, const Model& model);
  void listen(const Workbench& editor, const Model& model);

  std::map<std::pair<std::string, std::size_t>, Spark> sparks_;
  std::map<std::string, LinkPulse> pulses_;
  std::uint64_t document_ = 0;  ///< whose samples these are
  std::size_t seen_ = 0;
  double sampled_at_ = -1;
  std::int64_t tick_ = -1;
};

}  // namespace bl::desktop::canvas
