// Everything that is in the way of a scene, in an order that stays calm while it ticks.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "core/reading/problems_memo.h"
#include "ui/desktop/panels/workbench.h"

namespace bl::desktop {

/// In the order of the list.
enum class ProblemKind { conflict, rule, shortage, failing, no_room, place, idle, file };
inline constexpr std::size_t kProblemKinds = 8;

struct ProblemItem {
  ProblemKind kind = ProblemKind::file;
  std::string key;  ///< the same from tick to tick
  int band = 0;     ///< how bad, in steps: the worse come first within their kind
  bool is_error = false;
  std::string subject, text;  ///< what it is about, and the sentence; of conflicts made when they are seen
  reading::TensePort tense;   ///< of conflicts
  std::string why;            ///< of shortages of a use ("use/...") or a volume ("volume/..."): filled when it is seen
  std::vector<std::string> nodes, links;  ///< where a press goes
  bool operator==(const ProblemItem&) const = default;
};

class ProblemList {
 public:
  /// Reads of another state what differs from the last one.
  void refresh(const Workbench& editor, const reading::ReportModel& figures);
  const std::vector<ProblemItem>& items() const { return items_; }
  std::size_t count(ProblemKind kind) const { return counts_[static_cast<std::size_t>(kind)]; }
  /// How many want to be looked at: all but what people have switched off themselves.
  std::size_t pressing() const;
  /// Drops what was read of the last state, so that the next one is read as a whole. The list stays the same by that.
  void forget() { problems_ = {}; }

  int filter = -1;  ///< kind that is shown; -1: all

 private:
  void add_conflicts(const State& state);
  void add_shortages(const State& state, const reading::ReportModel& figures);
  void add_failures(const State& state);
  void add_volumes(const State& state, const reading::ReportModel& figures);
  void add_places();
  void add_idle(const State& state);
  void add_file(const Workbench& editor);

  std::vector<ProblemItem> items_;
  std::array<std::size_t, kProblemKinds> counts_{};
  std::shared_ptr<const State> state_;
  const Plan* plan_ = nullptr;
  std::uint64_t revision_ = static_cast<std::uint64_t>(-1);  ///< of the file's problems
  std::map<PortRef, int> bands_;
  reading::ProblemsMemo problems_;
};

/// Subject and sentence of an item that is seen.
void write_problem(const State& state, const reading::Accounts& accounts, ProblemItem& item);
/// What stands where the list is empty: whoever is short is listed, so that everybody has room there.
std::string all_is_well(bool has_run);
/// "Conflicts", "Shortages", ...
const char* label_of(ProblemKind kind);

}  // namespace bl::desktop
