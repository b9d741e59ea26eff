// Colours mixed and written, and the letters of uses; their colours are those of use_colours.
#include "core/drawing/palette.h"

#include <algorithm>
#include <cmath>

#include "core/drawing/use_colours.h"

namespace bl::drawing {

std::string hex(const Colour& colour) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string out = "#";
  for (const double part : {colour.red, colour.green, colour.blue}) {
    const auto value = static_cast<unsigned>(std::lround(std::clamp(part, 0.0, 1.0) * 255));
    out += kDigits[value >> 4];
    out += kDigits[value & 15];
  }
  return out;
}

Colour mix(const Colour& a, const Colour& b, double share) {
  const double s = std::clamp(share, 0.0, 1.0);
  return {a.red + (b.red - a.red) * s, a.green + (b.green - a.green) * s, a.blue + (b.blue - a.blue) * s};
}

Palette::Palette(const std::vector<std::string>& uses) {
  for (const std::string& use : uses) order_.emplace(use, order_.size());
}

Colour Palette::colour(const std::string& use) const { return use_colour(use).colour; }

std::string Palette::letter(const std::string& use) const {
  const auto found = order_.find(use);
  if (found == order_.end()) return "?";
  std::string out;
  for (std::size_t rest = found->second + 1; rest > 0; rest = (rest - 1) / 26)
    out.insert(out.begin(), static_cast<char>('A' + (rest - 1) % 26));
  return out;
}

}  // namespace bl::drawing
