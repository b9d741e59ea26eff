// Nine tones after Paul Tol's qualitative schemes (2021), which stay apart under the common colour vision deficiencies.
#include "core/drawing/palette.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace bl::drawing {

namespace {

constexpr std::array<Colour, 9> kTones = {Colour{0.933, 0.667, 0.400}, Colour{0.427, 0.624, 0.831}, Colour{0.855, 0.478, 0.522},
                                          Colour{0.373, 0.710, 0.580}, Colour{0.925, 0.843, 0.490}, Colour{0.667, 0.576, 0.780},
                                          Colour{0.702, 0.745, 0.337}, Colour{0.573, 0.820, 0.894}, Colour{0.757, 0.745, 0.725}};

}  // namespace

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

Colour Palette::colour(const std::string& use) const {
  const auto found = order_.find(use);
  if (found == order_.end()) return kTones.back();
  // More uses than tones: the same tones again, darker round by round; the letters still tell them apart.
  const std::size_t round = found->second / kTones.size();
  return mix(kTones[found->second % kTones.size()], kShade, std::min(0.6, 0.3 * static_cast<double>(round)));
}

std::string Palette::letter(const std::string& use) const {
  const auto found = order_.find(use);
  if (found == order_.end()) return "?";
  std::string out;
  for (std::size_t rest = found->second + 1; rest > 0; rest = (rest - 1) / 26)
    out.insert(out.begin(), static_cast<char>('A' + (rest - 1) % 26));
  return out;
}

}  // namespace bl::drawing
