// Rows of a room's journal at random, and what a file must hold after some of them.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/graph/scene.h"
#include "core/room/record.h"

namespace bl {

/// Records as a room might hand them over, one after the other: numbers of entries ascend, ticks too but for rewinds, and keys
/// come again and again.
class RandomRecords {
 public:
  /// `scene`: what commands are about. `last_seq`: the number of the last entry before the first record.
  RandomRecords(const Scene& scene, std::uint64_t seed, std::int64_t last_seq = 0);
  /// Never without any row.
  room::Record next();
  /// The next record with so many entries, and no more than that but for a run.
  room::Record next_of(std::size_t entries);
  /// The last record was not stored: its numbers are given again.
  void take_back();

 private:
  Command command();
  room::EntryRecord entry();
  room::Record filled();

  const Scene* scene_;
  Random random_;
  std::int64_t seq_, tick_ = 0;
  std::int64_t seq_before_, first_seq_, tick_before_ = 0;
  int number_ = 0;
};

/// A text of a few letters, some of which are not in every alphabet.
std::string random_words(Random& random);

/// Everything that a file must hold after some records: all entries, and of the other rows the last of each key.
class StoredRows {
 public:
  void add(const room::Record& record);
  /// All rows as text, to compare by.
  std::string text() const;

 private:
  std::map<std::int64_t, std::string> entries_;
  std::map<std::string, std::string> rows_;                              ///< by the name of the table and the key
  std::map<std::string, std::map<std::int64_t, std::string>> refusals_;  ///< by run; the last 256 stay
};

/// "" where both are equal; otherwise the first line of each that differs.
std::string first_difference(const std::string& found, const std::string& expected);

}  // namespace bl
