// What the pairs of one link propose to one port, on its way to one voice.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/graph/state.h"

namespace bl {

/// Proposals of all pairs of one link on one target, taken together in the order of the pairs. A link speaks with one voice: the
/// mean of the pairs that move anything, so that a node pulled by sixty partners is moved no farther than by one, and
/// links to sets settle whatever the size of the set. A pair counts as far as it moves anything: if it counted whole from its
/// first millimetre on, the voice of the others would jump to half whenever a second pair comes in, and nodes would saw for ever.
struct Collected {
  int count = 0, moving = 0;
  double number = 0;
  Vector3 vector;
  double magnitude = 0, squares = 0;
  std::vector<std::string> texts;

  void add(const Value& value, CombineRule rule) {
    ++count;
    if (const auto* list = std::get_if<Shared<std::vector<std::string>>>(&value)) {
      texts.insert(texts.end(), (*list)->begin(), (*list)->end());
      return;
    }
    if (const auto* v = std::get_if<Vector3>(&value)) {
      vector += *v;
      magnitude += norm(*v);
      squares += squared_norm(*v);
      if (*v != Vector3{}) ++moving;
      return;
    }
    const double x = as_number(value);
    magnitude += std::abs(x);
    squares += x * x;
    if (x != 0) ++moving;
    if (rule == CombineRule::min) number = count == 1 ? x : std::min(number, x);
    else if (rule == CombineRule::max) number = count == 1 ? x : std::max(number, x);
    else number += x;
  }

  Voice voice(PortRef target, const PortDefinition& port, double strength) const {
    if (port.rule == CombineRule::collect) {
      std::vector<std::string> all = texts;
      // Mostly they come in order, because pairs do.
      if (std::adjacent_find(all.begin(), all.end(), std::greater_equal<>()) != all.end()) {
        std::sort(all.begin(), all.end());
        all.erase(std::unique(all.begin(), all.end()), all.end());
      }
      return {target, Shared(std::move(all)), 0, strength};
    }
    const double share = port.rule == CombineRule::blend ? 1.0 / count : port.rule == CombineRule::sum ? share_of_sum() : 1.0;
    if (port.kind == ValueKind::point) return {target, vector * share, magnitude * share, strength};
    return {target, number * share, magnitude * share, strength};
  }

  // One over the number of pairs that move anything, each counted by how much it moves: (sum m)² / sum m² of n equal ones is n,
  // and one that hardly moves hardly counts. The sum times this share is never more than the largest move.
  double share_of_sum() const {
    if (moving <= 1) return 1;
    const double share = squares / (magnitude * magnitude);
    return share > 0 && share <= 1 ? share : 1.0 / moving;  // squares of extreme numbers overflow
  }
};

}  // namespace bl
