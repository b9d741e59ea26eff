// Records the author of each place of a scene, so that an undo reverses only its author's own changes.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/graph/touch.h"
#include "core/session/author.h"

namespace bl {

/// The gesture that last changed a place; none (0) where the place is unchanged since the scene was opened.
struct Writer {
  std::int64_t gesture = 0;
  Author author;
  bool operator==(const Writer&) const = default;
};

/// Is the place a value, in contrast to a node, role, row, lock, link or script, which are added and removed?
bool is_set_value(const Touch& place);

/// A place with its mark.
struct Mark {
  Touch place;
  Writer writer;
};

/// The places that a gesture has written, with their marks before. No mark: the place belonged to the writer of the place around
/// it.
struct Written {
  Writer writer;
  std::map<Touch, std::optional<Writer>> before;
  std::map<Touch, Writer> restored;  ///< the owners of the places that an undo or redo restored
};

/// Marks places; a place without a mark belongs to the writer of the place around it. An undo restores the marks with the values:
/// a value of Ben is Ben's again once Anna has undone her change of it.
class Writers {
 public:
  /// The mark of the place: its own, or that of the nearest place around it.
  Mark of(const Touch& place) const;
  /// Marks these places, and all that lies inside them, as written by the gesture; `written` keeps the earlier marks.
  void write(const std::vector<Touch>& places, Written& written);
  /// The same for an undo or redo of `other`, which restores the places.
  void write_back(const std::vector<Touch>& places, const Written& other, Written& written);

  /// The place, or one inside it, that another author has written since `other`.
  std::optional<Mark> since(const Touch& place, const Written& other) const;

 private:
  using Marks = std::map<Touch, Writer>;
  void clear_inside(const Touch& place, Written& written);
  void put(const Touch& place, const std::optional<Writer>& mark, Written& written);

  Marks marks_;
};

}  // namespace bl
