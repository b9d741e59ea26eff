// States put away: what a state consists of beyond its settings, without what can be made again.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/graph/state.h"

namespace bl {

/// Texts that come up again and again, such as ids, each kept once.
class TextPool {
 public:
  std::uint32_t number_of(const std::string& text);
  const std::string& text(std::uint32_t number) const { return *texts_[number]; }

 private:
  std::map<std::string, std::uint32_t> numbers_;
  std::vector<const std::string*> texts_;
};

/// Values in little room: numbers and points as bits, texts of tables by their number in a pool, all else as it is.
class PackedValues {
 public:
  void add(const Value& value, TextPool& pool);
  std::vector<Value> values(const TextPool& pool) const;
  void shrink();
  std::size_t bytes() const;

 private:
  enum class Kind : std::uint8_t { number, point, text, table, other };
  void add_table(const Table& table, TextPool& pool);

  std::vector<Kind> kinds_;              // cells of tables follow their table
  std::vector<double> numbers_;          // three for a point
  std::vector<std::uint32_t> wholes_;    // texts by number, and of each table its head by number and its rows
  std::vector<Shared<Table>> headings_;  // the columns of the tables, without rows; each once
  std::vector<Scalar> lists_;            // cells that are lists
  std::vector<Value> others_;
};

/// What goes into a file of a state, in a form that is quick to make and small: meshes and made objects are not in it. Packed
/// states that follow one another share what has not changed.
class PackedState {
 public:
  /// `before`: an earlier state and what was packed of it; both nullptr where there is none.
  PackedState(const State& state, const State* before, const PackedState* packed_before);

  std::int64_t tick() const { return tick_; }
  const std::shared_ptr<const Plan>& plan() const { return plan_; }
  /// As save() gives it, but for the analyses.
  SavedState saved() const;
  /// Also those that were running: their results are the same whenever they are asked for.
  const std::vector<AnalysisState>& analyses() const { return analyses_; }
  /// About how much memory it takes that none before it takes.
  std::size_t bytes() const { return bytes_; }

 private:
  struct Failure {
    std::uint32_t item = 0, type = 0;
    Error error;
  };
  // Of the nodes or links of one leaf.
  struct Leaf {
    std::shared_ptr<const std::vector<PortRef>> ports;  // mostly those of the leaf that was packed before
    std::vector<std::uint32_t> links;                   // whose voices they are
    PackedValues values;
    std::vector<Failure> failures;
    std::size_t bytes() const;
  };
  using Leaves = std::vector<std::shared_ptr<const Leaf>>;

  Leaf packed_nodes(const State& state, std::size_t leaf, std::vector<PortRef>& ports);
  Leaf packed_links(const State& state, std::size_t leaf, std::vector<PortRef>& ports);
  void keep(Leaves& leaves, Leaf&& leaf, std::vector<PortRef>&& ports, const Leaves* before);

  std::int64_t tick_ = 0, calm_ = 0;
  std::shared_ptr<const Plan> plan_;
  std::shared_ptr<TextPool> pool_;  // of all states that were packed one after the other
  Leaves nodes_, links_;
  std::vector<std::pair<PortRef, MeshPointer>> meshes_;  // that cannot be made again
  std::vector<AnalysisState> analyses_;
  std::size_t bytes_ = 0;
};

}  // namespace bl
