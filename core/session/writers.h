// Who wrote what stands in a scene now, so that an undo takes back only what is its author's own.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/graph/touch.h"
#include "core/session/author.h"

namespace bl {

/// The gesture that made a place what it is; none (0) where it stands as it was opened.
struct Writer {
  std::int64_t gesture = 0;
  Author author;
  bool operator==(const Writer&) const = default;
};

/// Is the place something that is set, in contrast to a node, role, row, lock, link or script that comes and goes?
bool is_set_value(const Touch& place);

/// A place, and whose it is.
struct Mark {
  Touch place;
  Writer writer;
};

/// What a gesture has written: the places with the marks that they bore before. No mark: the place was its outer place's
/// writer's.
struct Written {
  Writer writer;
  std::map<Touch, std::optional<Writer>> before;
  std::map<Touch, Writer> restored;  ///< whose the places are that an undo or redo brought back
};

/// Marks places; a place without a mark is its outer place's writer's. An undo brings the marks back with the values: what Ben
/// wrote is Ben's again once Anna has taken back what she wrote over it.
class Writers {
 public:
  /// The mark that says whose the place is: its own, or that of the nearest place around it.
  Mark of(const Touch& place) const;
  /// The gesture writes these places, and all that lies inside them; `written` keeps what was there before it.
  void write(const std::vector<Touch>& places, Written& written);
  /// The same by an undo or redo of `other`, which makes the places what they were before that.
  void write_back(const std::vector<Touch>& places, const Written& other, Written& written);

  /// The place, or one inside it, that somebody else has written since `other` did.
  std::optional<Mark> since(const Touch& place, const Written& other) const;

 private:
  using Marks = std::map<Touch, Writer>;
  void clear_inside(const Touch& place, Written& written);
  void put(const Touch& place, const std::optional<Writer>& mark, Written& written);

  Marks marks_;
};

}  // namespace bl
