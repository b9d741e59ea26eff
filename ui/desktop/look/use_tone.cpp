// Packs the colours of the one table as numbers.
#include "ui/desktop/look/use_tone.h"

#include <cmath>

#include "core/drawing/use_colours.h"

namespace bl::desktop {

std::size_t tone_of_use(const std::string& use) {
  if (use.empty()) return kNoUse;
  const drawing::Colour colour = drawing::use_colour(use).colour;
  const auto byte = [](double part) { return static_cast<std::size_t>(std::lround(255 * part)); };
  return byte(colour.red) << 16 | byte(colour.green) << 8 | byte(colour.blue);
}

}  // namespace bl::desktop
