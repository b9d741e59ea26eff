// Links as lines of a drawing: each family of kinds has a colour and a dash of its own.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/graph/state.h"

namespace bl::drawing {

/// How a drawing shows one family.
struct FamilyInk {
  std::string_view label, colour, dashes;
};

/// Nothing for the family that joins no places.
const FamilyInk* ink_of(LinkFamily family);

/// A link as a line between two nodes.
struct DrawnLink {
  const FamilyInk* ink = nullptr;
  std::uint32_t from = 0, to = 0;
  std::string title;
};

struct DrawnLinks {
  std::vector<DrawnLink> lines;
  std::vector<const FamilyInk*> families;  ///< that occur, in the order of the legend
  std::vector<std::string> beside;         ///< kinds with how many of them: what joins other things than volumes
  std::vector<std::string> left_out;       ///< links over sets too large to be drawn
};
DrawnLinks links_to_draw(const State& state);

}  // namespace bl::drawing
