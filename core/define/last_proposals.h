// What a link itself said in the tick before: for rules that rest on their own word, and not on that of others.
#pragma once

#include <functional>
#include <optional>
#include <string_view>

#include "core/define/definition.h"

namespace bl {

/// A port where the least proposal counts holds the word of one link, and others read it there. A rule that keeps its limit where
/// it is must not keep that of another one: it would hold it after the other has let go. What a link said is part of the state
/// that it is evaluated in, and is saved with it.
struct LastProposals {
  /// By the path of a port of an end that is written whole, and the place of the node; nothing where it said nothing. Without a
  /// function nobody knows what was said.
  std::function<std::optional<double>(std::string_view path, std::size_t place)> said;
  bool was_asked = false;  ///< the link has to be asked again in the tick after it has said something else
};

/// Does anybody know what the link said last?
inline bool has_last_word(const Tick& tick) {
  return tick.memo != nullptr && static_cast<bool>(tick.memo->of<LastProposals>().said);
}

/// What the link said there last, all of its pairs together. Where nobody knows, what is in force counts as its own word.
inline std::optional<double> own_word(const Tick& tick, std::string_view path, std::size_t place, double in_force) {
  if (tick.memo == nullptr) return in_force;
  LastProposals& last = tick.memo->of<LastProposals>();
  if (!last.said) return in_force;
  last.was_asked = true;
  return last.said(path, place);
}

}  // namespace bl
