// Kinds of links as a drawing groups them: each family has a colour and a dash of its own.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/graph/state.h"

namespace bl::report {

struct LinkFamily {
  std::string_view label, colour, dashes;
};

/// The family of a kind, for a drawing; nothing for kinds that join no places (demands).
const LinkFamily* family_of(std::string_view kind);

/// A link as a line between two nodes.
struct DrawnLink {
  const LinkFamily* family = nullptr;
  std::uint32_t from = 0, to = 0;
  std::string title;
};

struct DrawnLinks {
  std::vector<DrawnLink> lines;
  std::vector<const LinkFamily*> families;  ///< that occur, in the order of the legend
  std::vector<std::string> beside;          ///< kinds with how many of them: what joins other things than volumes
  std::vector<std::string> left_out;        ///< links over sets too large to be drawn
};
DrawnLinks links_to_draw(const State& state);

}  // namespace bl::report
