// Marks in ascending order of their places, so that what lies inside a place follows it.
#include "core/session/writers.h"

#include <algorithm>

namespace bl {

namespace {

// The first place that can lie inside.
Touch first_inside(const Touch& place) {
  Touch first = place;
  first.path += place.path.empty() ? "" : "/";
  return first;
}

}  // namespace

bool is_set_value(const Touch& place) {
  if (place.part == ScenePart::setting) return true;
  if (place.part == ScenePart::script || place.path.empty()) return false;
  if (!place.path.starts_with("types/")) return !place.path.starts_with("locked/");
  const auto steps = std::count(place.path.begin(), place.path.end(), '/');
  return steps == 2 || steps == 4;  // types/programme/rows, types/programme/rows/housing/count
}

Mark Writers::of(const Touch& place) const {
  Touch at = place;
  do {
    if (const auto mark = marks_.find(at); mark != marks_.end()) return {at, mark->second};
  } while (widen(at));
  return {place, {}};
}

void Writers::put(const Touch& place, const std::optional<Writer>& mark, Written& written) {
  const auto old = marks_.find(place);
  written.before.try_emplace(place, old == marks_.end() ? std::nullopt : std::optional(old->second));
  if (!mark) {
    if (old != marks_.end()) marks_.erase(old);
  } else {
    marks_[place] = *mark;
  }
}

void Writers::clear_inside(const Touch& place, Written& written) {
  for (auto mark = marks_.lower_bound(first_inside(place)); mark != marks_.end();) {
    if (mark->first == place) {
      ++mark;
      continue;
    }
    if (!lies_inside(mark->first, place)) break;
    written.before.try_emplace(mark->first, mark->second);
    mark = marks_.erase(mark);
  }
}

void Writers::write(const std::vector<Touch>& places, Written& written) {
  for (const Touch& place : places) {
    clear_inside(place, written);
    put(place, written.writer, written);
  }
}

void Writers::write_back(const std::vector<Touch>& places, const Written& other, Written& written) {
  for (const Touch& place : places) {
    clear_inside(place, written);
    const auto known = other.before.find(place);
    // An undo may have to write what its gesture did not: that is a step like any other.
    put(place, known == other.before.end() ? std::optional(written.writer) : known->second, written);
    written.restored[place] = of(place).writer;
    for (auto inner = other.before.lower_bound(first_inside(place)); inner != other.before.end(); ++inner) {
      if (inner->first == place) continue;
      if (!lies_inside(inner->first, place)) break;
      put(inner->first, inner->second, written);
      written.restored[inner->first] = of(inner->first).writer;
    }
  }
}

std::optional<Mark> Writers::since(const Touch& place, const Written& other) const {
  const auto is_own = [&](const Touch& at, const Writer& now) {
    if (const auto restored = other.restored.find(at); restored != other.restored.end()) return now == restored->second;
    return other.before.contains(at) ? now == other.writer : now.author == other.writer.author;
  };
  if (Mark now = of(place); !is_own(place, now.writer)) return now;
  for (auto mark = marks_.lower_bound(first_inside(place)); mark != marks_.end(); ++mark) {
    if (mark->first == place) continue;
    if (!lies_inside(mark->first, place)) break;
    if (!is_own(mark->first, mark->second)) return Mark{mark->first, mark->second};
  }
  return std::nullopt;
}

}  // namespace bl
