// The history of a session: each step of its holder, with its name, and whether it is undone.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/define/registry.h"
#include "core/graph/scene.h"
#include "core/session/log.h"

namespace bl::host {

/// All commands of one gesture.
struct HistoryStep {
  std::int64_t gesture = 0, tick = 0;
  std::string label;        ///< what was done, such as "Set port · Library"
  bool is_undone = false;   ///< undone, and not redone since
  std::size_t entries = 0;  ///< commands in it
  Author author = {};
};

/// Whose steps a history holds.
enum class HistoryOf : std::uint8_t { holder, everybody };

/// Follows the log entry by entry. Entries of devices are no steps, and neither is a rewind.
class History {
 public:
  History(const Registry& registry, Author author, HistoryOf whose = HistoryOf::holder)
      : registry_(&registry), author_(std::move(author)), whose_(whose) {}

  /// `scene`: the scene after the entry, for names.
  void take(const LogEntry& entry, const Scene& scene);
  /// The holder, where it becomes known later.
  void set_author(Author author) { author_ = std::move(author); }
  const Author& author() const { return author_; }
  /// Oldest first.
  const std::vector<HistoryStep>& steps() const { return steps_; }
  /// The gesture of the holder's last step, which can still be extended; 0 where there is none, or where something was undone or
  /// redone since.
  std::int64_t last_step() const { return last_step_; }

 private:
  void take_back(const LogEntry& entry);

  const Registry* registry_;
  Author author_;
  HistoryOf whose_;
  std::vector<HistoryStep> steps_;
  std::int64_t last_step_ = 0;
};

}  // namespace bl::host
